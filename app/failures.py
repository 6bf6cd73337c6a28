"""The last net: an error that nobody foresaw is shown once, and the drawing stays."""

from __future__ import annotations

import sys
import traceback
from types import TracebackType
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtGui import QGuiApplication

if TYPE_CHECKING:
    from PySide6.QtWidgets import QMessageBox, QWidget

SENTENCE = "Something went wrong inside Ninepoint."
ADVICE = (
    "Your drawing is kept as it is. Save it under a new name to be safe, and please report what"
    " you did; the details can be copied."
)


class Failures:
    """Shows unforeseen errors over a window, one box at a time, and logs each to stderr.

    Parameters
    ----------
    window
        The window that the box belongs to.
    """

    def __init__(self, window: QWidget) -> None:
        self._window = window
        self._pending = False
        self.box: QMessageBox | None = None

    def install(self) -> None:
        """Become ``sys.excepthook``, where `app.guard` reports to as well."""
        sys.excepthook = self.report

    def report(
        self,
        kind: type[BaseException],
        error: BaseException,
        trace: TracebackType | None,
    ) -> None:
        """Log an error and show it; the signature is that of ``sys.excepthook``."""
        details = "".join(traceback.format_exception(kind, error, trace))
        if sys.stderr is not None:  # a program started without a console has none
            sys.stderr.write(details)
        if not issubclass(kind, Exception) or self._pending:
            return
        self._pending = True
        # The error may come from the midst of painting, where no window can be opened.
        QTimer.singleShot(0, self._window, lambda: self._show(details))

    def _show(self, details: str) -> None:
        from PySide6.QtWidgets import QMessageBox  # rarely wanted, and slow to make

        box = QMessageBox(
            QMessageBox.Icon.Critical,
            "Ninepoint",
            SENTENCE,
            QMessageBox.StandardButton.Close,
            self._window,
        )
        box.setInformativeText(ADVICE)
        box.setDetailedText(details)
        copy = box.addButton("Copy details", QMessageBox.ButtonRole.ActionRole)
        copy.clicked.disconnect()  # copying leaves the box open
        copy.clicked.connect(lambda: QGuiApplication.clipboard().setText(details))
        box.finished.connect(self._closed)
        self.box = box
        box.open()

    def _closed(self) -> None:
        if self.box is not None:
            self.box.deleteLater()
        self.box = None
        self._pending = False
