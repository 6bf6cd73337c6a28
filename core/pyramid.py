"""Levels of detail of a limit curve, and of its polygon, so that a million spans are not looked at.

Notes
-----
Both stand on the same `core.blocks.Blocks` of the control polygon. With c max |D2p| for the largest
distance of the curve from its polygon, each coordinate with its own second differences D2p, and
e max |D2p| for that of the curve's points at whole t from the control points (`core.chords`), the
boxes of the curve are those of the polygon, wider by c max |D2p|. And where the polygon keeps
within d of the chord between its ends, the curve keeps within d + (c + e) max |D2p| of the chord
between its own. All bounds hold up to the rounding of the points.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.blocks import FAN, Blocks, bends_of
from core.chords import bounds, chord_constant
from core.vectors import gathered, lengths, taken
from core.windows import running_max

_FINEST: Final = 6
"""Dyadic level beyond which a span has to be cut to what is looked at of it."""


class Pyramid(ABC):
    """What is known of consecutive spans, in blocks of 8, 64, ... of them.

    Parameters
    ----------
    blocks
        The control polygon's levels of detail.
    """

    def __init__(self, blocks: Blocks) -> None:
        self.blocks = blocks
        self.spans = blocks.spans
        self.depth = len(blocks.boxes)
        """Number of levels; nodes of level k, from 0 on, stand for 8^(k+1) spans."""

    def nodes(self, level: int) -> NDArray[np.intp]:
        """All nodes of a level."""
        return np.arange(self.blocks.boxes[level].shape[1])

    @property
    def box(self) -> NDArray[np.float64]:
        """Box of all of it: lower corner, and the negative of the upper, shape (4,)."""
        level = self.depth - 1
        box: NDArray[np.float64] = self.boxes(level, self.nodes(level)).min(axis=1)
        return box

    @abstractmethod
    def boxes(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Boxes of some nodes, shape (4, m): lower corners, and the negatives of the upper."""

    def deviations(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """How far the polygon leaves the chords of some nodes, shape (m,)."""
        return taken(self.blocks.deviations[level], nodes)

    @abstractmethod
    def slack(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """How much further this may leave its own chords, between its own ends, shape (m,)."""

    @abstractmethod
    def places(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """Its exact points at t = 0, 1, ..., spans: shape (2, ...) for indices (...)."""

    @abstractmethod
    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Exact ends of the spans of some blocks, and how far each coordinate leaves the chord.

        Parameters
        ----------
        blocks
            Rising indices of nodes of level 0, shape (m,).

        Returns
        -------
        ends, margins
            Shapes (2, 9, m) and (2, 8, m): the blocks lie along the last axis, where loops are
            long. Spans beyond the end of the curve are points.
        """


class CurvePyramid(Pyramid):
    """The levels of detail of the limit curve.

    Parameters
    ----------
    blocks
        Those of its polygon. After a change of the scheme a new pyramid is due; to make it takes
        no time.

    Attributes
    ----------
    finest
        None, or the dyadic level at which the curve is drawn because no convergence is proven.

    Raises
    ------
    NoLimitError
        If the scheme has no unique limit.
    """

    def __init__(self, blocks: Blocks) -> None:
        super().__init__(blocks)
        self.curve = blocks.curve
        mask = self.curve.mask
        known = bounds(mask)
        self.finest = known.finest
        self._chord, self._polygon, self._knot = known.chord, known.polygon, known.knot
        self._read = mask.end - mask.start - 1
        self._weights = BasicLimitFunction(mask).table(0)[:-1, 0]
        # Row s of this matrix makes the curve point s steps on from the points of a block.
        self._limits = np.zeros((FAN + 1, len(self._weights) + FAN))
        for s in range(FAN + 1):
            self._limits[s, s : s + len(self._weights)] = self._weights

    def boxes(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """See `Pyramid.boxes`."""
        margins = self.blocks.bends[level].take(nodes, axis=1)
        margins *= self._polygon
        boxes = self.blocks.boxes[level].take(nodes, axis=1)
        both = boxes.reshape(2, 2, -1)
        both -= margins
        return boxes

    def slack(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """See `Pyramid.slack`."""
        slack = lengths(*self.blocks.bends[level].take(nodes, axis=1))
        slack *= self._polygon + self._knot
        return slack

    def places(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """See `Pyramid.places`."""
        coordinates = self.curve.endless_points.T
        read = indices.ravel() + np.arange(len(self._weights))[:, None]
        held = gathered(coordinates, read)
        places: NDArray[np.float64] = (self._weights @ held).reshape(2, *indices.shape)
        if not self.curve.closed:
            # The end rules hold up to rounding, which schemes that diverge enlarge.
            first, last = self.curve.control_points[[0, -1]]
            places[:, indices == 0] = first[:, None]
            places[:, indices == self.spans] = last[:, None]
        return places

    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `Pyramid.spans_of`."""
        coordinates = self.curve.endless_points.T
        # What would lie beyond the end is the last point.
        places = FAN * blocks + np.arange(self._limits.shape[1])[:, None]
        held = gathered(coordinates, places)
        ends = self._limits @ held
        bends = running_max(bends_of(held.transpose(0, 2, 1)), self._read)
        margins = self._chord * bends.transpose(0, 2, 1)
        beyond = self.spans - FAN * int(blocks[-1])
        if beyond < FAN:
            ends[:, beyond:, -1] = ends[:, beyond : beyond + 1, -1]
            margins[:, beyond:, -1] = 0.0
        return ends, margins


    def level(self, margins: NDArray[np.float64], tolerance: float) -> int | None:
        """Dyadic level at which the chords of some spans are straight enough.

        Parameters
        ----------
        margins
            How far the spans leave their own chords, as told by `spans_of`, at least one.
        tolerance
            Largest admitted distance between curve and chords.

        Returns
        -------
        int or None
            Always `finest` where no convergence is proven. None where a span has to be cut to what
            is looked at of it.
        """
        if self.finest is not None:
            return self.finest
        bend = float(margins.max()) / self._chord
        for level in range(_FINEST + 1):
            if bend * chord_constant(self.curve.mask, level) <= tolerance:
                return level
        return None


class PolygonPyramid(Pyramid):
    """The levels of detail of the control polygon itself; its spans are the edges."""

    @property
    def points(self) -> NDArray[np.float64]:
        """The control points, shape (n, 2)."""
        return self.blocks.curve.control_points

    @property
    def closed(self) -> bool:
        """Whether an edge leads from the last point to the first."""
        return self.blocks.curve.closed

    def boxes(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """See `Pyramid.boxes`."""
        return self.blocks.boxes[level].take(nodes, axis=1)

    def slack(self, level: int, nodes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Nothing; see `Pyramid.slack`."""
        return np.zeros_like(self.deviations(level, nodes))

    def places(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """See `Pyramid.places`."""
        points = self.points
        places: NDArray[np.float64] = points.T[:, indices % len(points)]
        return places

    def spans_of(self, blocks: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `Pyramid.spans_of`."""
        places = np.minimum(FAN * blocks + np.arange(FAN + 1)[:, None], self.spans)
        return self.places(places), np.zeros((2, FAN, len(blocks)))


def meets(boxes: NDArray[np.float64], limits: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which boxes (4, ...) have a point in a rectangle, itself (4,): upper x, y, - lower x, y."""
    x, y, left, below = boxes
    found: NDArray[np.bool_] = (x <= limits[0]) & (y <= limits[1])
    found &= (left <= limits[2]) & (below <= limits[3])
    return found


def contained(boxes: NDArray[np.float64], limits: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which boxes (4, ...) that are not empty lie in a rectangle; limits as in `meets`."""
    x, y, left, below = boxes
    found: NDArray[np.bool_] = (-left <= limits[0]) & (-below <= limits[1])
    found &= (-x <= limits[2]) & (-y <= limits[3]) & (x < np.inf)
    return found
