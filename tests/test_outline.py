"""What is filled covers what a pen would draw, and what it has anywhere depends on what is near."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.outline import outline, path_of
from app.polyline import polygon_of

SIDE = 200
INK = QColor("black")


@pytest.fixture(autouse=True)
def application(qapp):
    return qapp


def image_of(paint):
    image = QImage(SIDE, SIDE, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint(painter)
    flat = np.frombuffer(image.constBits(), dtype=np.uint8)
    return 1.0 - flat.reshape(SIDE, SIDE, 4)[..., 0] / 255


def filled(vertices, half, is_loop):
    path = path_of(outline(vertices, half, is_loop))
    return image_of(lambda painter: painter.fillPath(path, INK))


def by_pen(vertices, half, is_loop):
    pen = QPen(INK, 2 * half, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap,
               Qt.PenJoinStyle.BevelJoin)  # fmt: skip

    def paint(painter):
        painter.setPen(pen)
        draw = painter.drawPolygon if is_loop else painter.drawPolyline
        draw(polygon_of(vertices[:-1] if is_loop else vertices))

    return image_of(paint)


def flower(count, end=2 * np.pi):
    angle = np.linspace(0, end, count)
    radius = 60 + 15 * np.sin(5 * angle)
    return 100 + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def covered(vertices, half, fine=8):
    """Share of each pixel that lies within ``half`` of a polyline: a slow oracle."""
    middle = (np.arange(SIDE * fine) + 0.5) / fine
    near = np.zeros((SIDE * fine, SIDE * fine), dtype=bool)
    for start, end in pairwise(vertices):
        low, high = np.minimum(start, end) - half, np.maximum(start, end) + half
        columns, rows = (slice(int(low[k] * fine), int(high[k] * fine) + 2) for k in (0, 1))
        x, y = np.meshgrid(middle[columns], middle[rows])
        way = end - start
        share = ((x - start[0]) * way[0] + (y - start[1]) * way[1]) / (way**2).sum()
        share = share.clip(0, 1)
        away = np.hypot(x - start[0] - share * way[0], y - start[1] - share * way[1])
        near[rows, columns] |= away <= half
    return near.reshape(SIDE, fine, SIDE, fine).mean(axis=(1, 3))


@pytest.mark.parametrize("half", [0.75, 1.0, 2.0])
@pytest.mark.parametrize("is_loop", [True, False])
def test_a_smooth_line_is_drawn_exactly_and_by_a_pen_it_is_not(half, is_loop):
    vertices = flower(120) if is_loop else flower(90, 4.5)
    if is_loop:
        vertices[-1] = vertices[0]
    exact = covered(vertices, half)
    own, pens = (
        np.abs(draw(vertices, half, is_loop) - exact).max() for draw in (filled, by_pen)
    )
    assert own < 0.1
    assert own < pens


@pytest.mark.parametrize("is_loop", [True, False])
def test_sharp_corners_are_bevelled_and_have_no_hole(is_loop):
    star = 100 + 80 * np.array([(np.sin(k * 2.4 * np.pi / 3), np.cos(k * 2.4 * np.pi / 3))
                                for k in range(6)])  # fmt: skip
    star[-1] = star[0]
    vertices = star if is_loop else star[:-1]
    one, other = filled(vertices, 3.0, is_loop), by_pen(vertices, 3.0, is_loop)
    assert np.abs(one - other).max() < 0.3
    assert one.sum() == pytest.approx(other.sum(), rel=5e-3)


def test_where_the_line_hardly_turns_a_vertex_is_one_on_either_side():
    """Edges of a path are what Qt's rasteriser looks at, in each of its bands of rows."""
    angle = np.linspace(0, 2 * np.pi, 40)
    smooth = 100 + 60 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    smooth[-1] = smooth[0]
    assert len(outline(smooth, 1.0, True)) == 2 * (40 + 1)
    corner = np.array([(20.0, 100.0), (60.0, 100.0), (100.0, 100.0), (100.0, 150.0)])
    straight = outline(corner[:3], 2.0, False)
    assert len(outline(corner, 2.0, False)) == len(straight) + 2 * 2
    np.testing.assert_allclose(straight[:3], corner[:3] - (0, 2.0))


def test_a_corner_is_bevelled_whatever_the_line_does_elsewhere():
    """Else a sharp turn that comes or goes would change ink far from it."""
    angle = np.linspace(0.1, 4.0, 60)
    smooth = 100 + 60 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    kinked = smooth.copy()
    kinked[-1] += (0.0, 30.0)
    for half in (1.3, np.linspace(1.0, 2.0, 60)):
        one, other = outline(smooth, half, False), outline(kinked, half, False)
        assert len(other) == len(one) + 2
        np.testing.assert_array_equal(other[:57], one[:57])


def test_a_repeated_vertex_changes_nothing():
    vertices = flower(40, 4.0)
    twice = np.repeat(vertices, np.where(np.arange(40) % 7 == 3, 3, 1), axis=0)
    np.testing.assert_array_equal(outline(twice, 1.0, False), outline(vertices, 1.0, False))


def test_a_single_place_is_a_dot():
    for vertices in (np.array([(50.0, 60.0)]), np.full((4, 2), (50.0, 60.0))):
        found = outline(vertices, 2.0, False)
        np.testing.assert_allclose(np.hypot(*(found - vertices[0]).T), 2.0)
        assert filled(vertices, 2.0, False).sum() == pytest.approx(np.pi * 4, rel=0.1)


def test_the_breadth_at_each_vertex_is_kept():
    vertices = np.stack([np.linspace(20, 180, 9), np.full(9, 100.0)], axis=-1)
    halves = np.linspace(1.0, 9.0, 9)
    found = outline(vertices, halves, False)
    for place, half in zip(vertices, halves, strict=True):
        beside = found[np.isclose(found[:, 0], place[0])]
        assert beside[:, 1].min() == pytest.approx(100 - half)
        assert beside[:, 1].max() == pytest.approx(100 + half)


@given(st.lists(st.tuples(st.floats(20, 180), st.floats(20, 180)), min_size=1, max_size=9),
       st.floats(0.5, 6.0), st.booleans())  # fmt: skip
def test_it_stays_beside_the_line(places, half, is_loop):
    vertices = np.array(places)
    if is_loop:
        vertices = np.concatenate([vertices, vertices[:1]])
    found = outline(vertices, half, is_loop)
    assert np.isfinite(found).all()
    start, way = vertices[:-1], np.diff(vertices, axis=0)
    if not len(start):
        start, way = vertices, np.zeros((1, 2))
    length = np.maximum((way**2).sum(axis=1), 1e-300)
    share = ((way * (found[:, None] - start)).sum(axis=2) / length).clip(0, 1)
    away = np.hypot(*(start + share[..., None] * way - found[:, None]).transpose(2, 0, 1))
    assert away.min(axis=1).max() <= 1.026 * half


def test_far_from_a_vertex_that_moves_it_is_the_same_in_every_bit():
    rng = np.random.default_rng(2)
    for count in (8, 33, 120):
        vertices = flower(count, 5.0)
        for place in rng.integers(3, count - 3, 8):
            moved = vertices.copy()
            moved[place] += rng.normal(0, 4, 2)
            before, after = outline(vertices, 1.3, False), outline(moved, 1.3, False)
            held, kept = ({tuple(row) for row in found.tolist()} for found in (before, after))
            near = vertices[place - 1 : place + 2]
            lost = np.array(sorted(held - kept)).reshape(-1, 2)
            away = np.hypot(*(lost[:, None] - near).transpose(2, 0, 1)).min(axis=1)
            assert (away < 2 * 1.3).all()
