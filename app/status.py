"""The status bar: what the tool would do, how large the drawing is, the zoom, the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from PySide6.QtCore import QEvent, QSize, QTimer
from PySide6.QtGui import QColor, QPalette, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar, QToolButton, QWidget

from app.guard import guarded
from app.session import Session
from app.style import palette_of
from app.worker import Worker
from core.document import Document
from core.errors import NinepointError

if TYPE_CHECKING:
    from app.analysis import Finding

MESSAGE_MS: Final = 8_000
"""How long a sentence such as "Saved wing.ninepoint." covers the hint: time to read it twice."""

MM_PER_INCH: Final = 25.4
"""What a screen's dots per inch are counted by."""

SIZE_DELAY_MS: Final = 60
"""The size is computed when the hand rests this long: it must not slow a drag."""

HELD_POINTS: Final = 20_000
"""Number of control points up to which the size is computed at once, also while the hand rests
within a drag; that of longer drawings comes from the background when the drag has ended."""

SIZE_LEVEL: Final = 6
"""Dyadic level of the points that the size is taken from: 64 a span, exact to some 1e-4 of it."""

UNKNOWN: Final = "\N{HORIZONTAL ELLIPSIS}"
"""What stands for the class of the scheme before the first finding."""

FIGURE_MARGIN_PX: Final = 12
"""Air on both sides of a figure's widest text."""

SIZE_POINTS: Final = 2_000_000
"""Largest number of curve points that the size is taken from; long curves are sampled coarser."""


class StatusBar(QStatusBar):
    """Hint, size, zoom and cursor; a sentence takes the place of the hint for a while.

    Parameters
    ----------
    session
        The document whose size is shown.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._warns = False
        line = HintLine()
        self.hint = line.words
        self.hint.setAccessibleName("Hint")
        self.hint.setIndent(8)
        self.addWidget(line, 1)
        self.proof = QToolButton()
        self.proof.setAutoRaise(True)
        self.proof.setText(UNKNOWN)  # a button without words is higher than one with
        self.proof.setAccessibleName("What is proven of the scheme")
        widest = "C\u00b9\u00b9 proven, not C\u00b9\u00b2"
        room = self.proof.fontMetrics().horizontalAdvance(widest)
        self.proof.setMinimumWidth(room + FIGURE_MARGIN_PX)
        self.addPermanentWidget(self.proof)
        self.size_label = self._figure("Size of the drawing", "9999.99 \u00d7 9999.99 mm")
        self.zoom_label = self._figure("Zoom", "100000 %")
        self.cursor_label = self._figure("Cursor", "\N{MINUS SIGN}9999.99, \N{MINUS SIGN}9999.99")
        self._hint = ""
        self._telling = QTimer(self)
        self._telling.setSingleShot(True)
        self._telling.setInterval(MESSAGE_MS)
        self._telling.timeout.connect(lambda: self.hint.setText(self._hint))
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(SIZE_DELAY_MS)
        self._timer.timeout.connect(self._on_rest)
        self._measurer = Worker(self)
        self._measurer.done.connect(self._show_size)
        session.changed.connect(self._on_changed)
        self.measure()

    def _figure(self, name: str, widest: str) -> Figure:
        figure = Figure(widest)
        figure.setAccessibleName(name)
        figure.setToolTip(name)
        self.addPermanentWidget(figure)
        return figure

    def show_hint(self, hint: str) -> None:
        """Show what the tool would do, as soon as no sentence is being told."""
        self._hint = hint
        if not self._telling.isActive():
            self.hint.setText(hint)

    def tell(self, sentence: str) -> None:
        """Show a sentence for a while, in the place of the hint.

        QStatusBar's own messages hide the hint only while the bar is visible: told before the
        window is shown, they would be painted over it.
        """
        self.hint.setText(sentence)
        self._telling.start()

    def show_finding(self, finding: Finding) -> None:
        """Show the class that is proven; a click asks for the report."""
        if self.proof.text() == finding.statement:
            return
        self.proof.setText(finding.statement)
        self.proof.setToolTip("What is proven of the scheme: click for the report (Ctrl+R)")
        self._warns = not finding.is_convergent
        self._colour()
        self._timer.start()

    def show_zoom(self, scale: float) -> None:
        """Show the zoom, given in logical pixels per mm, in percent of real size."""
        percent = 100 * scale * MM_PER_INCH / self.logicalDpiX()
        self.zoom_label.show_words(f"{percent:.0f} %" if percent >= 10 else f"{percent:.2g} %")

    def show_cursor(self, position: tuple[float, float] | None) -> None:
        """Show where the cursor is, in mm, or nothing while it is elsewhere."""
        if position is None:
            self.cursor_label.show_words("")
            return
        x, y = position
        self.cursor_label.show_words(f"{x:.2f}, {y:.2f}".replace("-", "\N{MINUS SIGN}"))

    def measure(self) -> None:
        """Show the size of the drawing as it is now; that of a long one as soon as it is known."""
        document = self._session.document
        if _is_long(document):
            self._measurer.ask(lambda _cancelled, _send: drawn_size(document))
        else:
            self._show_size(drawn_size(document))

    def stop(self) -> None:
        """End what is measured in the background; returns when nothing runs any more."""
        self._timer.stop()
        self._measurer.stop()

    def _show_size(self, size: tuple[float, float] | None) -> None:
        if self._warns:
            self.size_label.show_words("no finite size")
        elif size is None:
            self.size_label.show_words("empty")
        else:
            self.size_label.show_words(f"{size[0]:.2f} \u00d7 {size[1]:.2f} mm")

    def _colour(self) -> None:
        palette = QPalette()
        if self._warns:
            palette.setColor(QPalette.ColorRole.ButtonText, QColor(palette_of(self).warning))
        self.proof.setPalette(palette)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_warns"):
            self._colour()

    def _on_rest(self) -> None:
        """Measure, but not a long drawing while it is held: the hand would feel it."""
        if self._session.in_gesture and _is_long(self._session.document):
            self._timer.start()
        else:
            self.measure()

    def _on_changed(self, old: Document, new: Document) -> None:
        if old.curves is not new.curves or old.parameters is not new.parameters:
            self._measurer.cancel()
            self._timer.start()


class HintLine(QWidget):
    """A line of words that is cut off where there is no room.

    The words have no layout: theirs would be that of the window, which would be computed anew with
    each move of the mouse that changes them (measured: 1.2 ms).
    """

    def __init__(self) -> None:
        super().__init__()
        self.words = QLabel(self)
        self.words.setAutoFillBackground(True)  # so that the bar is not painted
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    @guarded
    def sizeHint(self) -> QSize:
        """As high as a line of text."""
        return QSize(0, self.words.sizeHint().height())

    @guarded
    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the words all the room."""
        self.words.setGeometry(self.rect())


