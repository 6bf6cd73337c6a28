"""The window as a place where things are dropped; what becomes of them is `app.drops`'s."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent
from PySide6.QtWidgets import QMainWindow, QWidget

from app.guard import guarded

if TYPE_CHECKING:
    from app.drops import Drops


class Landing(QMainWindow):
    """A main window that takes what is dropped on it.

    A filter of its events would see all the others too, two in each frame of a drag.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAcceptDrops(True)

    @cached_property
    def drops(self) -> Drops:
        """What takes things that are dragged over the window; made for the first of them."""
        raise NotImplementedError

    @guarded
    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Say what a drop would do."""
        self.drops.enter(event)

    @guarded
    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        """Go on to take it, or not."""
        self.drops.move(event)

    @guarded
    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        """Say nothing any more."""
        self.drops.leave()

    @guarded
    def dropEvent(self, event: QDropEvent) -> None:
        """Open, import or paste what is dropped."""
        self.drops.drop(event)
