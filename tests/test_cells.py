"""Cells of the dual grid, and the maximum of a limit function as a proven interval."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.cells import WIDTH, Cells, maximum
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def cell_of(parameters, seed):
    """One cell of random data, and the curve of which it is the piece t = 29.5 .. 30.5."""
    mask = parameters.mask
    data = np.random.default_rng(seed).uniform(-1, 1, size=60)
    first = 30 - mask.end + 1
    window = data[first : first + mask.end - mask.start]
    curve = LimitCurve(np.column_stack([data, data]), mask, False)
    return Cells(mask, window[None, :]), curve


@given(convergent_members(), SEEDS)
def test_the_ends_are_curve_points(parameters, seed):
    cell, curve = cell_of(parameters, seed)
    np.testing.assert_allclose(cell.ends[0], [curve.at(29.5)[0], curve.at(30.5)[0]], atol=1e-12)


@given(convergent_members(), SEEDS)
def test_the_halves_are_the_two_halves_of_the_curve(parameters, seed):
    cell, curve = cell_of(parameters, seed)
    quarters = cell.halves().halves()
    # Left halves first: left-left, right-left, left-right, right-right.
    starts = np.array([29.5, 30.0, 29.75, 30.25])
    expected = [[curve.at(t)[0], curve.at(t + 0.25)[0]] for t in starts]
    np.testing.assert_allclose(quarters.ends, expected, atol=1e-12)


@given(convergent_members(), SEEDS)
def test_upper_bounds_hold_at_every_depth(parameters, seed):
    cells, curve = cell_of(parameters, seed)
    t = np.arange(29.5 * 64, 30.5 * 64 + 1) / 64
    highest = max(curve.at(x)[0] for x in t)
    for _ in range(4):
        assert cells.upper(cells.ends).max() >= highest - 1e-12
        cells = cells.halves()


@given(convergent_members(["translated"]), SEEDS)
def test_the_maximum_lies_in_the_interval_and_the_interval_is_narrow(parameters, seed):
    cell, curve = cell_of(parameters, seed)
    found = maximum(cell)
    t = np.arange(29.5 * 256, 30.5 * 256 + 1) / 256
    sampled = max(0.0, *(curve.at(x)[0] for x in t))
    assert sampled <= found.upper
    assert found.lower <= found.upper <= found.lower + WIDTH
    # The sampled maximum is at most a chord error of level 8 away.
    assert found.lower <= sampled + 1e-3


def test_nothing_is_bounded_for_divergent_members():
    mask = Parameters(50, 0, 0).mask
    found = maximum(Cells(mask, np.ones((1, mask.end - mask.start))))
    assert found.upper == np.inf
    assert np.isfinite(found.lower)


def test_negative_functions_have_the_maximum_zero_of_their_surroundings():
    mask = PRESETS["Calm"].mask
    found = maximum(Cells(mask, -np.ones((1, mask.end - mask.start))))
    assert found.lower == 0
    assert found.upper == pytest.approx(0, abs=1e-12)
