"""How far the limit curve can leave its chords, proven.

Notes
-----
Let ``E(t)`` be the difference between the curve on a unit interval of t and the chord between its
ends. It vanishes on linear data, so it is a combination of the second differences of the control
points, ``E(t) = sum_r g_r(t) D2p_r`` (summation by parts, twice), and ``|E| <= c max |D2p|`` with
``c = sup_t sum_r |g_r(t)|``. The same holds at level L for the refined polygon, whose second
differences are at most ``rho_L max |D2p|``; rho_L is the norm of the L-fold refinement of second
differences, whose symbol is ``a(z) / (1+z)^2``.

The sup is proven: between the samples of level m the curve differs from the chords by at most
``c rho_m``, so ``c <= c_m + c rho_m`` with the largest sample ``c_m``, hence
``c <= c_m / (1 - rho_m)``. Norms and samples are floats; their rounding, some 1e-13 relative, is
covered by the factor `ROUNDING`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.errors import NoLimitError
from core.mask import Mask

ROUNDING: Final = 1 + 1e-10
"""Factor on proven bounds that covers the rounding of the floats they are computed with."""

_SAMPLE_LEVELS: Final = (4, 6, 8, 10)
"""Levels of the samples, tried in turn until refinement halves the second differences."""


@lru_cache(maxsize=MEMORY)
def second_difference_norm(mask: Mask, level: int) -> float:
    """Norm ``rho_level``: how much ``max |D2p|`` can grow in ``level`` refinements, at most.

    It is ``max_i sum_j |b_{i - 2^level j}|`` of the iterated symbol
    ``b(z) b(z^2) ... b(z^(2^(level-1)))``, ``b = a / (1+z)^2`` (paper, Theorem 2.1).
    """
    step = _second_differences(mask)
    iterated = np.ones(1)
    for _ in range(level):
        spread = np.zeros(2 * len(iterated) - 1)
        spread[::2] = iterated
        iterated = np.convolve(spread, step)
    period = 2**level
    padded = np.concatenate([iterated, np.zeros(-len(iterated) % period)])
    return float(np.abs(padded).reshape(-1, period).sum(axis=0).max()) * ROUNDING


@lru_cache(maxsize=MEMORY)
def _second_differences(mask: Mask) -> NDArray[np.float64]:
    """Coefficients of ``a(z) / (1+z)^2``; the exact division is slow, and asked for many levels."""
    return mask.divided(2).values


@lru_cache(maxsize=MEMORY)
def chord_constant(mask: Mask) -> float:
    """Constant c of the bound ``|C - chord| <= c max |D2p|`` on a span ``[i, i + 1]``.

    The maximum runs over the second differences of the points that the span reads.

    Raises
    ------
    NoLimitError
        If refinement is not seen to shrink second differences, so that no bound is proven.
    """
    basis = BasicLimitFunction(mask)
    return _constant(mask, lambda level: basis.table(level))


@lru_cache(maxsize=MEMORY)
def cell_constant(mask: Mask) -> float:
    """The same on a cell ``[i - 1/2, i + 1/2]`` of the dual grid; see `core.cells`."""
    basis = BasicLimitFunction(mask)
    width = mask.end - mask.start
    return _constant(mask, lambda level: basis.values(level)[:-1].reshape(width, -1)[::-1])


@lru_cache(maxsize=MEMORY)
def size_constant(mask: Mask) -> float:
    """Constant of the bound ``|C| <= c max |p|``: the sup of ``sum_j |phi(t - j)|``, at least 1.

    It is the largest sample plus what the chord bound leaves between the samples, for data of size
    1, whose second differences are at most 4.
    """
    level = _SAMPLE_LEVELS[-1]
    largest = float(np.abs(BasicLimitFunction(mask).table(level)).sum(axis=0).max())
    rest = 4 * chord_constant(mask) * second_difference_norm(mask, level)
    return (largest + rest) * ROUNDING


def _constant(mask: Mask, table: Callable[[int], NDArray[np.float64]]) -> float:
    """Constant for an interval whose weights of the control points, at samples, are the table."""
    for level in _SAMPLE_LEVELS:
        growth = second_difference_norm(mask, level)
        if growth < 1 / 2:
            break
    else:
        raise NoLimitError(
            "No deviation can be proven for these parameters: the curve may not converge."
            " Bring alpha, beta and gamma closer to a preset."
        )
    samples = table(level)
    start = samples[:, :1]
    # The points that the right end reads lie one place further.
    end = np.vstack([np.zeros((1, 1)), start[:-1]])
    tau = np.arange(2**level) / 2**level
    error = samples - (1 - tau) * start - tau * end
    kernel = np.cumsum(np.cumsum(error, axis=0), axis=0)[:-2]
    largest = float(np.abs(kernel).sum(axis=0).max())
    return largest / (1 - growth) * ROUNDING
