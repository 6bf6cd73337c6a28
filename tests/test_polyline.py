"""Polylines for Qt: nothing that is seen is lost, nothing that Qt cannot hold gets through."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.polyline import DENSE, SAFE_PX, point_of, polygon_of, runs, stroke, thinned

coordinates = st.one_of(st.floats(-300, 300), st.sampled_from([1e4, -1e4, 1e12, -1e35, 1e35]))
polylines = st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=8).map(np.array)


@given(polylines)
def test_runs_stay_within_the_square(vertices):
    for part in runs(vertices, 100.0):
        assert len(part) >= 2
        assert np.abs(part).max() <= 100.0


@given(st.lists(st.tuples(st.floats(-300, 300), st.floats(-300, 300)), min_size=2, max_size=8))
def test_runs_hold_all_that_is_within_the_square(vertices):
    vertices = np.array(vertices)
    share = np.linspace(0, 1, 101)[:, None]
    dense = np.concatenate([a + share * (b - a) for a, b in pairwise(vertices)])
    inside = dense[(np.abs(dense) < 99.9).all(axis=1)]
    parts = runs(vertices, 100.0)
    for place in inside:
        assert min(_distance(part, place) for part in parts) < 1e-6


def _distance(polyline, place):
    start, way = polyline[:-1], np.diff(polyline, axis=0)
    length = np.maximum((way**2).sum(axis=1), 1e-300)
    share = np.clip((way * (place - start)).sum(axis=1) / length, 0, 1)
    return np.hypot(*(start + share[:, None] * way - place).T).min()


def test_a_polyline_that_fits_stays_whole():
    vertices = np.array([(0.0, 0.0), (50.0, 80.0), (-20.0, 10.0)])
    assert runs(vertices)[0] is vertices
    assert runs(vertices[:1]) == []


def test_a_polyline_that_leaves_and_returns_falls_in_two():
    vertices = np.array([(0.0, 0.0), (500.0, 0.0), (500.0, 50.0), (0.0, 50.0)])
    first, second = runs(vertices, 100.0)
    np.testing.assert_allclose(first, [(0, 0), (100, 0)])
    np.testing.assert_allclose(second, [(100, 50), (0, 50)])


def test_a_line_across_the_square_is_cut_on_both_sides():
    (part,) = runs(np.array([(-1e6, 10.0), (1e6, 10.0)]), 100.0)
    np.testing.assert_allclose(part, [(-100, 10), (100, 10)])


def test_thinning_moves_a_dense_curve_by_less_than_the_eye_sees():
    angle = np.linspace(0, 2 * np.pi, 100_000)
    circle = 200 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    thin = thinned(circle)
    assert len(thin) < 10_000
    assert max(_distance(thin, place) for place in circle[::1000]) < 0.36
    assert (thin[[0, -1]] == circle[[0, -1]]).all()
    assert thinned(circle[:DENSE]) is not None
    assert len(thinned(circle[:DENSE])) == DENSE


def test_a_polygon_is_filled_through_its_buffer():
    vertices = np.array([(1.5, -2.0), (3.0, 4.25), (0.0, 0.0)])
    polygon = polygon_of(vertices)
    assert [(p.x(), p.y()) for p in polygon] == [tuple(v) for v in vertices]
    assert polygon_of(np.zeros((0, 2))).isEmpty()


def test_a_place_is_kept_within_what_qt_holds():
    assert point_of(np.array([1e300, -1e300])).toTuple() == (SAFE_PX, -SAFE_PX)


@pytest.mark.parametrize("count", [40, 3000])
def test_a_stroke_covers_the_curve_without_gaps(count):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    circle = 100 + 80 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    circle = np.concatenate([circle, circle[:1]])
    image = QImage(200, 200, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(QColor("black"), 2.0)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        stroke(painter, circle, QRectF(0, 0, 200, 200))
    for a in np.linspace(0, 2 * np.pi, 500):
        x, y = 100 + 80 * np.cos(a), 100 + 80 * np.sin(a)
        assert image.pixelColor(int(x), int(y)).lightness() < 160
