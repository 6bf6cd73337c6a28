"""Exact points of a limit curve, so close that what lies between them is proven.

Notes
-----
Between two neighbouring samples the curve leaves their chord by no more than `core.bends` proves.
Each span takes the coarsest level at which this bound is a given share of the tolerance; what
`core.flatten`, `core.arcs` and `core.beziers` find at the samples is then a proof for the whole
curve.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.bends import ChordBounds
from core.errors import NinepointError
from core.limit import LimitCurve

FINEST_LEVEL: Final = 14
"""Level at which the search gives up: 16,384 samples in a span."""

MAX_SAMPLES: Final = 2**25
"""Largest number of samples of a curve: some seconds of work."""

_LARGEST_BOUND_SHARE: Final = 1 / 2
"""Share of the tolerance that the bound between the samples may take where a rough curve does not
come down to the share that was asked for at `FINEST_LEVEL`."""

BLOCK: Final = 2**17
"""Number of samples held at a time, unless one span has more. With half of them several threads
wait for each other more often, with twice as many they do not fit the processor's cache."""

_PLENTY: Final = (2**18, 2**18, *[2**15] * FINEST_LEVEL)
"""Numbers of samples up to which a curve is sampled finer than the proof needs, by one level, by
two, and so on: it costs nothing that a hand could feel, and cuts can lie closer to where they are
best."""

