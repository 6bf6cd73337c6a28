"""How closely a curve is to be cut: chords for each part of its length, shared out evenly.

Notes
-----
A chord of length h misses a curve of curvature k by ``k h^2 / 8``. So ``sqrt(k / (8 d))`` is the
density of chords, per unit of length, that keeps the deviation d; cutting the curve where the
integral of the density passes whole numbers gives all chords the same deviation, and no other
choice of as many chords does better, as the chords get short (de Boor's equidistribution).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.segments import Segments

_LARGEST_CORRECTION: Final = 1.5
"""Factor by which a density is changed at most in one correction."""


@dataclass(frozen=True, eq=False)
class Density:
    """How many chords a stretch of a curve asks for.

    Attributes
    ----------
    shares
        Chords that each of its steps asks for, shape (m,).
    finer
        A step has ``2^finer`` places: place ``i 2^finer`` is where step i begins.
    """

    shares: NDArray[np.float64]
    finer: int

    @cached_property
    def sums(self) -> NDArray[np.float64]:
        """Chords from the start to each of the steps' ends, shape (m + 1,)."""
        sums = np.zeros(len(self.shares) + 1)
        np.cumsum(self.shares, out=sums[1:])
        return sums

    @cached_property
    def places(self) -> NDArray[np.float64]:
        """The places of the steps' ends."""
        return np.arange(0.0, len(self.sums) << self.finer, 1 << self.finer)

    def cuts(self, fixed: NDArray[np.intp], fewest: int) -> NDArray[np.intp]:
        """Places that share out what lies between each two fixed ones to whole chords.

        Parameters
        ----------
        fixed
            Places that become vertices, rising, with both ends.
        fewest
            Number of chords before the second fixed one that there are at least, unless there are
            more sections.
        """
        ends = np.interp(fixed, self.places, self.sums)
        sections = np.diff(ends)
        chords = np.maximum(np.ceil(sections), 1.0).astype(np.intp)
        if len(chords) < fewest:
            chords[0] = max(chords[0], fewest)
        begin = np.concatenate([[0], np.cumsum(chords)])
        wanted = np.interp(np.arange(begin[-1] + 1.0), begin, ends)
        found = np.interp(wanted, self.sums, self.places)
        cuts: NDArray[np.intp] = np.rint(found, out=found).astype(np.intp)
        cuts[begin] = fixed
        rising = cuts[1:] > cuts[:-1]
        if rising.all():
            return cuts
        # Where nothing is asked for, any place will do, but it has to be in its section; and where
        # there are fewer places than chords wanted, several meet.
        inner = cuts[:-1]
        np.clip(inner, np.repeat(fixed[:-1], chords), np.repeat(fixed[1:], chords), out=inner)
        np.maximum.accumulate(cuts, out=cuts)
        kept: NDArray[np.intp] = cuts[np.concatenate([[True], cuts[1:] > cuts[:-1]])]
        return kept

    def corrected(self, cuts: NDArray[np.intp], wanted: NDArray[np.float64]) -> Density:
        """The density with which each chord would have had another number of chords."""
        had = np.diff(np.interp(cuts, self.places, self.sums))
        factors = np.divide(wanted, had, out=np.ones_like(had), where=had > 0)
        factors = np.clip(factors, 1 / _LARGEST_CORRECTION, _LARGEST_CORRECTION)
        counts = np.diff(-(-cuts >> self.finer))
        return Density(self.shares * Segments(counts).spread(factors), self.finer)
