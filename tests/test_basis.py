"""The basic limit function against the refinement equation and the B-spline in closed form."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core.basis import VIEWED, BasicLimitFunction
from core.continuity import certificate
from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.mask import Mask
from core.parents import bspline
from oracles import bspline_value, convergent_members, fractions
from reference import LIMIT_STENCILS

EPS = np.finfo(float).eps


def test_integer_values_solve_the_refinement_equation_exactly():
    for parameters in PRESETS.values():
        phi = BasicLimitFunction(parameters.mask)
        values = phi.integer_values
        assert sum(values.values()) == 1
        for j, value in values.items():
            assert value == sum(a * values.get(2 * j - i, 0) for i, a in phi.mask.items())


def test_bspline_member_has_the_values_of_the_bspline():
    phi = BasicLimitFunction(bspline())
    for k in range(-1, 13 * 8 + 2):
        x = phi.mask.start + Fraction(k, 8)
        assert phi.at(x) == bspline_value(12, Fraction(k, 8))


@given(convergent_members(), st.integers(0, 5))
def test_float_values_are_the_exact_ones_rounded(parameters, level):
    phi = BasicLimitFunction(parameters.mask)
    values = phi.values(level)
    width = phi.mask.end - phi.mask.start
    assert values.shape == (width * 2**level + 1,)
    # Each of the levels adds a few roundings of sums with weights of total size below 3.
    for k in range(0, len(values), max(1, len(values) // 7)):
        exact = phi.at(phi.mask.start + Fraction(k, 2**level))
        assert abs(values[k] - float(exact)) <= 16 * (level + 1) * EPS


@given(convergent_members(), st.integers(0, 6))
def test_all_shifts_of_phi_sum_to_one_everywhere(parameters, level):
    table = BasicLimitFunction(parameters.mask).table(level)
    np.testing.assert_allclose(table.sum(axis=0), 1.0, atol=1e-13)


@given(convergent_members())
def test_the_table_holds_phi_at_the_places_it_says(parameters):
    phi = BasicLimitFunction(parameters.mask)
    for level in (0, 1, 3):
        table = phi.table(level)
        for r in range(0, len(table), 3):
            for m in range(2**level):
                x = Fraction(m, 2**level) + Fraction(1, 2) - (r + 1 - phi.mask.end)
                assert table[r, m] == pytest.approx(float(phi.at(x)), abs=1e-14)


@given(convergent_members(), st.integers(0, 1023))
def test_weights_anywhere_agree_with_the_table(parameters, m):
    phi = BasicLimitFunction(parameters.mask)
    np.testing.assert_allclose(phi.weights(m / 1024), phi.table(10)[:, m], atol=1e-14)


@given(convergent_members(), st.floats(0, 1, exclude_max=True))
def test_weights_anywhere_sum_to_one_and_reproduce_linear_data(parameters, tau):
    phi = BasicLimitFunction(parameters.mask)
    weights = phi.weights(tau)
    places = np.arange(len(weights)) + 1 - phi.mask.end
    assert weights.sum() == pytest.approx(1, abs=1e-13)
    assert weights @ places == pytest.approx(tau, abs=1e-12)


def test_support_is_17_in_general_13_for_the_parents_and_one_sided_where_a_neighbour_is_missing():
    def support(*parameters):
        return BasicLimitFunction(Parameters(*parameters).mask).support

    assert support("1/4", "-1/2", "1/4") == (Fraction(-17, 2), Fraction(17, 2))
    assert support(0, 0, 0) == support(0, -1, 0) == (Fraction(-13, 2), Fraction(13, 2))
    assert support("1/4", "-1/2", 0) == (Fraction(-13, 2), Fraction(17, 2))
    assert support(0, "-1/2", "1/4") == (Fraction(-17, 2), Fraction(13, 2))


@given(fractions(1), fractions(1), fractions(1))
def test_phi_vanishes_outside_its_support(a, b, g):
    phi = BasicLimitFunction(Parameters(a, b, g).mask)
    low, high = phi.support
    assert phi.at(low + Fraction(1, 2)) == phi.at(high + Fraction(1, 2)) == 0
    assert phi.at(Fraction(40)) == phi.at(Fraction(-40)) == 0


@pytest.mark.parametrize("parameters", LIMIT_STENCILS, ids=str)
def test_reference_limit_stencils(parameters):
    stencil = BasicLimitFunction(Parameters(*parameters).mask).limit_stencil()
    weights = dict(stencil.items())
    for j, expected in enumerate(LIMIT_STENCILS[parameters]):
        assert float(weights[j]) == pytest.approx(expected, abs=5e-7)
        assert weights[-j] == weights[j]
    assert sum(weights.values()) == 1


def test_only_dyadic_places_have_an_exact_value():
    with pytest.raises(ValueError, match="dyadic"):
        BasicLimitFunction(bspline()).at(Fraction(1, 3))


@given(convergent_members(["translated", "mirrored"]))
def test_quick_tables_are_those_of_exact_values_to_1e_14(parameters):
    quick = BasicLimitFunction(parameters.mask)
    exact = BasicLimitFunction(parameters.mask, is_exact=True)
    size = np.abs(exact.values(VIEWED)).max()
    for level in (0, 3, VIEWED):
        np.testing.assert_allclose(quick.values(level), exact.values(level), atol=1e-14 * size)
        np.testing.assert_allclose(quick.table(level), exact.table(level), atol=1e-14 * size)


@given(convergent_members(["translated", "mirrored"]))
def test_so_are_quick_derivatives_where_there_is_one(parameters):
    assume((certificate(parameters.mask).order or 0) >= 1)
    quick = BasicLimitFunction(parameters.mask)
    exact = BasicLimitFunction(parameters.mask, is_exact=True)
    slopes = exact.values(VIEWED, 1)
    np.testing.assert_allclose(quick.values(VIEWED, 1), slopes, atol=1e-14 * np.abs(slopes).max())


@pytest.mark.parametrize("order", [0, 1, 2])
def test_coarse_levels_are_views_of_the_finest(order):
    phi = BasicLimitFunction(PRESETS["Tight"].mask)
    finest = phi.values(VIEWED, order)
    for level in range(VIEWED):
        values = phi.values(level, order)
        assert np.shares_memory(values, finest)
        np.testing.assert_array_equal(values, finest[:: 2 ** (VIEWED - level)])
    assert not np.shares_memory(phi.values(VIEWED + 1, order), finest)


def test_a_scheme_without_a_unique_limit_says_so():
    # Its matrix over the interior {-1, 0} is [[2, 1], [-1, 0]]: 1 is a double eigenvalue, and the
    # only eigenvector (1, -1) cannot be scaled to sum 1.
    phi = BasicLimitFunction(Mask(-2, tuple(Fraction(c) for c in (1, 2, 0, -1))))
    with pytest.raises(NoLimitError, match="no unique limit"):
        _ = phi.integer_values
    with pytest.raises(NoLimitError, match="no unique limit"):
        phi.values(3)
