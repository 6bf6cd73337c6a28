"""The badge: what is proven of the scheme, in words, with a mark that does not need its colour."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.guard import guarded
from app.style import Palette, color, palette_of

if TYPE_CHECKING:
    from app.analysis import Finding

MARK_PX: Final = 16
"""Side of the mark."""

WORD_GAP_PX: Final = 8
"""Room between the mark and the words."""

LINE_GAP_PX: Final = 2
"""Room between the lines."""

UNKNOWN: Final = "Looking for proofs \N{HORIZONTAL ELLIPSIS}"
"""What stands on the badge before the first finding."""


class Badge(QWidget):
    """Class and Hölder interval of a scheme, or a plain warning where there is no limit.

    A tick marks what converges, a triangle what does not, or is not proven to.

    It paints its words itself: labels would have the whole window laid out anew with each word.

    Attributes
    ----------
    statement, detail
        The two lines. What does not fit is cut off rather than making the panel wider; the tip has
        it all.
    warns
        Whether it warns.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.warns = False
        self.statement, self.detail = UNKNOWN, ""
        # Any breadth will do.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("What is proven of the scheme")
        self.setAccessibleDescription(UNKNOWN)

    @property
    def sentence(self) -> str:
        """All words of the badge in one line."""
        return self.accessibleDescription()

    @property
    def ink(self) -> QColor:
        """Colour of the statement."""
        colours = palette_of(self)
        return color(colours.warning if self.warns else colours.text)

    def show_finding(self, finding: Finding) -> None:
        """Tell of another finding."""
        detail = finding.exponent if finding.is_convergent else finding.notice
        words = f"{finding.statement} \N{MIDDLE DOT} {detail}"
        if words == self.sentence:
            return
        self.warns = not finding.is_convergent
        self.statement = finding.statement.capitalize() if self.warns else finding.statement
        self.detail = "Drawn at a finite level" if self.warns else detail
        self.setAccessibleDescription(words)
        self.setToolTip(f"{words}\nCtrl+R shows the whole report.")
        self.update()

    @guarded
    def sizeHint(self) -> QSize:
        """Both lines, and as broad as they are."""
        (first, _), (second, _) = self._lines()
        width = max(first.horizontalAdvance(self.statement), second.horizontalAdvance(self.detail))
        height = first.height() + LINE_GAP_PX + second.height()
        return QSize(MARK_PX + WORD_GAP_PX + ceil(width), ceil(max(height, MARK_PX)))

    @guarded
    def minimumSizeHint(self) -> QSize:
        """The mark, and both lines however short."""
        return QSize(MARK_PX, self.sizeHint().height())

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the mark beside the first line, and the words."""
        left = MARK_PX + WORD_GAP_PX
        room = self.width() - left
        (first, font), (second, plain) = self._lines()
        top = (self.height() - first.height() - LINE_GAP_PX - second.height()) / 2
        mark_top = round(top + (first.height() - MARK_PX) / 2)
        muted = self.palette().color(QPalette.ColorRole.PlaceholderText)
        with QPainter(self) as painter:
            for metrics, line_font, words, ink in (
                (first, font, self.statement, self.ink),
                (second, plain, self.detail, muted),
            ):
                painter.setFont(line_font)
                painter.setPen(ink)
                shown = metrics.elidedText(words, Qt.TextElideMode.ElideRight, room)
                painter.drawText(QPointF(left, top + metrics.ascent()), shown)
                top += metrics.height() + LINE_GAP_PX
            painter.translate(0, mark_top)
            _paint_mark(painter, palette_of(self), self.warns)

    def _lines(self) -> tuple[tuple[QFontMetricsF, QFont], tuple[QFontMetricsF, QFont]]:
        """Metrics and font of both lines: the statement is bold."""
        plain, bold = self.font(), QFont(self.font())
        bold.setBold(True)
        return (QFontMetricsF(bold), bold), (QFontMetricsF(plain), plain)


def _paint_mark(painter: QPainter, colours: Palette, warns: bool) -> None:
    """Draw a tick in a disc, or a triangle with an exclamation mark, `MARK_PX` wide and high."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    line = QPen(color(colours.background), 1.8)
    line.setCapStyle(Qt.PenCapStyle.RoundCap)
    line.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if warns:
        ground = QPen(color(colours.warning), 2.0)
        ground.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(ground)
        painter.setBrush(color(colours.warning))
        painter.drawPolygon(QPolygonF([QPointF(8, 2), QPointF(15, 14), QPointF(1, 14)]))
        painter.setPen(line)
        painter.drawLine(QPointF(8, 6), QPointF(8, 9.4))
        painter.drawPoint(QPointF(8, 12.2))
    else:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color(colours.accent))
        painter.drawEllipse(QRectF(0.5, 0.5, 15, 15))
        painter.setPen(line)
        tick = [QPointF(4.6, 8.3), QPointF(7.1, 10.8), QPointF(11.6, 5.6)]
        painter.drawPolyline(QPolygonF(tick))
