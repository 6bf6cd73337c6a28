"""The basic limit function phi: support, exact dyadic values, limit stencils, evaluation table.

Notes
-----
``phi`` is indexed by the symbol: ``phi(x) = sum_i a_i phi(2x - i)``, so its support is
``[start, end]`` of the mask. All schemes here are dual: with control point ``p_i`` at the curve
parameter ``t = i``, the curve is ``C(t) = sum_i p_i phi(t - i + 1/2)`` (theory, section 1).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from math import lcm
from operator import mul

import numpy as np
from numpy.typing import NDArray

from core.errors import NoLimitError
from core.mask import Mask, Stencil

HALF = Fraction(1, 2)
"""Shift between the symbol's variable x and the curve parameter: x = t + 1/2 (dual schemes)."""

MEMORY = 128
"""Number of tables and value arrays kept: a few masks at all levels, while a slider moves."""

VIEWED = 10
"""Dyadic level up to which values are computed at once; coarser levels are a part of them."""

_NO_LIMIT = "This scheme has no unique limit curve for these parameters; move a slider a little."


@dataclass(frozen=True)
class BasicLimitFunction:
    """The limit of the scheme on the data 1 at ``t = 0`` and 0 at all other integers.

    Parameters
    ----------
    mask
        Mask of a scheme whose rules sum to 1. For a scheme that does not converge the values at
        each dyadic level are still those of the refinement equation, but they grow from level to
        level.
    is_exact
        Whether tables start from the exact values at the integers, rounded, or from those of a
        solve in floats, ten times as fast: while a hand moves parameters. Both agree to 1e-14.

    Raises
    ------
    NoLimitError
        By the members that need values, if 1 is not a simple eigenvalue of the integer matrix.
    """

    mask: Mask
    is_exact: bool = False

    @property
    def support(self) -> tuple[Fraction, Fraction]:
        """Ends of the support in t; the support in x is ``[mask.start, mask.end]``."""
        return self.mask.start - HALF, self.mask.end - HALF

    @cached_property
    def integer_values(self) -> dict[int, Fraction]:
        """Exact values ``phi(j)``, j = start..end (theory, section 6).

        They are the eigenvector for eigenvalue 1 of ``M_{jk} = a_{2j-k}`` over the interior of
        the support, scaled to sum 1.
        """
        inner = range(self.mask.start + 1, self.mask.end)
        # The columns of M sum to 1, so the rows of M - I sum to zero: any one of them can give
        # way to the normalisation.
        rows = [[self.mask[2 * j - k] - (j == k) for k in inner] for j in inner[1:]]
        rows.append([Fraction(1)] * len(inner))
        right = [Fraction(0)] * (len(inner) - 1) + [Fraction(1)]
        solution = _solved(rows, right)
        values = dict.fromkeys(range(self.mask.start, self.mask.end + 1), Fraction(0))
        values.update(zip(inner, solution, strict=True))
        return values

    def at(self, x: Fraction) -> Fraction:
        """Exact value ``phi(x)`` at a dyadic ``x`` (denominator a power of two).

        Raises
        ------
        ValueError
            If x is not dyadic.
        """
        if x.denominator & (x.denominator - 1):
            raise ValueError(f"{x} is not dyadic")
        return _exact_value(self, x)

    def derived(self, order: int) -> BasicLimitFunction:
        """Basic limit function of the scheme ``2^order a(z) / (1+z)^order`` (theory, section 6).

        The derivative of a curve of phi is the curve of this function whose control points are the
        differences ``p_i - p_(i-1)`` of that order, at the same parameters; so its own derivative
        of that order is the backward difference of it.
        """
        return BasicLimitFunction(
            self.mask.divided(order).scaled(Fraction(2**order)), self.is_exact
        )

    def limit_stencil(self, t: Fraction = Fraction(0)) -> Stencil:
        """Exact weights of the control points ``p_j`` in the curve point ``C(t)``, t dyadic."""
        first = (t + HALF - self.mask.end).__floor__() + 1
        last = (t + HALF - self.mask.start).__ceil__() - 1
        weights = {j: self.at(t + HALF - j) for j in range(first, last + 1)}
        return Stencil.from_mapping(weights)

    def tangent_stencil(self, t: Fraction = Fraction(0)) -> Stencil:
        """Exact weights of the control points in the derivative ``C'(t)``, t dyadic.

        ``phi'(x) = psi(x) - psi(x - 1)`` with the basic limit function psi of the scheme
        ``2 a(z) / (1+z)`` (theory, section 6). The scheme must be C^1.
        """
        psi = BasicLimitFunction(self.mask).derived(1)
        first = (t + HALF - self.mask.end).__floor__() + 1
        last = (t + HALF - self.mask.start).__ceil__() - 1
        places = {j: t + HALF - j for j in range(first, last + 1)}
        return Stencil.from_mapping({j: psi.at(x) - psi.at(x - 1) for j, x in places.items()})

    @cached_property
    def _float_integer_values(self) -> NDArray[np.float64]:
        """The values of `integer_values` in floats, start..end."""
        if self.is_exact:
            return np.array([float(value) for value in self.integer_values.values()])
        matrix = _digit_matrix(self.mask, 0)[1:-1, 1:-1] - np.eye(len(self.mask.values) - 2)
        matrix[0] = 1.0
        right = np.zeros(len(matrix))
        right[0] = 1.0
        try:
            solution = np.linalg.solve(matrix, right)
        except np.linalg.LinAlgError:
            raise NoLimitError(_NO_LIMIT) from None
        if not np.isfinite(solution).all():
            raise NoLimitError(_NO_LIMIT)
        return np.concatenate([[0.0], solution, [0.0]])

    def values(self, level: int, order: int = 0) -> NDArray[np.float64]:
        """Values of phi, or of a derivative, at all dyadic points of a level, rounded to floats.

        Parameters
        ----------
        level
            The points are ``x = start + k / 2^level``.
        order
            Which derivative, 0 for phi itself. The order-d derivative is the d-fold backward
            difference of the basic limit function of the scheme ``2^d a(z) / (1+z)^d`` (theory,
            section 6). It exists for schemes that are C^order, which the caller makes sure of.

        Returns
        -------
        ndarray
            Shape ``((end - start) 2^level + 1,)``, read-only; the first and last value are 0. Up to
            level `VIEWED` all levels are views of one array.
        """
        held = max(level, VIEWED)
        values = _float_values(self, held) if order == 0 else _derivative(self, held, order)
        return values[:: 1 << (held - level)]

    def parameters(self, level: int) -> NDArray[np.float64]:
        """Curve parameters t of the entries of `values`: ``start - 1/2 + k / 2^level``."""
        width = self.mask.end - self.mask.start
        offsets: NDArray[np.float64] = np.arange(width * 2**level + 1) / 2**level
        return float(self.support[0]) + offsets

    def table(self, level: int, order: int = 0) -> NDArray[np.float64]:
        """Evaluation table of one span (theory, section 6).

        Parameters
        ----------
        level
            The span ``[i, i+1)`` is evaluated at ``t = i + m / 2^level``.
        order
            Which derivative with respect to t, as in `values`.

        Returns
        -------
        ndarray
            ``B[r, m]``, shape ``(end - start + 1, 2^level)``, with
            ``C(i + m / 2^level) = sum_r B[r, m] p_{i + r + 1 - end}``.
        """
        return self.span_table(level, order)[:, :-1]

    def span_table(self, level: int, order: int = 0) -> NDArray[np.float64]:
        """Evaluation table of a closed span: `table` with one column more, for ``t = i + 1``."""
        return _table(self, level, order)

    def cell_table(self, level: int) -> NDArray[np.float64]:
        """Evaluation table of a cell ``[i - 1/2, i + 1/2]`` of the dual grid, both ends included.

        Returns
        -------
        ndarray
            ``B[r, m]``, shape ``(end - start, 2^level + 1)``, with
            ``C(i - 1/2 + m / 2^level) = sum_r B[r, m] p_{i + r + 1 - end}``. It has one row less
            than `table`, because the support of phi ends where cells do; see `core.cells`.
        """
        return _cell_table(self, level)

    def weights(self, tau: float) -> NDArray[np.float64]:
        """Weights of the control points in a curve point at any place of a span.

        Parameters
        ----------
        tau
            Place in the span, 0 <= tau < 1; a float is a dyadic number, so the result is exact up
            to rounding.

        Returns
        -------
        ndarray
            Shape (end - start + 1,), as in `table`:
            ``C(i + tau) = sum_r w[r] p_{i + r + 1 - end}``.

        Notes
        -----
        The vector of all whole shifts, ``Phi(y)_k = phi(y + k)``, obeys
        ``Phi(y) = T_e Phi(2y - e)``, ``(T_e)_{kl} = a_{2k + e - l}``, with e the first binary digit
        of y; the digits of a float end after some 53 steps at ``Phi(0)``, the integer values.
        """
        y = tau + 0.5
        shift = int(y >= 1)
        y -= shift
        digits = []
        while y:
            y *= 2
            digits.append(int(y >= 1))
            y -= digits[-1]
        matrices = _digit_matrix(self.mask, 0), _digit_matrix(self.mask, 1)
        values = self._float_integer_values
        for digit in reversed(digits):
            values = matrices[digit] @ values
        # Row r holds phi(tau + 1/2 - s), s = r + 1 - end: entry shift - s of Phi, counted from
        # the start of the support.
        places = shift - (np.arange(len(values)) + 1 - self.mask.end) - self.mask.start
        inside = (places >= 0) & (places < len(values))
        return np.where(inside, values[np.clip(places, 0, len(values) - 1)], 0.0)


