from fractions import Fraction

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QLabel, QLineEdit

from app import import_found
from app.import_dialog import MOST_FITTED, ImportDialog
from app.import_found import contents, rounded_up
from app.import_way import Way
from app.style import DARK
from app.theme import window_palette
from app.worker import Worker
from core.errors import NinepointError
from core.family import PRESETS
from core.formats.outlines import straight
from core.formats.sketch import Sketch, Trace

ARC = np.array([[(0, 0), (0, 55), (45, 100), (100, 100)]], dtype=float)
TENTH = Way(True, Fraction(1, 10))


def polygon(count=4, closed=True, radius=10.0):
    turns = np.linspace(0, 2 * np.pi, count, endpoint=False)
    corners = np.stack([np.cos(turns), np.sin(turns)], axis=1) * radius
    return Trace(straight(corners, np.roll(corners, -1, axis=0)), closed)


def arc():
    return Sketch((Trace(ARC, False, "Arc"),), "mm", True)


@pytest.fixture
def shown(qtbot):
    fitting, painting = Worker(), Worker()
    dialogs = []

    def show(sketch, way=TENTH, parameters=PRESETS["Calm"]):
        dialog = ImportDialog(sketch, "wing.dxf", "Import", parameters, way, fitting, painting)
        qtbot.addWidget(dialog)
        dialogs.append(dialog)
        dialog.show()
        return dialog

    yield show
    for dialog in dialogs:
        dialog.reject()
    fitting.stop()
    painting.stop()


def settled(qtbot, dialog):
    qtbot.waitUntil(lambda: dialog.found is not None, timeout=20_000)
    return dialog.found


def type_into(field, text):
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Tab)


def test_it_shows_what_the_file_holds_and_what_it_becomes(qtbot, shown):
    dialog = shown(arc())
    assert dialog.windowTitle() == "Import wing.dxf"
    assert dialog.size_label.text() == "100.00 \u00d7 100.00 mm"
    assert dialog.contents.text() == "1, open"
    assert dialog.pieces.text() == "1 line or curve"
    assert dialog.doubt.isHidden()
    found = settled(qtbot, dialog)
    (curve,) = found.document.curves
    assert f"{curve.count} control points" in dialog.outcome.text()
    assert "proven" in dialog.outcome.text()
    assert dialog.take.isEnabled()
    assert dialog.preview.sight is found.sight


def test_a_smaller_tolerance_takes_more_points(qtbot, shown):
    dialog = shown(arc())
    few = settled(qtbot, dialog).document.curves[0].count
    type_into(dialog.field, "0.001")
    assert not dialog.take.isEnabled()
    assert settled(qtbot, dialog).document.curves[0].count > few
    assert dialog.way == Way(True, Fraction(1, 1000))


def test_the_vertices_are_the_control_points(qtbot, shown):
    dialog = shown(Sketch((polygon(6),), "mm", True))
    settled(qtbot, dialog)
    dialog.vertices.click()
    found = settled(qtbot, dialog)
    assert np.allclose(found.document.curves[0].points, polygon(6).nodes)
    assert dialog.outcome.text().startswith("6 control points.")
    assert "proven" not in dialog.outcome.text()
    assert not dialog.way.is_fit


def test_what_is_lost_between_vertices_is_said(qtbot, shown):
    dialog = shown(arc(), Way(False))
    settled(qtbot, dialog)
    assert "is lost" in dialog.outcome.text()


def test_typing_a_tolerance_chooses_the_fit(qtbot, shown):
    dialog = shown(arc(), Way(False))
    settled(qtbot, dialog)
    type_into(dialog.field, "0.5")
    assert dialog.fit.isChecked()
    settled(qtbot, dialog)
    assert "proven" in dialog.outcome.text()


def test_another_unit_changes_the_size_and_the_curves(qtbot, shown):
    sketch = Sketch((polygon(4),), "px", False)
    dialog = shown(sketch, Way(False))
    assert not dialog.doubt.isHidden()
    settled(qtbot, dialog)
    dialog.unit.setCurrentIndex(dialog.unit.findData("in"))
    assert dialog.size_label.text() == "1920.00 \u00d7 1920.00 mm"
    found = settled(qtbot, dialog)
    assert np.allclose(found.document.curves[0].points, polygon(4).nodes * 96)
    dialog.unit.setCurrentIndex(dialog.unit.findData("px"))
    assert np.allclose(settled(qtbot, dialog).document.curves[0].points, polygon(4).nodes)


def test_a_bad_tolerance_is_refused_in_a_sentence(qtbot, shown):
    dialog = shown(arc())
    settled(qtbot, dialog)
    type_into(dialog.field, "-1")
    assert dialog.outcome.text() == "tolerance must be greater than 0."
    assert not dialog.take.isEnabled()
    dialog.accept()
    assert dialog.isVisible()
    dialog.vertices.click()
    assert settled(qtbot, dialog).document is not None


