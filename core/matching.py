"""Which place of a route belongs to which parameter of a limit curve, and how far apart they are.

Notes
-----
Each sample of the curve, `core.squares.SAMPLES` to a span, has a place on the route. Fitting
alternates two steps. With the places given, the control points follow from least squares in which
the distance along the route counts little, for the places move anyway. Then each place moves to the
foot of its sample. Where the route turns within the distance of a sample, along and across cannot
be told apart, and all directions count alike; a corner keeps the sample that is nearest to it.

Proof of the deviation. Take the places for given. Both the polygon of finer samples of the curve
and the route are run through so that sample and place are passed at the same time, and a vertex of
the route when a point between two samples is, whose shares of the step rise from vertex to vertex.
Between two such events both move along straight lines, so their distance is largest at an event,
where it is measured. The curve keeps to the polygon of its samples, at equal shares of t, by
`core.chords`, and the cubics keep to the route by `core.route`. So the sum of the three bounds the
distance of curve and cubics as moving points (Fréchet), hence the Hausdorff distance.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.bends import ChordBounds
from core.limit import LimitCurve
from core.route import Route
from core.samples import FINEST_LEVEL
from core.squares import LEVEL, SAMPLES, Squares

HELD: Final = 0.2
"""Weight of a distance along the route, in parts of one across, by which places stay about where
they are."""

FREE: Final = 0.05
"""The same where they shall move."""

_SMALL: Final = 1e-9
"""Part of the length of a route within which directions are compared at least."""

_STEPS: Final = 3
"""Steps towards a foot."""

_SHARE: Final = 1 / 16
"""Share of the admitted deviation that the bound between fine samples should take."""

_BLOCK: Final = 2**17
"""Number of fine samples that are held at a time, unless one span has more."""


_MOST: Final = 2**22
"""Number of fine samples beyond which the share may grow: the curve is so rough that it will not do
anyway."""

_COARSER: Final = 4.0
"""Factor by which it grows; one level less, for a smooth curve."""


def settled(
    route: Route,
    squares: Squares,
    points: NDArray[np.float64],
    places: NDArray[np.float64],
    along: float,
    rounds: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Control points nearer to a route, and places nearer to the feet of their samples.

    Parameters
    ----------
    route
        The route.
    squares
        Least squares for the polygon.
    points
        Control points to start from, shape (squares.count, 2).
    places
        Place of each sample, and of the end of the last span, not falling; when closed the last
        one is the first one and the length of the route.
    along
        Weight of distances along the route, `HELD` or `FREE`.
    rounds
        How often both steps are taken.
    """
    seen = _complex(squares.values(points))
    for _ in range(rounds):
        pinned, places = _pinned(route, places)
        starts = places[:-1]
        targets = route.at(starts)
        off = np.abs(seen - targets) + _SMALL * route.length
        before, after = route.directions(starts - off), route.directions(starts + off)
        both = before + after
        sizes = np.abs(both)
        forward = np.divide(both, sizes, out=after.copy(), where=sizes > _SMALL)
        weights = np.minimum(along**2 + np.angle(after * before.conj()) ** 2, 1.0)
        weights[pinned] = 1.0
        x, y, less = forward.real, forward.imag, 1 - weights
        points = squares.solved(
            points, targets, (1 - less * x * x, -less * x * y, 1 - less * y * y)
        )
        seen = _complex(squares.values(points))
        gaps = np.diff(places)
        reach = np.maximum(gaps, np.roll(gaps, 1))
        reach = np.maximum(reach, np.abs(seen - targets))
        reach[pinned] = 0.0
        if not route.closed:
            reach[0] = 0.0
        starts = route.nearer(seen, starts, reach, _STEPS)
        end = starts[0] + route.length if route.closed else route.length
        places = np.minimum(np.maximum.accumulate(np.append(starts, end)), end)
    return points, places


def deviations(
    route: Route, curve: LimitCurve, places: NDArray[np.float64], admitted: float
) -> NDArray[np.float64]:
    """Proven distance between each span of a curve and its part of a route, as moving points.

    Parameters
    ----------
    route
        The route; its own bound is not included.
    curve
        The limit curve; its scheme must have a chord bound, see `core.chords`.
    places
        As in `settled`. Those of the ends of the spans are taken as they are.
    admitted
        Deviation whose small part the bound between the samples should take.

    Returns
    -------
    ndarray
        Shape (spans,).
    """
    levels, found = _levels(curve, _SHARE * admitted)
    while (1 << levels).sum() > _MOST and levels.max() > LEVEL:
        admitted *= _COARSER
        levels, found = _levels(curve, _SHARE * admitted)
    vertices, lengths = route.vertices[:-1], route.lengths[:-1]
    if route.closed:
        # Places count from that of t = 0, which may lie anywhere.
        lengths = lengths + route.length * np.ceil((places[0] - lengths) / route.length)
        order = np.argsort(lengths, kind="stable")
        vertices, lengths = vertices[order], lengths[order]
    for level in np.flatnonzero(np.bincount(levels)):
        chosen = np.flatnonzero(levels == level)
        size = max(_BLOCK >> int(level), 1)
        for begin in range(0, len(chosen), size):
            spans = chosen[begin : begin + size]
            found[spans] += _distances(
                route, curve, places, (vertices, lengths), spans, int(level)
            )
    return found


