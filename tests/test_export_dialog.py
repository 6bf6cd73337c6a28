from dataclasses import replace

import msgspec
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QPalette
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox

from answers import Answers
from app.export_dialog import SIZE_PX, ExportDialog
from app.export_shelf import Place, Shelf
from app.pages import register_encoders
from app.session import Session
from app.settings import Settings
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.document import Curve, Document
from core.profiles import named

SQUARE = Document((Curve([(0, 0), (40, 0), (40, 30), (0, 30)]),))


@pytest.fixture
def session():
    return Session(SQUARE)


@pytest.fixture
def settings():
    settings = Settings()
    settings.export_choice = "built-in/svg"
    return settings


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def opened(qtbot, session, settings, answers):
    made = []

    def make():
        dialog = ExportDialog(
            lambda: session.document, Shelf(session, settings), settings, answers
        )
        qtbot.addWidget(dialog)
        dialog.show()
        qtbot.waitUntil(dialog.list.hasFocus)
        qtbot.waitUntil(lambda: dialog.is_at_rest)
        made.append(dialog)
        return dialog

    register_encoders()
    yield make
    for dialog in made:
        dialog._surveyor.stop()


@pytest.fixture
def dialog(opened):
    return opened()


def settle(qtbot, dialog):
    qtbot.waitUntil(lambda: dialog.is_at_rest)


def type_into(dialog, key, text):
    editor = dialog.fields.editors[key]
    editor.setFocus()
    editor.selectAll()
    QTest.keyClicks(editor, text)
    QTest.keyClick(editor, Qt.Key.Key_Tab)


def go_to(dialog, key):
    row = next(row for row, offer in dialog.list._offers.items() if offer.key == key)
    dialog.list.setCurrentRow(row)


def ink(label):
    return label.palette().color(QPalette.ColorRole.WindowText).name()


def test_the_laser_is_proposed_at_first(opened, settings):
    settings.export_choice = ""
    assert opened().profile == named("laser")


def test_what_will_be_written_is_told_and_shown_before(dialog):
    assert dialog.sentence.text().startswith("32.36\u00a0\u00d7\u00a024.26 mm, closed, ")
    assert dialog.title.text() == named("svg").title
    assert dialog.use.text() == named("svg").use
    assert dialog.preview.picture.width == "32.36 mm"
    assert dialog.export.isEnabled()
    assert dialog.export.isDefault()


def test_another_profile_shows_its_own_fields_and_result(qtbot, dialog):
    QTest.keyClicks(dialog.list, "old")
    assert dialog.profile == named("laser-r12")
    settle(qtbot, dialog)
    assert " vertices, " in dialog.sentence.text()
    assert "states no unit" in dialog.notes.text()


def test_a_changed_field_is_surveyed_anew(qtbot, dialog):
    before = dialog.sentence.text()
    type_into(dialog, "tolerance_mm", "1")
    assert dialog.profile == named("svg").within(1.0)
    assert dialog.title.text() == f"{named('svg').title}, changed"
    settle(qtbot, dialog)
    assert dialog.sentence.text() != before
    dialog.reset.click()
    assert dialog.profile == named("svg")
    assert not dialog.reset.isEnabled()
    settle(qtbot, dialog)
    assert dialog.sentence.text() == before


def test_the_last_result_stays_and_is_marked_until_there_is_another(qtbot, dialog, monkeypatch):
    dialog.setPalette(window_palette(LIGHT))
    before = dialog.sentence.text()
    monkeypatch.setattr(dialog._surveyor, "ask", lambda *_: None)
    type_into(dialog, "tolerance_mm", "1")
    assert dialog.sentence.text() == before
    qtbot.waitUntil(lambda: not dialog._stale.isActive())
    assert dialog.sentence.text() == before
    assert ink(dialog.sentence) == LIGHT.muted_text
    assert dialog.export.isEnabled()


def test_before_the_first_result_it_is_measured(qtbot, opened, monkeypatch):
    monkeypatch.setattr("app.export_survey.Surveyor.ask", lambda *_: None)
    dialog = opened()
    qtbot.waitUntil(lambda: not dialog._stale.isActive())
    assert dialog.sentence.text() == "Measuring\u2026"
    assert dialog.export.isEnabled()


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_faults_stand_in_their_place_and_nothing_is_exported(qtbot, dialog, palette):
    dialog.setPalette(window_palette(palette))
    wanted = []
    dialog.wanted.connect(wanted.append)
    type_into(dialog, "tolerance_mm", "abc")
    assert dialog.sentence.text().startswith("Tolerance must be a number")
    assert ink(dialog.sentence) == palette.warning
    assert not dialog.export.isEnabled()
    QTest.keyClick(dialog.fields.editors["tolerance_mm"], Qt.Key.Key_Return)
    assert wanted == []
    type_into(dialog, "tolerance_mm", "0.1")
    settle(qtbot, dialog)
    assert dialog.export.isEnabled()
    assert ink(dialog.sentence) == palette.text


def test_what_the_survey_refuses_cannot_be_exported(qtbot, dialog):
    go_to(dialog, "built-in/png")
    type_into(dialog, "dpi", "10000")
    settle(qtbot, dialog)
    assert "choose at most" in dialog.sentence.text()
    assert not dialog.export.isEnabled()
    type_into(dialog, "dpi", "96")
    settle(qtbot, dialog)
    assert dialog.export.isEnabled()
    assert dialog.sentence.text().endswith(" pixels")


def test_an_empty_drawing_cannot_be_exported(opened, session):
    session.edit(Document(), "Clear")
    dialog = opened()
    assert "nothing to export" in dialog.sentence.text()
    assert not dialog.export.isEnabled()


