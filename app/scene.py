"""What the canvas shows, in pixels, computed before painting and kept while nothing changed.

A view of the document, the camera and what the hand is doing (`Overlay`). Curves are immutable, so
their identity says whether a limit curve or its pixels can be used again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from app.camera import Camera
from app.handles import CurveHit, PointHit
from app.polyline import closed_up
from app.style import SIZES
from core.detail import chord_profile, detailed, span_levels
from core.document import Curve, Document
from core.errors import NoLimitError
from core.family import Parameters
from core.limit import LimitCurve
from core.mask import Mask

TOLERANCE_PX: Final = 0.25
"""Admitted distance between the curve and its drawn chords, in device pixels."""

BUDGET: Final = 4000
"""Number of chords of one curve that is not exceeded, unless it has more spans."""

RIBBON_VERTICES: Final = 2048
"""Number of vertices along a ribbon of influence, about."""

FAINT: Final = 0.004
"""Share of the hand's move below which an influence is not drawn."""


FINITE_LEVEL: Final = 2
"""Dyadic level at which a curve is drawn that refinement does not bring to rest."""


@dataclass(frozen=True, eq=False)
class Overlay:
    """What the hand adds to the picture.

    Attributes
    ----------
    rubber_band
        Two opposite corners in pixels.
    hover
        Control point that a press would take.
    grip
        Place on a curve that a press would take, or that is held.
    influences
        For curves being moved: index, and the share of the hand's move that each control point
        follows, shape (n,).
    preview
        The curve being drawn, not yet in the document.
    """

    rubber_band: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
    hover: PointHit | None = None
    grip: CurveHit | None = None
    influences: tuple[tuple[int, NDArray[np.float64]], ...] = ()
    preview: Curve | None = None

    def resembles(self, other: Overlay) -> bool:
        """Whether the picture is the same with the other one in its place."""
        return (self.hover, self.grip) == (other.hover, other.grip) and all(
            mine is others
            for mine, others in (
                (self.rubber_band, other.rubber_band),
                (self.influences, other.influences),
                (self.preview, other.preview),
            )
        )


