"""A chart of numbers over two parameters, with a cross that can be dragged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QFocusEvent,
    QFont,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QWidget

from app.guard import guarded
from app.style import LIGHT, Palette, color, palette_of
from core.atlas import Plane

LEFT_PX: Final = 34
"""Room for the labels of the upright axis."""

BELOW_PX: Final = 20
"""Room for the labels of the level axis."""

LEGEND_PX: Final = 54
"""Room for the legend on the right."""

STRIP_PX: Final = 10
"""Breadth of the legend's strip of colours."""

ABOVE_PX: Final = 6
"""Air above; the topmost label needs it."""

STEPS_PER_UNIT: Final = 200
"""A place is taken in steps of 0.005, as the sliders have them."""

BURST_MS: Final = 600
"""Arrow presses that follow each other within this time are one step of undo."""

CROSS_PX: Final = 7.0
"""Half length of the arms of the cross."""

RAMPS: Final = {
    True: ("#eef3fc", "#a9c6f5", "#4f86e3", "#1f4da3", "#0a1f4d"),
    False: ("#20242b", "#24407a", "#3f74cf", "#86b4ff", "#eaf2ff"),
}
"""Colours from the least to the greatest value, in the light and in the dark: one hue whose
lightness runs one way, so that every eye sees the same order."""

_ARROWS: Final = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


@dataclass(frozen=True)
class Scale:
    """How values are coloured: from ``low`` to ``high``, labelled every ``step``."""

    name: str
    low: float
    high: float
    step: float
    label: Callable[[float], str]


