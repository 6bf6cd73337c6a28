"""What the canvas shows, in pixels, computed before painting and kept while nothing changed.

A view of the document, the camera and what the hand is doing (`Overlay`). Curves are immutable, so
their identity says whether the figure of a curve or its pixels can be used again; a curve that
differs from the one before by moved points is followed at the cost of the moves.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.camera import Camera
from app.drawn import Drawn, traced
from app.figure import COMPARED, Figure, akin, differing
from app.handles import (
    CurveHit,
    EdgeHit,
    PointHit,
    nearest_edge,
    nearest_on_curve,
    nearest_point,
)
from app.line import Line, line_of
from app.point_set import PointSet
from app.ribbons import Influence, ribbons
from app.splice import Splice
from core.document import Curve, Document
from core.family import Parameters
from core.runs import Runs


class Overlay(NamedTuple):
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
        For curves being moved.
    preview
        The curve being drawn, not yet in the document.
    """

    rubber_band: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
    hover: PointHit | None = None
    grip: CurveHit | None = None
    influences: tuple[Influence, ...] = ()
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


class Scene:
    """The drawn curves, and what the hand adds.

    Attributes
    ----------
    curves
        The curves of the document.
    ghosts
        Parts of the curves before the open gesture that differ from the present ones, by index.
    ribbons
        Ribbons of influence.
    preview
        The curve being drawn.
    has_limit
        Whether the scheme has a limit curve.
    """

    def __init__(self) -> None:
        self.curves: tuple[Drawn, ...] = ()
        self.ghosts: dict[int, Line] = {}
        self.ribbons: tuple[Line, ...] = ()
        self.preview: Drawn | None = None
        self.has_limit = True
        self._camera = Camera()
        self._ratio = 1.0
        self._moved = False
        self._boxes_px: NDArray[np.float64] | None = None
        self._before: tuple[Drawn, ...] = ()
        self._kept: dict[tuple[int, int], Drawn] = {}
        self._used: dict[tuple[int, int], Drawn] = {}
        self._ghosts_kept: dict[int, tuple[Drawn, bytes, Line]] = {}

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
        self._moved = (camera, ratio) != (self._camera, self._ratio)
        self._camera, self._ratio = camera, ratio
        self._used, self._boxes_px = {}, None
        parameters = document.parameters
        self._before = before = self.curves
        self.curves = tuple(
            self._drawn(curve, parameters, before[index] if index < len(before) else None)
            for index, curve in enumerate(document.curves)
        )
        self.has_limit = all(drawn.figure.limit is not None for drawn in self.curves)
        self.ghosts = self._ghosts(document, origin)
        self.ribbons = tuple(
            ribbon
            for influence in overlay.influences
            if influence.curve < len(self.curves)
            for ribbon in ribbons(self.curves[influence.curve], influence)
        )
        shown, self.preview = self.preview, None
        if overlay.preview is not None:
            self.preview = self._drawn(overlay.preview, parameters, shown)
        self._kept = self._used

    @property
    def hidden(self) -> int:
        """Number of control points of the curves whose points lie too close to be shown."""
        return sum(drawn.curve.count for drawn in self.curves if drawn.shown is None)

    def nearest_point(
        self, pos_px: NDArray[np.float64], radius_px: float, preferred: int = -1
    ) -> PointHit | None:
        """Control point near the mouse, as `app.handles.nearest_point`, at any number of points."""
        about, curves, preferred = self._near(pos_px, radius_px, preferred)
        near = [drawn.nearest(pos_px, radius_px) for drawn in curves]
        places = [drawn.places_px(found) for drawn, found in zip(curves, near, strict=True)]
        hit = nearest_point(places, pos_px, radius_px, preferred)
        if hit is None:
            return None
        return hit._replace(curve=about[hit.curve], point=int(near[hit.curve][hit.point]))

    def nearest_edge(
        self, pos_px: NDArray[np.float64], radius_px: float, preferred: int = -1
    ) -> EdgeHit | None:
        """Place on a control polygon near the mouse, as `app.handles.nearest_edge`."""
        about, curves, preferred = self._near(pos_px, radius_px, preferred)
        near = [_near_edges(drawn, pos_px, radius_px) for drawn in curves]
        # All edges of a short polygon are looked at, with the one that closes it.
        loops = [drawn.curve.is_loop and drawn.curve.count <= COMPARED for drawn in curves]
        places = [drawn.places_px(found) for drawn, found in zip(curves, near, strict=True)]
        hit = nearest_edge(places, loops, pos_px, radius_px, preferred)
        if hit is None:
            return None
        return hit._replace(curve=about[hit.curve], edge=int(near[hit.curve][hit.edge]))

    def nearest_on_curve(
        self, pos_px: NDArray[np.float64], radius_px: float, preferred: int = -1
    ) -> CurveHit | None:
        """Place on a limit curve near the mouse, as `app.handles.nearest_on_curve`."""
        about, curves, preferred = self._near(pos_px, radius_px, preferred)
        hit = nearest_on_curve(
            [drawn.vertices_px for drawn in curves],
            [drawn.parameters for drawn in curves],
            [drawn.starts for drawn in curves],
            [drawn.period for drawn in curves],
            pos_px,
            radius_px,
            preferred,
        )
        return None if hit is None else hit._replace(curve=about[hit.curve])

    def _near(
        self, pos_px: NDArray[np.float64], radius_px: float, preferred: int
    ) -> tuple[list[int], list[Drawn], int]:
        """Curves that may come near a place: their indices, they, and which is preferred."""
        if self._boxes_px is None:
            boxes = [drawn.box_px for drawn in self.curves]
            self._boxes_px = np.array(boxes).reshape(-1, 2, 2)
        low, high = self._boxes_px[:, 0], self._boxes_px[:, 1]
        meets = (low <= pos_px + radius_px) & (high >= pos_px - radius_px)
        about = np.flatnonzero(meets.all(axis=1)).tolist()
        place = about.index(preferred) if preferred in about else -1
        return about, [self.curves[index] for index in about], place

    def points_within(
        self, corner_px: NDArray[np.float64], opposite_px: NDArray[np.float64]
    ) -> PointSet:
        """Control points between two opposite corners."""
        near = [drawn.within(corner_px, opposite_px) for drawn in self.curves]
        return PointSet({curve: found for curve, found in enumerate(near) if found is not None})

    def _drawn(self, curve: Curve, parameters: Parameters, before: Drawn | None) -> Drawn:
        """Curve as drawn: as it was, or by moves from the one before, or from its points."""
        if before is not None and before.curve is curve and before.scheme is parameters:
            if not self._moved:
                return before
            return self._traced(curve, parameters, before)
        # The kept figure holds curve and parameters, so their identities cannot be taken over.
        key = (id(curve), id(parameters))
        known = self._used.get(key)
        if known is None:
            if self._before:
                shown = {(id(drawn.curve), id(drawn.scheme)): drawn for drawn in self._before}
                self._kept, self._before = {**shown, **self._kept}, ()
            known = self._kept.get(key)
            if known is None or self._moved:
                known = self._traced(curve, parameters, known or before)
            self._used[key] = known
        return known

    def _traced(self, curve: Curve, parameters: Parameters, before: Drawn | None) -> Drawn:
        """Draw a curve by the figure of the one before, if it can follow, or by a new one."""
        figure = None
        if before is not None and before.figure.follow(curve, parameters):
            figure = before.figure
        if figure is None:
            figure = Figure(curve, parameters)
        elif before is not None and not self._moved:
            splice = Splice.of(before)
            drawn = None if splice is None else splice.drawn()
            if drawn is not None:
                return drawn
        return traced(figure, self._camera, self._ratio, before)

    def _ghosts(self, document: Document, origin: Document) -> dict[int, Line]:
        """Outlines of the origin's curves where they differ from the present ones."""
        kept, self._ghosts_kept = self._ghosts_kept, {}
        if origin is document:
            return {}
        recast = origin.parameters is not document.parameters
        ghosts: dict[int, Line] = {}
        for index, curve in enumerate(origin.curves):
            now = self.curves[index] if index < len(self.curves) else None
            if now is not None and now.curve is curve and not recast:
                continue
            before = self._drawn(curve, origin.parameters, now)
            changed = None
            if now is not None and not recast and akin(curve, now.curve):
                changed = differing(curve, now.curve)
            sign = b"" if changed is None else changed.tobytes()
            known = kept.get(index)
            if known is None or known[0] is not before or known[1] != sign:
                known = before, sign, _part(before, changed)
            self._ghosts_kept[index] = known
            ghosts[index] = known[2]
        return ghosts


