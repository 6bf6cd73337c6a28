"""The outline of a broad line: filled, it is what a pen would draw, in half of the time or less.

Definitions
-----------
The *outline* of a polyline goes along its left side at half of its breadth and back along its right
side, from segment to segment straight on: corners are bevelled. At an open end it goes round in a
half circle.

Notes
-----
Filled by the winding rule an outline covers what the segments' rectangles and the corners between
them do, each place once: at the inner side of a corner it turns the other way round and takes away
what the two rectangles there have in common. Only where segments are shorter than the line is
broad, and turn sharply, may a place be missed or counted twice.

Qt's own stroker puts more vertices and counts places at the corners twice: on a smooth curve it is
off by 0.18 of a pixel's ink where this outline is off by 0.06. It also works on all of a line even
if little of it is seen; filling leaves out what is not. Measured on a curve of 150 vertices in
900 x 600 pixels, two wide: 0.74 ms by a pen and 0.39 ms filled, 0.18 and 0.01 ms where a square of
40 pixels of it is painted.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainterPath

from app.polyline import polygon_of
from core.extreme import largest, least

_ROUND: Final = np.pi * np.arange(1, 6) / 6
_COS: Final = np.cos(_ROUND)
_SIN: Final = np.sin(_ROUND)
"""Vertices of a half circle: its chords are off by 3 % of the half breadth."""

_TURNED: Final = np.array([[1.0], [-1.0]])
"""Turns a way to the left by a right angle, after x and y have changed places."""


def outline(
    vertices: NDArray[np.float64], half: float | NDArray[np.float64], is_loop: bool
) -> NDArray[np.float64]:
    """Outline of a polyline.

    Parameters
    ----------
    vertices
        In pixels, shape (k, 2), k >= 1, finite; a loop ends where it starts.
    half
        Half of the breadth, or that at each vertex, shape (k,).
    is_loop
        Whether the sides go on over the seam, without ends.

    Returns
    -------
    ndarray
        Shape (m, 2), not closed. What it has along a segment, and at the corners beside it, depends
        on that segment and its two neighbours alone, in every bit.
    """
    places = vertices.T
    starts, ends = places[:, :-1], places[:, 1:]
    ways = ends - starts
    squares = ways * ways
    # Not by hypot, whose last bits may depend on how many there are.
    lengths = np.sqrt(squares[0] + squares[1])
    if not len(lengths) or least(lengths) == 0:
        # A segment without a length has no direction.
        long = lengths > 0
        if not long.any():
            return _disc(places[:, :1], half if isinstance(half, float) else largest(half))
        kept = np.concatenate([[True], long])
        half = half if isinstance(half, float) else half[kept]
        return outline(places[:, kept].T, half, is_loop)
    sides = ways[::-1] * _TURNED / lengths
    # Both ends of each segment: (coordinate, segment, end).
    both, beside = np.empty((2, len(lengths), 2)), sides[:, :, None]
    both[:, :, 0], both[:, :, 1] = starts, ends
    if isinstance(half, float):
        sides *= half
    else:
        beside = beside * np.stack([half[:-1], half[1:]], axis=1)
    left = (both + beside).reshape(2, -1)
    right = (both - beside).reshape(2, -1)
    if is_loop:
        return np.concatenate([left, left[:, :1], right[:, :1], right[:, ::-1]], axis=1).T
    end = _cap(ends[:, -1:], beside[:, -1, -1:])
    begin = _cap(starts[:, :1], -beside[:, 0, :1])
    return np.concatenate([left, end, right[:, ::-1], begin], axis=1).T


def path_of(closed: NDArray[np.float64]) -> QPainterPath:
    """Qt's copy of an outline, to be filled."""
    path = QPainterPath()
    path.addPolygon(polygon_of(closed))
    path.closeSubpath()
    path.setFillRule(Qt.FillRule.WindingFill)
    return path


def _cap(middle: NDArray[np.float64], side: NDArray[np.float64]) -> NDArray[np.float64]:
    """Half circle from one side, (2, 1), forwards to the other, ends left out: shape (2, 5)."""
    cap: NDArray[np.float64] = middle + _COS * side - _SIN * (side[::-1] * _TURNED)
    return cap


def _disc(middle: NDArray[np.float64], half: float) -> NDArray[np.float64]:
    side = np.array([[half], [0.0]])
    halves = [middle + side, _cap(middle, side), middle - side, _cap(middle, -side)]
    return np.concatenate(halves, axis=1).T
