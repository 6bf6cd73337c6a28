"""SVG of contours at true size. Write only.

What is written
---------------
One ``path`` for each contour, absolute M, L and Z, in millimetres: the user unit is 1 mm, set by
width, height and viewBox together. No transforms; y points down in SVG, so it is flipped in the
coordinates. The page is the box of the ink, the contours' box with half a stroke around it: no
line is cut at the page's edge, and the page is not larger than what is on it. The path's own
extents are those of the contours. The same contours give the same bytes.
"""

from __future__ import annotations

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
    corner = np.array([low[0], high[1]])
    width, height = (_decimal(side + STROKE_MM, places) for side in (high - low).tolist())
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1"',
        f'     width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">',
        f"<title>{_text(title)}</title>",
    ]
    for name, line in zip(contours.names, contours.polylines, strict=True):
        path = _path(line, corner, places)
        if len(path) > MAX_PATH_BYTES:
            raise NinepointError(
                f"The contour {name!r} needs {len(line.points):,} vertices, more than SVG readers"
                " take in one path; choose a larger tolerance, or DXF."
            )
        lines.append(
            f'<path fill="none" stroke="#000000" stroke-width="{STROKE_MM:g}"'
            f' stroke-linejoin="round" d="{path}"><title>{_text(name)}</title></path>'
        )
    lines.append("</svg>\n")
    return "\n".join(lines).encode()


def _path(line: Polyline, corner: NDArray[np.float64], places: int) -> str:
    """Path data of a contour, the page's upper left corner being half a stroke from ``corner``."""
    page = (line.points - corner) * (1.0, -1.0) + STROKE_MM / 2
    steps = "\nL".join(f"{_decimal(x, places)} {_decimal(y, places)}" for x, y in page.tolist())
    return f"M{steps}{'Z' if line.closed else ''}"


def _decimal(value: float, places: int) -> str:
    """Decimal number without zeros at its end; ``places`` is at least 1, ``value`` not negative."""
    return f"{value:.{places}f}".rstrip("0").rstrip(".")


def _text(words: str) -> str:
    """Words as XML can hold them: no control characters, no halves of characters."""
    kept = (c for c in words if c >= " " and not "\ud800" <= c <= "\udfff" and c < "\ufffe")
    return escape("".join(kept), quote=False)
