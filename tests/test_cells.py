"""Cells of the dual grid, and how far a limit function leaves a range, as proven intervals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.cells import WIDTH, Cells, excess
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
def test_the_parts_are_the_eighths_of_the_curve(parameters, seed):
    cell, curve = cell_of(parameters, seed)
    parts = cell.parts().parts()
    expected = [curve.at(29.5 + k / 64)[0] for k in range(65)]
    np.testing.assert_allclose(parts.ends[:, 0], expected[:-1], atol=1e-12)
    np.testing.assert_allclose(parts.ends[:, 1], expected[1:], atol=1e-12)


@given(convergent_members(), SEEDS)
def test_bounds_hold_at_every_depth(parameters, seed):
    cells, curve = cell_of(parameters, seed)
    t = np.arange(29.5 * 64, 30.5 * 64 + 1) / 64
    values = [curve.at(x)[0] for x in t]
    for _ in range(3):
        least, largest = cells.bounds(cells.ends)
        assert largest.max() >= max(values) - 1e-12
        assert least.min() <= min(values) + 1e-12
        cells = cells.parts()


@given(convergent_members(["translated"]), SEEDS)
def test_the_excess_lies_in_narrow_intervals(parameters, seed):
    cell, curve = cell_of(parameters, seed)
    low, high = np.sort(np.random.default_rng(seed).uniform(-1, 1, size=2))
    t = np.arange(29.5 * 256, 30.5 * 256 + 1) / 256
    values = np.array([curve.at(x)[0] for x in t])
    both = excess(cell, low, high)
    for found, samples in ((both.above, values - high), (both.below, low - values)):
        sampled = samples.max(initial=0.0)
        assert sampled <= found.upper
        assert found.lower <= found.upper <= found.lower + WIDTH
        # The sampled maximum is at most a chord error of level 8 away.
        assert found.lower <= sampled + 1e-3


def test_nothing_is_bounded_for_divergent_members():
    mask = Parameters(50, 0, 0).mask
    for found in excess(Cells(mask, np.ones((1, mask.end - mask.start)))):
        assert found.upper == np.inf
        assert np.isfinite(found.lower)


@pytest.mark.parametrize("value", [-1.0, 2.0])
def test_a_function_within_the_range_exceeds_it_on_neither_side(value):
    mask = PRESETS["Calm"].mask
    data = np.full((1, mask.end - mask.start), value)
    for found in excess(Cells(mask, data), -1.0, 2.0):
        assert found.lower == 0
        assert found.upper == pytest.approx(0, abs=1e-12)
