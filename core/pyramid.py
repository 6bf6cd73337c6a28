"""Boxes and chord deviations over blocks of spans, so that a million spans are not looked at.

Notes
-----
A node of level k stands for 8^k consecutive spans. It holds the points of the curve at its ends, a
box that the curve does not leave, and its *deviation*: a bound of the distance of the curve from
the chord between the two ends. The control polygon has a pyramid as well; its spans are straight.

On one span each coordinate stays within ``c max |D2p|`` of that of the chord, with its own second
differences and c from `core.chords`, proven. So on a block of 8 spans the curve stays within the
largest of these bounds of the polyline of the 9 ends; and a polyline stays as near to a segment as
its vertices do, since the distance from a convex set is convex. A node of 8 nodes follows in the
same way: the largest deviation of the children, plus the largest distance of their ends from the
chord. All bounds hold up to the rounding of the points.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.basis import BasicLimitFunction
from core.chords import chord_constant
from core.limit import LimitCurve
from core.ranges import around, within
from core.runs import PARTS

FAN: Final = PARTS
"""Children of a node. Two or four at a time are joined again when the detail is chosen."""

_TOP: Final = 64
"""Nodes that one vector operation looks at as fast as at one."""

_CHUNK: Final = 1024
"""Blocks that are computed at a time: what they need stays in the cache."""


class Pyramid(ABC):
    """Levels of detail above consecutive spans.

    Parameters
    ----------
    spans
        Number of spans, at least 1.

    Attributes
    ----------
    ends
        For each level from 1 on, shape (2, m + 1): points at the ends of the nodes.
    boxes
        Shape (4, m) each: lower x, lower y, and the negatives of upper x, upper y.
    deviations
        Shape (m,) each.

    Notes
    -----
    m is a multiple of 8, except at the top; nodes beyond the end are empty: no rectangle meets
    their boxes. What the spans are, a derived class tells by `spans_of`.
    """

    def __init__(self, spans: int) -> None:
        self.spans = spans
        self.ends: list[NDArray[np.float64]] = []
        self.boxes: list[NDArray[np.float64]] = []
        self.deviations: list[NDArray[np.float64]] = []
        count = -(-spans // FAN)
        while True:
            is_top = count <= _TOP
            room = count if is_top else -(-count // FAN) * FAN
            self.ends.append(np.zeros((2, room + 1)))
            self.boxes.append(np.full((4, room), np.inf))
            self.deviations.append(np.zeros(room))
            if is_top:
                break
            count = room // FAN
        self.update((range(spans),))

    @abstractmethod
    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Ends of the spans of some blocks, and how far each coordinate can leave the chord.

        Parameters
        ----------
        blocks
            Rising indices of nodes of level 1, shape (m,).

        Returns
        -------
        ends, margins
            Shapes (2, m, 9) and (2, m, 8). Spans beyond the end of the curve are points.
        """

    def update(self, touched: Iterable[range]) -> None:
        """Take over spans that have changed; the cost is that of the changed blocks.

        Parameters
        ----------
        touched
            Ranges of spans, as `core.live.LiveCurve.move` returns them.
        """
        nodes = _unique([np.arange(r.start // FAN, -(-r.stop // FAN)) for r in touched])
        for begin in range(0, len(nodes), _CHUNK):
            self._write_blocks(nodes[begin : begin + _CHUNK])
        for level in range(1, len(self.ends) if len(nodes) else 0):
            nodes = _unique([nodes // FAN])
            self._write_nodes(level, nodes)

    def _write_blocks(self, blocks: NDArray[np.intp]) -> None:
        ends, margins = self.spans_of(blocks)
        margins = margins.max(axis=2)
        largest = np.hypot(margins[0], margins[1])
        self._write_ends(0, blocks, ends)
        self.boxes[0][:, blocks] = boxes_of(ends) - np.concatenate([margins, margins])
        self.deviations[0][blocks] = largest + from_chords(ends).max(axis=1)

    def _write_nodes(self, level: int, nodes: NDArray[np.intp]) -> None:
        children = (FAN * nodes[:, None] + np.arange(FAN)).ravel()
        ends = children_ends(self.ends[level - 1], nodes)
        largest = folded(np.maximum, self.deviations[level - 1][children])
        self._write_ends(level, nodes, ends)
        self.boxes[level][:, nodes] = folded(np.minimum, self.boxes[level - 1][:, children])
        self.deviations[level][nodes] = largest + from_chords(ends).max(axis=1)

    def _write_ends(self, level: int, nodes: NDArray[np.intp], ends: NDArray[np.float64]) -> None:
        held = self.ends[level]
        held[:, nodes] = ends[:, :, 0]
        held[:, nodes + 1] = ends[:, :, -1]
        after = int(nodes[-1]) + 1
        if after * FAN ** (level + 1) >= self.spans:
            held[:, after + 1 :] = held[:, after : after + 1]  # empty nodes are points


class CurvePyramid(Pyramid):
    """The levels of detail of a limit curve.

    Parameters
    ----------
    curve
        A limit curve with at least one span. If its points move (`core.live.LiveCurve.move`),
        `update` has to follow.

    Raises
    ------
    NoLimitError
        If no chord bound is proven for the scheme.
    """

    def __init__(self, curve: LimitCurve) -> None:
        mask = curve.mask
        self.curve = curve
        self._chord_constant = chord_constant(mask)
        self._bends = mask.end - mask.start - 1
        # Column s of this matrix makes the curve point s steps on from the points of a block.
        weights = BasicLimitFunction(mask).table(0)[:-1, 0]
        self._limits = np.zeros((len(weights) + FAN, FAN + 1))
        for s in range(FAN + 1):
            self._limits[s : s + len(weights), s] = weights
        super().__init__(curve.spans)

    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Curve points at the ends of spans, and the proven bounds; see `Pyramid.spans_of`."""
        coordinates = self.curve.endless_points.T
        places = FAN * blocks[:, None] + np.arange(len(self._limits))
        held = coordinates[:, np.minimum(places, coordinates.shape[1] - 1)]
        ends = held @ self._limits
        margins = self._chord_constant * running_max(bends_of(held), self._bends)
        beyond = self.spans - FAN * int(blocks[-1])
        if beyond < FAN:
            ends[:, -1, beyond:] = ends[:, -1, beyond : beyond + 1]
            margins[:, -1, beyond:] = 0.0
        return ends, margins


class PolygonPyramid(Pyramid):
    """The levels of detail of a control polygon; its spans are the edges.

    Parameters
    ----------
    points
        Control points, shape (n, 2), at least 2. They are not copied: when they change in place,
        `update` has to follow.
    closed
        Whether an edge leads from the last point to the first.
    """

    def __init__(self, points: NDArray[np.float64], closed: bool) -> None:
        self.points = points
        self.closed = closed
        super().__init__(len(points) if closed else len(points) - 1)

    def edges_at(self, indices: ArrayLike) -> tuple[range, ...]:
        """Edges that end in some control points, as `update` wants them."""
        places = np.asarray(indices, dtype=np.intp)
        return within(around(places, 1, 1), self.spans, self.closed) if places.size else ()

    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Control points at the ends of edges, and zeros; see `Pyramid.spans_of`."""
        places = np.minimum(FAN * blocks[:, None] + np.arange(FAN + 1), self.spans)
        ends = self.points[places % len(self.points)].transpose(2, 0, 1)
        return ends, np.zeros((2, len(blocks), FAN))


def _unique(rising: list[NDArray[np.intp]]) -> NDArray[np.intp]:
    """All values of arrays that rise, one after the other, each value once."""
    if not rising:
        return np.zeros(0, dtype=np.intp)
    values = np.concatenate(rising)
    found: NDArray[np.intp] = values[np.append(True, values[1:] > values[:-1])]
    return found


def children_ends(below: NDArray[np.float64], nodes: NDArray[np.intp]) -> NDArray[np.float64]:
    """Ends of the children of some nodes, shape (2, m, 9), from all ends of the level below."""
    return below[:, FAN * nodes[:, None] + np.arange(FAN + 1)]


def bends_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sizes of the second differences of each coordinate, along the last axis."""
    bends: NDArray[np.float64] = np.abs(np.diff(np.diff(points)))
    return bends


def boxes_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Boxes of points (2, ..., r): lower corners, and the negatives of the upper, (4, ...)."""
    return np.concatenate([points.min(axis=-1), -points.max(axis=-1)])


def from_chords(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distances of the inner ones of points (2, ..., r) from the segment between the outer ones.

    Returns
    -------
    ndarray
        Shape (..., r - 2).
    """
    x, y = points[..., 1:-1] - points[..., :1]
    way_x, way_y = points[..., -1:] - points[..., :1]
    length = way_x * way_x + way_y * way_y
    share = (x * way_x + y * way_y) / np.where(length > 0, length, 1.0)
    np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
    x -= share * way_x
    y -= share * way_y
    x *= x
    y *= y
    distances: NDArray[np.float64] = np.sqrt(x + y)
    return distances


def folded(extreme: np.ufunc, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Extreme of each `FAN` consecutive entries of the last axis."""
    size = FAN
    while size > 1:
        values = extreme(values[..., ::2], values[..., 1::2])
        size //= 2
    return values


def running_max(values: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Largest of each ``size`` consecutive entries of the last axis, by doubling."""
    reach = 1
    while reach < size:
        step = min(reach, size - reach)
        values = np.maximum(values[..., :-step], values[..., step:])
        reach += step
    return values


def meets(boxes: NDArray[np.float64], limits: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which boxes (4, ...) have a point in a rectangle, itself (4,): upper x, y, - lower x, y."""
    x, y, left, below = boxes
    found: NDArray[np.bool_] = (x <= limits[0]) & (y <= limits[1])
    found &= (left <= limits[2]) & (below <= limits[3])
    return found


def contained(boxes: NDArray[np.float64], limits: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which boxes (4, ...) that are not empty lie in a rectangle; limits as in `meets`."""
    x, y, left, below = boxes
    found: NDArray[np.bool_] = (-left <= limits[0]) & (-below <= limits[1])
    found &= (-x <= limits[2]) & (-y <= limits[3]) & (x < np.inf)
    return found
