"""A line as it is stroked: in pieces whose cuts stay where they are when a part of it moves.

Definitions
-----------
A *piece* is stroked at once, so it has no seam and covers no pixel twice; it is known by the t of
its first vertex. A *segment* is known by its piece, by t and place of both its ends, and by which
of them has a cap of the pen, where the piece ends. Two lines have a segment in common if both hold
the same one.

Notes
-----
Theorem: outside the padded boxes of the segments that they do not have in common, two lines drawn
with one pen are the same picture, in every bit.

Proof. Qt draws a piece with a wide pen by filling the outline of its pen's way. Each join depends
on the two segments that it joins, each cap on the end of one segment. Hence the outlines of two
pieces differ by closed loops within the padded boxes of the segments that they do not have in
common. Qt's rasteriser adds up whole numbers, the heights and areas of edges within pixels, along
the row; those of a closed loop that ends before a pixel cancel exactly. A thin pen draws segment by
segment, each by its ends and caps. Common segments lie in common pieces, in the order of t, and so
do the pieces. ∎

For the same reason a line is drawn in a region by those of its segments alone whose padded boxes
meet the region, and their neighbours: what is left out is closed by caps that do not reach into it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.polyline import SAFE_PX, thinned, within_square
from core.runs import Runs

WHOLE: Final = 512
"""Number of vertices up to which a run is stroked in one piece, without any seam."""

PIECE: Final = 64
"""Segments of a piece of a longer one, about: a wide pen's cost grows with its outline."""

MOST_IN_PIECE: Final = 256
"""Segments of a piece beyond which it is cut every `PIECE`, counted from its start."""

