"""What is painted on the sheet, thing by thing: where it is, and where it differs from another.

Definitions
-----------
The *box* of a thing is a rectangle in logical pixels (left, top, right, bottom), outside of which
it leaves no ink; pens and the pixels that edges are smoothed over are within it. A thing that is
painted for a region leaves, inside the region, the ink that it would leave if all of it were
painted; outside it may leave less.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple, Protocol

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QFont, QPainter, QPainterPath, QPen, QPolygonF

from app.line import Line
from app.outline import path_of
from app.pixel_box import SMOOTHED_PX, Box
from app.polyline import point_of
from app.style import Palette, color
from core.extreme import largest


class Ink(Protocol):
    """A thing on the sheet; two of a kind that are equal leave the same ink."""

    @property
    def box(self) -> Box:
        """Where it is."""

    def paint(self, painter: QPainter, seen: Box) -> None:
        """Paint at least what is seen of it in a box."""

    def unlike(self, other: Ink) -> list[Box]:
        """Boxes, outside of which this thing and another one of its place leave the same ink."""


def both(one: Ink, other: Ink) -> list[Box]:
    """Boxes of two things; none if they leave the same ink."""
    return [] if type(one) is type(other) and one == other else [one.box, other.box]


class Stroke:
    """A line in one colour, as broad as it says itself or as a pen.

    Parameters
    ----------
    line
        Its middle.
    colour, opacity
        What it is drawn with.
    width
        Breadth of the pen, in logical pixels; of a line with a breadth of its own, none.
    is_thin
        Whether the pen is at most a device pixel wide: Qt draws such lines by a way of its own,
        several times faster than it fills them.

    Attributes
    ----------
    box
        Where it is.
    reach
        How far from its middle it leaves ink.
    """

    def __init__(
        self, line: Line, colour: str, width: float, opacity: float = 1.0, is_thin: bool = False
    ) -> None:
        self.line, self.is_thin = line, is_thin
        self.colour, self.width, self.opacity = colour, width, opacity
        half = width / 2 if line.halves is None else largest(line.halves)
        self.reach = reach = half + SMOOTHED_PX
        left, top, right, bottom = line.box
        self.box: Box = left - reach, top - reach, right + reach, bottom + reach
        self._look = colour, width, opacity, is_thin, line.halves is None
        self._paths: dict[int, QPainterPath] = {}
        self._polygons: dict[int, tuple[QPolygonF, bool]] = {}

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, Stroke) or self._look != other._look:
            return [self.box, other.box]
        if self.line is other.line:
            return []
        return self.line.unlike(other.line, max(self.reach, other.reach), self.is_thin)

    def paint(self, painter: QPainter, seen: Box) -> None:
        near = self.line.near(seen, self.reach)
        if self.is_thin:
            painter.setPen(_pen(self.colour, self.width, self.opacity))
            for piece in near:
                if piece not in self._polygons:
                    self._polygons[piece] = self.line.polygon(piece)
                polygon, is_loop = self._polygons[piece]
                (painter.drawPolygon if is_loop else painter.drawPolyline)(polygon)
            return
        ink = _brush(self.colour, self.opacity)
        line, half = self.line, self.width / 2
        for piece in near:
            parts = line.parts(piece, seen, self.reach)
            if parts is not None:
                # One path, in which no place is covered twice where two parts cross.
                painter.fillPath(path_of(*(line.outline_along(part, half) for part in parts)), ink)
                continue
            if piece not in self._paths:
                self._paths[piece] = path_of(line.outline(piece, half))
            painter.fillPath(self._paths[piece], ink)


class Band(NamedTuple):
    """A rubber band: a rectangle with a border."""

    left: float
    top: float
    right: float
    bottom: float
    colour: str

    @property
    def box(self) -> Box:
        pad = 1.0 + SMOOTHED_PX
        return self.left - pad, self.top - pad, self.right + pad, self.bottom + pad

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, Band) or self.colour != other.colour:
            return [self.box, other.box]
        if self == other:
            return []
        # Between the two left sides, the two right ones, and so on; within both nothing differs.
        pad, one, two = 1.0 + SMOOTHED_PX, self.box, other.box
        low = min(one[0], two[0]), min(one[1], two[1])
        high = max(one[2], two[2]), max(one[3], two[3])
        left, right = max(one[0], two[0]) + 2 * pad, min(one[2], two[2]) - 2 * pad
        top, bottom = max(one[1], two[1]) + 2 * pad, min(one[3], two[3]) - 2 * pad
        if left >= right or top >= bottom:
            return [(*low, *high)]
        return [
            (low[0], low[1], left, high[1]), (right, low[1], high[0], high[1]),
            (low[0], low[1], high[0], top), (low[0], bottom, high[0], high[1]),
        ]  # fmt: skip

    def paint(self, painter: QPainter, seen: Box) -> None:
        box = QRectF(_point(self.left, self.top), _point(self.right, self.bottom))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.fillRect(box, color(self.colour, 0.10))
        painter.setPen(QPen(color(self.colour), 1.0))
        painter.drawRect(box)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)


class Words(NamedTuple):
    """A few words on a ground of their own.

    Attributes
    ----------
    text, font
        What is written, and how.
    ground
        The box around it.
    colour, palette
        Colour of the words, and those of their ground.
    """

    text: str
    font: QFont
    ground: Box
    colour: str
    palette: Palette

    @property
    def box(self) -> Box:
        left, top, right, bottom = self.ground
        return left - SMOOTHED_PX, top - SMOOTHED_PX, right + SMOOTHED_PX, bottom + SMOOTHED_PX

    def unlike(self, other: Ink) -> list[Box]:
        return both(self, other)

    def paint(self, painter: QPainter, seen: Box) -> None:
        left, top, right, bottom = self.ground
        box = QRectF(left, top, right - left, bottom - top)
        painter.setFont(self.font)
        painter.setPen(QPen(color(self.palette.ruler_line), 1.0))
        painter.setBrush(color(self.palette.ruler_background, 0.94))
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(color(self.colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.text)


def _point(x: float, y: float) -> QPointF:
    return point_of(np.array([x, y]))


@lru_cache(maxsize=32)
def _pen(colour: str, width: float, opacity: float) -> QPen:
    return QPen(
        color(colour, opacity), width, Qt.PenStyle.SolidLine,
        Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.BevelJoin,
    )  # fmt: skip


@lru_cache(maxsize=32)
def _brush(colour: str, opacity: float) -> QBrush:
    # To make one of a colour at once, PySide learns about gradients: 1.9 ms of the first paint.
    brush = QBrush()
    brush.setStyle(Qt.BrushStyle.SolidPattern)
    brush.setColor(color(colour, opacity))
    return brush
