"""The preview in the export dialog: the picture of what will be written, with its size."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.export_picture import Look, Picture
from app.guard import guarded
from app.style import color, palette_of

HINT_PX: Final = (420, 250)
"""Size that the preview would like."""

LEAST_PX: Final = (240, 150)

GAP_PX: Final = 8.0
"""Between a page and the line that tells its size."""

END_PX: Final = 3.0
"""Half the length of the ends of such a line."""

ROUNDING_PX: Final = 4.0
"""Radius of the corners of the preview."""


class ExportPreview(QWidget):
    """Shows the last picture until there is a newer one; draws nothing but that and two sizes.

    Signals
    -------
    outdated()
        Size or colours have changed: another picture is wanted.
    """

    outdated = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.picture: Picture | None = None
        self.setMinimumSize(*LEAST_PX)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName("Preview")

    @property
    def look(self) -> Look:
        """Size and colours of the picture that is wanted."""
        return Look(self.width(), self.height(), self.devicePixelRatioF(), palette_of(self))

    def show_picture(self, picture: Picture | None) -> None:
        """Show a picture; None leaves the last one."""
        if picture is None:
            return
        self.picture = picture
        self.setAccessibleDescription(f"{picture.width} wide, {picture.height} high")
        self.update()

    @guarded
    def sizeHint(self) -> QSize:
        return QSize(*HINT_PX)

    @guarded
    def resizeEvent(self, event: QResizeEvent) -> None:
        """Ask for a picture of this size."""
        super().resizeEvent(event)
        self.outdated.emit()

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Ask for a picture in other colours."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.outdated.emit()

    @guarded
    def event(self, event: QEvent) -> bool:
        """Ask for a picture of another density."""
        if event.type() == QEvent.Type.DevicePixelRatioChange:
            self.outdated.emit()
        return super().event(event)

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the picture, and its sides as a drawing office writes them."""
        colours = palette_of(self)
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), color(colours.background))
            picture = self.picture
            if picture is not None:
                size = picture.image.deviceIndependentSize()
                shift = QPointF(self.width() - size.width(), self.height() - size.height()) / 2
                painter.drawImage(shift, picture.image)
                self._draw_sizes(painter, picture, picture.frame.translated(shift))
            painter.setPen(QPen(color(colours.grid_major), 1.0))
            painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    def _draw_sizes(self, painter: QPainter, picture: Picture, frame: QRectF) -> None:
        """Below the page its width, to the left of it its height, upwards."""
        colours = palette_of(self)
        self._draw_size(painter, frame.bottomLeft(), frame.width(), picture.width, 1.0)
        painter.save()
        painter.translate(frame.bottomLeft())
        painter.rotate(-90)
        painter.setPen(color(colours.muted_text))
        self._draw_size(painter, QPointF(0, 0), frame.height(), picture.height, -1.0)
        painter.restore()

    def _draw_size(
        self, painter: QPainter, start: QPointF, length: float, words: str, side: float
    ) -> None:
        """A line beside a page from ``start`` along x, with its length in words beyond it."""
        colours = palette_of(self)
        y = start.y() + side * GAP_PX
        painter.setPen(QPen(color(colours.axis), 1.0))
        painter.drawLine(QPointF(start.x(), y), QPointF(start.x() + length, y))
        for x in (start.x(), start.x() + length):
            painter.drawLine(QPointF(x, y - END_PX), QPointF(x, y + END_PX))
        painter.setPen(color(colours.muted_text))
        metrics = painter.fontMetrics()
        width, height = metrics.horizontalAdvance(words), metrics.height()
        middle = start.x() + length / 2
        top = y + 2 if side > 0 else y - 2 - height
        box = QRectF(middle - width / 2 - 2, top, width + 4, height)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)
