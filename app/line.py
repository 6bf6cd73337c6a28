"""A line as it is drawn: in pieces whose cuts stay where they are when a part of it moves.

Definitions
-----------
A *piece* is drawn at once, so it has no seam and covers no pixel twice; it is known by the t of its
first vertex. A *vertex* is known by its piece, its t, its place and breadth, and whether the line
has an end there. A *segment* is common to two lines if in both the same two vertices follow each
other.

Notes
-----
Theorem: outside the padded boxes of the segments that are not common, and of the neighbours of
those, two lines are the same picture, in every bit.

Proof. A broad piece is drawn by filling its outline (`app.outline`), whose part along a segment
depends on that segment and its neighbours. Hence the outlines of two pieces differ by closed loops
within the padded boxes of the segments named. Qt's rasteriser adds up whole numbers, the heights
and areas of edges within pixels, along the row; those of a closed loop that ends before a pixel
cancel exactly. A thin pen draws segment by segment, each by its ends and caps. Common segments lie
in common pieces, in the order of t, and so do the pieces. ∎
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QPolygonF

from app.outline import outline
from app.pixel_box import Box, apart, around, grown, united
from app.polyline import SAFE_PX, polygon_of, thinned, within_square
from core.extreme import largest, same
from core.runs import Runs, counted

WHOLE: Final = 320
"""Number of vertices up to which a run is drawn in one piece, without any seam."""

PIECE: Final = 64
"""Segments of a piece of a longer one, about. Qt looks through what lies in a row of pixels for
each edge that it puts there: a curve of 1,000 vertices takes 4.2 ms at once and 1.0 ms so."""

MOST_IN_PIECE: Final = 256
"""Segments of a piece beyond which it is cut every `PIECE`, counted from its start."""

UNCUT: Final = np.inf
"""Stride of lines that are not cut."""

MOST: Final = 3 / 4
"""Share of a line's vertices from which on all of it is taken as changed, since its box is known;
and share of a piece's that come near a box from which on all of it is painted."""

LONG: Final = 96
"""Number of segments from which on a broad piece is cut to what is seen of it. Qt goes through all
of a path; to find what is near takes as long as it takes Qt for some thirty segments."""

_GAP: Final = 8
"""Number of segments up to which two stretches that are seen are taken as one."""

_BESIDE: Final = 2
"""Vertices on either side of one that differs up to which the outline depends on it."""


