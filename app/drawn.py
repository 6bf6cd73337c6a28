"""A curve in pixels: as many vertices and handles as can be seen, whatever its size."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.camera import Camera
from app.compact import SHORT, Compact, Vertices
from app.crowd import LEAST_SPACING_PX, MOST_HANDLES, spacing
from app.figure import Figure
from app.line import Line, line_of, stride_of
from app.polyline import SNAPPED_PX, snapped
from core.document import Curve
from core.family import Parameters
from core.live import LiveCurve
from core.picking import nearest_place, nearest_point, points_within
from core.runs import Runs, counted
from core.view import view

if TYPE_CHECKING:
    from app.splice import Splice

TOLERANCE_PX: Final = 0.25 - SNAPPED_PX
"""Admitted distance between the curve and its chords, in device pixels. Their ends are snapped,
too, so that what is drawn is off by a quarter of one at most."""

REACH_PX: Final = 12.0
"""How far around the canvas curves and points are drawn: what their pens and handles cover."""

PUSH_SHARE: Final = 1 / 16
"""How far beyond that, as a share of the canvas, a curve is looked at while the paper is pushed:
the next views are then mostly the same vertices elsewhere."""

SHORT_VERTICES: Final = 512
"""Vertices up to which a short curve is drawn whole: at high zoom most would be out of view."""

SPLICED_FROM: Final = 72
"""Number of spans from which moves of a point are drawn by `app.splice`: four times its reach."""

_NOTHING: Final = Runs(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp), 0.0)

_NO_INDICES: Final = np.zeros(0, dtype=np.intp)


@dataclass(eq=False)
class Drawn:
    """A curve as it is drawn; nothing changes it, though to freeze it would take too long.

    Attributes
    ----------
    curve
        The curve of the document.
    scheme
        The scheme that draws it.
    figure
        What it is drawn from; it may stand for another curve meanwhile, `limit` calls it back.
    camera, ratio
        The view, and device pixels per logical pixel.
    outline, polygon
        Vertices of limit curve and control polygon, in pixels, the first ones snapped
        (`app.polyline`); a loop that is seen whole ends where it starts.
    shown
        Indices of the control points in view, shape (h,); None if they are too many, or too close
        together, to be shown.
    strides
        Distances in t of the cuts of outline and polygon, see `app.line.stride_of`.
    sight
        What it was made from, for other views nearby; None if it was made by a splice.
    splice
        How this one was made by a few moves; None if it was made from the levels of detail.
    """

    curve: Curve
    scheme: Parameters
    figure: Figure
    camera: Camera
    ratio: float
    outline: Runs
    polygon: Runs
    shown: NDArray[np.intp] | None
    strides: tuple[float, float]
    sight: Sight | None = None
    splice: Splice | None = None

    @property
    def parameters(self) -> NDArray[np.float64]:
        """Places t of the drawn vertices, shape (k,)."""
        return self.outline.parameters

    @property
    def vertices_px(self) -> NDArray[np.float64]:
        """The drawn vertices of the limit curve, shape (k, 2)."""
        return self.outline.vertices

    @property
    def starts(self) -> NDArray[np.intp]:
        """First vertex of each run of consecutive ones, and k."""
        return self.outline.starts

    @property
    def period(self) -> int:
        """Number of spans of a loop; 0 of an open curve."""
        return self.curve.count if self.curve.is_loop else 0

    @cached_property
    def outline_line(self) -> Line:
        """The parts of the limit curve that are seen, as they are stroked."""
        return line_of(self.outline, self.period, self.strides[0])

    @cached_property
    def polygon_line(self) -> Line:
        """The parts of the control polygon that are seen, as they are stroked."""
        return line_of(self.polygon, self.period, self.strides[1])

    @cached_property
    def box_px(self) -> NDArray[np.float64]:
        """Corners of what is drawn of it, shape (2, 2); empty, from inf to -inf, if nothing is."""
        parts = [self.outline.vertices, self.polygon.vertices]
        if self.curve.count == 1:
            parts.append(self.points_px)
        drawn = [part for part in parts if len(part)]
        if not drawn:
            return np.array([[np.inf, np.inf], [-np.inf, -np.inf]])
        # Vertices lie near what they stand for: to a quarter of a device pixel.
        low = np.min([part.min(axis=0) for part in drawn], axis=0) - 1.0
        return np.stack([low, np.max([part.max(axis=0) for part in drawn], axis=0) + 1.0])

    @property
    def limit(self) -> LiveCurve | None:
        """The limit curve, before `Figure.placed`; None when the scheme has none.

        It lives: use it at once.
        """
        return self.present().limit

    @cached_property
    def points_px(self) -> NDArray[np.float64]:
        """Pixels of all control points, shape (n, 2); made when asked for."""
        return self.camera.to_pixels(self.curve.points)

    @cached_property
    def handles_px(self) -> NDArray[np.float64]:
        """Pixels of the control points that are shown, shape (h, 2)."""
        if self._is_whole:
            return self.points_px
        return self.places_px(_NO_INDICES if self.shown is None else self.shown)

    @property
    def _is_whole(self) -> bool:
        """Whether all points of a short curve are shown."""
        return self.shown is not None and self.shown is _all(self.curve.count)

    def places_px(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """Pixels of some control points, shape (k, 2)."""
        if self._is_whole:
            return self.points_px[indices]
        return self.camera.to_pixels(self.curve.places(indices))

    def within(
        self, low_px: NDArray[np.float64], high_px: NDArray[np.float64], most: int | None = None
    ) -> NDArray[np.intp] | None:
        """Indices of the control points in a rectangle; None if there are more than ``most``."""
        low, high = self.camera.to_mm(np.stack([low_px, high_px]))
        return _within(self.present(), np.minimum(low, high), np.maximum(low, high), most)

    def nearest(self, pos_px: NDArray[np.float64], radius_px: float) -> NDArray[np.intp]:
        """Indices of control points among which the nearest one is, if any is within a radius."""
        figure = self.present()
        if self.curve.count <= SHORT or figure.polygon is None:
            return _all(self.curve.count)
        place, radius = self.camera.to_mm(pos_px), radius_px * self.camera.pixel_mm
        found = nearest_point(figure.polygon, place, radius, figure.placed)
        return _NO_INDICES if found is None else np.array([found[0]])

    def on_polygon(self, pos_px: NDArray[np.float64], radius_px: float) -> float | None:
        """Place near the mouse on the polygon: i at point i, linear along what looks straight."""
        polygon = self.present().polygon
        if polygon is None:
            return None
        radius = radius_px * self.camera.pixel_mm
        place = self.camera.to_mm(pos_px)
        found = nearest_place(polygon, place, radius, self.figure.placed)
        return None if found is None else found[0]

    def present(self) -> Figure:
        """The figure, called back to this curve; it lives: use it at once."""
        self.figure.follow(self.curve, self.scheme)
        return self.figure


class Sight(NamedTuple):
    """What is drawn of a curve, in mm: the same for all views of a scale within a rectangle.

    Attributes
    ----------
    low, high
        Corners of the rectangle.
    origin
        A place in it, that the vertices are told from.
    outline, polygon
        Vertices of limit curve and control polygon.
    strides
        As of `Drawn`.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    origin: NDArray[np.float64]
    outline: Runs
    polygon: Runs
    strides: tuple[float, float]


