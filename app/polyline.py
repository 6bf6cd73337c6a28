"""Polylines in pixels: clipped to what Qt can hold, thinned, and handed over in one piece."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPolygonF
from shiboken6 import VoidPtr

SAFE_PX: Final = 1e5
"""Largest coordinate that is handed to Qt; its rasteriser counts in 24.8 fixed point."""

WHOLE: Final = 512
"""Number of vertices up to which a polyline is stroked in one piece, without any seam."""

RUN: Final = 64
"""Segments of a longer one that are stroked at a time: a wide pen's cost grows with its outline."""

POINT_BYTES: Final = 16
"""Size of Qt's point: two floats."""

DENSE: Final = 4000
"""Number of vertices above which those that fall on the same quarter pixel are merged."""


def runs(vertices: NDArray[np.float64], limit: float = SAFE_PX) -> list[NDArray[np.float64]]:
    """Parts of a polyline within the square of half width ``limit`` about the origin.

    Parameters
    ----------
    vertices
        Shape (n, 2), in pixels; finite.
    limit
        Half width of the square.

    Returns
    -------
    list of ndarray
        Polylines with at least two vertices; mostly the one that came in.
    """
    if len(vertices) < 2:
        return []
    if np.abs(vertices).max() <= limit:
        return [vertices]
    start, way = vertices[:-1], np.diff(vertices, axis=0)
    # Liang and Barsky: the part of each segment within the square is enter <= s <= leave.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        low, high = (-limit - start) / way, (limit - start) / way
    still = way == 0
    outside = still & (np.abs(start) > limit)
    low[still], high[still] = -np.inf, np.inf
    enter = np.maximum(np.minimum(low, high).max(axis=1), 0.0)
    leave = np.minimum(np.maximum(low, high).min(axis=1), 1.0)
    seen = (enter <= leave) & ~outside.any(axis=1)
    heads = np.clip(start + enter[:, None] * way, -limit, limit)
    tails = np.clip(start + leave[:, None] * way, -limit, limit)
    parts: list[NDArray[np.float64]] = []
    # A new part begins where the segment before is unseen or was cut at its end.
    fresh = seen & np.concatenate([[True], ~(seen[:-1] & (leave[:-1] == 1.0))])
    firsts = np.flatnonzero(fresh)
    ends = np.flatnonzero(seen & np.concatenate([~seen[1:] | fresh[1:], [True]]))
    for first, last in zip(firsts, ends, strict=True):
        parts.append(np.concatenate([heads[first : first + 1], tails[first : last + 1]]))
    return parts


def thinned(vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Polyline without the vertices that repeat the quarter pixel before them.

    It moves by less than the eye can see, and a curve of a million points that fills a window is
    left with some thousands. Short polylines stay as they are.
    """
    if len(vertices) <= DENSE:
        return vertices
    quarters = np.rint(vertices * 4)
    keep = np.ones(len(vertices), dtype=bool)
    keep[1:-1] = (np.diff(quarters[:-1], axis=0) != 0).any(axis=1)
    return vertices[keep]


def polygon_of(vertices: NDArray[np.float64]) -> QPolygonF:
    """Qt's copy of the vertices, filled through its buffer."""
    polygon = QPolygonF()
    count = len(vertices)
    polygon.resize(count)
    if count:
        # The type stubs know neither the size of a VoidPtr nor that it is a buffer.
        buffer = VoidPtr(polygon.data(), count * POINT_BYTES, True)  # type: ignore[call-arg, arg-type]
        places = np.frombuffer(buffer, dtype=np.float64)  # type: ignore[call-overload]
        places.reshape(count, 2)[:] = vertices
    return polygon


def stroke(painter: QPainter, vertices: NDArray[np.float64], view: QRectF) -> None:
    """Draw a polyline with the painter's pen; a long one in runs, without those out of view.

    The painter must have no brush, and its pen round caps, so that the runs join.
    """
    for part in runs(thinned(vertices)):
        if len(part) <= WHOLE:
            if (part[0] == part[-1]).all():
                painter.drawPolygon(polygon_of(part[:-1]))
            else:
                painter.drawPolyline(polygon_of(part))
            continue
        starts = np.arange(0, len(part) - 1, RUN)
        # A run's box holds its last vertex too, which is the first one of the next run.
        low = np.minimum.reduceat(part, starts, axis=0)
        high = np.maximum.reduceat(part, starts, axis=0)
        last = part[np.minimum(starts + RUN, len(part) - 1)]
        low, high = np.minimum(low, last), np.maximum(high, last)
        seen = (high >= (view.left(), view.top())).all(axis=1)
        seen &= (low <= (view.right(), view.bottom())).all(axis=1)
        for first in starts[seen]:
            painter.drawPolyline(polygon_of(part[first : first + RUN + 1]))


def point_of(place: NDArray[np.float64]) -> QPointF:
    """Qt's copy of one place, kept within what Qt can hold."""
    x, y = np.clip(place, -SAFE_PX, SAFE_PX)
    return QPointF(float(x), float(y))
