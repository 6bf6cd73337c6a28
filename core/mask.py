"""Masks of binary subdivision schemes, as exact Laurent polynomials."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

ONE: Final = Fraction(1)


class Stencil(NamedTuple):
    """One refinement or limit rule: the row that makes one new point.

    Attributes
    ----------
    start
        Offset of the first control point, relative to the point that the rule is named after.
    weights
        Exact weights of ``p_{i+start}, p_{i+start+1}, ...``.
    """

    start: int
    weights: tuple[Fraction, ...]

    @classmethod
    def from_mapping(cls, weights: Mapping[int, Fraction]) -> Stencil:
        """Stencil with ``weights[j]`` at offset ``j``; zeros at the ends are trimmed away."""
        nonzero = [j for j, weight in weights.items() if weight != 0]
        if not nonzero:
            return cls(0, ())
        offsets = range(min(nonzero), max(nonzero) + 1)
        return cls(offsets[0], tuple(weights.get(j, Fraction(0)) for j in offsets))

    @property
    def offsets(self) -> range:
        """Offsets ``j`` of the control points ``p_{i+j}`` that the rule reads."""
        return range(self.start, self.start + len(self.weights))

    def items(self) -> zip[tuple[int, Fraction]]:
        """Pairs (offset, weight)."""
        return zip(self.offsets, self.weights, strict=True)


@dataclass(frozen=True, init=False, repr=False)
class Mask:
    """The mask ``a`` of a binary scheme, ``P_m = sum_j a_{m-2j} p_j`` (paper, eq. 2.1).

    The mask is the column of the scheme: how one old point spreads over the new ones. It is kept
    trimmed (no zero at either end), so equal schemes have equal masks.

    Parameters
    ----------
    start
        Index of the first coefficient.
    coefficients
        Exact coefficients ``a_start, a_{start+1}, ...``; zeros at the ends are trimmed away.

    Attributes
    ----------
    start
        Index of the first coefficient that is not zero.
    numerators, denominator
        The coefficients over their least common denominator, greater than 0. Fractions are reduced
        after every step; chains of sums are ten times as fast in integers.

    Notes
    -----
    The symbol is ``a(z) = sum_i a_i z^i`` (paper, eq. 2.2). Sums and products of masks are those
    of their symbols. The zero polynomial is the mask with no coefficients and ``start`` 0.
    """

    start: int
    numerators: tuple[int, ...]
    denominator: int

    def __init__(self, start: int, coefficients: Iterable[Fraction]) -> None:
        exact = tuple(Fraction(c) for c in coefficients)
        common = lcm(*(c.denominator for c in exact))
        self._take(start, [c.numerator * (common // c.denominator) for c in exact], common)

    @classmethod
    def over(cls, start: int, numerators: Sequence[int], denominator: int) -> Mask:
        """Mask of the coefficients ``numerators[k] / denominator``, a denominator above 0."""
        mask = object.__new__(cls)
        mask._take(start, numerators, denominator)
        return mask

    def _take(self, start: int, numerators: Sequence[int], denominator: int) -> None:
        """Trim and reduce, so that equal symbols have equal attributes."""
        first, last = 0, len(numerators)
        while first < last and not numerators[first]:
            first += 1
        while last > first and not numerators[last - 1]:
            last -= 1
        factor = gcd(denominator, *numerators[first:last])
        kept = tuple(n // factor for n in numerators[first:last])
        object.__setattr__(self, "start", start + first if kept else 0)
        object.__setattr__(self, "numerators", kept)
        object.__setattr__(self, "denominator", denominator // factor)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        # Masks are keys of all caches, and hashed more often than made.
        return hash((self.start, self.numerators, self.denominator))

    def __repr__(self) -> str:
        return f"Mask({self.start}, {self.coefficients})"

    @cached_property
    def coefficients(self) -> tuple[Fraction, ...]:
        """The exact coefficients ``a_start, a_{start+1}, ...``."""
        return tuple(Fraction(n, self.denominator) for n in self.numerators)

    @classmethod
    def combined(cls, *parts: tuple[Fraction, Mask]) -> Mask:
        """Linear combination of masks: the sum of their symbols, each times a number."""
        start = min(mask.start for _, mask in parts)
        end = max(mask.end for _, mask in parts)
        common = lcm(*(number.denominator * mask.denominator for number, mask in parts))
        total = [0] * (end - start + 1)
        for number, mask in parts:
            factor = number.numerator * (common // (number.denominator * mask.denominator))
            for i, n in enumerate(mask.numerators, mask.start - start):
                total[i] += n * factor
        return cls.over(start, total, common)

    @classmethod
    def from_mapping(cls, coefficients: Mapping[int, Fraction]) -> Mask:
        """Mask with coefficient ``coefficients[i]`` at index ``i`` and zero elsewhere."""
        if not coefficients:
            return cls(0, ())
        first, last = min(coefficients), max(coefficients)
        zero = Fraction(0)
        return cls(first, tuple(coefficients.get(i, zero) for i in range(first, last + 1)))

    @classmethod
    def from_stencils(cls, even: Stencil, odd: Stencil) -> Mask:
        """Mask of the rules ``P_{2i+r} = sum_j e^r_j p_{i+j}``: ``a_{r-2j} = e^r_j``."""
        coefficients = {-2 * j: weight for j, weight in even.items()}
        coefficients.update({1 - 2 * j: weight for j, weight in odd.items()})
        return cls.from_mapping(coefficients)

    @property
    def end(self) -> int:
        """Index of the last coefficient."""
        return self.start + len(self.numerators) - 1

    def __getitem__(self, index: int) -> Fraction:
        """Coefficient ``a_index``, zero outside the support."""
        position = index - self.start
        if 0 <= position < len(self.numerators):
            return self.coefficients[position]
        return Fraction(0)

    def items(self) -> enumerate[Fraction]:
        """Pairs (index, coefficient)."""
        return enumerate(self.coefficients, self.start)

    @cached_property
    def values(self) -> NDArray[np.float64]:
        """The coefficients rounded to floats, read-only."""
        values = np.array([n / self.denominator for n in self.numerators])
        values.flags.writeable = False
        return values

    def stencil(self, parity: int) -> Stencil:
        """Rule for the new points ``P_{2i+parity}``: weights ``a_{parity-2j}`` of ``p_{i+j}``."""
        weights = {(parity - i) // 2: c for i, c in self.items() if (i - parity) % 2 == 0}
        return Stencil.from_mapping(weights)

    @property
    def even(self) -> Stencil:
        """Rule for the new points with even index."""
        return self.stencil(0)

    @property
    def odd(self) -> Stencil:
        """Rule for the new points with odd index."""
        return self.stencil(1)

    @property
    def is_symmetric(self) -> bool:
        """Whether the mask is its own mirror image, so that mirrored data give a mirrored curve."""
        return self.numerators == self.numerators[::-1]

    def symbol(self, z: Fraction) -> Fraction:
        """Value of the symbol ``a(z)`` at an exact ``z != 0``."""
        return sum((c * z**i for i, c in self.items()), Fraction(0))

    def __add__(self, other: Mask) -> Mask:
        """Sum of the symbols."""
        return Mask.combined((ONE, self), (ONE, other))

    def __sub__(self, other: Mask) -> Mask:
        """Difference of the symbols."""
        return Mask.combined((ONE, self), (-ONE, other))

    def __mul__(self, other: Mask) -> Mask:
        """Product of the symbols (convolution of the masks)."""
        total = [0] * (len(self.numerators) + len(other.numerators))
        for i, n in enumerate(self.numerators):
            for k, m in enumerate(other.numerators, i):
                total[k] += n * m
        return Mask.over(self.start + other.start, total, self.denominator * other.denominator)

    def scaled(self, factor: Fraction) -> Mask:
        """The symbol times a number."""
        return Mask.over(
            self.start,
            [factor.numerator * n for n in self.numerators],
            factor.denominator * self.denominator,
        )

    def shifted(self, places: int) -> Mask:
        """The symbol times ``z^places``."""
        return Mask.over(self.start + places, self.numerators, self.denominator)

    def alternated(self) -> Mask:
        """The symbol ``a(-z)``: the odd coefficients change sign."""
        return Mask.from_mapping({i: -c if i % 2 else c for i, c in self.items()})

    def divided(self, power: int = 1) -> Mask:
        """Exact quotient of the symbol by ``(1+z)^power``.

        Raises
        ------
        ArithmeticError
            If ``(1+z)^power`` does not divide the symbol.
        """
        numerators = self.numerators
        for _ in range(power):
            numerators, remainder = _divided(numerators)
            if remainder:
                raise ArithmeticError("1 + z does not divide the symbol")
        return Mask.over(self.start, numerators, self.denominator)

    def factored(self) -> tuple[int, Mask]:
        """Split off ``(1+z)``: multiplicity ``m`` and quotient ``a(z) / (1+z)^m``.

        The symbol must not be zero (it would be divisible without end).
        """
        multiplicity, quotient = 0, self.numerators
        while True:
            shorter, remainder = _divided(quotient)
            if remainder:
                return multiplicity, Mask.over(self.start, quotient, self.denominator)
            multiplicity, quotient = multiplicity + 1, shorter


def _divided(numerators: tuple[int, ...]) -> tuple[tuple[int, ...], int]:
    """Quotient of a polynomial by ``1 + z``, with integer coefficients, and the remainder."""
    remainder, quotient = 0, []
    for n in numerators:
        remainder = n - remainder
        quotient.append(remainder)
    return tuple(quotient[:-1]), remainder
