"""Background of the canvas: grid and rulers in millimetres, with ticks at 1, 2 or 5 times 10^k."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPixmap, QStaticText
from shiboken6 import wrapInstance

from app.camera import Camera
from app.style import SIZES, Palette, color

LABEL_POINTS: Final = 7.5
"""Size of the numbers on the rulers, in typographic points."""

LABEL_GAP_PX: Final = 14.0
"""Least room between two numbers on a ruler."""

LABEL_INDENT_PX: Final = 3.0
"""Room between a tick and its number."""

SHORT_TICK_PX: Final = 5.0
LONG_TICK_PX: Final = 12.0
"""Lengths of the ticks on the rulers, plain and labelled."""

STRIP: Final = 8
"""Rows of the background that are drawn; all others are copied from them. So few stay in the
processor's cache, and are copied three times as fast as drawn."""

AXIS_OPACITY: Final = 0.55
"""The lines through the origin are lines of the grid, only stronger."""

_CORNER_PX: Final = 400.0
"""From here on even the longest number keeps out of the corner of the rulers."""

_MINOR: Final = {1: (10, 5, 2), 2: (4, 2), 5: (5,)}
"""Parts that a step of 1, 2 or 5 may be cut into, so that the small steps are round as well."""


class Step(NamedTuple):
    """Distance between labelled ticks, ``digit * 10^exponent`` mm, and the parts it is cut into."""

    digit: int
    exponent: int
    parts: int

    @property
    def size_mm(self) -> float:
        """The distance in millimetres."""
        return self.digit * 10.0**self.exponent

    def label(self, count: int) -> str:
        """Text of the tick at ``count`` steps from the origin, exact at any zoom."""
        value = count * self.digit
        sign = "\N{MINUS SIGN}" if value < 0 else ""
        if self.exponent >= 0:
            return f"{sign}{abs(value) * 10**self.exponent}"
        whole, rest = divmod(abs(value), 10**-self.exponent)
        return f"{sign}{whole}.{rest:0{-self.exponent}d}"


def step_for(scale: float, spacing_px: float) -> Step:
    """Smallest round step whose ticks are at least ``spacing_px`` apart.

    Parameters
    ----------
    scale
        Pixels per millimetre.
    spacing_px
        Least distance between labelled ticks.
    """
    exponent = math.floor(math.log10(spacing_px / scale))
    for digit, power in ((1, exponent), (2, exponent), (5, exponent), (1, exponent + 1)):
        size_px = digit * 10.0**power * scale
        if size_px >= spacing_px * (1 - 1e-9):
            break
    fitting = [parts for parts in _MINOR[digit] if size_px / parts >= SIZES.minor_spacing]
    return Step(digit, power, fitting[0] if fitting else 1)


def ticks(low_mm: float, high_mm: float, step: Step) -> tuple[NDArray[np.float64], range]:
    """Ticks of an interval.

    Returns
    -------
    minor_mm, major
        Places of all ticks, and the counts of the labelled ones (multiples of the step).
    """
    size = step.size_mm
    major = range(math.ceil(low_mm / size), math.floor(high_mm / size) + 1)
    part = size / step.parts
    first, last = math.ceil(low_mm / part), math.floor(high_mm / part)
    return np.arange(first, last + 1, dtype=np.float64) * part, major


def ruler_font(base: QFont) -> QFont:
    """Font of the numbers on the rulers."""
    font = QFont(base)
    font.setPointSizeF(LABEL_POINTS)
    return font


def view_step(camera: Camera, metrics: QFontMetricsF) -> Step:
    """Step of both rulers: as fine as the longest number in view leaves room for."""
    low, high = camera.rectangle_mm()
    spacing = SIZES.label_spacing
    for _ in range(2):
        step = step_for(camera.scale, spacing)
        ends = np.concatenate([low, high]) / step.size_mm
        labels = [step.label(int(count)) for count in ends]
        widest = max(metrics.horizontalAdvance(label) for label in labels)
        spacing = max(spacing, widest + LABEL_GAP_PX)
    return step_for(camera.scale, spacing)


