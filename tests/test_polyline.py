"""Polylines for Qt: nothing that is seen is lost, nothing that Qt cannot hold gets through."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.polyline import (
    DENSE,
    SAFE_PX,
    SNAP,
    SNAPPED_PX,
    point_of,
    polygon_of,
    snapped,
    thinned,
    within_square,
)  # fmt: skip

coordinates = st.one_of(st.floats(-300, 300), st.sampled_from([1e4, -1e4, 1e12, -1e35, 1e35]))
polylines = st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=8).map(np.array)


def cut_to(vertices, limit=100.0, *starts):
    """Parts within the square, of one run or several."""
    starts = np.array([0, *starts, len(vertices)])
    found, t, ends = within_square(vertices, np.arange(float(len(vertices))), starts, limit)
    assert len(t) == len(found) == ends[-1]
    assert all((np.diff(t[a:b]) >= 0).all() for a, b in pairwise(ends))
    return [found[a:b] for a, b in pairwise(ends)]


@given(polylines)
def test_parts_stay_within_the_square(vertices):
    for part in cut_to(vertices):
        assert len(part) >= 2
        assert np.abs(part).max() <= 100.0


@given(st.lists(st.tuples(st.floats(-300, 300), st.floats(-300, 300)), min_size=2, max_size=8))
def test_parts_hold_all_that_is_within_the_square(vertices):
    vertices = np.array(vertices)
    share = np.linspace(0, 1, 101)[:, None]
    dense = np.concatenate([a + share * (b - a) for a, b in pairwise(vertices)])
    inside = dense[(np.abs(dense) < 99.9).all(axis=1)]
    parts = cut_to(vertices)
    for place in inside:
        assert min(_distance(part, place) for part in parts) < 1e-6


def _distance(polyline, place):
    start, way = polyline[:-1], np.diff(polyline, axis=0)
    length = np.maximum((way**2).sum(axis=1), 1e-300)
    share = np.clip((way * (place - start)).sum(axis=1) / length, 0, 1)
    return np.hypot(*(start + share[:, None] * way - place).T).min()


def test_a_polyline_that_fits_stays_whole():
    vertices = np.array([(0.0, 0.0), (50.0, 80.0), (-20.0, 10.0)])
    (part,) = cut_to(vertices)
    np.testing.assert_array_equal(part, vertices)


def test_a_polyline_that_leaves_and_returns_falls_in_two():
    vertices = np.array([(0.0, 0.0), (500.0, 0.0), (500.0, 50.0), (0.0, 50.0)])
    first, second = cut_to(vertices)
    np.testing.assert_allclose(first, [(0, 0), (100, 0)])
    np.testing.assert_allclose(second, [(100, 50), (0, 50)])


def test_runs_that_were_apart_stay_apart():
    vertices = np.array([(0.0, 0.0), (50.0, 0.0), (60.0, 0.0), (500.0, 0.0)])
    first, second = cut_to(vertices, 100.0, 2)
    np.testing.assert_allclose(first, [(0, 0), (50, 0)])
    np.testing.assert_allclose(second, [(60, 0), (100, 0)])


def test_a_line_across_the_square_is_cut_on_both_sides():
    (part,) = cut_to(np.array([(-1e6, 10.0), (1e6, 10.0)]))
    np.testing.assert_allclose(part, [(-100, 10), (100, 10)])


def test_a_line_far_away_leaves_nothing():
    assert cut_to(np.array([(1e6, 10.0), (1e6, 90.0), (2e6, 0.0)])) == []


@pytest.mark.parametrize("ratio", [1.0, 1.25, 2.0])
def test_snapped_places_are_off_by_less_than_can_be_seen_and_stay_where_they_are(ratio):
    places = np.random.default_rng(0).uniform(-1e4, 1e4, (500, 2))
    found = snapped(places, ratio)
    assert np.hypot(*(found - places).T).max() * ratio <= SNAPPED_PX * (1 + 1e-9)
    np.testing.assert_array_equal(snapped(found, ratio), found)
    np.testing.assert_array_equal(found * ratio * SNAP, np.rint(found * ratio * SNAP))


def test_thinning_moves_a_dense_curve_by_less_than_the_eye_sees():
    angle = np.linspace(0, 2 * np.pi, 100_000)
    circle = 200 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    t = np.linspace(0, 1, len(circle))
    thin, times, starts = thinned(circle, t, np.array([0, 50_000, len(circle)]))
    assert len(times) == len(thin) == starts[-1]
    assert (thin[starts[1]] == circle[50_000]).all()
    assert (thin[starts[1] - 1] == circle[49_999]).all()
    assert len(thin) < 10_000
    assert max(_distance(thin, place) for place in circle[::1000]) < 0.36
    assert (thin[[0, -1]] == circle[[0, -1]]).all()
    few, _, _ = thinned(circle[:DENSE], t[:DENSE], np.array([0, DENSE]))
    assert len(few) == DENSE


def test_a_polygon_is_filled_through_its_buffer():
    vertices = np.array([(1.5, -2.0), (3.0, 4.25), (0.0, 0.0)])
    polygon = polygon_of(vertices)
    assert [(p.x(), p.y()) for p in polygon] == [tuple(v) for v in vertices]
    assert polygon_of(np.zeros((0, 2))).isEmpty()


def test_a_place_is_kept_within_what_qt_holds():
    assert point_of(np.array([1e300, -1e300])).toTuple() == (SAFE_PX, -SAFE_PX)
