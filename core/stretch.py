"""What is asked of a stretch of a curve to cut it into chords."""

from __future__ import annotations

from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from core.density import Density

Part: TypeAlias = tuple[int, int]
"""Consecutive spans ``begin .. end - 1``."""


class Stretch(Protocol):
    """Consecutive spans of a curve, with places on them at which it can be cut."""

    @property
    def floor(self) -> float:
        """What each deviation is at least, whatever `deviations` says."""

    @property
    def aims(self) -> tuple[float, ...]:
        """For each correction of the density that pays, the share of what is admitted to aim at."""

    def density(self) -> Density:
        """How many chords are asked for, and where."""

    def fixed(self) -> NDArray[np.intp]:
        """Places that have to be vertices, rising, with both ends.

        With the extremes in x and y the polyline has the size of the curve, not one that is smaller
        by as much as its deviation. Those that the ends nearly reach do not count: a straight line
        has none.
        """

    def at(self, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """Where the curve is at places in ascending order, shape (2, k)."""

    def deviations(
        self,
        first: NDArray[np.intp],
        last: NDArray[np.intp],
        start: NDArray[np.float64],
        stop: NDArray[np.float64],
        asked: float,
    ) -> NDArray[np.float64]:
        """Proven bounds of the distance of the curve from chords between places.

        Parameters
        ----------
        first, last
            Places, ascending; no two chords overlap. Shape (n,).
        start, stop
            Where the curve is there, shape (2, n).
        asked
            Which chords keep within this distance is what is asked: the bounds of those that do may
            be larger than need be, up to this distance. It may take less time than to ask for each
            bound, 0.
        """


class Course(Protocol):
    """A whole curve, to be cut in parts within a deviation that is admitted."""

    def parts(self) -> list[Part]:
        """Runs of spans that are cut apart from each other."""

    def stretch(self, part: Part) -> Stretch:
        """One of the parts."""