def paint_grid(
    painter: QPainter, camera: Camera, palette: Palette, step: Step, axis: int
) -> None:
    """Draw the lines of the grid across an axis; the one through the origin is the other axis."""
    low, high = camera.rectangle_mm()
    length = (camera.height, camera.width)[axis]
    minor, major = ticks(float(low[axis]), float(high[axis]), step)
    for places, ink in (
        (minor, color(palette.grid)),
        (np.array(major) * step.size_mm, color(palette.grid_major)),
        (np.zeros(int(low[axis] <= 0 <= high[axis])), color(palette.axis, AXIS_OPACITY)),
    ):
        _rule(painter, axis, _axis_pixels(camera, axis, places), 0, length, ink)


def paint_ruler(
    painter: QPainter, camera: Camera, palette: Palette, step: Step, axis: int
) -> None:
    """Draw the ruler along the upper (0) or the left edge (1); the upper one has the unit, too."""
    low, high = camera.rectangle_mm()
    breadth, length = SIZES.ruler, (camera.width, camera.height)[axis]
    line, ground = color(palette.ruler_line), color(palette.ruler_background)
    painter.setFont(ruler_font(painter.font()))
    _fill(painter, _boxes(axis, np.zeros(1), 0, length, breadth), ground)
    minor, major = ticks(float(low[axis]), float(high[axis]), step)
    places = _axis_pixels(camera, axis, minor)
    _rule(painter, axis, places, breadth - SHORT_TICK_PX, breadth, line)
    labelled = _axis_pixels(camera, axis, np.array(major) * step.size_mm)
    _rule(painter, axis, labelled, breadth - LONG_TICK_PX, breadth, line)
    painter.setPen(color(palette.ruler_text))
    _write_labels(painter, axis, labelled.tolist(), [step.label(count) for count in major])
    if axis == 0:
        _fill(painter, _boxes(axis, np.zeros(1), 0, breadth, breadth), ground)
    edge = np.array([breadth - 1.0])
    _rule(painter, 1 - axis, edge, breadth - 1, length, line)
    if axis == 0:
        _rule(painter, 0, edge, breadth - 1, breadth, line)
        painter.setPen(color(palette.ruler_text))
        corner = QRectF(0, 0, breadth, breadth)
        painter.drawText(corner, Qt.AlignmentFlag.AlignCenter, "mm")


def paint_frame(painter: QPainter, size: tuple[int, int], ink: QColor) -> None:
    """Draw a line inside of all four edges, of whole device pixels and no broader than a pixel."""
    ratio = painter.device().devicePixelRatioF()
    breadth = max(math.floor(ratio), 1) / ratio
    for axis in (0, 1):
        length = size[1 - axis]
        edges = np.array([0.0, size[axis] - breadth])
        _fill(painter, _boxes(axis, edges, 0, breadth, length), ink)


class Background:
    """The grid, opaque, behind a drawing.

    A view that is new is painted at once, where it is seen. A picture of it is made as soon as a
    part of the same view is painted again: most views of a push or a zoom are seen once.
    """

    def __init__(self) -> None:
        self._view: _View | None = None
        self._pixmap = QPixmap()
        self._is_drawn = False

    def look(
        self, camera: Camera, palette: Palette, ratio: float, step: Step, with_grid: bool
    ) -> None:
        """Go over to a view.

        Parameters
        ----------
        camera, palette
            The view, and its colours.
        ratio
            Device pixels per logical pixel.
        step
            Distance of the lines.
        with_grid
            Whether there is a grid at all.
        """
        view = _View(camera, palette, ratio, step, with_grid)
        self._is_drawn &= view == self._view
        self._view = view

    def paint(self, painter: QPainter, is_whole: bool) -> None:
        """Paint it for the region that the painter is cut to; ``is_whole`` if that is all of it."""
        view = self._view
        if view is None:
            return
        if is_whole and not self._is_drawn:
            view.paint(painter)
            return
        if not self._is_drawn:
            wide, high = view.size
            if (self._pixmap.width(), self._pixmap.height()) != (wide, high):
                self._pixmap = QPixmap(wide, high)
            self._pixmap.setDevicePixelRatio(view.ratio)
            with QPainter(self._pixmap) as inner:
                view.paint(inner)
            self._is_drawn = True
        painter.drawPixmap(0, 0, self._pixmap)