def _levels(
    curve: LimitCurve, admitted: float
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Level at which each span is sampled, and the proven chord bound there.

    A span that stays too rough is given the finest level, and its bound is what it is.
    """
    chords = ChordBounds(curve)
    levels = np.full(curve.spans, FINEST_LEVEL, dtype=np.intp)
    bounds = np.empty(curve.spans)
    waiting = np.ones(curve.spans, dtype=np.bool_)
    for level in range(LEVEL, FINEST_LEVEL + 1):
        at = chords.at(level)
        reached = waiting & ((at <= admitted) | (level == FINEST_LEVEL))
        levels[reached], bounds[reached] = level, at[reached]
        waiting &= ~reached
        if not waiting.any():
            break
    return levels, bounds


def _distances(
    route: Route,
    curve: LimitCurve,
    places: NDArray[np.float64],
    line: tuple[NDArray[np.complex128], NDArray[np.float64]],
    spans: NDArray[np.intp],
    level: int,
) -> NDArray[np.float64]:
    """Largest distance between the samples of some spans, rising, and their parts of the route."""
    seen = _complex(curve.span_points(spans, level).transpose(2, 0, 1))
    steps = 1 << level
    fine = steps // SAMPLES
    coarse = places[spans[:, None] * SAMPLES + np.arange(SAMPLES + 1)]
    gaps = np.diff(coarse, axis=1)
    shares = np.arange(fine) / fine
    first = (coarse[:, :-1, None] + gaps[:, :, None] * shares).reshape(len(spans), steps)
    reach = np.repeat(np.maximum(gaps, np.roll(gaps, 1, axis=1)), fine, axis=1)
    starts, ends = coarse[:, :1], coarse[:, -1:]
    moved = route.nearer(seen[:, 1:-1].ravel(), first[:, 1:].ravel(), reach[:, 1:].ravel(), 2)
    moved = np.clip(moved.reshape(len(spans), steps - 1), starts, ends)
    where = np.concatenate([starts, np.maximum.accumulate(moved, axis=1), ends], axis=1)
    off = np.abs(seen - route.at(where.ravel()).reshape(where.shape))
    found: NDArray[np.float64] = off.max(axis=1)
    vertices, lengths = line
    # Which vertices lie within these spans, and after which sample.
    begin = np.searchsorted(lengths, starts[:, 0])
    counts = np.searchsorted(lengths, ends[:, 0]) - begin
    if not counts.any():
        return found
    rows = np.repeat(np.arange(len(spans)), counts)
    inner = np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts) + begin[rows]
    after = np.searchsorted(where.ravel(), lengths[inner], side="right") - 1
    after = np.clip(after - rows * (steps + 1), 0, steps - 1)
    corner = seen[rows, after]
    way = seen[rows, after + 1] - corner
    square = np.abs(way) ** 2
    along = ((vertices[inner] - corner) * way.conj()).real
    share = np.divide(along, square, out=np.zeros_like(along), where=square > 0)
    # Vertices between the same two samples are passed in their order.
    passed = rows * (steps + 1.0) + after
    share = np.maximum.accumulate(passed + np.clip(share, 0, 1)) - passed
    away = np.abs(vertices[inner] - corner - np.clip(share, 0, 1) * way)
    np.maximum.at(found, rows, away)
    return found


def _pinned(
    route: Route, places: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Samples that are nearest to the corners, and all places with theirs put there."""
    corners = route.corners
    last = len(places) - 1
    if not len(corners):
        return np.zeros(0, dtype=np.intp), places
    if route.closed:
        turns = np.ceil((places[0] - corners) / route.length)
        corners = np.sort(corners + route.length * turns)
    after = np.clip(np.searchsorted(places, corners), 1, last)
    nearest = after - (corners - places[after - 1] < places[after] - corners)
    if not route.closed:
        nearest = np.clip(nearest, 1, last - 1)
    places = places.copy()
    places[nearest] = corners
    if route.closed:
        if (nearest == last).any():
            places[0] = places[last] - route.length
        places[last] = places[0] + route.length
        nearest %= last
    return nearest, np.minimum(np.maximum.accumulate(places), places[last])


def _complex(coordinates: NDArray[np.float64]) -> NDArray[np.complex128]:
    return np.asarray(coordinates[0] + 1j * coordinates[1])
