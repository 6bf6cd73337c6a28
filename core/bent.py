"""Stretches of a smooth curve known by C'': they are cut without samples between the cuts.

Notes
-----
Let n be the unit normal of the chord from ``C(t0)`` to ``C(t1)``, h = t1 - t0. The distance from
its line, ``e(t) = n . (C(t) - C(t0))``, vanishes at both ends. So ``|e| <= (h^2 / 8) max |f|``,
f = e''; and where f is linear, from A to B, e is at ``t0 + tau h``

    ``-(h^2 / 2) tau (1 - tau) ((A + B) / 2 + (2 tau - 1) (B - A) / 6)``,

at most ``(h^2 / 8) (|A + B| / 2 + s |B - A|)``, ``s = 1 / (9 sqrt(3))`` being the largest value of
``4 tau (1 - tau) (2 tau - 1) / 6``.

C'' is the curve of the scheme ``4 a(z) / (1+z)^2`` on second differences (theory, section 6), and
leaves the chords between its knots, ``2^level`` in a span, by no more than r, by the bound of
`core.chords` for that scheme. Between ``t0`` and ``t1`` the polygon of its knots, taken in the
direction of n, leaves the line from A to B most at a knot, by k. At the only knot between, u after
t0 and v before t1, this is ``u v / (u + v)`` times the turn of the polygon there. So the curve
keeps within

    ``(h^2 / 8) (|A + B| / 2 + s |B - A| + k + r)``

of the line of the chord; and of the chord itself, if it goes forward along it all the way. With m
the largest ``|C''|``, it does where ``h^2 m / 2 <= |C(t1) - C(t0)|``, for the speed along the chord
leaves its mean by ``h m / 2`` at most. In any case ``h^2 m / 8`` bounds the distance of the curve
from the place on the chord at the same share. As in `core.measured`, these bound the Hausdorff
distance.

Where this is more than what is admitted, or the curve may go back, the chord is measured: between j
samples, evenly in t, the curve keeps to their polygon within ``(h / j)^2 m / 8``. These are few.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log2, sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.chords import ROUNDING, chord_constant, size_constant
from core.density import Density
from core.errors import NoLimitError
from core.limit import LimitCurve
from core.measured import EXTREME_SHARE
from core.segments import Segments
from core.stretch import Part
from core.vectors import lengths, taken
from core.windows import maxima_between, product, running_max, windows_of

_SMOOTH: Final = 4
"""Factors ``1 + z`` of a mask that second differences of C'' ask for."""


@dataclass(frozen=True)
class _Pains:
    """How much is done to save a chord.

    Attributes
    ----------
    levels
        Dyadic levels at which C'' may be known, tried in turn,
    rest
        until what it does between its knots is this share of second differences, both in the mean.
    places
        Places in the shortest chord, at least, for cuts to fall on; if there is a table so fine.
    aim
        Share of the admitted deviation that the density aims at.
    corrections
        The same for each correction of the density.
    unseen
        Share of the admitted deviation that samples leave unseen, where a chord is measured.
    """

    levels: tuple[int, ...]
    rest: float
    places: int
    aim: float
    corrections: tuple[float, ...]
    unseen: float


_CORRECTIONS: Final = (0.995,) * 4 + (0.98,) * 4 + (0.95,) * 2

_ALL: Final = _Pains((3, 4, 5, 6, 7), 1 / 100, 256, 1.0, _CORRECTIONS, 1 / 16)
"""Where there is little to cut."""

_SOME: Final = _Pains((3, 4, 5), 1 / 10, 16, 0.88, (), 1 / 8)
"""Where there is much. Aiming at 0.93 takes 2.5 % of the chords away, and a fifth more time."""

_FEW: Final = 2**13
"""Number of chords that is little to cut."""

_FEWEST: Final = 0.5
"""Mean number of chords in a span from which on less time is taken, and fewer chords are needed,
than if all is measured."""

_FEWEST_OF_MANY: Final = 2.0
"""The same where there is much to cut."""

_LARGEST_REST: Final = 1 / 10
"""Largest share that C'' may take between its knots: chords get shorter by half of it, or less."""

_LARGEST_ROUNDING: Final = 1 / 16
"""Share of the tolerance that the rounding of points may take."""

_PLACE_LEVELS: Final = (10, 14)
"""Least and greatest dyadic level of the places. There is a table for the least one."""

_STEPS: Final = 8
"""Steps of the density in a chord where it is corrected, at least."""

_BLOCK: Final = 2**17
"""Number of chords that are made at a time."""

_MOST_KNOTS: Final = 2**19
"""Number of knots that are held at a time."""

_MOST_SAMPLES: Final = 2**18
"""Number of such samples that are held at a time."""

_SKEW: Final = 1 / (9 * sqrt(3))
"""The constant s of the notes."""

_EPS: Final = float(np.finfo(float).eps)

_TINY: Final = 1e-300
"""What is added to a divisor that may be 0, as its dividend is then: 0 remains."""


class Bending:
    """A `core.stretch.Course` of stretches that are known by C''; `of` makes it.

    Attributes
    ----------
    curve
        The limit curve.
    tolerance
        Admitted deviation.
    level
        Dyadic level of the knots of C''.
    place_level
        Dyadic level of the places.
    rests
        Proven bounds of the distance of C'' from the chords between its knots, one for each span.
    rounding
        Bound of the rounding of a distance.
    aim, corrections, unseen
        Shares of the tolerance: what densities aim at, and what samples leave out.
    """

    def __init__(
        self,
        curve: LimitCurve,
        tolerance: float,
        pains: _Pains,
        level: int,
        rests: NDArray[np.float64],
        shortest: float,
    ) -> None:
        self.curve, self.tolerance, self.level, self.rests = curve, tolerance, level, rests
        self.aim, self.corrections, self.unseen = pains.aim, pains.corrections, pains.unseen
        least, greatest = _PLACE_LEVELS
        self.place_level = min(max(ceil(log2(pains.places / shortest)), least), greatest)
        self.rounding = _rounding(curve)
        steps = np.diff(curve.endless_points.T)
        bends = np.diff(steps)
        self._slope = _Derivative(curve, steps, 1)
        self._bend = _Derivative(curve, bends, 2)
        middle = (bends.shape[1] - curve.spans) // 2
        self._chords = np.hypot(*bends[:, middle : middle + curve.spans])
        self._chords /= 8 * tolerance
        np.sqrt(self._chords, out=self._chords)

    @classmethod
    def of(cls, curve: LimitCurve, tolerance: float) -> Bending | None:
        """The course, or none where C'' is not known well enough, or chords are long.

        Parameters
        ----------
        curve
            The limit curve; at least one span.
        tolerance
            Admitted deviation, > 0, in the unit of the control points.
        """
        rounding = _rounding(curve)
        if rounding > _LARGEST_ROUNDING * tolerance or curve.mask.factored()[0] < _SMOOTH:
            return None
        bends = np.diff(curve.endless_points.T, 2)
        sizes = np.hypot(*bends)
        chords = float(np.sqrt(sizes).mean()) / sqrt(8 * tolerance)
        few = chords * curve.spans <= _FEW
        if chords < (_FEWEST if few else _FEWEST_OF_MANY):
            return None
        pains = _ALL if few else _SOME
        scheme = BasicLimitFunction(curve.mask).derived(2).mask
        reads = scheme.end - scheme.start - 1
        largest = running_max(np.hypot(*np.diff(bends, 2)), reads)[: curve.spans]
        try:
            shortest = sqrt(8 * tolerance / (size_constant(scheme) * float(sizes.max())))
            for level in pains.levels:
                rests = chord_constant(scheme, level) * largest
                if rests.mean() <= pains.rest * sizes.mean():
                    break
        except NoLimitError:  # C'' is not continuous, or not seen to be
            return None
        if rests.mean() > _LARGEST_REST * sizes.mean():
            return None
        if _SOME.places / shortest > 2 ** _PLACE_LEVELS[1]:
            return None
        # A value of C'' is off by this much, being a combination of rounded differences.
        rests += rounding + 64 * _EPS * sizes.max()
        return cls(curve, tolerance, pains, level, rests, shortest)

    def parts(self) -> list[Part]:
        """Runs of spans with so many chords, or knots, as are held at a time."""
        loads = np.maximum(self._chords / _BLOCK, 2**self.level / _MOST_KNOTS)
        total = np.cumsum(loads)
        ends = np.searchsorted(total, np.arange(1, ceil(total[-1])))
        return list(pairwise(np.unique([0, *ends, len(loads)]).tolist()))

    def stretch(self, part: Part) -> BentStretch:
        """One of the parts."""
        slopes, bends = (d.at_knots(part, self.level) for d in (self._slope, self._bend))
        return BentStretch(self, part, slopes, bends)


class _Derivative:
    """A derivative of a curve.

    Parameters
    ----------
    curve
        The curve.
    differences
        Those of its control points of the same order, coordinates apart, shape (2, m).
    order
        Which one.
    """

    def __init__(self, curve: LimitCurve, differences: NDArray[np.float64], order: int) -> None:
        self._basis = BasicLimitFunction(curve.mask, is_exact=True).derived(order)
        scheme = self._basis.mask
        self._windows = windows_of(differences, scheme.end - scheme.start + 1, curve.spans)

    def at_knots(self, part: Part, level: int) -> NDArray[np.float64]:
        """Values at the knots of some spans, shape (2, n + 1)."""
        begin, end = part
        table = self._basis.span_table(level)
        values = np.empty((2, ((end - begin) << level) + 1))
        runs = values[:, :-1].reshape(2, end - begin, -1)
        product(self._windows[:, :, begin:end], table[:, :-1], runs)
        values[:, -1] = product(self._windows[:, :, end - 1 : end], table[:, -1:])[:, 0, 0]
        return values


def _rounding(curve: LimitCurve) -> float:
    """Rounding of distances, as in `core.samples`."""
    return 32 * _EPS * float(np.abs(curve.endless_points).max())


class BentStretch:
    """A `core.stretch.Stretch` of which C' and C'' are known at knots.

    Parameters
    ----------
    bending
        The course.
    part
        The spans.
    slopes, bends
        C' and C'' at the knots, shape (2, n + 1).
    """

    floor = 0.0

    def __init__(
        self,
        bending: Bending,
        part: Part,
        slopes: NDArray[np.float64],
        bends: NDArray[np.float64],
    ) -> None:
        self._bending, self._slopes, self._bends = bending, slopes, bends
        self.aims = bending.corrections
        self._begin, self._end = part
        self._finer = bending.place_level - bending.level
        self._last = (self._end - self._begin) << bending.place_level
        self._rests = bending.rests[slice(*part)]
        self._kinks = np.pad(np.diff(bends, 2), ((0, 0), (1, 1)))
        sizes = lengths(*bends)
        largest = np.maximum(sizes[:-1], sizes[1:])
        for _ in range(bending.level):
            largest = np.maximum(largest[::2], largest[1::2])
        self._largest = np.stack([self._rests, largest + self._rests])

    def density(self) -> Density:
        """Of the bend at the knots, and as if its root changed evenly between them."""
        (slope_x, slope_y), (bend_x, bend_y) = self._slopes, self._bends
        bend = slope_x * bend_y
        bend -= slope_y * bend_x
        np.abs(bend, out=bend)
        bend /= lengths(slope_x, slope_y) + _TINY
        level = self._bending.level
        if not self.aims:
            # What C'' may do between knots asks for chords, too, if nothing is corrected.
            bend[:-1] += np.repeat(self._rests, 1 << level)
            bend[-1] += self._rests[-1]
        bend /= 8 * self._bending.aim * self._bending.tolerance * 4.0**level
        chords = np.sqrt(bend, out=bend)
        parts = 1
        if self.aims:
            # Corrections need steps that are shorter than chords.
            wanted = ceil(log2(_STEPS * max(float(chords.max()), 1 / _STEPS)))
            parts = min(max(wanted, 1), self._finer)
        places = (np.arange(2**parts)[:, None] + 0.5) / 2**parts
        rises = np.diff(chords)
        shares = rises * places
        shares += chords[:-1]
        if not self.aims:
            # Over a chord on which the density w rises by d, the mean of w^2 is w^2 + (d / 2)^2,
            # d = w' / w; where w is nearly 0, it rises until a chord ends, by the root of w'.
            np.abs(rises, out=rises)
            rises /= 4
            shares *= shares
            shares += rises * rises * 4 / (shares + rises + _TINY)
            np.sqrt(shares, out=shares)
        shares /= 2**parts
        return Density(shares.T.ravel(), self._finer - parts)

    def fixed(self) -> NDArray[np.intp]:
        """The ends, where the curve turns back, and its extremes; see `core.stretch.Stretch`.

        Which extreme is the largest is seen at the knots.
        """
        chosen = [np.array([0, self._last]), self._turns()]
        ends = self.at(chosen[0])
        curve, level = self._bending.curve, self._bending.level
        knots = curve.span_starts(slice(self._begin, self._end), level)
        width = 1 << self._finer
        for values, (first, last), axis in zip(knots.reshape(2, -1), ends, (0, 1), strict=True):
            for find in (np.argmin, np.argmax):
                near = int(find(values)) * width
                places = np.arange(max(near - width, 0), min(near + width, self._last) + 1)
                found = self.at(places)[axis]
                best = int(find(found))
                beyond = min(abs(found[best] - first), abs(found[best] - last))
                if beyond > EXTREME_SHARE * self._bending.tolerance:
                    chosen.append(places[best : best + 1])
        return np.unique(np.concatenate(chosen))

    def _turns(self) -> NDArray[np.intp]:
        """Places where the curve turns back on itself, further than can be left out."""
        slope_x, slope_y = self._slopes
        along = slope_x[:-1] * slope_x[1:]
        along += slope_y[:-1] * slope_y[1:]
        steps = np.flatnonzero(along < 0)
        before, after = (lengths(*self._slopes[:, steps + ahead]) for ahead in (0, 1))
        least = EXTREME_SHARE * self._bending.tolerance * 2.0**self._bending.level
        shares = steps + before / (before + after + _TINY)
        turns: NDArray[np.intp] = np.rint(shares * 2.0**self._finer).astype(np.intp)
        return turns[before + after > least]

    def at(self, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """Where the curve is; see `core.stretch.Stretch`."""
        curve, level = self._bending.curve, self._bending.place_level
        spans = places >> level
        # The end of the last span is a part of it.
        np.minimum(spans, self._end - self._begin - 1, out=spans)
        shares = places - (spans << level)
        spans += self._begin
        points = curve.scattered_points(spans, shares, level)
        if not curve.closed and len(places):
            # The end rules hold up to rounding; a contour has to end exactly where it was told to.
            if self._begin == 0 and places[0] == 0:
                points[:, 0] = curve.control_points[0]
            if self._end == curve.spans and places[-1] == self._last:
                points[:, -1] = curve.control_points[-1]
        return points

    def deviations(
        self,
        first: NDArray[np.intp],
        last: NDArray[np.intp],
        start: NDArray[np.float64],
        stop: NDArray[np.float64],
        asked: float,  # noqa: ARG002 - each bound takes as long as the answer that is asked for
    ) -> NDArray[np.float64]:
        """Proven bounds, by the notes of this module; see `core.stretch.Stretch`."""
        way = stop - start
        chords = lengths(*way)
        bounds = self._off_lines(first, last, way)
        bounds /= chords + _TINY
        level = self._bending.place_level
        rests, sizes = maxima_between(self._largest, first >> level, (last - 1) >> level)
        bounds += rests
        apart = (last - first).astype(np.float64)
        apart *= apart
        apart *= ROUNDING / 8 * 0.25**level
        bounds *= apart
        apart *= sizes
        np.minimum(bounds, apart, out=bounds)
        chords /= 4
        unsure = apart > chords
        np.copyto(bounds, apart, where=unsure)
        unsure |= bounds > self._bending.tolerance
        some = np.flatnonzero(unsure)
        if len(some):
            measured = self._measured(
                first[some], last[some], start[:, some], way[:, some], apart[some]
            )
            bounds[some] = np.minimum(bounds[some], measured)
        bounds += self._bending.rounding
        return bounds

    def _off_lines(
        self, first: NDArray[np.intp], last: NDArray[np.intp], way: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """``|A + B| / 2 + s |B - A| + k``, each times the length of the chord, shape (n,)."""
        finer, (way_x, way_y) = self._finer, way
        before = self._bends_at(first)
        off: NDArray[np.float64]
        if (first[1:] == last[:-1]).all():
            after = np.concatenate([before[:, 1:], self._bends_at(last[-1:])], axis=1)
        else:
            after = self._bends_at(last)
        start, stop = (way_x * y - way_y * x for x, y in (before, after))
        off = start + stop
        np.abs(off, out=off)
        off *= 0.5
        rise = stop - start
        off += _SKEW * np.abs(rise)
        # At a knot that is the only one between, the polygon turns by its second difference.
        knots = first >> finer
        knots += 1
        counts = last - 1
        counts >>= finer
        counts -= knots
        kinks = way_x * taken(self._kinks[1], knots)
        kinks -= way_y * taken(self._kinks[0], knots)
        np.abs(kinks, out=kinks)
        knots <<= finer
        kinks *= knots - first
        after = last - knots
        # None is between: it is the end, or beyond it.
        np.maximum(after, 0, out=after)
        kinks *= after
        kinks /= (last - first) << finer
        several = np.flatnonzero(counts > 0)
        if len(several):
            kinks[several] = self._most_kinked(
                first[several],
                last[several],
                way[:, several],
                start[several],
                rise[several],
            )
        off += kinks
        return off

    def _most_kinked(
        self,
        first: NDArray[np.intp],
        last: NDArray[np.intp],
        way: NDArray[np.float64],
        start: NDArray[np.float64],
        rise: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """``k`` times the length of the chord, where knots are between; B - A is ``rise``."""
        finer, (bend_x, bend_y), (way_x, way_y) = self._finer, self._bends, way
        begin = (first >> finer) + 1
        knots = Segments(((last - 1) >> finer) + 1 - begin)
        seen = knots.spread(begin - knots.starts)
        seen += np.arange(knots.size)
        kinks = knots.spread(way_x)
        kinks *= taken(bend_y, seen)
        other = knots.spread(way_y)
        other *= taken(bend_x, seen)
        kinks -= other
        steady = rise / (last - first)
        kinks -= knots.spread(start - steady * first)
        seen <<= finer
        other = knots.spread(steady)
        other *= seen
        kinks -= other
        np.abs(kinks, out=kinks)
        return knots.maxima(kinks)

    def _bends_at(self, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """The polygon of C'' at places, shape (2, k)."""
        steps = np.minimum(places >> self._finer, self._bends.shape[1] - 2)
        shares = (places - (steps << self._finer)) * 0.5**self._finer
        steps_after = steps + 1
        found = np.empty((2, len(places)))
        for values, out in zip(self._bends, found, strict=True):
            values.take(steps, out=out, mode="clip")
            rises = taken(values, steps_after)
            rises -= out
            rises *= shares
            out += rises
        return found

    def _measured(
        self,
        first: NDArray[np.intp],
        last: NDArray[np.intp],
        start: NDArray[np.float64],
        way: NDArray[np.float64],
        apart: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Bounds by samples.

        Parameters
        ----------
        first, last, start, way
            The chords.
        apart
            How far the curve may be from the place on the chord at the same share, shape (k,).
            Between the ends of a j-th part of it, it keeps to their chord within a j^2-th of this.
        """
        width = last - first
        steps = np.ceil(np.sqrt(apart / (self._bending.unseen * self._bending.tolerance)))
        steps = np.minimum(np.minimum(steps, width), _MOST_SAMPLES // len(steps))
        samples = Segments(np.maximum(steps, 1.0).astype(np.intp))
        places = np.arange(samples.size) - samples.spread(samples.starts)
        places *= samples.spread(width)
        places //= samples.spread(samples.counts)
        places += samples.spread(first)
        way_x, way_y = samples.spread(way[0]), samples.spread(way[1])
        x, y = self.at(places)
        x -= samples.spread(start[0])
        y -= samples.spread(start[1])
        shares = x * way_x
        shares += y * way_y
        shares /= way_x * way_x + way_y * way_y + _TINY
        np.clip(shares, 0.0, 1.0, out=shares)
        x -= shares * way_x
        y -= shares * way_y
        # Parts differ by a place where their number does not divide that of the places.
        gaps = -(-width // samples.counts) / width
        found: NDArray[np.float64] = samples.maxima(lengths(x, y)) + apart * gaps * gaps
        return found
