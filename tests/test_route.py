"""The polygon along a chain of cubics: its bound, its places and its corners."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chains import chain, drawn, lines
from core.errors import NinepointError
from core.route import Route


@given(
    st.integers(0, 10**6), st.integers(1, 6), st.booleans(), st.sampled_from([3.0, 0.1, 0.001])
)
def test_cubics_keep_to_the_polygon(seed, count, closed, admitted):
    controls = chain(seed, count, closed)
    route = Route(controls, closed, admitted)
    assert route.bound <= admitted
    points = drawn(controls).ravel()
    start, way = route.vertices[:-1], np.diff(route.vertices)
    # Each point belongs to one of the sides near it along the chain; the nearest is near enough.
    for block in np.array_split(points[::7], 20):
        off = block[:, None] - start
        share = np.clip((off * way.conj()).real / np.abs(way) ** 2, 0, 1)
        assert np.abs(off - share * way).min(axis=1).max(initial=0) <= route.bound + 1e-9


def test_places_are_lengths():
    route = Route(lines([(0, 0), (3, 0), (3, 4)], False), False, 0.01)
    assert route.length == pytest.approx(7)
    at = route.at(np.array([-1, 0, 1, 3, 5, 7, 9.0]))
    np.testing.assert_allclose(at, [0, 0, 1, 3, 3 + 2j, 3 + 4j, 3 + 4j], atol=1e-12)
    np.testing.assert_allclose(route.directions(np.array([-1, 1, 3, 9.0])), [1, 1, 1j, 1j])


def test_places_of_a_closed_route_go_round():
    route = Route(lines([(0, 0), (4, 0), (4, 4), (0, 4)], True), True, 0.01)
    assert route.length == pytest.approx(16)
    np.testing.assert_allclose(route.at(np.array([-2.0, 14, 30])), 2j, atol=1e-12)
    np.testing.assert_allclose(route.directions(np.array([-2.0, 17])), [-1j, 1], atol=1e-12)


def test_corners_are_where_lines_meet_not_where_an_arc_turns():
    square = Route(lines([(0, 0), (4, 0), (4, 4), (0, 4)], True), True, 0.01)
    np.testing.assert_allclose(square.corners, [0, 4, 8, 12])
    assert square.turning == pytest.approx(2 * np.pi)
    bow = Route(np.array([[(0, 0), (0, 5), (10, 5), (10, 0)]], dtype=float), False, 0.001)
    assert len(bow.corners) == 0
    assert bow.turning == pytest.approx(np.pi, rel=0.05)
    hook = Route(lines([(0, 0), (4, 0), (0, 0.1)], False), False, 0.01)
    np.testing.assert_allclose(hook.corners, [4])


def test_cubics_of_no_extent_leave_no_trace():
    controls = lines([(0, 0), (0, 0), (5, 0), (5, 0), (5, 0), (9, 0)], False)
    np.testing.assert_allclose(Route(controls, False, 0.01).vertices, [0, 5, 9])


@given(st.integers(0, 10**6), st.integers(1, 6), st.booleans(), st.integers(1, 40))
def test_parts_rise_from_the_start_to_the_end(seed, count, closed, parts):
    route = Route(chain(seed, count, closed), closed, 0.1)
    places = route.shared(parts)
    assert len(places) == parts + 1
    assert (np.diff(places) > 0).all()
    assert places[[0, -1]].tolist() == [0, route.length]


def test_bent_stretches_get_more_parts_than_straight_ones():
    bow = [[(100, 0), (105, 0), (105, 8), (100, 8)]]
    controls = np.concatenate([lines([(0, 0), (100, 0)], False), np.array(bow, dtype=float)])
    places = Route(controls, False, 0.001).shared(20)
    assert (places > 95).sum() >= 8


@given(st.integers(0, 10**6), st.booleans())
def test_nearer_places_are_never_further(seed, closed):
    rng = np.random.default_rng(seed)
    route = Route(chain(seed, 4, closed), closed, 0.1)
    points = rng.uniform(0, 50, 30) + 1j * rng.uniform(0, 50, 30)
    places = rng.uniform(0, route.length, 30)
    found = route.nearer(points, places, np.full(30, 5.0), 3)
    before, after = np.abs(points - route.at(places)), np.abs(points - route.at(found))
    assert (after <= before + 1e-12).all()
    assert after.sum() < before.sum()


def test_a_dot_is_refused():
    with pytest.raises(NinepointError, match="dot"):
        Route(np.full((3, 4, 2), 7.0), True, 0.01)


def test_what_would_fill_the_memory_is_refused():
    huge = np.array([[(0, 0), (1e12, 1e12), (-1e12, 1e12), (1, 0)]])
    with pytest.raises(NinepointError, match="too long"):
        Route(huge, False, 1e-6)
