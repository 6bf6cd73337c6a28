"""Least squares by conjugate gradients against the dense system of control weights."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.family import PRESETS
from core.limit import LimitCurve
from core.pull import control_weights
from core.squares import LEVEL, SAMPLES, Squares
from effort import costly

SCHEMES = ["Lagrange", "Calm", "Tight", "Lean"]


def matrix_of(squares):
    """Weights of all control points in all samples, one by one."""
    rows = np.zeros((squares.spans * SAMPLES, squares.count))
    for k, row in enumerate(rows):
        places, weights = control_weights(
            squares.count, squares.mask, squares.closed, k / SAMPLES
        )
        row[places] = weights
    return rows


def weights_of(rng, count):
    """Positive definite 2 x 2 weights."""
    angle, less = rng.uniform(0, 2 * np.pi, count), rng.uniform(0, 0.9, count)
    x, y = np.cos(angle), np.sin(angle)
    return 1 - less * x * x, -less * x * y, 1 - less * y * y


@given(
    st.sampled_from(list(PRESETS)), st.integers(3, 70), st.booleans(), st.integers(0, 10**6)
)
def test_samples_are_those_of_the_curve(name, count, closed, seed):
    points = np.random.default_rng(seed).uniform(0, 9, size=(count, 2))
    squares = Squares(count, PRESETS[name].mask, closed)
    exact = LimitCurve(points, PRESETS[name].mask, closed).points(LEVEL)
    np.testing.assert_allclose(
        squares.values(points), exact[: squares.spans * SAMPLES].T, atol=1e-12
    )


@costly
@given(
    st.sampled_from(SCHEMES), st.sampled_from([3, 4, 9, 30, 75]), st.booleans(),
    st.integers(0, 10**6),
)
def test_the_sum_of_squares_is_as_small_as_it_can_be(name, count, closed, seed):
    rng = np.random.default_rng(seed)
    squares = Squares(count, PRESETS[name].mask, closed)
    points = rng.uniform(0, 9, size=(count, 2))
    targets = rng.normal(size=(squares.spans * SAMPLES, 2)) @ (1, 1j)
    xx, xy, yy = weights_of(rng, len(targets))
    found = points
    for _ in range(6):
        found = squares.solved(found, targets, (xx, xy, yy))
    A = matrix_of(squares)
    free = slice(None) if closed else slice(1, count - 1)
    if not closed:
        assert found[[0, -1]].tolist() == points[[0, -1]].tolist()
    left = targets - A @ (found @ (1, 1j))
    x, y = left.real, left.imag
    gradient = np.stack([A.T @ (xx * x + xy * y), A.T @ (xy * x + yy * y)])[:, free]
    start = targets - A @ (points @ (1, 1j))
    assert np.abs(gradient).max(initial=0) <= 1e-6 * np.abs(A.T @ start).max()


@pytest.mark.parametrize("name", PRESETS)
def test_a_closed_curve_is_found_from_its_samples_in_one_step(name):
    points = np.random.default_rng(3).uniform(0, 9, size=(20, 2))
    squares = Squares(20, PRESETS[name].mask, True)
    x, y = squares.values(points)
    found = squares.solved(np.zeros((20, 2)), x + 1j * y)
    np.testing.assert_allclose(found, points, atol=1e-7)


def test_a_line_of_two_points_has_nothing_free():
    points = np.array([(0.0, 0), (3, 4)])
    squares = Squares(2, PRESETS["Calm"].mask, False)
    found = squares.solved(points, np.full(SAMPLES, 7 + 7j))
    assert found.tolist() == points.tolist()
