"""How far the limit curve can leave its chords, proven.

Notes
-----
Let ``E(t)`` be the difference between the curve on a unit interval of t and the chord between its
ends. It vanishes on linear data, so it is a combination of the second differences of the control
points, ``E(t) = sum_r g_r(t) D2p_r`` (summation by parts, twice), and ``|E| <= c max |D2p|`` with
``c = sup_t sum_r |g_r(t)|``. The same holds for the chords of the interval's 2^L equal parts, with
a constant c_L of their own, and for the difference between the curve and its control polygon, with
p_i at t = i, as all schemes of the family reproduce lines (theory, section 5).

The sup is proven. L refinements, L >= 1, cut a cell ``[i - 1/2, i + 1/2]`` of t, and a span
``[i, i + 1]`` too, into 2^L cells of the refined polygon (theory, section 1), whose second
differences are at most ``rho_L max |D2p|``; rho_L is the norm of the L-fold refinement of second
differences, whose symbol is ``a(z) / (1+z)^2``. So between samples of level m the curve differs
from their chords by at most ``c rho_m``, c the constant of a cell. Let s_m be the largest distance
of such a sample from the chord that is asked about, for data whose second differences are at most
1. Then ``c <= s_m + c rho_m`` for a cell, hence ``c <= s_m / (1 - rho_m)``, and
``c_L <= s_m + c rho_m`` for the parts of cells and spans, m >= L. Norms and samples are floats;
their rounding, some 1e-13 relative, is covered by the factor `ROUNDING`.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.errors import NoLimitError
from core.folding import folded, norm
from core.mask import Mask

ROUNDING: Final = 1 + 1e-10
"""Factor on proven bounds that covers the rounding of the floats they are computed with."""

_SAMPLE_LEVELS: Final = (4, 6, 8, 10)
"""Levels of the samples, tried in turn until refinement halves the second differences."""

_FINER: Final = 4
"""Levels by which samples are finer than the parts whose chords are asked about, at least: what
may lie between them adds a percent."""

_HELD: Final = (6, 8, 10, 12)
"""Levels of the samples that serve all parts that are coarse enough. Bounds of finer parts than
these allow are valid, but less sharp."""

_SIZE_LEVEL: Final = 8
"""Level of the samples of sizes: what the chord bound leaves between them is below 1e-5."""

_FINE: Final = 6
"""Dyadic level at which a curve is drawn that seems to converge, though it is not proven."""

COARSE_LEVEL: Final = 2
"""Dyadic level at which a curve is drawn that refinement does not bring to rest."""


@lru_cache(maxsize=MEMORY)
def second_difference_norm(mask: Mask, level: int) -> float:
    """Norm ``rho_level``: how much ``max |D2p|`` can grow in ``level`` refinements, at most.

    It is ``max_i sum_j |b_{i - 2^level j}|`` of the iterated symbol
    ``b(z) b(z^2) ... b(z^(2^(level-1)))``, ``b = a / (1+z)^2`` (paper, Theorem 2.1).
    """
    if level == 0:
        return ROUNDING
    return norm(_folded(mask, level), level) * ROUNDING


@lru_cache(maxsize=MEMORY)
def _folded(mask: Mask, level: int) -> NDArray[np.float64]:
    """The iterated symbol of second differences: each level comes from the one before."""
    if level == 1:
        return mask.divided(2).values
    return folded(_folded(mask, level - 1), _folded(mask, 1))


@lru_cache(maxsize=MEMORY)
def chord_constant(mask: Mask, level: int = 0) -> float:
    """Constant c of the bound ``|C - chord| <= c max |D2p|`` on a span ``[i, i + 1]``.

    Parameters
    ----------
    mask
        The scheme.
    level
        The chords are those of the ``2^level`` equal parts of the span.

    Returns
    -------
    float
        The maximum runs over the second differences of the points that the span reads.

    Raises
    ------
    NoLimitError
        If refinement is not seen to shrink second differences, so that no bound is proven.
    """
    return _constant(mask, level, in_cell=False)


@lru_cache(maxsize=MEMORY)
def cell_constant(mask: Mask, level: int = 0) -> float:
    """The same on a cell ``[i - 1/2, i + 1/2]`` of the dual grid; see `core.cells`."""
    if level:
        return _constant(mask, level, in_cell=True)
    samples = _sample_level(mask)
    largest = _largest(_off_chords(_kernel(BasicLimitFunction(mask).cell_table(samples))))
    return largest / (1 - second_difference_norm(mask, samples)) * ROUNDING


@lru_cache(maxsize=MEMORY)
def size_constant(mask: Mask) -> float:
    """Constant of the bound ``|C| <= c max |p|``: the sup of ``sum_j |phi(t - j)|``, at least 1.

    It is the largest sample plus what the chord bound leaves between the samples, for data of size
    1, whose second differences are at most 4.
    """
    level = _SIZE_LEVEL
    largest = float(np.abs(BasicLimitFunction(mask).table(level)).sum(axis=0).max())
    rest = 4 * cell_constant(mask) * second_difference_norm(mask, level)
    return (largest + rest) * ROUNDING


class Bounds(NamedTuple):
    """Constants c of bounds ``c max |D2p|`` on a span, over the second differences that it reads.

    Attributes
    ----------
    chord
        Of the distance of the curve from the chord between the ends of the span.
    polygon
        Of its distance from the edge of the control polygon.
    knot
        Of the distance of its ends from the control points there.
    finest
        None for a curve whose refinement is proven to converge. Else the bounds are those of the
        polyline through its points at this dyadic level, whatever they would do beyond.
    """

    chord: float
    polygon: float
    knot: float
    finest: int | None


@lru_cache(maxsize=MEMORY)
def bounds(mask: Mask) -> Bounds:
    """Bounds of the limit curve; where none are proven, those of a finite level.

    Raises
    ------
    NoLimitError
        If the scheme has no unique limit, so that there are no points at any level.
    """
    basis = BasicLimitFunction(mask)
    knots = basis.table(0)[:-1, 0]
    apart = knots - np.eye(len(knots))[mask.end - 1]  # row r weighs p_{i + r + 1 - end}
    knot = _largest(_kernel(apart[:, None])) * ROUNDING
    try:
        chord = chord_constant(mask)
    except NoLimitError:
        finest = COARSE_LEVEL if grows(mask) else _FINE
        samples = basis.span_table(finest)
        chord = _largest(_off_chords(_kernel(samples))) * ROUNDING
        return Bounds(chord, _largest(_off_polygon(samples, mask)) * ROUNDING, knot, finest)
    level = _SAMPLE_LEVELS[0]
    rest = cell_constant(mask) * second_difference_norm(mask, level)
    polygon = (_largest(_off_polygon(basis.span_table(level), mask)) + rest) * ROUNDING
    return Bounds(chord, polygon, knot, None)


@lru_cache(maxsize=MEMORY)
def grows(mask: Mask) -> bool:
    """Whether finer chords miss the curve by more: there is nothing then that they come closer to.

    That is seen, not proven; but where refinement is proven to shrink second differences, and so
    all chords come closer in the end, the answer is no.
    """
    if second_difference_norm(mask, _SAMPLE_LEVELS[0]) < 1 / 2:
        return False
    table = BasicLimitFunction(mask).span_table
    before, after = (
        _largest(_off_chords(_kernel(table(level + 1)), level)) for level in (_FINE - 2, _FINE - 1)
    )
    return after >= before > 0


def _sample_level(mask: Mask) -> int:
    """Level to which refinement at least halves the second differences."""
    for level in _SAMPLE_LEVELS:
        if second_difference_norm(mask, level) < 1 / 2:
            return level
    raise NoLimitError(
        "No deviation can be proven for these parameters: the curve may not converge."
        " Bring alpha, beta and gamma closer to a preset."
    )


def _constant(mask: Mask, level: int, in_cell: bool) -> float:
    """Constant of the parts of a span, or of a cell."""
    samples = max(_sample_level(mask), level + _FINER)
    held = next((finest for finest in _HELD if finest >= samples), None)
    if held is None:  # no sample is looked at inside a part
        return cell_constant(mask) * second_difference_norm(mask, level) * ROUNDING
    kernel = _sample_kernel(mask, held, in_cell)[:, :: 1 << (held - samples)]
    between = cell_constant(mask) * second_difference_norm(mask, samples)
    return (_largest(_off_chords(kernel, level)) + between) * ROUNDING


@lru_cache(maxsize=MEMORY)
def _sample_kernel(mask: Mask, level: int, in_cell: bool) -> NDArray[np.float64]:
    """Kernel of the samples of a span, or of a cell, both ends included."""
    basis = BasicLimitFunction(mask)
    return _kernel(basis.cell_table(level) if in_cell else basis.span_table(level))


def _kernel(weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Double sums of weights of control points.

    Where weights vanish on lines, these are their weights of the second differences; the last two
    rows, of r, are 0 then. Differences of weights have differences of kernels.
    """
    return np.cumsum(np.cumsum(weights, axis=0), axis=0)