class _View(NamedTuple):
    """What a background shows, as `Background.look` is told it."""

    camera: Camera
    palette: Palette
    ratio: float
    step: Step
    with_grid: bool

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in device pixels."""
        return round(self.camera.width * self.ratio), round(self.camera.height * self.ratio)

    def paint(self, painter: QPainter) -> None:
        """Draw it."""
        wide, high = self.size
        # Upright lines are the same in all rows: rows are copied faster than columns drawn.
        strip = QPixmap(wide, STRIP)
        strip.setDevicePixelRatio(self.ratio)
        strip.fill(color(self.palette.background))
        if self.with_grid:
            with QPainter(strip) as inner:
                paint_grid(inner, self.camera, self.palette, self.step, 0)
        # Tiled as it is, pixel by pixel: on a screen of two pixels it would be scaled.
        strip.setDevicePixelRatio(1.0)
        painter.save()
        painter.scale(1 / self.ratio, 1 / self.ratio)
        painter.drawTiledPixmap(QRectF(0, 0, wide, high), strip)
        painter.restore()
        if self.with_grid:
            paint_grid(painter, self.camera, self.palette, self.step, 1)


def has_room(axis: int, place: float, width: float) -> bool:
    """Whether a label of a width, at a tick, keeps out of the corner of the two rulers."""
    start = place + LABEL_INDENT_PX if axis == 0 else place - LABEL_INDENT_PX - width
    return start >= SIZES.ruler


def _axis_pixels(
    camera: Camera, axis: int, places_mm: NDArray[np.float64]
) -> NDArray[np.float64]:
    points = np.zeros((len(places_mm), 2))
    points[:, axis] = places_mm
    return camera.to_pixels(points)[:, axis]


def _boxes(
    axis: int, along: NDArray[np.float64], across: float, length: float, breadth: float
) -> NDArray[np.float64]:
    """Equal rectangles at some places along the ruler of an axis: left, top, width, height."""
    boxes = np.empty((len(along), 4))
    boxes[:, axis], boxes[:, 1 - axis] = along, across
    boxes[:, 2 + axis], boxes[:, 3 - axis] = length, breadth
    return boxes


def _rule(
    painter: QPainter,
    axis: int,
    places: NDArray[np.float64],
    begin: float,
    end: float,
    ink: QColor,
) -> None:
    """Draw lines across an axis that cover whole device pixels, so that they are crisp."""
    ratio = painter.device().devicePixelRatioF()
    breadth = round(ratio) / ratio
    crisp = np.floor(places * ratio) / ratio
    _fill(painter, _boxes(axis, crisp, begin, breadth, end - begin), ink)


def _fill(painter: QPainter, boxes: NDArray[np.float64], ink: QColor) -> None:
    """Fill rectangles, shape (k, 4), without a border.

    `QPainter.fillRect` takes gradients too, and to learn about those before it first fills with a
    colour takes PySide 1.4 ms of the first paint.
    """
    if not len(boxes):
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(ink)
    # Four floats in a row are what Qt's rectangles are. A frame has a thousand of them, and Python
    # would take longer to make each than Qt to fill it.
    first: QRectF = wrapInstance(boxes.ctypes.data, QRectF)  # type: ignore[assignment]
    painter.drawRects(first, len(boxes))
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _write_labels(
    painter: QPainter, axis: int, places: list[float], labels: list[str]
) -> None:
    """Write numbers beside their ticks, if they have room; on the left ruler they read upwards."""
    metrics = QFontMetricsF(painter.font())
    painter.save()
    if axis == 1:
        painter.rotate(-90)
    for place, text in zip(places, labels, strict=True):
        # The corner is in the way of the first ones only.
        if place > _CORNER_PX or has_room(axis, place, metrics.horizontalAdvance(text)):
            along = place + LABEL_INDENT_PX if axis == 0 else LABEL_INDENT_PX - place
            painter.drawStaticText(QPointF(along, 1.0), _label(text))
    painter.restore()


@lru_cache(maxsize=512)
def _label(text: str) -> QStaticText:
    """A number, laid out once: while the paper is pushed most of them are seen again."""
    label = QStaticText(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    return label
