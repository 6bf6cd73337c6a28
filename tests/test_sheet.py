"""The sheet: its view, its words, and one draw for all events that wait."""


import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.session import Selection
from app.sheet import EMPTY_HINT, FIRST_HINT, NO_LIMIT_HINT
from core.document import Curve, Document
from core.errors import NoLimitError
from core.family import PRESETS
from mouse import BOAT, LEFT, MIDDLE, SHIFT, by


def wheel(canvas, place, turn, keys=Qt.KeyboardModifier.NoModifier):
    at = QPointF(*place)
    event = QWheelEvent(
        at, canvas.mapToGlobal(at), QPoint(), QPoint(0, turn), Qt.MouseButton.NoButton, keys,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(canvas, event)


def in_view(canvas):
    points = np.concatenate([drawn.points_px for drawn in canvas.scene.curves])
    low, high = points.min(axis=0), points.max(axis=0)
    return (low >= 24).all() and (high <= (canvas.width(), canvas.height())).all()


def test_the_first_view_shows_the_whole_drawing(canvas):
    assert in_view(canvas)
    span = np.ptp(canvas.scene.curves[0].points_px, axis=0)
    assert span[0] > 0.7 * canvas.width() or span[1] > 0.7 * canvas.height()


def test_an_untouched_view_stays_fitted_and_a_chosen_one_stays_chosen(canvas):
    canvas.resize(500, 700)
    assert in_view(canvas)
    canvas.zoom_by(3.0)
    scale = canvas.camera.scale
    canvas.resize(800, 500)
    assert canvas.camera.scale == scale


def test_another_document_is_fitted_but_undo_does_not_move_the_view(canvas, session, mouse):
    mouse.drag(mouse.point(0), mouse.point(0) + by(40, 40))
    canvas.zoom_by(4.0)
    camera = canvas.camera
    session.undo()
    session.redo()
    assert canvas.camera == camera
    session.replace(Document((Curve(np.array(BOAT) * 50),)), None)
    assert in_view(canvas)


def test_escape_in_the_first_drag_does_not_move_the_view(canvas, mouse):
    canvas.zoom_by(1.5)
    camera = canvas.camera
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert canvas.camera == camera


def test_the_wheel_zooms_at_the_mouse(canvas, qtbot):
    place = np.array([200.0, 150.0])
    held = canvas.camera.to_mm(place)
    scale = canvas.camera.scale
    with qtbot.waitSignal(canvas.zoom_changed) as told:
        wheel(canvas, place, 120)
    assert canvas.camera.scale == pytest.approx(1.2 * scale)
    assert told.args == [canvas.camera.scale]
    np.testing.assert_allclose(canvas.camera.to_pixels(held), place)
    wheel(canvas, place, -120)
    assert canvas.camera.scale == pytest.approx(scale)


def test_shift_and_wheel_push_sideways(canvas):
    before = canvas.camera
    wheel(canvas, (200, 150), 120, SHIFT)
    assert canvas.camera.scale == before.scale
    assert canvas.camera.y_mm == before.y_mm
    assert canvas.camera.x_mm != before.x_mm


@pytest.mark.parametrize("way", ["middle", "space", "hand"])
def test_three_ways_to_push_the_paper(canvas, session, mouse, way):
    held = canvas.camera.to_mm((300, 300))
    if way == "space":
        QTest.keyPress(canvas, Qt.Key.Key_Space)
        assert canvas.cursor().shape() == Qt.CursorShape.OpenHandCursor
    if way == "hand":
        canvas.set_tool("hand")
    mouse.drag((300, 300), (310, 300), (350, 280), button=MIDDLE if way == "middle" else LEFT)
    np.testing.assert_allclose(canvas.camera.to_pixels(held), (350, 280))
    assert session.undo_name is None
    if way == "space":
        QTest.keyRelease(canvas, Qt.Key.Key_Space)
        assert canvas.cursor().shape() != Qt.CursorShape.OpenHandCursor
        assert canvas.tool == "select"


def test_escape_in_a_push_goes_back(canvas, mouse):
    before = canvas.camera
    mouse.press((300, 300), MIDDLE)
    mouse.move((400, 300))
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert canvas.camera == before


def test_no_zoom_leads_out_of_bounds(canvas):
    for turn in (120_000, -240_000, 120_000):
        for place in ((0, 0), (899, 599), (450, 300)):
            wheel(canvas, place, turn)
            canvas.grab()
    canvas.fit_all()
    assert in_view(canvas)


def test_fit_selection_and_real_size(canvas, session):
    session.select(Selection(frozenset({(0, 2), (0, 3)})))
    canvas.fit_selection()
    pair = canvas.scene.curves[0].points_px[[2, 3]]
    assert abs(pair[0, 1] - pair[1, 1]) > 0.5 * canvas.height()
    canvas.zoom_real_size()
    assert canvas.camera.scale == pytest.approx(canvas.logicalDpiX() / 25.4)
    session.select(Selection())
    canvas.fit_selection()
    assert in_view(canvas)


def test_the_first_hint_goes_with_the_first_edit(canvas, session, mouse):
    assert canvas.words() == FIRST_HINT
    mouse.drag(mouse.point(0), mouse.point(0) + by(20, 0))
    assert canvas.words() == ""
    session.undo()
    assert canvas.words() == ""
    session.replace(Document(), None)
    assert canvas.words() == EMPTY_HINT


def test_a_scheme_without_limit_is_told(canvas, session, monkeypatch):
    def refuse(mask):
        raise NoLimitError("no limit")

    monkeypatch.setattr("app.figure.bounds", refuse)
    session.edit(session.document.with_parameters(PRESETS["Tight"]), "Tight")
    canvas.grab()
    QApplication.processEvents()
    assert canvas.words() == NO_LIMIT_HINT
    assert canvas.hint == NO_LIMIT_HINT


def test_one_draw_for_many_edits(canvas, session, monkeypatch):
    draws = []
    canvas.repaint()
    QApplication.processEvents()
    monkeypatch.setattr(canvas, "update", lambda *args: draws.append(args))
    for x in range(20):
        curve = session.document.curves[0].moved([0], (x, 0))
        session.edit(session.document.with_curve(0, curve), "Move point")
    assert draws == []
    QApplication.processEvents()
    assert len(draws) == 1


def test_another_screen_is_noticed_when_the_sheet_is_painted_there(canvas, monkeypatch):
    QApplication.processEvents()
    assert canvas.scene.curves[0].ratio == 1.0
    monkeypatch.setattr(canvas, "devicePixelRatioF", lambda: 2.0)  # it changes without a word
    canvas.repaint()
    assert canvas.scene.curves[0].ratio == 2.0


def test_posted_events_alone_bring_the_new_picture(canvas, session, monkeypatch):
    # Without a turn of the loop for a timer: labels that follow the mouse are painted with it.
    QApplication.processEvents()
    draws = []
    monkeypatch.setattr(canvas, "update", lambda *args: draws.append(args))
    moved = session.document.curves[0].moved([0], (30.0, 30.0))
    session.edit(session.document.with_curve(0, moved), "Move point")
    assert draws == []
    QApplication.sendPostedEvents()
    assert len(draws) == 1
