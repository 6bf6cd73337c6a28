"""What is painted on the sheet, thing by thing: where it is, and where it differs from another.

Definitions
-----------
The *box* of a thing is a rectangle in logical pixels (left, top, right, bottom), outside of which
it leaves no ink; pens and the pixels that edges are smoothed over are within it. A thing that is
painted for a region leaves, inside the region, the ink that it would leave if all of it were
painted; outside it may leave less.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Final, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QPainter, QPainterPath, QPen

from app.line import Line
from app.pixel_box import SMOOTHED_PX, Box, around, gathered, meeting
from app.polyline import area_within_square, point_of, polygon_of
from app.style import Palette, color

_SIMPLE: Final = 96
"""Vertices of a line up to which all of it is drawn: to choose what is seen would cost more."""


class Ink(Protocol):
    """A thing on the sheet; two of a kind that are equal leave the same ink."""

    @property
    def box(self) -> Box:
        """Where it is."""

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        """Paint at least what is seen of it in a region: rectangles, shape (r, 4)."""

    def unlike(self, other: Ink) -> list[Box]:
        """Boxes, outside of which this thing and another one of its place leave the same ink."""


def both(one: Ink, other: Ink) -> list[Box]:
    """Boxes of two things; none if they leave the same ink."""
    return [] if type(one) is type(other) and one == other else [one.box, other.box]


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line drawn with a solid pen.

    The pen's caps are round, so that the pieces of a line meet. Its joins are bevelled: at the
    blunt corners of a curve's chords Qt's round joins blacken single pixels where the curve runs
    level (measured: coverage off by 0.53, bevelled or mitred by 0.38), and mitred ones take two
    thirds more time for the same pixels.
    """

    line: Line
    colour: str
    width: float
    opacity: float = 1.0

    @property
    def reach(self) -> float:
        """How far from its middle the pen leaves ink."""
        return self.width / 2 + SMOOTHED_PX

    @cached_property
    def box(self) -> Box:
        places = self.line.vertices.T
        return around(np.concatenate([places, places]), self.reach)

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, Stroke) or self._pen != other._pen:
            return [self.box, other.box]
        if self.line is other.line:
            return []
        mine, others = self.line.own(other.line)
        parts = np.concatenate([self.line.boxes[:, mine], other.line.boxes[:, others]], axis=1)
        return gathered(parts, self.reach)

    @property
    def _pen(self) -> tuple[str, float, float]:
        return self.colour, self.width, self.opacity

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        line = self.line
        if len(line.t) <= _SIMPLE:
            painter.setPen(_pen(*self._pen))
            for polygon, is_loop in line.polygons:
                (painter.drawPolygon if is_loop else painter.drawPolyline)(polygon)
            return
        # Thin pens round otherwise where a segment has a cap: all have their neighbours.
        chosen = line.heads[line.widened(meeting(line.boxes, region, self.reach))]
        if not len(chosen):
            return
        painter.setPen(_pen(*self._pen))
        is_gap = chosen[1:] > chosen[:-1] + 1
        firsts = np.append(chosen[:1], chosen[1:][is_gap])
        lasts = np.append(chosen[:-1][is_gap], chosen[-1:]) + 1
        pieces = np.searchsorted(line.starts, firsts, "right") - 1
        edges = (np.flatnonzero(pieces[1:] > pieces[:-1]) + 1).tolist()
        for low, high in pairwise([0, *edges, len(pieces)]):
            piece = int(pieces[low])
            start, end = int(line.starts[piece]), int(line.starts[piece + 1]) - 1
            _stroke(painter, line.vertices, start, end, firsts[low:high], lasts[low:high])


@dataclass(frozen=True, eq=False)
class Area:
    """A filled outline, such as a ribbon of influence."""

    outline: NDArray[np.float64]
    colour: str
    opacity: float

    @cached_property
    def box(self) -> Box:
        return around(np.concatenate([self.outline.T, self.outline.T]), SMOOTHED_PX)

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, Area) or self._look != other._look:
            return [self.box, other.box]
        return [] if np.array_equal(self.outline, other.outline) else [self.box, other.box]

    @property
    def _look(self) -> tuple[str, float]:
        return self.colour, self.opacity

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        outline = area_within_square(self.outline)
        if not len(outline):
            return
        # As a polygon it would take twice the time.
        path = QPainterPath()
        path.addPolygon(polygon_of(outline))
        path.closeSubpath()
        path.setFillRule(Qt.FillRule.WindingFill)
        painter.fillPath(path, color(self.colour, self.opacity))


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

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
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

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        left, top, right, bottom = self.ground
        box = QRectF(left, top, right - left, bottom - top)
        painter.setFont(self.font)
        painter.setPen(QPen(color(self.palette.ruler_line), 1.0))
        painter.setBrush(color(self.palette.ruler_background, 0.94))
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(color(self.colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.text)


def _stroke(
    painter: QPainter,
    vertices: NDArray[np.float64],
    start: int,
    end: int,
    firsts: NDArray[np.intp],
    lasts: NDArray[np.intp],
) -> None:
    """Draw stretches ``first`` to ``last`` of the piece from ``start`` to ``end``, as one path."""
    is_loop = bool((vertices[start] == vertices[end]).all())
    if is_loop and firsts[0] == start and lasts[-1] == end:
        # A thin pen's ink depends, in the last bit, on the order of the segments: the seam is kept.
        painter.drawPolygon(polygon_of(vertices[start:end]))
        return
    stretches = [vertices[a : b + 1] for a, b in zip(firsts, lasts, strict=True)]
    if len(stretches) == 1:
        painter.drawPolyline(polygon_of(stretches[0]))
        return
    path = QPainterPath()
    for stretch in stretches:
        path.addPolygon(polygon_of(stretch))
    painter.drawPath(path)


def _point(x: float, y: float) -> QPointF:
    return point_of(np.array([x, y]))


@lru_cache(maxsize=32)
def _pen(colour: str, width: float, opacity: float) -> QPen:
    return QPen(
        color(colour, opacity), width, Qt.PenStyle.SolidLine,
        Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.BevelJoin,
    )  # fmt: skip
