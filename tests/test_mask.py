"""Masks as exact Laurent polynomials."""

from fractions import Fraction
from math import lcm

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.mask import Mask, Stencil

MASKS = st.builds(
    Mask,
    st.integers(-9, 9),
    st.lists(st.fractions(-3, 3, max_denominator=16), max_size=8).map(tuple),
)
POINT = st.sampled_from([Fraction(2), Fraction(-3, 5), Fraction(1), Fraction(-1)])


def test_zeros_at_the_ends_are_trimmed_so_that_equal_symbols_are_equal_masks():
    assert Mask(3, (Fraction(0), Fraction(1), Fraction(0))) == Mask(4, (Fraction(1),))
    assert Mask(3, (Fraction(0),)) == Mask(0, ())
    assert hash(Mask(3, (Fraction(0), Fraction(1)))) == hash(Mask(4, (Fraction(1),)))


@given(MASKS, MASKS, POINT)
def test_sums_and_products_are_those_of_the_symbols(a, b, z):
    assert (a + b).symbol(z) == a.symbol(z) + b.symbol(z)
    assert (a - b).symbol(z) == a.symbol(z) - b.symbol(z)
    assert (a * b).symbol(z) == a.symbol(z) * b.symbol(z)
    assert a.shifted(3).symbol(z) == z**3 * a.symbol(z)
    assert a.scaled(Fraction(2, 7)).symbol(z) == Fraction(2, 7) * a.symbol(z)
    assert a.alternated().symbol(z) == a.symbol(-z)


@given(MASKS)
def test_the_two_stencils_hold_the_whole_mask(a):
    assert Mask.from_stencils(a.even, a.odd) == a


def test_a_stencil_is_the_row_of_one_new_point():
    a = Mask(-1, tuple(Fraction(c) for c in (1, 2, 3, 4)))
    assert a.even == Stencil(-1, (Fraction(4), Fraction(2)))
    assert a.odd == Stencil(0, (Fraction(3), Fraction(1)))


@given(MASKS, st.integers(0, 4))
def test_dividing_undoes_multiplying_by_one_plus_z(a, power):
    one_plus_z = Mask(0, (Fraction(1), Fraction(1)))
    product = a
    for _ in range(power):
        product = product * one_plus_z
    assert product.divided(power) == a


def test_an_inexact_division_is_refused():
    with pytest.raises(ArithmeticError, match="1 \\+ z"):
        Mask(0, (Fraction(1), Fraction(2))).divided()


def test_factoring_finds_the_full_multiplicity():
    quotient = Mask(2, (Fraction(3), Fraction(1)))
    product = quotient
    for _ in range(5):
        product = product * Mask(0, (Fraction(1), Fraction(1)))
    assert product.factored() == (5, quotient)


def test_coefficients_outside_the_support_are_zero():
    a = Mask(-2, (Fraction(1), Fraction(5)))
    assert [a[i] for i in (-3, -2, -1, 0)] == [0, 1, 5, 0]
    assert not a.values.flags.writeable


@given(MASKS)
def test_the_integers_of_a_mask_are_its_coefficients_in_lowest_terms(a):
    assert a.denominator == lcm(*(c.denominator for c in a.coefficients))
    assert tuple(Fraction(n, a.denominator) for n in a.numerators) == a.coefficients
    scaled = Mask.over(a.start - 1, [0, *(3 * n for n in a.numerators), 0], 3 * a.denominator)
    assert (scaled, hash(scaled)) == (a, hash(a))
