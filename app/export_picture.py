"""The picture of what an export writes: drawn in the background, whatever its size."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPen

from app.camera import Camera
from app.export_paths import joints_of, painter_paths
from app.polyline import polygon_of
from app.style import LIGHT, Palette, color, contrast
from core.flatten import Polyline
from core.formats.contours import Contours
from core.formats.svg import page
from core.formats.tables import Tables
from core.polytope import Cancelled

PAPER: Final = "#ffffff"
"""Ground of formats that have a page; in both colour schemes, as it is what comes out."""

CHECKS: Final = ("#ffffff", "#e6e8ec")
"""Squares that stand for no ground at all."""

CHECK_PX: Final = 8

MARGINS_PX: Final = (40.0, 16.0, 16.0, 32.0)
"""Left, top, right, bottom; to the left and below stands the size."""

TICK_PX: Final = 7.0
"""Length of the mark between two entities."""

CROWD_PX: Final = 6.0
"""Mean distance of marks below which there are none: they would hide the curve."""

DOT_PX: Final = 2.0
"""Radius of a point of a table."""

ORIGIN_PX: Final = 6.0
"""Half the width of the cross at the origin."""

DASHES: Final = [4.0, 3.0]
"""Of the outline before the offset, in widths of its pen."""

FAINT: Final = 1.6
"""Contrast below which a colour cannot be seen on the canvas, so that its ink is taken."""

_PAGED: Final = ("svg", "pdf", "png")


@dataclass(frozen=True)
class Look:
    """How large a picture is, in logical pixels, how dense, and in which colours."""

    width: int
    height: int
    ratio: float
    palette: Palette = LIGHT


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture, and what stands around it.

    Attributes
    ----------
    image
        As large as it was asked for.
    frame
        The page, or the box of what is written, in logical pixels.
    width, height
        Its sides in words.
    """

    image: QImage
    frame: QRectF
    width: str
    height: str


def drawn(
    content: Contours | Tables,
    original: Contours | Tables | None,
    look: Look,
    cancelled: Cancelled | None = None,
) -> Picture | None:
    """Draw what is written, the ends of its entities, and what it was before an offset.

    It may be called in any thread; no fonts are used.

    Parameters
    ----------
    content
        What is written.
    original
        The same before the offset by a kerf, if there is one.
    look
        Size and colours.
    cancelled
        Asked every some thousand pieces.

    Returns
    -------
    Picture or None
        None if it was cancelled, or there is no room.
    """
    left, top, right, bottom = MARGINS_PX
    if look.width <= left + right or look.height <= top + bottom:
        return None
    return _Drawing(content, original, look).made(cancelled or (lambda: False))


