"""Areas on a grid of whole numbers, and what pyclipr (Clipper2) does with them.

An area is given by its edges: the outer ones run counterclockwise, holes clockwise. An edge is an
array of rows x, y, and the number from 1 of the polygon that its vertex comes from; 0 if of none.
"""

from __future__ import annotations

import math
import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError

_GRID: Final = 2.0**-10
"""Unit of the grid, as a share of the tolerance, at most."""

_LARGEST: Final = 2.0**50
"""Largest coordinate on the grid: Clipper2 computes differences of them in floats."""


def library() -> Any:
    """The module pyclipr, which ships no type information that mypy could check.

    Raises
    ------
    NinepointError
        If it is not installed; the sentence tells the command that installs it.
    """
    try:
        import pyclipr
    except ImportError as error:
        command = f"{shlex.quote(sys.executable)} -m pip install pyclipr"
        raise NinepointError(
            f"A kerf needs pyclipr, which is not installed. To install it, type: {command}"
        ) from error
    return pyclipr


@dataclass(frozen=True, eq=False)
class Grid:
    """Whole numbers that stand for places: ``(place - origin) scale``.

    Attributes
    ----------
    origin
        Shape (2,), the middle of what is to be drawn, nearly.
    scale
        Numbers for each millimetre, a power of two, so that scaling rounds nothing.
    """

    origin: NDArray[np.float64]
    scale: float

    @classmethod
    def of(
        cls, polygons: Sequence[NDArray[np.float64]], kerf: float, tolerance: float
    ) -> Grid:
        """Grid fine enough for polygons, an offset, and its tolerance.

        Raises
        ------
        NinepointError
            If the polygons are too large for that.
        """
        low = np.min([polygon.min(axis=0) for polygon in polygons], axis=0)
        high = np.max([polygon.max(axis=0) for polygon in polygons], axis=0)
        scale = 2.0 ** math.ceil(-math.log2(_GRID * tolerance))
        # Whole numbers, so that shifting by them rounds as little as can be.
        origin = np.rint((low + high) / 2)
        reach = float(np.abs([low - origin, high - origin]).max()) + 2 * abs(kerf)
        if reach * scale > _LARGEST:
            raise NinepointError(
                f"A drawing of {2 * reach:g} mm cannot be offset within {tolerance:g} mm;"
                " choose a larger tolerance."
            )
        return cls(origin, scale)

    def put(self, points: NDArray[np.float64], index: int) -> NDArray[np.float64]:
        """Rows x, y on the grid, and the number of the polygon, from 1: 0 is Clipper's "none"."""
        rows = np.full((len(points), 3), float(index + 1))
        rows[:, :2] = np.rint((points - self.origin) * self.scale)
        return rows

    def taken(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Places of rows."""
        places: NDArray[np.float64] = rows[:, :2] / self.scale + self.origin
        return places


@dataclass(frozen=True, eq=False)
class Node:
    """An edge of an area, and the edges directly inside it: of holes, or of islands in a hole."""

    rows: NDArray[np.float64]
    inner: tuple[Node, ...]

    def turned(self) -> NDArray[np.float64]:
        """The edge the other way round."""
        return self.rows[::-1]


def engine_of(clipper: Any, paths: list[NDArray[np.float64]]) -> Any:
    """Engine of the module `library` that knows some paths; they may cross, and run as they like.

    Its ``execute2(kind)`` combines them by the even-odd rule; `tree` reads what that gives.
    """
    engine = clipper.Clipper()
    engine.scaleFactor = 1.0
    engine.addPaths(paths, clipper.PathType.Subject)
    return engine


def tree(root: Any) -> tuple[Node, ...]:
    """Outermost edges of what an engine found, with those inside them.

    No recursion: contours may be nested as deep as they like.
    """
    order = [root]
    for node in order:
        order += node.children
    made: dict[int, Node] = {}
    for node in reversed(order[1:]):
        inner = tuple(made.pop(id(child)) for child in node.children)
        made[id(node)] = Node(np.column_stack([node.polygon, node.attributes]), inner)
    return tuple(made[id(child)] for child in root.children)


def grown(
    clipper: Any, paths: list[NDArray[np.float64]], reach: float, joins: float
) -> list[list[NDArray[np.float64]]]:
    """Edges of an area grown by a radius, those of each connected part together.

    Parameters
    ----------
    clipper
        The module `library`.
    paths
        Edges of the area, none of which crosses another.
    reach
        The radius, in units of the grid; if negative the area shrinks.
    joins
        How far chords may leave round joins, in units of the grid.
    """
    engine = clipper.ClipperOffset()
    engine.scaleFactor = 1.0
    engine.arcTolerance = joins
    engine.addPaths(paths, clipper.JoinType.Round, clipper.EndType.Polygon)
    found = []
    waiting = [*tree(engine.execute2(reach))]
    for node in waiting:
        found.append([node.rows, *[hole.rows for hole in node.inner]])
        waiting += [island for hole in node.inner for island in hole.inner]
    return found


def length(rows: NDArray[np.float64]) -> float:
    """Length of a closed edge, in units of the grid."""
    way = np.roll(rows[:, :2], -1, axis=0) - rows[:, :2]
    return float(np.hypot(*way.T).sum())


def doubled_area(points: NDArray[np.float64]) -> float:
    """Twice the area, positive if it lies to the left."""
    x, y = (points[:, :2] - points[0, :2]).T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
