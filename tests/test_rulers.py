"""Rulers lie over the edges of the sheet, and their marks follow the mouse."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF

from app.style import LIGHT, SIZES


def grabbed(canvas):
    return canvas.grab().toImage()


def test_the_marks_are_where_the_mouse_is_and_go_with_it(canvas):
    canvas.mark_mouse(QPointF(211.7, 97.2))
    image = grabbed(canvas)
    assert image.pixelColor(211, 3).name() == LIGHT.accent
    assert image.pixelColor(3, 97).name() == LIGHT.accent
    assert image.pixelColor(212, 3).name() != LIGHT.accent
    canvas.mark_mouse(QPointF(300.0, 10.0))  # on the upper ruler
    image = grabbed(canvas)
    assert image.pixelColor(300, 3).name() == LIGHT.accent
    column = {image.pixelColor(3, y).name() for y in range(SIZES.ruler, 500)}
    assert LIGHT.accent not in column
    canvas.mark_mouse(None)
    row = {grabbed(canvas).pixelColor(x, 3).name() for x in range(SIZES.ruler, 800)}
    assert LIGHT.accent not in row


def test_a_move_of_the_mouse_paints_nothing_of_the_sheet(canvas, qtbot, monkeypatch):
    qtbot.wait(20)
    asked = []
    monkeypatch.setattr(canvas, "update", lambda *args: asked.append(args))
    for x in (100.0, 200.0, 300.0):
        canvas.mark_mouse(QPointF(x, 50.0))
    qtbot.wait(20)
    assert asked == []


def test_the_ticks_follow_the_view(canvas):
    def ticks():
        image = grabbed(canvas)
        y = SIZES.ruler - 3
        row = [image.pixelColor(x, y).name() for x in range(SIZES.ruler, canvas.width())]
        return np.flatnonzero([colour == LIGHT.ruler_line for colour in row])

    before = ticks()
    assert len(before) > 5
    canvas.look(canvas.camera.moved(3.0, 0.0))
    after = ticks()
    assert set(before[before < 800] + 3) <= set(after)


@pytest.mark.parametrize("focused", [True, False])
def test_the_frame_of_the_focus_runs_all_around(canvas, qtbot, focused):
    canvas.setFocus() if focused else canvas.clearFocus()
    qtbot.waitUntil(lambda: canvas.hasFocus() == focused)
    qtbot.wait(20)
    image = grabbed(canvas)
    wide, high = canvas.width(), canvas.height()
    for place in ((0, 9), (9, 0), (0, 300), (300, 0), (wide - 1, 300), (300, high - 1)):
        assert (image.pixelColor(*place).name() == LIGHT.accent) == focused