class Chart(QWidget):
    """The picture of a map, its axes, its legend and the cross.

    Signals
    -------
    begun()
        A drag, or a burst of arrow keys, begins.
    chosen(u, v)
        A place was chosen, within what was begun.
    ended()
        The drag or the burst is over.
    dropped()
        Escape was pressed during a drag: what it did is to be taken back.
    """

    begun = Signal()
    chosen = Signal(float, float)
    ended = Signal()
    dropped = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.values: NDArray[np.float64] = np.zeros((0, 0))
        self.cross: tuple[float, float] | None = None
        self._plane: Plane | None = None
        self._scale: Scale | None = None
        self._image: QImage | None = None
        self._held = False
        self._burst = QTimer(self)
        self._burst.setSingleShot(True)
        self._burst.setInterval(BURST_MS)
        self._burst.timeout.connect(self.ended)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(160, 120)
        self.setAccessibleName("Map of parameters")
        self.setAccessibleDescription(
            "Level axis alpha, upright axis beta. Arrow keys move the present parameters, Shift"
            " ten times as far."
        )
        self.setToolTip("Click or drag to choose \u03b1 and \u03b2")

    def show_map(self, plane: Plane, values: NDArray[np.float64], scale: Scale) -> None:
        """Show values, shape (v, u); those that are nan are left empty."""
        self._plane, self._scale, self.values = plane, scale, values
        self._colour()

    def show_rows(self, rows: slice, values: NDArray[np.float64]) -> None:
        """Put some rows into the map."""
        self.values[rows] = values
        self._colour()

    def mark(self, place: tuple[float, float] | None) -> None:
        """Put the cross somewhere, or nowhere."""
        self.cross = place
        self.update()

    def value_here(self) -> float | None:
        """The value at the cross, nan if it is not known yet, or None outside the map."""
        if self.cross is None or self._plane is None or not self.values.size:
            return None
        index = []
        for place, ends, count in zip(
            self.cross, self._ranges, reversed(self.values.shape), strict=True
        ):
            share = (place - ends[0]) / (ends[1] - ends[0])
            if not 0 <= share <= 1:
                return None
            index.append(round(share * (count - 1)))
        return float(self.values[index[1], index[0]])

    def snapped(self, u: float, v: float) -> tuple[Fraction, Fraction]:
        """The place nearest to (u, v) that the sliders have too."""
        return Fraction(round(u * STEPS_PER_UNIT), STEPS_PER_UNIT), Fraction(
            round(v * STEPS_PER_UNIT), STEPS_PER_UNIT
        )

    def place_px(self, u: float, v: float) -> QPointF:
        """Pixels of a place."""
        (u0, u1), (v0, v1) = self._ranges
        area = self._area()
        x = area.left() + (u - u0) / (u1 - u0) * area.width()
        return QPointF(x, area.bottom() - (v - v0) / (v1 - v0) * area.height())

    @property
    def _ranges(self) -> tuple[tuple[float, float], tuple[float, float]]:
        if self._plane is None:
            return (0.0, 1.0), (0.0, 1.0)
        (u0, u1), (v0, v1) = self._plane.u_range, self._plane.v_range
        return (float(u0), float(u1)), (float(v0), float(v1))

    def _area(self) -> QRectF:
        return QRectF(self.rect()).adjusted(LEFT_PX, ABOVE_PX, -LEGEND_PX, -BELOW_PX)

    def _choose(self, at: QPointF) -> None:
        (u0, u1), (v0, v1) = self._ranges
        area = self._area()
        right = np.clip((at.x() - area.left()) / max(area.width(), 1.0), 0.0, 1.0)
        up = np.clip((area.bottom() - at.y()) / max(area.height(), 1.0), 0.0, 1.0)
        self.chosen.emit(float(u0 + right * (u1 - u0)), float(v0 + up * (v1 - v0)))

    def _colour(self) -> None:
        """Make the picture of the values."""
        if self._scale is None:
            return
        colours = _colours(self.values[::-1], self._scale, palette_of(self))
        rows, columns = colours.shape
        picture = QImage(colours.data, columns, rows, 4 * columns, QImage.Format.Format_ARGB32)
        self._image = picture.copy()  # the array goes, the picture stays
        self.update()

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_burst"):
            self._colour()

    @guarded
    def sizeHint(self) -> QSize:
        """About square, and as broad as the panels on the right."""
        return QSize(270, 250)

    @guarded
    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to drag the cross, which comes to the mouse."""
        if event.button() == Qt.MouseButton.LeftButton and self._plane is not None:
            self._settle()
            self._held = True
            self.begun.emit()
            self._choose(event.position())

    @guarded
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the mouse."""
        if self._held:
            self._choose(event.position())

    @guarded
    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag."""
        if self._held and event.button() == Qt.MouseButton.LeftButton:
            self._held = False
            self.ended.emit()

    @guarded
    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the cross by arrow keys; Escape drops a drag."""
        if event.key() == Qt.Key.Key_Escape and self._held:
            self._held = False
            self.dropped.emit()
        elif event.key() in _ARROWS and self.cross is not None and not self._held:
            if not self._burst.isActive():
                self.begun.emit()
            self._burst.start()
            shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            step = (10 if shift else 1) / STEPS_PER_UNIT
            right, up = _ARROWS[Qt.Key(event.key())]
            self.chosen.emit(self.cross[0] + right * step, self.cross[1] + up * step)
        else:
            super().keyPressEvent(event)

    @guarded
    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show the frame of the focus."""
        self.update()

    @guarded
    def focusOutEvent(self, event: QFocusEvent) -> None:
        """End what is under way."""
        self._settle()
        self.update()

    def _settle(self) -> None:
        if self._held or self._burst.isActive():
            self._held = False
            self._burst.stop()
            self.ended.emit()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw map, axes, legend and cross."""
        colours, area = palette_of(self), self._area()
        if self._image is None or self._scale is None or area.isEmpty():
            return
        font = QFont(self.font())
        font.setPointSizeF(max(font.pointSizeF() - 1, 1.0))
        with QPainter(self) as painter:
            painter.setFont(font)
            painter.fillRect(area, color(colours.plot_background))
            painter.drawImage(area, self._image)
            painter.setPen(QPen(color(colours.accent if self.hasFocus() else colours.axis), 1.0))
            painter.drawRect(area.adjusted(-0.5, -0.5, 0.5, 0.5))
            self._paint_axes(painter, colours, area)
            self._paint_legend(painter, colours, area, self._scale)
            if self.cross is not None and self.value_here() is not None:
                _paint_cross(painter, self.place_px(*self.cross), colours)

    def _paint_axes(self, painter: QPainter, colours: Palette, area: QRectF) -> None:
        painter.setPen(color(colours.muted_text))
        across, up = self._ranges
        for u in _ticks(across):
            x = self.place_px(u, up[0]).x()
            box = QRectF(x - 24, area.bottom() + 3, 48, BELOW_PX - 3)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, _signed(u))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for v in _ticks(up):
            y = self.place_px(across[0], v).y()
            box = QRectF(0, y - 8, LEFT_PX - 5, 16)
            painter.drawText(box, right, _signed(v))
        if self._plane is not None:
            painter.setPen(color(colours.text))
            box = QRectF(area.right() + 8, area.bottom() + 3, LEGEND_PX - 8, BELOW_PX - 3)
            painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, _named(self._plane.u_axis))
            box = QRectF(0, area.top() - 2, LEFT_PX - 5, 16)
            painter.drawText(box, right, _named(self._plane.v_axis))

    def _paint_legend(
        self, painter: QPainter, colours: Palette, area: QRectF, scale: Scale
    ) -> None:
        strip = QRectF(area.right() + 8, area.top(), STRIP_PX, area.height())
        shades = _colours(np.linspace(scale.high, scale.low, 64)[:, None], scale, colours)
        picture = QImage(shades.data, 1, len(shades), 4, QImage.Format.Format_ARGB32)
        painter.drawImage(strip, picture.copy())
        painter.setPen(color(colours.muted_text))
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        for step in range(round((scale.high - scale.low) / scale.step) + 1):
            value = scale.low + step * scale.step
            share = (value - scale.low) / (scale.high - scale.low)
            y = strip.bottom() - share * strip.height()
            y = min(max(y, strip.top() + 5), strip.bottom() - 5)
            box = QRectF(strip.right() + 5, y - 8, LEGEND_PX, 16)
            painter.drawText(box, left, scale.label(value))


