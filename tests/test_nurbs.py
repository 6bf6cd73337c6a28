import numpy as np
import pytest
from ezdxf.math import BSpline, Vec3
from hypothesis import given
from hypothesis import strategies as st

from core.formats import nurbs
from core.formats.budget import Budget
from core.formats.dxf_tags import EntityError

TOLERANCE = 1e-4


def fitted(degree, knots, points, weights=None, tolerance=TOLERANCE):
    return nurbs.spline(
        degree,
        np.array(knots, dtype=float),
        np.array(points, dtype=float),
        None if weights is None else np.array(weights, dtype=float),
        tolerance,
        Budget(),
    )


def points_on(controls, count):
    t = np.linspace(0, 1, count)[:, None]
    a, b, c, d = (controls[:, i, None] for i in range(4))
    found = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    return found.reshape(-1, 2)


def by_hand(degree, knots, points, weights, t):
    """Point of a NURBS by Cox and de Boor's recursion."""

    def basis(i, p):
        if p == 0:
            return float(knots[i] <= t < knots[i + 1])
        total = 0.0
        for start, sign, other in ((i, 1, i), (i + 1, -1, i + 1)):
            width = knots[start + p] - knots[start]
            if width > 0:
                share = (t - knots[start]) / width if sign > 0 else (knots[start + p] - t) / width
                total += share * basis(other, p - 1)
        return total

    shares = np.array([basis(i, degree) * weights[i] for i in range(len(points))])
    return shares @ np.array(points) / shares.sum()


@st.composite
def splines(draw, weighted):
    degree = draw(st.integers(1, 6))
    count = draw(st.integers(degree + 1, degree + 5))
    steps = draw(st.lists(st.integers(0, 3), min_size=count + degree, max_size=count + degree))
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    if draw(st.booleans()):
        knots[: degree + 1], knots[count:] = knots[degree], knots[count]
    points = draw(
        st.lists(st.tuples(*2 * [st.integers(-50, 50)]), min_size=count, max_size=count)
    )
    weights = draw(st.lists(st.integers(1, 9), min_size=count, max_size=count))
    return degree, knots, points, weights if weighted else [1] * count


@pytest.mark.parametrize("weighted", [False, True])
@given(data=st.data())
def test_cubics_keep_to_the_spline_within_their_bound(weighted, data):
    degree, knots, points, weights = data.draw(splines(weighted))
    if not knots[degree] < knots[len(points)]:
        with pytest.raises(EntityError):
            fitted(degree, knots, points, weights)
        return
    parts = fitted(degree, knots, points, weights)
    deviation = max(part.deviation for part in parts)
    assert deviation <= TOLERANCE + 1e-9
    curve = np.concatenate([points_on(part.controls, 40) for part in parts])
    spacing = max(
        np.hypot(*np.diff(points_on(part.controls, 40).reshape(-1, 40, 2), axis=1).T).max()
        for part in parts
    )
    for share in np.linspace(0, 0.999, 23):
        t = knots[degree] + share * (knots[len(points)] - knots[degree])
        exact = by_hand(degree, knots, points, weights, t)
        distance = np.hypot(*(curve - exact).T).min()
        assert distance <= deviation + spacing / 2 + 1e-9


def test_a_quarter_circle_of_weights_is_one_within_its_bound():
    (one,) = fitted(2, [0, 0, 0, 1, 1, 1], [(1, 0), (1, 1), (0, 1)], [1, 0.5**0.5, 1], 1e-7)
    radii = np.hypot(*points_on(one.controls, 50).T)
    assert np.abs(radii - 1).max() <= one.deviation <= 1e-7


def test_a_clamped_cubic_is_exact():
    points = [(0, 0), (1, 5), (4, 4), (6, 0), (9, 1)]
    curve = BSpline([Vec3(p) for p in points], order=4)
    (one,) = fitted(3, curve.knots(), points)
    assert one.deviation < 1e-14
    theirs = [point.xy for point in curve.flattening(1e-6)]
    assert len(one.controls) == 2
    assert one.controls[0, 0].tolist() == [*theirs[0]][:2]


def test_knots_of_full_multiplicity_cut_the_spline():
    parts = fitted(1, [0, 0, 1, 1, 2, 2], [(0, 0), (1, 0), (5, 5), (6, 5)])
    assert [part.controls[:, [0, 3]].tolist() for part in parts] == [
        [[[0, 0], [1, 0]]],
        [[[5, 5], [6, 5]]],
    ]


@pytest.mark.parametrize(
    ("degree", "knots", "points", "weights"),
    [
        (0, [0, 1, 2], [(0, 0), (1, 1)], None),
        (3, [0] * 8, [(0, 0)] * 4, None),
        (3, [0, 0, 0, 0, 1, 1, 1], [(0, 0)] * 4, None),
        (1, [0, 0, 1, 1], [(0, 0), (np.nan, 1)], None),
        (1, [0, 0, np.inf, np.inf], [(0, 0), (1, 1)], None),
        (1, [0, 1, 0.5, 1], [(0, 0), (1, 1)], None),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1, 0]),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1, -1]),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1, np.nan]),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1]),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1, 1e10]),
        (21, [0] * 22 + [1] * 22, [(0, 0)] * 22, None),
    ],
)
def test_what_is_no_spline_is_refused(degree, knots, points, weights):
    with pytest.raises(EntityError):
        fitted(degree, knots, points, weights)


def test_wild_splines_end_in_a_budget_not_in_the_night(monkeypatch):
    monkeypatch.setattr(nurbs, "MAX_PIECES", 50)
    points = [(0, 0), (1e6, 1e6), (-1e6, 3), (5, -1e6), (7, 7), (1, 1)]
    with pytest.raises(EntityError):
        fitted(5, [0] * 6 + [1] * 6, points, tolerance=1e-9)
