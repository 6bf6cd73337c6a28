"""Exact points of a limit curve, so close that what lies between them is proven.

Notes
-----
Between two neighbouring samples of level L the curve leaves their chord by at most
``c_L max |D2p|`` (see `core.chords`), the maximum running over the second differences that the
span reads. Each span takes the coarsest level at which this bound is a given share of the
tolerance; what `core.flatten`, `core.arcs` and `core.beziers` find at the samples is then a proof
for the whole curve.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.chords import chord_constant
from core.errors import NinepointError
from core.limit import LimitCurve

FINEST_LEVEL: Final = 14
"""Level at which the search gives up: 16,384 samples in a span."""

MAX_SAMPLES: Final = 2**25
"""Largest number of samples of a curve: some seconds of work."""

_LARGEST_BOUND_SHARE: Final = 1 / 2
"""Share of the tolerance that the bound between the samples may take where a rough curve does not
come down to the share that was asked for at `FINEST_LEVEL`."""

BLOCK: Final = 2**16
"""Number of samples held at a time, unless one span has more: they fit the processor's cache."""

_FINER: Final = (2**18, 2**18, *[2**15] * FINEST_LEVEL)
"""Numbers of samples up to which a curve is sampled finer than the proof needs, by one level, by
two, and so on: it costs nothing that a hand could feel, and cuts can lie closer to where they are
best."""

_UNEVEN: Final = 1.5
"""Samples that a block may take more, as a factor, to have one level for all of its spans."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Consecutive exact points of a curve.

    Attributes
    ----------
    x, y
        Coordinates, shape (n + 1,), from the start of the first span to the end of the last.
    bound
        Proven bound of the distance between the curve and the polygon of the samples, rounding
        included; parametrically: curve and chord at equal shares of their intervals.
    slope_x, slope_y
        Derivatives with respect to t, shape (n + 1,), if they were asked for, else empty.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    bound: float
    slope_x: NDArray[np.float64]
    slope_y: NDArray[np.float64]


class Sampling:
    """Levels at which the spans of a curve are to be sampled, and the samples in blocks.

    Parameters
    ----------
    curve
        The limit curve; at least one span.
    tolerance
        Admitted deviation, > 0, in the unit of the control points.
    share
        Share of the tolerance that the bound between the samples should take.

    Raises
    ------
    NinepointError
        If the scheme is not seen to converge (see `core.chords`), or the tolerance needs a level
        beyond `FINEST_LEVEL` or more than `MAX_SAMPLES` samples.
    """

    def __init__(self, curve: LimitCurve, tolerance: float, share: float) -> None:
        self.curve = curve
        self.levels, self.bounds = _levels(curve, tolerance, share)
        if (2**self.levels).sum() > MAX_SAMPLES:
            raise NinepointError(
                f"{curve.spans:,} spans within {tolerance:g} mm need too many vertices;"
                " choose a larger tolerance."
            )

    @property
    def largest_bound(self) -> float:
        """Largest bound between the samples of any span."""
        return float(self.bounds.max())

    def blocks(self, size: int = BLOCK, slopes: bool = False) -> Iterator[Samples]:
        """Samples of runs of spans; the last of a block is, up to rounding, the first of the next.

        Parameters
        ----------
        size
            Number of samples of a block, unless one span has more.
        slopes
            Whether derivatives are wanted. The scheme must be C^1.
        """
        ends = np.cumsum(2**self.levels)
        begin = 0
        while begin < len(ends):
            before = ends[begin - 1] if begin else 0
            end = int(np.searchsorted(ends, before + size, side="right"))
            end = max(end, begin + 1)
            yield self._block(begin, end, slopes)
            begin = end

    def _block(self, begin: int, end: int, slopes: bool) -> Samples:
        levels = self.levels[begin:end]
        if len(levels) << int(levels.max()) <= _UNEVEN * (1 << levels).sum():
            levels = np.full(len(levels), levels.max())
        x, y = self._values(begin, levels, 0)
        curve = self.curve
        if not curve.closed:
            # The end rules hold up to rounding; a contour has to end exactly where it was told to.
            if begin == 0:
                x[0], y[0] = curve.control_points[0]
            if end == curve.spans:
                x[-1], y[-1] = curve.control_points[-1]
        elif begin == 0 and end == curve.spans:
            x[-1], y[-1] = x[0], y[0]
        none = np.zeros(0)
        slope_x, slope_y = self._values(begin, levels, 1) if slopes else (none, none)
        return Samples(x, y, float(self.bounds[begin:end].max()), slope_x, slope_y)

    def _values(
        self, begin: int, levels: NDArray[np.intp], order: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Points or derivatives of the spans from ``begin`` on, and of the end of the last one."""
        basis = BasicLimitFunction(self.curve.mask, is_exact=True)
        first = np.concatenate([[0], np.cumsum(1 << levels)])
        found = []
        for column in self.curve.endless_points.T:
            values = np.empty(first[-1] + 1)
            for level in np.flatnonzero(np.bincount(levels)):
                table = basis.table(int(level), order)
                chosen = np.flatnonzero(levels == level)
                windows = sliding_window_view(column, len(table))[begin:][chosen]
                if len(chosen) == len(levels):
                    np.matmul(windows, table, out=values[:-1].reshape(len(levels), -1))
                else:
                    values[first[chosen][:, None] + np.arange(1 << level)] = windows @ table
            # The end is read with the window of the last span: the first column, one point on.
            last = begin + len(levels)
            weights = basis.table(0, order)[:-1, 0]
            values[-1] = column[last : last + len(weights)] @ weights
            found.append(values)
        return found[0], found[1]


def _levels(
    curve: LimitCurve, tolerance: float, share: float
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Level at which each span is sampled, and the proven chord bound at that level."""
    mask = curve.mask
    bends = np.hypot(*np.diff(curve.endless_points, n=2, axis=0).T)
    reads = mask.end - mask.start - 1
    largest = _running_maximum(bends, reads)[: curve.spans]
    # A coordinate of a curve point is off by some 8 eps of the largest coordinate, and what is made
    # of two of them, a distance from a chord, by twice as much more.
    rounding = 32 * np.finfo(float).eps * float(np.abs(curve.endless_points).max())
    factors = [chord_constant(mask, level) for level in range(FINEST_LEVEL + 1)]
    levels = np.full(curve.spans, -1, dtype=np.intp)
    for level, factor in enumerate(factors):
        admitted = share if level < FINEST_LEVEL else _LARGEST_BOUND_SHARE
        reached = (levels < 0) & (factor * largest + rounding <= admitted * tolerance)
        levels[reached] = level
        if (levels >= 0).all():
            break
    else:
        raise NinepointError(
            f"This curve is too rough to be followed within {tolerance:g} mm;"
            " choose a larger tolerance, or parameters closer to a preset."
        )
    bent = largest * max(factors) > rounding
    for plenty in _FINER:
        finer = levels + bent
        if finer.max() > FINEST_LEVEL or (1 << finer).sum() > plenty:
            break
        levels = finer
    return levels, np.array(factors)[levels] * largest + rounding


def _running_maximum(values: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Maximum of each ``size`` consecutive values, by doubling."""
    reach = 1
    while reach < size:
        step = min(reach, size - reach)
        values = np.maximum(values[:-step], values[step:])
        reach += step
    return values
