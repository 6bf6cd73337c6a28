"""The end rules of open polygons (theory, section 7)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.ends import end_points, end_rules, extended, reach
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.refine import refine
from oracles import convergent_members


def polygon(n, seed=3):
    return np.random.default_rng(seed).normal(size=(n, 2))


@given(convergent_members(["translated", "mirrored"]), st.integers(2, 45), st.integers(0, 10**6))
def test_the_limit_begins_and_ends_at_the_end_points_for_any_length(parameters, n, seed):
    points = polygon(n, seed)
    mask = parameters.mask
    endless = extended(points, mask, closed=False)
    weights = LimitCurve(points, mask, False)._basis.table(0)[:-1, 0]
    # By the plain sum over the extended polygon, not by the curve that sets its ends.
    np.testing.assert_allclose(weights @ endless[: len(weights)], points[0], atol=1e-11)
    np.testing.assert_allclose(weights @ endless[-len(weights) :], points[-1], atol=1e-11)


def test_symmetric_members_reflect_about_the_points_themselves():
    points = polygon(20)
    for name in ("Lagrange", "Calm", "Tight", "B-spline"):
        mask = PRESETS[name].mask
        np.testing.assert_allclose(end_points(points, mask), points[[0, -1]], atol=1e-13)
        left, _ = reach(mask)
        endless = extended(points, mask, closed=False)
        for j in range(1, left + 1):
            np.testing.assert_array_equal(endless[left - j], 2 * points[0] - points[j])


def test_the_end_system_has_the_condition_that_the_theory_states():
    mask = Parameters("3/10", "-3/5", "-1/5").mask
    response = np.array(
        [
            end_points(np.array([[1.0, 0.0], *[[0.0, 0.0]] * 18, [0.0, 0.0]]), mask)[:, 0],
            end_points(np.array([[0.0, 0.0], *[[0.0, 0.0]] * 18, [1.0, 0.0]]), mask)[:, 0],
        ]
    )
    # The end points are the inverse system applied to (p_0, p_n): the condition is the same.
    assert np.linalg.cond(response) == pytest.approx(1.38, abs=0.005)


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_short_polygons_are_reflected_as_often_as_needed(n):
    mask = PRESETS["Tight"].mask
    points = polygon(n)
    endless = extended(points, mask, closed=False)
    left, right = reach(mask)
    assert len(endless) == n + left + right
    if n == 2:
        steps = np.diff(endless, axis=0)
        np.testing.assert_allclose(steps, np.broadcast_to(points[1] - points[0], steps.shape))


def test_closed_polygons_go_on_cyclically():
    points = polygon(3)
    mask = PRESETS["Tight"].mask
    left, _ = reach(mask)
    endless = extended(points, mask, closed=True)
    for index, point in enumerate(endless):
        np.testing.assert_array_equal(point, points[(index - left) % 3])


def test_long_and_short_ways_to_the_end_points_agree():
    """Only the end pieces of a long polygon are read: the middle does not matter."""
    mask = PRESETS["Lean"].mask
    points = polygon(200)
    other = points.copy()
    other[60:140] += 5.0
    np.testing.assert_array_equal(end_points(points, mask), end_points(other, mask))
    assert np.abs(end_points(points, mask) - points[[0, -1]]).max() > 0.01


@given(convergent_members(), st.integers(0, 10**6))
def test_the_end_rules_are_the_first_refinement_written_out(parameters, seed):
    points = polygon(40, seed)
    rows = end_rules(parameters.mask)
    new = refine(points, parameters.mask, closed=False)
    for m, row in enumerate(rows):
        assert sum(row) == 1
        weights = np.array([float(weight) for weight in row])
        np.testing.assert_allclose(weights @ points[: len(row)], new[m], atol=1e-11)


@given(convergent_members())
def test_the_rule_after_the_end_rules_is_the_ordinary_one(parameters):
    points = polygon(40)
    mask = parameters.mask
    m = len(end_rules(mask))
    new = refine(points, mask, closed=False)
    rule = mask.stencil(m % 2)
    ordinary = sum(float(w) * points[m // 2 + j] for j, w in rule.items())
    np.testing.assert_allclose(ordinary, new[m], atol=1e-11)


def test_the_last_end_rule_differs_from_the_ordinary_one():
    for name in ("Calm", "Tight", "Lean"):
        mask = PRESETS[name].mask
        rows = end_rules(mask)
        m = len(rows) - 1
        ordinary = {m // 2 + j: w for j, w in mask.stencil(m % 2).items() if w}
        row = {j: w for j, w in enumerate(rows[-1]) if w}
        assert row != ordinary


def test_the_rules_at_the_far_end_are_those_of_the_mirrored_member():
    parameters = PRESETS["Lean"]
    points = polygon(40)
    new = refine(points, parameters.mask, closed=False)[::-1]
    for m, row in enumerate(end_rules(parameters.reversed.mask)):
        weights = np.array([float(weight) for weight in row])
        np.testing.assert_allclose(weights @ points[::-1][: len(row)], new[m], atol=1e-11)
