"""SVG of contours at true size. Write only; `core.formats.embedded` reads our own files back.

What is written
---------------
One ``path`` for each contour, absolute M, L or C, and Z, in the unit of the profile: the user unit
is 1 mm (or 1 inch), set by width, height and viewBox together. No transforms; y points down in SVG,
so it is flipped in the coordinates. The page is exactly the contours' box, so that every program
shows the part's true size as that of the page; at its edge a viewer that clips shows half of the
stroke. Inkscape is asked to show thin lines as hairlines, which add nothing to its bounding boxes.
Layers are groups that Inkscape knows as layers. The same contours give the same bytes.

The document itself is in the metadata, and each path bears a digest of its data in a namespace of
our own: so a reader can tell whether the document still is what the paths show.
"""

from __future__ import annotations

import hashlib
import math
import re
from html import escape
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core import store
from core.beziers import Beziers
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats import decimals
from core.formats.contours import Contour, Contours

NAMESPACE: Final = "urn:ninepoint:1"
"""Namespace of our own attributes and of the document."""

INKSCAPE: Final = "http://www.inkscape.org/namespaces/inkscape"

HAIRLINE_MM: Final = 0.1
"""Widest line that Inkscape is asked to show as a hairline."""

MAX_PATH_BYTES: Final = 9_000_000
"""Largest text of one path; common readers refuse an attribute, or a text, of 10 MB."""

_NEARLY: Final = 1e-3
"""Share of the last decimal by which contours may reach over the page: the box of cubics is
computed, and rounding must not make the page larger by a whole decimal."""


def encode(contours: Contours, title: str) -> bytes:
    """Text of an SVG file, UTF-8.

    Parameters
    ----------
    contours
        What to draw: cubics or polylines.
    title
        Title of the drawing.

    Raises
    ------
    NinepointError
        If a contour is of another kind.
    """
    profile, places = contours.profile, contours.places
    origin, size = page(contours)
    unit = profile.unit
    width, height = (decimals.word(side, places) for side in size.tolist())
    paths = [
        (contour, path)
        for contour, count in zip(contours.contours, path_counts(contours), strict=True)
        for path in _paths(contour, origin, places, count)
    ]
    lines = [
        b'<?xml version="1.0" encoding="UTF-8"?>',
        b'<svg xmlns="http://www.w3.org/2000/svg" version="1.1"',
        f'     xmlns:inkscape="{INKSCAPE}" xmlns:ninepoint="{NAMESPACE}"'.encode(),
        f'     width="{width}{unit}" height="{height}{unit}"'.encode(),
        f'     viewBox="0 0 {width} {height}" overflow="visible">'.encode(),
        f"<title>{_text(title)}</title>".encode(),
        *_metadata(contours, len(paths), f"{width}{unit} {height}{unit} 0 0 {width} {height}"),
    ]
    stroke = (
        f'fill="none" stroke="{profile.colour}"'
        f' stroke-width="{_short(profile.width_mm / profile.unit_mm)}" stroke-linejoin="round"'
    )
    if profile.width_mm <= HAIRLINE_MM:
        stroke += ' style="-inkscape-stroke:hairline"'
    opened = ""
    for place, (contour, path) in enumerate(paths, start=1):
        if contour.layer != opened:
            label = contour.name if profile.layers == "by curve" else contour.layer.capitalize()
            group = f'<g id="{contour.layer}" inkscape:groupmode="layer"'
            lines += [b"</g>"] * (opened != "")
            lines.append(f'{group} inkscape:label="{_text(label)}">'.encode())
            opened = contour.layer
        # What `path_digest` says of it, as there is one sign of white space at a time.
        digest = hashlib.sha256(path.replace(b"\n", b" ")).hexdigest()
        head = f'<path {stroke} ninepoint:place="{place}" ninepoint:digest="{digest}" d="'
        tail = f'"><title>{_text(contour.name)}</title></path>'
        lines.append(b"".join([head.encode(), path, tail.encode()]))
    lines.append(b"</g>\n</svg>\n")
    return b"\n".join(lines)


