"""Picking through the pyramids finds what looking at everything finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.affine import Affine
from core.blocks import Blocks
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.live import LiveCurve
from core.picking import nearest_place, nearest_point, points_within
from core.pyramid import CurvePyramid, PolygonPyramid
from core.view import view
from effort import costly
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def scattered(count: int, seed: int) -> NDArray[np.float64]:
    return np.random.default_rng(seed).normal(0, 100, (count, 2))


def polygon_of(points: NDArray[np.float64], closed: bool) -> PolygonPyramid:
    return PolygonPyramid(Blocks(LiveCurve(points, PRESETS["Calm"].mask, closed)))


def outline(curve: LimitCurve) -> CurvePyramid:
    return CurvePyramid(Blocks(LiveCurve(curve.control_points, curve.mask, curve.closed)))


@given(st.integers(2, 3000), SEEDS, st.booleans())
def test_points_within_are_those_of_brute_force(count: int, seed: int, closed: bool) -> None:
    points = scattered(count, seed)
    rng = np.random.default_rng(seed + 1)
    polygon = polygon_of(points, closed)
    lower = rng.uniform(-200, 200, 2)
    for upper in (lower + rng.uniform(0, 300, 2), np.full(2, 1e9)):
        inside = ((points >= lower) & (points <= upper)).all(axis=1)
        found = points_within(polygon, lower, upper)
        np.testing.assert_array_equal(found, np.flatnonzero(inside))
    everything = points_within(polygon, np.full(2, -1e9), np.full(2, 1e9), most=count)
    assert everything is not None
    assert len(everything) == count
    assert points_within(polygon, np.full(2, -1e9), np.full(2, 1e9), most=count - 1) is None


@given(st.integers(2, 3000), SEEDS, st.booleans(), st.floats(0.1, 100))
def test_the_nearest_point_is_that_of_brute_force(
    count: int, seed: int, closed: bool, radius: float
) -> None:
    points = scattered(count, seed)
    place = np.random.default_rng(seed + 1).normal(0, 100, 2)
    found = nearest_point(polygon_of(points, closed), place, radius)
    distances = np.hypot(*(points - place).T)
    if distances.min() > radius:
        assert found is None
    else:
        assert found == (int(distances.argmin()), pytest.approx(distances.min()))


def test_of_points_at_one_place_the_last_is_taken() -> None:
    points = np.zeros((20, 2))
    assert nearest_point(polygon_of(points, True), np.zeros(2), 1.0) == (19, 0.0)
    assert nearest_point(polygon_of(points, True), np.full(2, 2.0), 1.0) is None


@given(convergent_members(), st.integers(3, 300), SEEDS, st.booleans(), st.floats(0.5, 50))
def test_the_nearest_place_is_that_of_a_dense_curve(
    member: Parameters, count: int, seed: int, closed: bool, radius: float
) -> None:
    curve = LimitCurve(scattered(count, seed), member.mask, closed)
    place = np.random.default_rng(seed + 1).normal(0, 80, 2)
    found = nearest_place(outline(curve), place, radius)
    dense = curve.points(7)
    distances = np.hypot(*(dense - place).T)
    gap = np.hypot(*np.diff(dense, axis=0).T).max()
    slack = radius / 32
    if found is None:
        assert distances.min() > radius - slack
    else:
        assert distances.min() - gap - slack <= found[1] <= distances.min() + slack


def test_the_parameter_is_that_of_the_place() -> None:
    curve = LimitCurve(scattered(300, 5), PRESETS["Lean"].mask, False)
    pyramid = outline(curve)
    for t in (0.0, 0.4, 17.3, 150.5, 298.9):
        found = nearest_place(pyramid, curve.at(t), 1e-3)
        assert found is not None
        assert np.hypot(*(curve.at(min(found[0], 299)) - curve.at(t))) < 1e-4


def test_a_polygon_is_seen_and_picked_like_a_curve() -> None:
    points = scattered(700, 3)
    polygon = polygon_of(points, True)
    seen = view(polygon, np.full(2, -1e9), np.full(2, 1e9), 1e-9)
    np.testing.assert_array_equal(seen.vertices[:-1], points)
    middle = (points[40] + points[41]) / 2
    found = nearest_place(polygon, middle, 1e-3)
    assert found is not None
    assert found[0] == pytest.approx(40.5, abs=1e-3)


def test_a_long_straight_polygon_takes_few_vertices() -> None:
    angle = np.linspace(0, 2 * np.pi, 200_000, endpoint=False)
    circle = 500 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    seen = view(polygon_of(circle, True), np.full(2, -600.0), np.full(2, 600.0), 0.25)
    assert len(seen.vertices) < 300


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("index", [0, 7, 8, 500, 999])
def test_a_moved_point_is_found_where_it_went(closed: bool, index: int) -> None:
    live = LiveCurve(scattered(1000, 2), PRESETS["Calm"].mask, closed)
    blocks = Blocks(live)
    live.move(index, (1e4, 1e4))
    blocks.update(index)
    assert nearest_point(PolygonPyramid(blocks), np.full(2, 1e4), 1.0) == (index, 0.0)


@given(st.integers(2, 500), SEEDS, st.booleans(), st.floats(0, 7))
@costly
def test_points_and_places_are_found_where_the_polygon_lies(
    count: int, seed: int, closed: bool, turn: float
) -> None:
    points = scattered(count, seed)
    cos, sin = np.cos(turn), np.sin(turn)
    placed = Affine(np.array([[2 * cos, -sin], [2 * sin, cos]]), np.array([30.0, -500.0]))
    polygon, there = polygon_of(points, closed), placed(points)
    lower = there[0] - 40
    upper = lower + 90
    inside = ((there >= lower) & (there <= upper)).all(axis=1)
    found = points_within(polygon, lower, upper, placed=placed)
    np.testing.assert_array_equal(found, np.flatnonzero(inside))
    hit = nearest_point(polygon, there[-1], 1e-6, placed)
    assert hit is not None
    assert hit[0] == count - 1
    place = nearest_place(polygon, (there[0] + there[1]) / 2, 1e-3, placed)
    assert place is not None
    assert place[1] < 1e-4
