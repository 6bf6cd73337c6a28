"""The slider of a parameter: a track with a mark at the default, drawn from the colour table."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QSlider, QWidget

from app.guard import guarded
from app.style import color, palette_of

HANDLE_RADIUS_PX: Final = 7.0
"""Radius of the handle; the whole height of the track takes the mouse."""

GROOVE_PX: Final = 4.0
"""Breadth of the groove."""

MARK_PX: Final = 6.0
"""Half length of the mark at the default; it shows above and below the groove."""

HALO_PX: Final = 3.0
"""Ring around the handle while the track has the keyboard's focus."""

HEIGHT_PX: Final = 24
"""Height of the track: enough to be hit without aiming."""

FINE: Final = 10
"""With Shift the handle moves by a tenth of the mouse's way."""


class Track(QSlider):
    """A horizontal slider that tells gestures from single steps.

    A press takes the handle to the mouse; with Shift it moves finely. The default has a mark, and
    a double click asks for it.

    Signals
    -------
    taken()
        A drag begins; comes before its first change of value.
    left()
        A drag ended.
    dropped()
        Escape was pressed during a drag: what it did is to be taken back.
    reset()
        A double click asks for the default.
    blurred()
        The keyboard's focus went elsewhere.
    """

    taken = Signal()
    left = Signal()
    dropped = Signal()
    reset = Signal()
    blurred = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._mark = 0
        self._beyond = False
        self._held = False
        self._last_x = 0.0
        self._position = 0.0

    @property
    def is_held(self) -> bool:
        """Whether a drag is going on."""
        return self._held

    def show_value(self, value: int, mark: int) -> None:
        """Show a value that comes from elsewhere, which may lie beyond the ends, and the mark."""
        beyond = not self.minimum() <= value <= self.maximum()
        if (mark, beyond) != (self._mark, self._beyond):
            self._mark, self._beyond = mark, beyond
            self.update()
        self.setValue(value)

    def x_of(self, value: int) -> float:
        """Place of a value on the track, in pixels from the left."""
        share = (value - self.minimum()) / (self.maximum() - self.minimum())
        return self._start + share * self._length

    @property
    def _start(self) -> float:
        return HANDLE_RADIUS_PX + HALO_PX

    @property
    def _length(self) -> float:
        return max(self.width() - 2 * self._start, 1.0)

    def _value_at(self, x: float) -> float:
        share = (x - self._start) / self._length
        return self.minimum() + share * (self.maximum() - self.minimum())

    @guarded
    def sizeHint(self) -> QSize:
        """Wide enough to set single steps of some hundredths."""
        return QSize(140, HEIGHT_PX)

    @guarded
    def minimumSizeHint(self) -> QSize:
        """The least breadth in which it can still be used."""
        return QSize(80, HEIGHT_PX)

    @guarded
    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a drag; off the handle, the handle comes to the mouse."""
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        x = event.position().x()
        self._held = True
        self._last_x = x
        self._position = float(self.value())
        self.taken.emit()
        if abs(x - self.x_of(self.value())) > HANDLE_RADIUS_PX:
            self._go_to(self._value_at(x))
        self.update()
        event.accept()

    @guarded
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the mouse; a tenth of the way with Shift."""
        if not self._held:
            return
        x = event.position().x()
        way = (x - self._last_x) * (self.maximum() - self.minimum()) / self._length
        self._last_x = x
        fine = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        self._go_to(self._position + (way / FINE if fine else way))
        event.accept()

    @guarded
    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag."""
        if self._held and event.button() == Qt.MouseButton.LeftButton:
            self._release()
            self.left.emit()
        event.accept()

    @guarded
    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for the default."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.reset.emit()
        event.accept()

    @guarded
    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape drops a drag; else the keys of every slider."""
        if self._held:
            if event.key() == Qt.Key.Key_Escape:
                self._release()
                self.dropped.emit()
            event.accept()
            return
        super().keyPressEvent(event)

    @guarded
    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Tell that no more keys will come; a drag that loses the window ends where it is."""
        super().focusOutEvent(event)
        if self._held:
            self._release()
            self.left.emit()
        self.blurred.emit()

    @guarded
    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only with the focus: a wheel that scrolls past must not change the curve."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw groove, filled part, mark and handle."""
        colours = palette_of(self)
        accent = color(colours.accent if self.isEnabled() else colours.muted_text)
        middle = self.height() / 2
        x, mark = self.x_of(self.value()), self.x_of(self._mark)
        groove = QRectF(self._start, middle - GROOVE_PX / 2, self._length, GROOVE_PX)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(color(colours.muted_text), 1.5))
            painter.drawLine(QPointF(mark, middle - MARK_PX), QPointF(mark, middle + MARK_PX))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(color(colours.ruler_line))
            painter.drawRoundedRect(groove, GROOVE_PX / 2, GROOVE_PX / 2)
            painter.setBrush(accent)
            painter.drawRect(QRectF(min(x, mark), groove.top(), abs(x - mark), GROOVE_PX))
            if self.hasFocus():
                painter.setBrush(color(colours.accent, 0.3))
                halo = HANDLE_RADIUS_PX + HALO_PX
                painter.drawEllipse(QPointF(x, middle), halo, halo)
            # A hollow handle says that the number lies beyond the end of the track.
            rim = 2.0
            painter.setPen(QPen(accent, rim))
            painter.setBrush(color(colours.background) if self._beyond else accent)
            radius = HANDLE_RADIUS_PX - rim / 2
            painter.drawEllipse(QPointF(x, middle), radius, radius)

    def _go_to(self, position: float) -> None:
        # The exact position is kept beside the rounded value, so that fine moves add up.
        self._position = min(max(position, float(self.minimum())), float(self.maximum()))
        self.setValue(round(self._position))

    def _release(self) -> None:
        self._held = False
        self.update()
