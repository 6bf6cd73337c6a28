import subprocess
import sys
from pathlib import Path
from threading import Event

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, QRect, QSettings, Qt, QUrl
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QApplication,
    QHeaderView,
    QLineEdit,
    QMessageBox,
    QScrollBar,
)

from answers import Answers
from app import analysis
from app.actions import COMMANDS
from app.dialogs import Answer, Dialogs
from app.failures import SENTENCE, Failures
from app.launch import run
from app.opening import READY_POINTS_MM
from app.session import Selection
from app.settings import Settings
from app.style import DARK, LIGHT, palette_of
from app.theme import window_palette
from app.window import MainWindow
from core.chords import COARSE_LEVEL
from core.continuity import Effort, smoothness
from core.document import Curve, Document
from core.errors import NinepointError
from core.family import PRESETS, Parameters

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
    window.activateWindow()
    return window


def change(window, name="Tight"):
    window.scheme.choose_preset(name)


def dropped(window, *paths):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    args = (Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, NO_KEYS)
    enter = QDragEnterEvent(QPoint(300, 300), *args)
    QApplication.sendEvent(window, enter)
    if enter.isAccepted():
        QApplication.sendEvent(window, QDropEvent(QPointF(300, 300), *args))
    return enter.isAccepted()


def test_it_opens_on_a_ready_closed_shape(qtbot, window):
    (curve,) = window.session.document.curves
    assert curve.closed
    assert np.array_equal(curve.points, READY_POINTS_MM)
    assert window.session.document.parameters == PRESETS["Calm"]
    assert window.windowTitle() == "Untitled[*] - Ninepoint"
    assert not window.isWindowModified()
    assert window.status.hint.text()
    qtbot.waitUntil(lambda: window.status.size_label.text() == "99.27 \u00d7 58.35 mm")


def test_the_plots_come_after_the_first_paint(qtbot):
    window = MainWindow()
    qtbot.addWidget(window)
    assert window.docks.basis_plot is None
    with qtbot.waitSignal(window.completed):
        window.show()
    assert window.docks.basis_plot.isVisible()
    assert window.docks.step_plot.isVisible()


