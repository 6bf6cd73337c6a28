"""The limit curve as a polyline within a tolerance, with the proven deviation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from core.chords import chord_constant, second_difference_norm
from core.errors import NinepointError
from core.limit import LimitCurve

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
        If the scheme is not seen to converge (see `core.chords`), or the tolerance needs a level
        beyond `FINEST_LEVEL` or more than `MAX_SAMPLES` sampled points.
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
    squares: NDArray[np.float64] = (away**2).sum(axis=-1)
    return np.asarray(np.sqrt(squares.max(axis=(1, 2))), dtype=np.float64)
