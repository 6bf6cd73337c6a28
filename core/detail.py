"""Level of detail: as few points of the limit curve as the eye needs, chosen span by span.

Notes
-----
Between two neighbouring dyadic points of level l the curve leaves its chord by
``E(t) = sum_r g_r(t) D2p_r``, a combination of second differences of the control points, since E
vanishes on linear data (summation by parts, twice). Hence ``|E| <= sum_r max_t |g_r(t)| |D2p_r|``;
the maxima, one per level and place r, are the rows of `chord_profile`. They are taken over samples
at a quarter of the chord, where the middle of the chord is one: sharp enough for drawing. Where a
deviation must be proven, use `core.flatten`.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.limit import LimitCurve
from core.mask import Mask

FINEST_DETAIL: Final = 10
"""Finest level that is chosen: 1,024 chords in a span."""

_TABULATED: Final = 6
"""Finest level whose profile is computed; beyond, it goes on by the same ratio."""

_SAMPLES: Final = 2
"""Levels between a chord and its samples: four samples per chord."""


@lru_cache(maxsize=MEMORY)
def chord_profile(mask: Mask) -> NDArray[np.float64]:
    """Weights of the second differences in the chord error, for levels 0 to `FINEST_DETAIL`.

    Returns
    -------
    ndarray
        ``g[l, r]``, shape (FINEST_DETAIL + 1, end - start - 1), read-only: the chords of level l
        of span i miss the curve by at most ``sum_r g[l, r] |D2p_r|``, where ``D2p_r`` is the r-th
        second difference of the points that the span reads.

    Raises
    ------
    NoLimitError
        If the scheme has no unique limit.
    """
    basis = BasicLimitFunction(mask)
    start = basis.table(0)[:, :1]
    end = np.vstack([np.zeros((1, 1)), start[:-1]])
    rows = []
    for level in range(_TABULATED + 1):
        step = 2**_SAMPLES
        samples = np.hstack([basis.table(level + _SAMPLES), end])
        nodes = samples[:, ::step]
        share = np.arange(step) / step
        chords = nodes[:, :-1, None] * (1 - share) + nodes[:, 1:, None] * share
        error = samples[:, :-1] - chords.reshape(len(samples), -1)
        kernel = np.cumsum(np.cumsum(error, axis=0), axis=0)[:-2]
        rows.append(np.abs(kernel).max(axis=1))
    last, before = rows[-1].sum(), rows[-2].sum()
    ratio = last / before if before > 0 else 0.25
    for _ in range(_TABULATED, FINEST_DETAIL):
        rows.append(rows[-1] * ratio)
    profile = np.array(rows)
    profile.flags.writeable = False
    return profile


@lru_cache(maxsize=MEMORY)
def amplification(mask: Mask) -> float:
    """Largest ``sum_j |phi(t - j)|``: how far the curve can leave its points, 1 for convex rules.

    It is sampled at eighths of a span.
    """
    return float(np.abs(BasicLimitFunction(mask).table(3)).sum(axis=0).max())


def span_levels(
    curve: LimitCurve,
    tolerance: float,
    budget: int,
    view: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None,
) -> NDArray[np.intp]:
    """Dyadic level of each span at which its chords keep a tolerance.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Admitted distance between curve and chords, > 0, in the unit of the control points.
    budget
        Number of chords that is not exceeded, unless the curve has more spans: the tolerance
        gives way.
    view
        Two corners of the rectangle that is seen, lower left and upper right; spans out of it
        get level 0, and the tolerance does not hold there. Without it everything is seen.

    Returns
    -------
    ndarray
        Shape (spans,), values 0 to `FINEST_DETAIL`.
    """
    if curve.spans == 0:
        return np.zeros(0, dtype=np.intp)
    profile = chord_profile(curve.mask)
    bends = np.hypot(*np.diff(curve.endless_points, n=2, axis=0).T)
    windows = sliding_window_view(bends, profile.shape[1])[: curve.spans]
    errors = windows @ profile.T
    levels = np.asarray((errors[:, :-1] > tolerance).sum(axis=1), dtype=np.intp)
    if view is not None and levels.any():
        levels = np.where(spans_within(curve, *view), levels, 0)
    while levels.any() and int((1 << levels).sum()) > budget:
        levels = np.maximum(levels - 1, 0)
    return levels


def spans_within(
    curve: LimitCurve, lower: NDArray[np.float64], upper: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Which spans may meet a rectangle; those that are left out do not, nor do their chords.

    Parameters
    ----------
    curve
        The limit curve.
    lower, upper
        Corners of the rectangle, shape (2,).

    Returns
    -------
    ndarray
        Shape (spans,).
    """
    size = curve.mask.end - curve.mask.start + 1
    low = _running(np.minimum, curve.endless_points, size)[: curve.spans]
    high = _running(np.maximum, curve.endless_points, size)[: curve.spans]
    reach = (high - low) / 2 * amplification(curve.mask)
    middle = (low + high) / 2
    inside = (middle + reach >= lower) & (middle - reach <= upper)
    return np.asarray(inside.all(axis=1))


def detailed(
    curve: LimitCurve, levels: NDArray[np.intp]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Exact points of the curve with a level of its own for each span.

    Parameters
    ----------
    curve
        The limit curve.
    levels
        Dyadic levels, shape (spans,).

    Returns
    -------
    parameters, points
        Shapes (k,) and (k, 2): ``2^level`` points for each span, and the end of an open curve.
        Without spans, the control point, if there is one, at t = 0.
    """
    if curve.spans == 0:
        points = curve.control_points.copy()
        return np.zeros(len(points)), points
    sizes = 1 << levels
    first = np.concatenate([[0], np.cumsum(sizes)])
    count = int(first[-1]) + (not curve.closed)
    parameters = np.full(count, float(curve.spans))
    points = np.empty((count, 2))
    for level in np.flatnonzero(np.bincount(levels)):  # np.unique loads numpy.ma at start-up
        spans = np.flatnonzero(levels == level)
        within = np.arange(1 << level)
        places = first[spans][:, None] + within
        points[places] = curve.span_points(spans, int(level))[:, :-1]
        parameters[places] = spans[:, None] + within / (1 << level)
    if not curve.closed:
        points[-1] = curve.control_points[-1]
    return parameters, points


def _running(extreme: np.ufunc, values: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Extreme of each ``size`` consecutive rows, by doubling: log2(size) passes."""
    reach = 1
    while reach < size:
        step = min(reach, size - reach)
        values = extreme(values[:-step], values[step:])
        reach += step
    return values
