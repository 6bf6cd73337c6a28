"""Pulling the curve: it lands exactly, and by the smallest change."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.family import PRESETS
from core.limit import LimitCurve
from core.pull import control_weights, pull, pulled
from oracles import convergent_members

SETTING = (
    convergent_members(),
    st.integers(2, 60),
    st.booleans(),
    st.integers(0, 10**6),
    st.floats(0, 1),
)


def setting(parameters, n, closed, seed, share):
    points = np.random.default_rng(seed).normal(size=(n, 2))
    t = share * (n if closed else n - 1)
    return points, parameters.mask, closed, t


@given(*SETTING)
def test_the_curve_point_lands_on_the_target(parameters, n, closed, seed, share):
    points, mask, closed, t = setting(parameters, n, closed, seed, share)
    new = pulled(points, mask, closed, t, (3.0, -4.0))
    np.testing.assert_allclose(LimitCurve(new, mask, closed).at(t), (3.0, -4.0), atol=1e-10)


@given(*SETTING)
def test_weights_give_the_curve_point_and_sum_to_one(parameters, n, closed, seed, share):
    points, mask, closed, t = setting(parameters, n, closed, seed, share)
    indices, weights = control_weights(n, mask, closed, t)
    assert len(set(indices.tolist())) == len(indices)
    assert weights.sum() == pytest.approx(1, abs=1e-11)
    np.testing.assert_allclose(
        weights @ points[indices], LimitCurve(points, mask, closed).at(t), atol=1e-11
    )


@given(*SETTING)
def test_no_other_change_that_lands_there_is_smaller(parameters, n, closed, seed, share):
    points, mask, closed, t = setting(parameters, n, closed, seed, share)
    new = pulled(points, mask, closed, t, (3.0, -4.0))
    indices, weights = control_weights(n, mask, closed, t)
    row = np.zeros(n)
    row[indices] = weights
    way = np.array([3.0, -4.0]) - row @ points
    least = np.linalg.pinv(row[None, :]) @ way[None, :]
    np.testing.assert_allclose(new - points, least, atol=1e-9)


@given(convergent_members(), st.integers(0, 10**6))
def test_pinned_points_stay_and_the_curve_still_lands(parameters, seed):
    points = np.random.default_rng(seed).normal(size=(9, 2))
    new = pulled(points, parameters.mask, True, 3.25, (1.0, 1.0), pinned={3, 4})
    np.testing.assert_array_equal(new[[3, 4]], points[[3, 4]])
    np.testing.assert_allclose(LimitCurve(new, parameters.mask, True).at(3.25), (1, 1), atol=1e-8)


@given(convergent_members(), st.integers(0, 10**6))
def test_the_end_of_an_open_curve_is_its_end_point_alone(parameters, seed):
    points = np.random.default_rng(seed).normal(size=(9, 2))
    new = pulled(points, parameters.mask, False, 0.0, (5.0, 5.0))
    np.testing.assert_allclose(new[0], (5.0, 5.0), atol=1e-10)
    np.testing.assert_allclose(new[1:], points[1:], atol=1e-9)


@given(convergent_members())
def test_a_place_held_by_pinned_points_only_is_refused(parameters):
    with pytest.raises(NinepointError, match="pinned"):
        pulled(np.eye(2), parameters.mask, False, 0.5, (0, 0), pinned={0, 1})


def test_a_pull_names_the_points_that_move_and_costs_no_more():
    points = np.random.default_rng(4).normal(size=(100_000, 2))
    mask = PRESETS["Lean"].mask
    pull(points, mask, True, 70_000.3, (1.0, 2.0))
    tracemalloc.start()
    try:
        indices, positions = pull(points, mask, True, 70_000.3, (1.0, 2.0))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 50_000
    expected = points.copy()
    expected[indices] = positions
    assert len(indices) <= 18
    np.testing.assert_array_equal(pulled(points, mask, True, 70_000.3, (1.0, 2.0)), expected)
