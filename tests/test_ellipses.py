import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.formats import ellipses


def radii(numbers):
    controls = np.array(numbers).reshape(-1, 4, 2)
    t = np.linspace(0, 1, 400)[:, None]
    a, b, c, d = (controls[:, i, None] for i in range(4))
    points = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    return np.hypot(points[..., 0], points[..., 1])


@given(angle=st.floats(0.05, math.pi))
def test_the_bound_of_a_piece_holds_and_is_attained(angle):
    seen = radii(ellipses.arc((0, 0), (1, 0), (0, 1), 0.3, angle, 1)) - 1
    bound = ellipses.unit_deviation(angle)
    assert seen.min() >= -1e-15
    assert seen.max() <= bound + 1e-15
    if angle > 0.3:
        assert seen.max() >= 0.9 * bound


@given(
    radius=st.floats(1e-3, 1e9),
    sweep=st.floats(-2 * math.pi, 2 * math.pi).filter(bool),
    tolerance=st.floats(1e-6, 10),
)
def test_as_many_pieces_as_the_tolerance_needs(radius, sweep, tolerance):
    count = ellipses.piece_count(radius, sweep, tolerance)
    assert radius * ellipses.unit_deviation(sweep / count) <= max(tolerance, radius * 1e-16) * 1.001
    many = ellipses.pieces(np.array([radius]), np.array([sweep]), tolerance)
    assert many.tolist() == [count]


def test_two_quarters_make_a_half():
    assert ellipses.piece_count(1, math.pi, 1) == 2
    assert ellipses.piece_count(1, 2 * math.pi, 1) == 4


@given(
    st.lists(
        st.tuples(*6 * [st.floats(-9, 9)], st.floats(-7, 7), st.floats(-6, 6), st.integers(1, 9)),
        min_size=1,
        max_size=5,
    )
)
def test_many_arcs_are_those_drawn_one_by_one(arcs):
    rows = np.array([arc[:8] for arc in arcs])
    counts = np.array([arc[8] for arc in arcs])
    many = ellipses.cubics(rows[:, :2], rows[:, 2:4], rows[:, 4:6], rows[:, 6], rows[:, 7], counts)
    one_by_one = [
        number
        for x, y, a, b, c, d, start, sweep, count in arcs
        for number in ellipses.arc((x, y), (a, b), (c, d), start, sweep, count)
    ]
    assert np.allclose(many.ravel(), one_by_one, rtol=0, atol=1e-12)
