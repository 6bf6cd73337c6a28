"""Drawings of other programs, SVG and DXF: one place to open them, and to take them over.

A file is read as what it is, whatever its name says: programs and mail name files wrongly.
"""

from __future__ import annotations

import gzip
import re
import zlib
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Final

import numpy as np

from core import atomic
from core.document import MAX_COORDINATE_MM, MAX_POINTS, Curve, Document
from core.errors import FileError, NinepointError
from core.family import PRESETS, Parameters
from core.formats import read_dxf, read_svg
from core.formats.embedded import embedded
from core.formats.sketch import Sketch, Trace
from core.formats.svg import NAMESPACE

SUFFIXES: Final = (".svg", ".svgz", ".dxf")
"""Suffixes of the files that `read_sketch` reads."""

_GZIP: Final = b"\x1f\x8b"
_XML: Final = re.compile(rb"(?:\xef\xbb\xbf)?\s*<|\xff\xfe<|\xfe\xff\0<")
_NOT_DRAWINGS: Final = (
    (b"%PDF", "a PDF"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"PK\x03\x04", "a ZIP archive; unpack it first"),
    (b"%!PS", "a PostScript file"),
)


def read_sketch(path: str | Path) -> Sketch:
    """Read an SVG or DXF file of any program.

    Parameters
    ----------
    path
        The file; its contents say what it is, not its name. A compressed SVG (``.svgz``) is
        expanded, up to the size that is read of others.

    Returns
    -------
    Sketch
        With the document inside, if it is an SVG of ours that shows it still.

    Raises
    ------
    FileError
        If the file cannot be read, is neither SVG nor DXF, is damaged, asks for too much work, or
        holds no lines or curves.
    """
    path = Path(path)
    data = atomic.read(path)
    if data.startswith(_GZIP):
        data = _expanded(data, path)
    if not data.strip():
        raise FileError(path, "the file is empty.")
    for start, kind in _NOT_DRAWINGS:
        if data.startswith(start):
            raise FileError(path, f"it is {kind}; SVG and DXF can be read.")
    if _XML.match(data):
        sketch = read_svg.decode(data, path)
        if NAMESPACE.encode() not in data:
            return sketch
        return replace(sketch, document=embedded(data, path.name))
    return read_dxf.decode(data, path)


def polygons(sketch: Sketch, parameters: Parameters | None = None) -> Document:
    """Drawing whose control points are the nodes of the traces.

    Parameters
    ----------
    sketch
        What was read. What its curves do between the nodes is lost.
    parameters
        Member of the family that draws it; Calm by default.

    Raises
    ------
    NinepointError
        If there are more than `core.document.MAX_POINTS` nodes, or a coordinate is not admitted.
    """
    nodes = sum(len(trace.controls) + (not trace.closed) for trace in sketch.traces)
    if nodes > MAX_POINTS:
        raise NinepointError(
            f"The drawing has {nodes:,} vertices; at most {MAX_POINTS:,} can be control points."
            " Thin it out, or fit curves to it."
        )
    largest = float(np.abs([sketch.low, sketch.high]).max())
    if largest > MAX_COORDINATE_MM:
        raise NinepointError(
            f"The drawing reaches to {largest:g} mm; at most {MAX_COORDINATE_MM:g} mm are admitted."
            " Choose a smaller unit."
        )
    curves = tuple(
        Curve(trace.nodes, trace.closed, name(trace, index))
        for index, trace in enumerate(sketch.traces, 1)
    )
    return Document(curves, PRESETS["Calm"] if parameters is None else parameters)


def name(trace: Trace, index: int) -> str:
    """What the curve of a trace is called: its name, its layer's, or its number (from 1)."""
    return trace.name or (trace.layer if trace.layer != "0" else "") or f"Curve {index}"


def _expanded(data: bytes, path: Path) -> bytes:
    """Contents of a gzip file of an admitted size."""
    limit = atomic.MAX_BYTES
    try:
        with gzip.open(BytesIO(data)) as file:
            found = file.read(limit + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise FileError(path, "its compression is damaged; the file may be cut off.") from error
    if len(found) > limit:
        raise FileError(path, f"it expands to more than {limit / 1e6:,.0f} MB.")
    return found
