"""The limit curve as a polyline within a tolerance, with the proven deviation.

Notes
-----
A chord of length h misses a curve of curvature k by ``k h^2 / 8``. So ``sqrt(k / (8 d))`` is the
density of chords, per unit of length, that keeps the deviation d; cutting the curve where the
integral of the density passes whole numbers gives all chords the same deviation, and no other
choice of as many chords does better, as the chords get short (de Boor's equidistribution). What
this leaves over where chords are long is found by measuring: the density within a chord is
corrected by its true deviation, and a chord that still misses the tolerance is halved.

The density is a guess; the proof is apart from it. The curve keeps within b of the steps between
measured samples, at equal shares of both (`core.samples`). So where both ends of a step are within
d of a chord, the curve keeps within d + b of it, since distance from a segment is a convex
function. Where the chord ends within a step, the place on the step at the same share is no further
than b from this end; the curve keeps within max(d, b) + b there. A curve that joins the ends of a
segment and stays within some distance of it covers the segment within this distance too (its
nearest point on the segment moves continuously from end to end), so the one-sided distance bounds
the Hausdorff distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.limit import LimitCurve
from core.parallel import each
from core.samples import Samples, Sampling
from core.segments import Segments

_BOUND_SHARE: Final = 1 / 3
"""Share of the tolerance that the bound between samples takes at most. With a half, a tenth of the
time is saved, but there are curves that take a fifth more chords. Its double is within the
tolerance anyway."""

_FINER: Final = 2
"""Levels by which the places that cuts fall on are finer than the samples, mostly at least."""

_FINE_LEVEL: Final = 10
"""Dyadic level of these places where samples are coarse: there is a table for all coarser ones."""

_FINE_ENOUGH: Final = 128
"""Samples to a chord from which on samples are places enough: finer tables would be made first."""

_EPS: Final = float(np.finfo(float).eps)

_TINY: Final = 1e-300
"""What is added to a divisor that may be 0, as its dividend is then: 0 remains."""

_AIM: Final = 0.9
"""Share of the admitted deviation that large curves aim at: a chord may bend more than the density
says, and be longer by a sample."""

_FINE_AIMS: Final = (0.98,) * 4 + (0.95,) * 4 + (0.9,) * 4
"""The same in the corrections of the density where samples are few, but many to a chord. The first
is best with a hundred samples to a chord, the last with ten."""

_FEW: Final = 2**15
"""Number of samples of a curve up to which the density is corrected so often."""

_MANY: Final = 8
"""Samples to a chord from which on one correction pays in large curves, too: it takes more than a
tenth of chords away that turn far, a percent of others."""

_LARGEST_CORRECTION: Final = 1.5
"""Factor by which a density is changed at most in one correction."""

_EXTREME_SHARE: Final = 1 / 4
"""Share of the admitted deviation by which an extreme has to lie beyond both ends to count, and
the way to or from a turning point has to be longer."""

FEWEST_CLOSED: Final = 3
"""Chords of a closed curve, so that a tolerance beyond its size does not make it a dot."""


@dataclass(frozen=True, eq=False)
class Polyline:
    """A polyline whose vertices lie on the curve.

    Attributes
    ----------
    points
        Vertices, shape (n, 2), in the direction of t; the first is not repeated when closed.
    closed
        Whether the last vertex is joined to the first.
    deviation
        Proven bound of the Hausdorff distance between the polyline and the exact curve, in the
        unit of the points.
    """

    points: NDArray[np.float64]
    closed: bool
    deviation: float


def polyline(curve: LimitCurve, tolerance: float) -> Polyline:
    """Polyline through exact curve points, within ``tolerance`` of the curve.

    Straight runs take one chord, and chords are as long as their places allow, nearly. Vertices
    are always: the curve at t = 0, its extremes in x and y, places where it turns back on itself,
    and one in 2^17 samples of a large curve.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.

    Returns
    -------
    Polyline
        At least two vertices when open and three when closed, unless all samples are at one place.

    Raises
    ------
    NinepointError
        If the tolerance is not positive, or `core.samples.Sampling` refuses.
    """
    if not tolerance > 0:
        raise NinepointError(f"The tolerance must be greater than 0, not {tolerance:g}.")
    if curve.spans == 0:
        return Polyline(curve.control_points, closed=False, deviation=0.0)

    sampling = Sampling(curve, tolerance, _BOUND_SHARE)

    few = sampling.count <= _FEW

    def flat(part: tuple[int, int]) -> tuple[NDArray[np.float64], float]:
        samples = sampling.block(*part)
        fewest = FEWEST_CLOSED if curve.closed and not samples.first_span else 1
        run = _Run(sampling, samples, tolerance if few else _AIM * tolerance)
        cuts = _cuts(run, tolerance, fewest, few)
        return cuts.points[:, :-1].T, max(float(cuts.deviations.max()), 2 * samples.bound)

    found = each(flat, sampling.parts())
    pieces = [points for points, _ in found]
    if not curve.closed:
        pieces.append(curve.control_points[-1:])
    deviation = max(deviation for _, deviation in found)
    return Polyline(np.concatenate(pieces), curve.closed, deviation)


@dataclass(frozen=True, eq=False)
class _Cuts:
    """Where a block is cut into chords.

    Attributes
    ----------
    places
        Ascending, the first and last one included, shape (n + 1,).
    points
        Where the curve is there, shape (2, n + 1).
    deviations
        Proven distances of the curve from the chords between, shape (n,).
    """

    places: NDArray[np.intp]
    points: NDArray[np.float64]
    deviations: NDArray[np.float64]

    def halved(self, run: _Run, admitted: float) -> _Cuts:
        """The same with each chord that misses what is admitted halved until it fits."""
        places, (x, y), deviations = self.places, self.points, self.deviations.copy()
        while True:
            wide = np.flatnonzero(deviations > admitted)
            wide = wide[places[wide + 1] - places[wide] > 1]
            if not len(wide):
                return _Cuts(places, np.stack([x, y]), deviations)
            first, last = places[wide], places[wide + 1]
            middle = (first + last) // 2
            middle_x, middle_y = run.at(middle)
            start = _alternating([x[wide], middle_x], [y[wide], middle_y])
            stop = _alternating([middle_x, x[wide + 1]], [middle_y, y[wide + 1]])
            first, last = _alternating([first, middle], [middle, last])
            found = _deviations(run, first, last, start, stop, admitted)
            deviations[wide] = found[::2]
            count = len(places)
            order = np.insert(np.arange(count), wide + 1, np.arange(count, count + len(wide)))
            places, x, y = (
                _taken(np.concatenate(both), order)
                for both in ((places, middle), (x, middle_x), (y, middle_y))
            )
            # The last place begins no chord.
            deviations = _taken(np.concatenate([deviations, [0.0], found[1::2]]), order[:-1])


def _cuts(run: _Run, admitted: float, fewest: int, few: bool) -> _Cuts:
    """Cuts of a block, few chords that keep within what is admitted."""
    fixed = _fixed(run, admitted)
    density = _Density(run.shares, run.finer)
    many = len(run.steps) > _MANY * density.sums[-1]
    aims = _FINE_AIMS if few else (_AIM,) if many else ()
    asked = 0.0 if aims else admitted
    cuts = run.cut(density.cuts(fixed, fewest), asked)
    best = cuts.halved(run, admitted)
    for aim in aims:
        density = density.corrected(cuts.places, np.sqrt(cuts.deviations / (aim * admitted)))
        cuts = run.cut(density.cuts(fixed, fewest), asked)
        other = cuts.halved(run, admitted)
        if len(other.places) < len(best.places):
            best = other
    return best


class _Run:
    """Samples of a block, which are measured. Cuts fall on places between them, too.

    Attributes
    ----------
    origin
        The first sample, shape (2, 1).
    x, y
        Samples as seen from there: distances are differences of products, and small
        numbers keep their digits. Shape (m + 1,).
    step_x, step_y, steps
        From each of them to the next, and how far; shape (m,).
    shares
        Chords that each step asks for, shape (m,).
    margins
        How far the curve may leave the chords of the steps before and after each sample, shape
        (m + 1,).
    finer
        There are ``2^finer`` places in a step: place ``i 2^finer`` is sample i.
    """

    def __init__(self, sampling: Sampling, samples: Samples, aimed: float) -> None:
        self._sampling, self._samples = sampling, samples
        self.origin = np.array([[samples.x[0]], [samples.y[0]]])
        self.x, self.y = samples.x - samples.x[0], samples.y - samples.y[0]
        self.step_x, self.step_y = self.x[1:] - self.x[:-1], self.y[1:] - self.y[:-1]
        self.steps = _lengths(self.step_x, self.step_y)
        bounds = self._stepwise(samples.bounds)
        self.margins = np.append(bounds, bounds[-1])
        np.maximum(self.margins[1:-1], bounds[:-1], out=self.margins[1:-1])
        self.shares = self._shares(aimed)
        are_enough = len(self.steps) >= _FINE_ENOUGH * self.shares.sum()
        finer = _FINE_LEVEL - int(samples.levels.max())
        self.finer = max(finer, 0 if are_enough else _FINER)

    def _stepwise(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each span for each of its steps."""
        return np.repeat(values, 1 << self._samples.levels)

    def _shares(self, aimed: float) -> NDArray[np.float64]:
        """Chords that steps ask for, nothing at the first one.

        With steps of length s the cross product of two neighbours is ``k s^3``, hence the formula.
        """
        cross = self.step_x[:-1] * self.step_y[1:]
        cross -= self.step_x[1:] * self.step_y[:-1]
        np.abs(cross, out=cross)
        both = self.steps[:-1] + self.steps[1:]
        # What lies between the samples takes its part of what is aimed at.
        both *= self._stepwise(4 * (aimed - self._samples.bounds))[1:]
        both += _TINY
        shares = np.zeros(len(self.steps))
        np.divide(cross, both, out=shares[1:])
        return np.sqrt(shares, out=shares)

    def at(self, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """Where the curve is at places in ascending order, shape (2, k)."""
        return self._sampling.between(self._samples, places, self.finer)

    def cut(self, places: NDArray[np.intp], asked: float) -> _Cuts:
        """The chords between places; `_deviations` tells what is asked."""
        points = self.at(places)
        first, last, start, stop = places[:-1], places[1:], points[:, :-1], points[:, 1:]
        return _Cuts(places, points, _deviations(self, first, last, start, stop, asked))


@dataclass(frozen=True, eq=False)
class _Density:
    """How many chords a block asks for.

    Attributes
    ----------
    shares
        Chords that each step asks for, shape (m,).
    finer
        As in `_Run`.
    """

    shares: NDArray[np.float64]
    finer: int

    @cached_property
    def sums(self) -> NDArray[np.float64]:
        """Chords from the start of the block to each of the samples."""
        sums = np.zeros(len(self.shares) + 1)
        np.cumsum(self.shares, out=sums[1:])
        return sums

    @cached_property
    def places(self) -> NDArray[np.float64]:
        """The places of the samples."""
        return np.arange(0.0, len(self.sums) << self.finer, 1 << self.finer)

    def cuts(self, fixed: NDArray[np.intp], fewest: int) -> NDArray[np.intp]:
        """Places that share out what lies between each two fixed ones to whole chords.

        Parameters
        ----------
        fixed
            Samples that become vertices, rising, with both ends.
        fewest
            Number of chords before the second fixed one that there are at least, unless there are
            more sections.
        """
        ends = self.sums[fixed]
        sections = np.diff(ends)
        chords = np.maximum(np.ceil(sections), 1.0).astype(np.intp)
        if len(chords) < fewest:
            chords[0] = max(chords[0], fewest)
        begin = np.cumsum(chords) - chords
        wanted = np.arange(chords.sum()) - np.repeat(begin, chords)
        wanted = wanted * np.repeat(sections / chords, chords)
        wanted += np.repeat(ends[:-1], chords)
        cuts = np.rint(np.interp(wanted, self.sums, self.places)).astype(np.intp)
        fixed = fixed << self.finer
        cuts[begin] = fixed[:-1]
        # Where nothing is asked for, any place will do, but it has to be in its section; and where
        # there are fewer places than chords wanted, several meet.
        np.clip(cuts, np.repeat(fixed[:-1], chords), np.repeat(fixed[1:], chords), out=cuts)
        cuts = np.maximum.accumulate(np.append(cuts, fixed[-1]))
        kept: NDArray[np.intp] = cuts[np.concatenate([[True], cuts[1:] > cuts[:-1]])]
        return kept

    def corrected(self, cuts: NDArray[np.intp], wanted: NDArray[np.float64]) -> _Density:
        """The density with which each chord would have had another number of chords."""
        had = np.diff(np.interp(cuts, self.places, self.sums))
        factors = np.divide(wanted, had, out=np.ones_like(had), where=had > 0)
        factors = np.clip(factors, 1 / _LARGEST_CORRECTION, _LARGEST_CORRECTION)
        counts = np.diff(-(-cuts >> self.finer))
        return _Density(self.shares * Segments(counts).spread(factors), self.finer)


def _fixed(run: _Run, admitted: float) -> NDArray[np.intp]:
    """Samples that have to be vertices: the ends, where the curve turns back, and its extremes.

    With the extremes the polyline has the size of the curve, not one that is smaller by as much
    as its deviation. Those that the ends nearly reach do not count: a straight line has none.
    """
    x, y, step_x, step_y = run.x, run.y, run.step_x, run.step_y
    along = step_x[:-1] * step_x[1:]
    along += step_y[:-1] * step_y[1:]
    turns = np.concatenate([[0], np.flatnonzero(along < 0) + 1, [len(step_x)]])
    strides = np.hypot(np.diff(x[turns]), np.diff(y[turns]))
    # Rings and rounding about a place where the curve stops turn back a hundred times.
    far = strides > _EXTREME_SHARE * admitted
    chosen = [turns[[0, -1]], turns[1:-1][far[:-1] | far[1:]]]
    for values in (x, y):
        extremes = np.array([values.argmin(), values.argmax()])
        beyond = np.abs(values[[0, -1]][:, None] - values[extremes]).min(axis=0)
        chosen.append(extremes[beyond > _EXTREME_SHARE * admitted])
    return np.unique(np.concatenate(chosen))


def _deviations(
    run: _Run,
    first: NDArray[np.intp],
    last: NDArray[np.intp],
    start: NDArray[np.float64],
    stop: NDArray[np.float64],
    asked: float,
) -> NDArray[np.float64]:
    """Proven bounds of the distance of the curve from chords between places.

    What is within the bound b of a step's end is left out: the curve keeps within 2 b there. The
    distance from the line of the chord is measured. A sample that lies s beyond an end of the chord
    makes the way through the samples longer than the chord by 2 s at least, so half of that excess
    bounds s.

    Parameters
    ----------
    run
        The samples.
    first, last
        Places, ascending; no two chords overlap. Shape (n,).
    start, stop
        Where the curve is there, shape (2, n).
    asked
        Which chords keep within this distance is what is asked: the bounds of those that do may be
        larger than need be, up to this distance. It takes less time than to ask for each bound, 0.
    """
    begin, end = -(-first >> run.finer), -(-last >> run.finer)
    counts = end - begin
    final = np.maximum(end - 1, 0)
    if not counts.any():
        return np.zeros(len(counts))
    samples = Segments(counts)
    if end[-1] - begin[0] == samples.size:
        seen: slice | NDArray[np.intp] = slice(begin[0], end[-1])
    else:
        seen = samples.spread(begin - samples.starts)
        seen += np.arange(samples.size)
    from_x, from_y = start - run.origin
    way_x, way_y = stop - start
    lengths = _lengths(way_x, way_y)
    scale = 1.0 / (lengths + _TINY)
    normal_x, normal_y = -way_y * scale, way_x * scale
    away = samples.spread(normal_x)
    away *= run.x[seen]
    other = samples.spread(normal_y)
    other *= run.y[seen]
    away += other
    away -= samples.spread(normal_x * from_x + normal_y * from_y)
    np.abs(away, out=away)
    away += run.margins[seen]
    # The way leads to the first measured sample, on to the last one, and to the end.
    way = samples.sums(run.steps[seen]) - _taken(run.steps, final)
    way += _lengths(_taken(run.x, begin) - from_x, _taken(run.y, begin) - from_y)
    to_x, to_y = stop - run.origin
    way += _lengths(to_x - _taken(run.x, final), to_y - _taken(run.y, final))
    way *= 1 + (int(counts.max()) + 4) * _EPS
    beyond = np.maximum(way - lengths, 0.0) / 2
    # Only what is larger than this can be too large with what lies beyond the ends.
    large = asked - min(float(beyond.max()), asked / 2)
    return samples.maxima(away, large) + np.where(counts > 0, beyond, 0.0)


def _alternating(*pairs: list[NDArray[Any]]) -> NDArray[Any]:
    """For each pair of arrays a row whose entries are taken of one and the other in turn."""
    return np.stack(pairs).transpose(0, 2, 1).reshape(len(pairs), -1)


def _taken(values: NDArray[Any], indices: NDArray[np.intp]) -> NDArray[Any]:
    """``values[indices]`` for indices that need no check: half of the time."""
    return values.take(indices, mode="clip")


def _lengths(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths of vectors. They are neither so long nor so short that squares overflow."""
    squares = x * x
    squares += y * y
    return np.sqrt(squares, out=squares)
