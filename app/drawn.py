"""A curve in pixels: as many vertices and handles as can be seen, whatever its size."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.camera import Camera
from app.figure import Figure
from core.detail import chord_profile, detailed, span_levels
from core.document import Curve
from core.limit import LimitCurve
from core.mask import Mask
from core.picking import points_within
from core.pyramid import Pyramid
from core.runs import Runs
from core.view import BUDGET, view

TOLERANCE_PX: Final = 0.25
"""Admitted distance between the curve and its drawn chords, in device pixels."""

FINITE_LEVEL: Final = 2
"""Dyadic level at which a curve is drawn that refinement does not bring to rest."""

MOST_HANDLES: Final = 2000
"""Number of control points in view beyond which they are not shown: they would be a blot."""

REACH_PX: Final = 12.0
"""How far around the canvas curves and points are drawn: what their pens and handles cover."""

_NO_INDICES: Final = np.zeros(0, dtype=np.intp)


@dataclass(frozen=True, eq=False)
class Drawn:
    """A curve as it is drawn.

    Attributes
    ----------
    curve
        The curve of the document.
    figure
        What it is drawn from; it may stand for another curve meanwhile, `limit` calls it back.
    camera
        The view.
    parameters, vertices_px, starts
        Places t and pixels of the drawn vertices, shapes (k,) and (k, 2); the first vertex of each
        run of consecutive ones, and k. A loop that is seen whole ends where it starts.
    outlines_px, polygons_px
        The parts of limit curve and control polygon that are seen, polylines.
    shown
        Indices of the control points in view, shape (h,); None if there are too many to be shown.
    """

    curve: Curve
    figure: Figure
    camera: Camera
    parameters: NDArray[np.float64]
    vertices_px: NDArray[np.float64]
    starts: NDArray[np.intp]
    outlines_px: tuple[NDArray[np.float64], ...]
    polygons_px: tuple[NDArray[np.float64], ...]
    shown: NDArray[np.intp] | None

    @property
    def limit(self) -> LimitCurve | None:
        """The limit curve; None when the scheme has none. It lives: use it at once."""
        return self._present().limit

    @cached_property
    def points_px(self) -> NDArray[np.float64]:
        """Pixels of all control points, shape (n, 2); made when asked for."""
        return self.camera.to_pixels(self.curve.points)

    @cached_property
    def handles_px(self) -> NDArray[np.float64]:
        """Pixels of the control points that are shown, shape (h, 2)."""
        shown = _NO_INDICES if self.shown is None else self.shown
        return self.places_px(shown)

    def places_px(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """Pixels of some control points, shape (k, 2)."""
        return self.camera.to_pixels(self.curve.places(indices))

    def within(
        self, low_px: NDArray[np.float64], high_px: NDArray[np.float64], most: int | None = None
    ) -> NDArray[np.intp] | None:
        """Indices of the control points in a rectangle; None if there are more than ``most``."""
        low, high = self.camera.to_mm(np.stack([low_px, high_px]))
        return _within(self._present(), np.minimum(low, high), np.maximum(low, high), most)

    def _present(self) -> Figure:
        self.figure.follow(self.curve)
        return self.figure


def traced(figure: Figure, camera: Camera, ratio: float) -> Drawn:
    """Compute how the curve that a figure stands for is drawn.

    Parameters
    ----------
    figure
        The curve.
    camera
        The view.
    ratio
        Device pixels per logical pixel.
    """
    tolerance = TOLERANCE_PX / ratio * camera.pixel_mm
    low, high = camera.rectangle_mm()
    reach = REACH_PX * camera.pixel_mm
    low, high = low - reach, high + reach
    centre = np.array([camera.x_mm, camera.y_mm])

    def seen(pyramid: Pyramid | None) -> Runs:
        if pyramid is None:
            return Runs(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp), 0.0)
        return view(pyramid, low, high, tolerance, centre)

    limit, loop = figure.limit, figure.curve.is_loop
    if figure.outline is None and limit is not None and limit.spans:
        outline = _unproven(limit, tolerance, camera)
    else:
        outline = seen(figure.outline)
    polygon = seen(figure.polygon)
    shift = camera.width / 2, camera.height / 2
    flip = camera.scale, -camera.scale
    total = figure.curve.count if loop else None
    vertices = outline.vertices * flip + shift
    corners = polygon.vertices * flip + shift
    return Drawn(
        figure.curve,
        figure,
        camera,
        outline.parameters,
        vertices,
        outline.starts,
        polylines(vertices, outline.parameters, outline.starts, total),
        polylines(corners, polygon.parameters, polygon.starts, total),
        _within(figure, low, high, MOST_HANDLES),
    )


def polylines(
    vertices: NDArray[np.float64],
    parameters: NDArray[np.float64],
    starts: Iterable[int],
    total: int | None,
) -> tuple[NDArray[np.float64], ...]:
    """Runs of vertices as polylines; on a loop of ``total`` spans they go on over the seam."""
    bounds = [int(start) for start in starts]
    pairs = list(pairwise(bounds))
    parts = [vertices[first:after] for first, after in pairs]
    if total is None or not parts or parameters[0] != 0 or parameters[-1] != total:
        return tuple(parts)
    if len(parts) == 1:
        # The ends agree up to rounding; the pen shall meet itself without a cap.
        return (np.concatenate([parts[0][:-1], parts[0][:1]]),)
    return (np.concatenate([parts[-1][:-1], parts[0]]), *parts[1:-1])


def grows(mask: Mask) -> bool:
    """Whether finer chords miss the curve by more: there is nothing then that they converge to."""
    errors = chord_profile(mask).sum(axis=1)
    return bool(errors[-1] >= errors[-2] > 0)


def _unproven(limit: LimitCurve, tolerance: float, camera: Camera) -> Runs:
    """Vertices of a curve whose chords have no proven bound: the whole of it, by estimates."""
    if grows(limit.mask):
        levels = np.full(limit.spans, FINITE_LEVEL)
    else:
        levels = span_levels(limit, tolerance, BUDGET, camera.rectangle_mm())
    t, vertices = detailed(limit, levels)
    if limit.closed:
        t, vertices = np.append(t, limit.spans), np.concatenate([vertices, vertices[:1]])
    starts = np.array([0, len(t)])
    return Runs(vertices - (camera.x_mm, camera.y_mm), t, starts, np.inf)


def _within(
    figure: Figure, low: NDArray[np.float64], high: NDArray[np.float64], most: int | None
) -> NDArray[np.intp] | None:
    if figure.polygon is not None:
        return points_within(figure.polygon, low, high, most)
    points = figure.curve.points
    return np.flatnonzero(((points >= low) & (points <= high)).all(axis=1))
