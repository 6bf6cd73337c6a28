from threading import Event

import msgspec
import pytest
from PySide6.QtWidgets import QWidget

from answers import Answers
from app.exporting import TITLE, Exporter
from app.files import Files
from app.session import Session
from app.settings import Settings
from core.document import Curve, Document
from core.formats import export
from core.profiles import named
from core.store import save

SQUARE = Document((Curve([(0, 0), (40, 0), (40, 30), (0, 30)]),))


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def settings(tmp_path):
    settings = Settings()
    settings.export_folder = tmp_path
    settings.export_choice = "built-in/svg"
    return settings


@pytest.fixture
def exporter(qtbot, settings, answers):
    window = QWidget()
    qtbot.addWidget(window)
    window.show()
    qtbot.waitExposed(window)
    session = Session(SQUARE, window)
    files = Files(session, settings, answers, window)
    exporter = Exporter(session, files, settings, answers, window)
    exporter.session, exporter.files = session, files
    exporter.top = window  # a window lives as long as something holds it
    yield exporter
    exporter.stop()


def go_to(dialog, key):
    row = next(row for row, offer in dialog.list._offers.items() if offer.key == key)
    dialog.list.setCurrentRow(row)


def write(qtbot, exporter, key=None):
    """Export through the dialog, and give what was told."""
    exporter.ask()
    if key is not None:
        go_to(exporter.dialog, key)
    with qtbot.waitSignal(exporter.told) as told:
        exporter.dialog.export.click()
    return told.args[0]


@pytest.mark.parametrize(
    ("key", "suffix"),
    [
        ("built-in/svg", "svg"), ("built-in/laser", "dxf"), ("built-in/pdf", "pdf"),
        ("built-in/png", "png"), ("built-in/points", "csv"),
    ],
)  # fmt: skip
def test_an_export_says_before_what_it_writes(qtbot, exporter, answers, tmp_path, key, suffix):
    answers.path = tmp_path / f"shape.{suffix}"
    exporter.ask()
    go_to(exporter.dialog, key)
    qtbot.waitUntil(lambda: exporter.dialog.is_at_rest)
    promised = exporter.dialog.sentence.text().split("mm, 3")[0]  # without a picture's pixels
    with qtbot.waitSignal(exporter.told) as told:
        exporter.dialog.export.click()
    assert answers.suggested[-1] == tmp_path / f"Untitled.{suffix}"
    assert told.args[0].startswith(f"Exported shape.{suffix}: {promised}")
    assert answers.path.stat().st_size > 0
    assert exporter.dialog is None


