"""Ribbons of influence: along a curve, as broad as the curve follows the hand."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.drawn import Drawn
from app.style import SIZES
from core.live import LiveCurve
from core.view import BUDGET

RIBBON_VERTICES: Final = 2048
"""Number of vertices along a ribbon of influence, about."""

RIBBON_STEP_PX: Final = 6.0
"""Length of the chords of a ribbon, about."""

FAINT: Final = 0.004
"""Share of the hand's move below which an influence is not drawn."""


_Breadths = list[tuple[slice, NDArray[np.float64]]]
"""Vertices of a polyline that have a ribbon, stretch by stretch, and half its breadth there."""


@dataclass(frozen=True, eq=False)
class Influence:
    """How control points follow the hand.

    Attributes
    ----------
    curve
        Index of the curve.
    indices, shares
        Its control points that move, and the share of the hand's move that each follows, (k,).
    """

    curve: int
    indices: NDArray[np.intp]
    shares: NDArray[np.float64]
    _along: dict[tuple[object, ...], list[_Breadths]] = field(default_factory=dict)

    def along(
        self, limit: LiveCurve, stretches: list[tuple[NDArray[np.intp], int]]
    ) -> list[_Breadths]:
        """Breadths of the ribbons along a curve, for spans and their levels.

        Where the points are makes no difference, so that a drag asks once.
        """
        spans = [(int(chosen[0]), len(chosen), level) for chosen, level in stretches]
        key = limit.mask, limit.spans, limit.closed, *spans
        if key not in self._along:
            self._along.clear()
            # The curve is linear in its points: what a unit of the hand's way does is its share.
            places, way = limit.control_points[self.indices], self.shares[:, None] * (1.0, 0.0)
            before = [_joined(limit.span_points(*stretch))[:, 0] for stretch in stretches]
            limit.move(self.indices, places + way)
            after = [_joined(limit.span_points(*stretch))[:, 0] for stretch in stretches]
            limit.move(self.indices, places)
            self._along[key] = [
                _breadths(np.abs(b - a)) for a, b in zip(before, after, strict=True)
            ]
        return self._along[key]


def _breadths(share: NDArray[np.float64]) -> _Breadths:
    """Half the breadths of ribbons by the share of the hand's move that places follow."""
    strong = np.flatnonzero(share > FAINT)
    parts = np.split(strong, np.flatnonzero(np.diff(strong) > 1) + 1)
    wide = [slice(int(part[0]), int(part[-1]) + 1) for part in parts if len(part) > 1]
    return [(part, SIZES.ribbon_width * np.minimum(share[part], 1.5)) for part in wide]


def ribbons(drawn: Drawn, influence: Influence) -> list[NDArray[np.float64]]:
    """Outlines along a curve, as broad as the curve follows the hand."""
    limit, indices = drawn.limit, influence.indices
    if limit is None or not limit.spans or not len(indices):
        return []
    if indices.max() >= drawn.curve.count:
        return []
    touched = _stretches(drawn.figure.touched(indices), limit.spans, limit.closed)
    if sum(len(spans) for spans in touched) > BUDGET:
        return []  # So much of the curve follows that a ribbon would only be a blot.
    placed = drawn.figure.placed
    scale = drawn.camera.scale * placed.stretch
    stretches = [(spans, _level(limit.span_points(spans, 0), scale)) for spans in touched]
    ribbons: list[NDArray[np.float64]] = []
    for stretch, breadths in zip(stretches, influence.along(limit, stretches), strict=True):
        line = drawn.camera.to_pixels(placed(_joined(limit.span_points(*stretch))))
        ribbons.extend(_ribbon(line[part], half) for part, half in breadths)
    return ribbons


def _level(ends: NDArray[np.float64], scale: float) -> int:
    """Dyadic level at which the chords of spans, whose ends are (k, 2, 2), are short enough."""
    ways = ends[:, 1] - ends[:, 0]
    longest = math.sqrt((ways * ways).sum(axis=1).max()) * scale
    wanted = math.ceil(math.log2(max(longest / RIBBON_STEP_PX, 1.0)))
    admitted = math.floor(math.log2(RIBBON_VERTICES / len(ends)))
    return min(max(min(wanted, admitted), 0), 5)


def _joined(spans: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of consecutive spans, shape (k, m + 1, 2), as one polyline."""
    return np.concatenate([spans[:, :-1].reshape(-1, 2), spans[-1, -1:]])


def _stretches(
    ranges: tuple[range, ...], total: int, closed: bool
) -> list[NDArray[np.intp]]:
    """Spans of each range; on a loop, those on both sides of the seam are one stretch."""
    parts = [np.arange(part.start, part.stop) for part in ranges]
    if closed and len(parts) > 1 and ranges[0].start == 0 and ranges[-1].stop == total:
        parts[0] = np.concatenate([parts.pop(), parts[0]])
    return parts


def _ribbon(centre: NDArray[np.float64], half: NDArray[np.float64]) -> NDArray[np.float64]:
    """Outline of a band about a line of two vertices or more, ``half`` on either side wide."""
    steps = centre[1:] - centre[:-1]
    x, y = np.concatenate([steps[:1], steps[1:] + steps[:-1], steps[-1:]]).T
    # Where points coincide there is no direction, and the band has no breadth.
    length = np.hypot(x, y)
    share = half / np.where(length > 0, length, np.inf)
    across = np.stack([-y * share, x * share], axis=-1)
    return np.concatenate([centre + across, (centre - across)[::-1]])
