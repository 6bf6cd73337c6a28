"""The pen: each click a point, one step of undo for a finished curve, nothing for a dropped one."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from mouse import SHIFT, Mouse, boat, by, shown

PLACES = [np.array(place, dtype=float) for place in [(600, 60), (700, 90), (760, 60), (830, 160)]]


@pytest.fixture
def canvas(qtbot):
    canvas = shown(qtbot, boat())
    canvas.set_tool("pen")
    return canvas


@pytest.fixture
def session(canvas):
    return canvas.session


@pytest.fixture
def mouse(canvas):
    return Mouse(canvas)


def drawn(canvas):
    """The new curve in pixels."""
    assert len(canvas.session.document.curves) == 2
    return canvas.camera.to_pixels(canvas.session.document.curves[1].points)


def click_all(mouse, places=PLACES):
    for place in places:
        mouse.click(place)


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Enter])
def test_enter_ends_an_open_curve(canvas, mouse, session, key):
    start = session.document
    click_all(mouse)
    assert session.document is start
    QTest.keyClick(canvas, key)
    np.testing.assert_allclose(drawn(canvas), PLACES)
    assert not session.document.curves[1].closed
    assert session.undo_name == "Draw curve"
    assert session.selection.curve == 1
    assert canvas.tool == "select"
    session.undo()
    assert session.document is start


def test_a_double_click_ends_it_with_its_first_click_as_the_last_point(canvas, mouse):
    click_all(mouse, PLACES[:3])
    mouse.double_click(PLACES[3])
    np.testing.assert_allclose(drawn(canvas), PLACES)


def test_a_click_on_the_first_point_closes(canvas, mouse, session):
    click_all(mouse)
    mouse.move(PLACES[0] + by(4, 4))
    assert "closes" in canvas.hint
    mouse.click(PLACES[0] + by(4, 4))
    np.testing.assert_allclose(drawn(canvas), PLACES)
    assert session.document.curves[1].closed


def test_two_points_do_not_close(canvas, mouse, session):
    click_all(mouse, PLACES[:2])
    mouse.click(PLACES[0] + by(3, 0))
    assert len(session.document.curves) == 1
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    assert len(drawn(canvas)) == 3


def test_escape_drops(canvas, mouse, session):
    start = session.document
    click_all(mouse)
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert session.document is start
    assert canvas.overlay.preview is None
    assert canvas.tool == "pen"


def test_backspace_takes_the_last_point_back(canvas, mouse, session):
    click_all(mouse)
    QTest.keyClick(canvas, Qt.Key.Key_Backspace)
    QTest.keyClick(canvas, Qt.Key.Key_Backspace)
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    np.testing.assert_allclose(drawn(canvas), PLACES[:2])


def test_backspace_to_nothing_and_a_single_point_leave_nothing(canvas, mouse, session):
    mouse.click(PLACES[0])
    QTest.keyClick(canvas, Qt.Key.Key_Backspace)
    assert canvas.overlay.preview is None
    mouse.click(PLACES[0])
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    assert session.undo_name is None


def test_the_limit_curve_is_shown_while_drawing(canvas, mouse):
    click_all(mouse)
    mouse.move((860, 300))
    preview = canvas.scene.preview
    np.testing.assert_allclose(preview.points_px, [*PLACES, (860, 300)], atol=1e-9)
    assert len(preview.vertices_px) > 10


def test_a_point_can_be_adjusted_until_the_button_is_released(canvas, mouse):
    mouse.drag(PLACES[0], PLACES[0] + by(30, 0), PLACES[1])
    mouse.click(PLACES[2])
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    np.testing.assert_allclose(drawn(canvas), [PLACES[1], PLACES[2]])


def test_shift_keeps_an_axis(canvas, mouse):
    mouse.click(PLACES[0])
    mouse.click(PLACES[0] + by(80, 11), keys=SHIFT)
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    np.testing.assert_allclose(drawn(canvas)[1], PLACES[0] + by(80, 0))


def test_another_tool_finishes_the_curve(canvas, mouse):
    click_all(mouse)
    canvas.set_tool("hand")
    np.testing.assert_allclose(drawn(canvas), PLACES)


def test_another_document_drops_it(canvas, mouse, session):
    click_all(mouse)
    session.replace(boat(), None)
    assert canvas.overlay.preview is None
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    assert len(session.document.curves) == 1


def test_panning_while_drawing_keeps_the_points_in_the_drawing(canvas, mouse):
    click_all(mouse, PLACES[:2])
    placed = canvas.camera.to_mm(PLACES[:2])
    mouse.drag((300, 300), (340, 320), (400, 380), button=Qt.MouseButton.MiddleButton)
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    np.testing.assert_allclose(canvas.session.document.curves[1].points, placed)


def test_the_largest_coordinate_is_not_passed(qtbot):
    canvas = shown(qtbot, boat())
    canvas.set_tool("pen")
    canvas.look(canvas.camera.zoomed(1e-12))
    mouse = Mouse(canvas)
    click_all(mouse, [(40, 40), (890, 40), (450, 590)])
    QTest.keyClick(canvas, Qt.Key.Key_Return)
    assert np.abs(canvas.session.document.curves[1].points).max() <= 1e9
