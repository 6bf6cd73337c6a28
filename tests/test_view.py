"""What is seen: all of it, within the tolerance, by few vertices, at every zoom."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.affine import Affine
from core.blocks import Blocks
from core.chords import chord_constant
from core.document import Curve
from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.live import LiveCurve
from core.picking import nearest_point
from core.pyramid import CurvePyramid, PolygonPyramid
from core.runs import Runs
from core.view import view
from oracles import convergent_members

MEMBERS = [*PRESETS.values(), Parameters("1/10", -1, "-1/10", "mirrored")]
members = pytest.mark.parametrize("member", MEMBERS, ids=[*PRESETS, "mirrored"])
both_ends = pytest.mark.parametrize("closed", [True, False], ids=["closed", "open"])

HALF_SCREEN = np.array([960.0, 540.0])
TOLERANCE_PX = 0.25


def flower(count: int, noise: float = 0.0) -> NDArray[np.float64]:
    """A closed curve that fills a screen of 1920 x 1080 pixels at zoom 1."""
    rng = np.random.default_rng(7)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 480 + 50 * np.sin(9 * angle)
    circle = radius[:, None] * np.stack([1.7 * np.cos(angle), np.sin(angle)], axis=-1)
    return circle + rng.normal(0, noise, (count, 2))


def outline(curve: LimitCurve) -> CurvePyramid:
    return CurvePyramid(Blocks(LiveCurve(curve.control_points, curve.mask, curve.closed)))


def looked_at(curve: LimitCurve, place: NDArray[np.float64], zoom: float) -> Runs:
    half = HALF_SCREEN / zoom
    return view(outline(curve), place - half, place + half, TOLERANCE_PX / zoom)


def true_error(curve: LimitCurve, seen: Runs, samples: int = 5) -> float:
    """Largest distance of curve points, found one by one, from the chords of their t."""
    worst = 0.0
    for first, after in zip(seen.starts[:-1], seen.starts[1:], strict=True):
        t = seen.parameters[first:after]
        for k in range(len(t) - 1):
            start, way = seen.vertices[first + k], np.diff(seen.vertices[first + k :][:2], axis=0)
            way = way[0]
            for share in (np.arange(samples) + 0.5) / samples:
                away = curve.at(t[k] + share * (t[k + 1] - t[k])) - start
                along = np.clip(away @ way / max(way @ way, 1e-300), 0, 1)
                worst = max(worst, float(np.hypot(*(away - along * way))))
    return worst


@members
@both_ends
@pytest.mark.parametrize("zoom", [1, 30, 1e3, 1e6])
def test_the_true_error_is_below_a_quarter_of_a_pixel(
    member: Parameters, closed: bool, zoom: float
) -> None:
    curve = LimitCurve(flower(24, 30.0), member.mask, closed)
    seen = looked_at(curve, curve.at(7.3), zoom)
    assert len(seen.vertices) > 1
    assert seen.deviation <= TOLERANCE_PX / zoom
    assert true_error(curve, seen, 2) <= seen.deviation + 1e-11


@pytest.mark.parametrize("count", [500, 5000])
@pytest.mark.parametrize("zoom", [0.01, 1, 3, 40])
def test_the_true_error_over_whole_blocks_of_spans(count: int, zoom: float) -> None:
    curve = LimitCurve(flower(count), PRESETS["Lean"].mask, True)
    seen = looked_at(curve, curve.at(7.3) if zoom > 1 else np.zeros(2), zoom)
    assert true_error(curve, seen, 3) <= seen.deviation + 1e-11 <= TOLERANCE_PX / zoom + 1e-11


@given(convergent_members(), st.integers(2, 300), st.integers(0, 999), st.booleans())
def test_nothing_seen_is_missed(member: Parameters, count: int, seed: int, closed: bool) -> None:
    rng = np.random.default_rng(seed)
    curve = LimitCurve(rng.normal(0, 100, (count, 2)), member.mask, closed)
    dense, t = curve.points(6), curve.parameters(6)
    place = dense[rng.integers(len(dense))]
    half = HALF_SCREEN * 10.0 ** rng.uniform(-4, 1)
    seen = view(outline(curve), place - half, place + half, 0.01 * half[0], budget=10**6)
    inside = (np.abs(dense - place) <= half).all(axis=1)
    covered = np.zeros(len(t), dtype=bool)
    for first, after in zip(seen.starts[:-1], seen.starts[1:], strict=True):
        covered |= (t >= seen.parameters[first]) & (t <= seen.parameters[after - 1])
    assert inside.any()
    assert not (inside & ~covered).any()
    assert (np.diff(seen.parameters)[np.diff(seen.parameters) <= 0] <= 0).sum() < len(seen.starts)


@members
@both_ends
def test_vertices_lie_on_the_curve_at_their_parameters(member: Parameters, closed: bool) -> None:
    curve = LimitCurve(flower(24, 30.0), member.mask, closed)
    seen = looked_at(curve, curve.at(7.3), 5.0)
    exact = np.array([curve.at(t) for t in seen.parameters])
    np.testing.assert_allclose(seen.vertices, exact, atol=1e-10)


@pytest.mark.parametrize("count", [20, 200, 2000, 20_000, 200_000])
def test_a_screen_takes_few_vertices_whatever_n_is(count: int) -> None:
    curve = LimitCurve(flower(count), PRESETS["Calm"].mask, True)
    assert len(looked_at(curve, np.zeros(2), 1.0).vertices) < 700
    assert len(looked_at(curve, curve.at(count / 3), 1e6).vertices) < 100


def test_a_scribble_keeps_the_budget_and_says_how_far_it_is_off() -> None:
    curve = LimitCurve(
        np.random.default_rng(1).normal(0, 100, (50_000, 2)), PRESETS["Calm"].mask, True
    )
    seen = view(outline(curve), -HALF_SCREEN, HALF_SCREEN, TOLERANCE_PX, budget=3000)
    assert 1500 < len(seen.vertices) < 4000
    assert seen.deviation > TOLERANCE_PX


def test_out_of_sight_there_is_nothing() -> None:
    seen = looked_at(LimitCurve(flower(50), PRESETS["Calm"].mask, True), np.full(2, 1e4), 1.0)
    assert seen.vertices.shape == (0, 2)
    assert list(seen.runs()) == []


def test_a_curve_that_is_seen_in_parts_comes_in_runs() -> None:
    seen = looked_at(LimitCurve(flower(400), PRESETS["Calm"].mask, True), np.zeros(2), 1.1)
    runs = list(seen.runs())
    assert len(runs) > 1
    assert sum(len(run) for run in runs) == len(seen.vertices)
    longest = max(np.hypot(*np.diff(run, axis=0).T).max() for run in runs)
    assert longest < 100


@pytest.mark.parametrize("zoom", [1.0, 1e3, 1e6])
def test_far_from_the_origin_nothing_jitters(zoom: float) -> None:
    # Multiples of 2^-20 below 2^30: the shifted polygon is exactly the same one.
    points = np.round(flower(40, 10.0) * 2**10) / 2**20
    far_away = np.array([2.0**29, -(2.0**28)])
    place = LimitCurve(points, PRESETS["Tight"].mask, True).at(7.25)
    half = HALF_SCREEN / 2**10 / zoom
    seen = []
    for offset in (np.zeros(2), far_away):
        pyramid = outline(LimitCurve(points + offset, PRESETS["Tight"].mask, True))
        # A float near the offset cannot name the place; it is given to the nearest one.
        centre = np.round((place + offset) * 2**20) / 2**20
        seen.append(view(pyramid, centre - 3 * half, centre + 3 * half, half[0] / 4000, centre))
    here, there = seen
    common = np.intersect1d(here.parameters, there.parameters)
    assert len(common) > 0
    a = here.vertices[np.searchsorted(here.parameters, common)]
    b = there.vertices[np.searchsorted(there.parameters, common)]
    if zoom >= 1e3:  # then no chord spans whole spans
        np.testing.assert_allclose(a, b, atol=1e-13, rtol=0)
    np.testing.assert_allclose(a, b, atol=1e-6, rtol=0)


@both_ends
@pytest.mark.parametrize("count", [2, 3, 8, 9])
@pytest.mark.parametrize("kind", ["equal", "collinear", "doubled", "tiny and huge"])
def test_degenerate_polygons_are_seen(count: int, closed: bool, kind: str) -> None:
    line = np.outer(np.arange(count), [3.0, 4.0])
    points = {
        "equal": np.ones((count, 2)),
        "collinear": line,
        "doubled": line[np.arange(count) // 2],
        "tiny and huge": line * np.where(np.arange(count) % 2, 1e-9, 1e9)[:, None],
    }[kind]
    curve = LimitCurve(points, PRESETS["Lean"].mask, closed)
    size = float(np.abs(points).max())
    seen = view(outline(curve), np.full(2, -9 * size), np.full(2, 9 * size), size / 1000)
    assert np.isfinite(seen.vertices).all()
    assert seen.parameters[0] == 0
    assert seen.parameters[-1] == curve.spans
    assert len(seen.starts) == 2


def test_a_moved_point_is_seen_where_it_went() -> None:
    live = LiveCurve(flower(3000), PRESETS["Calm"].mask, True)
    blocks = Blocks(live)
    pyramid = CurvePyramid(blocks)
    live.move(100, (0.0, 0.0))
    place = live.at(100)
    assert len(view(pyramid, place - 20, place + 20, 0.25).vertices) == 0
    blocks.update([100])
    seen = view(pyramid, place - 20, place + 20, 0.25)
    assert len(seen.vertices) > 2
    assert true_error(LimitCurve(live.control_points, live.mask, True), seen) <= 0.25


@pytest.mark.parametrize("zoom", [1.0, 5.0, 30.0, 1e3, 1e6])
def test_a_hatching_costs_no_more_than_it_may_and_is_right_where_it_can_be(zoom: float) -> None:
    count = 20_000
    x = np.repeat(np.linspace(-900, 900, count // 2), 2)
    y = np.where(np.arange(count) % 2, 500.0, -500.0)
    curve = LimitCurve(np.stack([x, y], axis=-1), PRESETS["Tight"].mask, False)
    seen = looked_at(curve, curve.at(6000.25), zoom)
    assert len(seen.vertices) < 20_000
    if zoom >= 1e3:
        assert len(seen.vertices) < 700
        assert seen.deviation <= TOLERANCE_PX / zoom
        assert true_error(curve, seen, 1) <= seen.deviation + 1e-11


def test_an_event_allocates_nothing_of_size_n() -> None:
    curve = Curve(flower(200_000))
    live = LiveCurve(curve.points, PRESETS["Calm"].mask, True)
    blocks = Blocks(live)
    pyramid, polygon = CurvePyramid(blocks), PolygonPyramid(blocks)

    def event(index: int) -> None:
        after = curve.moved(index, (30.0, 40.0))
        changed = after.differences(curve)
        assert changed is not None
        live.move(changed, after.places(changed))
        blocks.update(changed)
        view(pyramid, -HALF_SCREEN, HALF_SCREEN, TOLERANCE_PX)
        nearest_point(polygon, live.at(index), 8.0)

    event(70_000)
    tracemalloc.start()
    try:
        event(50_000)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 600_000


@both_ends
@pytest.mark.parametrize("zoom", [1e-9, 1e-3, 1.0])
def test_a_scheme_that_does_not_converge_is_seen_at_a_finite_level(
    zoom: float, closed: bool
) -> None:
    curve = LiveCurve(flower(3000), Parameters(100, -100, 100).mask, closed)
    level = outline(curve).finest
    assert level == 2
    finite = curve.points(level)
    place = finite[1000]
    seen = looked_at(curve, place, zoom)
    assert np.isinf(seen.deviation)
    assert 1 < len(seen.vertices) < 10_000
    for vertex, t in zip(seen.vertices, seen.parameters, strict=True):
        expected = finite[round(t * 2**level) % len(finite)]
        np.testing.assert_allclose(vertex, expected, atol=1e-9 * np.abs(finite).max())


def test_a_scheme_that_seems_to_converge_is_seen_fine() -> None:
    unproven = Parameters(0, -8, 0).mask
    with pytest.raises(NoLimitError):
        chord_constant(unproven)
    curve = LimitCurve(flower(30), unproven, True)
    assert outline(curve).finest == 6
    assert len(looked_at(curve, curve.points(0)[3], 20.0).vertices) > 64


@members
@both_ends
@pytest.mark.parametrize("count", [17, 18, 23, 900])
def test_another_scheme_needs_no_new_blocks(member: Parameters, closed: bool, count: int) -> None:
    live = LiveCurve(flower(count, 5.0), PRESETS["Lean"].mask, closed)
    blocks = Blocks(live)
    live.recast(member.mask)
    blocks.update_ends()
    curve = LimitCurve(live.control_points, member.mask, closed)
    np.testing.assert_allclose(live.points(3), curve.points(3), atol=1e-11)
    place = curve.at(7.3)
    half = HALF_SCREEN / 5
    seen = view(CurvePyramid(blocks), place - half, place + half, TOLERANCE_PX / 5)
    anew = looked_at(curve, place, 5.0)
    np.testing.assert_array_equal(seen.parameters, anew.parameters)
    np.testing.assert_allclose(seen.vertices, anew.vertices, atol=1e-11)
    assert true_error(curve, seen, 2) <= seen.deviation + 1e-11 <= TOLERANCE_PX / 5 + 1e-11


@both_ends
@pytest.mark.parametrize("turn", [0.0, 0.4, -1.1])
def test_a_curve_that_is_moved_as_a_whole_needs_no_new_blocks(closed: bool, turn: float) -> None:
    cos, sin = np.cos(turn), np.sin(turn)
    matrix = np.array([[3.0 * cos, -sin], [3.0 * sin, cos]]) if turn else np.eye(2)
    placed = Affine(matrix, np.array([7e3, -20.0]))
    points = flower(900, 3.0)
    curve = LimitCurve(placed(points), PRESETS["Lean"].mask, closed)
    pyramid = outline(LimitCurve(points, PRESETS["Lean"].mask, closed))
    place = curve.at(7.3)
    half = HALF_SCREEN / 5
    seen = view(pyramid, place - half, place + half, TOLERANCE_PX / 5, place, placed=placed)
    exact = np.array([curve.at(t) for t in seen.parameters])
    assert len(exact) > 10
    np.testing.assert_allclose(seen.vertices + place, exact, atol=1e-8)
    assert seen.deviation <= TOLERANCE_PX / 5 + 1e-11
    moved = seen._replace(vertices=seen.vertices + place)
    assert true_error(curve, moved, 2) <= seen.deviation + 1e-8
    dense, t = curve.points(5), curve.parameters(5)
    inside = t[(np.abs(dense - place) <= half).all(axis=1)]
    covered = np.zeros(len(inside), dtype=bool)
    for first, after in zip(seen.starts[:-1], seen.starts[1:], strict=True):
        covered |= (inside >= seen.parameters[first]) & (inside <= seen.parameters[after - 1])
    assert covered.all()
