"""The preview in the import dialog: a picture that is painted in the background, and zoomed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, QTimer
from PySide6.QtGui import (
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.camera import Camera
from app.guard import guarded
from app.import_picture import (
    MOST_POINTS,
    POINT_RADIUS_PX,
    Sight,
    curve_pen,
    file_pen,
    painted,
)
from app.style import Palette, color, palette_of
from app.worker import Task, Worker
from core.polytope import Cancelled

LEAST_PX: Final = (420, 340)
"""Size below which a preview shows too little."""

MARGIN_PX: Final = 26
"""Free border around the drawing."""

LEGEND_PX: Final = 30
"""Height of the line below the drawing that says what is what."""

SAMPLE_PX: Final = 18
"""Length of the strokes in the legend."""

CLOSEST: Final = 64.0
"""Zoom, in parts of the whole: 0.01 mm on a drawing of 100 mm are some three pixels then."""

ZOOM_STEP: Final = 1.25
KEY_STEP_PX: Final = 40.0
NOTCH: Final = 120
"""Qt's measure of one notch of a mouse wheel."""


class Preview(QWidget):
    """Shows a sight; the wheel zooms, a drag moves, a double click shows all.

    It is painted in the background: until a new picture is there, the last one stands in its
    place.

    Parameters
    ----------
    painting
        Paints; it belongs to whoever ends it.
    """

    def __init__(self, painting: Worker, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._painting = painting
        self._sight: Sight | None = None
        self._camera = self._whole = Camera()
        self._image: QImage | None = None
        self._image_camera = self._camera
        self._held: QPointF | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(0)
        self._soon.timeout.connect(self._ask)
        painting.done.connect(self._take)
        self.setMinimumSize(*LEAST_PX)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Preview")
        self.setAccessibleDescription(
            "The lines of the file and the curves that they become. Plus and minus zoom, arrow"
            " keys move, 0 shows all."
        )
        self.setToolTip("Wheel zooms, drag moves, double click shows all")

    @property
    def camera(self) -> Camera:
        """The view."""
        return self._camera

    @property
    def sight(self) -> Sight | None:
        """What is shown."""
        return self._sight

    def show_sight(self, sight: Sight) -> None:
        """Show something; the view stays unless the lines of the file are others."""
        before, self._sight = self._sight, sight
        if before is None or not _same_box(before, sight):
            self.show_all()
        self._soon.start()

    def show_all(self) -> None:
        """Show the whole drawing as large as it fits."""
        if self._sight is None:
            return
        corners = np.array([self._sight.low, self._sight.high])
        margins = (MARGIN_PX, MARGIN_PX, MARGIN_PX, MARGIN_PX + LEGEND_PX)
        self._whole = Camera().resized(self.width(), self.height()).fitted(corners, margins)
        self._look(self._whole)

    def end(self) -> None:
        """Paint no more."""
        self._soon.stop()
        self._sight = None
        self._painting.cancel()

    def zoom(self, factor: float, at_px: tuple[float, float] | None = None) -> None:
        """Show less, larger; the place ``at_px``, or the middle, stays."""
        scale = np.clip(
            self._camera.scale * factor, self._whole.scale / 2, self._whole.scale * CLOSEST
        )
        self._look(self._camera.zoomed(float(scale) / self._camera.scale, at_px))

    def _look(self, camera: Camera) -> None:
        self._camera = camera
        self._soon.start()
        self.update()

    def _ask(self) -> None:
        if self._sight is not None:
            self._painting.ask(
                _painting(
                    self._sight, self._camera, self.devicePixelRatioF(), palette_of(self)
                )
            )

    def _take(self, found: tuple[Camera, QImage]) -> None:
        self._image_camera, self._image = found
        self.update()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the last picture where it belongs now, and say what is what."""
        palette = palette_of(self)
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), color(palette.background))
            if self._image is not None:
                old, now = self._image_camera, self._camera
                x, y = now.to_pixels(old.to_mm((0.0, 0.0))).tolist()
                zoom = now.scale / old.scale
                painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
                painter.drawImage(QRectF(x, y, old.width * zoom, old.height * zoom), self._image)
            self._paint_legend(painter, palette)
            frame = palette.accent if self.hasFocus() else palette.grid_major
            painter.setPen(QPen(color(frame), 1.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def _paint_legend(self, painter: QPainter, palette: Palette) -> None:
        if self._sight is None:
            return
        ground = QRectF(1, self.height() - LEGEND_PX, self.width() - 2, LEGEND_PX - 1)
        painter.fillRect(ground, color(palette.background))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        x, y = float(MARGIN_PX) / 2, ground.center().y()
        rows = [("File", file_pen(palette))]
        if self._sight.curves:
            rows.append(("Curve", curve_pen(palette)))
        for words, pen in rows:
            painter.setPen(pen)
            painter.drawLine(QPointF(x, y), QPointF(x + SAMPLE_PX, y))
            x = self._write(painter, palette, words, x + SAMPLE_PX + 6, ground)
        if 0 < len(self._sight.points) <= MOST_POINTS:
            painter.setPen(QPen(color(palette.accent), 1.0))
            painter.setBrush(color(palette.point_fill))
            painter.drawEllipse(QPointF(x + 4, y), POINT_RADIUS_PX, POINT_RADIUS_PX)
            self._write(painter, palette, "Control points", x + 13, ground)

    def _write(
        self, painter: QPainter, palette: Palette, words: str, x: float, ground: QRectF
    ) -> float:
        """Write words from x on; returns where the next may stand."""
        width = self.fontMetrics().horizontalAdvance(words)
        painter.setPen(color(palette.muted_text))
        room = QRectF(x, ground.top(), width + 2, ground.height())
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, words)
        return x + width + 18

    @guarded
    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep showing all if all is shown."""
        if self._camera == self._whole:
            self.show_all()
        else:
            self._look(self._camera.resized(self.width(), self.height()))

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Paint in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_soon"):
            self._soon.start()

    @guarded
    def event(self, event: QEvent) -> bool:
        """Paint for the pixels of another screen."""
        if event.type() == QEvent.Type.DevicePixelRatioChange and hasattr(self, "_soon"):
            self._soon.start()
        return super().event(event)

    @guarded
    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the mouse."""
        at = event.position()
        self.zoom(ZOOM_STEP ** (event.angleDelta().y() / NOTCH), (at.x(), at.y()))
        event.accept()

    @guarded
    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the paper."""
        self._held = event.position()

    @guarded
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Let the paper follow the mouse."""
        if self._held is not None:
            way = event.position() - self._held
            self._held = event.position()
            self._look(self._camera.moved(way.x(), way.y()))

    @guarded
    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self._held = None

    @guarded
    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show all."""
        self.show_all()

    @guarded
    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Zoom and move by keys."""
        key, ways = event.key(), {
            Qt.Key.Key_Left: (1, 0), Qt.Key.Key_Right: (-1, 0),
            Qt.Key.Key_Up: (0, 1), Qt.Key.Key_Down: (0, -1),
        }  # fmt: skip
        if key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoom(ZOOM_STEP)
        elif key == Qt.Key.Key_Minus:
            self.zoom(1 / ZOOM_STEP)
        elif key == Qt.Key.Key_0:
            self.show_all()
        elif key in ways:
            right, down = ways[Qt.Key(key)]
            self._look(self._camera.moved(right * KEY_STEP_PX, down * KEY_STEP_PX))
        else:
            super().keyPressEvent(event)


def _same_box(one: Sight, other: Sight) -> bool:
    return bool((one.low == other.low).all() and (one.high == other.high).all())


def _painting(sight: Sight, camera: Camera, ratio: float, palette: Palette) -> Task:
    """Task that paints a sight, for the view that it is painted for."""

    def task(cancelled: Cancelled, _send: Callable[[Any], None]) -> tuple[Camera, QImage]:
        return camera, painted(sight, camera, ratio, palette, cancelled)

    return task
