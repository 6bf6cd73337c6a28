"""A curve of the document in the form that is drawn from: what moves is followed, not rebuilt."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.document import Curve
from core.errors import NoLimitError
from core.family import Parameters
from core.live import LiveCurve
from core.pyramid import CurvePyramid, PolygonPyramid

_NONE: Final = np.zeros(0, dtype=np.intp)

COMPARED: Final = 4096
"""Number of points up to which two curves of unknown kinship are compared point by point."""


class Figure:
    """Limit curve and polygon of a curve, with their levels of detail.

    Parameters
    ----------
    curve, parameters
        The curve, and the scheme that draws it.

    Attributes
    ----------
    curve
        The curve that it stands for now.
    limit
        Its limit curve; None when the scheme has none.

    Notes
    -----
    The levels of detail are brought up to date when they are asked for: while a few points are
    dragged they are not (`app.splice`).
    """

    def __init__(self, curve: Curve, parameters: Parameters) -> None:
        self.curve = curve
        self.parameters = parameters
        self.limit: LiveCurve | None = None
        self._outline: CurvePyramid | None = None
        self._polygon: PolygonPyramid | None = None
        self._pending = _NONE
        points = curve.points
        try:
            self.limit = LiveCurve(points, parameters.mask, curve.is_loop)
            points = self.limit.control_points
            if self.limit.spans:
                self._outline = CurvePyramid(self.limit)
        except NoLimitError:
            # What is not proven is drawn as far as it is there.
            pass
        if len(points) > 1:
            self._polygon = PolygonPyramid(points, curve.is_loop)

    @property
    def outline(self) -> CurvePyramid | None:
        """Levels of detail of the limit curve; None without a span, or without a proven bound."""
        self._settle()
        return self._outline

    @property
    def polygon(self) -> PolygonPyramid | None:
        """Levels of detail of the control polygon; None with fewer than two points."""
        self._settle()
        return self._polygon

    @property
    def is_proven(self) -> bool:
        """Whether the limit curve has levels of detail."""
        return self._outline is not None

    def follow(self, curve: Curve) -> bool:
        """Stand for another curve that differs by moved points; the cost is that of the moves.

        Returns
        -------
        bool
            False if it is not such a curve; then nothing has changed.
        """
        if curve is self.curve:
            return True
        if self.limit is None or not akin(self.curve, curve):
            return False
        changed = differing(self.curve, curve)
        if changed is None:
            return False
        self.limit.move(changed, curve.places(changed))
        self._pending = np.union1d(self._pending, changed)
        self.curve = curve
        return True

    def touched(self, indices: NDArray[np.intp]) -> tuple[range, ...]:
        """Spans that read some control points, as `core.live.LiveCurve.move` tells them."""
        if self.limit is None:
            return ()
        # A move to where they are changes nothing.
        return self.limit.move(indices, self.curve.places(indices))

    def edges_at(self, indices: NDArray[np.intp]) -> tuple[range, ...]:
        """Edges of the polygon that end in some control points."""
        return () if self._polygon is None else self._polygon.edges_at(indices)

    def _settle(self) -> None:
        """Bring the levels of detail up to date."""
        pending, self._pending = self._pending, _NONE
        if not len(pending):
            return
        if self._outline is not None:
            self._outline.update(self.touched(pending))
        if self._polygon is not None:
            self._polygon.update(self.edges_at(pending))


def akin(curve: Curve, other: Curve) -> bool:
    """Whether two curves have as many points and the same ends, so that moves lead to the other."""
    return (curve.count, curve.is_loop) == (other.count, other.is_loop)


def differing(curve: Curve, other: Curve) -> NDArray[np.intp] | None:
    """Indices of the points in which two akin curves may differ; None if that takes too long."""
    changed = curve.differences(other)
    if changed is None and curve.count <= COMPARED:
        changed = np.flatnonzero((curve.points != other.points).any(axis=1))
    return changed
