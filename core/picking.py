"""What lies near a place: control points, and places on the curve, through the pyramids."""

from __future__ import annotations

from math import sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.affine import IDENTITY, Affine
from core.blocks import FAN
from core.pyramid import CurvePyramid, PolygonPyramid, Pyramid, contained, meets
from core.vectors import lengths
from core.view import view

_FINENESS: Final = 32
"""How much finer than the radius the curve is followed."""

_AT_ONCE: Final = 512
"""Nodes that are looked at as soon as eight."""

_CHILDREN: Final = np.arange(FAN)

_ROUNDING: Final = 1 + 1e-12
"""Factor on squares of distances that covers their rounding."""


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
    search = _Search(place, radius, placed, 0.0)
    places = _parts(search.blocks(polygon)).ravel()
    places = places[places < polygon.spans]
    if not len(places):
        return None
    # The ends of the last block belong to it; the last point of an open polygon has no other.
    if not polygon.closed and places[-1] == polygon.spans - 1:
        places = np.append(places, polygon.spans)
    x, y = search.offsets(polygon.points[places].T)
    squares = (x * x + y * y)[::-1]
    index = int(squares.argmin())
    distance = float(np.sqrt(squares[index]))
    return (int(places[len(places) - 1 - index]), distance) if distance <= radius else None


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
        No other place is nearer by more than 1/32 of the radius. The distance is that from chords,
        t is linear along a chord. If there is no place within the radius, None.
    """
    tolerance = radius / _FINENESS / 2
    search = _Search(place, radius, placed, tolerance)
    blocks = search.blocks(pyramid)
    if not len(blocks):
        return None
    ends, margins = pyramid.spans_of(blocks)
    spans = _parts(blocks).ravel()
    spans = spans[: len(spans) + min(pyramid.spans - int(spans[-1]) - 1, 0)]
    told = np.stack([ends[:, :-1], ends[:, 1:], margins], axis=1)
    told = told.transpose(0, 1, 3, 2).reshape(2, 3, -1)[..., : len(spans)]
    level: int | None = 0
    if isinstance(pyramid, CurvePyramid):
        straight = tolerance / placed.stretch
        level = pyramid.level(lengths(*told[:, 2]), straight)
        if level != 0:
            kept = search.near(_boxes(told))
            spans, told = spans[kept], told[..., kept]
            if not len(spans):
                return None
            level = pyramid.level(lengths(*told[:, 2]), straight)
        if level is None:
            return _nearest_seen(pyramid, place, radius, placed)
        if level:
            points = pyramid.curve.span_points(spans, level).transpose(2, 0, 1)
    if not level:
        points = told[:, :2].transpose(0, 2, 1)
    x, y = search.offsets(points)
    place_at, share, distance = _on_chords(x, y)
    span, part = divmod(place_at, x.shape[1] - 1)
    t = float(spans[span] + (part + share) / (x.shape[1] - 1))
    return (t, distance) if distance <= radius else None


def _nearest_seen(
    pyramid: Pyramid, place: NDArray[np.float64], radius: float, placed: Affine
) -> tuple[float, float] | None:
    """As `nearest_place`, of spans that reach so far beyond the square that they have to be cut."""
    tolerance = radius / _FINENESS
    seen = view(pyramid, place - radius, place + radius, tolerance, place, placed=placed)
    if not len(seen.vertices):
        return None
    x, y = seen.vertices.T
    index, share, distance = _on_chords(x[None], y[None], seen.starts[1:-1] - 1)
    if distance > radius:
        return None
    t, after = seen.parameters[index : index + 2]
    return float(t + share * (after - t)), distance


def _on_chords(
    x: NDArray[np.float64], y: NDArray[np.float64], gaps: NDArray[np.intp] | None = None
) -> tuple[int, float, float]:
    """Chord of polylines (k, m) that is nearest to the origin, share of it, and distance.

    A chord is told by its index in all k (m - 1) of them; those in ``gaps`` do not count.
    """
    from_x, from_y = x[:, :-1], y[:, :-1]
    way_x, way_y = x[:, 1:] - from_x, y[:, 1:] - from_y
    length = way_x * way_x + way_y * way_y
    share = -(from_x * way_x + from_y * way_y) / np.where(length > 0, length, 1.0)
    share = np.minimum(np.maximum(share, 0.0), 1.0)
    off_x, off_y = from_x + share * way_x, from_y + share * way_y
    squares = (off_x * off_x + off_y * off_y).ravel()
    if gaps is not None:
        squares[gaps] = np.inf
    index = int(squares.argmin())
    return index, float(share.ravel()[index]), float(np.sqrt(squares[index]))


def _boxes(told: NDArray[np.float64]) -> NDArray[np.float64]:
    """Boxes (4, m) of what lies between ends, no further off than a margin: told, (2, 3, m)."""
    starts, stops, margins = told.swapaxes(0, 1)
    return np.concatenate(
        [np.minimum(starts, stops) - margins, -np.maximum(starts, stops) - margins]
    )


def _parts(nodes: NDArray[np.intp]) -> NDArray[np.intp]:
    """Children of nodes, or spans of blocks, whether they exist or not; shape (m, 8)."""
    return FAN * nodes[:, None] + _CHILDREN


class _Search:
    """What lies near a place, found by boxes: the nearest thing is in one that is near.

    Whatever is in a box is no nearer than the box, and no farther than its farthest corner. So
    boxes are left out that are farther than the radius, or than the farthest corner of another.

    Parameters
    ----------
    place, radius, placed
        As in `nearest_place`.
    spare
        By how much a thing may be farther than the nearest one.
    """

    def __init__(
        self, place: NDArray[np.float64], radius: float, placed: Affine, spare: float
    ) -> None:
        back = placed.inverse
        self._matrix = None if placed.is_shift else placed.matrix
        self._place = back(np.asarray(place, dtype=np.float64))[:, None]
        self._shift = np.concatenate([-self._place, self._place])
        self._stretch, self._back = placed.stretch, back.stretch
        self._farthest, self._spare = radius, spare

    def blocks(self, pyramid: Pyramid) -> NDArray[np.intp]:
        """Nodes of level 0 that may hold the nearest thing, rising."""
        level = pyramid.depth - 1
        counts = [boxes.shape[1] for boxes in pyramid.blocks.boxes]
        while level and counts[level - 1] <= _AT_ONCE:
            level -= 1
        nodes = pyramid.nodes(level)
        nodes = nodes[self.near(pyramid.boxes(level, nodes))]
        while level and len(nodes):
            level -= 1
            nodes = _parts(nodes).ravel()
            # Only the last node of a level may have fewer.
            if nodes[-1] >= counts[level]:
                nodes = nodes[nodes < counts[level]]
            nodes = nodes[self.near(pyramid.boxes(level, nodes))]
        return nodes

    def near(self, boxes: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which boxes (4, m), m >= 1, may hold it; empty ones are infinite."""
        before, after = (boxes + self._shift).reshape(2, 2, -1)
        ways = np.empty((2, *before.shape))
        near = np.maximum(before, after, out=ways[0])
        np.maximum(near, 0.0, out=near)
        np.minimum(before, after, out=ways[1])
        ways *= ways
        nearest, farthest = ways[:, 0] + ways[:, 1]
        best = int(farthest.argmin())
        reach = self._stretch * sqrt(farthest[best])
        is_nearer = reach < self._farthest
        self._farthest = min(self._farthest, reach)
        # Of boxes as near as can be told, one is enough, unless all that is equal is sought.
        limit = self._back * (self._farthest - (self._spare if is_nearer else 0.0))
        found: NDArray[np.bool_] = nearest <= max(limit, 0.0) ** 2 * _ROUNDING
        if is_nearer:
            found[best] = True
        return found

    def offsets(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Ways from the place to points (2, ...), where these lie."""
        ways = (points.reshape(2, -1) - self._place).reshape(points.shape)
        if self._matrix is None:
            return ways
        return np.asarray(np.tensordot(self._matrix, ways, axes=1))