UNCUT: Final = np.inf
"""Stride of lines that are not cut."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line in pieces.

    Attributes
    ----------
    vertices
        In pixels, shape (k, 2), piece after piece; where one goes on in the next, the vertex is in
        both.
    t
        Places along the line, shape (k,), rising within a piece and from piece to piece.
    starts
        First vertex of each piece, and k: shape (pieces + 1,).
    """

    vertices: NDArray[np.float64]
    t: NDArray[np.float64]
    starts: NDArray[np.intp]

    def pieces(self) -> Iterator[NDArray[np.float64]]:
        """The vertices of each piece."""
        for first, after in zip(self.starts[:-1], self.starts[1:], strict=True):
            yield self.vertices[first:after]

    @cached_property
    def heads(self) -> NDArray[np.intp]:
        """First vertices of the segments, shape (s,); the second ones come next."""
        is_head = np.ones(len(self.vertices), dtype=bool)
        is_head[self.starts[1:] - 1] = False
        return np.flatnonzero(is_head)

    @cached_property
    def boxes(self) -> NDArray[np.float64]:
        """Left, top, right and bottom of each segment, without the pen: shape (4, s)."""
        ends = self.vertices.T[:, self.heads], self.vertices.T[:, self.heads + 1]
        return np.concatenate([np.minimum(*ends), np.maximum(*ends)])

    @cached_property
    def neighbours(self) -> NDArray[np.intp]:
        """Segments before and after each in its piece, or itself where it ends: shape (2, s)."""
        count = len(self.heads)
        found = np.stack([np.arange(-1, count - 1), np.arange(1, count + 1)])
        first, last = self._ends
        loops = (self.vertices[self.starts[:-1]] == self.vertices[self.starts[1:] - 1]).all(axis=1)
        found[0, first] = np.where(loops, last, first)
        found[1, last] = np.where(loops, first, last)
        return found

    @property
    def _ends(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """First and last segment of each piece."""
        ends = self.starts - np.arange(len(self.starts))
        return ends[:-1], ends[1:] - 1

    @cached_property
    def _segments(self) -> NDArray[np.float64]:
        """What a segment is known by: shape (8, s), t of its start first."""
        heads, steps = self.heads, np.diff(self.starts) - 1
        names = np.repeat(self.t[self.starts[:-1]], steps)
        capped = (self.neighbours == np.arange(len(heads))).T @ (1.0, 2.0)
        vertices, t = self.vertices.T, self.t
        ends = *vertices[:, heads], *vertices[:, heads + 1]
        return np.stack([t[heads], t[heads + 1], *ends, names, capped])

    def own(self, other: Line) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Segments of this line that the other one has not, and those that only the other has.

        Returns
        -------
        mine, others
            Shapes (s,) of this line and of the other one.
        """
        mine, others = self._segments, other._segments
        count = min(mine.shape[1], others.shape[1])
        before = _leading((mine[:, :count] == others[:, :count]).all(axis=0))
        left = count - before
        ends = mine[:, mine.shape[1] - left :], others[:, others.shape[1] - left :]
        behind = _leading((ends[0] == ends[1]).all(axis=0)[::-1])
        mine = mine[:, before : mine.shape[1] - behind]
        others = others[:, before : others.shape[1] - behind]
        differ = np.ones(mine.shape[1], dtype=bool), np.ones(others.shape[1], dtype=bool)
        if mine.shape[1] and others.shape[1]:
            # Several parts differ, such as those on both sides of a seam.
            places = np.minimum(np.searchsorted(others[0], mine[0]), others.shape[1] - 1)
            common = (mine == others[:, places]).all(axis=0)
            differ[0][common] = False
            differ[1][places[common]] = False
        same = np.zeros(before, dtype=bool), np.zeros(behind, dtype=bool)
        first, second = (np.concatenate([same[0], part, same[1]]) for part in differ)
        return first, second


def stride_of(runs: Runs) -> float:
    """Distance in t of the cuts of a line: a power of two, or `UNCUT` where all runs are short.

    Parameters
    ----------
    runs
        The line as it is drawn from nothing; where it changes in parts, the stride is kept.
    """
    counts = np.diff(runs.starts)
    if not len(counts) or counts.max() <= WHOLE:
        return UNCUT
    t = runs.parameters
    length = float((t[runs.starts[1:] - 1] - t[runs.starts[:-1]]).sum())
    return float(2.0 ** np.round(np.log2(PIECE * length / counts.sum())))


def line_of(runs: Runs, period: int, stride: float) -> Line:
    """Line through runs of vertices; on a loop of ``period`` spans they go on over the seam.

    Parameters
    ----------
    runs
        Its vertices, in pixels, finite.
    period
        Number of spans of a loop; 0 of an open line.
    stride
        It is cut where ``floor(t / stride)`` grows, so that no cut depends on what is elsewhere.
    """
    vertices, t, starts = runs.vertices, runs.parameters, runs.starts
    if period and len(t) and t[0] == 0 and t[-1] == period:
        if len(starts) == 2:
            # The ends agree up to rounding; the pen shall meet itself without a cap.
            vertices = vertices.copy()
            vertices[-1] = vertices[0]
        else:
            second = int(starts[1])
            vertices = np.concatenate([vertices[second:-1], vertices[:second]])
            t = np.concatenate([t[second:-1], t[:second] + period])
            starts = np.append(starts[1:-1] - second, len(t))
    vertices, t, starts = thinned(vertices, t, starts)
    if len(vertices) and np.abs(vertices).max() > SAFE_PX:
        vertices, t, starts = within_square(vertices, t, starts)
    return _cut(vertices, t, starts, stride)


def _cut(
    vertices: NDArray[np.float64], t: NDArray[np.float64], starts: NDArray[np.intp], stride: float
) -> Line:
    """Cut parts into pieces."""
    if stride == UNCUT or not len(t):
        return Line(vertices, t, starts)
    cells = np.floor(t / stride)
    fresh = np.concatenate([[False], cells[1:] != cells[:-1]])
    # A piece has a segment at least; those at the starts of runs are cut anyway.
    fresh[starts[1:] - 1] = fresh[starts[:-1]] = False
    ends = np.union1d(np.flatnonzero(fresh), starts)
    for piece in np.flatnonzero(np.diff(ends) > MOST_IN_PIECE):
        fresh[ends[piece] + PIECE : ends[piece + 1] - 1 : PIECE] = True
    cuts = np.flatnonzero(fresh)
    places = np.repeat(np.arange(len(t)), 1 + fresh)
    first = np.union1d(cuts, starts)
    return Line(vertices[places], t[places], first + np.searchsorted(cuts, first, "right"))


def _leading(flags: NDArray[np.bool_]) -> int:
    """Number of leading True."""
    return len(flags) if flags.all() else int(np.argmin(flags))
