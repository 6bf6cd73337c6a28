"""Boxes in logical pixels: around things, with a margin, and where they differ."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRect

from core.extreme import largest, least

Box = tuple[float, float, float, float]
"""Left, top, right, bottom, in logical pixels."""

SMOOTHED_PX: Final = 1.5
"""How far beyond its outline a shape may leave ink: smoothed edges, and rounding to pixels."""

MOST_PARTS: Final = 8
"""Number of boxes that the difference of two things is told in."""

_NEAR_SHARE: Final = 1 / 8
"""Part of a row that may lie between two places that differ for them to go into one box."""


def box_of(rectangle: QRect) -> Box:
    """Box of some whole pixels."""
    left, top = rectangle.left(), rectangle.top()
    return left, top, left + rectangle.width(), top + rectangle.height()


def around(places: NDArray[np.float64], reach: float) -> Box:
    """Box around places, shape (k, 2), and a margin; without any, a box that nothing meets."""
    if not len(places):
        return np.inf, np.inf, -np.inf, -np.inf
    # Each axis by itself: along the first one it takes ten times as long. And by its number: to be
    # unpacked, an array has to fail at a third row.
    x, y = places[:, 0], places[:, 1]
    return least(x) - reach, least(y) - reach, largest(x) + reach, largest(y) + reach


def meeting(places: NDArray[np.float64], box: Box, reach: float) -> NDArray[np.bool_]:
    """Which places, shape (k, 2), lie within a reach of a box."""
    left, top, right, bottom = box
    x, y = places[:, 0], places[:, 1]
    found: NDArray[np.bool_] = (x >= left - reach) & (x <= right + reach)
    found &= (y >= top - reach) & (y <= bottom + reach)
    return found


def apart(
    rows: tuple[NDArray[np.float64], ...], chosen: NDArray[np.intp], beside: int, reach: float
) -> list[Box]:
    """A few boxes with a margin that hold some places of a row, or of several rows.

    Parameters
    ----------
    rows
        Each of shape (k, 2).
    chosen
        Rising indices.
    beside
        Neighbours on either side that are held, too.
    reach
        The margin.
    """
    if not len(chosen):
        return []
    first, last = int(chosen[0]), int(chosen[-1])
    edges = [(first, last)]
    near = 2 * beside + 1 + int(len(rows[0]) * _NEAR_SHARE)
    if last - first >= len(chosen) - 1 + near:
        gaps = chosen[1:] - chosen[:-1]
        wide = (gaps > near).nonzero()[0]
        if len(wide) >= MOST_PARTS:
            wide = np.sort(wide[np.argpartition(gaps[wide], 1 - MOST_PARTS)[1 - MOST_PARTS :]])
        firsts, lasts = chosen[wide + 1].tolist(), chosen[wide].tolist()
        edges = list(zip([first, *firsts], [*lasts, last], strict=True))
    return [
        united(around(row[max(low - beside, 0) : high + beside + 1], reach) for row in rows)
        for low, high in edges
    ]


def grown(box: Box, reach: float) -> Box:
    """A box with a margin around it."""
    left, top, right, bottom = box
    return left - reach, top - reach, right + reach, bottom + reach


def united(boxes: Iterable[Box]) -> Box:
    """The box around some boxes, of which there must be one."""
    left, top, right, bottom = zip(*boxes, strict=True)
    return min(left), min(top), max(right), max(bottom)