def page(contours: Contours) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Upper left corner of the page in the coordinates of the contours, and its width and height.

    All are multiples of the last decimal, in the unit of the file.
    """
    scale = 10.0**contours.places
    low, high = contours.box
    low, high = np.floor(low * scale + _NEARLY), np.ceil(high * scale - _NEARLY)
    # A straight line along an axis would have a page without a height, which nobody can show.
    stroke = contours.profile.width_mm / contours.profile.unit_mm
    margin = np.where(high > low, 0.0, np.ceil(stroke / 2 * scale))
    origin = np.array([low[0] - margin[0], high[1] + margin[1]])
    return origin / scale, (high - low + 2 * margin) / scale


def path_counts(contours: Contours) -> list[int]:
    """Number of paths of each contour: more than one where it might be longer than readers take.

    A contour that is cut gives open paths, each of which starts where the one before ends.
    """
    _, size = page(contours)
    counts = []
    for contour in contours.contours:
        # What is between numbers, the digits before the point, the point, and those behind it.
        if isinstance(contour.shape, Beziers):
            # Control points lie beyond the page, though by less than its size; with a sign then.
            digits = 3 + len(str(int(2 * size.max()))) + contours.places
            piece = 6 * digits + 1
        else:
            digits = 2 + len(str(int(size.max()))) + contours.places
            piece = 2 * digits + 1
        start_and_end = 2 * digits + 1
        most = max((MAX_PATH_BYTES - start_and_end) // piece, 1)
        counts.append(math.ceil(contour.pieces / most))
    return counts


def path_digest(data: str) -> str:
    """Digest of the data of a path; any white space is one blank, as XML may replace it."""
    return hashlib.sha256(" ".join(data.split()).encode()).hexdigest()


def document_digest(text: str) -> str:
    """Digest of the document in the metadata; white space around lines does not count."""
    lines = "\n".join(line.strip() for line in text.split("\n")).strip()
    return hashlib.sha256(lines.encode()).hexdigest()


def _metadata(contours: Contours, paths: int, page: str) -> list[bytes]:
    """The document as JSON; in several texts, where one would be longer than readers take."""
    data = store.encode(contours.document)
    # The checksum of a file is that of its bytes, which XML changes; the digest replaces it.
    head, _, rest = data.split(b"\n", 2)
    text = (head + b"\n" + rest).decode().rstrip("\n")
    # XML cannot hold these two, JSON can in another way.
    text = text.replace("\ufffe", "\\ufffe").replace("\uffff", "\\uffff")
    digest = document_digest(text)
    pieces = []
    first = 0
    while first < len(text):
        last = first + MAX_PATH_BYTES // 4  # a letter has four bytes at most
        if last < len(text):
            last = text.rfind("\n", first, last) + 1 or last
        pieces.append(escape(text[first:last], quote=False))
        first = last
    inner = "</ninepoint:part>\n<ninepoint:part>".join(pieces)
    return [
        f'<metadata><ninepoint:drawing page="{page}" paths="{paths}" digest="{digest}">'.encode(),
        f"<ninepoint:part>{inner}</ninepoint:part>".encode(),
        b"</ninepoint:drawing></metadata>",
    ]


def _paths(
    contour: Contour, origin: NDArray[np.float64], places: int, count: int
) -> list[bytes]:
    """Data of the paths of a contour; the page's corner is ``origin`` in the document."""
    shape = contour.shape
    if isinstance(shape, Beziers):
        start = shape.controls[:1, 0]
        rows = shape.controls[:, 1:].reshape(-1, 6)
        between = (b"\nC", *[b" "] * 5, b"")
    elif isinstance(shape, Polyline):
        start, rows = shape.points[:1], shape.points[1:]
        between = (b"\nL", b" ", b"")
        if shape.closed and count > 1:
            rows = np.concatenate([rows, start])
    else:
        raise NinepointError(f"SVG holds cubics or polylines; {contour.name!r} is neither.")
    sides = rows.shape[1] // 2
    corner, flip = np.tile(origin, sides), np.tile([1.0, -1.0], sides)
    found = []
    for part in np.array_split(rows, count):
        first = decimals.text((b"M", b" ", b""), (start - origin) * flip[:2], (places,) * 2)
        steps = decimals.text(between, (part - corner) * flip, (places,) * len(corner))
        found.append(first + steps)
        start = part[-1:, -2:]
    if shape.closed and count == 1:
        found[0] += b"Z"
    return found


def _short(value: float) -> str:
    """Shortest text of a length, without an exponent."""
    return np.format_float_positional(value, precision=6, fractional=False, trim="-")


def _text(words: str) -> str:
    """Words as XML can hold them: no control characters, no halves of characters."""
    dropped = re.sub("[\0-\x1f\ud800-\udfff\ufffe\uffff]", "", words)
    return escape(dropped, quote=True)
