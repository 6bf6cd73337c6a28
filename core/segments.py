"""Consecutive segments of long arrays: what belongs to each, their sums and their largest values.

Notes
-----
NumPy's ways to do this take some time for each segment, or some for each entry. With three entries
to a segment the latter take a third of the time, and other threads go on meanwhile; with a hundred
the former take a tenth.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_LONG: Final = 12
"""Mean number of entries from which on it is sooner to go by segments."""


class Segments:
    """Segments of an array, one after the other.

    Parameters
    ----------
    counts
        Numbers of entries of the segments, shape (n,); some may be 0, not all.

    Attributes
    ----------
    counts
        As given.
    starts
        Index of the first entry of each segment.
    size
        Number of all entries.
    """

    def __init__(self, counts: NDArray[np.intp]) -> None:
        self.counts = counts
        self.starts = np.cumsum(counts) - counts
        self.size = int(self.starts[-1] + counts[-1])
        self._are_long = self.size > _LONG * len(counts)

    @cached_property
    def owners(self) -> NDArray[np.intp]:
        """Index of the segment to which each entry belongs, shape (size,)."""
        if self._are_long:
            return np.repeat(np.arange(len(self.counts)), self.counts)
        begun = np.bincount(self.starts[1:], minlength=self.size)[: self.size]
        return np.cumsum(begun, dtype=np.intp)

    def spread(self, values: NDArray[Any]) -> NDArray[Any]:
        """The value (n,) of each segment at all of its entries, shape (size,)."""
        if self._are_long:
            return np.repeat(values, self.counts)
        return values.take(self.owners, mode="clip")

    def sums(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sum of the entries of each segment, shape (n,)."""
        if self._are_long:
            return self._reduced(np.add, values)
        return np.bincount(self.owners, values, len(self.counts)).astype(np.float64, copy=False)

    def maxima(self, values: NDArray[np.float64], asked: float = 0.0) -> NDArray[np.float64]:
        """Largest entry of each segment, or 0.

        Parameters
        ----------
        values
            Entries, >= 0.
        asked
            Where the largest one is not larger than this, any number from it to this is an answer,
            which takes less time.
        """
        if self._are_long:
            return self._reduced(np.maximum, values)
        large = np.flatnonzero(values > asked)
        found = np.full(len(self.counts), min(asked, float(values.max())))
        np.maximum.at(
            found, self.owners.take(large, mode="clip"), values.take(large, mode="clip")
        )
        return found

    def _reduced(self, kind: np.ufunc, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Each segment reduced to one number, 0 where there is nothing."""
        found = np.zeros(len(self.counts))
        there = self.counts > 0
        found[there] = kind.reduceat(values, self.starts[there])
        return found