_UNEVEN: Final = 1.5
"""Samples that a block may take more, as a factor, to have few levels for its spans: what is moved
in long runs is moved sooner."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Consecutive exact points of a curve.

    Attributes
    ----------
    first_span
        Index of the span at whose start they begin.
    x, y
        Coordinates, shape (n + 1,), from the start of the first span to the end of the last.
    bounds
        Proven bounds of the distance between the curve and the polygon of the samples, one for each
        span, rounding included; parametrically: curve and chord at equal shares of their intervals.
    levels
        Dyadic level of each span: it has ``2^level`` samples, without its end.
    slope_x, slope_y
        Derivatives with respect to t, shape (n + 1,), if they were asked for, else empty.
    """

    first_span: int
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    bounds: NDArray[np.float64]
    levels: NDArray[np.intp]
    slope_x: NDArray[np.float64]
    slope_y: NDArray[np.float64]

    @cached_property
    def starts(self) -> NDArray[np.intp]:
        """Indices of the samples at which the spans start, and of the last sample."""
        return np.concatenate([[0], np.cumsum(1 << self.levels)])

    @property
    def bound(self) -> float:
        """Largest of the bounds."""
        return float(self.bounds.max())


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
        self._chords = ChordBounds(curve)
        # A coordinate of a curve point is off by some 8 eps of the largest coordinate, and what is
        # made of two of them, a distance from a chord, by twice as much more.
        self._rounding = 32 * np.finfo(float).eps * float(np.abs(curve.endless_points).max())
        self.levels = self._chosen_levels(tolerance, share)
        self.bounds = np.empty(curve.spans)
        for level in np.flatnonzero(np.bincount(self.levels)):
            chosen = self.levels == level
            self.bounds[chosen] = self._bounds_at(int(level))[chosen]
        if self.count > MAX_SAMPLES:
            raise NinepointError(
                f"{curve.spans:,} spans within {tolerance:g} mm need too many vertices;"
                " choose a larger tolerance."
            )

    @property
    def count(self) -> int:
        """Number of samples that the levels ask for."""
        return int((1 << self.levels).sum())

    @property
    def largest_bound(self) -> float:
        """Largest bound between the samples of any span."""
        return float(self.bounds.max())

    def parts(self, size: int = BLOCK) -> list[tuple[int, int]]:
        """Runs of spans ``begin .. end - 1`` of so many samples, unless one span has more."""
        ends = np.cumsum(2**self.levels)
        cuts = [0]
        while cuts[-1] < len(ends):
            before = ends[cuts[-1] - 1] if cuts[-1] else 0
            end = int(np.searchsorted(ends, before + size, side="right"))
            cuts.append(max(end, cuts[-1] + 1))
        return list(pairwise(cuts))

    def block(self, begin: int, end: int, slopes: bool = False) -> Samples:
        """Samples of a part; the last one is, up to rounding, the first of the next part.

        Parameters
        ----------
        begin, end
            As told by `parts`.
        slopes
            Whether derivatives are wanted. The scheme must be C^1.
        """
        levels, bounds = self.levels[begin:end], self.bounds[begin:end]
        coarsest = _coarsest(levels)
        if (levels < coarsest).any():
            raised = self._bounds_at(coarsest, slice(begin, end))
            bounds = np.where(levels < coarsest, raised, bounds)
            levels = np.maximum(levels, coarsest)
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
        return Samples(begin, x, y, bounds, levels, slope_x, slope_y)

    def between(
        self, samples: Samples, places: NDArray[np.intp], finer: int
    ) -> NDArray[np.float64]:
        """Exact points at some of ``2^finer`` equal shares of the steps between samples.

        Parameters
        ----------
        samples
            A block.
        places
            Sample i and j shares more are ``i 2^finer + j``. Ascending; shape (k,).
        finer
            Such that no span's level gets beyond what is tabulated (`core.limit.MAX_LEVEL`).

        Returns
        -------
        ndarray
            Shape (2, k). The first and the last sample are exactly those of the block.
        """
        starts = samples.starts << finer
        inside = np.searchsorted(places, starts)
        inside[-1] = len(places)
        spans = np.repeat(np.arange(len(starts) - 1), np.diff(inside))
        level = finer + int(samples.levels.max())
        shares = (places - starts[spans]) << (level - finer - samples.levels[spans])
        points = self.curve.scattered_points(spans + samples.first_span, shares, level)
        for end in (0, -1):
            if len(places) and places[end] == starts[end]:
                points[:, end] = samples.x[end], samples.y[end]
        return points

    def _values(self, begin: int, levels: NDArray[np.intp], order: int) -> NDArray[np.float64]:
        """Points or derivatives of the spans from ``begin`` on, and of the end of the last one.

        Shape (2, n + 1).
        """
        curve, end = self.curve, begin + len(levels)
        values = np.empty((2, int((1 << levels).sum()) + 1))
        # Values are moved in runs as long as the span that has fewest. All spans have one at least:
        # where some have more, theirs are put in its place.
        fewest = int(levels.min())
        runs = values[:, :-1].reshape(2, -1, 1 << fewest)
        count = 1 << (levels - fewest)
        if len(levels) == runs.shape[1]:
            curve.span_starts(slice(begin, end), fewest, order, runs)
        else:
            several = np.flatnonzero(levels > fewest)
            found = np.empty((2, len(levels) + int(count[several].sum()), 1 << fewest))
            curve.span_starts(slice(begin, end), fewest, order, found[:, : len(levels)])
            source = np.repeat(np.arange(len(levels)), count)
            filled = len(levels)
            for level in np.flatnonzero(np.bincount(levels[several])).tolist():
                chosen = several[levels[several] == level]
                after = filled + (len(chosen) << (level - fewest))
                part = curve.span_starts(begin + chosen, level, order)
                found[:, filled:after] = part.reshape(2, -1, 1 << fewest)
                source[np.repeat(levels == level, count)] = np.arange(filled, after)
                filled = after
            for coordinate, run in zip(found, runs, strict=True):
                coordinate.take(source, axis=0, out=run, mode="clip")
        values[:, -1] = curve.span_points(slice(end - 1, end), 0, order)[0, -1]
        return values

    def _bounds_at(self, level: int, spans: slice = slice(None)) -> NDArray[np.float64]:
        """Proven bounds between samples of a level, rounding included."""
        return self._chords.at(level, spans) + self._rounding

    def _chosen_levels(self, tolerance: float, share: float) -> NDArray[np.intp]:
        """Level at which each span is sampled."""
        levels = np.full(self.curve.spans, -1, dtype=np.intp)
        for level in range(FINEST_LEVEL + 1):
            admitted = share if level < FINEST_LEVEL else _LARGEST_BOUND_SHARE
            levels[(levels < 0) & (self._bounds_at(level) <= admitted * tolerance)] = level
            if (levels >= 0).all():
                break
        else:
            raise NinepointError(
                f"This curve is too rough to be followed within {tolerance:g} mm;"
                " choose a larger tolerance, or parameters closer to a preset."
            )
        bent = self._chords.at(0) > self._rounding
        for plenty in _PLENTY:
            finer = levels + bent
            if finer.max() > FINEST_LEVEL or (1 << finer).sum() > plenty:
                break
            levels = finer
        return levels


def _coarsest(levels: NDArray[np.intp]) -> int:
    """The level up to which all spans of a block may be raised."""
    counts = np.bincount(levels)
    levels_there = np.arange(len(counts))
    allowed = _UNEVEN * (counts << levels_there).sum()
    return max(
        int(level)
        for level in np.flatnonzero(counts)
        if (counts << np.maximum(levels_there, level)).sum() <= allowed
    )
