"""The canvas as a widget: what it tells, what it can be told, and the rules of the house."""

import inspect

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from app import canvas as canvas_module
from app import sheet as sheet_module
from app.session import Selection
from mouse import RIGHT


def test_the_mouse_is_told_in_millimetres(canvas, mouse, qtbot):
    places = []
    canvas.cursor_moved.connect(places.append)
    mouse.move(mouse.pixels((60, 30)))
    assert places[-1] == pytest.approx((60, 30))
    QApplication.sendEvent(canvas, QEvent(QEvent.Type.Leave))
    assert places[-1] is None


def test_tools_are_named(canvas, qtbot):
    with qtbot.waitSignal(canvas.tool_changed) as told:
        canvas.set_tool("pen")
    assert told.args == ["pen"]
    assert canvas.tool == "pen"
    assert canvas.cursor().shape() == Qt.CursorShape.CrossCursor
    with pytest.raises(ValueError, match="no tool 'brush'"):
        canvas.set_tool("brush")


def test_a_refusal_is_told_until_the_next_press(canvas, mouse):
    hints = []
    canvas.hint_changed.connect(hints.append)
    canvas.report("The drawing is full.")
    mouse.move((40, 40))
    assert hints[-1] == "The drawing is full."
    mouse.click((40, 40))
    assert hints[-1] != "The drawing is full."


def test_delete_takes_the_selected_points_and_empty_curves(canvas, session):
    canvas.delete_selection()
    assert session.undo_name is None
    session.select(Selection(frozenset({(0, 1), (0, 3), (0, 5)})))
    canvas.delete_selection()
    assert session.undo_name == "Delete 3 points"
    assert len(session.document.curves[0].points) == 5
    assert not session.selection.points
    canvas.select_all()
    assert len(session.selection.points) == 5
    canvas.delete_selection()
    assert session.document.curves == ()
    canvas.grab()
    session.undo()
    assert len(session.document.curves[0].points) == 5


def test_a_right_click_selects_the_point_and_asks_for_the_menu(canvas, session, mouse, qtbot):
    place = mouse.point(4)
    with qtbot.waitSignal(canvas.customContextMenuRequested):
        QTest.mouseClick(canvas, RIGHT, Qt.KeyboardModifier.NoModifier, QPoint(*place.astype(int)))
        at = QPoint(*place.astype(int))
        event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, canvas.mapToGlobal(at))
        QApplication.sendEvent(canvas, event)
    assert sorted(session.selection.points) == [(0, 4)]
    session.select(Selection(frozenset({(0, 4), (0, 5)})))
    mouse.click(place, RIGHT)
    assert sorted(session.selection.points) == [(0, 4), (0, 5)]


@pytest.mark.parametrize("module", [canvas_module, sheet_module])
def test_every_override_of_qt_is_guarded(module):
    for _, cls in inspect.getmembers(module, inspect.isclass):
        if cls.__module__ != module.__name__:
            continue
        for name, member in vars(cls).items():
            if inspect.isfunction(member) and callable(getattr(QWidget, name, None)):
                assert name == "__init__" or getattr(member, "is_guarded", False), name


def test_the_canvas_has_a_name_for_screen_readers(canvas):
    assert canvas.accessibleName()
    assert "Tab" in canvas.accessibleDescription()
    assert canvas.focusPolicy() == Qt.FocusPolicy.StrongFocus


def test_shift_is_forgotten_when_the_focus_goes(canvas, mouse, session):
    mouse.move(mouse.point(2))
    calm = canvas.hint
    QTest.keyPress(canvas, Qt.Key.Key_Shift, Qt.KeyboardModifier.ShiftModifier)
    assert canvas.hint != calm
    canvas.clearFocus()
    assert canvas.hint == calm
