"""The limit curve as a polyline within a tolerance, with the proven deviation.

Notes
-----
A chord of length h misses a curve of curvature k by ``k h^2 / 8``. So ``sqrt(k / (8 d))`` is the
density of chords, per unit of length, that keeps the deviation d; cutting the curve where the
integral of the density passes whole numbers gives all chords the same deviation, and no other
choice of as many chords does better, as the chords get short (de Boor's equidistribution). What
this leaves over where chords are long is found by measuring: the density within a chord is
corrected by its true deviation, and a chord that still misses the tolerance is halved.

The density is a guess; the proof is apart from it. All samples between the ends of a chord are
measured. Their polygon keeps to what its vertices keep to, since distance from a segment is a
convex function, and the curve keeps to its polygon by `core.samples`. A curve that joins the ends
of a segment and stays within d of it covers the segment within d too (its nearest point on the
segment moves continuously from end to end), so this one-sided distance bounds the Hausdorff
distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.limit import LimitCurve
from core.samples import Sampling

_BOUND_SHARE: Final = 1 / 8
"""Share of the tolerance that the bound between the samples should take: some five samples or
more to a chord."""

_EPS: Final = float(np.finfo(float).eps)

_MARGIN: Final = 1e-6
"""Part of a chord by which sums of densities keep off the whole number at the end of a section,
where there is a cut anyway: more than their rounding."""

_AIM: Final = 0.9
"""Share of the admitted deviation that large curves aim at: cuts fall on samples, which makes a
chord longer than wanted by a tenth now and then."""


_FINE_AIMS: Final = (0.98,) * 4 + (0.95,) * 4 + (0.9,) * 4
"""The same in the corrections of the density where samples are few, but many to a chord. The first
is best with a hundred samples to a chord, the last with ten."""

_FEW: Final = 2**15
"""Number of samples in a block up to which the density is corrected."""

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
    and one in 2^16 samples of a large curve.

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
    pieces: list[NDArray[np.float64]] = []
    deviation = 0.0
    for samples in Sampling(curve, tolerance, _BOUND_SHARE).blocks():
        fewest = FEWEST_CLOSED if curve.closed and not pieces else 1
        cuts, found = _cuts(samples.x, samples.y, tolerance - samples.bound, fewest)
        deviation = max(deviation, found + samples.bound)
        pieces.append(np.stack([samples.x[cuts[:-1]], samples.y[cuts[:-1]]], axis=1))
    if not curve.closed:
        pieces.append(curve.control_points[-1:])
    return Polyline(np.concatenate(pieces), curve.closed, deviation)


def _cuts(
    x: NDArray[np.float64], y: NDArray[np.float64], admitted: float, fewest: int
) -> tuple[NDArray[np.intp], float]:
    """Indices of the samples that become vertices, first and last included; their deviation."""
    # Distances are differences of products: small numbers keep their digits.
    x, y = x - x[0], y - y[0]
    step_x, step_y = np.diff(x), np.diff(y)
    steps = np.sqrt(step_x * step_x + step_y * step_y)
    few = len(steps) <= _FEW
    fixed = _fixed(x, y, step_x, step_y, admitted)
    density = _density(step_x, step_y, steps, admitted * (1.0 if few else _AIM))
    cuts = _equidistributed(density, fixed, fewest)
    deviations = _deviations(x, y, steps, cuts[:-1], cuts[1:])
    best = _halved(x, y, steps, cuts, deviations, admitted)
    for aim in _FINE_AIMS if few else ():
        wanted = np.sqrt(deviations / (aim * admitted))
        had = np.add.reduceat(density, cuts[:-1])
        factors = np.divide(wanted, had, out=np.ones_like(had), where=had > 0)
        factors = np.clip(factors, 1 / _LARGEST_CORRECTION, _LARGEST_CORRECTION)
        density = density * np.repeat(factors, np.diff(cuts))
        cuts = _equidistributed(density, fixed, fewest)
        deviations = _deviations(x, y, steps, cuts[:-1], cuts[1:])
        other = _halved(x, y, steps, cuts, deviations, admitted)
        if len(other[0]) < len(best[0]):
            best = other
    return best[0], float(best[1].max())


def _fixed(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    step_x: NDArray[np.float64],
    step_y: NDArray[np.float64],
    admitted: float,
) -> NDArray[np.intp]:
    """Samples that have to be vertices: the ends, where the curve turns back, and its extremes.

    With the extremes the polyline has the size of the curve, not one that is smaller by as much
    as its deviation. Those that the ends nearly reach do not count: a straight line has none.
    """
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


def _density(
    step_x: NDArray[np.float64],
    step_y: NDArray[np.float64],
    steps: NDArray[np.float64],
    admitted: float,
) -> NDArray[np.float64]:
    """Number of chords that each sample asks for, shape of the steps; nothing at the first one.

    With steps of length s the cross product of two neighbours is ``k s^3``, hence the formula.
    """
    cross = step_x[:-1] * step_y[1:]
    cross -= step_x[1:] * step_y[:-1]
    np.abs(cross, out=cross)
    both = steps[:-1] + steps[1:]
    both *= 4 * admitted
    density = np.zeros_like(steps)
    np.divide(cross, both, out=density[1:], where=both > 0)
    np.sqrt(density, out=density)
    return density


def _equidistributed(
    density: NDArray[np.float64], fixed: NDArray[np.intp], fewest: int
) -> NDArray[np.intp]:
    """Cuts that share out the density between each two fixed ones to a whole number of chords."""
    sums = np.cumsum(density)
    ends = np.concatenate([[0.0], sums[fixed[1:] - 1]])
    sections = np.diff(ends)
    chords = np.maximum(np.ceil(sections), 1.0)
    if len(chords) < fewest:
        chords[0] = max(chords[0], fewest)
    scale = np.zeros_like(sections)
    np.divide(chords - _MARGIN, sections, out=scale, where=sections > 0)
    counts = np.diff(fixed)
    begin = np.cumsum(chords) - chords
    sums *= np.repeat(scale, counts)
    sums += np.repeat(begin - ends[:-1] * scale + _MARGIN / 2, counts)
    passed = sums.astype(np.intp)
    inner = np.flatnonzero(passed[1:] != passed[:-1]) + 1
    return np.concatenate([[0], inner, [len(density)]])


def _deviations(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    steps: NDArray[np.float64],
    first: NDArray[np.intp],
    last: NDArray[np.intp],
) -> NDArray[np.float64]:
    """Proven distance of the samples ``first .. last`` from the chord between them, for each pair.

    The distance from the line of the chord is measured. A sample that lies s beyond an end of the
    chord makes the way through the samples longer than the chord by 2 s at least, so half of that
    excess bounds s.
    """
    counts = last - first
    begin = np.cumsum(counts) - counts
    whole = bool((first[1:] == last[:-1]).all())
    if whole:
        inner_x, inner_y = x[first[0] : last[-1]], y[first[0] : last[-1]]
        inner_steps = steps[first[0] : last[-1]]
    else:
        places = np.repeat(first - begin, counts) + np.arange(counts.sum())
        inner_x, inner_y, inner_steps = x[places], y[places], steps[places]
    chord_x, chord_y = x[last] - x[first], y[last] - y[first]
    lengths = np.sqrt(chord_x * chord_x + chord_y * chord_y)
    scale = np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0)
    normal_x, normal_y = -chord_y * scale, chord_x * scale
    offset = normal_x * x[first] + normal_y * y[first]
    away = np.repeat(normal_x, counts)
    away *= inner_x
    other = np.repeat(normal_y, counts)
    other *= inner_y
    away += other
    away -= np.repeat(offset, counts)
    np.abs(away, out=away)
    aside = np.maximum.reduceat(away, begin)
    way = np.add.reduceat(inner_steps, begin) * (1 + counts * _EPS)
    beyond = np.maximum(way - lengths, 0) / 2
    return np.asarray(np.hypot(aside, beyond))


def _halved(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    steps: NDArray[np.float64],
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
        left = _deviations(x, y, steps, first, middle)
        right = _deviations(x, y, steps, middle, last)
        deviations = np.insert(deviations, wide, left)
        deviations[wide + 1 + np.arange(len(wide))] = right
        cuts = np.insert(cuts, wide + 1, middle)
