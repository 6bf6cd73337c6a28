"""Cells of the dual grid: pieces of a limit function that refinement cuts into smaller ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.chords import cell_constant, size_constant
from core.errors import NoLimitError
from core.mask import Mask
from core.parts import refinements

WIDTH: Final = 1e-9
"""Width of the interval of a maximum, unless the search runs out of its budget."""

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

    def bounds(self, ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """Proven lower and upper bounds of the values in each cell, shape (2, k).

        The sharper ones of two: the ends and the chord bound beyond them, and, sharp in the tails,
        where the data are nearly constant, the middle of the data and their half range times
        `core.chords.size_constant` beyond it.

        Raises
        ------
        NoLimitError
            If the scheme is not seen to converge.
        """
        steps = self.windows[:, 1:] - self.windows[:, :-1]
        bend = cell_constant(self.mask) * np.abs(steps[:, 1:] - steps[:, :-1]).max(axis=1)
        low, high = self.windows.min(axis=1), self.windows.max(axis=1)
        middle, reach = (low + high) / 2, size_constant(self.mask) * (high - low) / 2
        return np.stack([
            np.maximum(ends.min(axis=1) - bend, middle - reach),
            np.minimum(ends.max(axis=1) + bend, middle + reach),
        ])

    def parts(self) -> Cells:
        """The cells of an eighth of the size: all parts of the first cell, then of the second."""
        _, from_cell = refinements(self.mask)
        return Cells(self.mask, (self.windows @ from_cell).reshape(-1, len(from_cell)))

    def subset(self, chosen: NDArray[np.bool_]) -> Cells:
        """Some of the cells."""
        return Cells(self.mask, self.windows[chosen])


class Excess(NamedTuple):
    """How far a function rises above a range, and falls below it: two intervals."""

    above: Interval
    below: Interval


def excess(cells: Cells, low: float = 0.0, high: float = 0.0) -> Excess:
    """How far a function leaves the range from ``low`` to ``high``, which it keeps to elsewhere.

    The ends show how far it does. A cell whose bounds lie no more than `WIDTH` beyond them is
    dropped; the others are cut into parts, for both sides at once.
    """
    seen, dropped = np.zeros((2, 1)), np.zeros((2, 1))
    signs, limits = np.array([[-1.0], [1.0]]), np.array([[-low], [high]])
    try:
        for _ in range(_MAX_DEPTH):
            ends = cells.ends
            bounds = signs * cells.bounds(ends) - limits
            shown = np.array([[-ends.min()], [ends.max()]]) - limits
            seen = np.maximum(seen, shown)
            alive = bounds > seen + (WIDTH - 2 * _ROUNDING)
            beyond = np.where(alive, 0.0, bounds).max(axis=1, keepdims=True)
            remaining = np.maximum(dropped, bounds.max(axis=1, keepdims=True))
            dropped = np.maximum(dropped, beyond)
            kept = alive.any(axis=0)
            if not kept.any():
                remaining = np.maximum(dropped, seen)
                break
            if kept.sum() > _MAX_CELLS:
                break
            cells = cells.subset(kept).parts()
    except NoLimitError:
        remaining = np.full((2, 1), np.inf)
    lower = np.maximum(seen - _ROUNDING, 0.0)
    below, above = map(Interval, lower[:, 0].tolist(), (remaining + _ROUNDING)[:, 0].tolist())
    return Excess(above, below)
