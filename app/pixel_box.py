"""Boxes in logical pixels: around things, with a margin, and where they differ."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRect

Box = tuple[float, float, float, float]
"""Left, top, right, bottom, in logical pixels."""

SMOOTHED_PX: Final = 1.5
"""How far beyond its outline a shape may leave ink: smoothed edges, and rounding to pixels."""

MOST_PARTS: Final = 8
"""Number of boxes that the difference of two things is told in."""

_NEAR: Final = 40
"""Places between two that differ up to which they go into one box."""


def box_of(rectangle: QRect) -> Box:
    """Box of some whole pixels."""
    left, top = rectangle.left(), rectangle.top()
    return left, top, left + rectangle.width(), top + rectangle.height()


def around(places: NDArray[np.float64], reach: float) -> Box:
    """Box around places, shape (k, 2), and a margin; without any, a box that nothing meets."""
    if not len(places):
        return np.inf, np.inf, -np.inf, -np.inf
    left, top = np.minimum.reduce(places).tolist()
    right, bottom = np.maximum.reduce(places).tolist()
    return left - reach, top - reach, right + reach, bottom + reach


def meeting(places: NDArray[np.float64], box: Box, reach: float) -> NDArray[np.bool_]:
    """Which places, shape (k, 2), lie within a reach of a box."""
    left, top, right, bottom = box
    near = (places >= (left - reach, top - reach)) & (places <= (right + reach, bottom + reach))
    found: NDArray[np.bool_] = near[:, 0] & near[:, 1]
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
    if last - first >= len(chosen) - 1 + _NEAR:
        gaps = chosen[1:] - chosen[:-1]
        wide = (gaps > _NEAR).nonzero()[0]
        if len(wide) >= MOST_PARTS:
            wide = np.sort(wide[np.argpartition(gaps[wide], 1 - MOST_PARTS)[1 - MOST_PARTS :]])
        firsts, lasts = chosen[wide + 1].tolist(), chosen[wide].tolist()
        edges = list(zip([first, *firsts], [*lasts, last], strict=True))
    boxes = []
    for low, high in edges:
        held = [row[max(low - beside, 0) : high + beside + 1] for row in rows]
        boxes.append(around(held[0] if len(held) == 1 else np.concatenate(held), reach))
    return boxes
