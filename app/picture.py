"""Painting the canvas: pure drawing from what `app.scene` computed; nothing here can fail."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen, QPixmap

from app.drawn import MOST_HANDLES, Drawn
from app.polyline import SAFE_PX, point_of, polygon_of, stroke
from app.scene import Overlay, Scene
from app.style import SIZES, Palette, color

HINT_POINTS: Final = 10.5
"""Size of the words on the canvas, in typographic points."""

HINT_PADDING_PX: Final = (14.0, 8.0)
"""Room around the words, left and right, above and below."""

HINT_RISE_PX: Final = 20.0
"""Room between the words and the lower edge."""

HINT_ROOM_PX: Final = 28.0
"""Room to leave free below a drawing, besides its margin, while there are words."""

CROWD: Final = 500
"""Number of control points in view beyond which they are drawn as dots, all at once."""

_RING_GAP: Final = 3.5
"""Radius of the hover ring beyond that of the point, in pixels."""


def pen(name: str, width: float, opacity: float = 1.0) -> QPen:
    """Solid pen for curves and lines; its caps are round, so that the runs of a curve meet.

    Its joins are mitred: at the blunt corners of a curve's chords Qt's round joins blacken single
    pixels where the curve runs level (measured: coverage off by 0.46, mitred by 0.21).
    """
    return QPen(
        color(name, opacity),
        width,
        Qt.PenStyle.SolidLine,
        Qt.PenCapStyle.RoundCap,
        Qt.PenJoinStyle.MiterJoin,
    )


def paint_scene(
    painter: QPainter,
    scene: Scene,
    palette: Palette,
    view: QRectF,
    active: int,
    selected: frozenset[tuple[int, int]],
    overlay: Overlay,
    with_polygon: bool,
) -> None:
    """Draw curves, polygons, points and what the hand adds, from the back to the front.

    Parameters
    ----------
    painter, scene, palette
        Where, what, and in which colours.
    view
        The part of the canvas that is seen, in pixels.
    active
        Index of the curve that new points go to.
    selected
        Pairs (curve, point).
    overlay
        What the hand adds.
    with_polygon
        Whether control polygons and points are drawn.
    """
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for ribbon in scene.ribbons_px:
        _fill(painter, ribbon, palette)
    painter.setPen(pen(palette.ghost, SIZES.polygon_width, 0.8))
    _stroke_all(painter, scene.ghosts_px, view)
    if with_polygon:
        painter.setPen(pen(palette.polygon, SIZES.polygon_width))
        for drawn in scene.curves:
            _stroke_all(painter, drawn.polygons_px, view)
    order = [index for index in range(len(scene.curves)) if index != active]
    painter.setPen(pen(palette.curve, SIZES.calm_width))
    for index in order:
        _stroke_all(painter, scene.curves[index].outlines_px, view)
    painter.setPen(pen(palette.curve_active, SIZES.curve_width))
    if active < len(scene.curves):
        _stroke_all(painter, scene.curves[active].outlines_px, view)
    if scene.preview is not None:
        _paint_preview(painter, scene.preview, palette, view)
    if with_polygon:
        for index, drawn in enumerate(scene.curves):
            _paint_points(painter, drawn.handles_px, palette, calm=index != active)
        _paint_selected(painter, scene, selected, palette, view)
    _paint_overlay(painter, scene, overlay, palette)


def paint_hint(painter: QPainter, text: str, palette: Palette, view: QRectF) -> None:
    """Draw a few words near the lower edge, on a ground of their own."""
    box = _words_box(painter, text)
    box.moveCenter(view.center())
    box.moveBottom(view.bottom() - HINT_RISE_PX)
    _paint_words(painter, text, box, palette, palette.text)


def paint_notice(painter: QPainter, text: str, palette: Palette, view: QRectF) -> None:
    """Draw a sentence that warns near the upper edge, on a ground of its own."""
    box = _words_box(painter, text)
    box.moveCenter(view.center())
    box.moveTop(view.top() + HINT_RISE_PX)
    _paint_words(painter, text, box, palette, palette.warning)


def _words_box(painter: QPainter, text: str) -> QRectF:
    """Box around some words, somewhere; the painter takes their font."""
    font = QFont(painter.font())
    font.setPointSizeF(HINT_POINTS)
    painter.setFont(font)
    wide, high = HINT_PADDING_PX
    size = QFontMetricsF(font).size(0, text)
    return QRectF(0, 0, size.width() + 2 * wide, size.height() + 2 * high)


def _paint_words(
    painter: QPainter, text: str, box: QRectF, palette: Palette, ink: str
) -> None:
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(color(palette.ruler_line), 1.0))
    painter.setBrush(color(palette.ruler_background, 0.94))
    painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(color(ink))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def paint_cursor_marks(painter: QPainter, palette: Palette, pos_px: QPointF) -> None:
    """Mark the place of the mouse on both rulers."""
    painter.setPen(QPen(color(palette.accent), 1.0))
    x, y = int(pos_px.x()) + 0.5, int(pos_px.y()) + 0.5
    if x > SIZES.ruler:
        painter.drawLine(QPointF(x, 0), QPointF(x, SIZES.ruler - 1))
    if y > SIZES.ruler:
        painter.drawLine(QPointF(0, y), QPointF(SIZES.ruler - 1, y))


def _fill(painter: QPainter, outline: NDArray[np.float64], palette: Palette) -> None:
    """Fill a ribbon of influence; a part that Qt cannot hold is left out."""
    if np.abs(outline).max() > SAFE_PX:
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(color(palette.influence, 0.34))
    painter.drawPolygon(polygon_of(outline), Qt.FillRule.WindingFill)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _paint_preview(painter: QPainter, drawn: Drawn, palette: Palette, view: QRectF) -> None:
    painter.setPen(pen(palette.polygon, SIZES.polygon_width))
    _stroke_all(painter, drawn.polygons_px, view)
    painter.setPen(pen(palette.curve_active, SIZES.curve_width))
    _stroke_all(painter, drawn.outlines_px, view)
    _paint_points(painter, drawn.handles_px, palette, calm=False)


def _paint_points(
    painter: QPainter,
    points: NDArray[np.float64],
    palette: Palette,
    calm: bool,
) -> None:
    """Draw control points in view: as handles, or as dots where they are crowded."""
    if is_crowd(points):
        dots = QPen(color(palette.polygon if calm else palette.point), 2 * SIZES.dot_radius)
        painter.setPen(dots)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.drawPoints(polygon_of(_sparse(points)))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        return
    rim = palette.polygon if calm else palette.point
    ratio = painter.device().devicePixelRatioF()
    _stamp(painter, _handle(rim, palette.point_fill, SIZES.point_radius, ratio), points)


def _paint_selected(
    painter: QPainter,
    scene: Scene,
    selected: frozenset[tuple[int, int]],
    palette: Palette,
    view: QRectF,
) -> None:
    places = [drawn.places_px(_seen(drawn, c, selected)) for c, drawn in enumerate(scene.curves)]
    if not places:
        return
    points = _within(np.concatenate(places), view)
    ratio = painter.device().devicePixelRatioF()
    chosen = palette.point_selected
    _stamp(painter, _handle(chosen, chosen, SIZES.selected_radius, ratio), points)


def _paint_overlay(
    painter: QPainter, scene: Scene, overlay: Overlay, palette: Palette
) -> None:
    if overlay.hover is not None and overlay.hover.curve < len(scene.curves):
        drawn, point = scene.curves[overlay.hover.curve], overlay.hover.point
        if point < drawn.curve.count:
            _ring(painter, drawn.places_px(np.array([point]))[0], palette)
    if overlay.grip is not None and overlay.grip.curve < len(scene.curves):
        place = place_of(scene.curves[overlay.grip.curve], overlay.grip.t)
        if place is not None:
            painter.setPen(QPen(color(palette.background), SIZES.rim_width))
            painter.setBrush(color(palette.hover))
            painter.drawEllipse(point_of(place), SIZES.selected_radius, SIZES.selected_radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
    if overlay.rubber_band is not None:
        corner, opposite = overlay.rubber_band
        box = QRectF(point_of(corner), point_of(opposite)).normalized()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.fillRect(box, color(palette.rubber_band, 0.10))
        painter.setPen(QPen(color(palette.rubber_band), 1.0))
        painter.drawRect(box)


def is_crowd(points_px: NDArray[np.float64]) -> bool:
    """Whether control points are so many, or so close, that handles would hide the drawing."""
    if len(points_px) < 3:
        return False
    if len(points_px) > CROWD:
        return True
    return float(np.hypot(*np.diff(points_px, axis=0).T).mean()) < SIZES.crowd_spacing


def place_of(drawn: Drawn, t: float) -> NDArray[np.float64] | None:
    """Pixels of a place on a drawn curve, linear between its vertices; None if it has none."""
    if not len(drawn.parameters):
        return None
    places = drawn.vertices_px
    return np.array([np.interp(t, drawn.parameters, places[:, axis]) for axis in (0, 1)])


def _seen(drawn: Drawn, curve: int, selected: frozenset[tuple[int, int]]) -> NDArray[np.intp]:
    """Selected points of a curve: all, or of very many those that are shown anyway."""
    if len(selected) <= MOST_HANDLES:
        chosen = [point for c, point in selected if c == curve and point < drawn.curve.count]
    else:
        shown = [] if drawn.shown is None else drawn.shown.tolist()
        chosen = [point for point in shown if (curve, point) in selected]
    return np.array(chosen, dtype=np.intp)


def _stroke_all(
    painter: QPainter, lines: Iterable[NDArray[np.float64]], view: QRectF
) -> None:
    for line in lines:
        stroke(painter, line, view)


def _ring(painter: QPainter, place: NDArray[np.float64], palette: Palette) -> None:
    radius = SIZES.point_radius + _RING_GAP
    painter.setPen(QPen(color(palette.hover, 0.35), 3.0))
    painter.drawEllipse(point_of(place), radius, radius)


def _within(points: NDArray[np.float64], view: QRectF) -> NDArray[np.float64]:
    """Points in view, or so close to it that their handles reach into it."""
    reach = SIZES.hit_point
    low = (view.left() - reach, view.top() - reach)
    high = (view.right() + reach, view.bottom() + reach)
    return points[((points >= low) & (points <= high)).all(axis=1)]


def _sparse(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """At most one point for each pixel; they are dots, more would not be seen."""
    if len(points) <= 1000:
        return points
    return np.unique(np.rint(points), axis=0)


@lru_cache(maxsize=32)
def _handle(rim: str, fill: str, radius: float, ratio: float) -> QPixmap:
    """Picture of a control point, drawn once for each colour, size and screen."""
    side = 2 * int(np.ceil(radius + SIZES.rim_width)) + 1
    pixmap = QPixmap(round(side * ratio), round(side * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(color(rim), SIZES.rim_width))
        painter.setBrush(color(fill))
        middle = side / 2
        painter.drawEllipse(QPointF(middle, middle), radius, radius)
    return pixmap


def _stamp(painter: QPainter, pixmap: QPixmap, places: Iterable[NDArray[np.float64]]) -> None:
    """Draw a picture centred on each place, on whole device pixels, so that it stays crisp."""
    ratio = pixmap.devicePixelRatio()
    half = pixmap.width() / ratio / 2
    for x, y in np.rint((np.array(places).reshape(-1, 2) - half) * ratio) / ratio:
        painter.drawPixmap(QPointF(x, y), pixmap)