def test_what_cannot_be_fitted_is_said_and_the_vertices_can_be_taken(qtbot, shown):
    dialog = shown(Sketch((Trace(ARC, False, deviation=1.0),), "mm", True))
    assert settled(qtbot, dialog).document is None
    assert "larger tolerance" in dialog.outcome.text()
    assert not dialog.take.isEnabled()
    dialog.vertices.click()
    assert settled(qtbot, dialog).document is not None
    assert dialog.take.isEnabled()


def endless(sketch, parameters, tolerance, cancelled, told):
    told(1)
    while not cancelled():
        pass
    raise NinepointError("The fit was stopped.")


def test_a_long_fit_shows_its_progress_and_can_be_stopped(qtbot, shown, monkeypatch):
    monkeypatch.setattr(import_found, "fitted", endless)
    dialog = shown(Sketch((polygon(4), polygon(5)), "mm", True))
    qtbot.waitUntil(dialog.progress.isVisible)
    qtbot.waitUntil(lambda: dialog.progress.value() == 1)
    assert dialog.progress.maximum() == 2
    assert not dialog.take.isEnabled()
    dialog.halt.click()
    assert "Stopped" in dialog.outcome.text()
    assert dialog.outcome.isVisible()
    dialog.vertices.click()
    assert settled(qtbot, dialog).document is not None


def test_closing_ends_the_fit(qtbot, shown, monkeypatch):
    monkeypatch.setattr(import_found, "fitted", endless)
    dialog = shown(arc())
    dialog.reject()
    qtbot.waitUntil(lambda: not dialog._fitting.is_busy)
    assert not dialog.isVisible()


def test_a_fault_of_the_program_leaves_the_dialog_usable(qtbot, shown, monkeypatch):
    monkeypatch.setattr("sys.excepthook", lambda *_: None)
    monkeypatch.setattr(import_found, "fitted", lambda *_: 1 // 0)
    dialog = shown(arc())
    assert settled(qtbot, dialog).document is None
    dialog.vertices.click()
    assert settled(qtbot, dialog).document is not None


def test_a_large_drawing_is_not_fitted_without_being_asked(qtbot, shown):
    dialog = shown(Sketch((polygon(MOST_FITTED + 1),), "mm", True))
    assert dialog.vertices.isChecked()


def test_notes_of_the_reader_are_shown(shown):
    sketch = Sketch((polygon(4),), "mm", True, ("Left out: 2 texts.",))
    texts = [label.text() for label in shown(sketch, Way(False)).findChildren(QLabel)]
    assert any("Left out: 2 texts." in text for text in texts)


@pytest.mark.parametrize(
    ("traces", "words"),
    [
        ([polygon()], "1, closed"),
        ([polygon(), polygon()], "2, all closed"),
        ([polygon(), Trace(ARC, False)], "2, of which 1 is closed"),
    ],
)
def test_contents_in_words(traces, words):
    assert contents(Sketch(tuple(traces), "mm", True)) == words


@pytest.mark.parametrize("value", [0.0099371, 0.1, 1.0, 12.01, 9.96e-3, 3e-7])
def test_a_rounded_bound_stays_a_bound(value):
    assert value <= float(rounded_up(value)) <= 1.11 * value


def test_everything_has_a_name_and_is_reached_by_tab(qtbot, shown):
    dialog = shown(arc())
    settled(qtbot, dialog)
    for kind in (QAbstractButton, QLineEdit, QComboBox):
        for widget in dialog.findChildren(kind):
            assert widget.accessibleName() or widget.text(), widget
    dialog.fit.setFocus()
    reached, widget = set(), dialog.fit
    for _ in range(40):
        widget = widget.nextInFocusChain()
        reached.add(widget)
    assert {dialog.unit, dialog.field, dialog.preview, dialog.take, dialog.vertices} <= reached


def test_the_preview_zooms_moves_and_shows_all_again(qtbot, shown):
    dialog = shown(arc())
    settled(qtbot, dialog)
    preview, whole = dialog.preview, dialog.preview.camera
    at = QPointF(100, 120)
    held = whole.to_mm((100, 120))
    wheel = QWheelEvent(
        at, preview.mapToGlobal(at), QPoint(), QPoint(0, 240), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(preview, wheel)
    assert preview.camera.scale > whole.scale
    assert np.allclose(preview.camera.to_mm((100, 120)), held)
    preview.setFocus()
    before = preview.camera
    QTest.keyClick(preview, Qt.Key.Key_Right)
    assert preview.camera.x_mm > before.x_mm
    QTest.keyClick(preview, Qt.Key.Key_0)
    assert preview.camera == whole
    for _ in range(60):
        QTest.keyClick(preview, Qt.Key.Key_Plus)
    assert preview.camera.scale == pytest.approx(64 * whole.scale)


def test_the_preview_is_painted_in_the_colours_of_the_scheme(qtbot, shown):
    dialog = shown(arc())
    settled(qtbot, dialog)
    dialog.setPalette(window_palette(DARK))

    def inks():
        image = dialog.preview.grab().toImage()
        return {image.pixelColor(x, y).name() for x in range(0, 400, 3) for y in range(0, 300, 3)}

    qtbot.waitUntil(lambda: DARK.accent in inks() and DARK.background in inks())
