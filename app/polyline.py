"""Vertices in pixels for Qt: clipped to what it can hold, thinned, and handed over at once."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPolygonF
from shiboken6 import VoidPtr

SAFE_PX: Final = 1e4
"""Largest coordinate that is handed to Qt, and more than any screen is wide.

From 32,767 device pixels on Qt clips a shape to what is being painted, and what of it is seen would
depend, in the last bits, on where one looks.
"""

POINT_BYTES: Final = 16
"""Size of Qt's point: two floats."""

DENSE: Final = 4000
"""Number of vertices above which those that fall on the same quarter pixel are merged."""


SNAP: Final = 64
"""Places that a vertex may have in a device pixel, along each axis: as many as Qt tells apart."""

SNAPPED_PX: Final = math.sqrt(0.5) / SNAP
"""How far it may be off for that, in device pixels."""


def thinned(
    vertices: NDArray[np.float64], t: NDArray[np.float64], starts: NDArray[np.intp]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.intp]]:
    """Runs of vertices without those that repeat the quarter pixel before them.

    They move by less than the eye can see, and a curve of a million points that fills a window is
    left with some thousands. Few vertices stay as they are.

    Parameters
    ----------
    vertices, t, starts
        As in `core.runs.Runs`.
    """
    if len(vertices) <= DENSE:
        return vertices, t, starts
    quarters = np.rint(vertices * 4)
    keep = np.ones(len(vertices), dtype=bool)
    keep[1:] = (np.diff(quarters, axis=0) != 0).any(axis=1)
    keep[starts[:-1]] = keep[starts[1:] - 1] = True
    return vertices[keep], t[keep], np.append(0, np.cumsum(keep))[starts]


def within_square(
    vertices: NDArray[np.float64],
    t: NDArray[np.float64],
    starts: NDArray[np.intp],
    limit: float = SAFE_PX,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.intp]]:
    """Parts of runs of vertices within the square of half width ``limit`` about the origin.

    Parameters
    ----------
    vertices, t, starts
        As in `core.runs.Runs`, in pixels; finite.
    limit
        Half width of the square.

    Returns
    -------
    vertices, t, starts
        The same of the parts, each of two vertices at least.
    """
    start, way, took = vertices[:-1], np.diff(vertices, axis=0), np.diff(t)
    # Liang and Barsky: the part of each segment within the square is enter <= s <= leave.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        low, high = (-limit - start) / way, (limit - start) / way
    still = way == 0
    outside = still & (np.abs(start) > limit)
    low[still], high[still] = -np.inf, np.inf
    enter = np.maximum(np.minimum(low, high).max(axis=1), 0.0)
    leave = np.minimum(np.maximum(low, high).min(axis=1), 1.0)
    seen = (enter <= leave) & ~outside.any(axis=1)
    seen[starts[1:-1] - 1] = False
    chosen = np.flatnonzero(seen)
    start, way, took, since = start[chosen], way[chosen], took[chosen], t[chosen]
    enter, leave = enter[chosen], leave[chosen]
    # A new part begins where the segment before is unseen or was cut at its end, or a run ends.
    whole = (np.diff(chosen) == 1) & (leave[:-1] == 1.0)
    fresh = np.concatenate([[True] * bool(len(chosen)), ~whole]).astype(bool)
    firsts = np.flatnonzero(fresh)
    tails = np.clip(start + leave[:, None] * way, -limit, limit)
    heads = np.clip(start + enter[:, None] * way, -limit, limit)[firsts]
    times = (since + enter * took)[firsts]
    return (
        np.insert(tails, firsts, heads, axis=0),
        np.insert(since + leave * took, firsts, times),
        np.append(firsts, len(chosen)) + np.arange(len(firsts) + 1),
    )


def snapped(vertices: NDArray[np.float64], ratio: float) -> NDArray[np.float64]:
    """Vertices on the grid of `SNAP` places a device pixel; ``ratio`` is the screen's.

    Far from a point that is dragged a curve moves by less than can be seen. On the grid it mostly
    does not move at all, and need not be painted anew.
    """
    steps = SNAP * ratio
    return np.rint(vertices * steps) / steps


def polygon_of(vertices: NDArray[np.float64]) -> QPolygonF:
    """Qt's copy of the vertices, filled through its buffer."""
    polygon = QPolygonF()
    count = len(vertices)
    polygon.resize(count)
    if count:
        # The type stubs know neither the size of a VoidPtr nor that it is a buffer.
        buffer = VoidPtr(polygon.data(), count * POINT_BYTES, True)  # type: ignore[call-arg, arg-type]
        places = np.frombuffer(buffer, dtype=np.float64)  # type: ignore[call-overload]
        places[::2], places[1::2] = vertices[:, 0], vertices[:, 1]
    return polygon


def point_of(place: NDArray[np.float64]) -> QPointF:
    """Qt's copy of one place, kept within what Qt can hold."""
    x, y = np.clip(place, -SAFE_PX, SAFE_PX)
    return QPointF(float(x), float(y))
