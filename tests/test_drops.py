import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent
from PySide6.QtWidgets import QApplication

from answers import Answers
from app.dialogs import Answer
from app.drawing_data import OWN, DrawingData
from app.style import LIGHT
from app.window import MainWindow
from core import store
from core.family import PRESETS
from drawings import letter_f

SQUARE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
    '<path d="M10 10 H50 V50 H10 Z"/></svg>'
)
COPY = Qt.DropAction.CopyAction
NO_KEYS = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def window(qtbot, answers):
    window = MainWindow(dialogs=answers)
    qtbot.addWidget(window, before_close_func=lambda w: setattr(answers, "answer", Answer.DISCARD))
    with qtbot.waitSignal(window.completed):
        window.show()
    return window


def event_of(kind, data, at):
    return kind(at, COPY | Qt.DropAction.MoveAction, data, Qt.MouseButton.LeftButton, NO_KEYS)


def entered(window, data, at=(400, 300)):
    event = event_of(QDragEnterEvent, data, QPoint(*at))
    QApplication.sendEvent(window, event)
    return event.isAccepted()


def dropped(window, data, at=(400, 300)):
    """Whether it was taken."""
    if not entered(window, data, at):
        return False
    QApplication.sendEvent(window, event_of(QDragMoveEvent, data, QPoint(*at)))
    event = event_of(QDropEvent, data, QPointF(*at))
    QApplication.sendEvent(window, event)
    assert event.dropAction() == COPY
    return event.isAccepted()


def files(*paths):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    return data


def text(words):
    data = QMimeData()
    data.setText(words)
    return data


@pytest.fixture
def points(tmp_path):
    paths = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for path in paths:
        path.write_text("0,0\n10,0\n10,10\n")
    return paths


def touch(window):
    window.scheme.choose_preset("Tight")


def done(qtbot, window):
    qtbot.waitUntil(lambda: not window.importer.is_busy)


def test_into_an_untouched_drawing_the_first_file_is_opened_and_others_are_added(
    qtbot, window, points
):
    data = files(*points)
    assert window.drops.promise(data) == "Drop to open first.csv and add the curves of second.csv"
    assert dropped(window, data)
    qtbot.waitUntil(lambda: len(window.session.document.curves) == 2)
    assert window.windowTitle() == "first[*] - Ninepoint"
    assert [curve.name for curve in window.session.document.curves] == ["first", "second"]
    assert window.session.undo_name == "Import curve"


def test_into_a_drawing_in_work_files_are_added(qtbot, window, answers, points):
    touch(window)
    data = files(*points)
    assert window.drops.promise(data) == "Drop to add the curves of 2 files"
    assert dropped(window, data)
    qtbot.waitUntil(lambda: len(window.session.document.curves) == 3)
    assert answers.asked == []
    assert window.session.document.parameters == PRESETS["Tight"]


def test_a_drawing_is_opened_after_the_question(qtbot, window, answers, tmp_path):
    path = tmp_path / "letter.ninepoint"
    store.save(letter_f(), path)
    touch(window)
    data = files(path)
    assert window.drops.promise(data) == "Drop to open letter.ninepoint"
    answers.answer = Answer.DISCARD
    with qtbot.waitSignal(window.files.opened):
        assert dropped(window, data)
    assert answers.asked == ["Untitled"]
    assert window.session.path == path


def test_a_foreign_file_is_asked_about(qtbot, window, tmp_path):
    path = tmp_path / "square.svg"
    path.write_text(SQUARE)
    assert dropped(window, files(path))
    qtbot.waitUntil(lambda: window.importer.dialog is not None)
    assert window.importer.dialog.windowTitle() == "Open square.svg"
    window.importer.dialog.reject()


def test_curves_are_pasted_where_they_are_dropped(qtbot, window):
    at = window.canvas.mapTo(window, QPoint(250, 180))
    place = window.canvas.camera.to_mm((250, 180))
    data = DrawingData(letter_f())
    assert window.drops.promise(data) == "Drop to add the curves here"
    assert dropped(window, data, (at.x(), at.y()))
    qtbot.waitUntil(lambda: len(window.session.document.curves) == 3)
    boxes = np.array([curve.box for curve in window.session.document.curves[1:]])
    assert np.allclose((boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2, place)
    assert window.session.undo_name == "Paste 2 curves"


def test_what_another_program_offers_is_kept_until_it_is_read(qtbot, window):
    data = QMimeData()
    data.setData(OWN, store.encode(letter_f()))
    assert dropped(window, data)
    data.clear()
    done(qtbot, window)
    qtbot.waitUntil(lambda: len(window.session.document.curves) == 3)


@pytest.mark.parametrize(
    ("words", "promise"),
    [("1 2\n3 4\n", "Drop to add the points here"), (SQUARE, "Drop to add the curves here")],
)
def test_text_of_curves_is_taken(qtbot, window, words, promise):
    assert window.drops.promise(text(words)) == promise
    assert dropped(window, text(words))
    qtbot.waitUntil(lambda: window.importer.is_busy or len(window.session.document.curves) == 2)
    if words == SQUARE:
        qtbot.waitUntil(lambda: window.importer.dialog is not None)
        window.importer.dialog.reject()
    done(qtbot, window)


def test_beside_the_canvas_curves_keep_their_place(qtbot, window):
    at = window.status.mapTo(window, QPoint(100, 10))
    assert dropped(window, DrawingData(letter_f()), (at.x(), at.y()))
    qtbot.waitUntil(lambda: len(window.session.document.curves) == 3)
    assert (window.session.document.curves[1].points == letter_f().curves[0].points).all()


def test_other_things_are_not_taken(window):
    before = window.session.document
    for data in (QMimeData(), text("hello")):
        assert not dropped(window, data)
        assert window.drops.hint.isHidden()
    web = QMimeData()
    web.setUrls([QUrl("https://example.com/a.svg")])
    assert not dropped(window, web)
    assert window.session.document is before


def test_a_hint_says_what_will_happen_while_it_is_over_the_window(window, points):
    hint = window.drops.hint
    assert entered(window, files(points[0]))
    assert hint.isVisible()
    assert hint.text() == "Drop to open first.csv"
    image = window.canvas.grab(hint.geometry()).toImage()
    inks = {image.pixelColor(x, 1).name() for x in range(10, image.width() - 10)}
    assert LIGHT.accent in inks
    QApplication.sendEvent(window, QDragLeaveEvent())
    assert hint.isHidden()
    dropped(window, files(points[0]))
    assert hint.isHidden()


def test_a_long_name_is_cut_short(window, tmp_path):
    promise = window.drops.promise(files(tmp_path / ("x" * 200 + ".csv")))
    assert promise.endswith("x...")
    assert len(promise) < 60
