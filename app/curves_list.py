"""The list of curves as such: a curve can be dragged out of it into other programs."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QDrag
from PySide6.QtWidgets import QAbstractItemView, QListWidget, QWidget

from app.drawing_data import DrawingData
from app.guard import guarded
from app.session import Session

COPY: Final = Qt.DropAction.CopyAction


class CurvesList(QListWidget):
    """List from which curves are dragged as they are copied; the drawing keeps them.

    Parameters
    ----------
    session
        The document, whose curves are listed in their order.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setDragEnabled(True)
        self.setDragDropMode(QAbstractItemView.DragDropMode.DragOnly)

    def dragged(self) -> DrawingData | None:
        """What a drag offers: the selected curves."""
        rows = sorted(index.row() for index in self.selectedIndexes())
        document = self._session.document
        curves = tuple(document.curves[row] for row in rows if document.curves[row].count)
        return DrawingData(replace(document, curves=curves)) if curves else None

    @guarded
    def startDrag(self, actions: Qt.DropAction) -> None:
        """Drag what is selected to wherever it is dropped."""
        data = self.dragged()
        if data is not None:
            drag = QDrag(self)
            drag.setMimeData(data)
            drag.setPixmap(self.viewport().grab(self.visualRect(self.selectedIndexes()[0])))
            drag.exec(COPY)