def test_the_file_is_the_one_that_the_core_writes(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.svg"
    write(qtbot, exporter)
    (tmp_path / "core").mkdir()
    reference = tmp_path / "core" / "shape.svg"
    export(SQUARE, reference, named("svg"))
    assert answers.path.read_bytes() == reference.read_bytes()


def test_export_again_repeats_without_a_question(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.dxf"
    write(qtbot, exporter, "built-in/laser")
    before = answers.path.read_bytes()
    answers.suggested.clear()
    exporter.session.edit(Document((Curve(SQUARE.curves[0].points * 2),)), "Scale")
    told = []
    exporter.told.connect(told.append)
    exporter.repeat()
    qtbot.waitUntil(lambda: len(told) == 2)
    assert told[0] == "Writing shape.dxf\u2026"
    assert "64." in told[1]
    assert exporter.dialog is None
    assert answers.suggested == []
    assert answers.path.read_bytes() != before


def test_export_again_asks_the_first_time_and_for_another_drawing(
    qtbot, exporter, answers, tmp_path
):
    exporter.repeat()
    assert exporter.dialog is not None
    answers.path = tmp_path / "shape.svg"
    with qtbot.waitSignal(exporter.told):
        exporter.dialog.export.click()
    exporter.files.new()
    exporter.repeat()
    assert exporter.dialog is not None


def test_a_drawing_that_is_opened_meanwhile_does_not_inherit_the_target(
    qtbot, exporter, answers, tmp_path, monkeypatch
):
    gate = Event()

    def slow(*args):
        assert gate.wait(10)
        return export(*args)

    monkeypatch.setattr("app.exporting.export", slow)
    answers.path = tmp_path / "shape.svg"
    exporter.ask()
    with qtbot.waitSignal(exporter.told):
        exporter.dialog.export.click()
        assert not answers.path.exists()  # it is written in the background
        exporter.files.new()
        gate.set()
    assert answers.path.exists()
    exporter.repeat()
    assert exporter.dialog is not None


def test_the_choices_are_remembered(qtbot, exporter, settings, answers, tmp_path):
    (tmp_path / "out").mkdir()
    answers.path = tmp_path / "out" / "shape.dxf"
    exporter.ask()
    go_to(exporter.dialog, "built-in/laser")
    exporter.dialog.fields.show_profile(named("laser").within(0.25))
    with qtbot.waitSignal(exporter.told):
        exporter.dialog.export.click()
    assert settings.export_folder == tmp_path / "out"
    exporter.ask()
    assert exporter.dialog.profile == named("laser").within(0.25)


def test_a_suffix_is_added_to_a_name_without(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape 1.5"
    write(qtbot, exporter)
    assert (tmp_path / "shape 1.5.svg").is_file()


def test_without_a_name_the_dialog_stays(exporter, answers, tmp_path):
    exporter.ask()
    exporter.dialog.export.click()
    assert answers.suggested
    assert exporter.dialog.isVisible()
    assert exporter.dialog.export.isEnabled()
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_told_in_the_dialog(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "no folder" / "shape.svg"
    exporter.ask()
    qtbot.waitUntil(lambda: exporter.dialog.is_at_rest)
    exporter.dialog.export.click()
    qtbot.waitUntil(lambda: "shape.svg" in exporter.dialog.sentence.text())
    assert exporter.dialog.isVisible()
    assert exporter.dialog.export.isEnabled()
    assert answers.shown == []
    answers.path = tmp_path / "shape.svg"
    with qtbot.waitSignal(exporter.told):
        exporter.dialog.export.click()


def test_a_repeated_export_that_fails_is_told(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.svg"
    write(qtbot, exporter)
    before = answers.path.read_bytes()
    exporter.session.edit(Document(), "Clear")
    exporter.repeat()
    qtbot.waitUntil(lambda: bool(answers.shown))
    title, sentence = answers.shown[0]
    assert title == TITLE
    assert "nothing to export" in sentence
    assert answers.path.read_bytes() == before


@pytest.mark.parametrize("fault", [OSError(28, "No space left on device"), MemoryError()])
def test_a_machine_that_is_full_is_told(
    qtbot, exporter, answers, tmp_path, monkeypatch, fault
):
    def full(*args):
        raise fault

    monkeypatch.setattr("app.exporting.export", full)
    answers.path = tmp_path / "shape.svg"
    exporter.ask()
    qtbot.waitUntil(lambda: exporter.dialog.is_at_rest)
    exporter.dialog.export.click()
    words = "No space left" if isinstance(fault, OSError) else "not enough memory"
    qtbot.waitUntil(lambda: words in exporter.dialog.sentence.text())


def test_the_file_that_the_drawing_came_from_is_not_overwritten(
    qtbot, exporter, answers, settings, tmp_path
):
    source = tmp_path / "points.csv"
    source.write_text("0,0\n40,0\n40,30\n0,30\n0,0\n")
    before = source.read_bytes()
    assert exporter.files.open_path(source)
    assert exporter.files.source == source
    answers.path = source
    exporter.ask()
    go_to(exporter.dialog, "built-in/points")
    qtbot.waitUntil(lambda: exporter.dialog.is_at_rest)
    exporter.dialog.export.click()
    qtbot.waitUntil(lambda: "came from" in exporter.dialog.sentence.text())
    assert source.read_bytes() == before
    exporter.dialog.reject()
    exporter.files.new()
    assert exporter.files.source is None


def test_nor_through_another_name_of_it(qtbot, exporter, answers, tmp_path):
    own = tmp_path / "shape.ninepoint"
    save(SQUARE, own)
    exporter.files.open_path(own)
    link = tmp_path / "shape.svg"
    link.symlink_to(own)
    before = own.read_bytes()
    answers.path = link
    exporter.ask()
    qtbot.waitUntil(lambda: exporter.dialog.is_at_rest)
    exporter.dialog.export.click()
    qtbot.waitUntil(lambda: "came from" in exporter.dialog.sentence.text())
    assert own.read_bytes() == before


def test_profiles_of_the_drawing_are_offered_and_written(qtbot, exporter, answers, tmp_path):
    profile = msgspec.structs.replace(named("svg"), name="blue", title="Blue", colour="#0000ff")
    exporter.session.edit(exporter.session.document.with_profile(profile), "Save profile Blue")
    answers.path = tmp_path / "shape.svg"
    write(qtbot, exporter, "drawing/blue")
    assert b"#0000ff" in answers.path.read_bytes()


def test_stopping_waits_for_the_file(qtbot, exporter, answers, tmp_path):
    answers.path = tmp_path / "shape.svg"
    exporter.ask()
    exporter.dialog.export.click()
    exporter.stop()
    assert answers.path.read_bytes().endswith(b"</svg>\n")
    assert exporter.dialog is None