@lru_cache(maxsize=MEMORY)
def _digit_matrix(mask: Mask, digit: int) -> NDArray[np.float64]:
    """Matrix ``a_{2k + digit - l}``, k and l = start..end."""
    shifts = np.arange(mask.start, mask.end + 1)
    index = 2 * shifts[:, None] + digit - shifts[None, :] - mask.start
    inside = (index >= 0) & (index < len(mask.values))
    return np.where(inside, mask.values[np.clip(index, 0, len(mask.values) - 1)], 0.0)


def _solved(rows: list[list[Fraction]], right: list[Fraction]) -> list[Fraction]:
    """Solution of a square linear system, exact: elimination without fractions.

    After step k all entries are minors of order k + 1, so that the division by the pivot before
    leaves no remainder (Bareiss, Math. Comp. 22, 1968), and numbers grow slowly.
    """
    size = len(rows)
    system = []
    for row, value in zip(rows, right, strict=True):
        scale = lcm(*(entry.denominator for entry in (*row, value)))
        system.append([int(entry * scale) for entry in (*row, value)])
    before = 1
    for k in range(size):
        pivot = next((r for r in range(k, size) if system[r][k]), None)
        if pivot is None:
            raise NoLimitError(_NO_LIMIT)
        system[k], system[pivot] = system[pivot], system[k]
        lead = system[k]
        for below in system[k + 1 :]:
            factor = below[k]
            for column in range(k, size + 1):
                below[column] = (below[column] * lead[k] - factor * lead[column]) // before
        before = lead[k]
    # Cramer's rule: the last pivot is the determinant, and a denominator of all that is solved.
    numerators: list[int] = []
    for k in reversed(range(size)):
        known = sum(map(mul, system[k][-2:k:-1], numerators))
        numerators.append((system[k][-1] * before - known) // system[k][k])
    return [Fraction(numerator, before) for numerator in reversed(numerators)]


@lru_cache(maxsize=2**16)
def _exact_value(phi: BasicLimitFunction, x: Fraction) -> Fraction:
    """Value at a dyadic x by the refinement equation, down to the integers."""
    mask = phi.mask
    if not mask.start < x < mask.end:
        return Fraction(0)
    if x.denominator == 1:
        return phi.integer_values[int(x)]
    return sum((a * _exact_value(phi, 2 * x - i) for i, a in mask.items()), Fraction(0))


@lru_cache(maxsize=MEMORY)
def _float_values(phi: BasicLimitFunction, level: int) -> NDArray[np.float64]:
    """Level by level: ``Phi(y) = T_e Phi(2y - e)``, see `weights`, for all y of a level at once."""
    if level == 0:
        values = phi._float_integer_values
    else:
        width = phi.mask.end - phi.mask.start
        coarse = _float_values(phi, level - 1)
        half = 2 ** (level - 1)
        # Column m is Phi(m / half), and phi(end + y) = 0 is its last entry.
        columns = np.zeros((width + 1, half))
        columns[:-1] = coarse[:-1].reshape(width, half)
        values = np.zeros(2 * width * half + 1)
        rows = values[:-1].reshape(width, 2 * half)
        for digit in (0, 1):
            matrix = _digit_matrix(phi.mask, digit)[:-1]
            np.matmul(matrix, columns, out=rows[:, digit * half : (digit + 1) * half])
    values.flags.writeable = False
    return values


@lru_cache(maxsize=MEMORY)
def _derivative(phi: BasicLimitFunction, level: int, order: int) -> NDArray[np.float64]:
    """Backward differences of the basic limit function of the divided-difference scheme."""
    step = 2**level
    values = np.zeros((phi.mask.end - phi.mask.start) * step + 1)
    coarse = phi.derived(order).values(level)
    values[: len(coarse)] = coarse
    for _ in range(order):
        values[step:] -= values[:-step].copy()
    values.flags.writeable = False
    return values


@lru_cache(maxsize=MEMORY)
def _table(phi: BasicLimitFunction, level: int, order: int) -> NDArray[np.float64]:
    """Cut phi, half a span ahead of its support, into spans; the last one is row 0."""
    fine = max(level, 1)
    half = 2 ** (fine - 1)
    padded = np.concatenate([np.zeros(half), phi.values(fine, order), np.zeros(half - 1)])
    spans = padded.reshape(-1, 2**fine)
    table = np.zeros((len(spans), 2**level + 1))
    table[:, :-1] = spans[::-1, :: 2 ** (fine - level)]
    # The end is the start of the next span, whose window lies one point further on.
    table[1:, -1] = table[:-1, 0]
    table.flags.writeable = False
    return table


@lru_cache(maxsize=MEMORY)
def _cell_table(phi: BasicLimitFunction, level: int) -> NDArray[np.float64]:
    """Cut phi into the unit intervals of x; the last one is row 0."""
    width = phi.mask.end - phi.mask.start
    table = np.zeros((width, 2**level + 1))
    table[:, :-1] = phi.values(level)[:-1].reshape(width, -1)[::-1]
    table[1:, -1] = table[:-1, 0]
    table.flags.writeable = False
    return table
