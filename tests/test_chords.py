"""Proven bounds: chords, sizes, second differences."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.chords import (
    cell_constant,
    chord_constant,
    grows,
    second_difference_norm,
    size_constant,
)
from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.refine import subdivide
from oracles import convergent_members, members


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


def largest_distance_from_chords(mask, level, start, fine=5):
    """Sup, by samples, over all data whose second differences are at most 1, by linear algebra.

    The chords are those of the ``2^level`` parts of the unit interval of t from ``start`` on.
    """
    n = 60
    pulses = [LimitCurve(np.stack([p, p], axis=1), mask, False) for p in np.eye(n)]
    place = int((n // 2 + start) * 2 ** (level + fine))
    interval = slice(place, place + 2 ** (level + fine) + 1)
    curves = np.array([pulse.points(level + fine)[interval, 0] for pulse in pulses])
    inner = curves[:, :-1].reshape(n, 2**level, 2**fine)
    knots = curves[:, :: 2**fine, None]
    share = np.arange(2**fine) / 2**fine
    error = (inner - (1 - share) * knots[:, :-1] - share * knots[:, 1:]).reshape(n, -1)
    kernel = np.linalg.lstsq(np.diff(np.eye(n), n=2, axis=0).T, error, rcond=None)[0]
    return np.abs(kernel).sum(axis=0).max()


@pytest.mark.parametrize(("constant", "start"), [(chord_constant, 0), (cell_constant, 1 / 2)])
@pytest.mark.parametrize("name", PRESETS)
def test_the_constants_of_parts_are_those_of_the_worst_data(name, constant, start):
    for level in range(5):
        worst = largest_distance_from_chords(PRESETS[name].mask, level, start)
        assert worst * (1 - 1e-9) <= constant(PRESETS[name].mask, level) <= 1.03 * worst


@given(convergent_members(), st.integers(0, 4), st.booleans())
def test_no_data_leave_the_chords_of_parts_further_than_the_constants_say(member, level, cell):
    worst = largest_distance_from_chords(member.mask, level, 1 / 2 if cell else 0, fine=3)
    constant = cell_constant if cell else chord_constant
    assert worst * (1 - 1e-9) <= constant(member.mask, level)


@pytest.mark.parametrize("constant", [chord_constant, cell_constant])
@pytest.mark.parametrize("name", PRESETS)
def test_the_constants_fall_on_where_parts_are_finer_than_all_samples(name, constant):
    found = [constant(PRESETS[name].mask, level) for level in range(6, 15)]
    assert all(after < before for before, after in pairwise(found))


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


@given(members())
def test_where_second_differences_are_proven_to_shrink_chords_come_closer(parameters):
    mask = parameters.mask
    if second_difference_norm(mask, 4) < 1 / 2:
        assert not grows(mask)
        assert chord_constant(mask, 12) < chord_constant(mask, 4)


def test_no_constant_is_stated_for_divergent_members():
    with pytest.raises(NoLimitError, match="may not converge"):
        chord_constant(Parameters(50, 0, 0).mask)
