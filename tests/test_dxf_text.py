import numpy as np
import pytest

from core.beziers import Beziers
from core.document import Curve
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats import dxf_text
from core.formats.contours import Contour
from core.splines import Spline

CURVE = Curve([(0, 0), (1, 1)], name="Segment")
LINE = Contour(CURVE, "L", Polyline(np.array([(0.0, -1.5), (2.25, 3.0)]), False, 0.0))
BOW = np.array([(0.0, 0.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)])


def tags(data):
    """Pairs of group code and value."""
    lines = data.decode("ascii").splitlines()
    assert len(lines) % 2 == 0
    return [(int(code), value) for code, value in zip(lines[::2], lines[1::2], strict=True)]


def test_an_lwpolyline_is_its_tags():
    assert tags(dxf_text.lwpolyline(LINE, 4, "2F", "17")) == [
        (0, "LWPOLYLINE"), (5, "2F"), (330, "17"), (100, "AcDbEntity"), (8, "L"),
        (100, "AcDbPolyline"), (90, "2"), (70, "0"),
        (10, "0.0"), (20, "-1.5"), (10, "2.25"), (20, "3.0"),
    ]  # fmt: skip


def test_a_polyline_of_r12_is_its_tags():
    assert tags(dxf_text.polyline(LINE, 4)) == [
        (0, "POLYLINE"), (8, "L"), (66, "1"), (10, "0.0"), (20, "0.0"), (30, "0.0"), (70, "0"),
        (0, "VERTEX"), (8, "L"), (10, "0.0"), (20, "-1.5"), (30, "0.0"),
        (0, "VERTEX"), (8, "L"), (10, "2.25"), (20, "3.0"), (30, "0.0"),
        (0, "SEQEND"), (8, "L"),
    ]  # fmt: skip


def test_a_spline_is_its_tags():
    contour = Contour(CURVE, "L", Spline(np.array([0.0, 16.0]), BOW, False, 0.0))
    found = tags(dxf_text.spline(contour, 4, "2F", "17"))
    assert found[5:12] == [
        (100, "AcDbSpline"), (70, "8"), (71, "3"), (72, "8"), (73, "4"), (74, "0"), (40, "0.0"),
    ]  # fmt: skip
    assert [value for code, value in found if code == 40] == ["0.0"] * 4 + ["16.0"] * 4
    assert [value for code, value in found if code == 10] == ["0.0", "0.0", "4.0", "4.0"]


def test_points_of_r2000_have_handles_and_those_of_r12_none():
    handles = iter(["30", "31"])
    rows = np.array([(1.0, 2.0), (3.0, 0.1)])
    new = tags(dxf_text.points(rows, "L", lambda: next(handles), "17"))
    assert [value for code, value in new if code == 5] == ["30", "31"]
    old = tags(dxf_text.points(rows, "L", lambda: next(handles), None))
    assert old[:5] == [(0, "POINT"), (8, "L"), (10, "1.0"), (20, "2.0"), (30, "0.0")]


def test_a_shape_of_another_kind_is_refused():
    cubics = Contour(CURVE, "L", Beziers(BOW[None], False, True, 0.0))
    with pytest.raises(NinepointError, match="'Segment' is no polyline"):
        dxf_text.lwpolyline(cubics, 4, "2F", "17")
    with pytest.raises(NinepointError, match="'Segment' is no spline"):
        dxf_text.spline(cubics, 4, "2F", "17")
