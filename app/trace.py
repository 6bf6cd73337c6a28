"""The line of a function in a plot, with discs where it is marked."""

from __future__ import annotations

from typing import Final

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QPainter, QPen
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from app.guard import guarded
from app.polyline import polygon_of

LEAST_STEP_PX: Final = 2.0
"""Vertices are left out that would lie closer, along t, in device pixels."""

MARK_RADIUS_PX: Final = 3.5
"""Radius of a disc."""

_ANYWHERE: Final = QRectF(-1e3, -1e3, 2e3, 2e3)
"""Box in which a trace may lie; the view cuts it off at its edges."""


class Trace(pg.GraphicsObject):
    """A function over evenly spaced t, drawn in pixels.

    In the coordinates of a plot, as `pyqtgraph.PlotCurveItem` draws, a pen wider than a pixel takes
    Qt twice as long, and the marks of `pyqtgraph.ScatterPlotItem` half as long again.

    Attributes
    ----------
    t, values
        The function, shapes (k,).
    marks
        Places (t, value) of the discs, shape (m, 2).
    pen
        Of the line, its width in logical pixels.
    mark_pen, mark_brush
        Of the discs.
    """

    def __init__(self) -> None:
        super().__init__()
        self.t: NDArray[np.float64] = np.zeros(0)
        self.values: NDArray[np.float64] = np.zeros(0)
        self.marks: NDArray[np.float64] = np.zeros((0, 2))
        self.pen, self.mark_pen, self.mark_brush = QPen(), QPen(), QBrush()

    def put(self, t: NDArray[np.float64], values: NDArray[np.float64]) -> None:
        """Draw another function from now on, without marks."""
        self.t, self.values, self.marks = t, values, np.zeros((0, 2))

    def clear(self) -> None:
        """Draw nothing."""
        self.put(np.zeros(0), np.zeros(0))

    @guarded
    def boundingRect(self) -> QRectF:
        """Where the trace may lie."""
        return _ANYWHERE

    @guarded
    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw line and discs in the pixels of the widget."""
        if len(self.t) < 2:
            return
        way = painter.worldTransform()
        scale, origin = np.array([way.m11(), way.m22()]), np.array([way.dx(), way.dy()])
        device = painter.device()
        ratio = 1.0 if device is None else device.devicePixelRatioF()
        # All but the ends are evenly spaced.
        step_px = (self.t[2] - self.t[1]) * abs(scale[0]) * ratio if len(self.t) > 2 else np.inf
        stride = max(int(np.ceil(LEAST_STEP_PX / step_px)), 1)
        places = np.stack([self.t, self.values], axis=1)
        kept = np.concatenate([places[:-1:stride], places[-1:]])
        painter.resetTransform()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self.pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolyline(polygon_of(kept * scale + origin))
        painter.setPen(self.mark_pen)
        painter.setBrush(self.mark_brush)
        for x, y in (self.marks * scale + origin).tolist():
            painter.drawEllipse(QPointF(x, y), MARK_RADIUS_PX, MARK_RADIUS_PX)
