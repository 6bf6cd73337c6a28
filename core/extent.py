"""How far a limit curve reaches: the upright box around it, as exact as it is asked for.

Notes
-----
Each side is a minimum: of x, of y, of -x and of -y. Points of the curve give a bound from above,
boxes of its parts (`core.pyramid`, `core.cells`) one from below. Parts whose boxes do not reach
further than the points by more than the tolerance are dropped, the others are cut into eight.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.affine import IDENTITY, Affine
from core.basis import BasicLimitFunction
from core.blocks import FAN, bends_of, boxes_of
from core.chords import cell_constant
from core.errors import NoLimitError
from core.parts import refinements
from core.pyramid import CurvePyramid

MOST: Final = 256
"""Blocks that are cut at a time. Of more the farthest come first, and mostly exclude the others."""

BUDGET: Final = 4
"""Times that so many are cut, up to 10 ms each: the tips of a long hatching are more."""

_ROUNDS: Final = 12
"""Rounds of cutting single spans, 36 levels: beyond, rounding is larger than any part."""


@dataclass(frozen=True, eq=False)
class Extent:
    """The box around some points of a curve.

    Attributes
    ----------
    lower, upper
        Its corners, shape (2,), on the curve or within it.
    deviation
        Proven bound of how far the curve leaves the box on any side.
    """

    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    deviation: float


def extent(pyramid: CurvePyramid, tolerance: float, placed: Affine = IDENTITY) -> Extent:
    """Box around a curve.

    Parameters
    ----------
    pyramid
        The curve with its levels of detail.
    tolerance
        How far the curve may leave the box, > 0, in the unit of the points. It is kept unless more
        than some thousand tips compete; `Extent.deviation` tells.
    placed
        Where the curve lies whose box is sought.

    Raises
    ------
    NoLimitError
        If the scheme is not proven to converge.
    """
    if pyramid.finest is not None:
        raise NoLimitError("A scheme that is not proven to converge has no proven extent.")
    search = _Search(tolerance, placed)
    level = pyramid.depth - 1
    nodes = np.arange(-(-pyramid.spans // FAN ** (level + 1)))
    search.meet(_ends(pyramid, level, nodes))
    waiting, cuts = [(level, nodes)], 0
    while waiting and cuts < BUDGET:
        level, nodes = waiting.pop()
        nodes = nodes[search.farthest(pyramid.boxes(level, nodes))]
        if len(nodes) > MOST:
            waiting.append((level, nodes[MOST:]))
            nodes = nodes[:MOST]
        if len(nodes) and level:
            level, nodes = level - 1, (FAN * nodes[:, None] + np.arange(FAN)).ravel()
            nodes = nodes[FAN ** (level + 1) * nodes < pyramid.spans]
            search.meet(_ends(pyramid, level, nodes))
            waiting.append((level, nodes))
        elif len(nodes):
            _cut(pyramid, np.sort(nodes), search)
            cuts += 1
    for level, nodes in waiting:
        search.drop(search.ahead(pyramid.boxes(level, nodes)))
    return Extent(search.reached[:2], -search.reached[2:], search.deviation)


class _Search:
    """The four minima as far as they are known.

    Attributes
    ----------
    reached
        Least x, y, -x and -y of the points that were met, shape (4,).
    deviation
        How much less they may be on parts that were dropped.
    """

    def __init__(self, tolerance: float, placed: Affine) -> None:
        self.reached = np.full(4, np.inf)
        self.deviation = 0.0
        self._tolerance, self._placed = tolerance, placed

    def meet(self, points: NDArray[np.float64]) -> None:
        """Take note of points of the curve, (2, ...)."""
        image = self._placed(points.reshape(2, -1).T).T
        self.reached = np.minimum(self.reached, boxes_of(image))

    def ahead(self, boxes: NDArray[np.float64]) -> NDArray[np.float64]:
        """How far boxes (4, m), before `placed`, reach beyond what was met, shape (m,)."""
        centres, halves = (boxes[:2] - boxes[2:]) / 2, -(boxes[:2] + boxes[2:]) / 2
        centres, halves = self._placed(centres.T).T, np.abs(self._placed.matrix) @ halves
        ahead = self.reached[:, None] - np.concatenate([centres - halves, -centres - halves])
        farthest: NDArray[np.float64] = ahead.max(axis=0)
        return farthest

    def drop(self, ahead: NDArray[np.float64]) -> None:
        """Take note of parts that are not looked at any more, by how far they reach."""
        self.deviation = max(self.deviation, float(ahead.max(initial=0.0)))

    def farthest(self, boxes: NDArray[np.float64]) -> NDArray[np.intp]:
        """Indices of the parts that have to be cut, the farthest first; the others are dropped."""
        ahead = self.ahead(boxes)
        chosen = ahead > self._tolerance
        self.drop(ahead[~chosen])
        places = np.flatnonzero(chosen)
        found: NDArray[np.intp] = places[np.argsort(-ahead[places])]
        return found


def _ends(
    pyramid: CurvePyramid, level: int, nodes: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Points of the curve at both ends of some nodes."""
    size: int = FAN ** (level + 1)
    return pyramid.places(np.minimum(size * (nodes + np.arange(2)[:, None]), pyramid.spans))


def _cut(pyramid: CurvePyramid, blocks: NDArray[np.intp], search: _Search) -> None:
    """Cut blocks into spans, and these, by the points that they read, until none is beyond."""
    curve = pyramid.curve
    ends, margins = pyramid.spans_of(blocks)
    search.meet(ends)
    starts, stops = ends[:, :-1], ends[:, 1:]
    low, high = np.minimum(starts, stops) - margins, np.maximum(starts, stops) + margins
    spans = FAN * blocks + np.arange(FAN)[:, None]
    inside = spans < pyramid.spans
    spans = spans[inside][search.farthest(np.concatenate([low, -high])[:, inside])]
    to_parts, to_next = refinements(curve.mask)
    table = BasicLimitFunction(curve.mask).cell_table(0)
    windows = curve.endless_points.T[:, spans[:, None] + np.arange(len(to_parts))]
    for _ in range(_ROUNDS):
        if not windows.size:
            return
        windows = (windows @ to_parts).reshape(2, -1, len(to_next))
        ends = windows @ table
        search.meet(ends)
        margins = cell_constant(curve.mask) * bends_of(windows).max(axis=2)
        boxes = boxes_of(ends) - np.concatenate([margins, margins])
        windows, to_parts = windows[:, search.farthest(boxes)], to_next
