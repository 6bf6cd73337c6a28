"""The limit curve as one cubic spline with continuous curvature, with the proven deviation.

Notes
-----
The spline interpolates the curve at its knots, which are parameters t of the curve; it is C^2, and
so is a closed one across its seam. Of the cubic splines with given knots none is nearer, as the
knots get close, than by a factor that does not depend on the curve, and its error is that of the
fourth derivative: ``5/384 h^4 |C''''|``. So the density of knots that keeps an error d is
``(5 |C''''| / (384 d))^(1/4)``, found here by measuring the errors between the knots and changing
the density by the fourth root of what they should be (de Boor, A Practical Guide to Splines,
chapter XII).

With the derivatives m_j at the knots as unknowns the equations of C^2 are
``a_j m_j-1 + 2 m_j + (1 - a_j) m_j+1 = c_j``, 0 < a_j < 1. Solving each for m_j in turn with what
the others were before (Jacobi's iteration) halves the error, whatever the knots are and however
many. The control points follow by blossoming: that of three consecutive knots is the value of the
trilinear form of the cubic there.

Proof of the deviation. What is compared are curve and spline at the same t. At the samples of the
curve both are evaluated, the spline from the very control points that are returned. Between two
samples the curve keeps to its chord by `core.samples`, and the spline leaves its chord by at most
``(u_k+1 - u_k)^2 max |S''| / 8``, u being the place within a piece, where S'' is linear, hence
largest at an end of the piece. So the sum of the three bounds the distance of curve and spline as
moving points (Fréchet), hence the Hausdorff distance. How the knots were found does not matter.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.continuity import smoothness
from core.errors import NinepointError
from core.limit import LimitCurve
from core.samples import Sampling

DEGREE: Final = 3
"""Degree of the splines."""

MAX_SAMPLES: Final = 2**22
"""Largest number of samples of a curve, which are all held at once: some 200 MB."""

_BOUND_SHARE: Final = 1 / 32
"""Share of the tolerance that the bound between the samples should take."""

_ROUGHEST_SHARE: Final = 1 / 4
"""Share that it may take at most; beyond, the curve is too rough for a spline."""

_FEWEST_CLOSED: Final = 4
"""Pieces of a closed spline, at least."""

_ITERATIONS: Final = 56
"""Rounds of Jacobi's iteration: the error comes down to 2^-56."""

_ROUNDS: Final = 16
"""Rounds in which the density of knots is corrected, for a curve of few samples."""

_FEW: Final = 2**17
"""Samples up to which so many rounds cost nothing that a hand could feel."""

_ROUNDS_OF_MANY: Final = 6

_AIMS: Final = (0.98, 0.9, 0.7)
"""Shares of the admitted error that the rounds aim at, in turns."""

_LARGEST_CORRECTION: Final = 4.0
"""Factor by which a density is changed at most in a round."""


@dataclass(frozen=True, eq=False)
class Spline:
    """A cubic spline over a clamped knot vector.

    Attributes
    ----------
    knots
        Breakpoints, shape (m + 1,), rising whole numbers from 0 on: the knot vector is these with
        the first and the last one four times.
    controls
        Control points, shape (m + 3, 2). A closed one ends where it starts, in every bit.
    closed
        Whether the curve is closed; then the spline is C^2 across its seam too, up to rounding.
    deviation
        Proven bound of the Hausdorff distance between the spline and the exact curve, in the unit
        of the points.
    """

    knots: NDArray[np.float64]
    controls: NDArray[np.float64]
    closed: bool
    deviation: float

    @property
    def beziers(self) -> NDArray[np.float64]:
        """Control points of the m cubics that the spline consists of, shape (m, 4, 2)."""
        return pieces(self.knots, self.controls)


def spline(curve: LimitCurve, tolerance: float) -> Spline | None:
    """C^2 spline within ``tolerance`` of the curve, or None where it is too rough for one.

    Parameters
    ----------
    curve
        The limit curve; at least one span.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.

    Returns
    -------
    Spline or None
        None for a scheme that is not proven C^1, where the bound between the samples does not come
        down far enough, and where knots as close as the samples do not do.

    Raises
    ------
    NinepointError
        If the tolerance is not positive, `core.samples.Sampling` refuses, or more than
        `MAX_SAMPLES` samples are needed.
    """
    if not tolerance > 0:
        raise NinepointError(f"The tolerance must be greater than 0, not {tolerance:g}.")
    order = smoothness(curve.mask).order
    if curve.spans == 0 or order is None or order < 1:
        return None
    sampling = Sampling(curve, tolerance, _BOUND_SHARE)
    bound = sampling.largest_bound
    if bound > _ROUGHEST_SHARE * tolerance:
        return None
    samples = _Samples(curve, sampling.levels)
    best = _fitted(samples, tolerance - bound)
    if best is None:
        return None
    cuts, controls, error = best
    return Spline(samples.t[cuts], controls, curve.closed, error + bound)


