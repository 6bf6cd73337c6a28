"""Rulers: ticks are round, labels exact and never crowded, at any zoom."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QImage, QPainter

from app.camera import Camera
from app.grid import Background, Step, has_room, ruler_font, step_for, ticks, view_step
from app.style import DARK, LIGHT, SIZES

scales = st.floats(-8, 6).map(lambda e: 10**e)


@given(scales, st.floats(40, 300))
def test_the_step_is_round_and_the_smallest_that_leaves_room(scale, spacing):
    step = step_for(scale, spacing)
    assert step.digit in (1, 2, 5)
    size_px = step.size_mm * scale
    assert spacing * (1 - 1e-6) <= size_px <= 2.5 * spacing * (1 + 1e-6)


@given(scales)
def test_the_small_ticks_are_round_too_and_apart(scale):
    step = step_for(scale, SIZES.label_spacing)
    part = Fraction(step.digit, step.parts)
    while part < 1:
        part *= 10
    assert part in (1, 2, 5)
    assert step.parts == 1 or step.size_mm * scale / step.parts >= SIZES.minor_spacing


@given(st.integers(0, 1), st.floats(-50, 500), st.floats(5, 60))
def test_labels_are_left_out_rather_than_cut_by_the_corner(axis, place, width):
    """Along the top a label reads to the right of its tick, along the left side upwards from it."""
    ends = (place, place + width) if axis == 0 else (place - width, place)
    if has_room(axis, place, width):
        assert min(ends) >= SIZES.ruler - 4
    else:
        assert min(ends) < SIZES.ruler + 4


@pytest.mark.parametrize(
    ("step", "count", "text"),
    [
        (Step(5, 0, 5), 3, "15"),
        (Step(2, 1, 4), -2, "\N{MINUS SIGN}40"),
        (Step(1, -1, 10), 12, "1.2"),
        (Step(5, -3, 5), 1, "0.005"),
        (Step(5, -3, 5), -3, "\N{MINUS SIGN}0.015"),
        (Step(1, 9, 10), 1, "1000000000"),
        (Step(1, -6, 10), 10**15 + 1, "1000000000.000001"),
        (Step(1, -2, 10), 0, "0.00"),
    ],
)
def test_labels_are_exact(step, count, text):
    assert step.label(count) == text


def test_ticks_of_an_interval():
    minor, major = ticks(-12.0, 23.0, Step(1, 1, 5))
    assert list(major) == [-1, 0, 1, 2]
    np.testing.assert_allclose(minor, np.arange(-12, 23, 2))


@given(scales, st.floats(-1e9, 1e9))
def test_labels_have_room_wherever_one_looks(qapp, scale, centre):
    camera = Camera(centre, -centre, scale, 900, 600)
    metrics = QFontMetricsF(ruler_font(QFont()))
    step = view_step(camera, metrics)
    low, high = camera.rectangle_mm()
    for end in (low[0], high[0], low[1], high[1]):
        label = step.label(math.floor(end / step.size_mm))
        assert metrics.horizontalAdvance(label) <= step.size_mm * scale


STEP = Step(10, 0, 5)


def painted(background, size, ratio=1.0, is_whole=True):
    image = QImage(*(round(length * ratio) for length in size), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor("red"))
    with QPainter(image) as painter:
        background.paint(painter, is_whole)
    return image


@pytest.mark.parametrize("ratio", [1.0, 1.25, 1.5, 2.0])
@pytest.mark.parametrize("with_grid", [True, False])
def test_the_background_is_the_same_at_once_and_from_the_picture_that_is_kept(
    qapp, monkeypatch, ratio, with_grid
):
    background = Background()
    camera = Camera(3, -2, 4.0, 300, 200)
    background.look(camera, LIGHT, ratio, STEP, with_grid)
    first = painted(background, (300, 200), ratio)
    assert first == painted(background, (300, 200), ratio, is_whole=False)
    assert first.pixelColor(5, 5).name() in (LIGHT.background, LIGHT.grid, LIGHT.grid_major)
    drawn = []
    monkeypatch.setattr("app.grid.paint_grid", lambda *args: drawn.append(args))
    background.look(camera, LIGHT, ratio, STEP, with_grid)
    for is_whole in (True, False):  # the picture is kept as long as the view is
        assert first == painted(background, (300, 200), ratio, is_whole)
    assert drawn == []
    monkeypatch.undo()
    background.look(camera, DARK, ratio, STEP, with_grid)
    assert first != painted(background, (300, 200), ratio)
    background.look(camera, LIGHT, ratio, STEP, with_grid)
    assert first == painted(background, (300, 200), ratio, is_whole=False)


def test_grid_lines_are_crisp(qapp):
    background = Background()
    background.look(Camera(0, 0, 4.0, 301, 201), LIGHT, 1.0, STEP, True)
    image = painted(background, (301, 201))
    row = [image.pixelColor(x, 150).name() for x in range(301)]
    assert set(row) <= {LIGHT.background, LIGHT.grid, LIGHT.grid_major, *_axis(image)}


def _axis(image):
    """The colour of the axis through the origin: a mixture of its own and the background's."""
    return {image.pixelColor(150, 150).name()}


def test_without_a_grid_the_paper_is_plain(qapp):
    background = Background()
    background.look(Camera(0, 0, 4.0, 300, 200), LIGHT, 1.0, STEP, False)
    image = painted(background, (300, 200))
    assert {image.pixelColor(x, 120).name() for x in range(300)} == {LIGHT.background}
