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
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.limit import LimitCurve
from core.parallel import each
from core.samples import Samples, Sampling

_BOUND_SHARE: Final = 1 / 3
"""Share of the tolerance that the bound between measured samples takes at most: a chord has two of
their steps then, mostly more."""

_FINER: Final = 2
"""Levels by which the samples that cuts fall on are finer than those that are measured."""

_MEASURED: Final = 2**_FINER
"""One sample in so many is measured."""

_EPS: Final = float(np.finfo(float).eps)

_TINY: Final = 1e-300
"""What is added to a divisor that may be 0, as its dividend is then: 0 remains."""

_AIM: Final = 0.87
"""Share of the admitted deviation that large curves aim at: a chord may bend more than the density
says, and be longer by a sample."""

_FINE_AIMS: Final = (0.98,) * 4 + (0.95,) * 4 + (0.9,) * 4
"""The same in the corrections of the density where samples are few, but many to a chord. The first
is best with a hundred samples to a chord, the last with ten."""

_FEW: Final = 2**15
"""Number of measured samples in a block up to which the density is corrected."""

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
    and one in 2^16 measured samples of a large curve.

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

    def flat(part: tuple[int, int]) -> tuple[NDArray[np.float64], float]:
        samples = sampling.block(*part, finer=_FINER)
        fewest = FEWEST_CLOSED if curve.closed and not samples.first_span else 1
        cuts, deviation = _cuts(_Run(samples), tolerance, fewest)
        return np.stack([samples.x[cuts[:-1]], samples.y[cuts[:-1]]], axis=1), deviation

    found = each(flat, sampling.parts())
    pieces = [points for points, _ in found]
    if not curve.closed:
        pieces.append(curve.control_points[-1:])
    deviation = max(deviation for _, deviation in found)
    return Polyline(np.concatenate(pieces), curve.closed, deviation)


def _cuts(run: _Run, admitted: float, fewest: int) -> tuple[NDArray[np.intp], float]:
    """Indices of the samples that become vertices, first and last included; their deviation."""
    few = len(run.steps) <= _FEW
    fixed = _fixed(run, admitted)
    density = _density(run, admitted * (1.0 if few else _AIM))
    cuts = density.cuts(fixed, fewest)
    deviations = _deviations(run, cuts[:-1], cuts[1:])
    best = _halved(run, cuts, deviations, admitted)
    for aim in _FINE_AIMS if few else ():
        density = density.corrected(cuts, np.sqrt(deviations / (aim * admitted)))
        cuts = density.cuts(fixed, fewest)
        deviations = _deviations(run, cuts[:-1], cuts[1:])
        other = _halved(run, cuts, deviations, admitted)
        if len(other[0]) < len(best[0]):
            best = other
    return best[0], float(best[1].max())


