"""The certificate of Theorem 2.1: exact against float, reference values, divergent members."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.continuity import Convergence, certificate, derived, iterated_norm, smoothness
from core.family import PRESETS, Parameters
from core.mask import Mask
from oracles import members
from reference import ROWS


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_certificates(row):
    found = certificate(row.parameters.mask, exact=True)
    assert (found.order, found.iterations) == row.certificate
    assert isinstance(found.norm, Fraction)
    assert float(found.norm) == pytest.approx(row.norm, abs=5.1e-5)


@given(members())
def test_floats_and_fractions_name_the_same_class(parameters):
    quick, exact = certificate(parameters.mask), certificate(parameters.mask, exact=True)
    assert (quick.order, quick.iterations) == (exact.order, exact.iterations)
    if exact.order is not None:
        assert exact.norm < 1
        assert float(exact.norm) == pytest.approx(quick.norm, rel=1e-9)


@given(members(), st.integers(1, 3))
def test_the_norm_is_that_of_the_product_of_spread_masks(parameters, iterations):
    b = derived(parameters.mask, 1)
    product = Mask(0, (Fraction(1),))
    for k in range(iterations):
        product = product * Mask.from_mapping({2**k * i: c for i, c in b.items()})
    period = 2**iterations
    sums = [Fraction(0)] * period
    for i, c in product.items():
        sums[i % period] += abs(c)
    assert iterated_norm(b, iterations) == max(sums)


@given(members(["translated"]))
def test_no_smaller_number_of_iterations_and_no_higher_class_is_proven(parameters):
    found = certificate(parameters.mask)
    if found.order is None:
        return
    b = derived(parameters.mask, found.order)
    for fewer in range(1, min(found.iterations, 4)):
        assert iterated_norm(b, fewer) >= 1
    if found.order + 1 < parameters.mask.factored()[0]:
        higher = derived(parameters.mask, found.order + 1)
        assert all(iterated_norm(higher, k) >= 1 for k in (1, 2, 3))


def test_a_norm_of_exactly_one_is_not_below_one():
    """Where floats cannot tell a norm from 1, the fraction decides: (1+z)^13 is C^11, not C^12."""
    assert iterated_norm(derived(PRESETS["B-spline"].mask, 12), 5) == 1
    assert certificate(PRESETS["B-spline"].mask).order == 11


def test_divergent_members_have_no_certificate():
    found = certificate(Parameters(10, 0, 0).mask)
    assert (found.order, found.iterations, found.norm) == (None, None, None)


def test_a_class_needs_its_factors():
    with pytest.raises(ArithmeticError):
        derived(Parameters("1/10", -1, "-1/10", "mirrored").mask, 3)


@pytest.mark.parametrize("corner", list(np.ndindex(2, 2, 2)), ids=str)
def test_translated_members_of_the_unit_box_are_proven_continuous(corner):
    signs = [2 * c - 1 for c in corner]
    assert certificate(Parameters(*signs).mask).order >= 1


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_the_class_is_known_from_both_sides(row):
    found = smoothness(row.parameters.mask)
    assert found.order >= row.certificate[0]
    assert found.not_class > found.order
    assert found.convergence is Convergence.PROVEN


def test_a_rough_member_is_continuous_and_proven_not_to_be_smoother():
    found = smoothness(Parameters("1/2", 0, "-1/2", "mirrored").mask)
    assert 0 < found.exponent.lower < found.exponent.upper < 1
    assert (found.order, found.not_class) == (0, 1)
    assert found.convergence is Convergence.PROVEN


def test_a_member_with_a_negative_exponent_is_proven_divergent():
    found = smoothness(Parameters(1, 0, -1, "mirrored").mask)
    assert found.exponent.upper < 0
    assert (found.order, found.not_class) == (None, 0)
    assert found.convergence is Convergence.DISPROVEN


@given(members())
def test_no_class_is_both_proven_and_disproven(parameters):
    found = smoothness(parameters.mask)
    assert found.order is None or found.order < found.not_class