NOTHING: Final = Overlay()
"""The overlay of an idle hand."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """A curve as it is drawn.

    Attributes
    ----------
    curve
        The curve of the document.
    limit
        Its limit curve; None when the scheme has none.
    parameters, vertices_px
        Places t and pixels of the drawn vertices, shapes (k,) and (k, 2).
    points_px
        Pixels of the control points, shape (n, 2).
    """

    curve: Curve
    limit: LimitCurve | None
    parameters: NDArray[np.float64]
    vertices_px: NDArray[np.float64]
    points_px: NDArray[np.float64]

    @property
    def outline_px(self) -> NDArray[np.float64]:
        """The drawn vertices from end to end; a loop returns to its start."""
        return closed_up(self.vertices_px) if self.curve.is_loop else self.vertices_px

    @property
    def polygon_px(self) -> NDArray[np.float64]:
        """The control polygon from end to end; a loop returns to its start."""
        return closed_up(self.points_px) if self.curve.is_loop else self.points_px


class Scene:
    """The drawn curves, and what the hand adds.

    Attributes
    ----------
    curves
        The curves of the document.
    ghosts_px
        Parts of the shape before the open gesture that differ from the present shape.
    ribbons_px
        Outlines of the ribbons of influence.
    preview
        The curve being drawn.
    has_limit
        Whether the scheme has a limit curve.
    """

    def __init__(self) -> None:
        self.curves: tuple[Drawn, ...] = ()
        self.ghosts_px: tuple[NDArray[np.float64], ...] = ()
        self.ribbons_px: tuple[NDArray[np.float64], ...] = ()
        self.preview: Drawn | None = None
        self.has_limit = True
        self._camera = Camera()
        self._ratio = 1.0
        self._kept: dict[tuple[int, int], tuple[Parameters, Drawn]] = {}
        self._used: dict[tuple[int, int], tuple[Parameters, Drawn]] = {}

    def update(
        self,
        document: Document,
        origin: Document,
        camera: Camera,
        ratio: float,
        overlay: Overlay = NOTHING,
    ) -> None:
        """Bring the scene up to date.

        Parameters
        ----------
        document, origin
            The present document, and the one at the start of the open gesture.
        camera
            The view.
        ratio
            Device pixels per logical pixel.
        overlay
            What the hand adds.
        """
        moved = (camera, ratio) != (self._camera, self._ratio)
        self._camera, self._ratio = camera, ratio
        self._used = {}
        parameters = document.parameters
        self.curves = tuple(self._drawn(curve, parameters, moved) for curve in document.curves)
        self.has_limit = all(drawn.limit is not None for drawn in self.curves)
        self.ghosts_px = self._ghosts(document, origin, moved)
        self.ribbons_px = tuple(
            ribbon
            for curve, weights in overlay.influences
            if curve < len(self.curves)
            for ribbon in self._ribbons(self.curves[curve], weights)
        )
        self.preview = None
        if overlay.preview is not None:
            self.preview = self._drawn(overlay.preview, parameters, moved)
        self._kept = self._used

    def _drawn(self, curve: Curve, parameters: Parameters, moved: bool) -> Drawn:
        """Curve as drawn: as it was, or from its limit curve, or from its points."""
        # The kept entry holds curve and parameters, so their identities cannot be taken over.
        key = (id(curve), id(parameters))
        kept = self._used.get(key) or self._kept.get(key)
        if kept is None:
            drawn = self._projected(curve, _limit(curve, parameters))
        elif moved and key not in self._used:
            drawn = self._projected(curve, kept[1].limit)
        else:
            drawn = kept[1]
        self._used[key] = (parameters, drawn)
        return drawn

    def _projected(self, curve: Curve, limit: LimitCurve | None) -> Drawn:
        camera = self._camera
        if limit is None:
            t, vertices = np.zeros(0), np.zeros((0, 2))
        else:
            if grows(limit.mask):
                levels = np.full(limit.spans, FINITE_LEVEL)
            else:
                levels = self._levels(limit)
            t, vertices = detailed(limit, levels)
        points_px = camera.to_pixels(curve.points)
        return Drawn(curve, limit, t, camera.to_pixels(vertices), points_px)

    def _levels(self, limit: LimitCurve) -> NDArray[np.intp]:
        """Dyadic level of each span at which its chords look like the curve."""
        camera = self._camera
        tolerance = TOLERANCE_PX / self._ratio * camera.pixel_mm
        return span_levels(limit, tolerance, BUDGET, camera.rectangle_mm())

    def _ghosts(
        self, document: Document, origin: Document, moved: bool
    ) -> tuple[NDArray[np.float64], ...]:
        """Outlines of the origin's curves where they differ from the present ones."""
        if origin is document:
            return ()
        recast = origin.parameters is not document.parameters
        parts: list[NDArray[np.float64]] = []
        for index, curve in enumerate(origin.curves):
            now = self.curves[index] if index < len(self.curves) else None
            if now is not None and now.curve is curve and not recast:
                continue
            before = self._drawn(curve, origin.parameters, moved)
            parts.extend(_differing(before, None if recast else now))
        return tuple(parts)

    def _ribbons(
        self, drawn: Drawn, weights: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Outlines along a curve, as broad as the curve follows the hand."""
        limit = drawn.limit
        if limit is None or limit.spans == 0 or len(weights) != len(drawn.curve.points):
            return []
        pairs = np.stack([weights, np.zeros(len(weights))], axis=-1)
        shares = LimitCurve(pairs, limit.mask, limit.closed)
        reads = limit.mask.end - limit.mask.start + 1
        strong = shares.endless_points[:, 0] != 0
        touched = np.asarray(sliding_window_view(strong, reads)[: limit.spans].any(axis=1))
        ribbons: list[NDArray[np.float64]] = []
        for spans in _stretches(touched, limit.closed):
            level = int(np.clip(np.log2(RIBBON_VERTICES / len(spans)), 0, 5))
            centre = self._camera.to_pixels(_joined(limit.span_points(spans, level)))
            share = np.abs(_joined(shares.span_points(spans, level))[:, 0])
            ribbons.extend(
                _ribbon(centre[stretch], share[stretch])
                for stretch in _stretches(share > FAINT, closed=False)
                if len(stretch) > 1
            )
        return ribbons


def _limit(curve: Curve, parameters: Parameters) -> LimitCurve | None:
    try:
        return curve.limit(parameters)
    except NoLimitError:
        return None


def grows(mask: Mask) -> bool:
    """Whether finer chords miss the curve by more: there is nothing then that they converge to."""
    errors = chord_profile(mask).sum(axis=1)
    return bool(errors[-1] >= errors[-2] > 0)


def _joined(spans: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of consecutive spans, shape (k, m + 1, 2), as one polyline."""
    return np.concatenate([spans[:, :-1].reshape(-1, 2), spans[-1, -1:]])


def _stretches(flags: NDArray[np.bool_], closed: bool) -> list[NDArray[np.intp]]:
    """Find runs of consecutive indices whose flag is set; on a loop one may pass the seam."""
    indices = np.flatnonzero(flags)
    if not len(indices):
        return []
    parts = np.split(indices, np.flatnonzero(np.diff(indices) > 1) + 1)
    if closed and len(parts) > 1 and flags[0] and flags[-1]:
        parts[0] = np.concatenate([parts.pop(), parts[0]])
    return parts


def _differing(before: Drawn, now: Drawn | None) -> list[NDArray[np.float64]]:
    """Parts of an outline whose spans read other control points than now."""
    limit = before.limit
    if limit is None:
        return []
    same = now is not None and now.limit is not None and now.curve.is_loop == limit.closed
    if not same or now is None or now.limit is None or now.limit.spans != limit.spans:
        return [before.outline_px]
    if not limit.spans:
        return []
    changed = np.asarray((limit.endless_points != now.limit.endless_points).any(axis=1))
    reads = limit.mask.end - limit.mask.start + 1
    touched = np.asarray(sliding_window_view(changed, reads)[: limit.spans].any(axis=1))
    span = np.minimum(before.parameters.astype(np.intp), limit.spans - 1)
    parts = []
    for stretch in _stretches(touched[span], limit.closed):
        # One vertex more: the end of the last chord.
        after = (stretch[-1] + 1) % len(span) if limit.closed else stretch[-1]
        parts.append(before.vertices_px[np.append(stretch, after)])
    return parts


def _ribbon(
    centre: NDArray[np.float64], share: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Outline of a band about a line, ``share`` of the full breadth wide."""
    along = np.gradient(centre, axis=0)
    length = np.hypot(*along.T)
    # Where points coincide there is no direction, and the band has no breadth.
    across = np.divide(along[:, ::-1] * (-1, 1), length[:, None],
                       out=np.zeros_like(along), where=length[:, None] > 0)
    half = SIZES.ribbon_width * np.minimum(share, 1.5)[:, None] * across
    return np.concatenate([centre + half, (centre - half)[::-1]])
