"""Stretches of a curve known by samples, so close that distances from chords can be measured.

Notes
-----
The curve keeps within b of the steps between the samples, at equal shares of both
(`core.samples`). So where both ends of a step are within d of a chord, the curve keeps within d + b
of it, since distance from a segment is a convex function. Where the chord ends within a step, the
place on the step at the same share is no further than b from this end; the curve keeps within
max(d, b) + b there. A curve that joins the ends of a segment and stays within some distance of it
covers the segment within this distance too (its nearest point on the segment moves continuously
from end to end), so the one-sided distance bounds the Hausdorff distance.

It holds for chords of any length and for curves of any class, and tells their deviation nearly
exactly, but needs several samples for each chord.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.density import Density
from core.limit import LimitCurve
from core.samples import Samples, Sampling
from core.segments import Segments
from core.stretch import Part
from core.vectors import lengths, taken

_BOUND_SHARE: Final = 1 / 3
"""Share of the tolerance that the bound between samples takes at most. With a half, a tenth of the
time is saved, but there are curves that take a fifth more chords. Its double is within the
tolerance anyway."""

_AIM: Final = 0.9
"""Share of the admitted deviation that large curves aim at: a chord may bend more than the density
says, and be longer by a place."""

_FINE_AIMS: Final = (0.98,) * 4 + (0.95,) * 4 + (0.9,) * 4
"""The same in the corrections of the density where samples are few, but many to a chord. The first
is best with a hundred samples to a chord, the last with ten."""

_FEW: Final = 2**15
"""Number of samples of a curve up to which the density is corrected so often."""

_MANY: Final = 8
"""Samples to a chord from which on one correction pays in large curves, too: it takes more than a
tenth of chords away that turn far, a percent of others."""

_FINER: Final = 2
"""Levels by which the places that cuts fall on are finer than the samples, mostly at least."""

_FINE_LEVEL: Final = 10
"""Dyadic level of these places where samples are coarse: there is a table for all coarser ones."""

_FINE_ENOUGH: Final = 128
"""Samples to a chord from which on samples are places enough: finer tables would be made first."""

_EPS: Final = float(np.finfo(float).eps)

_TINY: Final = 1e-300
"""What is added to a divisor that may be 0, as its dividend is then: 0 remains."""

EXTREME_SHARE: Final = 1 / 4
"""Share of the admitted deviation by which an extreme has to lie beyond both ends to count, and
the way to or from a turning point has to be longer."""


class Measuring:
    """A `core.stretch.Course` of measured stretches.

    Parameters
    ----------
    curve
        The limit curve; at least one span.
    tolerance
        Admitted deviation, > 0, in the unit of the control points.

    Raises
    ------
    NinepointError
        As `core.samples.Sampling`.
    """

    def __init__(self, curve: LimitCurve, tolerance: float) -> None:
        self._sampling = Sampling(curve, tolerance, _BOUND_SHARE)
        self._tolerance = tolerance

    def parts(self) -> list[Part]:
        """Runs of spans of so many samples as are held at a time."""
        return self._sampling.parts()

    def stretch(self, part: Part) -> MeasuredStretch:
        """One of the parts, sampled."""
        return MeasuredStretch(self._sampling, self._sampling.block(*part), self._tolerance)


class MeasuredStretch:
    """A `core.stretch.Stretch` of samples. Cuts fall on places between them, too.

    Attributes
    ----------
    origin
        The first sample, shape (2, 1).
    x, y
        Samples as seen from there: distances are differences of products, and small
        numbers keep their digits. Shape (m + 1,).
    step_x, step_y, steps
        From each of them to the next, and how far; shape (m,).
    margins
        How far the curve may leave the chords of the steps before and after each sample, shape
        (m + 1,).
    floor
        Twice the largest of them: what is within b of a step's end is left out.
    """

    def __init__(self, sampling: Sampling, samples: Samples, admitted: float) -> None:
        self._sampling, self._samples, self._admitted = sampling, samples, admitted
        self.floor = 2 * samples.bound
        self.origin = np.array([[samples.x[0]], [samples.y[0]]])
        self.x, self.y = samples.x - samples.x[0], samples.y - samples.y[0]
        self.step_x, self.step_y = self.x[1:] - self.x[:-1], self.y[1:] - self.y[:-1]
        self.steps = lengths(self.step_x, self.step_y)
        bounds = self._stepwise(samples.bounds)
        self.margins = np.append(bounds, bounds[-1])
        np.maximum(self.margins[1:-1], bounds[:-1], out=self.margins[1:-1])
        few = sampling.count <= _FEW
        self._shares = self._asked(admitted if few else _AIM * admitted)
        many = len(self.steps) > _MANY * self._shares.sum()
        self.aims = _FINE_AIMS if few else (_AIM,) if many else ()
        are_enough = len(self.steps) >= _FINE_ENOUGH * self._shares.sum()
        finer = _FINE_LEVEL - int(samples.levels.max())
        self._finer = max(finer, 0 if are_enough else _FINER)

    def _stepwise(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each span for each of its steps."""
        return np.repeat(values, 1 << self._samples.levels)

    def _asked(self, aimed: float) -> NDArray[np.float64]:
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

    def density(self) -> Density:
        """Of the turns from step to step."""
        return Density(self._shares, self._finer)

    def fixed(self) -> NDArray[np.intp]:
        """The ends, where the curve turns back, and its extremes; see `core.stretch.Stretch`."""
        least = EXTREME_SHARE * self._admitted
        x, y, step_x, step_y = self.x, self.y, self.step_x, self.step_y
        along = step_x[:-1] * step_x[1:]
        along += step_y[:-1] * step_y[1:]
        turns = np.concatenate([[0], np.flatnonzero(along < 0) + 1, [len(step_x)]])
        strides = np.hypot(np.diff(x[turns]), np.diff(y[turns]))
        # Rings and rounding about a place where the curve stops turn back a hundred times.
        far = strides > least
        chosen = [turns[[0, -1]], turns[1:-1][far[:-1] | far[1:]]]
        for values in (x, y):
            extremes = np.array([values.argmin(), values.argmax()])
            beyond = np.abs(values[[0, -1]][:, None] - values[extremes]).min(axis=0)
            chosen.append(extremes[beyond > least])
        return np.unique(np.concatenate(chosen)) << self._finer

    def at(self, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """Where the curve is; see `core.stretch.Stretch`."""
        return self._sampling.between(self._samples, places, self._finer)

    def deviations(
        self,
        first: NDArray[np.intp],
        last: NDArray[np.intp],
        start: NDArray[np.float64],
        stop: NDArray[np.float64],
        asked: float,
    ) -> NDArray[np.float64]:
        """Proven bounds; see `core.stretch.Stretch`.

        The distance from the line of the chord is measured. A sample that lies s beyond an end of
        the chord makes the way through the samples longer than the chord by 2 s at least, so half
        of that excess bounds s.
        """
        begin, end = -(-first >> self._finer), -(-last >> self._finer)
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
        from_x, from_y = start - self.origin
        way_x, way_y = stop - start
        chords = lengths(way_x, way_y)
        scale = 1.0 / (chords + _TINY)
        normal_x, normal_y = -way_y * scale, way_x * scale
        away = samples.spread(normal_x)
        away *= self.x[seen]
        other = samples.spread(normal_y)
        other *= self.y[seen]
        away += other
        away -= samples.spread(normal_x * from_x + normal_y * from_y)
        np.abs(away, out=away)
        away += self.margins[seen]
        # The way leads to the first measured sample, on to the last one, and to the end.
        way = samples.sums(self.steps[seen]) - taken(self.steps, final)
        way += lengths(taken(self.x, begin) - from_x, taken(self.y, begin) - from_y)
        to_x, to_y = stop - self.origin
        way += lengths(to_x - taken(self.x, final), to_y - taken(self.y, final))
        way *= 1 + (int(counts.max()) + 4) * _EPS
        beyond = np.maximum(way - chords, 0.0) / 2
        # Only what is larger than this can be too large with what lies beyond the ends.
        large = asked - min(float(beyond.max()), asked / 2)
        return samples.maxima(away, large) + np.where(counts > 0, beyond, 0.0)
