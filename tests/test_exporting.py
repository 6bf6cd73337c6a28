from fractions import Fraction

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget

from answers import Answers
from app.exporting import FORMATS, ExportDialog, Exporter, described, trial
from app.files import Files
from app.opening import ready_document
from app.session import Session
from app.settings import Settings
from core.document import Document
from core.formats import export, profile_for


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def settings():
    return Settings()


@pytest.fixture
def exporter(qtbot, settings, answers):
    window = QWidget()
    qtbot.addWidget(window)
    window.show()
    qtbot.waitExposed(window)
    session = Session(ready_document(), window)
    files = Files(session, settings, answers, window)
    exporter = Exporter(session, files, settings, answers, window)
    exporter.session, exporter.files = session, files
    exporter.top = window  # a window lives as long as something holds it
    return exporter


def type_into(field, text):
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Tab)


@pytest.mark.parametrize(
    ("index", "suffix", "size"),
    [(0, "svg", "99.28 \u00d7 58.34 mm"), (1, "dxf", "99.26 \u00d7 58.35 mm")],
)
def test_an_export_says_before_what_it_writes(
    qtbot, exporter, answers, tmp_path, index, suffix, size
):
    answers.path = tmp_path / f"shape.{suffix}"
    exporter.ask()
    exporter.dialog.choice.setCurrentIndex(index)
    promised = exporter.dialog.preview.text()
    with qtbot.waitSignal(exporter.told) as told:
        exporter.dialog.accept()
    assert answers.suggested[-1].name == f"Untitled.{suffix}"
    assert told.args[0] == f"Exported shape.{suffix}: {promised}."
    assert promised.startswith(f"{size}, closed, ")
    assert answers.path.stat().st_size > 0


def test_the_file_is_the_one_that_the_core_writes(exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.svg"
    exporter.ask()
    exporter.dialog.accept()
    (tmp_path / "core").mkdir()
    reference = tmp_path / "core" / "shape.svg"
    export(exporter.session.document, reference, profile_for(reference))
    assert answers.path.read_bytes() == reference.read_bytes()


def test_export_again_repeats_without_a_question(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.dxf"
    exporter.ask()
    exporter.dialog.choice.setCurrentIndex(1)
    exporter.dialog.accept()
    answers.path.unlink()
    exporter.dialog = None
    with qtbot.waitSignal(exporter.told):
        exporter.repeat()
    assert exporter.dialog is None
    assert answers.path.is_file()


def test_export_again_asks_the_first_time_and_for_another_drawing(exporter, answers, tmp_path):
    exporter.repeat()
    assert exporter.dialog is not None
    answers.path = tmp_path / "shape.svg"
    exporter.dialog.accept()
    exporter.files.new()
    exporter.dialog = None
    exporter.repeat()
    assert exporter.dialog is not None


def test_the_choices_are_remembered(qtbot, exporter, settings, answers, tmp_path):
    answers.path = tmp_path / "shape.dxf"
    exporter.ask()
    exporter.dialog.choice.setCurrentIndex(1)
    qtbot.waitUntil(exporter.dialog.choice.hasFocus)
    type_into(exporter.dialog.field, "1/4")
    exporter.dialog.accept()
    assert settings.export_folder == tmp_path
    again = ExportDialog(exporter.session.document, settings)
    qtbot.addWidget(again)
    assert again.format.suffix == "dxf"
    assert again.tolerance == Fraction(1, 4)


def test_a_suffix_is_added_to_a_name_without(exporter, answers, tmp_path):
    answers.path = tmp_path / "shape 1.5"
    exporter.ask()
    exporter.dialog.accept()
    assert (tmp_path / "shape 1.5.svg").is_file()


@pytest.fixture
def dialog(qtbot, settings):
    dialog = ExportDialog(ready_document(), settings)
    qtbot.addWidget(dialog)
    dialog.show()
    qtbot.waitUntil(dialog.choice.hasFocus)
    return dialog


@pytest.mark.parametrize("text", ["abc", "0", "-1", "1e9", "1e-9"])
def test_a_tolerance_that_is_nonsense_cannot_be_accepted(dialog, text):
    type_into(dialog.field, text)
    assert not dialog.export.isEnabled()
    assert dialog.preview.text().endswith(".")
    type_into(dialog.field, "0.1")
    assert dialog.export.isEnabled()
    assert dialog.preview.text().startswith("99.37 \u00d7 58.39 mm")


def test_enter_in_a_refused_field_does_not_export(dialog, qtbot):
    dialog.field.selectAll()
    QTest.keyClicks(dialog.field, "abc")
    QTest.keyClick(dialog.field, Qt.Key.Key_Return)
    assert dialog.isVisible()


def test_a_coarser_tolerance_needs_fewer_pieces():
    fine = trial(ready_document(), FORMATS[0], 0.001)
    coarse = trial(ready_document(), FORMATS[0], 0.1)
    assert coarse.entities < fine.entities
    assert "\u2264" in described(coarse)


def test_an_empty_drawing_cannot_be_exported(qtbot, settings):
    dialog = ExportDialog(Document(), settings)
    qtbot.addWidget(dialog)
    assert not dialog.export.isEnabled()
    assert "nothing to export" in dialog.preview.text()


def test_a_folder_that_cannot_be_written_is_told(exporter, answers, tmp_path):
    answers.path = tmp_path / "no folder" / "shape.svg"
    exporter.ask()
    exporter.dialog.accept()
    assert answers.shown[0][0] == "Cannot export"
    assert "shape.svg" in answers.shown[0][1]


def test_nonsense_that_was_remembered_is_replaced(qtbot, settings):
    settings.export_format, settings.export_tolerance = "exe", "-3"
    dialog = ExportDialog(ready_document(), settings)
    qtbot.addWidget(dialog)
    assert dialog.format.suffix == "svg"
    assert dialog.tolerance == Fraction(1, 100)
