"""Ribbons of influence: along a curve, as broad as the curve follows the hand."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawn import Drawn
from app.line import Line, ribbon_of
from app.polyline import snapped
from app.style import SIZES
from core.extreme import largest
from core.live import LiveCurve
from core.view import BUDGET

RIBBON_VERTICES: Final = 2048
"""Number of vertices along a ribbon of influence, about."""

RIBBON_STEP_PX: Final = 6.0
"""Length of the chords of a ribbon, about."""

FAINT: Final = 0.004
"""Share of the hand's move below which an influence is not drawn."""


LEVELS: Final = 5
"""Finest dyadic level of a ribbon."""


class Stretch(NamedTuple):
    """Consecutive spans along which a ribbon may lie.

    Attributes
    ----------
    spans
        Their indices; over the seam of a loop they go on.
    parts
        Vertices of their polyline that have a ribbon, and half its breadth there.
    """

    spans: NDArray[np.intp]
    parts: list[tuple[slice, NDArray[np.float64]]]


class Influence:
    """How control points follow the hand.

    Parameters
    ----------
    curve
        Index of the curve.
    indices, shares
        Its control points that move, and the share of the hand's move that each follows, (k,).
    """

    def __init__(
        self, curve: int, indices: NDArray[np.intp], shares: NDArray[np.float64]
    ) -> None:
        self.curve, self.indices, self.shares = curve, indices, shares
        self._level = 0
        self._key: tuple[object, ...] = ()
        self._stretches: list[Stretch] = []

    def stretches(
        self, limit: LiveCurve, touched: tuple[range, ...], level: int
    ) -> list[Stretch]:
        """Where the ribbons along a curve lie, at a dyadic level.

        Where the points are makes no difference, so that a drag asks once.
        """
        key = limit.mask, limit.spans, limit.closed, touched, level
        if key != self._key:
            spans = _joined(touched, limit.spans, limit.closed)
            # The curve is linear in its points: what a unit of the hand's way does is its share.
            places, way = limit.control_points[self.indices], self.shares[:, None] * (1.0, 0.0)
            before = [_line(limit, some, level)[:, 0] for some in spans]
            limit.move(self.indices, places + way)
            after = [_line(limit, some, level)[:, 0] for some in spans]
            limit.move(self.indices, places)
            self._stretches = [
                Stretch(some, _parts(np.abs(b - a)))
                for some, a, b in zip(spans, before, after, strict=True)
            ]
            self._key = key
        return self._stretches

    def lines(
        self, limit: LiveCurve, touched: tuple[range, ...], scale: float
    ) -> list[tuple[NDArray[np.float64], Stretch]]:
        """Polylines along the stretches, with chords of about `RIBBON_STEP_PX`.

        Parameters
        ----------
        limit, touched
            The curve, and the spans that follow.
        scale
            Pixels per unit of its points.
        """
        count = sum(len(spans) for spans in touched)
        finest = min(LEVELS, int(math.log2(max(RIBBON_VERTICES / count, 1.0))))
        # The level of the frame before is mostly that of this one; a chord of the next has half
        # the length.
        level, was_long = min(self._level, finest), False
        while True:
            stretches = self.stretches(limit, touched, level)
            lines = [_line(limit, stretch.spans, level) for stretch in stretches]
            chord = max(map(_longest, lines)) * scale
            if chord > RIBBON_STEP_PX and level < finest:
                level, was_long = level + 1, True
            elif chord < RIBBON_STEP_PX / 2 and level > 0 and not was_long:
                level -= 1
            else:
                break
        self._level = level
        return list(zip(lines, stretches, strict=True))


def ribbons(drawn: Drawn, influence: Influence) -> list[Line]:
    """Lines along a curve, as broad as the curve follows the hand."""
    limit, indices = drawn.limit, influence.indices
    if limit is None or not limit.spans or not len(indices):
        return []
    if largest(indices) >= drawn.curve.count:
        return []
    figure, camera = drawn.figure, drawn.camera
    touched, placed = figure.touched(indices), figure.placed
    if sum(len(spans) for spans in touched) > BUDGET:
        return []  # So much of the curve follows that a ribbon would only be a blot.
    return [
        ribbon_of(snapped(camera.to_pixels(placed(line[part])), drawn.ratio), half)
        for line, stretch in influence.lines(limit, touched, camera.scale * placed.stretch)
        for part, half in stretch.parts
    ]


def _parts(share: NDArray[np.float64]) -> list[tuple[slice, NDArray[np.float64]]]:
    """Parts of a line that have a ribbon, by the share of the hand's move that places follow."""
    strong = np.flatnonzero(share > FAINT)
    parts = np.split(strong, np.flatnonzero(np.diff(strong) > 1) + 1)
    wide = [slice(int(part[0]), int(part[-1]) + 1) for part in parts if len(part) > 1]
    return [(part, SIZES.ribbon_width * np.minimum(share[part], 1.5)) for part in wide]


def _longest(line: NDArray[np.float64]) -> float:
    """Length of the longest chord."""
    ways = line[1:] - line[:-1]
    squares = ways * ways
    return math.sqrt(largest(squares[:, 0] + squares[:, 1]))


def _line(limit: LiveCurve, spans: NDArray[np.intp], level: int) -> NDArray[np.float64]:
    """Points of consecutive spans as one polyline, shape (m, 2)."""
    points = limit.span_points(spans, level).transpose(2, 0, 1)
    return np.concatenate([points[:, :, :-1].reshape(2, -1), points[:, -1, -1:]], axis=1).T


def _joined(
    ranges: tuple[range, ...], total: int, closed: bool
) -> list[NDArray[np.intp]]:
    """Spans of each range; on a loop, those on both sides of the seam are one stretch."""
    parts = [np.arange(part.start, part.stop) for part in ranges]
    if closed and len(parts) > 1 and ranges[0].start == 0 and ranges[-1].stop == total:
        parts[0] = np.concatenate([parts.pop(), parts[0]])
    return parts
