import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtGui import QPainterPath

from app.export_paths import LONG, joints_of, painter_paths, pieces_of
from core.arcs import Arcs
from core.document import Curve, Document
from core.flatten import Polyline
from core.formats.boxes import box_of
from core.formats.contours import Contours
from core.profiles import named
from drawings import letter_f

KINDS = {"laser": "arcs", "laser-r12": "polyline", "cad": "spline", "svg": "cubics"}


def shapes(name, tolerance=0.01):
    return [c.shape for c in Contours.of(letter_f(), named(name).within(tolerance)).contours]


def dense(pieces, count=20):
    """Points on cubics, shape (n, count, 2)."""
    u = np.linspace(0, 1, count)[:, None]
    v = 1 - u
    zero, one, two, three = (pieces[:, None, k] for k in range(4))
    return v**3 * zero + 3 * u * v * (v * one + u * two) + u**3 * three


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.floats(0.01, 20),
    st.floats(-1, 1).filter(lambda bulge: abs(bulge) > 1e-3),
)
def test_an_arc_is_two_cubics_along_it(start, length, bulge):
    """The circle is found from the bulge in another way: by its angle, in the complex plane."""
    points = np.array([start, (start[0] + length, start[1] + length / 3)])
    pieces = pieces_of(Arcs(points, np.array([bulge, 0.0]), False, True, 0.0))
    a, b = points @ [1, 1j]
    turn = 4 * np.arctan(bulge)
    centre = (a * np.exp(1j * turn) - b) / (np.exp(1j * turn) - 1)
    radius = abs(a - centre)
    off = np.abs(dense(pieces) @ [1, 1j] - centre) - radius
    assert np.abs(off).max() <= radius / 2000
    middle = centre + (a - centre) * np.exp(0.5j * turn)
    np.testing.assert_allclose(pieces[0, 3] @ [1, 1j], middle, atol=1e-9 * radius)
    np.testing.assert_array_equal(pieces[[0, 1], [0, 3]], points)


def test_a_line_among_arcs_stays_straight():
    points = np.array([(0.0, 0.0), (3.0, 4.0), (9.0, 4.0)])
    pieces = pieces_of(Arcs(points, np.zeros(3), False, False, 0.0))
    np.testing.assert_allclose(dense(pieces)[0] @ [4, -3], 0, atol=1e-12)


@pytest.mark.parametrize("name", KINDS)
def test_paths_cover_the_box_of_the_shape_and_close(name):
    for shape in shapes(name):
        low, high = box_of(shape)
        (path,) = painter_paths(shape, np.array([low[0], high[1]]), 10.0)
        seen = path.boundingRect()
        np.testing.assert_allclose(
            [seen.left(), seen.top(), seen.width(), seen.height()],
            [0, 0, *(high - low) * 10], atol=0.02,
        )  # fmt: skip
        ends = [path.elementAt(0), path.elementAt(path.elementCount() - 1)]
        assert ((ends[0].x, ends[0].y) == (ends[1].x, ends[1].y)) == shape.closed


@pytest.mark.parametrize("name", KINDS)
def test_joints_are_the_ends_of_entities_with_unit_directions(name):
    content = Contours.of(letter_f(), named(name).within(0.1))
    for contour in content.contours:
        places, ways = joints_of(contour.shape)
        assert len(places) == contour.pieces + (not contour.closed)
        np.testing.assert_allclose(np.hypot(*ways.T), 1)
        exact = contour.curve.limit(letter_f().parameters).points(9)
        off = np.abs((places - content.shift)[:, None] @ [1, 1j] - exact @ [1, 1j]).min(axis=1)
        assert off.max() < 0.2


def test_a_long_shape_comes_in_parts_that_join():
    t = np.linspace(0, 6, 3 * LONG + 5)
    shape = Polyline(np.stack([t, np.sin(t)], axis=1), True, 0.0)
    parts = list(painter_paths(shape, np.zeros(2), 1.0))
    assert len(parts) == 4
    for path, following in zip(parts, [*parts[1:], parts[0]], strict=True):
        assert isinstance(path, QPainterPath)
        # The last piece of one is the first of the next, so that the line has no notch there.
        last = [path.elementAt(path.elementCount() - 2), path.elementAt(path.elementCount() - 1)]
        first = [following.elementAt(0), following.elementAt(1)]
        assert [(e.x, e.y) for e in last] == [(e.x, e.y) for e in first]
    assert sum(path.elementCount() - 1 for path in parts) == len(t) + 4


def test_a_piece_that_stands_still_has_no_direction():
    curve = Curve([(0, 0), (10, 0), (10, 10)])
    (contour,) = Contours.of(Document((curve,)), named("svg")).contours
    still = np.repeat(contour.shape.controls[:1, :1], 4, axis=1)
    controls = np.concatenate([still, contour.shape.controls])
    _, ways = joints_of(type(contour.shape)(controls, True, True, 0.0))
    np.testing.assert_array_equal(ways[0], 0)