def _largest(kernel: NDArray[np.float64]) -> float:
    """Largest sum of the weights of second differences, of errors that vanish on lines."""
    return float(np.abs(kernel[:-2]).sum(axis=0).max())


def _off_chords(kernel: NDArray[np.float64], level: int = 0) -> NDArray[np.float64]:
    """Kernel of the distance of samples from chords.

    Parameters
    ----------
    kernel
        That of samples of an interval, ends included; shape (r, m + 1).
    level
        The chords are those of the ``2^level`` equal parts.

    Returns
    -------
    ndarray
        Shape (r, m).
    """
    inner = kernel[:, :-1].reshape(len(kernel), 1 << level, -1)
    knots = kernel[:, :: inner.shape[2], None]
    tau = np.arange(inner.shape[2]) / inner.shape[2]
    off = knots[:, 1:] - knots[:, :-1]
    off = inner - knots[:, :-1] - tau * off
    return off.reshape(len(kernel), -1)


def _off_polygon(samples: NDArray[np.float64], mask: Mask) -> NDArray[np.float64]:
    """Kernel of the distance of samples of a span, but for its end, from the polygon's edge."""
    off = samples[:, :-1].copy()
    tau = np.arange(off.shape[1]) / off.shape[1]
    # Row r weighs p_{i + r + 1 - end}.
    off[mask.end - 1] -= 1 - tau
    off[mask.end] -= tau
    return _kernel(off)
