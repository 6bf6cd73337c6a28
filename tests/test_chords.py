"""Proven bounds: chords, sizes, second differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.chords import chord_constant, second_difference_norm, size_constant
from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.refine import subdivide
from oracles import convergent_members


@pytest.mark.parametrize("name", PRESETS)
def test_the_chord_constant_bounds_every_chord(name):
    mask = PRESETS[name].mask
    rng = np.random.default_rng(5)
    points = rng.normal(size=(60, 2))
    curve = LimitCurve(points, mask, True)
    fine = curve.span_points(slice(None), 7)
    share = np.linspace(0, 1, fine.shape[1])[:, None]
    chords = fine[:, :1] * (1 - share) + fine[:, -1:] * share
    bends = np.abs(np.diff(curve.endless_points, n=2, axis=0)).max(axis=0)
    assert (np.abs(fine - chords).max(axis=(0, 1)) <= chord_constant(mask) * bends).all()
    # A parabola, bent by 1 everywhere, is 1/8 from its chords: no valid constant is smaller.
    assert chord_constant(mask) >= 1 / 8


@pytest.mark.parametrize("level", [1, 2, 4])
@pytest.mark.parametrize("name", PRESETS)
def test_second_differences_shrink_as_the_norm_says(name, level):
    mask = PRESETS[name].mask
    signs = np.random.default_rng(level).choice([-1.0, 1.0], size=(200, 2))
    points = np.cumsum(np.cumsum(signs, axis=0), axis=0)
    inside = slice(30 * 2**level, -30 * 2**level)
    bends = np.abs(np.diff(subdivide(points, mask, False, level), n=2, axis=0))[inside].max()
    assert bends <= second_difference_norm(mask, level) * (1 + 1e-9)


def test_the_weights_of_the_bound_reproduce_the_chord_error():
    """Summation by parts, checked: the kernel applied to second differences is the chord error."""
    mask = PRESETS["Lean"].mask
    points = np.random.default_rng(2).normal(size=18)
    table = BasicLimitFunction(mask).table(3)
    start = table[:, :1]
    end = np.vstack([[[0.0]], start[:-1]])
    tau = np.arange(8) / 8
    weights = table - (1 - tau) * start - tau * end
    kernel = np.cumsum(np.cumsum(weights, axis=0), axis=0)[:-2]
    np.testing.assert_allclose(points @ weights, np.diff(points, n=2) @ kernel, atol=1e-12)


@given(convergent_members(), st.integers(0, 10**6))
def test_no_curve_is_larger_than_the_size_constant_says(parameters, seed):
    data = np.random.default_rng(seed).choice([-1.0, 1.0], size=(40, 2))
    curve = LimitCurve(data, parameters.mask, True).points(5)
    assert np.abs(curve).max() <= size_constant(parameters.mask)


def test_the_size_constant_is_one_for_a_curve_in_the_hull_of_its_points():
    assert size_constant(PRESETS["B-spline"].mask) == pytest.approx(1, abs=1e-5)
    assert size_constant(PRESETS["Lagrange"].mask) > 1.05


def test_no_constant_is_stated_for_divergent_members():
    with pytest.raises(NoLimitError, match="may not converge"):
        chord_constant(Parameters(50, 0, 0).mask)
