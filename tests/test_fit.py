"""Few control points within a tolerance; each stated deviation is measured again by brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chains import chain, dense, drawn, furthest, lines
from core.beziers import beziers
from core.errors import NinepointError, NoLimitError
from core.family import PRESETS, Parameters
from core.fit import fit
from core.limit import LimitCurve
from effort import costly

CALM = PRESETS["Calm"].mask

GUITAR = [(0, 0), (30, -12), (62, -6), (80, 8), (100, 12), (125, 2), (150, -2), (172, 18)]
GUITAR += [(168, 48), (140, 62), (112, 52), (92, 44), (70, 52), (40, 62), (5, 52), (-12, 26)]


def circle(radius, pieces=4):
    angle = 2 * np.pi * np.arange(pieces + 1) / pieces
    points = radius * np.exp(1j * angle)
    points[-1] = points[0]
    handle = 4 / 3 * np.tan(np.pi / (2 * pieces)) * 1j * points
    ends = points[:-1], points[1:]
    z = np.stack([ends[0], ends[0] + handle[:-1], ends[1] - handle[1:], ends[1]], axis=1)
    return np.stack([z.real, z.imag], axis=-1)


def measured(found, controls, mask, steps=200):
    """Distance of the limit curve and the cubics, both ways."""
    curve = LimitCurve(found.points, mask, found.closed)
    level = 6 if len(found.points) > 40 else 8
    line, contour = dense(curve, level), drawn(controls, steps).ravel()
    return max(furthest(line[::3], contour), furthest(contour[::3], line))


@costly
@given(
    st.sampled_from(list(PRESETS)), st.integers(1, 4), st.booleans(), st.integers(0, 10**6),
    st.sampled_from([3.0, 0.3]),
)
def test_contour_and_curve_keep_to_each_other(name, count, closed, seed, tolerance):
    controls = chain(seed, count, closed and count > 1)
    mask = PRESETS[name].mask
    found = fit(controls, mask, closed and count > 1, tolerance)
    assert found.closed == (closed and count > 1)
    assert found.deviation <= tolerance
    # Both polygons of the measurement leave what they stand for by less than the last term.
    assert measured(found, controls, mask) <= found.deviation + 0.002
    if not found.closed:
        assert found.points[0].tolist() == controls[0, 0].tolist()
        assert found.points[-1].tolist() == controls[-1, 3].tolist()


@pytest.mark.parametrize(("radius", "most"), [(5, 8), (50, 10), (500, 20)])
def test_a_circle_takes_few_points(radius, most):
    controls = circle(radius)
    found = fit(controls, CALM, True, 0.01)
    assert len(found.points) <= most
    assert measured(found, controls, CALM, 1000) <= found.deviation + 0.0005
    assert found.deviation <= 0.01


def test_a_straight_line_takes_two_points():
    straight = np.outer([0, 1, 4, 4, 9, 30], [3.0, 4.0])
    found = fit(lines(straight, False), CALM, False, 0.01)
    assert found.points.tolist() == [[0, 0], [90, 120]]
    assert found.deviation < 1e-6


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("closed", [True, False])
def test_our_own_curves_are_found_again(name, closed):
    mask = PRESETS[name].mask
    drawing = beziers(LimitCurve(GUITAR, mask, closed), 0.001)
    found = fit(drawing.controls, mask, closed, 0.05, drawing.deviation)
    assert len(found.points) <= 1.75 * len(GUITAR)
    assert found.deviation <= 0.05
    exact = dense(LimitCurve(GUITAR, mask, closed), 7)
    assert furthest(dense(LimitCurve(found.points, mask, closed), 5), exact) <= found.deviation


def test_sharp_corners_are_kept_within_the_tolerance():
    controls = lines([(0, 0), (100, 0), (100, 60), (50, 10), (0, 60)], True)
    found = fit(controls, CALM, True, 0.05)
    assert measured(found, controls, CALM) <= found.deviation <= 0.05
    curve = dense(LimitCurve(found.points, CALM, True), 8)
    for corner in controls[:, 0] @ (1, 1j):
        assert np.abs(curve - corner).min() <= 0.05
    assert len(found.points) <= 12 * 5


def test_points_gather_where_the_contour_bends():
    bow = np.array([[(100, 0), (106, 0), (106, 8), (100, 8)]], dtype=float)
    controls = np.concatenate(
        [lines([(0, 0), (100, 0)], False), bow, lines([(100, 8), (0, 8)], False)]
    )
    found = fit(controls, CALM, False, 0.01)
    straight = found.points[:, 0] < 80
    assert straight.sum() <= 6
    assert measured(found, controls, CALM) <= found.deviation <= 0.01


def test_a_cusp_is_followed_to_its_end():
    controls = lines([(0, 0), (100, 1), (0, 2)], False)
    found = fit(controls, CALM, False, 0.1)
    curve = dense(LimitCurve(found.points, CALM, False), 8)
    assert np.abs(curve - (100 + 1j)).min() <= found.deviation <= 0.1


def test_a_spiral_of_many_turns_is_seen_as_one():
    angle = np.linspace(0, 40 * np.pi, 2000)
    points = (angle / 3)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    controls = lines(points, False)
    found = fit(controls, CALM, False, 0.1)
    assert found.deviation <= 0.1
    assert len(found.points) < 200
    assert measured(found, controls, CALM, 4) <= found.deviation + 0.01


def test_pieces_of_no_extent_change_nothing():
    controls = circle(20)
    dot = np.repeat(controls[:, 3:], 4, axis=1)
    found = fit(np.stack([controls, dot], axis=1).reshape(-1, 4, 2), CALM, True, 0.01)
    assert found.points.tolist() == fit(controls, CALM, True, 0.01).points.tolist()


def test_size_and_place_do_not_matter():
    controls = circle(20) * (1, 0.5)
    found = fit(controls, CALM, True, 0.01)
    moved = fit(controls * 1000 + (1e5, -3e5), CALM, True, 10)
    assert abs(len(moved.points) - len(found.points)) <= 1
    back = (moved.points - (1e5, -3e5)) / 1000
    curve = dense(LimitCurve(back, CALM, True), 8)
    assert furthest(curve, drawn(controls).ravel()) <= moved.deviation / 1000 + 1e-6


def test_coordinates_far_from_zero_keep_the_bound():
    controls = circle(20) + 1e7
    found = fit(controls, CALM, True, 0.01)
    assert found.deviation <= 0.01
    near = fit(circle(20), CALM, True, 0.01)
    assert abs(len(found.points) - len(near.points)) <= 1


def test_the_contours_own_deviation_counts():
    controls = circle(20)
    assert fit(controls, CALM, True, 0.01, 0.004).deviation >= 0.004
    with pytest.raises(NinepointError, match=r"known within 0\.02 mm only"):
        fit(controls, CALM, True, 0.01, 0.02)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan")])
def test_tolerances_must_be_positive(tolerance):
    with pytest.raises(NinepointError, match="greater than 0"):
        fit(circle(20), CALM, True, tolerance)


def test_a_tolerance_below_rounding_is_refused():
    with pytest.raises(NinepointError, match="known within"):
        fit(circle(20) + 1e6, CALM, True, 1e-12)


def test_a_tolerance_that_is_nothing_to_the_length_is_refused():
    with pytest.raises(NinepointError, match=r"within 1\.3e-06 mm at best"):
        fit(circle(20), CALM, True, 1e-7)


def test_too_few_points_say_how_close_they_come():
    with pytest.raises(NinepointError, match=r"With 12 points at most .* mm of this contour"):
        fit(lines(GUITAR, True), CALM, True, 0.01, most=12)


def test_a_dot_is_refused():
    with pytest.raises(NinepointError, match="dot"):
        fit(np.full((3, 4, 2), 7.0), CALM, True, 0.01)


def test_schemes_without_a_bound_are_refused():
    with pytest.raises(NoLimitError, match="No deviation can be proven"):
        fit(circle(20), Parameters(50, 0, 0).mask, True, 0.01)


@pytest.mark.parametrize(
    "controls", [np.zeros((0, 4, 2)), np.zeros((3, 2)), np.full((1, 4, 2), np.nan)]
)
def test_what_is_no_chain_of_cubics_is_refused(controls):
    with pytest.raises(ValueError, match="cubics must"):
        fit(controls, CALM, True, 0.01)


def test_a_tolerance_beyond_the_size_leaves_a_triangle():
    found = fit(circle(1), CALM, True, 50)
    assert len(found.points) == 3
    assert found.deviation <= 50


def test_the_search_stops_when_it_is_told_to():
    asked = []

    def cancelled():
        asked.append(True)
        return len(asked) > 3

    with pytest.raises(NinepointError, match="stopped"):
        fit(lines(GUITAR, True), CALM, True, 0.01, cancelled=cancelled)
    assert len(asked) == 4
