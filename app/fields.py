"""Number fields: what is typed is read exactly, and nonsense is refused in a sentence."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Final

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLineEdit, QWidget

from app.guard import guarded
from app.style import color, palette_of
from core.errors import ParameterError
from core.family import exact

StandardKey = QKeySequence.StandardKey

MAX_DECIMALS: Final = 6
"""Longest decimal number that is shown as such; what does not end by then is a fraction."""

FRAME_WIDTH_PX: Final = 2.0
"""Frame around a field whose text is refused."""


def typed_number(text: str, name: str) -> Fraction:
    """Exact number that a user typed: 0.25, 1/4, 25.4/2, and 0,25 where the comma is decimal.

    Raises
    ------
    ParameterError
        If it is no number; the message starts with ``name``.
    """
    return exact(text.replace(",", ".") if "." not in text else text, name)


def shown_number(number: Fraction) -> str:
    """Text of an exact number that `typed_number` reads back exactly.

    A decimal number if it has at most `MAX_DECIMALS` decimals, else a fraction; with a true minus
    sign.
    """
    scaled = number * 10**MAX_DECIMALS
    if scaled.denominator == 1:
        text = f"{float(number):.{MAX_DECIMALS}f}".rstrip("0").rstrip(".")
    else:
        text = str(number)
    return text.replace("-", "\N{MINUS SIGN}")


class NumberField(QLineEdit):
    """A line that holds one exact number.

    Enter, or leaving the field, hands a changed number over by `entered`; Escape brings back the
    number in force. Text that is refused stays, in a frame, until it is mended or Escape is
    pressed, and leaves the number in force as it is.

    Parameters
    ----------
    name
        What the number is called in messages and to screen readers.
    check
        Called with each number typed; raises `ParameterError` to refuse it.

    Signals
    -------
    entered(number)
        The user typed another number, a `Fraction`.
    refused(sentence)
        The text is no admitted number; the sentence says why.
    """

    entered = Signal(object)
    refused = Signal(str)

    def __init__(
        self,
        name: str,
        check: Callable[[Fraction], object] | None = None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._name = name
        self._check = check
        self._number = Fraction(0)
        self._fault = ""
        self._explanation = ""
        self.setAccessibleName(name)
        self.editingFinished.connect(self._take)
        self.textEdited.connect(lambda: self._mark(""))
        self.set_number(Fraction(0))

    @property
    def number(self) -> Fraction:
        """The number in force."""
        return self._number

    @property
    def fault(self) -> str:
        """Why the present text is refused; empty if it is not."""
        return self._fault

    def set_number(self, number: Fraction) -> None:
        """Show a number that comes from elsewhere; emits nothing."""
        self._number = number
        self._mark("")
        text = shown_number(number)
        if text != self.text():
            self.setText(text)
            self.setCursorPosition(0)

    def set_explanation(self, text: str) -> None:
        """Set the tooltip shown while nothing is wrong."""
        self._explanation = text
        self._mark(self._fault)

    def _take(self) -> None:
        if self.text() == shown_number(self._number):
            self._mark("")
            return
        try:
            number = typed_number(self.text(), self._name)
            if self._check is not None:
                self._check(number)
        except ParameterError as error:
            self._mark(str(error))
            self.refused.emit(str(error))
            return
        changed = number != self._number
        self.set_number(number)
        if changed:
            self.entered.emit(number)

    def _mark(self, fault: str) -> None:
        words = fault or self._explanation
        if words != self.toolTip():
            self.setToolTip(words)
            self.setAccessibleDescription(words)
        if fault != self._fault:
            self._fault = fault
            self.update()

    @guarded
    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape restores the number in force."""
        if event.key() == Qt.Key.Key_Escape and (self._fault or self._is_edited()):
            self.set_number(self._number)
            self.selectAll()
            event.accept()
            return
        super().keyPressEvent(event)
        if self._fault and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.accept()  # no dialog may take it for its default button

    @guarded
    def event(self, event: QEvent) -> bool:
        """Leave undo and redo to the window, unless the text is being edited."""
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and not self._is_edited()
            and any(event.matches(key) for key in (StandardKey.Undo, StandardKey.Redo))
        ):
            event.ignore()
            return True
        return super().event(event)

    @guarded
    def focusInEvent(self, event: QFocusEvent) -> None:
        """Select all of the number when it is reached by Tab, so that typing replaces it."""
        super().focusInEvent(event)
        if event.reason() in (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason):
            self.selectAll()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the field, and a frame around a refused text."""
        super().paintEvent(event)
        if not self._fault:
            return
        inset = FRAME_WIDTH_PX / 2
        frame = self.rect().toRectF().adjusted(inset, inset, -inset, -inset)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(color(palette_of(self).warning), FRAME_WIDTH_PX))
            painter.drawRoundedRect(frame, FRAME_WIDTH_PX, FRAME_WIDTH_PX)

    def _is_edited(self) -> bool:
        return self.text() != shown_number(self._number)
