"""Hit tests: the nearest thing within reach, against a slow search."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.handles import (
    DYADIC,
    nearest_edge,
    nearest_on_curve,
    nearest_point,
)

SQUARE = np.array([(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)])
FAR = SQUARE + 500.0
ALL = np.array([0, 4])

places = st.tuples(st.floats(-50, 150), st.floats(-50, 150)).map(np.array)


@given(places, st.floats(1, 80))
def test_nearest_point_is_the_nearest(pos, radius):
    hit = nearest_point([SQUARE], pos, radius)
    distances = np.hypot(*(SQUARE - pos).T)
    if hit is None:
        assert distances.min() > radius
    else:
        assert hit.distance_px == pytest.approx(distances.min())
        assert distances[hit.point] == pytest.approx(distances.min())


def test_among_points_at_one_place_the_upper_one_is_taken():
    twice = np.array([(5.0, 5.0), (9.0, 9.0), (5.0, 5.0)])
    assert nearest_point([twice], np.array([5.0, 5.0]), 10).key == (0, 2)
    assert nearest_point([SQUARE, SQUARE], np.zeros(2), 10).key == (1, 0)


def test_the_preferred_curve_wins_a_tie_but_not_against_a_nearer_point():
    assert nearest_point([SQUARE, SQUARE], np.zeros(2), 10, preferred=0).key == (0, 0)
    nearer = SQUARE + 1.0
    assert nearest_point([nearer, SQUARE], np.zeros(2), 10, preferred=0).key == (1, 0)


@given(places)
def test_nearest_edge_lies_on_the_edge(pos):
    hit = nearest_edge([SQUARE], [True], pos, 1e6)
    start, end = SQUARE[hit.edge], SQUARE[(hit.edge + 1) % 4]
    place = start + hit.share * (end - start)
    assert 0 <= hit.share <= 1
    assert np.hypot(*(place - pos)) == pytest.approx(hit.distance_px)
    dense = np.concatenate(
        [np.linspace(SQUARE[i], SQUARE[(i + 1) % 4], 201) for i in range(4)]
    )
    assert hit.distance_px <= np.hypot(*(dense - pos).T).min() + 1e-9


def test_an_open_polygon_has_no_last_edge():
    left = np.array([-3.0, 50.0])
    assert nearest_edge([SQUARE], [True], left, 6).edge == 3
    assert nearest_edge([SQUARE], [False], left, 6) is None


def test_edges_of_a_point_repeated_have_no_direction():
    twice = np.array([(5.0, 5.0), (5.0, 5.0)])
    hit = nearest_edge([twice], [False], np.array([5.0, 8.0]), 6)
    assert (hit.share, hit.distance_px) == (0.0, 3.0)


@pytest.mark.parametrize("points", [np.zeros((0, 2)), np.zeros((1, 2))])
def test_too_few_points_have_no_edge(points):
    assert nearest_edge([points], [False], np.zeros(2), 10) is None
    assert nearest_on_curve([points], [np.zeros(len(points))], [ALL], [0], np.zeros(2), 9) is None


@given(places)
def test_the_parameter_on_a_curve_is_linear_and_dyadic(pos):
    t, loop = np.arange(5.0), np.concatenate([SQUARE, SQUARE[:1]])
    hit = nearest_on_curve([loop], [t], [np.array([0, 5])], [4], pos, 1e6)
    assert hit.t * DYADIC == round(hit.t * DYADIC)
    assert 0 <= hit.t < 4
    edge, share = int(hit.t), hit.t % 1
    place = SQUARE[edge] + share * (SQUARE[(edge + 1) % 4] - SQUARE[edge])
    # Rounding t to 1/1024 moves the place by at most half of a 1024th of the edge.
    assert np.hypot(*(place - pos)) <= hit.distance_px + 100 / DYADIC


def test_the_end_of_an_open_curve_can_be_taken():
    t = np.array([0.0, 1.0, 2.0, 3.0])
    hit = nearest_on_curve([SQUARE], [t], [ALL], [0], np.array([-2.0, 101.0]), 6)
    assert hit.t == 3.0


def test_out_of_reach_is_nothing():
    nowhere = np.array([50.0, 50.0])
    assert nearest_point([SQUARE, FAR], nowhere, 10) is None
    assert nearest_edge([SQUARE, FAR], [True, True], nowhere, 10) is None
    assert nearest_point([], nowhere, 10) is None


def test_absurd_pixels_do_no_harm():
    wild = np.array([(-1e200, 0.0), (1e200, 1e200), (0.0, 0.0), (10.0, 0.0)])
    hit = nearest_edge([wild], [False], np.array([5.0, 1.0]), 6)
    assert hit.edge == 2


def test_a_gap_between_runs_of_a_curve_is_not_taken():
    starts, t = np.array([0, 2, 4]), np.array([0.0, 1.0, 5.0, 6.0])
    in_gap = np.array([102.0, 50.0])
    assert nearest_on_curve([SQUARE], [t], [starts], [0], in_gap, 6) is None
    assert nearest_on_curve([SQUARE], [t], [starts], [0], np.array([50.0, 98.0]), 6).t == 5.5
