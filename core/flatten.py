"""The limit curve as a polyline within a tolerance, with the proven deviation.

Notes
-----
Let ``E(t)`` be the difference between the curve on a span and the chord between its ends. It
vanishes on linear data, so it is a combination of the second differences of the control points,
``E(t) = sum_r g_r(t) D2p_r`` (summation by parts, twice), and ``|E| <= c max |D2p|`` with
``c = sup_t sum_r |g_r(t)|``. The same holds at level L for the refined polygon, whose second
differences are at most ``rho_L max |D2p|``; rho_L is the norm of the L-fold refinement of second
differences, whose symbol is ``a(z) / (1+z)^2``.

The sup is proven: between the samples of level m the curve differs from the chords by at most
``c rho_m``, so ``c <= c_m + c rho_m`` with the largest sample ``c_m``, hence
``c <= c_m / (1 - rho_m)``. Norms and samples are floats; their rounding, some 1e-13 relative, is
covered by the factor `ROUNDING`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.errors import NinepointError
from core.limit import LimitCurve
from core.mask import Mask

ROUNDING: Final = 1 + 1e-10
"""Factor on proven bounds that covers the rounding of the floats they are computed with."""

FINEST_LEVEL: Final = 14
"""Level at which the search gives up: 16,384 chords in a span."""

MAX_SAMPLES: Final = 2**25
"""Largest number of sampled points of a curve: some ten seconds of work."""

_BOUND_SHARE: Final = 1 / 8
"""Share of the tolerance that the bound between the sampled points should take."""

_LARGEST_BOUND_SHARE: Final = 1 / 2
"""Share that it may take where a rough curve does not come down to that at `FINEST_LEVEL`."""

_CHUNK_POINTS: Final = 2**18
"""Number of sampled points held at a time."""


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


@lru_cache(maxsize=MEMORY)
def second_difference_norm(mask: Mask, level: int) -> float:
    """Norm ``rho_level``: how much ``max |D2p|`` can grow in ``level`` refinements, at most.

    It is ``max_i sum_j |b_{i - 2^level j}|`` of the iterated symbol
    ``b(z) b(z^2) ... b(z^(2^(level-1)))``, ``b = a / (1+z)^2`` (paper, Theorem 2.1).
    """
    step = mask.divided(2).values
    iterated = np.ones(1)
    for _ in range(level):
        spread = np.zeros(2 * len(iterated) - 1)
        spread[::2] = iterated
        iterated = np.convolve(spread, step)
    period = 2**level
    padded = np.concatenate([iterated, np.zeros(-len(iterated) % period)])
    return float(np.abs(padded).reshape(-1, period).sum(axis=0).max()) * ROUNDING


@lru_cache(maxsize=MEMORY)
def chord_constant(mask: Mask) -> float:
    """Constant c of the chord bound ``|C - chord| <= c max |D2p|`` over one span.

    The maximum runs over the second differences of the points that the span reads.

    Raises
    ------
    NinepointError
        If refinement is not seen to shrink second differences, so that no bound is proven.
    """
    for level in range(4, 11, 2):
        growth = second_difference_norm(mask, level)
        if growth < 1 / 2:
            break
    else:
        raise NinepointError(
            "No deviation can be proven for these parameters: the curve may not converge."
            " Bring alpha, beta and gamma closer to a preset."
        )
    table = BasicLimitFunction(mask).table(level)
    start = table[:, :1]
    end = np.vstack([np.zeros((1, 1)), start[:-1]])
    tau = np.arange(2**level) / 2**level
    weights = table - (1 - tau) * start - tau * end
    kernel = np.cumsum(np.cumsum(weights, axis=0), axis=0)[:-2]
    largest = float(np.abs(kernel).sum(axis=0).max())
    return largest / (1 - growth) * ROUNDING


def polyline(curve: LimitCurve, tolerance: float) -> Polyline:
    """Polyline through exact curve points, within ``tolerance`` of the curve.

    Each span is cut uniformly, as fine as it needs. Its deviation is the largest distance of
    sampled curve points from their chords, plus the proven bound between the samples.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.

    Returns
    -------
    Polyline
        At least the ends of all spans.

    Raises
    ------
    NinepointError
        If the scheme is not seen to converge, or the tolerance needs a level beyond
        `FINEST_LEVEL` or more than `MAX_SAMPLES` sampled points.
    """
    if not tolerance > 0:
        raise NinepointError(f"The tolerance must be greater than 0, not {tolerance:g}.")
    if curve.spans == 0:
        return Polyline(curve.control_points, closed=False, deviation=0.0)
    fine_levels, bounds = _fine_levels(curve, tolerance)
    if (2**fine_levels).sum() > MAX_SAMPLES:
        raise NinepointError(
            f"{curve.spans:,} spans within {tolerance:g} mm need too many vertices;"
            " choose a larger tolerance."
        )
    pieces: dict[int, NDArray[np.float64]] = {}
    deviation = 0.0
    for fine in np.unique(fine_levels):
        members = np.flatnonzero(fine_levels == fine)
        size = max(_CHUNK_POINTS >> int(fine), 1)
        for begin in range(0, len(members), size):
            spans = members[begin : begin + size]
            sampled = curve.span_points(spans, int(fine))
            steps, distances = _coarsest(sampled, tolerance - bounds[spans])
            deviation = max(deviation, float((distances + bounds[spans]).max()))
            for span, points, step in zip(spans, sampled, steps, strict=True):
                # A view would keep all samples in memory.
                pieces[int(span)] = points[:-1:step].copy()
    points = np.concatenate([pieces[span] for span in range(curve.spans)])
    if not curve.closed:
        points = np.concatenate([points, curve.control_points[-1:]])
    return Polyline(points, curve.closed, deviation)


def _fine_levels(
    curve: LimitCurve, tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Level at which each span is sampled, and the proven chord bound at that level."""
    mask = curve.mask
    endless = curve.endless_points
    bends = np.hypot(*np.diff(endless, n=2, axis=0).T)
    reads = mask.end - mask.start - 1
    largest = sliding_window_view(bends, reads).max(axis=1)[: curve.spans]
    # A coordinate of a curve point is off by some 8 eps of the largest coordinate.
    rounding = 16 * np.finfo(float).eps * float(np.abs(endless).max())
    constant = chord_constant(mask)
    levels = np.full(curve.spans, -1, dtype=np.intp)
    bounds = np.full(curve.spans, np.inf)
    for level in range(FINEST_LEVEL + 1):
        bound = constant * second_difference_norm(mask, level) * largest + rounding
        share = _BOUND_SHARE if level < FINEST_LEVEL else _LARGEST_BOUND_SHARE
        reached = (levels < 0) & (bound <= share * tolerance)
        levels[reached] = level
        bounds[reached] = bound[reached]
        if (levels >= 0).all():
            return levels, bounds
    raise NinepointError(
        f"This curve is too rough to be followed within {tolerance:g} mm;"
        " choose a larger tolerance, or parameters closer to a preset."
    )


