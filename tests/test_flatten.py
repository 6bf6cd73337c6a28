"""Polylines within a tolerance, and the proof of their deviation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.flatten import polyline
from core.limit import LimitCurve
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


@given(
    convergent_members(),
    st.integers(2, 9),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([1.0, 0.1, 0.01]),
)
def test_the_curve_keeps_within_the_stated_deviation(parameters, n, seed, closed, tolerance):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    flat = polyline(curve, tolerance)
    assert flat.closed == closed
    assert flat.deviation <= tolerance
    dense = curve.points(7)
    assert distance_to_polyline(dense, flat.points, closed) <= flat.deviation


@given(convergent_members(["translated"]), st.integers(0, 10**6), st.booleans())
def test_vertices_lie_on_the_curve_and_no_vertex_is_repeated(parameters, seed, closed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(6, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    flat = polyline(curve, 0.1)
    exact = {tuple(p) for p in np.round(curve.points(10), 9)}
    assert all(tuple(p) in exact for p in np.round(flat.points, 9))
    assert len(np.unique(flat.points, axis=0)) == len(flat.points)


def test_a_finer_tolerance_never_takes_fewer_vertices():
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    counts = [len(polyline(curve, tolerance).points) for tolerance in (1, 0.1, 0.01, 0.001)]
    assert counts == sorted(counts)
    assert counts[0] >= 8


def test_a_straight_polygon_takes_one_chord_a_span():
    curve = LimitCurve(np.outer(np.arange(6), [3.0, 4.0]), PRESETS["Tight"].mask, False)
    assert len(polyline(curve, 0.01).points) == 6


@pytest.mark.parametrize("n", [0, 1])
def test_a_dot_is_its_own_polyline(n):
    flat = polyline(LimitCurve(np.full((n, 2), 5.0), PRESETS["Calm"].mask, False), 0.01)
    assert len(flat.points) == n
    assert flat.deviation == 0


def test_huge_offsets_do_not_spoil_the_bound():
    shape = np.array(SHAPE, dtype=float)
    flat = polyline(LimitCurve(shape + 1e7, PRESETS["Calm"].mask, True), 0.01)
    near = polyline(LimitCurve(shape, PRESETS["Calm"].mask, True), 0.01)
    assert len(flat.points) == len(near.points)
    np.testing.assert_allclose(flat.points - 1e7, near.points, atol=1e-6)


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
