"""Background of the canvas: grid and rulers in millimetres, with ticks at 1, 2 or 5 times 10^k."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen, QPixmap

from app.camera import Camera
from app.style import SIZES, Palette, color

LABEL_POINTS: Final = 7.5
"""Size of the numbers on the rulers, in typographic points."""

LABEL_GAP_PX: Final = 14.0
"""Least room between two numbers on a ruler."""

_MINOR: Final = {1: (10, 5, 2), 2: (4, 2), 5: (5,)}
"""Parts that a step of 1, 2 or 5 may be cut into, so that the small steps are round as well."""


@dataclass(frozen=True)
class Step:
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


def paint_grid(painter: QPainter, camera: Camera, palette: Palette, step: Step) -> None:
    """Draw the lines of the grid; those through the origin are the axes."""
    low, high = camera.rectangle_mm()
    ratio = painter.device().devicePixelRatioF()
    for axis in (0, 1):
        minor, major = ticks(float(low[axis]), float(high[axis]), step)
        labelled = np.array(major) * step.size_mm
        for places, name in ((minor, palette.grid), (labelled, palette.grid_major)):
            painter.setPen(_hairline(name))
            _lines(painter, camera, axis, places, ratio)
        if low[axis] <= 0 <= high[axis]:
            painter.setPen(_hairline(palette.axis, 0.55))
            _lines(painter, camera, axis, np.zeros(1), ratio)


def paint_rulers(painter: QPainter, camera: Camera, palette: Palette, step: Step) -> None:
    """Draw the rulers along the upper and the left edge, with the unit in the corner."""
    low, high = camera.rectangle_mm()
    breadth = SIZES.ruler
    painter.fillRect(QRectF(0, 0, camera.width, breadth), color(palette.ruler_background))
    painter.fillRect(QRectF(0, 0, breadth, camera.height), color(palette.ruler_background))
    font = ruler_font(painter.font())
    painter.setFont(font)
    ratio = painter.device().devicePixelRatioF()
    for axis in (0, 1):
        minor, major = ticks(float(low[axis]), float(high[axis]), step)
        painter.setPen(_hairline(palette.ruler_line))
        for place in _crisp(_axis_pixels(camera, axis, minor), ratio):
            _ruler_line(painter, axis, place, breadth - 5.0, breadth)
        for count in major:
            place = _axis_pixels(camera, axis, np.array([count * step.size_mm]))
            at = float(_crisp(place, ratio)[0])
            painter.setPen(_hairline(palette.ruler_line))
            _ruler_line(painter, axis, at, breadth - 12.0, breadth)
            painter.setPen(color(palette.ruler_text))
            _ruler_label(painter, axis, at, step.label(count))
    painter.setPen(_hairline(palette.ruler_line))
    edge = float(_crisp(np.array([breadth - 1.0]), ratio)[0])
    painter.drawLine(QPointF(breadth, edge), QPointF(camera.width, edge))
    painter.drawLine(QPointF(edge, breadth), QPointF(edge, camera.height))
    corner = QRectF(0, 0, breadth, breadth)
    painter.fillRect(corner, color(palette.ruler_background))
    painter.setPen(color(palette.ruler_text))
    painter.drawText(corner, Qt.AlignmentFlag.AlignCenter, "mm")


class Background:
    """Grid and rulers as one opaque picture, drawn again only when the view changes."""

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._pixmap = QPixmap()

    def pixmap(
        self, camera: Camera, palette: Palette, ratio: float, font: QFont, with_grid: bool
    ) -> QPixmap:
        """Return the picture for a view.

        Parameters
        ----------
        camera, palette
            The view, and its colours.
        ratio
            Device pixels per logical pixel.
        font
            Font of the canvas; the rulers have a small one of its family.
        with_grid
            Whether the grid is drawn; the rulers always are.
        """
        key = (camera, palette, ratio, font, with_grid)
        if key != self._key:
            self._key = key
            self._pixmap = QPixmap(round(camera.width * ratio), round(camera.height * ratio))
            self._pixmap.setDevicePixelRatio(ratio)
            self._pixmap.fill(color(palette.background))
            step = view_step(camera, QFontMetricsF(ruler_font(font)))
            with QPainter(self._pixmap) as painter:
                painter.setFont(font)
                if with_grid:
                    paint_grid(painter, camera, palette, step)
                paint_rulers(painter, camera, palette, step)
        return self._pixmap


def _hairline(name: str, opacity: float = 1.0) -> QPen:
    """Line of one device-independent pixel."""
    return QPen(color(name, opacity), 1.0)


def _axis_pixels(
    camera: Camera, axis: int, places_mm: NDArray[np.float64]
) -> NDArray[np.float64]:
    points = np.zeros((len(places_mm), 2))
    points[:, axis] = places_mm
    return camera.to_pixels(points)[:, axis]


def _crisp(places_px: NDArray[np.float64], ratio: float) -> NDArray[np.float64]:
    """Nearest places where a line one logical pixel wide covers whole device pixels."""
    shift = 0.5 * round(ratio) / ratio
    return np.asarray(np.floor(places_px * ratio) / ratio + shift)


def _lines(
    painter: QPainter, camera: Camera, axis: int, places: NDArray[np.float64], ratio: float
) -> None:
    for place in _crisp(_axis_pixels(camera, axis, places), ratio):
        if axis == 0:
            painter.drawLine(QPointF(place, 0), QPointF(place, camera.height))
        else:
            painter.drawLine(QPointF(0, place), QPointF(camera.width, place))


def _ruler_line(painter: QPainter, axis: int, place: float, begin: float, end: float) -> None:
    if axis == 0:
        painter.drawLine(QPointF(place, begin), QPointF(place, end))
    else:
        painter.drawLine(QPointF(begin, place), QPointF(end, place))


def _ruler_label(painter: QPainter, axis: int, place: float, text: str) -> None:
    """Write a number beside its tick; on the left ruler it reads upwards."""
    flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextDontClip
    box = QRectF(3, 1, 1, 1)
    painter.save()
    if axis == 0:
        painter.translate(place, 1)
    else:
        painter.translate(1, place)
        painter.rotate(-90)
    painter.drawText(box, int(flags), text)
    painter.restore()
