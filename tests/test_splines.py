import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from core.document import Curve
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.splines import DEGREE, pieces, spline
from drawings import F_POINTS
from effort import costly
from independent import chord_error, exact_points, farthest

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]
ends = st.integers(-400, 400).map(lambda quarters: quarters / 4)
polygons = st.lists(st.tuples(ends, ends), min_size=2, max_size=9, unique=True)
presets = st.sampled_from(list(PRESETS.values()))


def oracle(found):
    """The spline by its definition: scipy's, over the knot vector with its clamped ends."""
    knots = np.concatenate([[found.knots[0]] * DEGREE, found.knots, [found.knots[-1]] * DEGREE])
    return BSpline(knots, found.controls, DEGREE)


def dense(found, parts=128):
    share = np.arange(parts) / parts
    t = (found.knots[:-1, None] + share * np.diff(found.knots)[:, None]).ravel()
    return oracle(found)(np.append(t, found.knots[-1]))


@costly
@given(polygons, st.booleans(), presets, st.sampled_from([0.02, 0.1, 1.0]))
def test_the_deviation_is_a_bound_both_ways_and_within_the_tolerance(points, closed, p, tolerance):
    curve = Curve(points, closed)
    found = spline(curve.limit(p), tolerance)
    assert found.deviation <= tolerance
    exact, line = exact_points(curve, p), dense(found)
    assert farthest(exact, line) <= found.deviation + chord_error(line)
    assert farthest(line, exact) <= found.deviation + chord_error(exact)


@given(polygons, st.booleans(), presets)
def test_knots_are_simple_and_rise_from_zero(points, closed, p):
    found = spline(Curve(points, closed).limit(p), 0.1)
    assert found.knots[0] == 0
    assert (np.diff(found.knots) > 0).all()
    assert np.array_equal(found.knots, np.round(found.knots))
    assert len(found.controls) == len(found.knots) + DEGREE - 1


@given(polygons.filter(lambda p: len(p) > 2), presets)
def test_a_closed_spline_ends_in_its_first_point_and_is_smooth_across_the_seam(points, p):
    found = spline(Curve(points, True).limit(p), 0.1)
    assert found.closed
    assert found.controls[0].tobytes() == found.controls[-1].tobytes()
    whole = oracle(found)
    for order in (1, 2):
        values = whole.derivative(order)(found.knots[[0, -1]])
        size = np.abs(whole.derivative(order)(found.knots)).max() + 1e-12
        assert np.abs(values[0] - values[1]).max() <= 1e-6 * size


@given(polygons, presets)
def test_an_open_spline_keeps_both_ends_and_their_tangents(points, p):
    curve = Curve(points, False)
    found = spline(curve.limit(p), 0.1)
    assert found.controls[0].tolist() == list(points[0])
    assert found.controls[-1].tolist() == list(points[-1])
    slope = curve.limit(p).span_points(slice(0, 1), 0, 1)[0, 0]
    own = found.controls[1] - found.controls[0]
    assert abs(slope[0] * own[1] - slope[1] * own[0]) <= 1e-9 * (1 + np.hypot(*slope)) * 100


@given(polygons, st.booleans(), presets)
def test_its_pieces_are_the_spline(points, closed, p):
    found = spline(Curve(points, closed).limit(p), 0.1)
    cubics = pieces(found.knots, found.controls)
    assert np.array_equal(cubics, found.beziers)
    assert np.array_equal(cubics[1:, 0], cubics[:-1, 3])
    whole = oracle(found)
    for u in (0.0, 0.3, 0.5, 1.0):
        v = 1 - u
        weights = np.array([v**3, 3 * u * v * v, 3 * u * u * v, u**3])
        at = found.knots[:-1] + u * np.diff(found.knots)
        assert np.abs(np.einsum("k,ikx->ix", weights, cubics) - whole(at)).max() < 1e-9


@pytest.mark.parametrize(("name", "most"), [("Calm", 40), ("Tight", 32), ("B-spline", 20)])
def test_few_pieces_do_for_a_smooth_shape(name, most):
    found = spline(Curve(SHAPE, True).limit(PRESETS[name]), 0.01)
    assert len(found.knots) - 1 <= most


def test_a_finer_tolerance_needs_the_fourth_root_of_it_in_pieces():
    curve = Curve(SHAPE, True).limit(PRESETS["Tight"])
    coarse, fine = (len(spline(curve, tolerance).knots) for tolerance in (0.1, 1e-5))
    assert fine <= 1.4 * 10 * coarse


def test_corners_of_repeated_points_are_kept():
    corners = np.repeat(F_POINTS, 9, axis=0)
    curve = Curve(corners, True)
    found = spline(curve.limit(PRESETS["Calm"]), 0.01)
    assert found.deviation <= 0.01
    for corner in F_POINTS:
        assert farthest(np.array([corner]), dense(found)) <= 0.01


def test_a_straight_line_is_one_piece():
    found = spline(Curve([(0, 0), (30, 40)], False).limit(PRESETS["Calm"]), 0.01)
    assert found.knots.tolist() == [0, 1] or len(found.knots) == 2
    assert np.allclose(found.controls, [(0, 0), (10, 40 / 3), (20, 80 / 3), (30, 40)])


def test_what_is_too_rough_for_a_spline_gives_none():
    rough = Parameters("3/10", "-1/2", "-1/3", "mirrored")
    assert spline(Curve(SHAPE, True).limit(rough), 0.01) is None
    assert spline(Curve([(1, 2)], False).limit(PRESETS["Calm"]), 0.01) is None


def test_a_tolerance_that_is_not_positive_is_refused():
    for tolerance in (0.0, -1.0, float("nan")):
        with pytest.raises(NinepointError, match="greater than 0"):
            spline(Curve(SHAPE, True).limit(PRESETS["Calm"]), tolerance)


def test_too_many_samples_are_refused(monkeypatch):
    monkeypatch.setattr("core.splines.MAX_SAMPLES", 100)
    with pytest.raises(NinepointError, match="too many points for one spline"):
        spline(Curve(SHAPE, True).limit(PRESETS["Calm"]), 1e-4)