def _coarsest(
    sampled: NDArray[np.float64], admitted: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """For each span the widest step whose chords keep all samples within ``admitted``.

    Parameters
    ----------
    sampled
        Shape (k, 2^F + 1, 2).
    admitted
        Shape (k,), positive.

    Returns
    -------
    steps, distances
        Shape (k,): samples per chord, a power of two, and the largest distance of a sample.
    """
    count, size = sampled.shape[0], sampled.shape[1] - 1
    steps = np.ones(count, dtype=np.intp)
    distances = np.zeros(count)
    open_spans = np.arange(count)
    step = size
    while step > 1 and len(open_spans):
        points = sampled[open_spans]
        found = _chord_distances(points, step)
        good = found <= admitted[open_spans]
        steps[open_spans[good]] = step
        distances[open_spans[good]] = found[good]
        open_spans = open_spans[~good]
        step //= 2
    return steps, distances


def _chord_distances(points: NDArray[np.float64], step: int) -> NDArray[np.float64]:
    """Largest distance, for each row, of the points from the chord segments over ``step`` points.

    A curve that joins the ends of a segment and stays within d of it covers the segment within d
    too (its nearest point on the segment moves continuously from end to end), so this one-sided
    distance bounds the Hausdorff distance.
    """
    rows = len(points)
    start = points[:, :-1:step, None]
    chord = points[:, step::step, None] - start
    inner = points[:, :-1].reshape(rows, -1, step, 2) - start
    length = (chord**2).sum(axis=-1)
    along = (inner * chord).sum(axis=-1)
    share = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
    away = inner - np.clip(share, 0.0, 1.0)[..., None] * chord
    return np.sqrt((away**2).sum(axis=-1).max(axis=(1, 2)))
