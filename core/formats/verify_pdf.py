"""What a PDF file of ours says, read by a strict reader that knows nothing of how it was written.

It finds the page and its contents by the table of places, as viewers do, and takes only the
operators that draw contours; anything else is refused.
"""

from __future__ import annotations

import re
import zlib
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.formats.readback import Readback, arcs_read, cubics_read, numbers_in

_INCH: Final = 72.0
"""Points of PDF in an inch."""

_UNITS: Final = {"mm": _INCH / 25.4, "in": _INCH}

_SAME: Final = 1e-9
"""Share by which a scale, of twelve digits, may differ."""

_HEAD: Final = re.compile(rb"(\S+) 0 0 (\S+) 0 0 cm\n[^\n]* RG\n\S+ w 1 j\n")

_PATH: Final = re.compile(
    rb"/OC /(L\d+) BDC\n([-\d.]+ [-\d.]+) m\n((?:[-\d. ]+ [lc]\n)+)([sS])\nEMC\n"
)
"""A layer, a start, lines or cubics, and whether the way back is drawn, too."""


def outlines(data: bytes, fine: float) -> tuple[str, NDArray[np.float64], list[Readback]]:
    """Unit, size of the page, and contours of a file; the origin is its lower left corner.

    Parameters and errors are those of `core.formats.verify_dxf.outlines`; layers are called L0, L1
    and so on.
    """
    sheet = _object(data, 3)
    box = re.search(rb"/MediaBox \[0 0 (\S+) (\S+)\] /UserUnit (\d+)", sheet)
    if box is None:
        raise NinepointError("its page has no size")
    width, height, unit = (float(number) for number in box.groups())
    drawn = _stream(_object(data, 4))
    head = _HEAD.match(drawn)
    if head is None or head[1] != head[2]:
        raise NinepointError("its page has no scale")
    scale = float(head[1]) * unit
    said = [name for name, points in _UNITS.items() if abs(scale / points - 1) < _SAME]
    if not said:
        raise NinepointError("its scale is that of no unit")
    found = []
    place = head.end()
    while place < len(drawn):
        path = _PATH.match(drawn, place)
        if path is None:
            raise NinepointError("a path has other data than lines or cubics")
        found.append(_outline(path, fine))
        place = path.end()
    return said[0], np.array([width, height]) * unit / scale, found


def named(outline: Readback, layers: list[str]) -> Readback:
    """Contour with the name of its layer, of which the file has the place."""
    place = int(outline.layer.removeprefix("L"))
    return replace(outline, layer=layers[place] if place < len(layers) else "")


def _object(data: bytes, number: int) -> bytes:
    """Text of an object, found by the table of places."""
    end = re.search(rb"startxref\n(\d+)\n%%EOF\n\Z", data)
    table = data[int(end[1]) :] if end else b""
    rows = re.findall(rb"(\d{10}) \d{5} [nf] \n", table)
    start = int(rows[number]) if number < len(rows) else len(data)
    head = b"%d 0 obj\n" % number
    if not data.startswith(head, start):
        raise NinepointError("its table of places is wrong")
    after = int(rows[number + 1]) if number + 1 < len(rows) else int(end[1]) if end else 0
    return data[start + len(head) : after]


def _stream(text: bytes) -> bytes:
    """What a compressed stream holds."""
    found = re.match(rb"<< /Length (\d+) /Filter /FlateDecode >>\nstream\n", text)
    if found is None:
        raise NinepointError("it has no contents")
    try:
        return zlib.decompress(text[found.end() : found.end() + int(found[1])])
    except zlib.error as error:
        raise NinepointError("its contents are damaged") from error


def _outline(path: re.Match[bytes], fine: float) -> Readback:
    layer, start, steps, ending = path.groups()
    kinds = set(re.findall(rb"[lc]", steps))
    if len(kinds) != 1:
        raise NinepointError("a path has lines and cubics")
    (kind,) = kinds
    size = 2 if kind == b"l" else 6
    words = (start + b" " + steps.replace(kind + b"\n", b" ")).decode()
    points = numbers_in(words, 2 + size * steps.count(kind)).reshape(-1, 2)
    closed, name = ending == b"s", layer.decode()
    if kind == b"l":
        return arcs_read(points, np.zeros(len(points)), closed, name, fine)
    rows = (len(points) - 1) // 3
    controls = np.empty((rows, 4, 2))
    controls[:, 0], controls[:, 1:] = points[:-1:3], points[1:].reshape(rows, 3, 2)
    return cubics_read(controls, closed and bool((points[0] == points[-1]).all()), name, fine)
