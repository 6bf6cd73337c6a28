import numpy as np
import pytest
from hypothesis import given

from core.document import Curve, Document
from core.errors import NinepointError
from core.formats.contours import Contours
from drawings import documents, extents, letter_f, tolerances


@given(documents, tolerances)
def test_the_deviation_with_the_rounding_stays_within_the_tolerance(document, tolerance):
    contours = Contours.of(document, tolerance, 2)
    assert 0.7 * 10.0**-contours.decimals <= contours.deviation_mm <= tolerance


@given(documents, tolerances)
def test_the_extents_are_those_of_the_exact_curves(document, tolerance):
    contours = Contours.of(document, tolerance, 4)
    low, high = extents(document)
    # The dense points are exact, but the extreme may lie between them: hence only one side.
    assert (contours.low <= low + tolerance).all()
    assert (contours.high >= high - tolerance).all()


def test_one_contour_for_each_curve_closed_as_it_is():
    contours = Contours.of(letter_f(), 0.01, 4)
    assert contours.names == ("Letter F", "Stroke")
    assert [line.closed for line in contours.polylines] == [True, False]
    assert contours.closed == 1
    assert contours.vertices == sum(len(line.points) for line in contours.polylines)


def test_no_vertex_is_repeated():
    corners = np.repeat([(0, 0), (10, 0), (10, 10), (0, 10)], 9, axis=0)
    for closed in (True, False):
        document = Document((Curve(corners, closed),))
        (line,) = Contours.of(document, 0.01, 4).polylines
        assert (np.diff(line.points, axis=0) != 0).any(axis=1).all()
        assert (line.points[0] != line.points[-1]).any()


def test_an_open_curve_that_comes_back_keeps_both_ends():
    document = Document((Curve([(0, 0), (10, 0), (10, 10), (0, 0)], closed=False),))
    (line,) = Contours.of(document, 0.01, 4).polylines
    assert line.points[0].tolist() == line.points[-1].tolist() == [0, 0]


def test_curves_without_extent_are_left_out():
    dots = (Curve([]), Curve([(1, 2)]), Curve([(1, 2)] * 5))
    segment = Curve([(0, 0), (3, 4)], closed=True, name="Segment")
    contours = Contours.of(Document((*dots, segment, *dots)), 0.01, 4)
    assert contours.names == ("Segment",)
    assert contours.closed == 0
    assert contours.polylines[0].points.tolist() == [[0, 0], [3, 4]]
    for curves in ((), dots):
        with pytest.raises(NinepointError, match="nothing to export"):
            Contours.of(Document(curves), 0.01, 4)


def test_a_curve_smaller_than_the_decimals_has_no_extent():
    tiny = Curve([(5, 5), (5 + 1e-8, 5), (5, 5 + 1e-8)])
    large = Curve([(0, 0), (3, 4)], name="Segment")
    assert Contours.of(Document((tiny, large)), 0.01, 4).names == ("Segment",)


@pytest.mark.parametrize(
    ("tolerance", "decimals"), [(100, 2), (1, 2), (0.1, 3), (0.05, 4), (0.01, 4), (0.001, 5)]
)
def test_the_tolerance_sets_the_decimals(tolerance, decimals):
    contours = Contours.of(letter_f(), tolerance, 2)
    assert contours.decimals == decimals
    for line in contours.polylines:
        assert np.array_equal(line.points, np.round(line.points, decimals))
