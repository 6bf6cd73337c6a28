from threading import Event

import numpy as np
import pytest
from PySide6.QtWidgets import QPushButton, QWidget

from answers import Answers
from app import importing
from app.dialogs import Answer
from app.files import Files
from app.import_way import Way
from app.importing import Importer
from app.opening import ready_document
from app.session import Session
from app.settings import Settings
from core.document import Document
from core.family import PRESETS
from core.formats import PROFILES, export, open_document
from core.formats.foreign import read_sketch
from drawings import letter_f

SQUARE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
    '<path d="M10 10 H50 V50 H10 Z"/></svg>'
)


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def settings():
    return Settings()


@pytest.fixture
def importer(qtbot, settings, answers):
    window = QWidget()
    qtbot.addWidget(window)
    window.show()
    session = Session(ready_document(), window)
    files = Files(session, settings, answers, window)
    importer = Importer(session, files, settings, answers, window)
    files.foreign.connect(importer.open)
    importer.session, importer.files, importer.top = session, files, window
    yield importer
    importer.stop()


@pytest.fixture
def square(tmp_path):
    path = tmp_path / "square.svg"
    path.write_text(SQUARE)
    return path


@pytest.fixture
def ours(tmp_path):
    path = tmp_path / "letter.svg"
    export(letter_f().with_parameters(PRESETS["Tight"]), path, PROFILES["svg"])
    return path


def asked(qtbot, importer):
    """The dialog, once it knows what to do."""
    qtbot.waitUntil(lambda: importer.dialog is not None and importer.dialog.found is not None)
    return importer.dialog


def done(qtbot, importer):
    qtbot.waitUntil(lambda: not importer.is_busy)


def test_a_foreign_file_is_asked_about_and_becomes_a_drawing_without_a_file(
    qtbot, importer, answers, square
):
    assert not importer.files.open_path(square)
    dialog = asked(qtbot, importer)
    assert dialog.windowTitle() == "Open square.svg"
    before = importer.session.document
    assert before.curves[0].name == "Curve 1"
    with qtbot.waitSignals([importer.files.opened, importer.files.told]):
        dialog.accept()
    session = importer.session
    assert session.document is dialog.found.document
    assert (session.path, session.undo_name, session.is_modified) == (None, None, False)
    assert importer.files.title == "square"
    assert importer.files.suggestion.name == "square.ninepoint"
    assert importer.files.recent == [square]
    assert square.read_text() == SQUARE
    assert not importer.is_busy


@pytest.mark.parametrize("leave", ["reject", "close"])
def test_a_no_changes_nothing(qtbot, importer, square, leave):
    before = importer.session.document
    importer.files.open_path(square)
    getattr(asked(qtbot, importer), leave)()
    done(qtbot, importer)
    assert importer.session.document is before
    assert importer.files.recent == []


def test_our_own_svg_opens_without_a_question_and_without_loss(qtbot, importer, ours):
    with qtbot.waitSignal(importer.files.opened):
        importer.files.open_path(ours)
    assert importer.dialog is None
    document, letter = importer.session.document, letter_f()
    assert document.parameters == PRESETS["Tight"]
    for one, other in zip(document.curves, letter.curves, strict=True):
        assert (one.points == other.points).all()
        assert (one.closed, one.name) == (other.closed, other.name)
    assert importer.session.path is None


def test_our_own_svg_that_was_changed_is_asked_about(qtbot, importer, ours):
    text = ours.read_text()
    ours.write_text(text.replace("<path ", '<path transform="scale(2)" ', 1))
    assert read_sketch(ours).document is None
    importer.files.open_path(ours)
    asked(qtbot, importer)


def test_importing_adds_the_curves_in_one_step(qtbot, importer, answers, square, tmp_path):
    square.write_text(SQUARE.replace("</svg>", '<circle cx="30" cy="30" r="9"/></svg>'))
    answers.path = square
    with qtbot.waitSignal(importer.told) as told:
        importer.ask()
        asked(qtbot, importer).accept()
    session = importer.session
    assert told.args[0] == "Imported 2 curves from square.svg."
    assert session.undo_name == "Import 2 curves"
    assert len(session.document.curves) == 3
    assert set(session.selection.points.by_curve) == {1, 2}
    session.undo()
    assert len(session.document.curves) == 1


@pytest.mark.parametrize(
    ("name", "text", "count"),
    [("points.csv", "0,0\n10,0\n10,10\n", 3), ("points.json", "[[0,0],[1,0]]", 2)],
)
def test_points_are_imported_without_a_question(qtbot, importer, tmp_path, name, text, count):
    path = tmp_path / name
    path.write_text(text)
    with qtbot.waitSignal(importer.told) as told:
        importer.add([path])
    assert told.args[0] == f"Imported 1 curve from {name}."
    assert importer.session.document.curves[1].count == count
    assert importer.session.document.curves[1].name == "points"