def traced(figure: Figure, camera: Camera, ratio: float, before: Drawn | None = None) -> Drawn:
    """Compute how the curve that a figure stands for is drawn.

    Parameters
    ----------
    figure
        The curve.
    camera
        The view.
    ratio
        Device pixels per logical pixel.
    before
        What was drawn before, of whatever curve; if it is the same one and the paper was only
        pushed, what was found then is mostly all that is needed.
    """
    low, high = seen_mm(camera)
    sight, is_pushed = None, False
    if before is not None and before.curve is figure.curve and before.scheme is figure.parameters:
        is_pushed = (before.camera.scale, before.ratio) == (camera.scale, ratio)
        known = before.sight if is_pushed else None
        if known is not None and (known.low <= low).all() and (known.high >= high).all():
            sight = known
    if sight is None:
        beyond = PUSH_SHARE * (high - low) if is_pushed else np.zeros(2)
        sight = _sight(figure, camera, ratio, low - beyond, high + beyond)
    centre, flip, middle = camera.frame
    # The centre goes first: far from the origin this keeps the digits.
    shift = (sight.origin - centre) * flip + middle
    outline = sight.outline
    return Drawn(
        figure.curve,
        figure.parameters,
        figure,
        camera,
        ratio,
        outline._replace(vertices=snapped(outline.vertices * flip + shift, ratio)),
        sight.polygon.carried(flip, shift),
        _shown(figure, camera, low, high),
        sight.strides,
        sight,
    )


