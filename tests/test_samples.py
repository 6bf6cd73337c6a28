"""Samples of a curve, and the bound of what lies between them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.samples import MAX_SAMPLES, Sampling

masks = st.sampled_from([member.mask for member in PRESETS.values()])


def polygons(seed, count):
    """Rough and smooth parts, so that spans take different levels."""
    points = np.random.default_rng(seed).uniform(0, 30, size=(count, 2))
    points[: count // 2] *= 1e-3
    return points


def joined(blocks, name):
    values = [getattr(block, name) for block in blocks]
    for before, after in pairwise(values):
        np.testing.assert_allclose(before[-1], after[0], rtol=0, atol=1e-12)
    return np.concatenate([*(v[:-1] for v in values), values[-1][-1:]])


@given(masks, st.integers(2, 60), st.integers(0, 10**6), st.booleans())
def test_samples_are_the_exact_points_and_derivatives(mask, count, seed, closed):
    curve = LimitCurve(polygons(seed, count), mask, closed)
    sampling = Sampling(curve, 0.01, 1 / 8)
    blocks = [sampling.block(*part, slopes=True) for part in sampling.parts()]
    found = np.stack([joined(blocks, name) for name in ("x", "y")], axis=1)
    slopes = np.stack([joined(blocks, name) for name in ("slope_x", "slope_y")], axis=1)
    spans = len(sampling.levels)
    levels = np.concatenate([block.levels for block in blocks])
    assert (levels >= sampling.levels).all()
    assert (2**levels).sum() <= 1.5 * sampling.count
    first = np.concatenate([[0], np.cumsum(2**levels)])
    assert len(found) == first[-1] + 1
    for span in range(spans):
        part = slice(first[span], first[span + 1] + 1)
        exact = curve.span_points(np.array([span]), int(levels[span]))[0]
        np.testing.assert_allclose(found[part], exact, rtol=0, atol=1e-11)
        exact = curve.span_points(np.array([span]), int(levels[span]), 1)[0]
        np.testing.assert_allclose(slopes[part], exact, rtol=0, atol=1e-10)
    if not closed:
        assert found[[0, -1]].tolist() == curve.control_points[[0, -1]].tolist()
    else:
        assert found[0].tolist() == found[-1].tolist()


@given(masks, st.integers(2, 12), st.integers(0, 10**6), st.sampled_from([1e-1, 1e-3]))
def test_the_curve_keeps_to_the_polygon_of_the_samples(mask, count, seed, tolerance):
    curve = LimitCurve(polygons(seed, count), mask, False)
    sampling = Sampling(curve, tolerance, 1 / 8)
    assert sampling.largest_bound <= tolerance / 8
    for span, level in enumerate(sampling.levels):
        dense = curve.span_points(np.array([span]), int(level) + 3)[0]
        nodes = dense[::8]
        share = np.arange(8)[:, None] / 8
        chords = nodes[:-1, None] * (1 - share) + nodes[1:, None] * share
        away = np.hypot(*(dense[:-1] - chords.reshape(-1, 2)).T).max()
        assert away <= sampling.bounds[span]


@given(masks, st.integers(2, 40), st.integers(0, 10**6), st.booleans())
def test_points_between_samples_are_exact(mask, count, seed, closed):
    curve = LimitCurve(polygons(seed, count), mask, closed)
    sampling = Sampling(curve, 0.01, 1 / 8)
    block = sampling.block(*sampling.parts()[0])
    last = len(block.x) - 1
    rng = np.random.default_rng(seed)
    places = np.unique(np.append(rng.integers(0, last << 3, 200), [0, 5, last << 3]))
    found = sampling.between(block, places, 3)
    span = np.minimum(np.searchsorted(block.starts, places / 8, "right"), len(block.levels)) - 1
    t = span + (places / 8 - block.starts[span]) / 2.0 ** block.levels[span]
    exact = np.array([curve.at(value) for value in t]).T
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-11)
    assert found[:, 0].tolist() == [block.x[0], block.y[0]]
    assert found[:, -1].tolist() == [block.x[-1], block.y[-1]]
    on = places % 8 == 0
    samples = np.stack([block.x, block.y])[:, places[on] // 8]
    np.testing.assert_allclose(found[:, on], samples, rtol=0, atol=1e-11)
    assert sampling.between(block, np.array([], dtype=int), 3).shape == (2, 0)


def test_the_spans_of_a_block_have_few_levels_where_that_takes_few_samples():
    """A level that most spans have is raised to by others, but not one that few have."""
    bent = np.random.default_rng(1).uniform(0, 30, size=(400, 2))
    bent[200:] = bent[199] + np.outer(np.arange(200), [3, 4])
    sampling = Sampling(LimitCurve(bent, PRESETS["Calm"].mask, False), 0.001, 1 / 8)
    assert (sampling.levels == 0).sum() > 150
    levels = np.concatenate([sampling.block(*part).levels for part in sampling.parts()])
    assert len(np.unique(levels)) < len(np.unique(sampling.levels))
    assert (levels[sampling.levels == 0] > 0).all()
    assert (levels < levels.max()).any()


def test_long_curves_come_in_blocks_and_short_ones_in_one():
    points = np.random.default_rng(0).uniform(0, 3000, size=(3000, 2))
    sampling = Sampling(LimitCurve(points, PRESETS["Calm"].mask, True), 0.1, 1 / 8)
    blocks = [sampling.block(*part) for part in sampling.parts()]
    assert len(blocks) > 1
    joined(blocks, "x")
    few = Sampling(LimitCurve(points[:9], PRESETS["Calm"].mask, True), 0.1, 1 / 8)
    assert few.parts() == [(0, 9)]


def test_straight_spans_take_no_samples_between():
    line = LimitCurve(np.outer(np.arange(40), [3, 4]), PRESETS["Tight"].mask, False)
    assert (Sampling(line, 0.01, 1 / 8).levels == 0).all()


def test_too_many_samples_and_too_rough_curves_are_refused():
    zigzag = np.stack([np.arange(20_000), 1e6 * (np.arange(20_000) % 2)], axis=1)
    curve = LimitCurve(zigzag, PRESETS["Lagrange"].mask, False)
    with pytest.raises(NinepointError, match="too many vertices"):
        Sampling(curve, 1.0, 1 / 8)
    assert MAX_SAMPLES >= 10**7
    rough = Parameters("1/2", "-3/10", "-1/2", "mirrored")
    with pytest.raises(NinepointError, match="too rough"):
        Sampling(LimitCurve(zigzag[:9], rough.mask, True), 0.01, 1 / 8)
