"""Ranges of spans around control points that have moved."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray


def around(indices: NDArray[np.intp], before: int, after: int) -> list[tuple[int, int]]:
    """Intervals ``[i - before, i + after)``; those that meet become one.

    Parameters
    ----------
    indices
        Places, in any order, shape (k,) or ().
    before, after
        How far each interval goes.
    """
    if indices.size == 1:
        index = int(indices.item())
        return [(index - before, index + after)]
    if indices.size == 0:
        return []
    places = np.unique(indices)
    gaps = np.flatnonzero(np.diff(places) > before + after)
    starts = places[np.concatenate([[0], gaps + 1])] - before
    stops = places[np.concatenate([gaps, [len(places) - 1]])] + after
    return list(zip(starts.tolist(), stops.tolist(), strict=True))


def united(one: NDArray[np.intp], other: NDArray[np.intp]) -> NDArray[np.intp]:
    """Rising indices that are in one of two rising arrays, or in both.

    In a drag both are mostly the same, or one is empty; that is seen without sorting.
    """
    if one is other or not len(other):
        return one
    if not len(one) or (len(one) == len(other) and (one == other).all()):
        return other
    return np.union1d(one, other)


def within(intervals: Iterable[tuple[int, int]], spans: int, closed: bool) -> tuple[range, ...]:
    """Rising disjoint ranges in ``range(spans)``: cut off at open ends, carried over a seam.

    Parameters
    ----------
    intervals
        Pairs (start, stop), which may overlap and reach one turn beyond ``range(spans)``.
    spans
        Number of spans.
    closed
        Whether the last span is followed by the first.
    """
    parts = []
    for start, stop in intervals:
        if closed and stop - start >= spans:
            return (range(spans),)
        if closed and start < 0:
            parts += [(start + spans, spans), (0, stop)]
        elif closed and stop > spans:
            parts += [(start, spans), (0, stop - spans)]
        else:
            parts.append((max(start, 0), min(stop, spans)))
    parts.sort()
    found: list[tuple[int, int]] = []
    for start, stop in parts:
        if found and start <= found[-1][1]:
            found[-1] = found[-1][0], max(stop, found[-1][1])
        elif start < stop:
            found.append((start, stop))
    return tuple(range(start, stop) for start, stop in found)