class _Run:
    """Samples of a block: cuts fall on any of them, but few are measured.

    Attributes
    ----------
    last
        Index of the last sample.
    x, y
        Samples that are measured, both ends included, as seen from the first one: distances are
        differences of products, and small numbers keep their digits. Shape (m + 1,).
    step_x, step_y, steps
        From each of them to the next, and how far; shape (m,).
    bounds
        How far the curve may leave the chords of these steps, shape (m,).
    margins
        The larger one of the bounds before and after each measured sample, shape (m + 1,).
    """

    def __init__(self, samples: Samples) -> None:
        self._x, self._y = samples.x, samples.y
        self.last = len(samples.x) - 1
        self.x = samples.x[::_MEASURED] - samples.x[0]
        self.y = samples.y[::_MEASURED] - samples.y[0]
        self.step_x, self.step_y = self.x[1:] - self.x[:-1], self.y[1:] - self.y[:-1]
        self.steps = _lengths(self.step_x, self.step_y)
        self.bounds = np.repeat(samples.bounds, np.diff(samples.starts) // _MEASURED)
        self.margins = np.append(self.bounds, self.bounds[-1])
        np.maximum(self.margins[1:-1], self.bounds[:-1], out=self.margins[1:-1])

    def places(self, samples: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where some of all samples lie, as seen from the first one."""
        return self._x[samples] - self._x[0], self._y[samples] - self._y[0]


@dataclass(frozen=True, eq=False)
class _Density:
    """How many chords a block asks for.

    Attributes
    ----------
    places
        Samples between which the density is constant, rising, with both ends of the block; shape
        (m + 1,).
    shares
        Chords between each two of them, shape (m,).
    """

    places: NDArray[np.float64]
    shares: NDArray[np.float64]

    @cached_property
    def sums(self) -> NDArray[np.float64]:
        """Chords from the start of the block to each of the places."""
        return np.concatenate([[0.0], np.cumsum(self.shares)])

    def cuts(self, fixed: NDArray[np.intp], fewest: int) -> NDArray[np.intp]:
        """Samples that share out what lies between each two fixed ones to whole chords.

        Parameters
        ----------
        fixed
            Samples that become vertices, rising, with both ends.
        fewest
            Number of chords before the second fixed one that there are at least, unless there are
            more sections.
        """
        ends = np.interp(fixed, self.places, self.sums)
        sections = np.diff(ends)
        chords = np.maximum(np.ceil(sections), 1.0).astype(np.intp)
        if len(chords) < fewest:
            chords[0] = max(chords[0], fewest)
        begin = np.cumsum(chords) - chords
        wanted = np.arange(chords.sum()) - np.repeat(begin, chords)
        wanted = wanted * np.repeat(sections / chords, chords)
        wanted += np.repeat(ends[:-1], chords)
        cuts = np.rint(np.interp(wanted, self.sums, self.places)).astype(np.intp)
        cuts[begin] = fixed[:-1]
        # Where nothing is asked for, any place will do, but it has to be in its section; and where
        # there are fewer samples than chords wanted, several meet.
        np.clip(cuts, np.repeat(fixed[:-1], chords), np.repeat(fixed[1:], chords), out=cuts)
        cuts = np.maximum.accumulate(np.append(cuts, fixed[-1]))
        kept: NDArray[np.intp] = cuts[np.concatenate([[True], cuts[1:] > cuts[:-1]])]
        return kept

    def corrected(self, cuts: NDArray[np.intp], wanted: NDArray[np.float64]) -> _Density:
        """The density with which each chord would have had another number of chords."""
        had = np.diff(np.interp(cuts, self.places, self.sums))
        factors = np.divide(wanted, had, out=np.ones_like(had), where=had > 0)
        factors = np.clip(factors, 1 / _LARGEST_CORRECTION, _LARGEST_CORRECTION)
        inside = np.searchsorted(cuts, self.places[:-1], side="right") - 1
        return _Density(self.places, self.shares * factors[inside])


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
    chosen = [_MEASURED * turns[[0, -1]], _MEASURED * turns[1:-1][far[:-1] | far[1:]]]
    for values in (x, y):
        extremes = np.array([values.argmin(), values.argmax()])
        beyond = np.abs(values[[0, -1]][:, None] - values[extremes]).min(axis=0)
        chosen.append(_MEASURED * extremes[beyond > _EXTREME_SHARE * admitted])
    return np.unique(np.concatenate(chosen))


def _density(run: _Run, admitted: float) -> _Density:
    """Number of chords that measured samples ask for; nothing at the first one.

    With steps of length s the cross product of two neighbours is ``k s^3``, hence the formula.
    """
    cross = run.step_x[:-1] * run.step_y[1:]
    cross -= run.step_x[1:] * run.step_y[:-1]
    np.abs(cross, out=cross)
    both = run.steps[:-1] + run.steps[1:]
    # What lies between the samples takes its part of what is admitted.
    both *= 4 * (admitted - run.bounds[1:])
    both += _TINY
    shares = np.zeros(len(run.steps))
    np.divide(cross, both, out=shares[1:])
    places = np.arange(0.0, run.last + 1, _MEASURED)
    return _Density(places, np.sqrt(shares, out=shares))


def _deviations(
    run: _Run, first: NDArray[np.intp], last: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Proven distance of the curve between samples ``first`` and ``last`` from their chord.

    The distance from the line of the chord is measured. A sample that lies s beyond an end of the
    chord makes the way through the samples longer than the chord by 2 s at least, so half of that
    excess bounds s.
    """
    begin, end = -(-first // _MEASURED), -(-last // _MEASURED)
    counts = end - begin
    final = np.maximum(end - 1, 0)
    if not counts.any():
        return 2 * run.bounds[final]
    leader = np.cumsum(counts) - counts
    if (first[1:] == last[:-1]).all():
        x, y = run.places(np.append(first, last[-1]))
        from_x, from_y, to_x, to_y = x[:-1], y[:-1], x[1:], y[1:]
        seen: slice | NDArray[np.intp] = slice(begin[0], end[-1])
    else:
        (from_x, from_y), (to_x, to_y) = run.places(first), run.places(last)
        seen = np.repeat(begin - leader, counts) + np.arange(counts.sum())
    way_x, way_y = to_x - from_x, to_y - from_y
    lengths = _lengths(way_x, way_y)
    scale = 1.0 / (lengths + _TINY)
    normal_x, normal_y = -way_y * scale, way_x * scale
    away = np.repeat(normal_x, counts)
    away *= run.x[seen]
    other = np.repeat(normal_y, counts)
    other *= run.y[seen]
    away += other
    away -= np.repeat(normal_x * from_x + normal_y * from_y, counts)
    np.abs(away, out=away)
    margins = run.margins[seen]
    np.maximum(away, margins, out=away)
    away += margins
    # What ``reduceat`` finds for a chord without measured samples is not used.
    leader = np.minimum(leader, len(away) - 1)
    deviations = np.maximum.reduceat(away, leader)
    # The way leads to the first measured sample, on to the last one, and to the end.
    way = np.add.reduceat(run.steps[seen], leader) - run.steps[final]
    way += _lengths(run.x[begin] - from_x, run.y[begin] - from_y)
    way += _lengths(to_x - run.x[final], to_y - run.y[final])
    way *= 1 + (counts + 4) * _EPS
    deviations += np.maximum(way - lengths, 0.0) / 2
    return np.where(counts == 0, 2 * run.bounds[final], deviations)


def _halved(
    run: _Run,
    cuts: NDArray[np.intp],
    deviations: NDArray[np.float64],
    admitted: float,
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Cuts and deviations when each chord that misses what is admitted is halved until it fits."""
    while True:
        wide = np.flatnonzero((deviations > admitted) & (np.diff(cuts) > 1))
        if not len(wide):
            return cuts, deviations
        first, last = cuts[wide], cuts[wide + 1]
        middle = (first + last) // 2
        begin, end = np.concatenate([first, middle]), np.concatenate([middle, last])
        left, right = np.split(_deviations(run, begin, end), 2)
        deviations = np.insert(deviations, wide, left)
        deviations[wide + 1 + np.arange(len(wide))] = right
        cuts = np.insert(cuts, wide + 1, middle)


def _lengths(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths of vectors. They are neither so long nor so short that squares overflow."""
    squares = x * x
    squares += y * y
    return np.sqrt(squares, out=squares)
