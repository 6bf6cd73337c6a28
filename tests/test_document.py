"""Documents are immutable values with admitted coordinates."""

import tracemalloc
from dataclasses import replace

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.affine import Affine
from core.document import MAX_COORDINATE_MM, MAX_POINTS, Curve, Document
from core.errors import NinepointError
from core.family import PRESETS
from core.profiles import PROFILES

SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


def test_the_points_of_a_curve_cannot_be_written_to():
    source = np.array(SQUARE, dtype=float)
    curve = Curve(source)
    source[0] = 99
    assert curve.points[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        curve.points[0] = 1


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf"), 1e300])
def test_coordinates_out_of_reach_are_refused_by_point(bad):
    with pytest.raises(NinepointError, match="Point 2 of 'wing'"):
        Curve([(0, 0), (1, bad)], name="wing")


def test_the_largest_coordinate_is_admitted():
    assert Curve([(MAX_COORDINATE_MM, -MAX_COORDINATE_MM)]).points.shape == (1, 2)


def test_a_wrong_number_of_coordinates_is_refused():
    with pytest.raises(NinepointError, match="two coordinates"):
        Curve([(1, 2, 3)])


def test_too_many_points_are_refused():
    half = Curve(np.zeros((MAX_POINTS // 2 + 1, 2)))
    with pytest.raises(NinepointError, match="at most"):
        Document((half, half))


def test_edits_make_copies_and_leave_the_original():
    curve = Curve(SQUARE, closed=False, name="frame")
    moved = curve.moved([1, 2], [(20, 0), (20, 10)])
    assert moved.points[1:3].tolist() == [[20, 0], [20, 10]]
    assert curve.points[1].tolist() == [10, 0]
    assert curve.inserted(4, (5, 15)).points[-1].tolist() == [5, 15]
    assert curve.without([0, 3]).points.tolist() == [[10, 0], [10, 10]]
    assert (moved.name, moved.closed) == ("frame", False)


def test_documents_share_what_an_edit_does_not_touch():
    document = Document((Curve(SQUARE), Curve(SQUARE)))
    edited = document.with_curve(0, Curve(SQUARE[:3]))
    assert edited.curves[1] is document.curves[1]
    assert edited.parameters is document.parameters
    assert document.with_parameters(PRESETS["Tight"]).curves is document.curves
    assert document.with_curve_added(document.curves[0]).curves == (
        *document.curves,
        document.curves[0],
    )
    assert document.without_curves({0}).curves == (document.curves[1],)


@pytest.mark.parametrize(
    ("n", "closed", "loop"), [(2, True, False), (3, True, True), (3, False, False)]
)
def test_a_loop_needs_three_points(n, closed, loop):
    curve = Curve(SQUARE[:n], closed)
    assert curve.is_loop is loop
    assert curve.limit(PRESETS["Calm"]).closed is loop


def test_two_points_of_a_closed_curve_are_drawn_as_the_segment_between_them():
    points = Curve([(0, 0), (8, 4)], closed=True).limit(PRESETS["B-spline"]).points(2)
    np.testing.assert_allclose(points, [(0, 0), (2, 1), (4, 2), (6, 3), (8, 4)], atol=1e-12)


@given(
    st.integers(1, 80),
    st.lists(st.lists(st.integers(-80, 79), max_size=5), max_size=5),
    st.integers(0, 999),
)
def test_moves_on_moves_are_those_of_plain_arrays(count, moves, seed):
    rng = np.random.default_rng(seed)
    curve, points = Curve(rng.normal(size=(count, 2))), None
    points = curve.points.copy()
    curves = [curve]
    for indices in moves:
        chosen = [i % count for i in indices]
        positions = rng.normal(size=(len(chosen), 2))
        curve = curve.moved(chosen, positions)
        for i, place in zip(chosen, positions, strict=True):
            points[i] = place
        np.testing.assert_array_equal(curve.places(np.arange(count)), points)
        curves.append(curve)
    for other in curves:
        different = curve.differences(other)
        if different is not None:
            changed = np.flatnonzero((curve.points != other.points).any(axis=1))
            assert set(changed) <= set(different)
    np.testing.assert_array_equal(curve.points, points)
    assert curve.count == count
    with pytest.raises(ValueError, match="read-only"):
        curve.points[0] = 1.0


def test_a_move_in_a_long_curve_costs_what_moves():
    curve = Curve(np.zeros((200_000, 2)))
    tracemalloc.start()
    try:
        moved = curve.moved([7, -1], [(1.0, 2.0), (3.0, 4.0)])
        Document((moved,))
        again = moved.moved(7, (5.0, 6.0))
        assert again.is_loop
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 20_000
    assert again.differences(moved).tolist() == moved.differences(again).tolist() == [7]
    assert again.differences(curve).tolist() == [7, 199_999]
    sibling = moved.moved([3], (0.0, 1.0))
    assert again.differences(sibling).tolist() == [3, 7]
    assert again.places([6, 7, 199_999]).tolist() == [[0, 0], [5, 6], [3, 4]]
    assert again.differences(Curve(np.zeros((200_000, 2)))) is None
    assert again.points[7].tolist() == [5, 6]
    assert moved.points[7].tolist() == [1, 2]
    assert replace(moved, name="wing").points[-1].tolist() == [3, 4]


def test_moves_know_a_frozen_array_of_indices_again_but_no_array_that_may_change():
    curve, own = Curve(np.zeros((90, 2))), np.array([5, 8])
    frozen = own.copy()
    frozen.flags.writeable = False
    moved = curve.moved(frozen, (1.0, 2.0))
    assert moved.differences(curve) is frozen
    assert curve.moved(frozen, (3.0, 4.0)).differences(moved) is frozen
    moved = curve.moved(own, (1.0, 2.0))
    own[0] = 70
    assert moved.differences(curve).tolist() == [5, 8]


def test_a_curve_that_is_carried_costs_nothing_of_its_size():
    points = np.random.default_rng(1).normal(size=(200_000, 2))
    curve = Curve(points)
    curve.carried(Affine.shift((0.0, 0.0)))
    tracemalloc.start()
    try:
        there = curve.carried(Affine.shift((3.0, -4.0))).moved(7, (0.0, 0.0))
        Document((there,))
        again = there.carried(Affine.shift((1.0, 1.0)))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 20_000
    assert again.differences(curve).tolist() == [7]
    np.testing.assert_array_equal(again.placed.offset, (4.0, -3.0))
    np.testing.assert_array_equal(again.places([6, 7]), [points[6] + [4, -3], (1, 1)])
    expected = points + np.array([4, -3])
    expected[7] = 1, 1
    np.testing.assert_array_equal(again.points, expected)
    for carried in (again, curve, curve.carried(Affine.shift((5.0, 6.0)))):
        np.testing.assert_array_equal(carried.box[0], carried.points.min(axis=0))
        np.testing.assert_array_equal(carried.box[1], carried.points.max(axis=0))
    np.testing.assert_array_equal(curve.points, points)


def test_a_turned_curve_is_that_of_its_turned_points():
    turn = Affine(np.array([[0.6, -0.8], [0.8, 0.6]]), np.array([5.0, 6.0]))
    curve = Curve(SQUARE).carried(turn)
    expected = np.array(SQUARE) @ turn.matrix.T + turn.offset
    np.testing.assert_allclose(curve.points, expected, atol=1e-12)
    np.testing.assert_array_equal(curve.points, curve.places(np.arange(4)))
    assert Curve(np.zeros((0, 2))).carried(turn).count == 0


def test_profiles_of_a_drawing_have_different_names():
    laser = PROFILES["laser"]
    thin = msgspec.structs.replace(laser, tolerance_mm=0.002)
    document = Document().with_profile(laser).with_profile(thin)
    assert document.profiles == (thin,)
    assert document.without_profile("laser").profiles == ()
    with pytest.raises(NinepointError, match="same name"):
        Document(profiles=(laser, thin))


def test_a_curve_is_not_carried_off_the_sheet():
    with pytest.raises(NinepointError, match="leave the sheet"):
        Curve(SQUARE).carried(Affine.shift((MAX_COORDINATE_MM, 0)))


@pytest.mark.parametrize("index", [4, -5])
def test_a_point_that_is_not_there_cannot_move(index):
    with pytest.raises(IndexError, match="4 points"):
        Curve(SQUARE).moved(index, (0, 0))


def test_a_move_out_of_reach_is_refused_by_point():
    with pytest.raises(NinepointError, match="Point 3 of 'wing'"):
        Curve(SQUARE, name="wing").moved([0, 2], [(0, 0), (float("nan"), 0)])


def test_an_attribute_that_is_not_there_is_missed():
    with pytest.raises(AttributeError, match="colour"):
        _ = Curve(SQUARE).colour
