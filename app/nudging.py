"""Arrow keys: a burst of nudges is one step of undo."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QObject, QTimer

from app.edits import counted, moved
from app.point_set import PointSet
from app.session import Session
from core.document import Document

BURST_MS: Final = 600
"""A nudge that comes within this time of the last one belongs to the same step of undo."""


class Nudging(QObject):
    """Moves the selected points by small steps, folding a burst of them into one gesture.

    Parameters
    ----------
    session
        What is edited.
    parent
        Owner of the timer.
    """

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._origin: Document | None = None
        self._points = PointSet()
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(BURST_MS)
        self._timer.timeout.connect(self.settle)

    @property
    def is_open(self) -> bool:
        """Whether a burst is under way: the next nudge of the same points joins it."""
        session = self._session
        return (
            self._origin is not None and session.in_gesture and session.origin is self._origin
        )

    def nudge(self, dx_mm: float, dy_mm: float) -> None:
        """Move the selected points; nothing happens without any, or within another gesture."""
        session = self._session
        points = session.selection.points
        if not points or (session.in_gesture and not self.is_open):
            return
        if not self.is_open or points != self._points:
            self.settle()
            session.begin(counted("Move", len(points)))
            self._origin, self._points = session.origin, points
        session.adjust(moved(session.document, points, (dx_mm, dy_mm)))
        self._timer.start()

    def settle(self) -> None:
        """End the burst, so that the next edit is a step of its own."""
        self._timer.stop()
        if self.is_open:
            self._session.commit()
        self._origin = None
