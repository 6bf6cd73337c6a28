"""Signs of control points, and of what the mouse would take: small things in great numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPen, QPixmap

from app.ink import Ink, both
from app.pixel_box import SMOOTHED_PX, Box, apart, around, meeting
from app.polyline import point_of, polygon_of
from app.style import SIZES, color
from core.extreme import same

_RING_GAP: Final = 3.5
"""Radius of the hover ring beyond that of the point, in pixels."""

_RING_WIDTH: Final = 3.0
"""Pen of the hover ring."""


@dataclass(eq=False)
class _Points:
    """Signs of some control points.

    Attributes
    ----------
    names, places
        Rising indices of the points, and their pixels: shapes (h,) and (h, 2).
    """

    names: NDArray[np.intp]
    places: NDArray[np.float64]

    @property
    def look(self) -> tuple[object, ...]:
        """All that tells these signs from others, except where they are."""
        raise NotImplementedError

    @property
    def reach(self) -> float:
        """Half of a sign's size."""
        raise NotImplementedError

    @cached_property
    def box(self) -> Box:
        return around(self.places, self.reach)

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, _Points) or self.look != other.look:
            return [self.box, other.box]
        if same(self.names, other.names):
            differ = self.places != other.places
            own = (differ[:, 0] | differ[:, 1]).nonzero()[0]
            return apart((self.places, other.places), own, 0, self.reach)
        # Both name the points in rising order, in which those of both are painted.
        mine, lone = np.ones(len(self.names), bool), np.ones(len(other.names), bool)
        _, one, two = np.intersect1d(
            self.names, other.names, assume_unique=True, return_indices=True
        )
        mine[one] = lone[two] = (self.places[one] != other.places[two]).any(axis=1)
        return [*apart((self.places,), mine.nonzero()[0], 0, self.reach),
                *apart((other.places,), lone.nonzero()[0], 0, self.reach)]  # fmt: skip


@dataclass(eq=False)
class Handles(_Points):
    """Control points as small discs with a rim, on whole device pixels, so that they are crisp."""

    rim: str
    fill: str
    radius: float
    ratio: float

    @property
    def look(self) -> tuple[object, ...]:
        return self.rim, self.fill, self.radius, self.ratio

    @property
    def reach(self) -> float:
        # Half of the picture, the way to whole pixels, and what smoothing adds.
        return self.radius + SIZES.rim_width + 1.0 + SMOOTHED_PX

    def paint(self, painter: QPainter, seen: Box) -> None:
        places = self.places[meeting(self.places, seen, self.reach)]
        pixmap = _disc(self.rim, 1.0, SIZES.rim_width, self.fill, self.radius, self.ratio)
        _stamp(painter, pixmap, places)


@dataclass(eq=False)
class Dots(_Points):
    """Control points in a crowd."""

    colour: str

    @property
    def look(self) -> tuple[object, ...]:
        return (self.colour,)

    @property
    def reach(self) -> float:
        return SIZES.dot_radius + SMOOTHED_PX

    def paint(self, painter: QPainter, seen: Box) -> None:
        places = self.places[meeting(self.places, seen, self.reach)]
        painter.setPen(QPen(color(self.colour), 2 * SIZES.dot_radius))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.drawPoints(polygon_of(places))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)


class Ring(NamedTuple):
    """A ring around the control point that a press would take, on whole device pixels as it is."""

    x: float
    y: float
    colour: str
    ratio: float

    @property
    def box(self) -> Box:
        # Half of the picture, and the way to whole pixels.
        return _square(self.x, self.y, SIZES.point_radius + _RING_GAP + _RING_WIDTH / 2 + 1.5)

    def unlike(self, other: Ink) -> list[Box]:
        return both(self, other)

    def paint(self, painter: QPainter, seen: Box) -> None:
        radius = SIZES.point_radius + _RING_GAP
        pixmap = _disc(self.colour, 0.35, _RING_WIDTH, None, radius, self.ratio)
        _stamp(painter, pixmap, np.array([[self.x, self.y]]))


class Grip(NamedTuple):
    """A bead on the curve where a press would take it."""

    x: float
    y: float
    colour: str
    rim: str

    @property
    def box(self) -> Box:
        return _square(self.x, self.y, SIZES.selected_radius + SIZES.rim_width / 2)

    def unlike(self, other: Ink) -> list[Box]:
        return both(self, other)

    def paint(self, painter: QPainter, seen: Box) -> None:
        radius = SIZES.selected_radius
        painter.setPen(QPen(color(self.rim), SIZES.rim_width))
        painter.setBrush(color(self.colour))
        painter.drawEllipse(point_of(np.array([self.x, self.y])), radius, radius)
        painter.setBrush(Qt.BrushStyle.NoBrush)


def _square(x: float, y: float, reach: float) -> Box:
    reach += SMOOTHED_PX
    return x - reach, y - reach, x + reach, y + reach


def _stamp(painter: QPainter, pixmap: QPixmap, places: NDArray[np.float64]) -> None:
    """Put a picture's middle on some places, and its corner on whole device pixels."""
    ratio = pixmap.devicePixelRatioF()
    corners = np.rint((places - pixmap.width() / ratio / 2) * ratio) / ratio
    for x, y in corners.tolist():
        painter.drawPixmap(QPointF(x, y), pixmap)


@lru_cache(maxsize=32)
def _disc(
    rim: str, opacity: float, width: float, fill: str | None, radius: float, ratio: float
) -> QPixmap:
    """Picture of a disc, or of a ring, drawn once for each colour, size and screen."""
    side = 2 * int(np.ceil(radius + width)) + 1
    pixmap = QPixmap(round(side * ratio), round(side * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(color(rim, opacity), width))
        if fill is not None:
            painter.setBrush(color(fill))
        middle = side / 2
        painter.drawEllipse(QPointF(middle, middle), radius, radius)
    return pixmap