class _Drawing:
    """One picture in the making; lengths are in logical pixels."""

    def __init__(
        self, content: Contours | Tables, original: Contours | Tables | None, look: Look
    ) -> None:
        self.content, self.look = content, look
        self.original = original if isinstance(original, Contours) else None
        profile = content.profile
        self.is_paged = isinstance(content, Contours) and profile.format in _PAGED
        self.colours = LIGHT if self.is_paged else look.palette
        self.box = content.box
        if isinstance(content, Contours) and self.is_paged:
            origin, size = page(content)
            self.box = origin + np.array([(0.0, -size[1]), (size[0], 0.0)])
        corners = self.box
        if self.original is not None:
            corners = np.concatenate([corners, self.original.box + self._moved(self.original)])
        # The camera's own limits of scale are those of a canvas; here a length of 1 fills it.
        self.centre = corners.mean(axis=0)
        self.unit = float((corners.max(axis=0) - corners.min(axis=0)).max()) or 1.0
        camera = Camera(width=look.width, height=look.height)
        self.camera = camera.fitted((corners - self.centre) / self.unit, MARGINS_PX)
        self.scale = self.camera.scale / self.unit
        width = profile.width_mm / profile.unit_mm * self.scale if self.is_paged else 0.0
        ink = QColor(profile.colour)
        if not self.is_paged and contrast(profile.colour, self.colours.background) < FAINT:
            ink = QColor(self.colours.curve_active)
        self.ink = _pen(ink, max(width, 1.2))

    def made(self, cancelled: Cancelled) -> Picture | None:
        look = self.look
        size = (round(look.width * look.ratio), round(look.height * look.ratio))
        image = QImage(*size, QImage.Format.Format_ARGB32_Premultiplied)
        image.setDevicePixelRatio(look.ratio)
        image.fill(QColor(look.palette.background))
        low, high = self._pixels(self.box)
        frame = QRectF(low[0], high[1], high[0] - low[0], low[1] - high[1])
        with QPainter(image) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            if self.is_paged:
                self._draw_page(painter, frame)
            for _ in self._steps(painter):
                if cancelled():
                    return None
        width, height = ((self.box[1] - self.box[0]) * self.content.profile.unit_mm).tolist()
        return Picture(image, frame, f"{width:.2f} mm", f"{height:.2f} mm")

    def _steps(self, painter: QPainter) -> Iterator[None]:
        """Draw, and give way after each short part."""
        if self.original is not None:
            pen = _pen(QColor(self.colours.ghost), 1.0)
            pen.setDashPattern(DASHES)
            yield from self._outlines(painter, self.original, pen)
        if isinstance(self.content, Tables):
            yield from self._points(painter, self.content)
        else:
            yield from self._outlines(painter, self.content, self.ink)
            yield from self._ticks(painter, self.content)
        if not self.is_paged:
            self._draw_origin(painter)

    def _moved(self, contours: Contours) -> NDArray[np.float64]:
        """From the coordinates of other contours to those of the content."""
        own = self.content.shift if isinstance(self.content, Contours) else np.zeros(2)
        return own - contours.shift

    def _pixels(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.camera.to_pixels((places - self.centre) / self.unit)

    def _draw_page(self, painter: QPainter, frame: QRectF) -> None:
        profile = self.content.profile
        if profile.format == "png" and profile.transparent:
            painter.fillRect(frame, QColor(CHECKS[0]))
            painter.save()
            painter.setClipRect(frame)
            painter.translate(frame.topLeft().toPoint())
            for row in range(int(frame.height() / CHECK_PX) + 1):
                for column in range(row % 2, int(frame.width() / CHECK_PX) + 1, 2):
                    square = QRectF(column * CHECK_PX, row * CHECK_PX, CHECK_PX, CHECK_PX)
                    painter.fillRect(square, QColor(CHECKS[1]))
            painter.restore()
        else:
            painter.fillRect(frame, QColor(PAPER))
        painter.setPen(_pen(QColor(self.look.palette.grid_major), 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(frame)

    def _outlines(self, painter: QPainter, contours: Contours, pen: QPen) -> Iterator[None]:
        painter.setPen(pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        corner = self.centre - self._moved(contours)
        painter.save()
        painter.translate(*self._pixels(self.centre).tolist())
        for contour in contours.contours:
            for path in painter_paths(contour.shape, corner, self.scale):
                painter.drawPath(path)
                yield
        painter.restore()

    def _ticks(self, painter: QPainter, contours: Contours) -> Iterator[None]:
        """Marks between the entities; dots on polylines, whose sides have two directions there."""
        accent = QColor(self.colours.accent)
        for contour in contours.contours:
            places, ways = joints_of(contour.shape)
            yield
            at = self._pixels(places)
            far = np.hypot(*np.diff(at, axis=0).T)
            if len(far) and far.mean() < CROWD_PX:
                continue
            if isinstance(contour.shape, Polyline):
                self._dots(painter, at, accent)
                continue
            across = ways[:, ::-1] * (TICK_PX / 2)
            painter.setPen(_pen(accent, 1.0))
            for ends in np.concatenate([at - across, at + across], axis=1).tolist():
                painter.drawLine(QLineF(*ends))

    def _points(self, painter: QPainter, tables: Tables) -> Iterator[None]:
        for points, table in zip(tables.points, tables.tables, strict=True):
            line = Polyline(points, table.curve.is_loop, 0.0)
            painter.setPen(_pen(QColor(self.colours.polygon), 1.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            at = self._pixels(points)
            painter.save()
            painter.translate(*self._pixels(self.centre).tolist())
            for path in painter_paths(line, self.centre, self.scale) if len(points) > 1 else ():
                painter.drawPath(path)
                yield
            painter.restore()
            for part in np.array_split(at, max(len(at) // 2000, 1)):
                self._dots(painter, part, QColor(self.colours.accent))
                yield

    def _dots(self, painter: QPainter, at: NDArray[np.float64], ink: QColor) -> None:
        painter.setPen(_pen(ink, 2 * DOT_PX))
        painter.drawPoints(polygon_of(at))

    def _draw_origin(self, painter: QPainter) -> None:
        """A cross where x and y are 0, if that is in sight."""
        x, y = self._pixels(np.zeros(2)).tolist()
        sight = QRectF(0, 0, self.look.width, self.look.height)
        arm = ORIGIN_PX + 1
        if not sight.adjusted(arm, arm, -arm, -arm).contains(QPointF(x, y)):
            return
        painter.setPen(_pen(color(self.colours.influence), 1.5))
        painter.drawLine(QLineF(x - ORIGIN_PX, y, x + ORIGIN_PX, y))
        painter.drawLine(QLineF(x, y - ORIGIN_PX, x, y + ORIGIN_PX))


def _pen(ink: QColor, width: float) -> QPen:
    caps, joins = Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin
    return QPen(QBrush(ink), width, Qt.PenStyle.SolidLine, caps, joins)
