"""Pixels and millimetres: the mapping is exact both ways, and never leaves its bounds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.camera import DEFAULT_SPAN_MM, MAX_CENTRE_MM, MAX_SCALE, MIN_SCALE, Camera

pixels = st.floats(-5000, 5000)
millimetres = st.floats(-1e9, 1e9)


@st.composite
def cameras(draw):
    # Scales at which no push or zoom of these tests leads beyond the farthest centre.
    scale = 10 ** draw(st.floats(-5, 6))
    return Camera(draw(millimetres), draw(millimetres), scale, 900, 600)


@given(cameras(), pixels, pixels)
def test_there_and_back(camera, x, y):
    # The centre is rounded to eps times its size, the rest to eps times the way in pixels.
    digits = 4 * np.finfo(float).eps * max(abs(camera.x_mm), abs(camera.y_mm), 1.0) * camera.scale
    back = camera.to_pixels(camera.to_mm((x, y)))
    np.testing.assert_allclose(back, (x, y), atol=digits + 1e-9)


def test_y_points_up_in_the_drawing_and_down_on_the_screen():
    camera = Camera(0, 0, 10.0, 200, 100)
    np.testing.assert_allclose(camera.to_pixels((1, 1)), (110, 40))
    np.testing.assert_allclose(camera.to_mm((110, 40)), (1, 1))


@given(cameras(), st.floats(0.01, 100), st.floats(0, 900), st.floats(0, 600))
def test_zoom_holds_the_place_under_the_mouse(camera, factor, x, y):
    zoomed = camera.zoomed(factor, (x, y))
    held = camera.to_mm((x, y))
    digits = 8 * np.finfo(float).eps * max(np.abs(held).max(), 1.0) * zoomed.scale
    np.testing.assert_allclose(zoomed.to_pixels(held), (x, y), atol=digits + 1e-6)


@given(cameras(), st.floats(-2000, 2000), st.floats(-2000, 2000))
def test_a_push_moves_the_paper_by_pixels(camera, dx, dy):
    held = camera.to_mm((100, 100))
    digits = 8 * np.finfo(float).eps * max(np.abs(held).max(), 1.0) * camera.scale
    np.testing.assert_allclose(
        camera.moved(dx, dy).to_pixels(held), (100 + dx, 100 + dy), atol=digits + 1e-6
    )


@given(cameras(), st.sampled_from([1e-300, 1e-12, 1e12, 1e300]), st.integers(1, 5))
def test_scale_and_centre_stay_within_bounds(camera, factor, times):
    for _ in range(times):
        camera = camera.zoomed(factor, (0, 0)).moved(1e6, -1e6)
        assert MIN_SCALE <= camera.scale <= MAX_SCALE
        assert max(abs(camera.x_mm), abs(camera.y_mm)) <= MAX_CENTRE_MM
        assert np.isfinite(camera.to_pixels([(1e9, -1e9)])).all()


points = st.lists(st.tuples(millimetres, millimetres), min_size=1, max_size=6)


@given(points)
def test_what_is_fitted_is_in_view(places):
    places = np.array(places)
    camera = Camera(width=900, height=600).fitted(places, (80, 70, 60, 50))
    seen = camera.to_pixels(places)
    if camera.scale < MAX_SCALE:
        assert (seen >= (80 - 0.1, 70 - 0.1)).all()
        assert (seen <= (840 + 0.1, 550 + 0.1)).all()
    assert MIN_SCALE <= camera.scale <= MAX_SCALE


def test_the_fit_touches_its_margins():
    camera = Camera(width=900, height=600).fitted(np.array([(0, 0), (100, 10)]), (80, 70, 60, 50))
    left, right = camera.to_pixels([(0, 0), (100, 10)])[:, 0]
    assert (left, right) == pytest.approx((80, 840))


def test_nothing_or_a_single_place_is_fitted_to_a_sensible_width():
    camera = Camera(width=900, height=600)
    assert camera.fitted(np.zeros((0, 2)), (0, 0, 0, 0)).scale == pytest.approx(
        900 / DEFAULT_SPAN_MM
    )
    single = camera.fitted(np.array([(7.0, 3.0)]), (0, 0, 0, 0))
    np.testing.assert_allclose(single.to_pixels((7, 3)), (450, 300))


def test_a_canvas_smaller_than_its_margins_can_be_fitted():
    camera = Camera(width=10, height=10).fitted(np.array([(0, 0), (5, 5)]), (50, 50, 50, 50))
    assert np.isfinite(camera.to_pixels((5, 5))).all()


def test_the_middle_stays_when_the_canvas_grows():
    camera = Camera(3, 4, 2.0, 100, 100).resized(300, 500)
    np.testing.assert_allclose(camera.to_pixels((3, 4)), (150, 250))
    assert Camera().resized(0, -1).width == 1


def test_decimals_tell_one_pixel_from_the_next():
    for scale, decimals in [(0.01, 0), (1, 0), (4, 1), (10, 1), (96 / 25.4, 1), (500, 3), (1e6, 6)]:
        assert Camera(scale=scale).decimals == decimals
        assert decimals == 0 or 10**-decimals <= 1 / scale


def test_the_rectangle_in_view():
    low, high = Camera(10, 20, 2.0, 100, 40).rectangle_mm()
    np.testing.assert_allclose(low, (-15, 10))
    np.testing.assert_allclose(high, (35, 30))
