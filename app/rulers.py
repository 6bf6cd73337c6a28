"""The rulers along the sheet, and the marks on them that follow the mouse."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QPalette, QPixmap
from PySide6.QtWidgets import QLabel, QWidget

from app.style import SIZES, color

FRAME_PX: Final = 1
"""Edge of the sheet that the rulers leave free, for the frame of what has the focus."""


class Rulers:
    """Two strips of the background in front of the sheet, each with a mark.

    They are widgets that Qt paints by itself. Marks painted by the sheet would make what it has to
    paint, for each move of the mouse, reach from both rulers to the drawing.

    Parameters
    ----------
    sheet
        The widget along whose upper and left edge they lie.
    """

    def __init__(self, sheet: QWidget) -> None:
        self._paper: QPixmap | None = None
        self._strips = QLabel(sheet), QLabel(sheet)
        self._marks = QWidget(self._strips[0]), QWidget(self._strips[1])
        for widget in (*self._strips, *self._marks):
            widget.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        for strip, mark in zip(self._strips, self._marks, strict=True):
            strip.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
            mark.setAutoFillBackground(True)
            mark.hide()

    def show_paper(self, paper: QPixmap, accent: str) -> None:
        """Show the strips of a background, and marks of a colour.

        Parameters
        ----------
        paper
            Picture of the whole sheet; the same one is never shown with other ink on it.
        accent
            Colour of the marks.
        """
        if paper is self._paper:
            return
        self._paper = paper
        ratio = paper.devicePixelRatioF()
        wide, high = round(paper.width() / ratio), round(paper.height() / ratio)
        upper = QRect(FRAME_PX, FRAME_PX, wide - 2 * FRAME_PX, SIZES.ruler - FRAME_PX)
        left = QRect(FRAME_PX, SIZES.ruler, SIZES.ruler - FRAME_PX, high - SIZES.ruler - FRAME_PX)
        colours = QPalette()
        colours.setColor(QPalette.ColorRole.Window, color(accent))
        for strip, mark, place in zip(self._strips, self._marks, (upper, left), strict=True):
            strip.setGeometry(place)
            corner, size = QPointF(place.topLeft()) * ratio, QSizeF(place.size()) * ratio
            strip.setPixmap(paper.copy(QRectF(corner, size).toRect()))
            mark.setPalette(colours)

    def mark(self, position: QPointF | None) -> None:
        """Mark a place of the sheet, or none."""
        for axis, mark in enumerate(self._marks):
            place = -1 if position is None else int((position.x(), position.y())[axis])
            if place < SIZES.ruler:
                mark.hide()
                continue
            if axis == 0:
                mark.setGeometry(place - FRAME_PX, 0, 1, SIZES.ruler - FRAME_PX)
            else:
                mark.setGeometry(0, place - SIZES.ruler, SIZES.ruler - FRAME_PX, 1)
            mark.show()
