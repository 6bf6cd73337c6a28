"""A field for a colour: typed as #rrggbb, or chosen from Qt's dialog by the button beside it."""

from __future__ import annotations

import re
from typing import Final

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QColorDialog, QHBoxLayout, QLineEdit, QToolButton, QWidget

from app.guard import guarded
from app.style import color, palette_of

SWATCH_PX: Final = 16


class ColourField(QWidget):
    """A line for a colour and a button that shows it.

    Signals
    -------
    entered(colour)
        The user has given another colour, "#rrggbb".
    refused(sentence)
        The text is no colour.
    """

    entered = Signal(str)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colour = "#000000"
        self._fault = ""
        self.line = QLineEdit()
        self.line.setMaxLength(32)
        self.button = QToolButton()
        self.button.setIconSize(QSize(SWATCH_PX, SWATCH_PX))
        self.button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.button.setAutoRaise(False)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(6)
        layout.addWidget(self.line, 1)
        layout.addWidget(self.button)
        self.setFocusProxy(self.line)
        self.line.editingFinished.connect(self._take)
        self.button.clicked.connect(self._choose)
        self.setAccessibleName("Colour")
        self.set_colour(self._colour)

    @property
    def colour(self) -> str:
        """The colour in force."""
        return self._colour

    @property
    def fault(self) -> str:
        """Why the present text is refused; empty if it is not."""
        return self._fault

    def set_colour(self, colour: str) -> None:
        """Show a colour that comes from elsewhere; emits nothing."""
        self._colour, self._fault = colour, ""
        self.line.setText(colour)
        self.button.setIcon(QIcon(self._swatch()))

    @guarded
    def setAccessibleName(self, name: str) -> None:
        super().setAccessibleName(name)
        self.line.setAccessibleName(name)
        self.button.setAccessibleName(f"Choose {name.lower()}")

    @guarded
    def setToolTip(self, tip: str) -> None:
        super().setToolTip(tip)
        self.line.setToolTip(tip)
        self.button.setToolTip("Choose from a palette")

    def _take(self) -> None:
        text = self.line.text().strip().lower()
        text = text if text.startswith("#") else f"#{text}"
        if re.fullmatch("#[0-9a-f]{3}", text):
            text = "#" + "".join(2 * digit for digit in text[1:])
        if re.fullmatch("#[0-9a-f]{6}", text) is None:
            self._fault = f"A colour is written like #1e90ff, not {self.line.text()!r}."
            self.refused.emit(self._fault)
            return
        changed = text != self._colour or bool(self._fault)
        self.set_colour(text)
        if changed:
            self.entered.emit(text)

    def _choose(self) -> None:
        dialog = QColorDialog(QColor(self._colour), self)
        dialog.setWindowTitle("Colour of the lines")
        dialog.colorSelected.connect(self._show_chosen)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _show_chosen(self, colour: QColor) -> None:
        if colour.name() != self._colour or self._fault:
            self.set_colour(colour.name())
            self.entered.emit(self._colour)

    def _swatch(self) -> QPixmap:
        ratio = self.devicePixelRatioF()
        picture = QPixmap(QSize(SWATCH_PX, SWATCH_PX) * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        with QPainter(picture) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(color(palette_of(self).axis), 1.0))
            painter.setBrush(QColor(self._colour))
            painter.drawRoundedRect(QRectF(0.5, 0.5, SWATCH_PX - 1, SWATCH_PX - 1), 3, 3)
        return picture
