"""The pyramid: boxes and deviations hold, and an update equals a new pyramid."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.live import LiveCurve
from core.pyramid import FAN, CurvePyramid, from_chords
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def wave(count: int, seed: int = 1) -> NDArray[np.float64]:
    rng = np.random.default_rng(seed)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    circle = 100 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return circle + rng.normal(0, 3, (count, 2))


@given(convergent_members(), st.integers(2, 700), SEEDS, st.booleans())
@settings(max_examples=40)
def test_no_node_promises_too_much(member: Parameters, count: int, seed: int, closed: bool) -> None:
    curve = LimitCurve(wave(count, seed), member.mask, closed)
    pyramid = CurvePyramid(curve)
    level = 4
    dense = curve.points(level)
    if closed:
        dense = np.concatenate([dense, dense[:1]])
    for k in range(len(pyramid.ends)):
        spans = FAN ** (k + 1)
        nodes = -(-curve.spans // spans)
        for node in range(nodes):
            first, after = node * spans, min((node + 1) * spans, curve.spans)
            part = dense[first << level : (after << level) + 1].T
            box = pyramid.boxes[k][:, node]
            assert (part.min(axis=1) >= box[:2] - 1e-9).all()
            assert (-part.max(axis=1) >= box[2:] - 1e-9).all()
            assert from_chords(part).max() <= pyramid.deviations[k][node] + 1e-9
            ends = pyramid.ends[k][:, node : node + 2]
            np.testing.assert_allclose(ends, part[:, [0, -1]], atol=1e-9)
        assert np.isinf(pyramid.boxes[k][:, nodes:]).all()


@given(convergent_members(), st.integers(2, 700), SEEDS, st.booleans())
@settings(max_examples=40)
def test_an_update_equals_a_new_pyramid(
    member: Parameters, count: int, seed: int, closed: bool
) -> None:
    rng = np.random.default_rng(seed)
    live = LiveCurve(wave(count, seed), member.mask, closed)
    pyramid = CurvePyramid(live)
    for _ in range(3):
        indices = rng.choice(count, size=min(2, count), replace=False)
        pyramid.update(live.move(indices, rng.normal(0, 50, (len(indices), 2))))
    new = CurvePyramid(LimitCurve(live.control_points, member.mask, closed))
    for mine, others in (
        (pyramid.ends, new.ends),
        (pyramid.boxes, new.boxes),
        (pyramid.deviations, new.deviations),
    ):
        for held, expected in zip(mine, others, strict=True):
            np.testing.assert_allclose(held, expected, atol=1e-9, rtol=0)


def test_an_update_allocates_nothing_of_size_n() -> None:
    live = LiveCurve(wave(200_000), PRESETS["Tight"].mask, True)
    pyramid = CurvePyramid(live)
    tracemalloc.start()
    try:
        pyramid.update(live.move(100_000, (3.0, 4.0)))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000


def test_without_a_proven_bound_there_is_no_pyramid() -> None:
    with pytest.raises(NoLimitError):
        CurvePyramid(LimitCurve(wave(20), Parameters(100, 100, 100).mask, True))


def test_distances_are_those_from_segments() -> None:
    points = np.array([[0, 2, 5, -1, 4.0], [0, 1, 0, 0, 0.0]])
    np.testing.assert_allclose(from_chords(points), [1, 1, 1])
    np.testing.assert_allclose(from_chords(np.ones((2, 4))), [0, 0])
