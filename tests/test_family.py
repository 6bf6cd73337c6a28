"""The family: theorems of the theory, section 5, and the reading of parameters."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import ParameterError
from core.family import MAX_PARAMETER, PRESETS, Parameters, exact, one_parameter, two_parameter
from core.limit import LimitCurve
from core.parents import bspline, lagrange
from oracles import convergent_members, fractions, members, reproduces
from reference import ROWS


@given(members())
def test_both_rules_sum_to_one_and_reproduce_linear_data(parameters):
    mask = parameters.mask
    assert sum(mask.even.weights) == 1
    assert sum(mask.odd.weights) == 1
    assert reproduces(mask, 1)


@given(members(), fractions())
def test_the_mask_is_affine_in_each_parameter(parameters, other):
    p = parameters
    for name in ("alpha", "beta", "gamma"):
        values = {"alpha": p.alpha, "beta": p.beta, "gamma": p.gamma}
        zero, one, there = (
            Parameters(**{**values, name: v}, neighbours=p.neighbours).mask for v in (0, 1, other)
        )
        assert there == zero + (one - zero).scaled(other)


@given(members(["translated"]))
def test_degrees_reproduced_are_those_of_the_theorem(parameters):
    a, b, g = parameters.alpha, parameters.beta, parameters.gamma
    mask = parameters.mask
    assert reproduces(mask, 2) == (a + b + g == 0)
    assert reproduces(mask, 3) == (a + b + g == 0 and a == g)
    assert reproduces(mask, 6) == (a == b == g == 0)


@given(fractions(), fractions())
def test_quadratics_and_cubics_are_reproduced_on_their_planes(a, g):
    assert reproduces(Parameters(a, -a - g, g).mask, 2)
    assert reproduces(Parameters(a, -2 * a, a).mask, 3)


@given(members(["translated"]))
def test_multiplicity_of_one_plus_z_is_that_of_the_theorem(parameters):
    a, b, g = parameters.alpha, parameters.beta, parameters.gamma
    multiplicity = parameters.mask.factored()[0]
    assert multiplicity >= 7
    assert (multiplicity >= 8) == (a + b + g == -1)
    assert (multiplicity >= 9) == (a + b + g == -1 and a == g)
    assert (multiplicity >= 13) == (parameters.mask == bspline())


@given(fractions(), fractions())
def test_multiplicity_grows_on_its_planes(a, g):
    assert Parameters(a, -1 - a - g, g).mask.factored()[0] >= 8
    assert Parameters(a, -1 - 2 * a, a).mask.factored()[0] >= 9


@given(members(["mirrored"]))
def test_mirrored_with_different_neighbours_keeps_only_three_factors(parameters):
    if parameters.alpha != parameters.gamma:
        assert parameters.mask.factored()[0] == 3


@given(fractions(), fractions())
def test_both_readings_agree_when_alpha_is_gamma(a, b):
    assert Parameters(a, b, a, "mirrored").mask == Parameters(a, b, a).mask


@given(members(["mirrored"]))
def test_mirrored_masks_are_symmetric(parameters):
    assert parameters.mask.is_symmetric


@given(fractions(), fractions(), fractions())
def test_translated_masks_are_symmetric_exactly_when_alpha_is_gamma(a, b, g):
    assert Parameters(a, b, g).mask.is_symmetric == (a == g)


@given(fractions(), fractions(), fractions())
def test_mirrored_swaps_alpha_and_gamma_in_the_odd_rule(a, b, g):
    mask = Parameters(a, b, g, "mirrored").mask
    assert mask.even == Parameters(a, b, g).mask.even
    assert mask.odd == Parameters(g, b, a).mask.odd


def test_named_members_and_sub_schemes():
    assert Parameters(0, 0, 0).mask == lagrange()
    assert Parameters(0, -1, 0).mask == bspline()
    assert one_parameter("-1/2").mask == (lagrange() + bspline()).scaled(Fraction(1, 2))
    assert two_parameter("1/4", "-1/2") == PRESETS["Tight"]
    assert {name: parameters.name for name, parameters in PRESETS.items()} == {
        name: name for name in PRESETS
    }
    assert Parameters(0, "1/7", 0).name is None


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_multiplicity_and_reproduction(row):
    mask = row.parameters.mask
    assert mask.factored()[0] == row.multiplicity
    assert reproduces(mask, row.reproduction)
    assert not reproduces(mask, row.reproduction + 1)


@given(convergent_members(), st.integers(3, 12), st.booleans(), st.integers(0, 10**6))
def test_reversing_the_polygon_and_the_member_gives_the_same_curve(parameters, n, closed, seed):
    points = np.random.default_rng(seed).normal(size=(n, 2))
    there = LimitCurve(points, parameters.mask, closed).points(3)
    back = LimitCurve(points[::-1], parameters.reversed.mask, closed).points(3)
    # Point j of the reversed polygon is point n - 1 - j, so t there is n - 1 - t here.
    places = (8 * (n - 1) - np.arange(len(back))) % (8 * n)
    np.testing.assert_allclose(back, there[places], atol=1e-12)


@pytest.mark.parametrize(
    ("value", "number"),
    [
        (0.1, Fraction(1, 10)),
        (3, Fraction(3)),
        ("25.4/2", Fraction(127, 10)),
        (" -1/4 ", Fraction(-1, 4)),
        ("\N{MINUS SIGN}.5", Fraction(-1, 2)),
        ("1e-3", Fraction(1, 1000)),
        (Fraction(2, 3), Fraction(2, 3)),
    ],
)
def test_numbers_are_read_exactly(value, number):
    assert exact(value) == number


@pytest.mark.parametrize(
    "value",
    ["", "x", "1/0", "1//2", "1/2/3", "nan", "inf", float("nan"), float("inf"), True, None,
     "1e9999", "9" * 100, "1_000", 5e-324, "0x10", [1]],
)  # fmt: skip
def test_what_is_no_admitted_number_is_refused_by_name(value):
    with pytest.raises(ParameterError, match="gamma"):
        Parameters(0, 0, value)


def test_absurd_parameters_are_refused():
    Parameters(MAX_PARAMETER, -MAX_PARAMETER, 0)
    with pytest.raises(ParameterError, match="beta must lie between -100 and 100"):
        Parameters(0, "100.0001", 0)


def test_an_unknown_reading_is_refused():
    with pytest.raises(ParameterError, match="'translated' or 'mirrored'"):
        Parameters(0, 0, 0, "both")


def test_equal_members_share_one_mask():
    assert Parameters("1/7", "-1/2", "3/11").mask is Parameters("2/14", "-0.5", "3/11").mask
    assert Parameters("1/7", 0, "3/11").mask != Parameters("1/7", 0, "3/11", "mirrored").mask
