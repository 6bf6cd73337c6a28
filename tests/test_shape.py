"""Tangents and curvature against closed forms and finite differences."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.errors import SmoothnessError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.shape import curvatures, second_derivatives, tangents
from oracles import bspline_value, convergent_members

SEEDS = st.integers(0, 10**6)


def polygon(n, seed):
    return np.random.default_rng(seed).normal(size=(n, 2))


@given(convergent_members(["translated"]), st.integers(2, 9), SEEDS, st.booleans())
def test_tangents_are_the_slopes_of_ever_shorter_chords(parameters, n, seed, closed):
    curve = LimitCurve(polygon(n, seed), parameters.mask, closed)
    slopes = []
    for level in (6, 9):
        step = 2**level
        points = curve.points(level)
        chords = (np.roll(points, -1, axis=0) - points)[: None if closed else -1] * step
        coarse = chords[:: step // 8]
        slopes.append(np.abs(coarse - tangents(curve, 3)[: len(coarse)]).max())
    size = np.abs(tangents(curve, 3)).max() + 1e-9
    assert slopes[1] <= 0.05 * size
    assert slopes[1] <= slopes[0] / 3 + 1e-9


@pytest.mark.parametrize("order", [1, 2, 3])
def test_derivatives_of_the_bspline_are_differences_of_lower_bsplines(order):
    phi = BasicLimitFunction(PRESETS["B-spline"].mask)
    values = phi.values(3, order)
    for k in range(0, len(values), 5):
        x = Fraction(k, 8)
        exact = sum(
            (-1) ** j * comb(order, j) * bspline_value(12 - order, x - j) for j in range(order + 1)
        )
        assert values[k] == pytest.approx(float(exact), abs=1e-13)


@given(convergent_members(["translated"]), st.integers(0, 4))
def test_derivative_tables_kill_constants_and_differentiate_lines(parameters, level):
    table = BasicLimitFunction(parameters.mask).table(level, 1)
    places = np.arange(len(table)) + 1.0 - parameters.mask.end
    np.testing.assert_allclose(table.sum(axis=0), 0, atol=1e-12)
    np.testing.assert_allclose(places @ table, 1, atol=1e-11)


@given(convergent_members(["translated"]), st.integers(1, 4), st.integers(1, 2))
def test_derivatives_solve_the_refinement_equation(parameters, level, order):
    """From ``phi(x) = sum a_i phi(2x - i)``: each derivative brings a factor 2."""
    phi = BasicLimitFunction(parameters.mask)
    fine, coarse = phi.values(level, order), phi.values(level - 1, order)
    expected = np.zeros(len(fine))
    for i, a in enumerate(parameters.mask.values):
        first = i * 2 ** (level - 1)
        expected[first : first + len(coarse)] += 2**order * a * coarse
    np.testing.assert_allclose(fine, expected, atol=1e-10)


@pytest.mark.parametrize("name", PRESETS)
def test_a_circle_has_the_curvature_of_its_own_radius(name):
    angle = np.arange(40) * 2 * np.pi / 40
    curve = LimitCurve(np.column_stack([np.cos(angle), np.sin(angle)]), PRESETS[name].mask, True)
    radius = np.hypot(*curve.points(2).T)
    np.testing.assert_allclose(curvatures(curve, 2), 1 / radius, rtol=2e-5)
    back = LimitCurve(curve.control_points[::-1], PRESETS[name].mask, True)
    assert (curvatures(back, 2) < 0).all()


def test_shapes_are_those_of_the_points():
    for closed in (True, False):
        curve = LimitCurve(polygon(5, 1), PRESETS["Calm"].mask, closed)
        assert tangents(curve, 3).shape == second_derivatives(curve, 3).shape
        assert tangents(curve, 3).shape == curve.points(3).shape
        assert curvatures(curve, 3).shape == (len(curve.points(3)),)


def test_curvature_is_undefined_where_the_curve_stands_still():
    curve = LimitCurve(np.ones((6, 2)), PRESETS["B-spline"].mask, True)
    assert np.isnan(curvatures(curve, 1)).all()


def test_a_derivative_that_is_not_proven_is_refused_with_the_reason():
    rough = LimitCurve(polygon(8, 1), Parameters("1/2", 0, "-1/2", "mirrored").mask, True)
    with pytest.raises(SmoothnessError, match="only C\\^0 is proven, and tangents need C\\^1"):
        tangents(rough, 2)
    smooth = LimitCurve(polygon(8, 1), Parameters("3/10", "-3/5", "-1/5", "mirrored").mask, True)
    assert np.isfinite(tangents(smooth, 2)).all()
    with pytest.raises(SmoothnessError, match="only C\\^1 is proven, and curvature needs C\\^2"):
        curvatures(smooth, 2)
    with pytest.raises(SmoothnessError, match="not even continuity"):
        tangents(LimitCurve(polygon(8, 1), Parameters(10, 0, 0).mask, True), 2)


@pytest.mark.parametrize("n", [0, 1])
def test_dots_have_no_direction(n):
    curve = LimitCurve(np.ones((n, 2)), PRESETS["Calm"].mask, False)
    np.testing.assert_array_equal(tangents(curve, 3), np.zeros((n, 2)))
