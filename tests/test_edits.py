"""Edits are pure: the old document stays, what is not touched is shared."""

import numpy as np
import pytest

from app.edits import (
    centred,
    chosen,
    counted,
    moved,
    uncovered,
    unused,
    with_curves,
    with_moved,
    with_new_curve,
    with_point_on_edge,
    without_points,
)
from app.handles import EdgeHit
from app.point_set import PointSet
from core.document import MAX_COORDINATE_MM, Curve, Document
from core.errors import NinepointError


@pytest.fixture
def document():
    return Document((Curve([(0, 0), (10, 0), (10, 10)]), Curve([(50, 50)], name="dot")))


def test_names_count_the_points():
    assert counted("Move", 1) == "Move point"
    assert counted("Delete", 3) == "Delete 3 points"


def test_moving_points_of_several_curves(document):
    after = moved(document, {(0, 1), (1, 0)}, (2, -3))
    np.testing.assert_array_equal(after.curves[0].points, [(0, 0), (12, -3), (10, 10)])
    np.testing.assert_array_equal(after.curves[1].points, [(52, 47)])
    np.testing.assert_array_equal(document.curves[0].points[1], (10, 0))


def test_curves_that_are_not_moved_are_shared(document):
    assert moved(document, {(0, 0)}, (1, 1)).curves[1] is document.curves[1]


def test_points_stop_at_the_admitted_edge(document):
    after = moved(document, {(0, 1)}, (1e12, 0))
    assert after.curves[0].points[1, 0] == MAX_COORDINATE_MM
    after = with_moved(document, 1, [0], [(1e300, -1e300)])
    np.testing.assert_array_equal(after.curves[1].points, [(MAX_COORDINATE_MM, -MAX_COORDINATE_MM)])


def test_a_curve_without_points_goes(document):
    after = without_points(document, {(0, 1), (1, 0)})
    assert len(after.curves) == 1
    np.testing.assert_array_equal(after.curves[0].points, [(0, 0), (10, 10)])


@pytest.mark.parametrize(
    ("edge", "share", "index", "place"), [(0, 0.25, 1, (2.5, 0)), (2, 0.5, 3, (5, 5))]
)
def test_a_new_point_lies_on_its_edge(document, edge, share, index, place):
    after, key = with_point_on_edge(document, EdgeHit(0, edge, share, 0.0))
    assert key == (0, index)
    np.testing.assert_array_equal(after.curves[0].points[index], place)
    assert len(after.curves[0].points) == 4


def test_a_new_curve_has_a_name_of_its_own(document):
    after = with_new_curve(document, [(0, 0), (1, 1)], closed=False)
    assert after.curves[-1].name == "Curve 3"
    assert not after.curves[-1].closed
    named = document.with_curve_added(Curve([(0, 0)], name="Curve 4"))
    assert with_new_curve(named, [(0, 0), (1, 1)], True).curves[-1].name == "Curve 5"


@pytest.mark.parametrize(
    ("name", "new"),
    [("Wing", "Wing 3"), ("Wing 2", "Wing 3"), ("Curve 1", "Curve 2"), ("Rib", "Rib")],
)
def test_a_name_that_is_taken_gets_the_next_number(name, new):
    assert unused(name, {"Wing", "Wing 2", "Curve 1"}) == new


def test_curves_are_added_under_names_of_their_own(document):
    after = with_curves(document, [Curve(np.eye(2), name="dot"), Curve(np.eye(2), name="dot")])
    assert [curve.name for curve in after.curves] == ["Curve", "dot", "dot 2", "dot 3"]
    assert after.curves[:2] == document.curves


def test_whole_curves_are_copied_as_they_are(document):
    assert chosen(document, PointSet({0: [0, 1, 2]})).curves == document.curves[:1]
    assert chosen(document, PointSet()) is document
    assert chosen(document, PointSet({0: [0, 1, 2], 1: [0]})).curves == document.curves


@pytest.mark.parametrize(
    ("closed", "members", "order"),
    [
        (True, [0, 1, 7], [7, 0, 1]),
        (True, [2, 3, 4], [2, 3, 4]),
        (True, [1, 6, 7], [6, 7, 1]),
        (False, [0, 1, 7], [0, 1, 7]),
        (False, [5], [5]),
    ],
)
def test_some_points_are_copied_as_an_open_curve_without_the_longest_gap(closed, members, order):
    whole = Curve(np.arange(16.0).reshape(8, 2), closed, "Wing")
    (part,) = chosen(Document((whole,)), PointSet({0: members})).curves
    assert part.points.tolist() == whole.points[order].tolist()
    assert (part.closed, part.name) == (False, "Wing")


def test_curves_that_would_cover_others_step_aside_as_often_as_needed(document):
    for _ in range(4):
        document = with_curves(document, uncovered(document, document.curves[:1], 2.0))
    starts = [tuple(curve.points[0]) for curve in document.curves if curve.count == 3]
    assert starts == [(0, 0), (2, -2), (4, -4), (6, -6), (8, -8)]


def test_curves_that_cover_nothing_stay(document):
    other = (Curve([(1, 0), (10, 0), (10, 10)]),)
    assert uncovered(document, other, 2.0) == other
    assert uncovered(document, (), 2.0) == ()


def test_curves_are_centred_together(document):
    after = centred(document.curves, (100, 100))
    low = np.min([curve.points.min(axis=0) for curve in after], axis=0)
    high = np.max([curve.points.max(axis=0) for curve in after], axis=0)
    np.testing.assert_allclose((low + high) / 2, (100, 100))
    with pytest.raises(NinepointError, match="leave the sheet"):
        centred(document.curves, (MAX_COORDINATE_MM, 0))
