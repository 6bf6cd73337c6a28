"""Boxes, deviations and bends over blocks of a control polygon, whatever scheme draws it.

Notes
-----
A node of level k, from 0 on, stands for 8^(k+1) consecutive edges of the polygon, which are spans
of its curve as well. It holds a box of its points, its *deviation*, a bound of the distance of the
polygon from the chord between the node's ends, and its *bends*, the largest second differences of
each coordinate that any scheme of the family reads on its spans.

A polyline stays as near to a segment as its vertices do, since the distance from a convex set is
convex. A node of 8 nodes deviates by no more than the most deviating of these, plus the largest
distance of their ends from the chord, in the same way.

None of this depends on the scheme, but for the phantom points at the ends (`core.ends`): so nothing
is built anew when a slider moves. What the curve is off its polygon, the bends bound
(`core.chords`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.live import SIDE, LiveCurve
from core.ranges import around, within
from core.runs import PARTS
from core.vectors import gathered

FAN: Final = PARTS
"""Children of a node. Two or four at a time are joined again when the detail is chosen."""

_TOP: Final = 64
"""Nodes that one vector operation looks at as fast as at one."""

_CHUNK: Final = 1024
"""Blocks that are computed at a time: what they need stays in the cache."""

_READ: Final = SIDE + FAN + SIDE + 1
"""Points that the spans of a block read: from 8 before its first to 8 behind its last end."""


class Blocks:
    """Levels of detail above a control polygon.

    Parameters
    ----------
    curve
        The curve whose polygon it is, with at least one span. When its points or its scheme
        change, `update` has to follow.

    Attributes
    ----------
    boxes
        For each level, shape (4, m): lower x, lower y, and the negatives of upper x, upper y.
    deviations
        Shape (m,) each.
    bends
        Shape (2, m) each.

    Notes
    -----
    m is a multiple of 8, except at the top; nodes beyond the end are empty: no rectangle meets
    their boxes.

    Where the ends of an open curve are not reflected at its first and last point, but at centres
    near them, the polygon has two first edges: one from the point, which is seen, and one from the
    centre, which the curve follows. The box holds both, and the deviation covers both.
    """

    def __init__(self, curve: LiveCurve) -> None:
        self.curve = curve
        self.spans = curve.spans
        self.boxes: list[NDArray[np.float64]] = []
        self.deviations: list[NDArray[np.float64]] = []
        self.bends: list[NDArray[np.float64]] = []
        count = -(-self.spans // FAN)
        while True:
            is_top = count <= _TOP
            room = count if is_top else -(-count // FAN) * FAN
            self.boxes.append(np.full((4, room), np.inf))
            self.deviations.append(np.zeros(room))
            self.bends.append(np.zeros((2, room)))
            if is_top:
                break
            count = room // FAN
        self._update((range(self.spans),))

    def update(self, indices: ArrayLike) -> None:
        """Take over control points that have moved; the cost is that of the changed blocks.

        Parameters
        ----------
        indices
            The points, shape (k,), in any order.
        """
        places = np.asarray(indices, dtype=np.intp).reshape(-1)
        if not len(places):
            return
        # A span's block reads from SIDE before its own start to SIDE behind its own end.
        touched = around(places, SIDE + 1, SIDE + 1)
        if not self.curve.closed:
            if places.min() <= SIDE:
                touched.append((0, SIDE + 1))
            if places.max() >= self.spans - SIDE:
                touched.append((self.spans - 1 - SIDE, self.spans))
        self._update(within(touched, self.spans, self.curve.closed))

    def update_ends(self) -> None:
        """Take over another scheme: only the ends of open polygons depend on it."""
        if not self.curve.closed:
            self.update([0, self.spans])

    def knots(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Points of the polygon that cut some nodes into their children, shape (2, 9, m)."""
        size: int = FAN**level
        places = np.minimum(size * (FAN * nodes + np.arange(FAN + 1)[:, None]), self.spans)
        places += SIDE
        return gathered(self.curve.padded, places)

    def _update(self, touched: Iterable[range]) -> None:
        nodes = _unique([np.arange(r.start // FAN, -(-r.stop // FAN)) for r in touched])
        for begin in range(0, len(nodes), _CHUNK):
            self._write_blocks(nodes[begin : begin + _CHUNK])
        for level in range(1, len(self.boxes) if len(nodes) else 0):
            nodes = _unique([nodes // FAN])
            self._write_nodes(level, nodes)

    def _write_blocks(self, blocks: NDArray[np.intp]) -> None:
        held = self._held(blocks)
        ends = held[:, :, SIDE : SIDE + FAN + 1]
        bends = bends_of(held)
        beyond = self.spans - FAN * int(blocks[-1])
        if beyond < FAN:
            ends[:, -1, beyond:] = ends[:, -1, beyond : beyond + 1]
            bends[:, -1, beyond + 2 * SIDE - 1 :] = 0.0
        self.boxes[0][:, blocks] = boxes_of(ends)
        self.deviations[0][blocks] = from_chords(ends).max(axis=1)
        self.bends[0][:, blocks] = bends.max(axis=2)
        if not self.curve.closed:
            self._widen(0, 0, int(blocks[0]))
            self._widen(-1, -(-self.spans // FAN) - 1, int(blocks[-1]))

    def _held(self, blocks: NDArray[np.intp]) -> NDArray[np.float64]:
        """Points that the spans of some blocks read, shape (2, m, `_READ`).

        In memory the blocks lie along the last axis, where loops are long.
        """
        points = self.curve.padded
        first, last = int(blocks[0]), int(blocks[-1])
        if last - first == len(blocks) - 1 and FAN * last + _READ <= points.shape[1]:
            row, item = points.strides
            shape, strides = (2, _READ, len(blocks)), (row, item, FAN * item)
            windows = np.lib.stride_tricks.as_strided(
                points[:, FAN * first :], shape, strides, writeable=False
            )
            return windows.copy().transpose(0, 2, 1)
        places = FAN * blocks + np.arange(_READ)[:, None]
        return points[:, np.minimum(places, points.shape[1] - 1)].transpose(0, 2, 1)

    def _widen(self, end: int, block: int, written: int) -> None:
        """Let the first or last block cover the end point beside the centre of reflection."""
        if block != written:
            return
        point = self.curve.control_points[end]
        centre = self.curve.padded[:, SIDE + (self.spans if end else 0)]
        self.deviations[0][block] += 2 * float(np.hypot(*(point - centre)))
        box = self.boxes[0][:, block]
        np.minimum(box, np.concatenate([point, -point]), out=box)

    def _write_nodes(self, level: int, nodes: NDArray[np.intp]) -> None:
        children = (FAN * nodes[:, None] + np.arange(FAN)).ravel()
        largest = folded(np.maximum, self.deviations[level - 1][children])
        away = from_chords(self.knots(level, nodes).transpose(0, 2, 1)).max(axis=1)
        self.boxes[level][:, nodes] = folded(np.minimum, self.boxes[level - 1][:, children])
        self.deviations[level][nodes] = largest + away
        self.bends[level][:, nodes] = folded(np.maximum, self.bends[level - 1][:, children])


def _unique(rising: list[NDArray[np.intp]]) -> NDArray[np.intp]:
    """All values of arrays that rise, one after the other, each value once."""
    if not rising:
        return np.zeros(0, dtype=np.intp)
    values = np.concatenate(rising)
    found: NDArray[np.intp] = values[np.append(True, values[1:] > values[:-1])]
    return found


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
    return from_segments(points[..., 1:-1] - points[..., :1], points[..., -1:] - points[..., :1])


def from_segments(
    offsets: NDArray[np.float64], ways: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distances of places from segments, both seen from where the segments start.

    Parameters
    ----------
    offsets
        The places, shape (2, ...); they are overwritten.
    ways
        The ends of the segments, of a shape that broadcasts.
    """
    (x, y), (way_x, way_y) = offsets, ways
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
