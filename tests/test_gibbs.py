"""The step response and its overshoot."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.family import PRESETS, Parameters
from core.flatten import chord_constant, second_difference_norm
from core.gibbs import StepResponse
from core.limit import LimitCurve
from oracles import convergent_members, step_value
from reference import ROWS


@given(convergent_members(), st.integers(0, 4))
def test_the_step_response_is_the_limit_curve_of_a_step(parameters, level):
    step = StepResponse(parameters.mask)
    data = np.array([1.0] * 20 + [0.0] * 20)
    curve = LimitCurve(np.column_stack([np.arange(40), data]), parameters.mask, False).points(level)
    t = BasicLimitFunction(parameters.mask).parameters(max(level, 1))
    places = np.rint((t + 19) * 2**level).astype(int)
    on_grid = np.abs((t + 19) * 2**level - places) < 1e-9
    np.testing.assert_allclose(
        step.values(max(level, 1))[on_grid], curve[places[on_grid], 1], atol=1e-12
    )


@given(convergent_members(), st.integers(0, 8 * 16))
def test_values_are_the_exact_sums(parameters, k):
    phi = BasicLimitFunction(parameters.mask)
    values = StepResponse(parameters.mask).values(3)
    k = k % len(values)
    exact = step_value(phi, phi.mask.start + Fraction(k, 8))
    assert values[k] == pytest.approx(float(exact), abs=1e-13)


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_overshoot_and_undershoot(row):
    step = StepResponse(row.parameters.mask)
    assert step.overshoot == pytest.approx(row.overshoot, abs=5.1e-7)
    assert step.undershoot == pytest.approx(row.undershoot, abs=5.1e-7)


@pytest.mark.parametrize(
    ("parameters", "low", "high"),
    [
        (Parameters(1, 1, 1), 0.7279962, 0.7279963),
        (Parameters("3/10", "-3/5", "-1/5", "mirrored"), 0.0174824, 0.0174856),
    ],
    ids=str,
)
def test_two_overshoots_of_the_theory_are_refuted_by_a_proven_interval(parameters, low, high):
    """Between samples S leaves the chord by at most the chord bound; its data bend by at most 1."""
    mask, level = parameters.mask, 15
    sampled = StepResponse(mask).values(level).max() - 1
    bound = chord_constant(mask) * second_difference_norm(mask, level)
    assert low <= sampled
    assert sampled + bound <= high
    printed = {1: 0.727993, Fraction(3, 10): 0.017488}[parameters.alpha]
    assert not sampled - 5e-7 <= printed <= sampled + bound + 5e-7


def test_the_bspline_does_not_overshoot_at_all():
    step = StepResponse(PRESETS["B-spline"].mask)
    assert step.overshoot < 1e-14
    assert step.undershoot < 1e-14


@given(convergent_members())
def test_the_step_falls_from_one_to_zero(parameters):
    values = StepResponse(parameters.mask).values(4)
    assert values[0] == pytest.approx(1, abs=1e-13)
    assert values[-1] == pytest.approx(0, abs=1e-13)