def _sight(
    figure: Figure,
    camera: Camera,
    ratio: float,
    low: NDArray[np.float64],
    high: NDArray[np.float64],
) -> Sight:
    """Find what is drawn within a rectangle."""
    tolerance = TOLERANCE_PX / ratio * camera.pixel_mm
    limit, compact = figure.limit, figure.compact
    if limit is not None and limit.spans >= SPLICED_FROM:
        # Where a chord is cut, both halves of the tolerance may be needed.
        tolerance /= 2
    centre = camera.frame[0]
    outline = polygon = _NOTHING
    if compact is None or _meets(compact, low, high):
        short = None if compact is None else compact.vertices(tolerance)
        if short is not None and len(short[0]) <= SHORT_VERTICES:
            outline = _whole(short, centre, tolerance)
        elif limit is not None and limit.spans and figure.outline is not None:
            outline = view(figure.outline, low, high, tolerance, centre, placed=figure.placed)
        if compact is not None:
            polygon = _whole(compact.corners, centre, 0.0) if figure.curve.count > 1 else _NOTHING
        elif figure.polygon is not None:
            polygon = view(figure.polygon, low, high, tolerance, centre, placed=figure.placed)
    return Sight(low, high, centre, outline, polygon, (stride_of(outline), stride_of(polygon)))


@lru_cache(maxsize=4)
def seen_mm(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Corners of what is drawn: the canvas and what reaches into it; not to be written."""
    low, high = camera.rectangle_mm()
    reach = REACH_PX * camera.pixel_mm
    return low - reach, high + reach


def _meets(compact: Compact, low: NDArray[np.float64], high: NDArray[np.float64]) -> bool:
    """Whether a short curve may be seen in a rectangle."""
    left, bottom, right, top = compact.box
    return bool(left <= high[0] and bottom <= high[1] and right >= low[0] and top >= low[1])


def _whole(vertices: Vertices, centre: NDArray[np.float64], deviation: float) -> Runs:
    """All vertices of a curve as one run."""
    t, points = vertices
    return Runs(points - centre, t, counted(len(t))[1], deviation)


def _shown(
    figure: Figure, camera: Camera, low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.intp] | None:
    """Control points in view, unless their signs would only cover the curve."""
    compact, count = figure.compact, figure.curve.count
    if compact is not None and not _meets(compact, low, high):
        return _NO_INDICES
    if compact is not None and count >= 3:
        left, bottom, right, top = compact.box
        if left >= low[0] and bottom >= low[1] and right <= high[0] and top <= high[1]:
            hidden = compact.spacing * camera.scale < LEAST_SPACING_PX
            return None if hidden else _all(count)
    found = _within(figure, low, high, MOST_HANDLES)
    if found is None or len(found) < 3:
        return found
    apart_px = spacing(figure.curve.places(found)) * camera.scale
    return None if apart_px < LEAST_SPACING_PX else found


@lru_cache(maxsize=SHORT)
def _all(count: int) -> NDArray[np.intp]:
    """Indices of so many points, the same read-only array each time."""
    indices = np.arange(count)
    indices.flags.writeable = False
    return indices


def _within(
    figure: Figure, low: NDArray[np.float64], high: NDArray[np.float64], most: int | None
) -> NDArray[np.intp] | None:
    if figure.curve.count > SHORT and figure.polygon is not None:
        return points_within(figure.polygon, low, high, most, figure.placed)
    points = figure.curve.points
    return np.flatnonzero(((points >= low) & (points <= high)).all(axis=1))
