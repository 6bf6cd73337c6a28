"""Polylines within a tolerance, and the proof of their deviation."""

from contextlib import contextmanager
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.bent import Bending
from core.continuity import smoothness
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.flatten import polyline
from core.limit import LimitCurve
from core.samples import Sampling
from core.shape import curvatures, tangents
from effort import costly
from oracles import convergent_members

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


def distance_to_polyline(points, vertices, closed):
    """Largest distance of the points from a polyline, by brute force."""
    start = vertices if closed else vertices[:-1]
    end = np.roll(vertices, -1, axis=0) if closed else vertices[1:]
    chord = end - start
    length = np.maximum((chord**2).sum(axis=1), 1e-300)
    nearest = np.full(len(points), np.inf)
    for s, c, square in zip(start, chord, length, strict=True):
        share = np.clip(((points - s) @ c) / square, 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - s - share[:, None] * c).T))
    return nearest.max()


@contextmanager
def cut_by(way):
    """Second derivatives are not looked at, if all is to be measured."""
    with pytest.MonkeyPatch.context() as patch:
        if way == "samples":
            patch.setattr(Bending, "of", lambda curve, tolerance: None)
        yield


ways = st.sampled_from(["second derivatives", "samples"])


def parts_of(curve, count):
    """Open curves that are about as long together as a closed one, each of few samples."""
    size = len(curve.control_points) // count
    for begin in range(0, count * size, size):
        part = np.take(curve.control_points, range(begin, begin + size + 1), axis=0, mode="wrap")
        yield LimitCurve(part, curve.mask, False)


@given(
    convergent_members(),
    st.integers(2, 9),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([1.0, 0.1, 0.01]),
    ways,
)
def test_the_curve_keeps_within_the_stated_deviation(
    parameters, n, seed, closed, tolerance, way
):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    try:
        with cut_by(way):
            flat = polyline(curve, tolerance)
    except NinepointError:
        # Refused as too rough, which nearly continuous curves only are.
        assert smoothness(parameters.mask).exponent.lower < 4 / 5
        return
    assert flat.closed == closed
    assert flat.deviation <= tolerance
    dense = curve.points(9)
    assert distance_to_polyline(dense, flat.points, closed) <= flat.deviation