@dataclass(eq=False)
class Line:
    """A line in pieces; nothing changes it.

    Attributes
    ----------
    vertices
        In pixels, shape (k, 2), piece after piece; where one goes on in the next, the vertex is in
        both. All x are stored before all y, so that NumPy goes along them and not across.
    t
        Places along the line, shape (k,), rising within a piece and from piece to piece.
    starts
        First vertex of each piece, and k: shape (pieces + 1,).
    halves
        Half of the breadth at each vertex, shape (k,); None of a line as broad as its pen.
    """

    vertices: NDArray[np.float64]
    t: NDArray[np.float64]
    starts: NDArray[np.intp]
    halves: NDArray[np.float64] | None = None

    def pieces(self) -> Iterator[NDArray[np.float64]]:
        """The vertices of each piece."""
        for first, after in pairwise(self.starts.tolist()):
            yield self.vertices[first:after]

    def outline(self, piece: int, half: float) -> NDArray[np.float64]:
        """Outline of a piece (`app.outline`), ``half`` or `halves` on either side of it."""
        part = slice(int(self.starts[piece]), int(self.starts[piece + 1]))
        breadth = half if self.halves is None else self.halves[part]
        return outline(self.vertices[part], breadth, bool(self.loops[piece]))

    def parts(self, piece: int, box: Box, reach: float) -> list[NDArray[np.intp]] | None:
        """Consecutive vertices of the stretches of a piece that come within a reach of a box.

        On either side there is a segment more: where the sides of one end depends on the next. None
        if they are most of the piece, or it is short.
        """
        first, after = int(self.starts[piece]), int(self.starts[piece + 1])
        segments = after - first - 1
        if segments < LONG:
            return None
        places = self.vertices[first:after].T
        corners = np.array(grown(box, reach)).reshape(2, 2, 1)
        # A segment with both ends beyond the same side is out of reach.
        below, above = places < corners[0], places > corners[1]
        beyond = below[:, :-1] & below[:, 1:]
        beyond |= above[:, :-1] & above[:, 1:]
        near = (~(beyond[0] | beyond[1])).nonzero()[0]
        if len(near) >= MOST * segments:
            return None
        if not len(near):
            return []
        gaps = (near[1:] - near[:-1] > _GAP).nonzero()[0]
        firsts = [int(near[0]), *near[gaps + 1].tolist()]
        lasts = [*near[gaps].tolist(), int(near[-1])]
        if not self.loops[piece]:
            return [first + np.arange(max(begin - 1, 0), min(end + 3, segments + 1))
                    for begin, end in zip(firsts, lasts, strict=True)]  # fmt: skip
        if len(firsts) > 1 and firsts[0] + segments - lasts[-1] <= _GAP:
            # Over the seam the last stretch goes on.
            lasts[-1] = lasts.pop(0) + segments
            del firsts[0]
        return [first + np.arange(begin - 1, end + 3) % segments
                for begin, end in zip(firsts, lasts, strict=True)]  # fmt: skip

    def outline_along(self, part: NDArray[np.intp], half: float) -> NDArray[np.float64]:
        """Outline of some consecutive vertices, with ends."""
        breadth = half if self.halves is None else self.halves[part]
        return outline(self.vertices.T.take(part, axis=1).T, breadth, False)

    def polygon(self, piece: int) -> tuple[QPolygonF, bool]:
        """A piece as Qt draws it by a pen, and whether it is a loop; its end is left out then."""
        first, after = int(self.starts[piece]), int(self.starts[piece + 1])
        is_loop = bool(self.loops[piece])
        return polygon_of(self.vertices[first : after - is_loop]), is_loop

    @cached_property
    def box(self) -> Box:
        """Where its middle is."""
        return around(self.vertices, 0.0)

    def near(self, box: Box, reach: float) -> list[int]:
        """Pieces that come within a reach of a box, perhaps."""
        if len(self.starts) == 2:
            return [0]
        low, high = self._corners
        left, top, right, bottom = box
        meets = (low <= (right + reach, bottom + reach)) & (high >= (left - reach, top - reach))
        found: list[int] = np.flatnonzero(meets[:, 0] & meets[:, 1]).tolist()
        return found

    @cached_property
    def _corners(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower and upper corners of the pieces, shapes (pieces, 2)."""
        firsts = self.starts[:-1]
        return (
            np.minimum.reduceat(self.vertices, firsts), np.maximum.reduceat(self.vertices, firsts)
        )  # fmt: skip

    @cached_property
    def loops(self) -> NDArray[np.bool_]:
        """Pieces that end where they start, shape (pieces,)."""
        ends = self._places[self.starts[:-1]], self._places[self.starts[1:] - 1]
        found: NDArray[np.bool_] = ends[0] == ends[1]
        return found

    @cached_property
    def _places(self) -> NDArray[np.complex128]:
        """The vertices as numbers x + i y, shape (k,): equal ones are found at once."""
        places = np.empty(len(self.vertices), dtype=np.complex128)
        places.real, places.imag = self.vertices[:, 0], self.vertices[:, 1]
        return places

    @cached_property
    def _names(self) -> NDArray[np.complex128]:
        """Name of the piece of each vertex, and i where the line has an end there, shape (k,)."""
        starts = self.starts
        names = np.repeat(self.t[starts[:-1]] + 0j, starts[1:] - starts[:-1])
        names.imag[starts[:-1]] = names.imag[starts[1:] - 1] = ~self.loops
        return names

    def unlike(self, other: Line, reach: float, is_thin: bool = False) -> list[Box]:
        """Boxes with a margin outside of which both lines are the same picture, drawn alike.

        Parameters
        ----------
        other
            The other line.
        reach
            The margin.
        is_thin
            Whether a thin pen draws them, to which the neighbours of a segment make no difference.
        """
        beside = 1 if is_thin else _BESIDE
        if same(self.t, other.t) and same(self.starts, other.starts):
            changed = self._changed(other)
            if len(changed) >= MOST * max(len(self.t), 1):
                return [grown(united([self.box, other.box]), reach)]
            changed = changed if is_thin else self._over_seams(changed)
            return apart((self.vertices, other.vertices), changed, beside, reach)
        mine, others = self._alone(other)
        if not is_thin:
            mine, others = self._over_seams(mine), other._over_seams(others)
        return [*apart((self.vertices,), mine, beside, reach),
                *apart((other.vertices,), others, beside, reach)]  # fmt: skip

    def _changed(self, other: Line) -> NDArray[np.intp]:
        """Vertices that differ in lines of the same t and pieces."""
        differ: NDArray[np.bool_] = self._places != other._places
        if self.halves is not None and other.halves is not None:
            differ |= self.halves != other.halves
        changed = differ.nonzero()[0]
        if self._keeps_seam(changed):
            return changed
        opened = self.loops != other.loops
        if opened.any():
            differ[self.starts[:-1][opened]] = differ[self.starts[1:][opened] - 1] = True
            changed = differ.nonzero()[0]
        return changed

    def _keeps_seam(self, changed: NDArray[np.intp]) -> bool:
        """Whether no vertex near the ends of a line in one piece is among some."""
        if not len(changed):
            return True
        last = len(self.t) - 1
        return len(self.starts) == 2 and changed[0] > _BESIDE and changed[-1] < last - _BESIDE

    def _over_seams(self, changed: NDArray[np.intp]) -> NDArray[np.intp]:
        """Vertices, and both ends of each loop that has one near its seam."""
        if self._keeps_seam(changed) or not self.loops.any():
            return changed
        if len(self.starts) == 2:
            parts = [changed]
            if changed[0] > 0:
                parts.insert(0, np.zeros(1, dtype=np.intp))
            if changed[-1] < len(self.t) - 1:
                parts.append(self.starts[1:] - 1)
            return np.concatenate(parts)
        firsts, lasts = self.starts[:-1][self.loops], self.starts[1:][self.loops] - 1
        ends = np.concatenate([firsts, lasts])
        # The first one from two before an end on is at most two behind it.
        near = np.searchsorted(changed, ends - _BESIDE)
        is_near = changed[np.minimum(near, len(changed) - 1)] <= ends + _BESIDE
        is_near &= near < len(changed)
        meets = is_near[: len(firsts)] | is_near[len(firsts) :]
        return np.union1d(changed, np.concatenate([firsts[meets], lasts[meets]]))

    def _alone(self, other: Line) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Vertices of this line that the other one has not, and those that only the other has.

        A few that both have may be among them. If a segment is not common, one of its ends is among
        these vertices, or what the other line has between them.
        """
        sizes = len(self.t), len(other.t)
        count = min(sizes)
        before = _leading(self._alike(slice(count), other, slice(count)))
        left = count - before
        ends = slice(sizes[0] - left, None), slice(sizes[1] - left, None)
        behind = _leading(self._alike(ends[0], other, ends[1])[::-1])
        mine, others = (np.ones(size, dtype=bool) for size in sizes)
        for own, size in ((mine, sizes[0]), (others, sizes[1])):
            own[:before] = own[size - behind :] = False
        # Several parts may differ, such as those on both sides of a seam. A cut vertex is in both
        # pieces; the later one of the two begins a piece.
        inner = np.arange(before, sizes[0] - behind)
        places = np.searchsorted(other.t, self.t[inner], "left")
        begins = self.starts[np.searchsorted(self.starts, inner)] == inner
        places[begins] = np.searchsorted(other.t, self.t[inner[begins]], "right") - 1
        places = np.clip(places, 0, max(sizes[1] - 1, 0))
        if sizes[1] and len(inner):
            alike = self._alike(inner, other, places)
            mine[inner[alike]] = others[places[alike]] = False
        return mine.nonzero()[0], others.nonzero()[0]

    def _alike(
        self, mine: slice | NDArray[np.intp], other: Line, others: slice | NDArray[np.intp]
    ) -> NDArray[np.bool_]:
        """Whether vertices of two lines are the same, in pieces of one name."""
        alike: NDArray[np.bool_] = self.t[mine] == other.t[others]
        alike &= self._places[mine] == other._places[others]
        alike &= self._names[mine] == other._names[others]
        if self.halves is not None and other.halves is not None:
            alike &= self.halves[mine] == other.halves[others]
        return alike


def stride_of(runs: Runs) -> float:
    """Distance in t of the cuts of a line: a power of two, or `UNCUT` where all runs are short.

    Parameters
    ----------
    runs
        The line as it is drawn from nothing; where it changes in parts, the stride is kept.
    """
    if len(runs.parameters) <= WHOLE:
        return UNCUT
    counts = np.diff(runs.starts)
    if counts.max() <= WHOLE:
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
    vertices, t, starts = np.asfortranarray(runs.vertices), runs.parameters, runs.starts
    if period and len(t) and t[0] == 0 and t[-1] == period:
        if len(starts) == 2:
            # The ends agree up to rounding; the pen shall meet itself without a cap.
            if vertices[-1].tolist() != vertices[0].tolist():
                vertices = vertices.copy()
                vertices[-1] = vertices[0]
        else:
            second = int(starts[1])
            vertices = np.concatenate([vertices[second:-1], vertices[:second]])
            t = np.concatenate([t[second:-1], t[:second] + period])
            starts = np.append(starts[1:-1] - second, len(t))
    vertices, t, starts = thinned(vertices, t, starts)
    if len(vertices) and not _is_safe(vertices):
        vertices, t, starts = within_square(vertices, t, starts)
    return _cut(vertices, t, starts, stride)


def ribbon_of(vertices: NDArray[np.float64], halves: NDArray[np.float64]) -> Line:
    """Line of its own breadth through vertices, in one piece, of two vertices or more.

    Parameters
    ----------
    vertices
        In pixels, finite, shape (k, 2).
    halves
        Half of the breadth at each, shape (k,).
    """
    vertices = np.asfortranarray(vertices)
    t, starts = counted(len(vertices))
    if not _is_safe(vertices):
        vertices, seen, starts = within_square(vertices, t, starts)
        t, halves = seen, np.interp(seen, t, halves)
    return Line(vertices, t, starts, halves)


def _cut(
    vertices: NDArray[np.float64], t: NDArray[np.float64], starts: NDArray[np.intp], stride: float
) -> Line:
    """Cut parts into pieces."""
    if stride == UNCUT or not len(t):
        return Line(vertices, t, starts)
    places, times, firsts = _cuts(_Held(t), _Held(starts), stride)
    return Line(vertices.T.take(places, axis=1).T, times, firsts)


class _Held(NamedTuple):
    """An array that is known again by being the same object."""

    array: NDArray[Any]

    def __hash__(self) -> int:
        return id(self.array)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Held) and self.array is other.array


