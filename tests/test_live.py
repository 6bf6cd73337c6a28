"""A curve whose points move: it equals a new one, and names what changed, at a cost without n."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.live import LiveCurve
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def polygon(count: int, seed: int = 1) -> NDArray[np.float64]:
    return np.random.default_rng(seed).normal(size=(count, 2)) * 10


@given(convergent_members(), st.integers(1, 60), SEEDS, st.booleans(), st.integers(1, 5))
def test_after_moves_it_equals_a_new_curve(
    member: Parameters, count: int, seed: int, closed: bool, moves: int
) -> None:
    rng = np.random.default_rng(seed)
    live = LiveCurve(polygon(count, seed), member.mask, closed)
    points = live.control_points.copy()
    for _ in range(moves):
        indices = rng.choice(count, size=rng.integers(1, min(count, 4) + 1), replace=False)
        positions = rng.normal(size=(len(indices), 2)) * 10
        points[indices] = positions
        live.move(indices, positions)
    new = LimitCurve(points, member.mask, closed)
    np.testing.assert_array_equal(live.control_points, points)
    extent = np.ptp(points, axis=0).max() + np.abs(points).max()
    np.testing.assert_allclose(live.points(3), new.points(3), atol=1e-12 * extent, rtol=0)
    if live.spans:
        np.testing.assert_allclose(live.at(0.3), new.at(0.3), atol=1e-12 * extent, rtol=0)


@given(convergent_members(), st.integers(2, 90), SEEDS, st.booleans())
def test_only_the_spans_that_it_names_change(
    member: Parameters, count: int, seed: int, closed: bool
) -> None:
    rng = np.random.default_rng(seed)
    live = LiveCurve(polygon(count, seed), member.mask, closed)
    before = live.span_points(slice(None), 3)
    indices = rng.choice(count, size=rng.integers(1, 3), replace=False)
    touched = live.move(indices, rng.normal(size=(len(indices), 2)))
    changed = np.abs(live.span_points(slice(None), 3) - before).max(axis=(1, 2)) > 1e-12
    named = np.zeros(live.spans, dtype=bool)
    for part in touched:
        assert not named[part.start : part.stop].any()
        named[part.start : part.stop] = True
    assert not (changed & ~named).any()


def test_one_point_inside_touches_18_spans() -> None:
    live = LiveCurve(polygon(1000), PRESETS["Tight"].mask, True)
    assert live.move(500, (0.0, 0.0)) == (range(491, 509),)
    assert live.move(0, (0.0, 0.0)) == (range(9), range(991, 1000))
    seven_point = LiveCurve(polygon(1000), PRESETS["Calm"].mask, False)
    assert seven_point.move([500], [(0.0, 0.0)]) == (range(493, 507),)


@pytest.mark.parametrize("closed", [True, False])
def test_all_points_touch_all_spans(closed: bool) -> None:
    live = LiveCurve(polygon(100), PRESETS["Lean"].mask, closed)
    points = polygon(100, 2)
    assert live.move(np.arange(100), points) == (range(live.spans),)
    assert live.move([], np.zeros((0, 2))) == ()
    new = LimitCurve(points, PRESETS["Lean"].mask, closed)
    np.testing.assert_allclose(live.points(2), new.points(2), atol=1e-12)


def test_ten_thousand_moves_add_no_error() -> None:
    live = LiveCurve(polygon(50), PRESETS["Lean"].mask, False)
    rng = np.random.default_rng(3)
    for index, place in zip(rng.integers(0, 50, 10_000), rng.normal(size=(10_000, 2)), strict=True):
        live.move(index, place)
    new = LimitCurve(live.control_points, PRESETS["Lean"].mask, False)
    np.testing.assert_allclose(live.points(3), new.points(3), atol=1e-13, rtol=0)


@pytest.mark.parametrize("name", ["Tight", "Lean"])
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("index", [0, 3, 100_000, 199_999])
def test_a_move_allocates_nothing_of_size_n(name: str, closed: bool, index: int) -> None:
    live = LiveCurve(polygon(200_000), PRESETS[name].mask, closed)
    live.move(index, (0.0, 0.0))
    live.span_points(slice(0, 1), 5)
    tracemalloc.start()
    try:
        for part in live.move(index, (1.0, 1.0)):
            live.span_points(slice(part.start, part.stop), 5)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000


def test_what_moves_cannot_be_written_from_outside() -> None:
    live = LiveCurve(polygon(40), PRESETS["Calm"].mask, True)
    for view in (live.control_points, live.endless_points):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0.0
