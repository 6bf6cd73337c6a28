"""A chain of cubics as a fine polygon: points by length, directions, corners, nearest places."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError

MAX_VERTICES: Final = 2**21
"""Largest number of vertices: each is looked at in each of a hundred attempts to fit."""

_CORNER: Final = 0.5
"""Angle in radians from which a vertex is a corner: the polygon of an arc whose sagittas are
1/32 of a tolerance turns by as much where the radius is no larger than the tolerance."""

_GRID: Final = 8
"""Places to a part at which turning is looked at."""


class Route:
    """The polygon along a chain of cubic Bézier curves, by the length along it.

    Parameters
    ----------
    controls
        Control points of the cubics, shape (n, 4, 2), n >= 1, finite; each cubic starts with the
        very numbers that the one before ends with, and when closed the last one ends where the
        first one starts. Cubics of no extent may be among them.
    closed
        Whether the chain is closed. Places along it are then taken modulo its length.
    admitted
        How far the chain may leave the polygon, > 0.

    Attributes
    ----------
    vertices
        Vertices as complex numbers, shape (m + 1,); no two neighbours are equal. When closed the
        last one is the first one.
    lengths
        Length from the start to each vertex, shape (m + 1,).
    bound
        Proven bound of the distance between chain and polygon, as moving points: a cubic leaves
        the chord of a part h of its interval by ``h^2 max |B''| / 8`` at most.
    corners
        Lengths at which the polygon has a corner, rising.

    Raises
    ------
    NinepointError
        If the chain is a dot, or needs more than `MAX_VERTICES` vertices.
    """

    def __init__(self, controls: NDArray[np.float64], closed: bool, admitted: float) -> None:
        cubics = controls[:, :, 0] + 1j * controls[:, :, 1]
        bends = 6 * np.abs(np.diff(cubics, n=2, axis=1)).max(axis=1)
        counts = np.maximum(np.ceil(np.sqrt(bends / (8 * admitted))), 1.0)
        if counts.sum() > MAX_VERTICES:
            raise NinepointError(
                f"This contour of {len(cubics):,} cubics is too long for so small a tolerance;"
                " choose a larger one, or cut the contour in parts."
            )
        self.bound = float((bends / (8 * counts**2)).max())
        vertices = _points(cubics, counts.astype(np.intp))
        kept = np.concatenate([[True], np.diff(vertices) != 0])
        vertices = vertices[kept]
        if len(vertices) < 2:
            raise NinepointError("A contour without extent cannot be fitted: it is a dot.")
        ways = np.diff(vertices)
        sizes = np.abs(ways)
        self.closed = closed
        self.vertices = vertices
        self.lengths = np.concatenate([[0.0], np.cumsum(sizes)])
        self._directions = ways / sizes
        turns = np.abs(np.angle(self._directions * np.roll(self._directions, 1).conj()))
        if not closed:
            turns[0] = 0.0
        self.corners = self.lengths[:-1][turns > _CORNER]
        self._turned = np.concatenate([[0.0], np.cumsum(turns)])
        """Angle by which the polygon has turned behind each vertex, up to the next."""

    @property
    def length(self) -> float:
        """Length of the polygon."""
        return float(self.lengths[-1])

    @property
    def turning(self) -> float:
        """Sum of the angles by which the polygon turns, in radians."""
        return float(self._turned[-1])

    def shared(self, parts: int) -> NDArray[np.float64]:
        """Places that cut the polygon into parts, by its length and its turning alike.

        What it turns by is spread over a part of its length. Shape (parts + 1,), rising from 0 to
        the length.
        """
        grid = np.linspace(0.0, self.length, _GRID * parts + 1)
        turned = np.interp(grid, self.lengths, self._turned)
        padded = np.pad(turned, _GRID // 2, mode="edge")
        sums = np.concatenate([[0.0], np.cumsum(padded)])
        smooth = sums[_GRID + 1 :] - sums[: -_GRID - 1]
        smooth -= smooth[0]
        both = grid / self.length
        if smooth[-1] > 0:
            both = (both + smooth / smooth[-1]) / 2
        places = np.interp(np.linspace(0.0, both[-1], parts + 1), both, grid)
        places[-1] = self.length
        return places

    def at(self, places: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Points at lengths along the polygon; beyond the ends of an open one, its ends."""
        if self.closed:
            places = places % self.length
        x = np.interp(places, self.lengths, self.vertices.real)
        return np.asarray(x + 1j * np.interp(places, self.lengths, self.vertices.imag))

    def directions(self, places: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Unit vectors along the polygon."""
        if self.closed:
            places = places % self.length
        sides = np.searchsorted(self.lengths, places, side="right") - 1
        return np.asarray(self._directions[np.clip(sides, 0, len(self._directions) - 1)])

    def nearer(
        self,
        points: NDArray[np.complex128],
        places: NDArray[np.float64],
        reach: NDArray[np.float64],
        steps: int,
    ) -> NDArray[np.float64]:
        """Places whose points are nearer to given ones, or as near, by steps of Newton's.

        Parameters
        ----------
        points
            What to come near to, shape (k,).
        places
            Where to start, shape (k,).
        reach
            Longest step of each, shape (k,).
        steps
            Number of steps.
        """
        off = points - self.at(places)
        for _ in range(steps):
            step = (off * self.directions(places).conj()).real
            tried = places + np.clip(step, -reach, reach)
            if not self.closed:
                np.clip(tried, 0.0, self.length, out=tried)
            left = points - self.at(tried)
            better = np.abs(left) < np.abs(off)
            places, off = np.where(better, tried, places), np.where(better, left, off)
        return places


def _points(cubics: NDArray[np.complex128], counts: NDArray[np.intp]) -> NDArray[np.complex128]:
    """Points of the cubics at equal steps of their parameters, and the end of the last one."""
    which = np.repeat(np.arange(len(cubics)), counts)
    steps = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    u = steps / counts[which]
    v = 1 - u
    one, two, three, four = cubics.T
    points = v * v * (v * one[which] + 3 * u * two[which])
    points += u * u * (3 * v * three[which] + u * four[which])
    return np.concatenate([points, four[-1:]])
