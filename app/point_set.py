"""A set of control points of several curves, held in arrays: a million are selected in a moment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_NONE: Final = np.zeros(0, dtype=np.intp)
_NONE.flags.writeable = False


class PointSet(Set[tuple[int, int]]):
    """Pairs (curve, point), an immutable set.

    Parameters
    ----------
    members
        For curves that have members, the indices of the points, in any order.
    """

    def __init__(self, members: Mapping[int, ArrayLike] | None = None) -> None:
        self._members: dict[int, NDArray[np.intp]] = {}
        for curve, points in sorted((members or {}).items()):
            held = _distinct(np.array(points, dtype=np.intp))
            if len(held):
                held.flags.writeable = False
                self._members[curve] = held

    @classmethod
    def of(cls, pairs: Iterable[tuple[int, int]]) -> PointSet:
        """The set of some pairs."""
        if isinstance(pairs, PointSet):
            return pairs
        grouped: dict[int, list[int]] = {}
        for curve, point in pairs:
            grouped.setdefault(curve, []).append(point)
        return cls(grouped)

    @classmethod
    def _from_iterable(cls, pairs: Iterable[Any]) -> Any:
        return cls.of(pairs)

    @property
    def by_curve(self) -> Mapping[int, NDArray[np.intp]]:
        """Rising indices of the points of each curve that has members."""
        return self._members

    def of_curve(self, curve: int) -> NDArray[np.intp]:
        """Rising indices of the points of one curve."""
        return self._members.get(curve, _NONE)

    def within(self, sizes: list[int]) -> PointSet:
        """Those that exist if the curves have so many points."""
        if all(
            curve < len(sizes) and points[-1] < sizes[curve]
            for curve, points in self._members.items()
        ):
            return self
        return PointSet(
            {
                curve: points[points < sizes[curve]]
                for curve, points in self._members.items()
                if curve < len(sizes)
            }
        )

    def __contains__(self, pair: object) -> bool:
        if not isinstance(pair, tuple) or len(pair) != 2:
            return False
        points = self.of_curve(pair[0])
        place = int(np.searchsorted(points, pair[1]))
        return place < len(points) and bool(points[place] == pair[1])

    def __iter__(self) -> Iterator[tuple[int, int]]:
        for curve, points in self._members.items():
            for point in points.tolist():
                yield curve, point

    def __len__(self) -> int:
        return sum(map(len, self._members.values()))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Set):
            return NotImplemented
        if len(self) != len(other):
            return False
        members = PointSet.of(other)._members
        return self._members.keys() == members.keys() and all(
            np.array_equal(points, members[curve]) for curve, points in self._members.items()
        )

    def __hash__(self) -> int:
        return hash(tuple((curve, points.tobytes()) for curve, points in self._members.items()))

    def __or__(self, other: Iterable[tuple[int, int]]) -> PointSet:  # type: ignore[override]
        others = PointSet.of(other)
        curves = self._members.keys() | others._members.keys()
        return PointSet(
            {
                curve: np.concatenate([self.of_curve(curve), others.of_curve(curve)])
                for curve in curves
            }
        )

    def __sub__(self, other: Iterable[tuple[int, int]]) -> PointSet:
        others = PointSet.of(other)
        return PointSet(
            {
                curve: np.setdiff1d(points, others.of_curve(curve), assume_unique=True)
                for curve, points in self._members.items()
            }
        )

    def __repr__(self) -> str:
        return f"PointSet({ {curve: points.tolist() for curve, points in self._members.items()} })"


def _distinct(points: NDArray[np.intp]) -> NDArray[np.intp]:
    """Rising indices, each once; mostly they are so already, or two such rows in one."""
    if (points[1:] > points[:-1]).all():
        return points
    points = np.sort(points, kind="stable")
    kept: NDArray[np.intp] = points[np.append(True, points[1:] > points[:-1])]
    return kept
