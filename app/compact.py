"""All of a curve of few points, computed once: the next view is mostly the same one moved."""

from __future__ import annotations

from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.crowd import spacing
from app.pixel_box import around
from app.spans import SpanVertices
from core.affine import Affine
from core.chords import size_constant
from core.document import Curve
from core.live import LiveCurve
from core.runs import counted

SHORT: Final = 64
"""Number of points and spans up to which a curve is drawn whole, without its levels of detail."""

Vertices = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Places t and points, shapes (k,) and (k, 2)."""


class Compact:
    """What is drawn of a short curve, in mm, whatever the view.

    Parameters
    ----------
    curve
        The curve.
    limit
        Its limit curve, before ``placed``; None when the scheme has none, or nothing is proven.
    placed
        Where the limit curve lies.
    spans
        All spans of the limit curve, kept from one curve to the next.

    Notes
    -----
    It is made for a curve as it is: after a change another one is due.
    """

    def __init__(
        self, curve: Curve, limit: LiveCurve | None, placed: Affine, spans: SpanVertices
    ) -> None:
        self._curve, self._limit, self._placed, self._spans = curve, limit, placed, spans
        self._vertices: tuple[float, Vertices | None] | None = None

    @cached_property
    def corners(self) -> Vertices:
        """All of the control polygon; a loop ends where it starts."""
        points = self._curve.points
        if self._curve.is_loop:
            points = np.concatenate([points, points[:1]])
        return counted(len(points))[0], np.asfortranarray(points)

    @cached_property
    def spacing(self) -> float:
        """Mean distance of neighbouring control points, of which there must be two."""
        return spacing(self._curve.points)

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """Least x and y, and largest x and y, of a box that holds curve and polygon.

        The curve is a mean of its points, of weights whose sizes sum to `size_constant` at most.
        """
        if self._limit is None:
            return around(self._curve.points, 0.0)
        # The phantom points, and the control points among them.
        left, low, right, high = around(self._placed(self._limit.endless_points), 0.0)
        half = (size_constant(self._limit.mask) - 1) / 2
        wide, tall = half * (right - left), half * (high - low)
        return left - wide, low - tall, right + wide, high + tall

    def vertices(self, tolerance: float) -> Vertices | None:
        """Vertices of all of the limit curve, as fine as `app.spans` makes them."""
        limit = self._limit
        if limit is None or not limit.spans:
            return None
        if self._vertices is None or self._vertices[0] != tolerance:
            found = self._spans.of(limit, tolerance / self._placed.stretch)
            placed = None if found is None else (found[0], self._placed(found[1]))
            self._vertices = tolerance, placed
        return self._vertices[1]