def pieces(knots: NDArray[np.float64], controls: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cubics of a clamped spline as Bézier curves, shape (m, 4, 2); see `Spline`.

    A piece of the spline is the trilinear form f at knots: its control points are f(a, a, a),
    f(a, a, b), f(a, b, b), f(b, b, b), found from the form at neighbouring knots by going along
    one argument (Boehm).
    """
    steps = np.diff(knots)
    before = np.concatenate([[0.0], steps[:-1]])[:, None]
    after = np.concatenate([steps[1:], [0.0]])[:, None]
    own = steps[:, None]
    first, second = controls[1:-2], controls[2:-1]
    way = second - first
    total = before + own + after
    found = np.empty((len(steps), 4, 2))
    found[:, 1] = first + before / total * way
    found[:, 2] = second - after / total * way
    found[0, 0], found[-1, 3] = controls[0], controls[-1]
    share = before[1:] / (before[1:] + own[1:])
    joints = found[:-1, 2] + share * (found[1:, 1] - found[:-1, 2])
    found[1:, 0] = found[:-1, 3] = joints
    return found


class _Samples:
    """Exact points of a whole curve, with their parameters and the derivatives at both ends."""

    def __init__(self, curve: LimitCurve, levels: NDArray[np.intp]) -> None:
        counts = 1 << levels
        if counts.sum() > MAX_SAMPLES:
            raise NinepointError(
                f"{curve.spans:,} spans need too many points for one spline;"
                " choose a larger tolerance, or arcs."
            )
        begin = np.concatenate([[0], np.cumsum(counts)])
        finest = int(levels.max())
        # Parameters are whole numbers: multiples of the shortest step.
        self.t = np.empty(begin[-1] + 1)
        self.points = np.empty((begin[-1] + 1, 2))
        for level in np.unique(levels).tolist():
            chosen = np.flatnonzero(levels == level)
            places = begin[chosen][:, None] + np.arange((1 << level) + 1)
            offsets = np.arange((1 << level) + 1) << (finest - level)
            self.t[places] = (chosen << finest)[:, None] + offsets
            self.points[places] = curve.span_points(chosen, level)
        self.closed = curve.closed
        if curve.closed:
            self.points[-1] = self.points[0]
        ends = curve.span_points(np.array([0, curve.spans - 1]), 0, 1)
        self.slopes = np.stack([ends[0, 0], ends[1, -1]]) / 2.0**finest
        self.spans = begin


_Fit = tuple[NDArray[np.intp], NDArray[np.float64], float]
"""Indices of the samples at the knots, control points, and the error."""


def _fitted(samples: _Samples, admitted: float) -> _Fit | None:
    """Spline with few knots whose error is admitted, or None if there is none."""
    cuts = samples.spans
    last = len(samples.t) - 1
    if samples.closed and len(cuts) <= _FEWEST_CLOSED:
        cuts = np.unique(np.linspace(0, last, _FEWEST_CLOSED + 1).round().astype(np.intp))
    best: _Fit | None = None
    for number in range(_ROUNDS if last < _FEW else _ROUNDS_OF_MANY):
        controls, errors = _interpolated(samples, cuts)
        if errors.max() <= admitted and (best is None or len(cuts) < len(best[0])):
            best = cuts, controls, float(errors.max())
        aim = _AIMS[number % len(_AIMS)] * admitted
        cuts = _redistributed(samples, cuts, errors / aim)
    while best is None:
        controls, errors = _interpolated(samples, cuts)
        wide = np.flatnonzero((errors > admitted) & (np.diff(cuts) > 1))
        if errors.max() <= admitted:
            best = cuts, controls, float(errors.max())
        elif len(wide):
            # This ends: either nothing fails, or there is a knot at each sample.
            cuts = np.union1d(cuts, (cuts[wide] + cuts[wide + 1]) // 2)
        else:
            return None
    return best


def _redistributed(
    samples: _Samples, cuts: NDArray[np.intp], excess: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Knots for which each piece should have the error that is aimed at."""
    factors = np.clip(excess**0.25, 1 / _LARGEST_CORRECTION, _LARGEST_CORRECTION)
    sums = np.concatenate([[0.0], np.cumsum(factors)])
    fewest = _FEWEST_CLOSED if samples.closed else 1
    count = max(int(np.ceil(sums[-1])), fewest)
    wanted = np.interp(np.linspace(0, sums[-1], count + 1), sums, samples.t[cuts])
    nearest = np.searchsorted(samples.t, wanted)
    nearest = np.clip(nearest, 1, len(samples.t) - 1)
    nearest -= wanted - samples.t[nearest - 1] < samples.t[nearest] - wanted
    nearest[0], nearest[-1] = 0, len(samples.t) - 1
    chosen = np.unique(nearest)
    # A coarse sampling may leave less than what is fewest; then the old ones stay.
    return chosen if len(chosen) > fewest else cuts


def _interpolated(
    samples: _Samples, cuts: NDArray[np.intp]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Control points of the C^2 spline through the samples at ``cuts``, and its pieces' errors."""
    controls = _controls(samples, cuts)
    return controls, _errors(samples, cuts, controls)


def _controls(samples: _Samples, cuts: NDArray[np.intp]) -> NDArray[np.float64]:
    """Control points of the C^2 spline through the samples at ``cuts``."""
    places = samples.points[cuts]
    steps = np.diff(samples.t[cuts])[:, None]
    chords = np.diff(places, axis=0) / steps
    slopes = np.empty_like(places)
    # One more on each side: of a closed curve the neighbours across the seam, else what is known.
    wide = np.empty((len(places) + samples.closed, 2))
    if samples.closed:
        share = steps / (np.concatenate([steps[-1:], steps[:-1]]) + steps)
        right = 3 * (share * np.concatenate([chords[-1:], chords[:-1]]) + (1 - share) * chords)
    else:
        share = steps[1:] / (steps[:-1] + steps[1:])
        right = 3 * (share * chords[:-1] + (1 - share) * chords[1:])
        wide[0], wide[-1] = samples.slopes
    inner = wide[1:-1]
    inner[:] = right / 3
    for _ in range(_ITERATIONS):
        if samples.closed:
            wide[0], wide[-1] = inner[-1], inner[0]
        inner[:] = (right - share * wide[:-2] - (1 - share) * wide[2:]) / 2
    if samples.closed:
        slopes[:-1], slopes[-1] = inner, inner[0]
    else:
        slopes[:] = wide
    ahead, back = places[:-1] + steps * slopes[:-1] / 3, places[1:] - steps * slopes[1:] / 3
    # The form at the knots about an inner one, seen from the longer of the two pieces there: what
    # is extrapolated is then not further away than what it is extrapolated from.
    from_right = ahead[1:] - steps[:-1] / steps[1:] * (back[1:] - ahead[1:])
    from_left = back[:-1] + steps[1:] / steps[:-1] * (back[:-1] - ahead[:-1])
    inner = np.where(steps[1:] >= steps[:-1], from_right, from_left)
    return np.concatenate([places[:1], ahead[:1], inner, back[-1:], places[-1:]])


def _errors(
    samples: _Samples, cuts: NDArray[np.intp], controls: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Bound of the distance of the spline from the polygon of the samples, for each piece."""
    cubics = pieces(samples.t[cuts], controls)
    counts = np.diff(cuts)
    lengths = np.diff(samples.t[cuts])
    steps = np.diff(samples.t) / np.repeat(lengths, counts)
    u = (samples.t[:-1] - np.repeat(samples.t[cuts[:-1]], counts)) / np.repeat(lengths, counts)
    v = 1 - u
    square = np.zeros(len(u))
    for axis in (0, 1):
        zero, one, two, three = (np.repeat(cubics[:, k, axis], counts) for k in range(4))
        value = v * v * (v * zero + 3 * u * one) + u * u * (3 * v * two + u * three)
        value -= samples.points[:-1, axis]
        square += value * value
    errors = np.sqrt(np.maximum.reduceat(square, cuts[:-1]))
    # The sample at the end of a piece is the first one of the next, or the last of all.
    last = np.append(np.sqrt(square[cuts[1:-1]]), np.hypot(*(controls[-1] - samples.points[-1])))
    errors = np.maximum(errors, last)
    second = 6 * np.abs(cubics[:, :2] - 2 * cubics[:, 1:3] + cubics[:, 2:])
    bend = np.hypot(second[..., 0], second[..., 1]).max(axis=1)
    longest = np.maximum.reduceat(steps, cuts[:-1])
    return np.asarray(errors + bend * longest**2 / 8)

