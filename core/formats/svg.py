"""SVG of contours at true size. Write only.

What is written
---------------
One ``path`` for each contour, absolute M, L and Z, in millimetres: the user unit is 1 mm, set by
width, height and viewBox together. No transforms; y points down in SVG, so it is flipped in the
coordinates. The page is exactly the contours' box, so that every program shows the part's true
size as that of the page; at its edge a viewer that clips shows half of the stroke. Inkscape is
asked for a hairline, which adds nothing to its bounding boxes. The same contours give the same
bytes.
"""

from __future__ import annotations

import re
from html import escape
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.flatten import Polyline
from core.formats.contours import Contours

STROKE_MM: Final = 0.1
"""Width of the line: thin enough for laser programs, visible on a screen."""

MAX_PATH_BYTES: Final = 9_000_000
"""Largest text of one path; common readers refuse an attribute of 10 MB."""

GUARD_DIGITS: Final = 2
"""Decimals beyond those of the tolerance: 0.01 mm is written with 4."""


def encode(contours: Contours, title: str) -> bytes:
    """Text of an SVG file, UTF-8.

    Parameters
    ----------
    contours
        What to draw.
    title
        Title of the drawing.

    Raises
    ------
    NinepointError
        If a path would be longer than `MAX_PATH_BYTES`.
    """
    places = contours.decimals
    low, high = contours.low, contours.high
    # A straight line along an axis would have a page without a height, which nobody can show.
    margin = np.where(high - low > 0, 0.0, STROKE_MM / 2)
    origin = np.array([low[0], high[1]]) + margin * (-1.0, 1.0)
    width, height = (_decimal(side, places) for side in (high - low + 2 * margin).tolist())
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1"',
        f'     width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"',
        '     overflow="visible">',
        f"<title>{_text(title)}</title>",
    ]
    for name, line in zip(contours.names, contours.polylines, strict=True):
        path = _path(line, origin, places)
        if len(path) > MAX_PATH_BYTES:
            raise NinepointError(
                f"The contour {name!r} needs {len(line.points):,} vertices, more than SVG readers"
                " take in one path; choose a larger tolerance, or DXF."
            )
        lines.append(
            f'<path fill="none" stroke="#000000" stroke-width="{STROKE_MM:g}"'
            ' stroke-linejoin="round" style="-inkscape-stroke:hairline"'
            f' d="{path}"><title>{_text(name)}</title></path>'
        )
    lines.append("</svg>\n")
    return "\n".join(lines).encode()


def _path(line: Polyline, origin: NDArray[np.float64], places: int) -> str:
    """Path data of a contour; the page's upper left corner is ``origin`` in the document."""
    page = (line.points - origin) * (1.0, -1.0) + 0.0  # there is no -0 then
    steps = "\nL".join(f"{_decimal(x, places)} {_decimal(y, places)}" for x, y in page.tolist())
    return f"M{steps}{'Z' if line.closed else ''}"


def _decimal(value: float, places: int) -> str:
    """Decimal number without zeros at its end; ``places`` is at least 1, ``value`` not negative."""
    return f"{value:.{places}f}".rstrip("0").rstrip(".")


def _text(words: str) -> str:
    """Words as XML can hold them: no control characters, no halves of characters."""
    dropped = re.sub("[\0-\x1f\ud800-\udfff\ufffe\uffff]", "", words)
    return escape(dropped, quote=False)