@costly  # each looks among 200,000 exact points
@given(convergent_members(["translated"]), st.integers(0, 10**6), st.booleans())
def test_vertices_lie_on_the_curve_and_no_vertex_is_repeated(parameters, seed, closed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(6, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    flat = polyline(curve, 0.1)
    exact, found = (np.round(p, 9) @ [1, 1j] for p in (curve.points(15), flat.points))
    assert np.isin(found, exact).all()
    assert len(np.unique(flat.points, axis=0)) == len(flat.points)


def test_a_finer_tolerance_never_takes_fewer_vertices():
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    counts = [len(polyline(curve, tolerance).points) for tolerance in (1, 0.1, 0.01, 0.001)]
    assert counts == sorted(counts)
    assert counts[0] >= 8


@pytest.mark.parametrize(("name", "uniform"), [("Calm", 206), ("Tight", 192)])
def test_far_fewer_vertices_than_by_cutting_uniformly(name, uniform):
    flat = polyline(LimitCurve(SHAPE, PRESETS[name].mask, True), 0.01)
    assert len(flat.points) <= 0.8 * uniform


@pytest.mark.parametrize("name", PRESETS)
def test_about_as_few_vertices_as_the_curvature_asks_for(name):
    """Chords of deviation d are ``sqrt(8 d / k)`` long; no polyline through the curve has less."""
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    for tolerance in (0.01, 0.001):
        speed = np.hypot(*tangents(curve, 11).T)
        bend = np.sqrt(np.abs(curvatures(curve, 11)) / (8 * tolerance)) * speed
        needed = bend.sum() / 2**11
        assert len(polyline(curve, tolerance).points) <= 1.06 * needed + 1


@pytest.mark.parametrize("way", ["second derivatives", "samples"])
def test_a_straight_polygon_takes_one_chord(way):
    for count in (2, 6, 1000):
        straight = np.outer(np.arange(count) ** 1.5, [3.0, 4.0])
        with cut_by(way):
            flat = polyline(LimitCurve(straight, PRESETS["Calm"].mask, False), 0.01)
        assert flat.points.tolist() == [straight[0].tolist(), straight[-1].tolist()]


def test_a_straight_run_in_a_curve_takes_one_chord():
    side = np.arange(1, 200)[:, None]
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * 600.0
    square = np.concatenate([a + side * (b - a) / 200 for a, b in pairwise([*corners, corners[0]])])
    flat = polyline(LimitCurve(square, PRESETS["B-spline"].mask, True), 0.01)
    lengths = np.hypot(*np.diff(flat.points, axis=0).T)
    assert (lengths > 500).sum() >= 3


@pytest.mark.parametrize("way", ["second derivatives", "samples"])
def test_a_curve_that_turns_back_on_a_line_keeps_its_turning_points(way):
    curve = LimitCurve([(0, 0), (30, 0), (10, 0), (40, 0)], PRESETS["Calm"].mask, False)
    with cut_by(way):
        flat = polyline(curve, 0.01)
    assert len(flat.points) <= 8
    x = curve.points(10)[:, 0]
    for turn in x[1:-1][(np.diff(x)[1:] > 0) != (np.diff(x)[:-1] > 0)]:
        assert np.abs(flat.points[:, 0] - turn).min() <= 0.01


def test_a_symmetric_curve_gets_about_as_many_vertices_on_both_sides():
    angle = np.arange(12) * np.pi / 6
    heart = np.stack([30 * np.sin(angle) ** 3, 24 * np.cos(angle) - 9 * np.cos(2 * angle)], axis=1)
    flat = polyline(LimitCurve(heart, PRESETS["Calm"].mask, True), 0.01)
    left, right = (flat.points[:, 0] < -1e-6).sum(), (flat.points[:, 0] > 1e-6).sum()
    assert abs(left - right) <= 2


def test_a_tolerance_beyond_the_size_of_a_closed_curve_leaves_a_triangle():
    flat = polyline(LimitCurve(SHAPE, PRESETS["Calm"].mask, True), 1000)
    assert len(flat.points) >= 3
    assert flat.deviation <= 1000


def test_long_curves_are_cut_in_blocks_without_a_gap():
    angle = np.linspace(0, 400 * np.pi, 6000, endpoint=False)
    spiral = angle[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    curve = LimitCurve(spiral, PRESETS["Tight"].mask, False)
    flat = polyline(curve, 0.001)
    assert flat.points[0].tolist() == spiral[0].tolist()
    assert flat.points[-1].tolist() == spiral[-1].tolist()
    steps = np.hypot(*np.diff(flat.points, axis=0).T)
    assert 0 < steps.min() < steps.max() < 20


@pytest.mark.parametrize("name", ["Tight", "B-spline"])
@pytest.mark.parametrize("tolerance", [0.02, 1.0])
@pytest.mark.parametrize("way", ["second derivatives", "samples"])
def test_long_curves_keep_within_the_stated_deviation(name, tolerance, way):
    """Of long curves it is only asked which chords are too long, not what each one's bound is."""
    rng = np.random.default_rng(3)
    points = np.cumsum(rng.normal(size=(2000, 2)), axis=0) * 30
    curve = LimitCurve(points, PRESETS[name].mask, True)
    assert Sampling(curve, tolerance, 1 / 3).count > 2**15
    with cut_by(way):
        flat = polyline(curve, tolerance)
        few = sum(len(polyline(part, tolerance).points) for part in parts_of(curve, 20))
    dense = rng.permutation(curve.points(7))[:300]
    away = distance_to_polyline(dense, flat.points, closed=True)
    assert away <= flat.deviation <= tolerance
    assert len(flat.points) <= 1.12 * few


@pytest.mark.parametrize("name", PRESETS)
def test_second_derivatives_take_no_more_vertices_than_samples(name):
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    for tolerance in (1.0, 0.1, 0.01, 0.001):
        bent = polyline(curve, tolerance)
        with cut_by("samples"):
            measured = polyline(curve, tolerance)
        assert len(bent.points) <= 1.02 * len(measured.points) + 1


def test_points_far_apart_and_many_at_one_place():
    points = np.repeat(SHAPE, 20, axis=0).astype(float)
    points[70:90] += np.random.default_rng(0).normal(size=(20, 2)) * 1e-7
    curve = LimitCurve(points, PRESETS["Lean"].mask, True)
    flat = polyline(curve, 0.01)
    assert distance_to_polyline(curve.points(5), flat.points, True) <= flat.deviation <= 0.01


@pytest.mark.parametrize("n", [0, 1])
def test_a_dot_is_its_own_polyline(n):
    flat = polyline(LimitCurve(np.full((n, 2), 5.0), PRESETS["Calm"].mask, False), 0.01)
    assert len(flat.points) == n
    assert flat.deviation == 0


def test_huge_offsets_do_not_spoil_the_bound():
    shape = np.array(SHAPE, dtype=float)
    curve = LimitCurve(shape, PRESETS["Calm"].mask, True)
    far = polyline(LimitCurve(shape + 1e7, PRESETS["Calm"].mask, True), 0.01)
    near = polyline(curve, 0.01)
    assert abs(len(far.points) - len(near.points)) <= 2
    dense = curve.points(7)
    assert distance_to_polyline(dense, far.points - 1e7, True) <= far.deviation <= 0.01


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("way", ["second derivatives", "samples"])
def test_the_polyline_has_the_size_of_the_curve(name, way):
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    with cut_by(way):
        flat, dense = polyline(curve, 0.1), curve.points(12)
    np.testing.assert_allclose(flat.points.min(axis=0), dense.min(axis=0), atol=1e-4)
    np.testing.assert_allclose(flat.points.max(axis=0), dense.max(axis=0), atol=1e-4)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan")])
def test_tolerances_must_be_positive(tolerance):
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    with pytest.raises(NinepointError, match="greater than 0"):
        polyline(curve, tolerance)


def test_a_tolerance_below_rounding_is_refused_in_a_sentence():
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    with pytest.raises(NinepointError, match="too rough"):
        polyline(curve, 1e-15)


def test_divergent_members_are_refused_in_a_sentence():
    with pytest.raises(NinepointError, match="No deviation can be proven"):
        polyline(LimitCurve(SHAPE, Parameters(50, 0, 0).mask, True), 0.01)
