import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.arcs import Arcs
from core.beziers import Beziers
from core.flatten import Polyline
from core.formats.boxes import box_of
from core.splines import Spline

numbers = st.integers(-100, 100).map(lambda n: n / 8)
places = st.tuples(numbers, numbers)
bulges = st.integers(-90, 90).map(lambda n: n / 100)


def sampled(points):
    return np.stack([points.min(axis=0), points.max(axis=0)])


def agree(found, dense, slack):
    assert (found[0] <= dense[0] + 1e-9).all()
    assert (found[1] >= dense[1] - 1e-9).all()
    assert np.abs(found - dense).max() <= slack


@given(st.lists(st.tuples(places, bulges), min_size=2, max_size=9, unique_by=lambda v: v[0]),
       st.booleans())  # fmt: skip
def test_the_box_of_arcs_is_that_of_their_points(vertices, closed):
    points = np.array([place for place, _ in vertices])
    curves = np.array([bulge for _, bulge in vertices])
    if not closed:
        curves[-1] = 0
    found = box_of(Arcs(points, curves, closed, False, 0.0))
    dense = []
    for k, (start, bulge) in enumerate(zip(points, curves, strict=True)):
        if k == len(points) - 1 and not closed:
            break
        end = points[(k + 1) % len(points)]
        # The arc through three points: both ends, and the chord's middle moved by its height.
        way = end - start
        top = (start + end) / 2 + bulge / 2 * np.array([way[1], -way[0]])
        dense.append(circle_through(start, top, end, bulge))
    agree(found, sampled(np.concatenate(dense)), 0.02)


def circle_through(start, top, end, bulge):
    if bulge == 0:
        return np.array([start, end])
    a, b = top - start, end - start
    double = 2 * (a[0] * b[1] - a[1] * b[0])
    centre = np.array([b[1] * (a @ a) - a[1] * (b @ b), a[0] * (b @ b) - b[0] * (a @ a)]) / double
    from_ = np.arctan2(*(-centre)[::-1])
    turn = 4 * np.arctan(bulge)
    angle = from_ + np.linspace(0, 1, 400) * turn
    return start + centre + np.hypot(*centre) * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@given(st.lists(st.tuples(places, places, places, places), min_size=1, max_size=4))
def test_the_box_of_cubics_is_that_of_their_points(controls):
    controls = np.array(controls)
    u = np.linspace(0, 1, 2001)[:, None]
    v = 1 - u
    dense = np.concatenate(
        [v**3 * a + 3 * u * v * v * b + 3 * u * u * v * c + u**3 * d for a, b, c, d in controls]
    )
    agree(box_of(Beziers(controls, False, False, 0.0)), sampled(dense), 1e-4)


def test_control_points_beyond_the_curve_do_not_count():
    bow = Beziers(np.array([[(0, 0), (0, 4), (4, 4), (4, 0)]], dtype=float), False, True, 0.0)
    assert box_of(bow).tolist() == [[0, 0], [4, 3]]
    spline = Spline(np.array([0.0, 1.0]), bow.controls[0], False, 0.0)
    assert box_of(spline).tolist() == [[0, 0], [4, 3]]


def test_half_a_circle_reaches_over_its_chord():
    arc = Arcs(np.array([(0.0, 0.0), (2.0, 0.0)]), np.array([0.99999999, 0.0]), False, True, 0.0)
    assert np.allclose(box_of(arc), [[0, -1], [2, 0]])


@given(st.lists(places, min_size=2, max_size=9))
def test_the_box_of_a_polyline_is_that_of_its_vertices(points):
    points = np.array(points)
    assert np.array_equal(box_of(Polyline(points, True, 0.0)), sampled(points))