class Figure(QLabel):
    """A figure as wide as the widest one so far, so that it changes without a jump.

    Its size is fixed, because Qt lays a window out anew for all others that change their text.

    Parameters
    ----------
    widest
        The widest text that is expected.
    """

    def __init__(self, widest: str) -> None:
        super().__init__()
        self.setAutoFillBackground(True)  # as above
        self._room = widest
        self._fit()

    def show_words(self, words: str) -> None:
        """Show a text."""
        if words != self.text():
            self.setText(words)
            if self._advance(words) + FIGURE_MARGIN_PX > self.width():
                self._room = words
                self._fit()

    def _advance(self, words: str) -> int:
        return self.fontMetrics().horizontalAdvance(words)

    def _fit(self) -> None:
        room = self._advance(self._room)
        self.setFixedSize(room + FIGURE_MARGIN_PX, self.fontMetrics().height() + 2)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Make room for another font."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_room"):
            self._fit()


def _is_long(document: Document) -> bool:
    return sum(curve.count for curve in document.curves) > HELD_POINTS


def drawn_size(document: Document) -> tuple[float, float] | None:
    """Width and height in mm of the box around all limit curves, or None if nothing is drawn."""
    corners = []
    for curve in document.curves:
        if not curve.count:
            continue
        level = SIZE_LEVEL
        while level > 0 and curve.count << level > SIZE_POINTS:
            level -= 1
        try:
            points = curve.limit(document.parameters).points(level)
        except NinepointError:
            return None
        corners += [points.min(axis=0), points.max(axis=0)]
    if not corners:
        return None
    width, height = np.max(corners, axis=0) - np.min(corners, axis=0)
    return float(width), float(height)
