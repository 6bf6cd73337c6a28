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
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QPainter, QPainterPath, QPen, QPixmap

from app.line import Line
from app.polyline import area_within_square, point_of, polygon_of
from app.style import SIZES, Palette, color

Box = tuple[float, float, float, float]
"""Left, top, right, bottom, in logical pixels."""

SMOOTHED_PX: Final = 1.5
"""How far beyond its outline a shape may leave ink: smoothed edges, and rounding to pixels."""

MITRE: Final = 2.0
"""Widths of a pen that its mitred joins reach: Qt's miter limit."""

MOST_PARTS: Final = 8
"""Number of boxes that the difference of two things is told in."""

_RING_GAP: Final = 3.5
"""Radius of the hover ring beyond that of the point, in pixels."""

_RING_WIDTH: Final = 3.0
"""Pen of the hover ring."""


class Ink:
    """A thing on the sheet; two that are equal leave the same ink."""

    @property
    def box(self) -> Box:
        """Where it is."""
        raise NotImplementedError

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        """Paint at least what is seen of it in a region: rectangles, shape (r, 4)."""
        raise NotImplementedError

    def unlike(self, other: Ink) -> list[Box]:
        """Boxes, outside of which this thing and another one of its place leave the same ink."""
        return [] if self == other else [self.box, other.box]


@dataclass(frozen=True)
class Stroke(Ink):
    """A line drawn with a solid pen.

    The pen's caps are round, so that the pieces of a line meet. Its joins are mitred: at the blunt
    corners of a curve's chords Qt's round joins blacken single pixels where the curve runs level
    (measured: coverage off by 0.46, mitred by 0.21).
    """

    line: Line
    colour: str
    width: float
    opacity: float = 1.0

    @property
    def reach(self) -> float:
        """How far from its middle the pen leaves ink."""
        return MITRE * self.width + SMOOTHED_PX

    @cached_property
    def box(self) -> Box:
        return around(self.line.boxes, self.reach)

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
        met = meeting(line.boxes, region, self.reach)
        # Thin pens round otherwise where a segment has a cap: all have their neighbours.
        chosen = line.heads[met | met[line.neighbours].any(axis=0)]
        if not len(chosen):
            return
        painter.setPen(_pen(*self._pen))
        gaps = np.flatnonzero(np.diff(chosen) > 1) + 1
        firsts = chosen[np.concatenate([[0], gaps])]
        lasts = chosen[np.concatenate([gaps - 1, [len(chosen) - 1]])] + 1
        pieces = np.searchsorted(line.starts, firsts, "right") - 1
        edges = np.flatnonzero(np.diff(pieces, prepend=-1, append=-1))
        for low, high in pairwise(edges.tolist()):
            piece = int(pieces[low])
            start, end = int(line.starts[piece]), int(line.starts[piece + 1]) - 1
            _stroke(painter, line.vertices, start, end, firsts[low:high], lasts[low:high])


@dataclass(frozen=True, eq=False)
class Area(Ink):
    """A filled outline, such as a ribbon of influence."""

    outline: NDArray[np.float64]
    colour: str
    opacity: float

    @cached_property
    def box(self) -> Box:
        return around(np.concatenate([self.outline.T, self.outline.T]), SMOOTHED_PX)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Area)
            and (self.colour, self.opacity) == (other.colour, other.opacity)
            and np.array_equal(self.outline, other.outline)
        )

    __hash__ = None  # type: ignore[assignment]  # arrays have none

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        outline = area_within_square(self.outline)
        if not len(outline):
            return
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color(self.colour, self.opacity))
        painter.drawPolygon(polygon_of(outline), Qt.FillRule.WindingFill)
        painter.setBrush(Qt.BrushStyle.NoBrush)


@dataclass(frozen=True, eq=False)
class _Points(Ink):
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

    @property
    def box(self) -> Box:
        return around(self._boxes, self.reach)

    @cached_property
    def _boxes(self) -> NDArray[np.float64]:
        return np.concatenate([self.places.T, self.places.T])

    def unlike(self, other: Ink) -> list[Box]:
        if not isinstance(other, _Points) or self.look != other.look:
            return [self.box, other.box]
        if np.array_equal(self.names, other.names):
            own = others = (self.places != other.places).any(axis=1)
        else:
            # Both name the points in rising order, in which those of both are painted.
            own, others = np.ones(len(self.names), bool), np.ones(len(other.names), bool)
            _, one, two = np.intersect1d(
                self.names, other.names, assume_unique=True, return_indices=True
            )
            moved = (self.places[one] != other.places[two]).any(axis=1)
            own[one] = others[two] = moved
        boxes = [self._boxes[:, own], other._boxes[:, others]]
        return gathered(np.concatenate(boxes, axis=1), self.reach)


