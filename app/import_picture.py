"""The picture of an import: the lines of a file, and over them the curves that they become."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QPen

from app.camera import Camera
from app.export_paths import painter_paths
from app.style import Palette, color
from core.beziers import Beziers
from core.document import Document
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats.sketch import Sketch
from core.polytope import Cancelled

Shape = Beziers | Polyline

FILE_WIDTH_PX: Final = 4.0
"""A band, so that a curve that leaves its middle is seen to do so."""

FILE_OPACITY: Final = 0.6
CURVE_WIDTH_PX: Final = 1.6
POINT_RADIUS_PX: Final = 2.6

MOST_POINTS: Final = 4_000
"""Number of control points up to which they are marked; more would cover the drawing."""

MANY: Final = 5_000
"""Pieces of a contour beyond which those that fall on the same half pixel are drawn as one."""

FINEST_LEVEL: Final = 6
"""Dyadic level of the points that curves are drawn by: 64 chords a span."""

MOST_CHORDS: Final = 400_000
"""Chords of all curves together; long drawings are drawn by fewer to a span."""


@dataclass(frozen=True, eq=False)
class Sight:
    """What a preview shows, in millimetres.

    Attributes
    ----------
    file
        The contours of the file.
    curves
        What they become.
    points
        Control points of the curves, shape (n, 2).
    low, high
        Box of the contours of the file.
    """

    file: Sequence[Shape]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    curves: Sequence[Shape] = ()
    points: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 2)))


def sight_of(sketch: Sketch, document: Document | None = None) -> Sight:
    """What there is to be seen of a sketch, and of the drawing that it becomes."""
    file = [Beziers(trace.controls, trace.closed, False, 0.0) for trace in sketch.traces]
    if document is None:
        return Sight(file, sketch.low, sketch.high)
    curves: list[Shape] = []
    total = sum(curve.count for curve in document.curves)
    level = FINEST_LEVEL
    while level > 0 and total << level > MOST_CHORDS:
        level -= 1
    for curve in document.curves:
        if curve.count < 2:
            continue
        try:
            points = curve.limit(document.parameters).points(level)
        except NinepointError:  # no limit: the points alone say what there will be
            continue
        curves.append(Polyline(points, False, 0.0))
    points = np.concatenate([np.zeros((0, 2)), *(curve.points for curve in document.curves)])
    return Sight(file, sketch.low, sketch.high, curves, points)


def painted(
    sight: Sight, camera: Camera, ratio: float, palette: Palette, cancelled: Cancelled
) -> QImage:
    """Picture of a sight; half done if it is cancelled."""
    size = QSize(camera.width, camera.height) * ratio
    image = QImage(size, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(color(palette.background))
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for shapes, pen in (
            (sight.file, file_pen(palette)),
            (sight.curves, curve_pen(palette)),
        ):
            painter.setPen(pen)
            for shape in shapes:
                for path in painter_paths(
                    _light(shape, camera.scale), camera.to_mm((0.0, 0.0)), camera.scale
                ):
                    if cancelled():
                        return image
                    painter.drawPath(path)
        if len(sight.points) <= MOST_POINTS:
            painter.setPen(QPen(color(palette.accent), 1.0))
            painter.setBrush(color(palette.point_fill))
            for place in _in_view(sight.points, camera):
                painter.drawEllipse(QPointF(*place), POINT_RADIUS_PX, POINT_RADIUS_PX)
    return image


def _light(shape: Shape, scale: float) -> Shape:
    """The same at this scale, with fewer pieces if they are many."""
    if isinstance(shape, Beziers):
        if len(shape.controls) <= MANY:
            return shape
        vertices = np.concatenate([shape.controls[:, 0], shape.controls[-1:, 3]])
    else:
        if len(shape.points) <= MANY:
            return shape
        vertices = shape.points
    steps = np.diff(np.rint(vertices * (2 * scale)), axis=0)
    keep = np.concatenate([[True], steps.any(axis=1)])
    keep[-1] = True
    return Polyline(vertices[keep], False, 0.0)


def _in_view(points_mm: NDArray[np.float64], camera: Camera) -> Iterator[tuple[float, float]]:
    """Pixels of the points that are in view."""
    places = camera.to_pixels(points_mm)
    room = POINT_RADIUS_PX + 1
    far = np.array([camera.width, camera.height]) + room
    seen = ((places >= -room) & (places <= far)).all(axis=1)
    yield from places[seen].tolist()


def file_pen(palette: Palette) -> QPen:
    """What the lines of the file are drawn with."""
    return _round(QPen(color(palette.curve, FILE_OPACITY), FILE_WIDTH_PX))


def curve_pen(palette: Palette) -> QPen:
    """What the curves are drawn with."""
    return _round(QPen(color(palette.accent), CURVE_WIDTH_PX))


def _round(pen: QPen) -> QPen:
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    return pen