def _colours(
    values: NDArray[np.float64], scale: Scale, colours: Palette
) -> NDArray[np.uint32]:
    """Pixels 0xAARRGGBB of values; unknown ones are transparent, those below the scale grey."""
    ramp = np.array([_channels(name) for name in RAMPS[colours is LIGHT]])
    share = (np.nan_to_num(values) - scale.low) / (scale.high - scale.low)
    place = np.clip(share, 0.0, 1.0) * (len(ramp) - 1)
    rgb = np.stack(
        [np.interp(place, np.arange(len(ramp)), channel) for channel in ramp.T], axis=-1
    )
    rgb[values < scale.low] = _channels(colours.axis)
    whole = np.rint(rgb).astype(np.uint32)
    pixels = (whole[..., 0] << 16) | (whole[..., 1] << 8) | whole[..., 2] | np.uint32(0xFF000000)
    return np.ascontiguousarray(np.where(np.isnan(values), 0, pixels), dtype=np.uint32)


def _channels(name: str) -> list[int]:
    return [int(name[i : i + 2], 16) for i in (1, 3, 5)]


def _ticks(ends: tuple[float, float]) -> list[float]:
    """Multiples of 1/2, or of 1/4 on a short axis, within the ends."""
    step = 0.5 if ends[1] - ends[0] >= 1 else 0.25
    first, last = np.ceil(ends[0] / step), np.floor(ends[1] / step)
    return [float(k) * step for k in np.arange(first, last + 1)]


def _named(axis: tuple[int, int, int]) -> str:
    """What runs along an axis: "α", or "α = γ"."""
    return " = ".join(name for name, part in zip("\u03b1\u03b2\u03b3", axis, strict=True) if part)


def _signed(value: float) -> str:
    return f"{value:g}".replace("-", "\N{MINUS SIGN}")


def _paint_cross(painter: QPainter, at: QPointF, colours: Palette) -> None:
    """A cross with an edge, so that it stands out from every shade of the map."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for name, width in ((colours.background, 5.0), (colours.influence, 2.0)):
        pen = QPen(color(name), width)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawLine(at - QPointF(CROSS_PX, 0), at + QPointF(CROSS_PX, 0))
        painter.drawLine(at - QPointF(0, CROSS_PX), at + QPointF(0, CROSS_PX))
