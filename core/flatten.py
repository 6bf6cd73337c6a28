"""The limit curve as a polyline within a tolerance, with the proven deviation.

Notes
-----
Chords are shared out so that all have the same deviation, by the bend of the curve
(`core.density`). What this leaves over where chords are long is found by measuring: the density
within a chord is corrected by its true deviation, and a chord that still misses the tolerance is
halved.

The density is a guess; the proof is apart from it. Where chords are much shorter than spans, it
follows from second derivatives (`core.bent`), else from samples (`core.measured`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.bent import Bending
from core.errors import NinepointError
from core.limit import LimitCurve
from core.measured import Measuring
from core.parallel import each
from core.stretch import Course, Part, Stretch
from core.vectors import taken

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
    and one in some 100,000 of a large curve.

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

    course: Course = Bending.of(curve, tolerance) or Measuring(curve, tolerance)

    def flat(part: Part) -> tuple[NDArray[np.float64], float]:
        stretch = course.stretch(part)
        fewest = FEWEST_CLOSED if curve.closed and not part[0] else 1
        cuts = _cuts(stretch, tolerance, fewest)
        return cuts.points[:, :-1].T, max(float(cuts.deviations.max()), stretch.floor)

    found = each(flat, course.parts())
    pieces = [points for points, _ in found]
    if not curve.closed:
        pieces.append(curve.control_points[-1:])
    deviation = max(deviation for _, deviation in found)
    return Polyline(np.concatenate(pieces), curve.closed, deviation)


@dataclass(frozen=True, eq=False)
class _Cuts:
    """Where a stretch is cut into chords.

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

    @classmethod
    def made(cls, stretch: Stretch, places: NDArray[np.intp], asked: float) -> _Cuts:
        """The chords between places; `core.stretch.Stretch.deviations` tells what is asked."""
        points = stretch.at(places)
        start, stop = points[:, :-1], points[:, 1:]
        return cls(
            places, points, stretch.deviations(places[:-1], places[1:], start, stop, asked)
        )

    def halved(self, stretch: Stretch, admitted: float) -> _Cuts:
        """The same with each chord that misses what is admitted halved until it fits."""
        places, (x, y), deviations = self.places, self.points, self.deviations.copy()
        while True:
            wide = np.flatnonzero(deviations > admitted)
            wide = wide[places[wide + 1] - places[wide] > 1]
            if not len(wide):
                return _Cuts(places, np.stack([x, y]), deviations)
            first, last = places[wide], places[wide + 1]
            middle = (first + last) // 2
            middle_x, middle_y = stretch.at(middle)
            start = _alternating([x[wide], middle_x], [y[wide], middle_y])
            stop = _alternating([middle_x, x[wide + 1]], [middle_y, y[wide + 1]])
            first, last = _alternating([first, middle], [middle, last])
            found = stretch.deviations(first, last, start, stop, admitted)
            deviations[wide] = found[::2]
            count = len(places)
            order = np.insert(np.arange(count), wide + 1, np.arange(count, count + len(wide)))
            places, x, y = (
                taken(np.concatenate(both), order)
                for both in ((places, middle), (x, middle_x), (y, middle_y))
            )
            # The last place begins no chord.
            deviations = taken(np.concatenate([deviations, [0.0], found[1::2]]), order[:-1])


def _cuts(stretch: Stretch, admitted: float, fewest: int) -> _Cuts:
    """Cuts of a stretch, few chords that keep within what is admitted."""
    fixed, density = stretch.fixed(), stretch.density()
    asked = 0.0 if stretch.aims else admitted
    cuts = _Cuts.made(stretch, density.cuts(fixed, fewest), asked)
    best = cuts.halved(stretch, admitted)
    for aim in stretch.aims:
        density = density.corrected(cuts.places, np.sqrt(cuts.deviations / (aim * admitted)))
        cuts = _Cuts.made(stretch, density.cuts(fixed, fewest), asked)
        other = cuts.halved(stretch, admitted)
        if len(other.places) < len(best.places):
            best = other
    return best


def _alternating(*pairs: list[NDArray[Any]]) -> NDArray[Any]:
    """For each pair of arrays a row whose entries are taken of one and the other in turn."""
    return np.stack(pairs).transpose(0, 2, 1).reshape(len(pairs), -1)
