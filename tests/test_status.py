from threading import Event, current_thread

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QMainWindow

from app import status as status_module
from app.analysis import Finding
from app.opening import ready_document
from app.session import Session
from app.status import HELD_POINTS, SIZE_LEVEL, StatusBar, drawn_size
from core.continuity import smoothness
from core.document import Curve, Document
from core.errors import NoLimitError
from core.family import PRESETS
from core.formats import export, named
from core.limit import LimitCurve


@pytest.fixture
def bar(qtbot):
    bar = StatusBar(Session(ready_document()))
    qtbot.addWidget(bar)
    yield bar
    bar.stop()


def test_the_size_is_that_of_the_curve_and_not_of_the_polygon(tmp_path):
    report = export(ready_document(), tmp_path / "shape.svg", named("svg").within(1e-4))
    assert drawn_size(ready_document()) == pytest.approx(
        (report.width_mm, report.height_mm), abs=1e-3
    )


def test_the_size_holds_all_curves():
    far = Curve(np.array([[500.0, 0.0], [600.0, 0.0]]), closed=False)
    width, _ = drawn_size(ready_document().with_curve_added(far))
    assert width > 500


@pytest.mark.parametrize("document", [Document(), Document((Curve(np.zeros((0, 2))),))])
def test_nothing_has_no_size(document):
    assert drawn_size(document) is None


def test_a_dot_has_the_size_zero():
    assert drawn_size(Document((Curve(np.array([[3.0, 4.0]])),))) == (0.0, 0.0)


def test_a_scheme_without_a_limit_has_no_size(monkeypatch):
    def refuse(self, level):
        raise NoLimitError("There is no limit.")

    monkeypatch.setattr(LimitCurve, "points", refuse)
    assert drawn_size(ready_document()) is None


def test_long_curves_are_sampled_coarser(monkeypatch):
    levels = []
    original = LimitCurve.points
    monkeypatch.setattr(
        LimitCurve, "points", lambda self, level: (levels.append(level), original(self, level))[1]
    )
    angle = np.linspace(0, 6, 100_000)
    long = Curve(np.stack([np.cos(angle), np.sin(angle)], axis=1))
    drawn_size(Document((long,)))
    drawn_size(ready_document())
    assert levels == [4, SIZE_LEVEL]


def test_the_size_follows_when_the_hand_rests(qtbot, bar):
    before = bar.size_label.text()
    document = bar._session.document
    bar._session.edit(document.with_parameters(PRESETS["Lagrange"]), "Preset Lagrange")
    assert bar.size_label.text() == before
    qtbot.waitUntil(lambda: bar.size_label.text() != before)


@pytest.mark.parametrize(
    ("percent", "text"), [(100, "100 %"), (12.4, "12 %"), (0.123, "0.12 %"), (54321, "54321 %")]
)
def test_the_zoom_is_told_in_percent_of_real_size(bar, percent, text):
    bar.show_zoom(percent / 100 * bar.logicalDpiX() / 25.4)
    assert bar.zoom_label.text() == text


def test_a_long_hint_does_not_widen_the_window(bar):
    before = bar.minimumSizeHint().width()
    bar.hint.setText("word " * 200)
    assert bar.minimumSizeHint().width() == before


def test_a_sentence_takes_the_place_of_the_hint_for_a_while(qtbot):
    bar = StatusBar(Session())
    qtbot.addWidget(bar)
    bar.show_hint("Drag a point")
    bar.tell("Saved wing.ninepoint.")
    assert bar.hint.text() == "Saved wing.ninepoint."
    assert bar.currentMessage() == ""
    bar.show_hint("Drag on empty space")
    assert bar.hint.text() == "Saved wing.ninepoint."
    bar._telling.timeout.emit()
    bar._telling.stop()
    assert bar.hint.text() == "Drag on empty space"
    bar.show_hint("Drag a point")
    assert bar.hint.text() == "Drag a point"


@pytest.fixture
def long_bar(qtbot):
    """Bar of a drawing that is measured in the background."""
    angle = np.linspace(0, 6, HELD_POINTS + 1)
    bar = StatusBar(Session(Document((Curve(np.stack([np.cos(angle), np.sin(angle)], axis=1)),))))
    qtbot.addWidget(bar)
    qtbot.waitUntil(lambda: bar.size_label.text() != "")
    yield bar
    bar.stop()


def test_the_size_of_a_long_drawing_waits_for_the_end_of_a_drag(qtbot, long_bar):
    before, session = long_bar.size_label.text(), long_bar._session
    session.begin("Move point")
    session.adjust(session.document.with_curve(0, session.document.curves[0].moved([9], (50, 0))))
    long_bar._on_rest()
    assert long_bar.size_label.text() == before
    session.commit()
    qtbot.waitUntil(lambda: long_bar.size_label.text() != before)


def test_a_long_drawing_is_measured_outside_the_window_s_thread(qtbot, long_bar, monkeypatch):
    threads = []
    monkeypatch.setattr(
        status_module, "drawn_size", lambda document: threads.append(current_thread())
    )
    long_bar.measure()
    qtbot.waitUntil(lambda: len(threads) == 1)
    assert threads[0] is not current_thread()


def test_a_size_that_is_out_of_date_is_not_shown(qtbot, long_bar, monkeypatch):
    gate, original = Event(), drawn_size

    def slow(document):
        assert gate.wait(10)
        return original(document)

    monkeypatch.setattr(status_module, "drawn_size", slow)
    shown = []
    long_bar._measurer.done.connect(shown.append)
    long_bar.measure()
    session = long_bar._session
    moved = session.document.with_curve(0, session.document.curves[0].moved([9], (50, 0)))
    session.edit(moved, "Move point")
    gate.set()
    qtbot.waitUntil(lambda: len(shown) > 0)
    assert shown == [pytest.approx(original(moved))]


def test_the_bar_keeps_its_height_when_the_class_is_known(qtbot, bar):
    bar.show()
    before = bar.sizeHint().height(), bar.proof.sizeHint().height()
    bar.show_finding(Finding(PRESETS["Calm"], smoothness(PRESETS["Calm"].mask)))
    assert (bar.sizeHint().height(), bar.proof.sizeHint().height()) == before


def test_figures_and_hints_that_change_lay_nothing_out(qtbot):
    window = QMainWindow()
    bar = StatusBar(Session(ready_document()), window)
    window.setStatusBar(bar)
    qtbot.addWidget(window)
    with qtbot.waitExposed(window):
        window.show()
    QApplication.processEvents()
    laid = []

    class Watch(QObject):
        def eventFilter(self, watched, event):  # noqa: N802
            if event.type() == QEvent.Type.LayoutRequest and watched in (window, bar):
                laid.append(watched)
            return False

    watch = Watch()
    QApplication.instance().installEventFilter(watch)
    for step in range(9):
        bar.show_cursor((step, -step))
        bar.show_hint(f"{step} mm \u00b7 Shift keeps an axis")
        bar.show_zoom(1 + step)
        QApplication.processEvents()
    QApplication.instance().removeEventFilter(watch)
    assert laid == []
    assert bar.hint.text().startswith("8 mm")


def test_a_figure_makes_room_for_a_wider_one(bar):
    before = bar.cursor_label.width()
    bar.show_cursor((-123456.0, -123456.0))
    wide = bar.cursor_label.width()
    assert wide > before
    bar.show_cursor((1.0, 1.0))
    assert bar.cursor_label.width() == wide
