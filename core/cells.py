"""Cells of the dual grid: pieces of a limit function that refinement cuts into smaller ones."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.chords import cell_constant, size_constant
from core.errors import NoLimitError
from core.folding import folded
from core.mask import Mask
from core.runs import PARTS

WIDTH: Final = 1e-9
"""Width of the interval of a maximum, unless the search runs out of its budget."""

STEP: Final = 3
"""Refinements that are done at a time, into `PARTS` parts: few large products, not many small."""

_MAX_DEPTH: Final = 20
"""Steps after which the search ends: for rough functions the interval then stays wider."""

_MAX_CELLS: Final = 4_000
"""Cells, not excluded yet, at which the search ends: for divergent schemes none ever are."""

_ROUNDING: Final = 1e-13
"""Absolute rounding of a value, for data of size 1: sums of some 20 products, through 60 levels."""


class Interval(NamedTuple):
    """Numbers between two proven ends; ``upper`` is infinite where no bound is proven."""

    lower: float
    upper: float


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of one size, with the control points that each of them reads.

    Parameters
    ----------
    mask
        The scheme.
    windows
        Shape (k, end - start): row c holds the data ``p_i``, i = j - end + 1 .. j - start, of a
        cell ``j - 1/2 <= t <= j + 1/2``, or the refined data of a smaller cell in the same way.

    Notes
    -----
    Refinement sends the cell j to the cells 2j and 2j + 1 of the finer grid, its two halves; three
    of them at once to its eight parts 8j .. 8j + 7.
    """

    mask: Mask
    windows: NDArray[np.float64]

    @property
    def ends(self) -> NDArray[np.float64]:
        """Exact values at the two ends of each cell, shape (k, 2)."""
        values = BasicLimitFunction(self.mask).values(0)[::-1]
        return np.stack([self.windows @ values[1:], self.windows @ values[:-1]], axis=1)

    def upper(self, ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """Proven upper bounds of the values in each cell, shape (k,).

        The smaller one of two: the larger end plus the chord bound, and, sharp in the tails, where
        the data are small and nearly constant, the middle of the data plus their half range times
        `core.chords.size_constant`.

        Raises
        ------
        NoLimitError
            If the scheme is not seen to converge.
        """
        bends = np.abs(np.diff(self.windows, n=2, axis=1)).max(axis=1)
        by_chord = ends.max(axis=1) + cell_constant(self.mask) * bends
        low, high = self.windows.min(axis=1), self.windows.max(axis=1)
        by_size = (low + high + size_constant(self.mask) * (high - low)) / 2
        return np.asarray(np.minimum(by_chord, by_size), dtype=np.float64)

    def parts(self) -> Cells:
        """The cells of an eighth of the size: all parts of the first cell, then of the second."""
        _, from_cell = refinements(self.mask)
        return Cells(self.mask, (self.windows @ from_cell).reshape(-1, len(from_cell)))

    def subset(self, chosen: NDArray[np.bool_]) -> Cells:
        """Some of the cells."""
        return Cells(self.mask, self.windows[chosen])


def maximum(cells: Cells) -> Interval:
    """Interval of the maximum over the cells and 0, which the function takes elsewhere.

    The largest end is a lower bound. A cell whose upper bound exceeds it by no more than `WIDTH`
    is dropped; the others are cut into parts.
    """
    lower = dropped = 0.0
    try:
        for _ in range(_MAX_DEPTH):
            ends = cells.ends
            upper = cells.upper(ends)
            lower = max(lower, float(ends.max(initial=0.0)))
            alive = upper > lower + WIDTH - 2 * _ROUNDING
            dropped = max(dropped, float(upper[~alive].max(initial=0.0)))
            if not alive.any():
                return Interval(max(lower - _ROUNDING, 0.0), max(dropped, lower) + _ROUNDING)
            remaining = max(dropped, float(upper.max()))
            if alive.sum() > _MAX_CELLS:
                break
            cells = cells.subset(alive).parts()
    except NoLimitError:
        return Interval(max(lower - _ROUNDING, 0.0), np.inf)
    return Interval(max(lower - _ROUNDING, 0.0), remaining + _ROUNDING)


@lru_cache(maxsize=MEMORY)
def refinements(mask: Mask) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Matrices that cut a window of control points into those of its eight parts.

    Returns
    -------
    from_span, from_cell
        Shapes (r + 1, 8 r) and (r, 8 r), r = end - start. The parts of a span ``[i, i + 1]`` and of
        a cell ``[i - 1/2, i + 1/2]`` are cells of the three times refined polygon, whose point m
        lies at ``t = (m + 1/2) / 8 - 1/2`` (theory, section 1): cells 4 to 11 of the span 0, cells
        0 to 7 of the cell 0.
    """
    parts = PARTS
    iterated = folded(folded(mask.values, mask.values), mask.values)
    width = mask.end - mask.start
    both = []
    for first, reads in ((parts // 2, width + 1), (0, width)):
        coarse = np.arange(reads) + 1 - mask.end
        fine = (first + np.arange(parts)[:, None] + np.arange(width) + 1 - mask.end).ravel()
        index = fine - parts * coarse[:, None] - (parts - 1) * mask.start
        inside = (index >= 0) & (index < len(iterated))
        matrix = np.where(inside, iterated[np.clip(index, 0, len(iterated) - 1)], 0.0)
        matrix.flags.writeable = False
        both.append(matrix)
    return both[0], both[1]