@lru_cache(maxsize=32)
def _cuts(
    held_t: _Held, held_starts: _Held, stride: float
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.intp]]:
    """Vertices of the pieces, their t, and the first of each piece.

    In a drag the t are mostly the same arrays again and again.
    """
    t, starts = held_t.array, held_starts.array
    cells = np.floor(t / stride)
    fresh = np.zeros(len(t) + 1, dtype=bool)
    fresh[1:-1] = cells[1:] != cells[:-1]
    # A piece has a segment at least; those at the starts of runs are cut anyway.
    fresh[starts[1:] - 1] = fresh[starts] = False
    ends = _with(fresh, starts)
    for piece in np.flatnonzero(ends[1:] - ends[:-1] > MOST_IN_PIECE):
        fresh[ends[piece] + PIECE : ends[piece + 1] - 1 : PIECE] = True
    cuts = fresh.nonzero()[0]
    places = np.repeat(np.arange(len(t)), 1 + fresh[:-1])
    first = _with(fresh, starts)
    return places, t[places], first + np.searchsorted(cuts, first, "right")


def _with(chosen: NDArray[np.bool_], more: NDArray[np.intp]) -> NDArray[np.intp]:
    """Indices of what is chosen, and more of them, rising: `numpy.union1d` loads masked arrays."""
    both = chosen.copy()
    both[more] = True
    return both.nonzero()[0]


def _is_safe(vertices: NDArray[np.float64]) -> bool:
    """Whether Qt can hold all vertices, of which there must be one."""
    return bool(largest(np.abs(vertices)) <= SAFE_PX)


def _leading(flags: NDArray[np.bool_]) -> int:
    """Number of leading True."""
    return len(flags) if flags.all() else int(np.argmin(flags))
