"""A line as it is stroked: in pieces whose cuts stay where they are when a part of it moves.

Definitions
-----------
A *piece* is stroked at once, so it has no seam and covers no pixel twice; it is known by the t of
its first vertex. A *vertex* is known by its piece, its t, its place, and whether the pen has a cap
there because the piece ends. Two lines have a *segment* in common if in both the same two vertices
follow each other.

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
from PySide6.QtGui import QPolygonF

from app.polyline import SAFE_PX, polygon_of, thinned, within_square
from core.runs import Runs

WHOLE: Final = 512
"""Number of vertices up to which a run is stroked in one piece, without any seam."""

PIECE: Final = 64
"""Segments of a piece of a longer one, about: a wide pen's cost grows with its outline."""

MOST_IN_PIECE: Final = 256
"""Segments of a piece beyond which it is cut every `PIECE`, counted from its start."""

_FEW: Final = 512
"""Vertices from the first to the last that differs, up to which none between are looked at."""

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
    def polygons(self) -> list[tuple[QPolygonF, bool]]:
        """The pieces as Qt draws them, and whether each is a loop; its end is left out then."""
        return [
            (polygon_of(piece[:-1] if is_loop else piece), bool(is_loop))
            for piece, is_loop in zip(self.pieces(), self._loops, strict=True)
        ]

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

    def widened(self, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Chosen segments and their neighbours, those over the seam of a loop too, shape (s,)."""
        wide = chosen.copy()
        wide[1:] |= chosen[:-1]
        wide[:-1] |= chosen[1:]
        for piece in np.flatnonzero(self._loops).tolist():
            first, last = (int(self.starts[k]) - k for k in (piece, piece + 1))
            wide[first] |= chosen[last - 1]
            wide[last - 1] |= chosen[first]
        return wide

    @cached_property
    def _loops(self) -> NDArray[np.bool_]:
        """Pieces that end where they start, shape (pieces,)."""
        ends = self.vertices[self.starts[:-1]], self.vertices[self.starts[1:] - 1]
        found: NDArray[np.bool_] = (ends[0] == ends[1]).all(axis=1)
        return found

    @cached_property
    def _places(self) -> NDArray[np.complex128]:
        """The vertices as numbers x + i y, shape (k,): equal ones are found at once."""
        return np.ascontiguousarray(self.vertices).view(np.complex128)[:, 0]

    @cached_property
    def _names(self) -> NDArray[np.complex128]:
        """Name of the piece of each vertex, and i where the pen has a cap, shape (k,)."""
        starts = self.starts
        names = np.repeat(self.t[starts[:-1]] + 0j, starts[1:] - starts[:-1])
        names.imag[starts[:-1]] = names.imag[starts[1:] - 1] = ~self._loops
        return names

    def own(self, other: Line) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Segments of this line that the other one has not, and those that only the other has.

        A few that both have may be among them.

        Returns
        -------
        mine, others
            Shapes (s,) of this line and of the other one.
        """
        sizes = len(self.t), len(other.t)
        count = min(sizes)
        before = _leading(self._alike(slice(count), other, slice(count)))
        left = count - before
        ends = slice(sizes[0] - left, None), slice(sizes[1] - left, None)
        behind = _leading(self._alike(ends[0], other, ends[1])[::-1])
        # Where both ends differ the seam of a loop is among what moves, and its middle stays.
        if count - before - behind <= _FEW and (before or behind or not count):
            mine, others = (
                (line.heads >= before - 1) & (line.heads < size - behind)
                for line, size in zip((self, other), sizes, strict=True)
            )
            return mine, others
        # Which vertex of the other line each one is, or -1.
        partner = np.arange(sizes[0]), np.arange(sizes[1])
        partner[0][sizes[0] - behind :] += sizes[1] - sizes[0]
        partner[1][sizes[1] - behind :] += sizes[0] - sizes[1]
        for partners, size in zip(partner, sizes, strict=True):
            partners[before : size - behind] = -1
        # Several parts may differ, such as those on both sides of a seam. A cut vertex is in both
        # pieces; the later one of the two begins a piece.
        inner = np.arange(before, sizes[0] - behind)
        places = np.searchsorted(other.t, self.t[inner], "left")
        begins = self.starts[np.searchsorted(self.starts, inner)] == inner
        places[begins] = np.searchsorted(other.t, self.t[inner[begins]], "right") - 1
        places = np.minimum(places, sizes[1] - 1)
        alike = self._alike(inner, other, places)
        partner[0][inner[alike]] = places[alike]
        partner[1][places[alike]] = inner[alike]
        mine, others = (
            (partners[line.heads] < 0) | (partners[line.heads + 1] != partners[line.heads] + 1)
            for partners, line in zip(partner, (self, other), strict=True)
        )
        return mine, others

    def _alike(
        self, mine: slice | NDArray[np.intp], other: Line, others: slice | NDArray[np.intp]
    ) -> NDArray[np.bool_]:
        """Whether vertices of two lines are the same, in pieces of one name."""
        alike: NDArray[np.bool_] = self.t[mine] == other.t[others]
        alike &= self._places[mine] == other._places[others]
        alike &= self._names[mine] == other._names[others]
        return alike


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
