"""Offset of closed contours by the radius of a tool, through pyclipr (Clipper2).

Definition
----------
A is what all polygons of a drawing enclose together, by the even-odd rule: what lies within an odd
number of them; so a contour inside another one is a hole. B(k) is a disk of radius k. The offset by
k > 0 is the edge of ``A + B(k)`` (all points within k of A): outer contours grow, holes shrink. The
offset by -k is the edge of ``A - B(k)`` (the points whose disk lies in A). Round joins come from
the definition: at a corner the centre of the tool runs round it.

What is proven
--------------
Let C be exact curves, and the polygons within e of them, piece by piece: then the winding numbers
differ only at points that are within e of both, so that ``A_C - B(e)`` lies in A, and A in
``A_C + B(e)``. With d = e + (the tolerance of the joins) + (the larger one of thinning and the
radius of slivers that are dropped) + (the grid), for k > 0

    ``A_C + B(k - d)``  lies in the result, and the result in  ``A_C + B(k + d)``,

and likewise inside. So each point of the result keeps a distance between k - d and k + d from the
exact curves, and the result lies between two exact offsets. It is within d of the exact offset by
k itself wherever the two of these are: not where the number or the connection of contours changes
between k - d and k + d, as where a slot as wide as the tool may close or stay open.

The grid is what Clipper2 computes on; how much its roundings add up to is not proven, but is taken
to be `_GRID_UNITS` of its units, a thousandth of the tolerance each. `core.formats.verify` measures
the distances of the finished file from the exact curves on its own.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.formats.clipping import Grid, Node, doubled_area, engine_of, grown, length, library, tree

_GRID_UNITS: Final = 8
"""Units of the grid that two rounds of rounding, with the crossings found, move a contour by."""

_JOIN_SHARE: Final = 1 / 2
"""Share of the tolerance for the chords of round joins; thinning takes the rest."""

_COINCIDENT: Final = 10
"""Tolerances that paths may run along each other."""

_ROUNDED_LENGTH: Final = 1e-6
"""The same as a share of the length: what rounding to the grid may take away."""

_FEWEST_THINNED: Final = 8
"""Vertices from which on a contour is thinned."""

_PLAIN: Final = 2
"""Tolerances by which the tool has to leave more than was drawn, so that it is told."""


@dataclass(frozen=True, eq=False)
class Ring:
    """One closed contour of an offset.

    Attributes
    ----------
    points
        Vertices, shape (n, 2), n >= 3; the first is not repeated. They run in the direction of the
        polygon that the ring follows, and begin near the first point of it.
    sources
        Indices of the polygons whose parts it follows; that of which it has most comes first.
    """

    points: NDArray[np.float64]
    sources: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Offset:
    """Contours that a tool runs along.

    Attributes
    ----------
    rings
        The contours, in the order of the polygons that they follow; none crosses itself or
        another.
    deviation
        Bound of the distance from the offset of the polygons; see the notes of the module.
    gone
        Indices of the polygons that no ring follows: the tool does not fit into them, or what they
        enclose is nothing.
    crossing
        Pairs of indices of polygons that cross, the smaller one first.
    rounded
        Points, shape (m, 2), one for each place where the tool cannot follow: its edge leaves what
        was drawn by more than some tolerances there, as it is a corner or a slot too narrow.
    """

    rings: tuple[Ring, ...]
    deviation: float
    gone: tuple[int, ...]
    crossing: tuple[tuple[int, int], ...]
    rounded: NDArray[np.float64]


def offset(polygons: Sequence[NDArray[np.float64]], kerf: float, tolerance: float) -> Offset:
    """Offset closed polygons by the radius of a tool.

    Parameters
    ----------
    polygons
        Closed polygons, shape (n, 2) each, the first point not repeated. They may cross
        themselves and each other; the even-odd rule says what they enclose.
    kerf
        The offset, not 0: > 0 outwards, < 0 inwards.
    tolerance
        Largest deviation from the offset of the polygons, > 0.

    Raises
    ------
    NinepointError
        If pyclipr is not installed, polygons run along each other, nothing is left, or the
        coordinates are too large for the tolerance.
    """
    clipper = library()
    grid = Grid.of(polygons, kerf, tolerance)
    numbered = [grid.put(polygon, index) for index, polygon in enumerate(polygons)]
    area = tree(engine_of(clipper, numbered).execute2(clipper.ClipType.Union))
    _check_length(numbered, area, tolerance, grid.scale)
    reach = abs(kerf) * grid.scale
    joins = _JOIN_SHARE * tolerance
    spare = tolerance - joins - _GRID_UNITS / grid.scale
    moved = 0.0
    rings: list[Ring] = []
    places: list[NDArray[np.float64]] = []
    for region in _regions(area, kerf > 0):
        whole = grown(clipper, region.paths, region.sign * reach, joins * grid.scale)
        found = _without_slivers(clipper, whole, region.sign, spare * grid.scale)
        if sum(map(len, found)) < sum(map(len, whole)):
            moved = spare
        for rows in itertools.chain.from_iterable(found):
            points, thinned = _thinned(grid.taken(rows), spare)
            moved = max(moved, thinned)
            rings.append(_followed(points, _sources(rows), polygons))
        parts = _rounded(clipper, region, found, reach, tolerance * grid.scale)
        places += [grid.taken(part)[:1] for part in parts]
    if not rings:
        raise NinepointError(
            f"With a kerf of {kerf:g} mm nothing is left: the tool fits into no curve."
            " Choose a smaller kerf."
        )
    rings.sort(key=lambda ring: ring.sources[0])
    seen = {source for ring in rings for source in ring.sources}
    return Offset(
        tuple(rings),
        joins + moved + _GRID_UNITS / grid.scale,
        tuple(index for index in range(len(polygons)) if index not in seen),
        _crossing(area),
        np.concatenate([np.zeros((0, 2)), *places]),
    )


@dataclass(frozen=True, eq=False)
class _Region:
    """What can be offset on its own: a connected part of the drawn area, or of what is around it.

    Attributes
    ----------
    paths
        Its edges; the outer one counterclockwise, holes clockwise.
    sign
        -1 if it shrinks. The part without an end is given by what it leaves out, which grows: 1.
    """

    paths: list[NDArray[np.float64]]
    sign: int


def _regions(area: tuple[Node, ...], outwards: bool) -> list[_Region]:
    """Regions by which an area grows, or shrinks.

    What shrinks keeps to itself: so to grow, the parts of the complement are shrunk. Each by
    itself takes Clipper a time that grows with its size, all together with the square of that.
    """
    found = [_Region([node.rows for node in area], 1)] if outwards else []
    waiting = [(node, True) for node in area]
    while waiting:
        node, filled = waiting.pop()
        waiting += [(inner, not filled) for inner in node.inner]
        if filled != outwards:
            nodes = (node, *node.inner)
            found.append(_Region([n.rows if filled else n.turned() for n in nodes], -1))
    return found


def _without_slivers(
    clipper: Any, found: list[list[NDArray[np.float64]]], sign: int, spare: float
) -> list[list[NDArray[np.float64]]]:
    """Edges but for those of parts in which no circle of the radius ``spare`` fits.

    Where the tool hardly fits, what is left of a slot hangs on the roundings of its edges.
    """
    if sign < 0:
        return [paths for paths in found if not _is_sliver(clipper, paths, spare)]
    return [
        [outer, *(hole for hole in holes if not _is_sliver(clipper, [hole[::-1]], spare))]
        for outer, *holes in found
    ]


def _is_sliver(clipper: Any, paths: list[NDArray[np.float64]], spare: float) -> bool:
    # No point of a part is further from its edge than its largest circle's radius; so that is no
    # less than area by perimeter.
    area = sum(map(doubled_area, paths)) / 2
    if area > spare * sum(map(length, paths)):
        return False
    return not grown(clipper, paths, -spare, spare)


def _check_length(
    paths: list[NDArray[np.float64]],
    area: tuple[Node, ...],
    tolerance: float,
    scale: float,
) -> None:
    """Refuse paths that coincide: where there are two, the even-odd rule sees no edge.

    Elsewhere each part of a path is an edge, so that the edges have the length of the paths.
    """
    edges = []
    waiting = [*area]
    for node in waiting:
        waiting += node.inner
        edges.append(node.rows)
    drawn, left = (sum(map(length, rows)) / scale for rows in (paths, edges))
    if drawn - left > max(_COINCIDENT * tolerance, _ROUNDED_LENGTH * drawn):
        raise NinepointError(
            f"Curves lie on each other for {(drawn - left) / 2:.4g} mm, so inside and outside"
            " cannot be told apart. Delete one of them, or set the kerf to 0."
        )


def _sources(rows: NDArray[np.float64]) -> tuple[int, ...]:
    """Indices of the polygons that a ring follows, those with most vertices first."""
    counts = np.bincount(rows[:, 2].astype(np.intp))
    counts[0] = 0
    order = np.argsort(-counts, kind="stable")
    return tuple((order[counts[order] > 0] - 1).tolist())


def _crossing(area: tuple[Node, ...]) -> tuple[tuple[int, int], ...]:
    """Pairs of polygons of which parts are joined into one edge."""
    pairs = set()
    waiting = [*area]
    for node in waiting:
        waiting += node.inner
        marks = node.rows[:, 2].astype(np.intp) - 1
        after = np.roll(marks, -1)
        changes = np.flatnonzero((marks != after) & (marks >= 0) & (after >= 0))
        for pair in zip(marks[changes].tolist(), after[changes].tolist(), strict=True):
            pairs.add((min(pair), max(pair)))
    return tuple(sorted(pairs))


def _rounded(
    clipper: Any,
    region: _Region,
    found: list[list[NDArray[np.float64]]],
    reach: float,
    tolerance: float,
) -> list[NDArray[np.float64]]:
    """Parts of a region that the tool should have room for, but has not.

    A tool that keeps to the shrunk region covers this grown by its radius.
    """
    joins = _JOIN_SHARE * tolerance
    plain = grown(clipper, region.paths, region.sign * _PLAIN * tolerance, joins)
    if region.sign < 0:
        paths = list(itertools.chain.from_iterable(found))
        covered = grown(clipper, paths, reach, joins)
        more, less = plain, covered
    else:
        more = [part for paths in found for part in grown(clipper, paths, -reach, joins)]
        less = plain
    if not more:
        return []
    engine = engine_of(clipper, list(itertools.chain.from_iterable(more)))
    if less:
        engine.addPaths(list(itertools.chain.from_iterable(less)), clipper.PathType.Clip)
    parts = tree(engine.execute2(clipper.ClipType.Difference))
    return [part.rows for part in parts]


def _thinned(
    points: NDArray[np.float64], spare: float
) -> tuple[NDArray[np.float64], float]:
    """Ring without vertices near the chord of their neighbours, and the largest distance of these.

    Offsetting makes two vertices of each. No two neighbours go, so the ring moves by no more than
    the distance of one.
    """
    count = len(points)
    if count < _FEWEST_THINNED:
        return points, 0.0
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    way, off = after - before, points - before
    square = (way**2).sum(axis=1)
    share = np.divide((way * off).sum(axis=1), square, out=np.zeros(count), where=square > 0)
    away = np.hypot(*(off - np.clip(share, 0, 1)[:, None] * way).T)
    near = away <= spare
    # Every second of a run of near ones, counted from where the last far one was.
    places = np.arange(count)
    last_far = np.maximum.accumulate(np.where(near, -1, places))
    goes = near & ((places - last_far) % 2 == 1)
    goes[-1] &= not goes[0]
    return points[~goes], float(away[goes].max(initial=0.0))


def _followed(
    points: NDArray[np.float64],
    sources: tuple[int, ...],
    polygons: Sequence[NDArray[np.float64]],
) -> Ring:
    """Ring that runs as its polygon does, from near the start of that."""
    polygon = polygons[sources[0]]
    if (doubled_area(points) > 0) != (doubled_area(polygon) > 0):
        points = points[::-1]
    first = int(np.hypot(*(points - polygon[0]).T).argmin())
    return Ring(np.roll(points, -first, axis=0), sources)
