"""The status bar: what it is told, in words, without laying the window out anew."""

import math

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QMainWindow

from app.analysis import Finding
from app.measure import Size
from app.status import StatusBar
from core.continuity import smoothness
from core.family import PRESETS, Parameters

DIVERGENT = Parameters(10, 0, 0)


@pytest.fixture
def bar(qtbot):
    bar = StatusBar()
    qtbot.addWidget(bar)
    return bar


@pytest.mark.parametrize(
    ("size", "words"),
    [
        (Size(99.274, 58.351, 1e-3), "99.27 \u00d7 58.35 mm"),
        (Size(99.274, 58.351, 0.7), "about 99.27 \u00d7 58.35 mm"),
        (Size(0.0, 0.0, math.inf), "no proven size"),
        (None, "empty"),
    ],
)
def test_the_size_is_told_as_far_as_it_is_proven(bar, size, words):
    bar.show_size(size)
    assert bar.size_label.text() == words


def test_what_does_not_converge_has_no_finite_size(bar):
    bar.show_size(Size(1.0, 2.0, 0.0))
    bar.show_finding(Finding(DIVERGENT, smoothness(DIVERGENT.mask)))
    assert bar.size_label.text() == "no finite size"
    bar.show_finding(Finding(PRESETS["Calm"], smoothness(PRESETS["Calm"].mask)))
    assert bar.size_label.text() == "1.00 \u00d7 2.00 mm"


def test_a_class_that_is_known_before_the_size_leaves_its_place_empty(bar):
    bar.show_finding(Finding(PRESETS["Calm"], smoothness(PRESETS["Calm"].mask)))
    assert bar.size_label.text() == ""


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


def test_a_hint_without_room_ends_in_dots(qtbot, bar):
    """Before the dots the letters stand where they did; from there on there are others."""
    hint = type(bar.hint)("Drag a point, or the curve itself, and so on")
    qtbot.addWidget(hint)
    hint.setIndent(bar.hint.indent())
    whole = hint.fontMetrics().horizontalAdvance(hint.text()) + hint.indent()

    def ink(width):
        """Columns of the picture that have ink."""
        hint.resize(width, 20)
        image = hint.grab().toImage()
        ground = image.pixel(0, 0)
        return [
            x
            for x in range(image.width())
            if any(image.pixel(x, y) != ground for y in range(image.height()))
        ]

    free, cut = ink(whole), ink(whole - 30)
    dots = hint.fontMetrics().horizontalAdvance("\N{HORIZONTAL ELLIPSIS}")
    same = whole - 30 - 3 * dots
    assert [x for x in cut if x < same] == [x for x in free if x < same]
    assert [x for x in cut if x >= same] != [x for x in free if same <= x < whole - 30]


def test_a_sentence_takes_the_place_of_the_hint_for_a_while(qtbot):
    bar = StatusBar()
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
    qtbot.waitUntil(lambda: bar.hint.text() == "Drag a point")


def test_the_bar_keeps_its_height_when_the_class_is_known(qtbot, bar):
    bar.show()
    before = bar.sizeHint().height(), bar.proof.sizeHint().height()
    bar.show_finding(Finding(PRESETS["Calm"], smoothness(PRESETS["Calm"].mask)))
    assert (bar.sizeHint().height(), bar.proof.sizeHint().height()) == before


def test_figures_and_hints_that_change_lay_nothing_out(qtbot):
    window = QMainWindow()
    bar = StatusBar(window)
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
    qtbot.waitUntil(lambda: bar.hint.text().startswith("8 mm"))
    qtbot.waitUntil(lambda: bar.cursor_label.text().startswith("8.00"))
    QApplication.instance().removeEventFilter(watch)
    assert laid == []


def test_a_figure_makes_room_for_a_wider_one(bar):
    before = bar.cursor_label.width()
    bar.show_cursor((-123456.0, -123456.0))
    wide = bar.cursor_label.width()
    assert wide > before
    bar.show_cursor((1.0, 1.0))
    assert bar.cursor_label.width() == wide


def test_all_words_stand_on_one_line_in_any_font(qtbot, bar):
    bar.show()
    for points in (9, 16):
        font = bar.font()
        font.setPointSize(points)
        bar.setFont(font)
        QApplication.processEvents()
        middles = {
            label.mapTo(bar, label.rect().center()).y()
            for label in (bar.proof, bar.hint, bar.size_label, bar.zoom_label, bar.cursor_label)
        }
        assert len(middles) == 1
