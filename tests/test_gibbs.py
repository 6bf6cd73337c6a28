"""The step response and its overshoot."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.cells import WIDTH
from core.family import PRESETS, Parameters
from core.gibbs import (
    StepResponse,
    falls_monotonically,
    ramp_gibbs,
    step_gibbs,
    zeta_violation,
)
from core.limit import LimitCurve
from core.mask import Mask
from effort import costly
from oracles import convergent_members, members, refined, step_value
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


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_intervals_are_narrow_and_contain_the_reference_and_the_samples(row):
    gibbs = step_gibbs(row.parameters.mask)
    step = StepResponse(row.parameters.mask)
    for interval, sampled, printed in (
        (gibbs.overshoot, step.overshoot, row.overshoot),
        (gibbs.undershoot, step.undershoot, row.undershoot),
    ):
        assert 0 <= interval.lower <= interval.upper <= interval.lower + WIDTH
        assert sampled <= interval.upper + 1e-13  # the rounding of a sum of samples
        assert interval.lower - 5.1e-7 <= printed <= interval.upper + 5.1e-7


@pytest.mark.parametrize(
    ("parameters", "printed"),
    [
        (Parameters(1, 1, 1), 0.727993),
        (Parameters("3/10", "-3/5", "-1/5", "mirrored"), 0.017488),
    ],
    ids=str,
)
def test_two_overshoots_of_the_theory_lie_outside_the_proven_interval(parameters, printed):
    interval = step_gibbs(parameters.mask).overshoot
    assert not interval.lower - 5e-7 <= printed <= interval.upper + 5e-7


def test_one_exact_value_alone_refutes_the_printed_overshoot():
    phi = BasicLimitFunction(Parameters(1, 1, 1).mask)
    assert step_value(phi, Fraction(9, 512)) - 1 > Fraction("0.727996")


@given(convergent_members(["translated"]))
def test_mirroring_the_member_swaps_overshoot_and_undershoot(parameters):
    here, there = step_gibbs(parameters.mask), step_gibbs(parameters.reversed.mask)
    assert here.overshoot.lower == pytest.approx(there.undershoot.lower, abs=2 * WIDTH)
    assert here.undershoot.lower == pytest.approx(there.overshoot.lower, abs=2 * WIDTH)


@given(convergent_members(["translated"]))
def test_the_ramp_response_keeps_within_its_excess(parameters):
    ramp = np.maximum(np.arange(60) - 29.5, 0)
    curve = LimitCurve(np.column_stack([np.arange(60), ramp]), parameters.mask, False)
    inside = slice(18 * 32, -18 * 32)
    t = curve.parameters(5)[inside]
    excess = curve.points(5)[inside, 1] - np.maximum(t - 29.5, 0)
    gibbs = ramp_gibbs(parameters.mask)
    for interval, sampled in ((gibbs.overshoot, excess.max()), (gibbs.undershoot, -excess.min())):
        assert sampled <= interval.upper + 1e-13  # the rounding of a sum of samples
        assert interval.lower <= max(sampled, 0) + 1e-3


def test_only_a_proof_makes_a_member_free_of_the_gibbs_effect():
    assert falls_monotonically(PRESETS["B-spline"].mask)
    for name in ("Lagrange", "Calm", "Tight", "Lean"):
        assert not falls_monotonically(PRESETS[name].mask)
    # Lean has no overshoot above 1e-9, but that is no proof that it has none.
    assert step_gibbs(PRESETS["Lean"].mask).overshoot.upper > 0


def test_the_first_violation_of_the_zeta_criterion_is_a_negative_partial_sum():
    mask = PRESETS["Calm"].mask
    violation = zeta_violation(mask)
    assert (violation.iterations, violation.residue) == (1, 0)
    # k = 1, l = 0: sums of the even coefficients from the far end.
    assert violation.value == sum(mask[2 * tau] for tau in range(-10, violation.index + 1)) < 0
    assert zeta_violation(PRESETS["B-spline"].mask) is None


def first_negative_sum(mask, iterations):
    """Theorem 2.2 word by word: the first (k, l, i, zeta) with a negative zeta."""
    folded = {0: Fraction(1)}
    for k in range(1, iterations + 1):
        folded = refined(folded, mask)
        period = 2**k
        reach = max(map(abs, folded)) // period + 2
        for residue in range(period):
            for i in range(-reach, reach + 1):
                if i == 0:
                    continue
                taus = range(-reach, i + 1) if i < 0 else range(i, reach + 1)
                zeta = sum((folded.get(period * tau + residue, 0) for tau in taus), Fraction(0))
                if zeta < 0:
                    return k, residue, i, zeta
    return None


@costly
@given(members())
def test_the_first_violation_is_that_of_the_definition(parameters):
    found = zeta_violation(parameters.mask, 2)
    expected = first_negative_sum(parameters.mask, 2)
    if expected is None:
        assert found is None
    else:
        assert (found.iterations, found.residue, found.index, found.value) == expected


def test_the_sum_up_to_the_middle_is_no_partial_sum():
    """With i = 0 the theorem sets zeta to 0: a mask whose sums are negative there only passes."""
    mask = Mask(-2, tuple(Fraction(c) for c in (3, 1, -4, 0, 2)))
    assert zeta_violation(mask, 1) is None
    assert first_negative_sum(mask, 1) is None


def test_the_ringing_of_lagrange_is_the_longest_of_the_presets_that_follow_the_polygon():
    calm, lagrange = (StepResponse(PRESETS[n].mask).ringing_length for n in ("Calm", "Lagrange"))
    assert 2 < calm < lagrange < 6.5


def test_the_bspline_does_not_overshoot_at_all():
    step = StepResponse(PRESETS["B-spline"].mask)
    assert step.overshoot < 1e-14
    assert step.undershoot < 1e-14


@given(convergent_members())
def test_the_step_falls_from_one_to_zero(parameters):
    values = StepResponse(parameters.mask).values(4)
    assert values[0] == pytest.approx(1, abs=1e-13)
    assert values[-1] == pytest.approx(0, abs=1e-13)