def test_enter_in_the_list_and_alt_e_ask_for_the_file(qtbot, dialog):
    with qtbot.waitSignal(dialog.wanted) as wanted:
        QTest.keyClick(dialog.list, Qt.Key.Key_Return)
    assert wanted.args == [named("svg")]
    with qtbot.waitSignal(dialog.wanted):
        dialog.export.click()


def test_changes_of_several_profiles_are_kept_apart_and_remembered(qtbot, dialog, opened, settings):
    type_into(dialog, "tolerance_mm", "1")
    go_to(dialog, "built-in/laser")
    assert dialog.profile == named("laser")
    type_into(dialog, "tolerance_mm", "0.5")
    go_to(dialog, "built-in/svg")
    assert dialog.profile == named("svg").within(1.0)
    dialog.remember()
    again = opened()
    assert again.profile == named("svg").within(1.0)
    assert again.reset.isEnabled()
    go_to(again, "built-in/laser")
    assert again.profile == named("laser").within(0.5)
    again.reset.click()
    again.remember()
    assert settings.export_choice == "built-in/laser"
    assert settings.export_changes == {"built-in/svg": named("svg").within(1.0)}


def test_giving_up_remembers_nothing(dialog, settings):
    type_into(dialog, "tolerance_mm", "1")
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert not dialog.isVisible()
    assert settings.export_changes == {}


@pytest.mark.parametrize("place", [Place.OWN, Place.DRAWING])
def test_fields_are_saved_as_a_profile_and_deleted(dialog, answers, settings, session, place):
    type_into(dialog, "tolerance_mm", "1")
    answers.typed = "Thin lines"
    (dialog.for_all if place is Place.OWN else dialog.for_this).trigger()
    offer = dialog.list.offer
    assert (offer.place, offer.profile.title) == (place, "Thin lines")
    assert dialog.title.text() == "Thin lines"
    assert not dialog.reset.isEnabled()
    kept = settings.export_profiles if place is Place.OWN else session.document.profiles
    assert kept == (offer.profile,)
    assert kept[0].tolerance_mm == 1.0
    go_to(dialog, "built-in/svg")
    assert dialog.profile == named("svg")
    assert not dialog.delete.isEnabled()
    go_to(dialog, offer.key)
    dialog.delete.click()
    assert settings.export_profiles == session.document.profiles == ()
    assert dialog.list.offer.place is Place.BUILT_IN


def test_an_own_profile_is_saved_again_under_its_name(dialog, answers, settings):
    answers.typed = "Thin lines"
    dialog.for_all.trigger()
    assert answers.asked == [""]
    type_into(dialog, "tolerance_mm", "1")
    dialog.for_all.trigger()
    assert answers.asked == ["", "Thin lines"]
    (kept,) = settings.export_profiles
    assert kept.tolerance_mm == 1.0


def test_a_long_title_does_not_widen_the_dialog(dialog, answers):
    width = dialog.minimumSizeHint().width()
    answers.typed = "W" * 100
    dialog.for_all.trigger()
    assert dialog.title.text().endswith("\u2026")
    assert dialog.title.toolTip() == "W" * 100
    assert dialog.minimumSizeHint().width() <= width + 300
    assert dialog.width() == SIZE_PX[0]


def test_a_title_that_cannot_be_is_told(dialog, answers, settings):
    answers.typed = "  "
    dialog.for_all.trigger()
    assert dialog.sentence.text() == "A profile needs a title."
    answers.typed = None
    dialog.for_all.trigger()
    assert settings.export_profiles == ()


def test_while_a_file_is_written_the_dialog_waits(qtbot, dialog):
    dialog.set_busy(True)
    assert dialog.sentence.text() == "Writing\u2026"
    assert not dialog.export.isEnabled()
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert dialog.isVisible()
    dialog.tell_fault("no.txt: the disk is full.")
    qtbot.waitUntil(lambda: not dialog._stale.isActive())
    assert dialog.sentence.text() == "no.txt: the disk is full."
    assert dialog.export.isEnabled()
    assert dialog.buttons.button(QDialogButtonBox.StandardButton.Cancel).isEnabled()


def test_many_notes_are_counted(dialog):
    survey = dialog._survey
    dialog._take_survey(replace(survey, notes=("one.", "two.", "three.", "four.")))
    assert dialog.notes.text() == "one.\nAnd 3 more notes of this kind."
    dialog._take_survey(replace(survey, notes=("one.", "two.")))
    assert dialog.notes.text() == "one.\ntwo."


def test_a_kerf_is_shown_beside_the_outline(qtbot, dialog):
    go_to(dialog, "built-in/laser-r12")
    type_into(dialog, "kerf_mm", "1")
    assert dialog.profile == msgspec.structs.replace(named("laser-r12"), kerf_mm=1.0)
    settle(qtbot, dialog)
    assert dialog.sentence.text().startswith("34.34\u00a0\u00d7\u00a026.")
    assert dialog._survey.original is not None


def test_tab_reaches_everything(qtbot, dialog):
    dialog.list.setFocus()
    seen = []
    for _ in range(20):
        seen.append(dialog.focusWidget())
        dialog.focusNextChild()
    fields = dialog.fields._seen()
    for part in (dialog.list, dialog.keep, dialog.export, *fields):
        assert part in seen or part.focusProxy() in seen
    places = [seen.index(e.focusProxy() or e) for e in fields]
    assert places == sorted(places)
    for part in seen:
        assert part.accessibleName() or part.text()