@dataclass(frozen=True, eq=False)
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

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        places = self.places[meeting(self._boxes, region, self.reach)]
        pixmap = _handle(self.rim, self.fill, self.radius, self.ratio)
        half = pixmap.width() / self.ratio / 2
        corners = np.rint((places - half) * self.ratio) / self.ratio
        for x, y in corners.tolist():
            painter.drawPixmap(QPointF(x, y), pixmap)


@dataclass(frozen=True, eq=False)
class Dots(_Points):
    """Control points in a crowd."""

    colour: str

    @property
    def look(self) -> tuple[object, ...]:
        return (self.colour,)

    @property
    def reach(self) -> float:
        return SIZES.dot_radius + SMOOTHED_PX

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        places = self.places[meeting(self._boxes, region, self.reach)]
        painter.setPen(QPen(color(self.colour), 2 * SIZES.dot_radius))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.drawPoints(polygon_of(places))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)


@dataclass(frozen=True)
class Ring(Ink):
    """A ring around the control point that a press would take."""

    x: float
    y: float
    colour: str

    @property
    def box(self) -> Box:
        return _square(self.x, self.y, SIZES.point_radius + _RING_GAP + _RING_WIDTH / 2)

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        radius = SIZES.point_radius + _RING_GAP
        painter.setPen(QPen(color(self.colour, 0.35), _RING_WIDTH))
        painter.drawEllipse(_point(self.x, self.y), radius, radius)


@dataclass(frozen=True)
class Grip(Ink):
    """A bead on the curve where a press would take it."""

    x: float
    y: float
    colour: str
    rim: str

    @property
    def box(self) -> Box:
        return _square(self.x, self.y, SIZES.selected_radius + SIZES.rim_width / 2)

    def paint(self, painter: QPainter, region: NDArray[np.float64]) -> None:
        radius = SIZES.selected_radius
        painter.setPen(QPen(color(self.rim), SIZES.rim_width))
        painter.setBrush(color(self.colour))
        painter.drawEllipse(_point(self.x, self.y), radius, radius)
        painter.setBrush(Qt.BrushStyle.NoBrush)


@dataclass(frozen=True)
class Band(Ink):
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


@dataclass(frozen=True, eq=False)
class Words(Ink):
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

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Words) and self._all == other._all

    __hash__ = None  # type: ignore[assignment]  # fonts have none

    @property
    def _all(self) -> tuple[object, ...]:
        return self.text, self.font, self.ground, self.colour, self.palette

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


def around(boxes: NDArray[np.float64], reach: float) -> Box:
    """Box around boxes, shape (4, k), and a margin; without any, a box that nothing meets."""
    if not boxes.shape[1]:
        return np.inf, np.inf, -np.inf, -np.inf
    left, top = (boxes[:2].min(axis=1) - reach).tolist()
    right, bottom = (boxes[2:].max(axis=1) + reach).tolist()
    return left, top, right, bottom


def meeting(
    boxes: NDArray[np.float64], region: NDArray[np.float64], reach: float
) -> NDArray[np.bool_]:
    """Which of some boxes, shape (4, k), with a margin, meet a region of rectangles, (r, 4)."""
    left, top, right, bottom = boxes
    found = np.zeros(boxes.shape[1], dtype=bool)
    for low_x, low_y, high_x, high_y in region:
        meets = (left <= high_x + reach) & (right >= low_x - reach)
        meets &= (top <= high_y + reach) & (bottom >= low_y - reach)
        found |= meets
    return found


def gathered(boxes: NDArray[np.float64], reach: float) -> list[Box]:
    """A few boxes that hold many, shape (4, k), with a margin; neighbours go together."""
    count = boxes.shape[1]
    if not count:
        return []
    parts = min(count, MOST_PARTS)
    firsts = np.arange(parts) * count // parts
    low = np.minimum.reduceat(boxes[:2], firsts, axis=1) - reach
    high = np.maximum.reduceat(boxes[2:], firsts, axis=1) + reach
    return [(a, b, c, d) for a, b, c, d in np.concatenate([low, high]).T.tolist()]


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


def _square(x: float, y: float, reach: float) -> Box:
    reach += SMOOTHED_PX
    return x - reach, y - reach, x + reach, y + reach


@lru_cache(maxsize=32)
def _pen(colour: str, width: float, opacity: float) -> QPen:
    return QPen(
        color(colour, opacity), width, Qt.PenStyle.SolidLine,
        Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.MiterJoin,
    )  # fmt: skip


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
