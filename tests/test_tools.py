"""What all tools have in common: named states, and a drag that begins after three pixels."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.gestures import Pan, Pointer
from app.style import SIZES
from app.tools import DragTool, HandTool, State, Tool
from mouse import boat, shown


class Clicks(DragTool):
    """Counts its clicks; its drags push the paper."""

    def __init__(self, stage):
        super().__init__(stage)
        self.clicks = 0

    def _begin(self, pressed):
        return Pan(self._stage, pressed)

    def _click(self, pointer):
        self.clicks += 1


@pytest.fixture
def canvas(qtbot):
    return shown(qtbot, boat())


@pytest.fixture
def tool(canvas):
    return Clicks(canvas)


def at(x, y=0.0):
    return Pointer(np.array([100.0 + x, 100.0 + y]))


def test_the_states_of_a_drag(tool):
    assert tool.state is State.IDLE
    tool.press(at(0))
    assert tool.state is State.PRESSED
    tool.move(at(SIZES.drag_start - 0.1))
    assert tool.state is State.PRESSED
    tool.move(at(SIZES.drag_start))
    assert tool.state is State.DRAGGING
    tool.move(at(1))
    assert tool.state is State.DRAGGING
    tool.release(at(1))
    assert tool.state is State.IDLE
    assert tool.clicks == 0


def test_a_click_is_a_press_and_a_release_at_one_place(tool, canvas):
    before = canvas.camera
    tool.press(at(0))
    tool.release(at(1, 1))
    assert tool.clicks == 1
    assert canvas.camera == before


def test_a_release_far_away_is_a_drag(tool, canvas):
    held = canvas.camera.to_mm((100.0, 100.0))
    tool.press(at(0))
    tool.release(at(50))
    assert tool.clicks == 0
    np.testing.assert_allclose(canvas.camera.to_pixels(held), (150, 100))


def test_escape_ends_press_and_drag_and_is_else_not_taken(tool, canvas):
    assert not tool.key(Qt.Key.Key_Escape)
    before = canvas.camera
    tool.press(at(0))
    tool.move(at(50))
    assert not tool.key(Qt.Key.Key_A)
    assert tool.key(Qt.Key.Key_Escape)
    assert canvas.camera == before
    tool.release(at(90))
    assert canvas.camera == before
    assert tool.clicks == 0


def test_another_document_leaves_the_tool_idle(tool):
    tool.press(at(0))
    tool.move(at(50))
    tool.drop()
    assert tool.state is State.IDLE


def test_the_hand_pushes_from_the_first_pixel(canvas):
    hand = HandTool(canvas)
    assert hand.cursor == Qt.CursorShape.OpenHandCursor
    held = canvas.camera.to_mm((100.0, 100.0))
    hand.press(at(0))
    assert hand.cursor == Qt.CursorShape.ClosedHandCursor
    hand.move(at(1))
    np.testing.assert_allclose(canvas.camera.to_pixels(held), (101, 100))
    assert "Esc" in hand.hint(False)
    hand.release(at(1))
    assert "wheel" in hand.hint(False)


def test_a_tool_without_manners_takes_no_key(canvas):
    tool = Tool(canvas)
    assert not tool.key(Qt.Key.Key_Escape)
    assert tool.cursor == Qt.CursorShape.ArrowCursor