def test_the_first_paint_loads_nothing_that_it_does_not_need():
    script = """
import sys
from app.settings import Settings
from app.theme import styled_application
from app.window import MainWindow
application = styled_application("ninepoint")
window = MainWindow(settings=Settings(None))
window.show()
window.canvas.repaint()
assert window.canvas.scene.curves[0].outline_line.near((0, 0, 900, 900), 1.0)
heavy = ("pyqtgraph", "ezdxf", "msgspec", "scipy", "numpy.ma")
print(*(name for name in heavy if name in sys.modules))
sys.stdout.flush()
import os
os._exit(0)
"""
    root = Path(__file__).parents[1]
    run = subprocess.run(
        [sys.executable, "-c", script], cwd=root, capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == ""


def test_nothing_moves_after_the_first_paint(qtbot):
    window = MainWindow()
    qtbot.addWidget(window)
    with qtbot.waitExposed(window):
        window.show()
    first = [widget.geometry() for widget in (window.canvas, *window.docks.all)]
    qtbot.waitUntil(lambda: window.docks.basis_plot is not None)
    QApplication.processEvents()
    assert [widget.geometry() for widget in (window.canvas, *window.docks.all)] == first


@pytest.mark.parametrize("name", ["report", "map"])
def test_hidden_panels_are_made_when_they_are_first_seen(qtbot, window, name):
    dock = getattr(window.docks, name)
    waiting = dock.widget()
    dock.toggleViewAction().trigger()  # behind the tab of the lists
    assert dock.widget() is waiting
    dock.raise_()
    qtbot.waitUntil(lambda: dock.widget() is not waiting)
    made = dock.widget()
    assert made is getattr(window, name)
    assert made.isVisible()
    dock.close()
    dock.toggleViewAction().trigger()
    dock.raise_()
    qtbot.waitUntil(made.isVisible)
    assert dock.widget() is made


def test_every_icon_is_there_after_the_first_paint(window):
    for command in COMMANDS:
        assert window.commands[command.key].icon().isNull() is (command.icon == "")


def test_moving_a_slider_changes_curve_and_plots_together(window):
    before = window.docks.basis_plot.curve.values.copy()
    sentence = window.docks.step_plot.sentence
    change(window, "Lagrange")
    assert not np.array_equal(window.docks.basis_plot.curve.values, before)
    assert window.docks.step_plot.sentence != sentence


def test_the_title_marks_unsaved_changes(window, answers, tmp_path):
    change(window)
    assert window.isWindowModified()
    answers.path = tmp_path / "wing.ninepoint"
    window.commands["save"].trigger()
    assert window.windowTitle() == "wing.ninepoint[*] - Ninepoint"
    assert not window.isWindowModified()
    change(window, "Lean")
    window.commands["undo"].trigger()
    assert not window.isWindowModified()


def test_a_name_with_the_mark_in_it_is_shown_as_it_is(window, answers, tmp_path):
    answers.path = tmp_path / "a[*]b.ninepoint"
    window.commands["save"].trigger()
    assert window.windowTitle() == "a[*][*]b.ninepoint[*] - Ninepoint"


@pytest.mark.parametrize("answer", list(Answer))
def test_closing_asks_about_unsaved_changes(window, answers, tmp_path, answer):
    change(window)
    answers.answer, answers.path = answer, tmp_path / "wing.ninepoint"
    assert window.close() is (answer is not Answer.CANCEL)
    assert answers.asked == ["Untitled"]
    assert answers.path.exists() is (answer is Answer.SAVE)


def test_a_window_whose_question_fails_stays_open(window, monkeypatch):
    reported = []
    monkeypatch.setattr(sys, "excepthook", lambda *what: reported.append(what[0]))
    monkeypatch.setattr(window.files, "may_leave", lambda: 1 / 0)
    event = QCloseEvent()
    window.closeEvent(event)
    assert not event.isAccepted()
    assert reported == [ZeroDivisionError]


def test_a_dropped_file_opens(qtbot, window, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("0,0\n10,0\n10,10\n")
    with qtbot.waitSignal(window.files.opened):
        assert dropped(window, path)
    assert len(window.session.document.curves[0].points) == 3
    assert window.windowTitle() == "points[*] - Ninepoint"
    assert window.status.hint.text() == "Opened points.csv."


def test_a_bad_dropped_file_leaves_the_drawing(qtbot, window, answers, tmp_path):
    path = tmp_path / "picture.csv"
    path.write_bytes(b"\x89PNG\x00\x01")
    before = window.session.document
    dropped(window, path)
    qtbot.waitUntil(lambda: bool(answers.shown))
    assert answers.shown[0][1].startswith("picture.csv")
    assert window.session.document is before


def test_text_is_not_taken_for_a_file(window):
    data = QMimeData()
    data.setText("hello")
    event = QDragEnterEvent(
        QPoint(300, 300), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, NO_KEYS
    )
    QApplication.sendEvent(window, event)
    assert not event.isAccepted()


def test_an_empty_drawing_has_no_size(window):
    window.commands["new"].trigger()
    window.canvas.measure.look()
    assert window.status.size_label.text() == "empty"
    assert window.session.document.curves == ()


def test_the_curve_is_opened_and_closed_in_named_steps(window):
    action = window.commands["closed"]
    action.trigger()
    assert not window.session.document.curves[0].closed
    assert not action.isChecked()
    assert window.session.undo_name == "Open curve"
    action.trigger()
    assert window.session.document.curves[0].closed
    assert window.session.undo_name == "Close curve"


def test_all_selected_curves_are_opened_alike(window):
    session = window.session
    extra = Curve(np.eye(3, 2), closed=False, name="Extra")
    session.edit(session.document.with_curve_added(extra), "Add curve")
    session.select(Selection(frozenset({(0, 0), (1, 0)}), 0))
    window.commands["closed"].trigger()
    assert [curve.closed for curve in session.document.curves] == [False, False]
    assert session.undo_name == "Open 2 curves"


def test_reversing_keeps_the_selected_points(window):
    session = window.session
    session.select(Selection(frozenset({(0, 1)}), 0))
    place = session.document.curves[0].points[1]
    window.commands["reverse"].trigger()
    (point,) = session.selection.points.of_curve(0)
    assert np.array_equal(session.document.curves[0].points[point], place)
    assert np.array_equal(session.document.curves[0].points, READY_POINTS_MM[::-1])
    assert session.undo_name == "Reverse curve"


def test_deleting_the_curve_leaves_the_others(window):
    session = window.session
    session.edit(session.document.with_curve_added(Curve(np.eye(2), name="Extra")), "Add curve")
    session.select(Selection(curve=0))
    window.commands["delete curve"].trigger()
    assert [curve.name for curve in session.document.curves] == ["Extra"]
    window.commands["delete curve"].trigger()
    assert session.document.curves == ()
    assert not window.commands["delete curve"].isEnabled()


def test_polygon_and_grid_are_shown_and_hidden(window):
    for key, read in (
        ("polygon", lambda: window.canvas.show_polygon),
        ("grid", lambda: window.canvas.show_grid),
    ):
        assert window.commands[key].isChecked()
        window.commands[key].trigger()
        assert not read()
        assert not window.commands[key].isChecked()
        window.commands[key].trigger()
        assert read()


def test_the_derivative_is_shown_and_hidden(window):
    plot = window.docks.basis_plot
    assert not window.commands["slope"].isChecked()
    window.commands["slope"].trigger()
    assert window.commands["slope"].isChecked()
    assert len(plot.slope.t)
    window.commands["slope"].trigger()
    assert not len(plot.slope.t)


def test_zoom_and_cursor_are_shown(qtbot, window):
    window.canvas.zoom_real_size()
    assert window.status.zoom_label.text() == "100 %"
    QTest.mouseMove(window.canvas, window.canvas.rect().center())
    window.canvas.cursor_moved.emit((12.345, -6.0))
    shown = "12.35, \N{MINUS SIGN}6.00"
    qtbot.waitUntil(lambda: window.status.cursor_label.text() == shown)
    window.canvas.cursor_moved.emit(None)
    assert window.status.cursor_label.text() == ""


def test_panels_come_back_by_reset(window):
    before = window.saveState()
    window.docks.basis.close()
    window.docks.scheme.setFloating(True)
    window.tool_bar.hide()
    window.commands["reset layout"].trigger()
    assert not any(dock.isFloating() for dock in window.docks.all)
    hidden = [dock.windowTitle() for dock in window.docks.all if not dock.isVisible()]
    assert hidden == ["Report", "Map"]
    assert window.tool_bar.isVisible()
    assert len(window.saveState()) == len(before)


def test_place_and_panels_are_remembered(qtbot, tmp_path, answers):
    settings = Settings(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))
    free = QGuiApplication.primaryScreen().availableGeometry()
    place = QRect(free.topLeft() + QPoint(30, 40), free.size() * 0.9)
    first = MainWindow(settings=settings, dialogs=answers)
    qtbot.addWidget(first)
    first.setGeometry(place)
    first.show()
    first.docks.step.hide()
    first.close()
    second = MainWindow(settings=settings, dialogs=answers)
    qtbot.addWidget(second)
    second.restore()
    assert second.geometry() == place
    second.show()
    assert not second.docks.step.isVisible()
    assert second.docks.basis.isVisible()


def test_a_place_off_all_screens_is_not_taken(qtbot, answers):
    settings = Settings()
    settings.window_rect = QRect(90_000, 90_000, 800, 600)
    window = MainWindow(settings=settings, dialogs=answers)
    qtbot.addWidget(window)
    window.restore()
    assert QGuiApplication.primaryScreen().geometry().intersects(window.geometry())


@pytest.mark.parametrize("colours", [DARK, LIGHT])
def test_another_colour_scheme_reaches_everything(window, colours):
    QApplication.setPalette(window_palette(DARK if colours is LIGHT else LIGHT))
    QApplication.setPalette(window_palette(colours))
    QApplication.processEvents()
    picture = window.grab().toImage()

    def ground(widget, x, y):
        return picture.pixelColor(widget.mapTo(window, QPoint(x, y))).name()

    plot = window.docks.basis_plot
    assert ground(plot, plot.width() - 3, plot.height() - 3) == colours.plot_background
    assert plot.curve.pen.color().name() == colours.plot_curve
    assert window.commands["fit"].icon().pixmap(20, 20).toImage().pixelColor(3, 3).alpha() > 0


def test_every_control_has_a_name(window):
    window.show_report()
    window.show_map()
    for kind in (QAbstractButton, QAbstractItemView, QAbstractSlider, QLineEdit):
        for control in window.findChildren(kind):
            if control.window() is not window or control.objectName().startswith("qt_"):
                continue  # popups and parts that Qt makes and names itself
            if isinstance(control, QScrollBar | QHeaderView):
                continue
            words = getattr(control, "text", str)()
            assert control.accessibleName() or words or control.toolTip(), control


def test_the_keyboard_reaches_every_control(window):
    reached, widget = set(), window.canvas
    for _ in range(200):
        widget = widget.nextInFocusChain()
        if widget.focusPolicy() & Qt.FocusPolicy.TabFocus:
            reached.add(widget)
    controls = [window.scheme.preset, *window.scheme.tracks.values(), window.points.table]
    controls += [*window.scheme.fields.values(), window.curves.list, window.canvas]
    assert reached.issuperset(controls)


def test_the_keyboard_reaches_the_lists_after_the_scheme(window):
    order, widget = [], window.canvas
    for _ in range(200):
        order.append(widget)
        widget = widget.nextInFocusChain()
    told = [
        window.scheme.preset,
        *window.scheme.neighbours.values(),
        window.curves.list,
        window.points.table,
        window.status.proof,
    ]
    assert sorted(told, key=order.index) == told


def test_the_recent_menu_lists_files_and_clears(window, answers, tmp_path):
    answers.path = tmp_path / "wing & tail.ninepoint"
    window.commands["save"].trigger()
    (recent,) = [
        action.menu()
        for action in window.menuBar().actions()[0].menu().actions()
        if action.text() == "Open &recent"
    ]
    assert recent.isEnabled()
    recent.aboutToShow.emit()
    first, *_, last = recent.actions()
    assert first.text() == "&1 wing && tail.ninepoint"
    change(window)
    answers.answer = Answer.DISCARD
    first.trigger()
    assert window.session.document.parameters == PRESETS["Calm"]
    last.trigger()
    assert not recent.isEnabled()


def test_an_unforeseen_error_is_shown_once(qtbot, window, capsys, monkeypatch):
    failures = Failures(window)
    monkeypatch.setattr(sys, "excepthook", failures.report)
    before = window.session.document
    for _ in range(2):
        try:
            [][0]
        except IndexError:
            sys.excepthook(*sys.exc_info())
    qtbot.waitUntil(lambda: failures.box is not None)
    assert failures.box.text() == SENTENCE
    assert "IndexError" in failures.box.detailedText()
    assert capsys.readouterr().err.count("IndexError") == 2
    (copy,) = [button for button in failures.box.buttons() if "Copy" in button.text()]
    copy.click()
    assert failures.box.isVisible()
    assert "IndexError" in QGuiApplication.clipboard().text()
    failures.box.close()
    qtbot.waitUntil(lambda: failures.box is None)
    assert window.session.document is before


def test_an_error_box_does_not_stop_the_program(qtbot):
    window = MainWindow()
    qtbot.addWidget(window)
    window.show()
    Dialogs(window).error("Cannot open", "wing.csv: the file is empty.")
    (box,) = window.findChildren(QMessageBox)
    assert box.text() == "wing.csv: the file is empty."
    box.close()


@pytest.mark.parametrize(("theme", "colours"), [("light", LIGHT), ("dark", DARK)])
def test_a_screenshot_shows_the_whole_window(qtbot, tmp_path, theme, colours):
    hook = sys.excepthook
    picture = tmp_path / "window.png"
    assert run(None, picture, (1000, 640), theme) == 0
    image = QImage(str(picture))
    ratio = image.width() / 1000
    assert (image.width(), image.height()) == (1000 * ratio, 640 * ratio)
    seen = {image.pixelColor(x, y).name() for x in range(0, 1000, 2) for y in range(0, 640, 2)}
    assert {colours.background, colours.plot_fill, colours.plot_curve} <= seen
    assert sys.excepthook is hook
    assert not list(tmp_path.glob("*.conf"))


def test_a_screenshot_of_a_file(qtbot, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("0,0\n10,0\n10,10\n")
    assert run(points, tmp_path / "window.png", None, "light") == 0
    assert (tmp_path / "window.png").stat().st_size > 10_000


def test_a_screenshot_of_a_drawing_of_another_program(qtbot, tmp_path):
    path = tmp_path / "square.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
        '<circle cx="30" cy="30" r="20"/></svg>'
    )
    assert run(path, tmp_path / "window.png", None, "light") == 0
    assert (tmp_path / "window.png").stat().st_size > 10_000


def test_the_keys_of_the_edit_menu_copy_and_paste(qtbot, window):
    window.canvas.setFocus()
    ctrl = Qt.KeyboardModifier.ControlModifier
    for key in (Qt.Key.Key_A, Qt.Key.Key_C, Qt.Key.Key_V, Qt.Key.Key_D, Qt.Key.Key_X):
        QTest.keyClick(window.canvas, key, ctrl)
    assert [curve.name for curve in window.session.document.curves] == ["Curve 1", "Curve 2"]
    assert window.session.undo_name == "Cut curve"
    assert "Duplicated" in window.status.hint.text()


def test_in_the_table_the_same_keys_copy_numbers(qtbot, window):
    window.points.table.selectRow(2)
    window.points.table.setFocus()
    QTest.keyClick(window.points.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == "110.0\t10.0\n"
    assert window.status.hint.text() == "Copied 1 point as numbers."


def test_on_another_screen_the_icons_are_drawn_for_its_pixels(qtbot, window, monkeypatch):
    ratio = 2.0 * window.devicePixelRatioF()
    monkeypatch.setattr(window, "devicePixelRatioF", lambda: ratio)
    window.repaint()
    qtbot.waitUntil(lambda: window.commands.ratio == ratio)
    wide = [size.width() for size in window.commands["select"].icon().availableSizes()]
    assert max(wide) >= 20 * ratio


def test_a_screenshot_that_cannot_be_made_is_refused(qtbot, tmp_path):
    with pytest.raises(NinepointError, match=r"missing\.csv"):
        run(tmp_path / "missing.csv", tmp_path / "window.png")
    with pytest.raises(NinepointError, match=r"window\.png"):
        run(None, tmp_path / "no folder" / "window.png")


def test_a_drawing_that_runs_away_has_no_crash(window):
    far = Document((Curve(np.array([[-1e9, -1e9], [1e9, 1e9], [0, 1e9]])),))
    window.session.replace(far, None)
    window.canvas.fit_all()
    window.grab()
    window.canvas.measure.look()
    assert "mm" in window.status.size_label.text()


def known(qtbot, window):
    qtbot.waitUntil(lambda: window.analysis.is_at_rest and window.analysis.finding is not None)


def test_badge_status_and_canvas_tell_what_is_proven(qtbot, window):
    known(qtbot, window)
    proof = "C\u00b3 proven, not C\u2074"
    assert window.scheme.badge.sentence == f"{proof} \u00b7 H\u00f6lder 3.82747\u2026"
    assert window.status.proof.text() == proof
    assert window.canvas.notice == ""
    type_into(window.scheme.fields["alpha"], "10")
    known(qtbot, window)
    assert window.status.proof.text() == "does not converge, proven"
    assert "does not converge, proven" in window.scheme.badge.sentence
    assert "drawn at a finite level" in window.canvas.notice
    qtbot.waitUntil(lambda: window.status.size_label.text() == "no finite size")
    window.commands["undo"].trigger()
    known(qtbot, window)
    assert window.canvas.notice == ""
    qtbot.waitUntil(lambda: window.status.size_label.text() == "99.27 \u00d7 58.35 mm")


def type_into(field, text):
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


@pytest.mark.parametrize(
    "parameters",
    [Parameters(100, -100, 100), Parameters(10, 0, 0), Parameters(1, 0, -1, "mirrored")],
)
def test_a_divergent_scheme_is_drawn_without_overflow(qtbot, window, parameters):
    document = window.session.document
    window.session.edit(document.with_parameters(parameters), "Set")
    known(qtbot, window)
    (drawn,) = window.canvas.scene.curves
    assert np.isfinite(drawn.vertices_px).all()
    assert len(drawn.vertices_px) == 8 * 2**COARSE_LEVEL + 1
    assert window.docks.step_plot.sentence == "overshoot and undershoot: no bound proven"
    colours = palette_of(window)
    content = window.canvas.grab().toImage()
    inks = {content.pixelColor(x, y).name() for x in range(200, 700) for y in range(44, 76)}
    assert colours.warning in inks


def test_the_badge_follows_while_a_slider_is_held(qtbot, window):
    known(qtbot, window)
    track = window.scheme.tracks["alpha"]
    middle = QPoint(round(track.x_of(track.value())), track.height() // 2)
    QTest.mousePress(track, Qt.MouseButton.LeftButton, pos=middle)
    QTest.mouseMove(track, middle + QPoint(40, 0))
    with qtbot.waitSignal(window.analysis.changed) as changed:
        assert track.is_held
    assert changed.args[0].parameters is window.session.document.parameters
    QTest.mouseRelease(track, Qt.MouseButton.LeftButton, pos=middle + QPoint(40, 0))


def test_the_report_opens_by_a_key_and_is_made_then(qtbot, window):
    known(qtbot, window)
    assert window.analysis.finding.report is None
    assert not window.docks.report.isVisible()
    QTest.keyClick(window.canvas, Qt.Key.Key_R, Qt.KeyboardModifier.ControlModifier)
    assert window.report.page.hasFocus()
    qtbot.waitUntil(lambda: window.report.report is not None)
    assert window.report.report.parameters == PRESETS["Calm"]
    change(window, "Tight")
    qtbot.waitUntil(lambda: window.report.report.parameters == PRESETS["Tight"])
    window.docks.report.close()
    change(window, "Lean")
    known(qtbot, window)
    assert window.analysis.finding.report is None


def test_a_click_on_the_status_opens_the_report(qtbot, window):
    known(qtbot, window)
    QTest.mouseClick(window.status.proof, Qt.MouseButton.LeftButton)
    assert window.docks.report.isVisible()


def test_nothing_is_cut_in_the_scheme_panel(qtbot, window):
    known(qtbot, window)
    assert window.scheme.height() >= window.scheme.sizeHint().height()
    for finding in ("Lagrange", "B-spline"):
        change(window, finding)
        known(qtbot, window)
        badge = window.scheme.badge
        assert badge.sizeHint().width() <= badge.width()
        assert badge.sizeHint().height() <= badge.height()


def test_no_work_outlives_the_window(qtbot, window, answers, monkeypatch):
    begun, ended = Event(), []

    def endless(mask, effort=Effort.QUICK, cancelled=None):
        if effort is Effort.FULL:
            begun.set()
            while not cancelled():
                pass
            ended.append(mask)
        return smoothness(mask)

    monkeypatch.setattr(analysis, "smoothness", endless)
    change(window)
    qtbot.waitUntil(begun.is_set)
    answers.answer = Answer.DISCARD
    assert window.close()
    assert ended
    assert window.analysis.is_at_rest


def test_a_key_sheet_called_with_shift_leaves_the_plain_hint(qtbot, window):
    window.canvas.setFocus()
    QTest.mouseMove(window.canvas, window.canvas.rect().center())
    hint = window.canvas.hint
    QTest.keyPress(window.canvas, Qt.Key.Key_Shift, Qt.KeyboardModifier.ShiftModifier)
    window.commands["keys"].trigger()
    qtbot.waitUntil(lambda: not window.canvas.hasFocus())
    qtbot.waitUntil(lambda: window.status.hint.text() == hint)
    QApplication.activeModalWidget().close()
