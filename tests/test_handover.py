"""Waiting for the display while the hand rests."""

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.handover import PAUSE_MS, SHARES_MEMORY, Handover


class Watched:
    """A backing store that notes what is asked of it."""

    def __init__(self, store):
        self._store = store
        self.begun, self.ended = [], 0

    def beginPaint(self, region):  # noqa: N802
        self.begun.append(region.boundingRect())
        self._store.beginPaint(region)

    def endPaint(self):  # noqa: N802
        self.ended += 1
        self._store.endPaint()


class Painted(QWidget):
    def paintEvent(self, event):  # noqa: N802
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), Qt.GlobalColor.darkGreen)


@pytest.fixture
def widget(qtbot, monkeypatch):
    window = QWidget()
    layout = QVBoxLayout(window)
    layout.setContentsMargins(30, 20, 0, 0)
    inner = Painted()
    layout.addWidget(inner)
    qtbot.addWidget(window)
    window.resize(200, 150)
    with qtbot.waitExposed(window):
        window.show()
    inner.store = Watched(inner.backingStore())
    monkeypatch.setattr(inner, "backingStore", lambda: inner.store)
    yield inner
    window.close()


def test_it_asks_once_after_the_last_of_several_paints(qtbot, widget):
    handover = Handover(widget, SHARES_MEMORY)
    before = widget.window().grab().toImage()
    for x in range(5):
        handover.follow(QPoint(x, 7))
    assert not widget.store.begun
    qtbot.waitUntil(lambda: bool(widget.store.begun))
    qtbot.wait(5 * PAUSE_MS)
    # The place of the last paint, as the window sees it.
    assert widget.store.begun == [QRect(34, 27, 1, 1)]
    assert widget.store.ended == 1
    assert widget.window().grab().toImage() == before


def test_a_window_that_is_hidden_meanwhile_is_left_alone(qtbot, widget):
    Handover(widget, SHARES_MEMORY).follow(QPoint(0, 0))
    widget.window().hide()
    qtbot.wait(5 * PAUSE_MS)
    assert not widget.store.begun


def test_where_no_memory_is_shared_nothing_is_asked(qtbot, widget):
    Handover(widget).follow(QPoint(0, 0))
    Handover(widget, "wayland").follow(QPoint(0, 0))
    qtbot.wait(5 * PAUSE_MS)
    assert not widget.store.begun


def test_the_sheet_tells_each_paint(canvas, monkeypatch):
    told = []
    monkeypatch.setattr(canvas._handover, "follow", told.append)
    canvas.repaint(QRect(40, 50, 20, 10))
    assert told == [QPoint(40, 50)]
