"""The badge: what is proven of the scheme, in words, with a mark that does not need its colour."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette, QPen, QPolygonF
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from app.guard import guarded
from app.style import color, palette_of

if TYPE_CHECKING:
    from app.analysis import Finding

MARK_PX: Final = 16
"""Side of the mark."""

UNKNOWN: Final = "Looking for proofs \N{HORIZONTAL ELLIPSIS}"
"""What stands on the badge before the first finding."""


class Badge(QWidget):
    """Class and Hölder interval of a scheme, or a plain warning where there is no limit.

    A tick marks what converges, a triangle what does not, or is not proven to.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._warns = False
        self.mark = Mark()
        self.statement = QLabel(UNKNOWN)
        self.detail = QLabel()
        font = self.statement.font()
        font.setBold(True)
        self.statement.setFont(font)
        self.detail.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        for label in (self.statement, self.detail):
            # A long statement is cut off rather than making the panel wider; the tip has it all.
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setHorizontalSpacing(8)
        layout.setVerticalSpacing(2)
        layout.setColumnStretch(1, 1)
        layout.addWidget(self.mark, 0, 0)
        layout.addWidget(self.statement, 0, 1)
        layout.addWidget(self.detail, 1, 1)
        self.setAccessibleName("What is proven of the scheme")
        self.setAccessibleDescription(UNKNOWN)

    @property
    def sentence(self) -> str:
        """All words of the badge in one line."""
        return self.accessibleDescription()

    def show_finding(self, finding: Finding) -> None:
        """Tell of another finding."""
        self._warns = not finding.is_convergent
        detail = finding.exponent if finding.is_convergent else finding.notice
        self.statement.setText(finding.statement.capitalize() if self._warns else finding.statement)
        self.detail.setText("Drawn at a finite level" if self._warns else detail)
        self.mark.show_warning(self._warns)
        words = f"{finding.statement} \N{MIDDLE DOT} {detail}"
        if words != self.accessibleDescription():
            self.setAccessibleDescription(words)
            self.setToolTip(f"{words}\nCtrl+R shows the whole report.")
        self._colour()

    def _colour(self) -> None:
        palette = self.statement.palette()
        words = QColor(palette_of(self).warning if self._warns else palette_of(self).text)
        if palette.color(QPalette.ColorRole.WindowText) != words:
            palette.setColor(QPalette.ColorRole.WindowText, words)
            self.statement.setPalette(palette)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "detail"):
            self._colour()


class Mark(QWidget):
    """A tick in a disc, or a triangle with an exclamation mark."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.warns = False
        self.setFixedSize(QSize(MARK_PX, MARK_PX))

    def show_warning(self, warns: bool) -> None:
        """Show the triangle, or the tick."""
        if warns != self.warns:
            self.warns = warns
            self.update()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the mark in the colours of the program."""
        colours = palette_of(self)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            line = QPen(color(colours.background), 1.8)
            line.setCapStyle(Qt.PenCapStyle.RoundCap)
            line.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
            painter.setPen(Qt.PenStyle.NoPen)
            if self.warns:
                ground = QPen(color(colours.warning), 2.0)
                ground.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
                painter.setPen(ground)
                painter.setBrush(color(colours.warning))
                painter.drawPolygon(QPolygonF([QPointF(8, 2), QPointF(15, 14), QPointF(1, 14)]))
                painter.setPen(line)
                painter.drawLine(QPointF(8, 6), QPointF(8, 9.4))
                painter.drawPoint(QPointF(8, 12.2))
            else:
                painter.setBrush(color(colours.accent))
                painter.drawEllipse(QRectF(0.5, 0.5, 15, 15))
                painter.setPen(line)
                tick = [QPointF(4.6, 8.3), QPointF(7.1, 10.8), QPointF(11.6, 5.6)]
                painter.drawPolyline(QPolygonF(tick))
