"""Runs of vertices: chords that were found in any order, put in the order of t."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

PARTS: Final = 8
"""Parts into which a stretch of a curve is cut that is too bent for one chord."""

_EXPLORED: Final = 2048
"""Number of parts, seen in part at best, that are cut at a time to find what is seen of them."""


class Runs(NamedTuple):
    """Runs of consecutive vertices, in the direction of t.

    Attributes
    ----------
    vertices
        Points of the curve, less the origin that was asked for, shape (v, 2).
    parameters
        Their t, shape (v,).
    starts
        First vertex of each run, and v: shape (runs + 1,).
    deviation
        Proven bound of the distance between the runs and the parts of the curve that they stand
        for; larger than the tolerance only where the budget did not suffice.
    """

    vertices: NDArray[np.float64]
    parameters: NDArray[np.float64]
    starts: NDArray[np.intp]
    deviation: float

    def carried(self, factors: NDArray[np.float64], shift: NDArray[np.float64]) -> Runs:
        """The same with vertices ``v * factors + shift``; the deviation stays as it was told."""
        return Runs(self.vertices * factors + shift, self.parameters, self.starts, self.deviation)

    def runs(self) -> Iterator[NDArray[np.float64]]:
        """The vertices of each run."""
        for first, after in zip(self.starts[:-1], self.starts[1:], strict=True):
            yield self.vertices[first:after]


@lru_cache(maxsize=256)
def counted(count: int) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Parameters 0, 1, 2 ... of a single run of some vertices, and its `Runs.starts`.

    They are the same arrays each time, read-only.
    """
    t, starts = np.arange(count, dtype=np.float64), np.array([0, count], dtype=np.intp)
    t.flags.writeable = starts.flags.writeable = False
    return t, starts


class Chords:
    """Chords that were found, piece by piece, as long as a budget lasts.

    Parameters
    ----------
    origin
        What is subtracted from the points at whole t, shape (2,).
    budget
        Number of chords to be kept, about.
    places
        Points at whole t, shape (2, k) for k of them.

    Attributes
    ----------
    deviation
        Largest bound of those taken; whoever adds chords raises it.
    """

    def __init__(
        self,
        origin: NDArray[np.float64],
        budget: int,
        places: Callable[[NDArray[np.intp]], NDArray[np.float64]],
    ) -> None:
        self.deviation = 0.0
        self._origin = origin
        self._places = places
        self._left = budget
        self._times: list[NDArray[np.float64]] = []
        self._points: list[NDArray[np.float64]] = []

    def affordable(
        self,
        wanted: NDArray[np.bool_],
        within: NDArray[np.bool_],
        bounds: NDArray[np.float64],
        count: int,
    ) -> NDArray[np.bool_]:
        """Those parts of what is wanted that the budget admits, the most bent ones first.

        Parameters
        ----------
        wanted
            Parts that shall be cut.
        within
            Parts of which all is seen. Of the others little may be: some are cut for nothing.
        bounds
            How bent the parts are.
        count
            Number of chords if none is cut; each that is takes `PARTS` instead of one.
        """
        admitted = max((self._left - count) // (PARTS - 1), 0)
        number = int(np.count_nonzero(wanted))
        certain = int(np.count_nonzero(wanted & within))
        if number <= admitted or (certain <= admitted and number <= _EXPLORED):
            return wanted
        chosen = np.zeros_like(wanted)
        if admitted:
            places = np.flatnonzero(wanted)
            worst = np.argpartition(bounds.ravel()[places], -admitted)[-admitted:]
            chosen.ravel()[places[worst]] = True
        return chosen

    def thinned(self, levels: NDArray[np.intp]) -> NDArray[np.intp]:
        """Dyadic levels, all lowered alike until the budget admits ``2^level`` chords for each."""
        while levels.any() and int((1 << levels).sum()) > self._left:
            levels = np.maximum(levels - 1, 0)
        return levels

    def add_parts(self, times: NDArray[np.intp]) -> None:
        """Take chords over whole spans, by the t of both ends (2, k).

        Their points are made in the end, because neighbours have most of them in common.
        """
        self._add(times, np.full((2, times.shape[1], 2), np.nan))

    def add_curve(
        self, start: NDArray[np.float64], length: float, points: NDArray[np.float64]
    ) -> None:
        """Take the chords of points (2, k, m + 1), m on each stretch of t from ``start`` (k,)."""
        count = points.shape[2] - 1
        times = start[:, None] + length / count * np.arange(count + 1)
        ends = np.stack([points[:, :, :-1], points[:, :, 1:]], axis=-1).reshape(2, -1, 2)
        self._add(np.stack([times[:, :-1].ravel(), times[:, 1:].ravel()]), ends)

    def _add(self, times: NDArray[np.generic], ends: NDArray[np.float64]) -> None:
        if not times.size:
            return
        self._left -= times.shape[1]
        self._times.append(times.astype(np.float64))
        self._points.append(ends)

    def joined(self) -> Runs:
        """All chords as runs, in the order of t."""
        if not self._times:
            return Runs(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp), 0.0)
        times = np.concatenate(self._times, axis=1)
        ends = np.concatenate(self._points, axis=1)
        order = np.argsort(times[0])
        start, after = times[:, order]
        # A run ends where the next chord starts elsewhere; t is dyadic, so they can be compared.
        last = np.append(start[1:] != after[:-1], True)
        place = np.arange(len(start)) + np.cumsum(last) - last
        count = int(place[-1]) + 2
        vertices, parameters = np.empty((2, count)), np.empty(count)
        vertices[:, place], parameters[place] = ends[:, order, 0], start
        tips = place[last] + 1
        vertices[:, tips], parameters[tips] = ends[:, order[last], 1], after[last]
        unknown = np.flatnonzero(np.isnan(vertices[0]))
        whole = parameters[unknown].astype(np.intp)
        vertices[:, unknown] = self._places(whole) - self._origin[:, None]
        starts = np.concatenate([[0], tips + 1])
        return Runs(vertices.T, parameters, starts, self.deviation)
