"""The box around a curve, against many of its points."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.affine import IDENTITY, Affine
from core.blocks import Blocks
from core.errors import NoLimitError
from core.extent import extent
from core.family import PRESETS, Parameters
from core.live import LiveCurve
from core.pyramid import CurvePyramid
from oracles import convergent_members

TURN = Affine(np.array([[0.6, -0.8], [0.9, 0.5]]), np.array([30.0, -20.0]))
MAPS = st.sampled_from([IDENTITY, Affine.shift((500.0, -3.0)), TURN])


def curve_of(count, closed, mask, seed=0, spread=100.0):
    points = np.random.default_rng(seed).uniform(-spread, spread, (count, 2))
    live = LiveCurve(points, mask, closed)
    return live, CurvePyramid(Blocks(live))


def sampled(live, placed, level=8):
    points = placed(live.points(level))
    return points.min(axis=0), points.max(axis=0)


@given(convergent_members(), st.integers(2, 700), st.booleans(), MAPS, st.integers(0, 99))
def test_no_point_of_the_curve_lies_outside_by_more_than_the_deviation(
    member, count, closed, placed, seed
):
    live, pyramid = curve_of(count, closed and count > 2, member.mask, seed)
    found = extent(pyramid, 1e-3, placed)
    assert found.deviation <= 1e-3
    low, high = sampled(live, placed, 6)
    assert (low >= found.lower - found.deviation - 1e-9).all()
    assert (high <= found.upper + found.deviation + 1e-9).all()


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("placed", [IDENTITY, TURN], ids=["as it is", "turned"])
def test_each_side_is_reached_within_the_tolerance(name, closed, placed):
    live, pyramid = curve_of(50, closed, PRESETS[name].mask)
    found = extent(pyramid, 1e-6, placed)
    low, high = sampled(live, placed, 12)
    np.testing.assert_allclose(found.lower, low, atol=2e-5)
    np.testing.assert_allclose(found.upper, high, atol=2e-5)


def test_a_straight_line_needs_no_cut(monkeypatch):
    monkeypatch.setattr("core.extent._cut", None)
    live = LiveCurve(np.stack([np.arange(5000.0), np.zeros(5000)], axis=1),
                     PRESETS["Calm"].mask, False)  # fmt: skip
    found = extent(CurvePyramid(Blocks(live)), 1e-3)
    np.testing.assert_allclose([found.lower, found.upper], [[0, 0], [4999, 0]], atol=1e-9)


def test_where_too_many_parts_compete_the_deviation_says_so(monkeypatch):
    monkeypatch.setattr("core.extent.BUDGET", 5)
    monkeypatch.setattr("core.extent.MOST", 8)
    live, pyramid = curve_of(20_000, True, PRESETS["Lagrange"].mask)
    found = extent(pyramid, 1e-9)
    low, high = sampled(live, IDENTITY, 4)
    assert found.deviation > 1e-9
    assert (low >= found.lower - found.deviation).all()
    assert (high <= found.upper + found.deviation).all()


def test_what_waits_is_looked_at_again_where_many_compete(monkeypatch):
    monkeypatch.setattr("core.extent.MOST", 3)
    monkeypatch.setattr("core.extent.BUDGET", 10_000)
    live, pyramid = curve_of(3_000, True, PRESETS["Lagrange"].mask)
    found = extent(pyramid, 1e-6)
    assert found.deviation <= 1e-6
    low, high = sampled(live, IDENTITY, 10)
    np.testing.assert_allclose(found.lower, low, atol=1e-3)
    np.testing.assert_allclose(found.upper, high, atol=1e-3)


def test_a_scheme_that_is_not_proven_to_converge_has_no_extent():
    _, pyramid = curve_of(20, True, Parameters(50, 0, 0).mask)
    with pytest.raises(NoLimitError, match="not proven"):
        extent(pyramid, 1e-3)
