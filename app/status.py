"""The status bar: what the tool would do, how large the drawing is, the zoom, the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar, QToolButton, QWidget

from app.guard import guarded
from app.style import palette_of

if TYPE_CHECKING:
    from app.analysis import Finding
    from app.measure import Size

MESSAGE_MS: Final = 8_000
"""How long a sentence such as "Saved wing.ninepoint." covers the hint: time to read it twice."""

MM_PER_INCH: Final = 25.4
"""What a screen's dots per inch are counted by."""

UNKNOWN: Final = "\N{HORIZONTAL ELLIPSIS}"
"""What stands for the class of the scheme before the first finding."""

FIGURE_MARGIN_PX: Final = 12
"""Air on both sides of a figure's widest text."""


class StatusBar(QStatusBar):
    """Hint, size, zoom and cursor; a sentence takes the place of the hint for a while."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._warns = False
        self._size: Size | None = None
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

    def _figure(self, name: str, widest: str) -> Figure:
        figure = Figure(widest)
        figure.setAccessibleName(name)
        figure.setToolTip(name)
        figure.setFixedHeight(self.proof.sizeHint().height())  # on one line with its words
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
        if self.size_label.text():
            self.show_size(self._size)

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

    def show_size(self, size: Size | None) -> None:
        """Show how large the drawing is, or that there is nothing to be measured."""
        self._size = size
        if self._warns:
            words = "no finite size"
        elif size is None:
            words = "empty"
        elif not size.is_proven:
            words = "no proven size"
        else:
            words = f"{size.width:.2f} \u00d7 {size.height:.2f} mm"
            words = words if size.is_sharp else f"about {words}"
        self.size_label.show_words(words)

    def _colour(self) -> None:
        palette = QPalette()
        if self._warns:
            palette.setColor(QPalette.ColorRole.ButtonText, QColor(palette_of(self).warning))
        self.proof.setPalette(palette)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme, and the height of another font."""
        super().changeEvent(event)
        if not hasattr(self, "cursor_label"):
            return
        if event.type() == QEvent.Type.PaletteChange:
            self._colour()
        elif event.type() == QEvent.Type.FontChange:
            for figure in (self.size_label, self.zoom_label, self.cursor_label):
                figure.setFixedHeight(self.proof.sizeHint().height())


class HintWords(QLabel):
    """Words of one line; what does not fit gives way to dots."""

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the words, or as many as there is room for."""
        metrics, indent = self.fontMetrics(), max(self.indent(), 0)
        room = self.width() - indent
        if metrics.horizontalAdvance(self.text()) <= room:
            super().paintEvent(event)
            return
        shown = metrics.elidedText(self.text(), Qt.TextElideMode.ElideRight, room)
        with QPainter(self) as painter:
            painter.drawText(
                self.rect().adjusted(indent, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, shown
            )


class HintLine(QWidget):
    """A line of words that is cut off where there is no room.

    The words have no layout: theirs would be that of the window, which would be computed anew with
    each move of the mouse that changes them (measured: 1.2 ms).
    """

    def __init__(self) -> None:
        super().__init__()
        self.words = HintWords(self)
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
        self.setFixedWidth(self._advance(self._room) + FIGURE_MARGIN_PX)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Make room for another font."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_room"):
            self._fit()
