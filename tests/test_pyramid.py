"""The pyramids of a curve and of its polygon: boxes, deviations and ends are what they promise."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.blocks import FAN, Blocks, from_chords
from core.errors import NoLimitError
from core.family import Parameters
from core.live import LiveCurve
from core.mask import Mask
from core.pyramid import CurvePyramid, PolygonPyramid, Pyramid
from effort import costly
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def wave(count: int, seed: int = 1) -> NDArray[np.float64]:
    rng = np.random.default_rng(seed)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    circle = 100 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return circle + rng.normal(0, 3, (count, 2))


def check(pyramid: Pyramid, dense: NDArray[np.float64], level: int) -> None:
    """Compare all that a pyramid promises with points (2, m) at ``t = k / 2^level``."""
    ends = pyramid.places(np.arange(pyramid.spans + 1))
    np.testing.assert_allclose(ends, dense[:, :: 1 << level], atol=1e-9)
    for k in range(pyramid.depth):
        size = FAN ** (k + 1)
        nodes = pyramid.nodes(k)
        boxes = pyramid.boxes(k, nodes)
        deviations = pyramid.deviations(k, nodes) + pyramid.slack(k, nodes)
        full = -(-pyramid.spans // size)
        for node in range(full):
            first, after = node * size, min((node + 1) * size, pyramid.spans)
            part = dense[:, first << level : (after << level) + 1]
            assert (part.min(axis=1) >= boxes[:2, node] - 1e-9).all()
            assert (-part.max(axis=1) >= boxes[2:, node] - 1e-9).all()
            assert from_chords(part).max(initial=0.0) <= deviations[node] + 1e-9
        assert np.isinf(boxes[:, full:]).all()


@given(convergent_members(), st.integers(2, 700), SEEDS, st.booleans())
def test_no_node_of_a_curve_promises_too_much(
    member: Parameters, count: int, seed: int, closed: bool
) -> None:
    curve = LiveCurve(wave(count, seed), member.mask, closed)
    level = 4
    dense = curve.points(level)
    if closed:
        dense = np.concatenate([dense, dense[:1]])
    pyramid = CurvePyramid(Blocks(curve))
    assert pyramid.finest is None
    check(pyramid, dense.T, level)


@given(convergent_members(["translated"]), st.integers(2, 700), SEEDS, st.booleans())
@costly
def test_no_node_of_a_polygon_promises_too_much(
    member: Parameters, count: int, seed: int, closed: bool
) -> None:
    curve = LiveCurve(wave(count, seed), member.mask, closed)
    points = curve.control_points
    corners = np.concatenate([points, points[:1]]) if closed else points
    check(PolygonPyramid(Blocks(curve)), corners.T, 0)


@pytest.mark.parametrize("closed", [True, False])
def test_a_finite_level_keeps_its_promises_too(closed: bool) -> None:
    curve = LiveCurve(wave(150), Parameters(100, 100, 100).mask, closed)
    pyramid = CurvePyramid(Blocks(curve))
    assert pyramid.finest == 2
    finite = curve.points(2)
    if closed:
        finite = np.concatenate([finite, finite[:1]])
    scale = np.abs(finite).max()
    check(CurvePyramid(Blocks(LiveCurve(curve.control_points / scale, curve.mask, closed))),
          finite.T / scale, 2)  # fmt: skip


def test_without_a_limit_there_is_no_pyramid_of_the_curve() -> None:
    # 1 is a double eigenvalue of its integer matrix.
    mask = Mask(-2, tuple(Fraction(c) for c in (1, 2, 0, -1)))
    blocks = Blocks(LiveCurve(wave(20), mask, True))
    with pytest.raises(NoLimitError):
        CurvePyramid(blocks)
    assert PolygonPyramid(blocks).spans == 20
