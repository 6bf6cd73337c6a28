"""A curve of the document in the form that is drawn from: what changes is followed, not rebuilt."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.compact import SHORT, Compact
from app.spans import SpanVertices
from core.affine import IDENTITY
from core.blocks import Blocks
from core.chords import bounds
from core.document import Curve
from core.errors import NoLimitError
from core.family import PRESETS, Parameters
from core.live import LiveCurve
from core.pyramid import CurvePyramid, PolygonPyramid
from core.ranges import united

_NONE: Final = np.zeros(0, dtype=np.intp)

COMPARED: Final = 4096
"""Number of points up to which two curves of unknown kinship are compared point by point."""


class Figure:
    """Limit curve and polygon of a curve, with their levels of detail.

    It keeps the points where they were when it was made; a curve that was carried elsewhere since
    is seen through ``placed``.

    Parameters
    ----------
    curve, parameters
        The curve, and the scheme that draws it.

    Attributes
    ----------
    curve, parameters
        The curve and the scheme that it stands for now.
    placed
        Map from the points of `limit`, `outline` and `polygon` to those of the curve.

    Notes
    -----
    The levels of detail are made, and brought up to date, when they are asked for: curves of a few
    points do without (`compact`), and so do drags of a few points (`app.splice`).
    """

    def __init__(self, curve: Curve, parameters: Parameters) -> None:
        self.curve = self._first = curve
        self.parameters = parameters
        self.placed = IDENTITY
        self._pending = _NONE
        # A scheme that always has a limit; the true one is cast next.
        self._live = LiveCurve(curve.points, PRESETS["Calm"].mask, curve.is_loop)
        self._blocks: Blocks | None = None
        self._outline: CurvePyramid | None = None
        self._compact: Compact | None = None
        self._spans = SpanVertices(range(self._live.spans))
        self._has_limit = self._is_proven = False
        self._cast()

    def _cast(self) -> None:
        """Go over to the scheme of the parameters; what depends on it costs nothing of size n."""
        self._outline = self._compact = None
        self._has_limit = self._is_proven = False
        mask = self.parameters.mask
        try:
            known = bounds(mask)
            self._live.recast(mask)
        except NoLimitError:
            # What there is of it is drawn: the polygon.
            return
        self._has_limit, self._is_proven = True, known.finest is None
        if self._blocks is not None:
            self._blocks.update_ends()

    @property
    def limit(self) -> LiveCurve | None:
        """The limit curve, before `placed`; None when the scheme has none."""
        return self._live if self._has_limit else None

    @property
    def outline(self) -> CurvePyramid | None:
        """Levels of detail of the limit curve; None without a span, or without a limit."""
        blocks = self._present_blocks()
        if self._outline is None and blocks is not None and self._has_limit:
            self._outline = CurvePyramid(blocks)
        return self._outline

    @property
    def polygon(self) -> PolygonPyramid | None:
        """Levels of detail of the control polygon; None with fewer than two points."""
        blocks = self._present_blocks()
        return None if blocks is None else PolygonPyramid(blocks)

    @property
    def is_proven(self) -> bool:
        """Whether the chords of the limit curve have proven bounds."""
        return self._is_proven and self._live.spans > 0

    @property
    def compact(self) -> Compact | None:
        """All of a short curve, kept until it changes; None of a longer one, or of none."""
        if self._compact is None and 0 < self.curve.count <= SHORT:
            limit = self._live if self.is_proven else None
            self._compact = Compact(self.curve, limit, self.placed, self._spans)
        return self._compact

    def follow(self, curve: Curve, parameters: Parameters) -> bool:
        """Stand for another curve that differs by moves, or another scheme, or both.

        The cost is that of the moved points; the scheme and a move of all points together cost
        nothing of their number.

        Returns
        -------
        bool
            False if it is not such a curve; then nothing has changed.
        """
        if curve is not self.curve and not self._follow_moves(curve):
            return False
        if parameters is not self.parameters:
            self.parameters = parameters
            self._cast()
        return True

    def _follow_moves(self, curve: Curve) -> bool:
        if not akin(self.curve, curve):
            return False
        changed = curve.differences(self.curve)
        if changed is not None:
            if curve.placed is not self.curve.placed:
                self.placed = curve.placed.after(self._first.placed.inverse)
        elif self.placed is IDENTITY:
            # Strangers of a few points, such as before and after an edit of most of them.
            changed = differing(self.curve, curve)
            self._first = curve if changed is not None else self._first
        if changed is None:
            return False
        self._compact = None
        self._live.put(changed, self.placed.inverse(curve.places(changed)))
        self._pending = united(self._pending, changed)
        self.curve = curve
        return True

    def touched(self, indices: NDArray[np.intp]) -> tuple[range, ...]:
        """Spans that read some control points, as `core.live.LiveCurve.move` tells them."""
        return self._live.reading(indices)

    def _present_blocks(self) -> Blocks | None:
        """The levels of detail, made or brought up to date; None without a span."""
        pending, self._pending = self._pending, _NONE
        if self._blocks is not None:
            self._blocks.update(pending)
        elif self._live.spans:
            self._blocks = Blocks(self._live)
        return self._blocks


def akin(curve: Curve, other: Curve) -> bool:
    """Whether two curves have as many points and the same ends, so that moves lead to the other."""
    return (curve.count, curve.is_loop) == (other.count, other.is_loop)


def differing(curve: Curve, other: Curve) -> NDArray[np.intp] | None:
    """Indices of the points in which two akin curves may differ; None if that takes too long."""
    changed = curve.differences(other)
    if changed is not None and curve.placed is other.placed:
        return changed
    if curve.count > COMPARED:
        return None
    return np.flatnonzero((curve.points != other.points).any(axis=1))