def test_our_own_drawing_follows_the_scheme_of_the_one_it_comes_into(qtbot, importer, ours):
    with qtbot.waitSignal(importer.told) as told:
        importer.add([ours])
    assert told.args[0] == "Imported 2 curves from letter.svg, drawn by this scheme."
    assert importer.session.document.parameters == PRESETS["Calm"]


def test_several_files_come_one_after_the_other(qtbot, importer, square, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("0,0\n10,0\n10,10\n")
    importer.add([points, square, points])
    asked(qtbot, importer).accept()
    done(qtbot, importer)
    names = [curve.name for curve in importer.session.document.curves]
    assert names == ["Curve 1", "points", "Curve 2", "points 2"]


def test_a_no_ends_the_rest_too(qtbot, importer, square):
    importer.add([square, square])
    asked(qtbot, importer).reject()
    done(qtbot, importer)
    assert len(importer.session.document.curves) == 1


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("broken.svg", b"<svg", "broken.svg"),
        ("empty.dxf", b"", "the file is empty"),
        ("picture.svg", b"\x89PNG\r\n", "PNG"),
        ("points.csv", b"1,2\n3\n", "line 2"),
        ("points.json", b"[[1, 2], [3", "cut off"),
        ("missing.dxf", None, "no such file"),
    ],
)
def test_bad_files_are_refused_in_a_sentence_and_the_next_is_read(
    qtbot, importer, answers, tmp_path, name, data, words
):
    path = tmp_path / name
    if data is not None:
        path.write_bytes(data)
    good = tmp_path / "good.csv"
    good.write_text("0,0\n1,1\n")
    importer.add([path, good])
    done(qtbot, importer)
    ((title, sentence),) = answers.shown
    assert title == "Cannot import"
    assert words in sentence
    assert [curve.name for curve in importer.session.document.curves] == ["Curve 1", "good"]


def test_a_bad_foreign_file_leaves_the_drawing_and_the_recent_files(
    qtbot, importer, answers, tmp_path
):
    path = tmp_path / "gone.svg"
    importer._settings.add_recent(path)
    before = importer.session.document
    importer.files.open_path(path)
    done(qtbot, importer)
    assert "no longer there" in answers.shown[0][1]
    assert importer.session.document is before
    assert importer.files.recent == []


def test_the_choice_is_remembered(qtbot, importer, settings, square):
    importer.add([square])
    asked(qtbot, importer).vertices.click()
    qtbot.waitUntil(importer.dialog.take.isEnabled)
    importer.dialog.accept()
    done(qtbot, importer)
    assert not Way.read(settings.import_way).is_fit
    assert np.allclose(importer.session.document.curves[1].points[0], (10, 50))
    importer.add([square])
    assert asked(qtbot, importer).vertices.isChecked()


def test_changes_made_while_a_file_is_read_are_asked_about(
    qtbot, importer, answers, square, monkeypatch
):
    gate = Event()

    def read(path):
        assert gate.wait(10)
        return read_sketch(path)

    monkeypatch.setattr(importing, "read", read)
    importer.files.open_path(square)
    session = importer.session
    session.edit(session.document.with_parameters(PRESETS["Tight"]), "Preset Tight")
    changed = session.document
    gate.set()
    dialog = asked(qtbot, importer)
    answers.answer = Answer.CANCEL
    dialog.accept()
    done(qtbot, importer)
    assert answers.asked == ["Untitled"]
    assert session.document is changed


def test_a_long_reading_shows_a_bar_and_can_be_cancelled(qtbot, importer, square, monkeypatch):
    gate = Event()

    def read(path):
        assert gate.wait(10)
        return read_sketch(path)

    monkeypatch.setattr(importing, "read", read)
    before = importer.session.document
    importer.add([square, square])
    qtbot.waitUntil(lambda: importer.bar is not None and importer.bar.isVisible())
    assert "square.svg" in importer.bar.labelText()
    importer.bar.findChild(QPushButton).click()
    assert not importer.is_busy
    gate.set()
    qtbot.waitUntil(lambda: not importer._reading.is_busy)
    assert importer.session.document is before
    assert importer.dialog is None


def test_a_fault_of_the_program_does_not_stop_what_comes_next(
    qtbot, importer, square, tmp_path, monkeypatch
):
    monkeypatch.setattr("sys.excepthook", lambda *_: None)
    monkeypatch.setattr(
        importing, "read", lambda path: 1 // 0 if path == square else open_document(path)
    )
    points = tmp_path / "points.csv"
    points.write_text("0,0\n1,1\n")
    importer.add([square, points])
    qtbot.waitUntil(lambda: len(importer.session.document.curves) == 2)
    done(qtbot, importer)


def test_a_drawing_without_points_is_refused(qtbot, importer, answers, tmp_path, monkeypatch):
    monkeypatch.setattr(importing, "read", lambda path: Document())
    importer.add([tmp_path / "empty.ninepoint"])
    done(qtbot, importer)
    assert answers.shown == [("Cannot import", "empty.ninepoint: There are no points in it.")]