def _near_edges(
    drawn: Drawn, pos_px: NDArray[np.float64], radius_px: float
) -> NDArray[np.intp]:
    """Consecutive control points, of a long polygon only those about the place near the mouse."""
    count = drawn.curve.count
    if count <= COMPARED:
        return np.arange(count)
    t = drawn.on_polygon(pos_px, radius_px)
    if t is None:
        return np.zeros(0, dtype=np.intp)
    about = int(t) + np.arange(-COMPARED // 2, COMPARED // 2)
    return about % count if drawn.curve.is_loop else about[(about >= 0) & (about < count)]


def _part(before: Drawn, changed: NDArray[np.intp] | None) -> Line:
    """Parts of an outline that read some control points; without knowing which, all of it."""
    if changed is None:
        return before.outline_line
    t, vertices = before.parameters, before.vertices_px
    times, places, starts = [np.zeros(0)], [np.zeros((0, 2))], [0]
    has_limit = before.figure.limit is not None
    for spans in before.figure.touched(changed) if has_limit else ():
        for first, after in zip(before.starts[:-1], before.starts[1:], strict=True):
            own = t[first:after]
            low, high = max(spans.start, own[0]), min(spans.stop, own[-1])
            if low < high:
                inner = own[(own > low) & (own < high)]
                chosen = np.concatenate([[low], inner, [high]])
                times.append(chosen)
                places.append(_between(chosen, own, vertices[first:after]))
                starts.append(starts[-1] + len(chosen))
    cut = Runs(np.concatenate(places), np.concatenate(times), np.array(starts), 0.0)
    return line_of(cut, before.period, before.strides[0])


def _between(
    times: NDArray[np.float64], known: NDArray[np.float64], places: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Places on a polyline at some t, shape (k, 2)."""
    return np.stack([np.interp(times, known, places[:, axis]) for axis in (0, 1)], axis=-1)
