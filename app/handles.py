"""What lies under the mouse: hit tests in pixels, and what they mean in the drawing.

Everything here is a pure function of arrays; pixels have y down. Among things at equal distance
the one that is drawn last, on top, is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.extreme import least

DYADIC: Final = 2**10
"""Places on a span that a curve is grabbed at: t is a multiple of 1/1024."""


class PointHit(NamedTuple):
    """A control point near the mouse."""

    curve: int
    point: int
    distance_px: float

    @property
    def key(self) -> tuple[int, int]:
        """The pair that a selection holds."""
        return self.curve, self.point


class EdgeHit(NamedTuple):
    """A place on the control polygon: ``share`` of the way from point ``edge`` to the next."""

    curve: int
    edge: int
    share: float
    distance_px: float


class CurveHit(NamedTuple):
    """A place on a limit curve, at the parameter ``t``."""

    curve: int
    t: float
    distance_px: float


def nearest_point(
    polygons_px: Sequence[NDArray[np.float64]],
    pos_px: NDArray[np.float64],
    radius_px: float,
    preferred: int = -1,
) -> PointHit | None:
    """Nearest control point within a radius.

    Parameters
    ----------
    polygons_px
        Control points of each curve, shape (n, 2).
    pos_px
        The mouse, shape (2,).
    radius_px
        Farthest admitted distance.
    preferred
        Curve that wins when points of several curves lie at the same place.
    """
    best: PointHit | None = None
    for curve in _order(len(polygons_px), preferred):
        points = polygons_px[curve]
        if not len(points):
            continue
        # The last of equals: points are drawn in order, so it lies on top.
        x, y = points.T
        away_x, away_y = x - pos_px[0], y - pos_px[1]
        squares = (away_x * away_x + away_y * away_y)[::-1]
        place = int(squares.argmin())
        index, distance = len(points) - 1 - place, float(np.sqrt(squares[place]))
        if distance <= radius_px and (best is None or distance < best.distance_px):
            best = PointHit(curve, index, distance)
    return best


def nearest_edge(
    polygons_px: Sequence[NDArray[np.float64]],
    loops: Sequence[bool],
    pos_px: NDArray[np.float64],
    radius_px: float,
    preferred: int = -1,
) -> EdgeHit | None:
    """Nearest place on the control polygons within a radius; ``loops`` says which are closed."""
    best: EdgeHit | None = None
    for curve in _order(len(polygons_px), preferred):
        found = _nearest_on(polygons_px[curve], loops[curve], pos_px)
        if found is None or found[2] > radius_px:
            continue
        if best is None or found[2] < best.distance_px:
            best = EdgeHit(curve, *found)
    return best


def nearest_on_curve(
    curves_px: Sequence[NDArray[np.float64]],
    parameters: Sequence[NDArray[np.float64]],
    starts: Sequence[NDArray[np.intp]],
    periods: Sequence[int],
    pos_px: NDArray[np.float64],
    radius_px: float,
    preferred: int = -1,
) -> CurveHit | None:
    """Nearest place on the drawn limit curves within a radius.

    Parameters
    ----------
    curves_px, parameters
        Drawn vertices of each curve, shape (k, 2), and their t, shape (k,).
    starts
        First vertex of each run of consecutive ones, and k.
    periods
        Number of spans of each closed curve, 0 of an open one.
    pos_px, radius_px, preferred
        As in `nearest_point`.

    Returns
    -------
    CurveHit or None
        Its t is linear between the vertices, rounded to a multiple of 1/1024.
    """
    best: CurveHit | None = None
    for curve in _order(len(curves_px), preferred):
        found = _nearest_on(curves_px[curve], False, pos_px, starts[curve][1:-1] - 1)
        if found is None or found[2] > radius_px:
            continue
        edge, share, distance = found
        if best is None or distance < best.distance_px:
            before, after = parameters[curve][edge : edge + 2].tolist()
            dyadic = round((before + share * (after - before)) * DYADIC) / DYADIC
            period = periods[curve]
            best = CurveHit(curve, dyadic % period if period else dyadic, distance)
    return best


def _order(count: int, preferred: int) -> list[int]:
    """Curves from the top down, the preferred one before all."""
    order = list(range(count - 1, -1, -1))
    if 0 <= preferred < count:
        order.remove(preferred)
        order.insert(0, preferred)
    return order


def _nearest_on(
    vertices: NDArray[np.float64],
    closed: bool,
    pos: NDArray[np.float64],
    gaps: NDArray[np.intp] | None = None,
) -> tuple[int, float, float] | None:
    """Segment, share of it and distance of the nearest place on a polyline, not in its gaps."""
    if len(vertices) < 2:
        return None
    x, y = vertices.T
    from_x, from_y = (x, y) if closed else (x[:-1], y[:-1])
    to_x, to_y = (np.roll(x, -1), np.roll(y, -1)) if closed else (x[1:], y[1:])
    way_x, way_y = to_x - from_x, to_y - from_y
    away_x, away_y = pos[0] - from_x, pos[1] - from_y
    # Far out of view the squares may overflow; such segments are at an infinite distance.
    with np.errstate(over="ignore", invalid="ignore"):
        length = way_x * way_x + way_y * way_y
        along = way_x * away_x + way_y * away_y
        share = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
        np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
        off_x, off_y = away_x - share * way_x, away_y - share * way_y
        squares = off_x * off_x + off_y * off_y
    if gaps is not None:
        squares[gaps] = np.inf
    if np.isnan(least(squares)):
        squares[np.isnan(squares)] = np.inf
    index = int(squares.argmin())
    return index, float(share[index]), float(np.sqrt(squares[index]))
