"""The hand: keys and buttons go to the right tool, and no step is lost or doubled."""


import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QFocusEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from app.canvas import Canvas
from app.session import Selection, Session
from core.document import Curve, Document
from mouse import ALT, BOAT, CTRL, LEFT, RIGHT, SHIFT, boat, by, shown


def test_tab_walks_the_points_and_wraps(canvas, session):
    for expected in (0, 1, 2):
        QTest.keyClick(canvas, Qt.Key.Key_Tab)
        assert sorted(session.selection.points) == [(0, expected)]
    for expected in (1, 0, 7):
        QTest.keyClick(canvas, Qt.Key.Key_Backtab, SHIFT)
        assert sorted(session.selection.points) == [(0, expected)]
    assert canvas.hasFocus()


def test_tab_goes_on_to_the_next_curve(qtbot):
    document = Document((Curve(BOAT[:2]), Curve(BOAT[2:4])))
    canvas = shown(qtbot, document)
    seen = []
    for _ in range(5):
        QTest.keyClick(canvas, Qt.Key.Key_Tab)
        seen.extend(canvas.session.selection.points)
    assert seen == [(0, 0), (0, 1), (1, 0), (1, 1), (0, 0)]


def test_ctrl_tab_leaves_and_so_does_tab_on_an_empty_canvas(qtbot):
    window = QWidget()
    layout = QVBoxLayout(window)
    canvas = Canvas(Session(boat()))
    field = QLineEdit()
    layout.addWidget(canvas)
    layout.addWidget(field)
    qtbot.addWidget(window)
    with qtbot.waitActive(window):
        window.show()
        window.activateWindow()
    canvas.setFocus()
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    assert canvas.hasFocus()
    QTest.keyClick(canvas, Qt.Key.Key_Tab, CTRL)
    assert field.hasFocus()
    canvas.session.replace(Document(), None)
    canvas.setFocus()
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    assert field.hasFocus()


@pytest.mark.parametrize(
    ("keys", "step"), [(Qt.KeyboardModifier.NoModifier, 1.0), (SHIFT, 10.0), (ALT, 0.1)]
)
def test_arrows_nudge(canvas, session, keys, step):
    session.select(Selection(frozenset({(0, 1), (0, 2)})))
    start = session.document
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Left):
        QTest.keyClick(canvas, key, keys)
    after = session.document.curves[0].points
    np.testing.assert_allclose(after[1], np.array(BOAT[1]) + by(step, step))
    QTest.keyClick(canvas, Qt.Key.Key_Down, keys)
    after = session.document.curves[0].points
    np.testing.assert_allclose(after[2], np.array(BOAT[2]) + by(step, 0))
    assert session.undo_name == "Move 2 points"
    session.undo()
    assert session.document is start


def test_an_edit_after_a_burst_is_a_step_of_its_own(canvas, session, mouse):
    session.select(Selection(frozenset({(0, 1)})))
    canvas.nudge(1, 0)
    canvas.delete_selection()
    assert session.undo_name == "Delete point"
    session.undo()
    assert session.undo_name == "Move point"
    canvas.nudge(1, 0)
    place = mouse.point(4)
    mouse.drag(place, place + by(20, 0))
    session.undo()
    assert session.undo_name == "Move point"
    assert session.document.curves[0].points[4, 0] == 80


def test_nothing_is_deleted_or_nudged_in_the_middle_of_a_drag(canvas, session, mouse):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    canvas.delete_selection()
    canvas.nudge(5, 5)
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    mouse.release(place + by(20, 0))
    assert len(session.document.curves[0].points) == 8
    assert session.document.curves[0].points[4, 1] == 40
    assert session.undo_name == "Move point"


def test_losing_the_focus_keeps_what_was_dragged(canvas, session, mouse):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    QApplication.sendEvent(canvas, QFocusEvent(QEvent.Type.FocusOut))
    assert not session.in_gesture
    assert session.undo_name == "Move point"
    moved = session.document
    mouse.move(place + by(90, 0))
    mouse.release(place + by(90, 0))
    assert session.document is moved


def test_a_release_that_went_elsewhere_ends_the_drag(canvas, session, mouse):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    moved = session.document
    mouse.held = Qt.MouseButton.NoButton
    mouse.move(place + by(90, 0))
    assert session.document is moved
    assert not session.in_gesture


def test_another_document_in_a_drag(canvas, session, mouse):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    other = boat(closed=False)
    session.replace(other, None)
    mouse.move(place + by(40, 0))
    mouse.release(place + by(40, 0))
    assert session.document is other
    assert session.undo_name is None


def test_other_buttons_have_no_meaning_in_a_drag(canvas, session, mouse):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    mouse.press(place + by(20, 0), RIGHT)
    mouse.held = LEFT
    mouse.move(place + by(30, 0))
    mouse.release(place + by(30, 0))
    assert session.document.curves[0].points[4, 0] == pytest.approx(80 + 30 / canvas.camera.scale)
