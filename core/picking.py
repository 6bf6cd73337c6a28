"""What lies near a place: control points, and places on the curve, through the pyramids."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.affine import IDENTITY, Affine
from core.blocks import FAN
from core.pyramid import PolygonPyramid, Pyramid, contained, meets
from core.view import view

_FINENESS: Final = 32
"""How much finer than the radius the curve is followed."""


def points_within(
    polygon: PolygonPyramid,
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
    most: int | None = None,
    placed: Affine = IDENTITY,
) -> NDArray[np.intp] | None:
    """Indices of the control points in a rectangle, rising.

    Parameters
    ----------
    polygon
        The control polygon.
    lower, upper
        Corners of the rectangle, shape (2,).
    most
        Where a sign of each point would only be a blot: the number beyond which they are not
        sought.
    placed
        Where the polygon lies, as in `core.view.view`. If it is turned, points beside the rectangle
        may count for ``most``.

    Returns
    -------
    ndarray or None
        Shape (k,); None if there are more than ``most``.
    """
    low, high = placed.inverse.box(np.asarray(lower), np.asarray(upper))
    limits = np.concatenate([high, -low])
    points = polygon.points
    children = polygon.nodes(polygon.depth - 1)
    for level in range(polygon.depth - 1, -1, -1):
        boxes = polygon.boxes(level, children)
        nodes = children[meets(boxes, limits)]
        if most is not None:
            # All but the last node of a level are full.
            full = int(contained(boxes, limits).sum()) - 1
            if full * FAN ** (level + 1) > most:
                return None
        children = (FAN * nodes[:, None] + np.arange(FAN)).ravel()
    # The ends of the last block belong to it; the last point of an open polygon has no other.
    places = children[children < len(points)]
    if not polygon.closed and len(places) and places[-1] == polygon.spans - 1:
        places = np.append(places, polygon.spans)
    seen = placed(points[places])
    inside = (seen >= lower) & (seen <= upper)
    found: NDArray[np.intp] = places[inside.all(axis=1)]
    return None if most is not None and len(found) > most else found


def nearest_point(
    polygon: PolygonPyramid, place: NDArray[np.float64], radius: float, placed: Affine = IDENTITY
) -> tuple[int, float] | None:
    """Nearest control point within a radius, and its distance; of equals the last one.

    Parameters
    ----------
    polygon
        The control polygon.
    place
        Where it is sought, shape (2,).
    radius
        Farthest admitted distance, in the unit of the points.
    placed
        As in `points_within`.
    """
    near = points_within(polygon, place - radius, place + radius, placed=placed)
    if near is None or not len(near):
        return None
    distances = np.hypot(*(placed(polygon.points[near]) - place).T)[::-1]
    index = int(distances.argmin())
    distance = float(distances[index])
    return (int(near[len(near) - 1 - index]), distance) if distance <= radius else None


def nearest_place(
    pyramid: Pyramid, place: NDArray[np.float64], radius: float, placed: Affine = IDENTITY
) -> tuple[float, float] | None:
    """Parameter t of the nearest place on a curve, or polygon, within a radius; and its distance.

    Parameters
    ----------
    pyramid
        The curve, or the polygon, whose t is i at point i.
    place, radius, placed
        As in `nearest_point`; radius > 0.

    Returns
    -------
    t, distance
        The distance is that from chords that stay within 1/32 of the radius of the curve; t is
        linear along a chord.
    """
    tolerance = radius / _FINENESS
    seen = view(pyramid, place - radius, place + radius, tolerance, place, placed=placed)
    if not len(seen.vertices):
        return None
    x, y = seen.vertices.T
    way_x, way_y = np.diff(x), np.diff(y)
    length = way_x * way_x + way_y * way_y
    # The place is the origin. A step from run to run is no chord.
    share = -(x[:-1] * way_x + y[:-1] * way_y) / np.where(length > 0, length, 1.0)
    share = np.clip(share, 0.0, 1.0)
    distances = np.hypot(x[:-1] + share * way_x, y[:-1] + share * way_y)
    distances[seen.starts[1:-1] - 1] = np.inf
    index = int(distances.argmin())
    distance = float(distances[index])
    if distance > radius:
        return None
    t, after = seen.parameters[index : index + 2]
    return float(t + share[index] * (after - t)), distance
