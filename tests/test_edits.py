"""Edits are pure: the old document stays, what is not touched is shared."""

import numpy as np
import pytest

from app.edits import (
    counted,
    moved,
    with_moved,
    with_new_curve,
    with_point_on_edge,
    without_points,
)
from app.handles import EdgeHit
from core.document import MAX_COORDINATE_MM, Curve, Document


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
