"""Boxes in logical pixels: around things, with a margin, and which of them meet a region."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

Box = tuple[float, float, float, float]
"""Left, top, right, bottom, in logical pixels."""

SMOOTHED_PX: Final = 1.5
"""How far beyond its outline a shape may leave ink: smoothed edges, and rounding to pixels."""

MOST_PARTS: Final = 8
"""Number of boxes that the difference of two things is told in."""


def around(boxes: NDArray[np.float64], reach: float) -> Box:
    """Box around boxes, shape (4, k), and a margin; without any, a box that nothing meets."""
    if not boxes.shape[1]:
        return np.inf, np.inf, -np.inf, -np.inf
    left, top = (boxes[:2].min(axis=1) - reach).tolist()
    right, bottom = (boxes[2:].max(axis=1) + reach).tolist()
    return left, top, right, bottom


def meeting(
    boxes: NDArray[np.float64], region: NDArray[np.float64], reach: float
) -> NDArray[np.bool_]:
    """Which of some boxes, shape (4, k), with a margin, meet a region of rectangles, (r, 4)."""
    left, top, right, bottom = boxes
    found = np.zeros(boxes.shape[1], dtype=bool)
    for low_x, low_y, high_x, high_y in region:
        meets = (left <= high_x + reach) & (right >= low_x - reach)
        meets &= (top <= high_y + reach) & (bottom >= low_y - reach)
        found |= meets
    return found


def gathered(boxes: NDArray[np.float64], reach: float) -> list[Box]:
    """A few boxes that hold many, shape (4, k), with a margin; neighbours go together."""
    count = boxes.shape[1]
    if not count:
        return []
    parts = min(count, MOST_PARTS)
    firsts = np.arange(parts) * count // parts
    low = np.minimum.reduceat(boxes[:2], firsts, axis=1) - reach
    high = np.maximum.reduceat(boxes[2:], firsts, axis=1) + reach
    return [(a, b, c, d) for a, b, c, d in np.concatenate([low, high]).T.tolist()]
