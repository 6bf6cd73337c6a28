"""What a file holds and the window shows: frozen values, so that undo is a list of them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve

MAX_COORDINATE_MM: Final = 1e9
"""Largest admitted coordinate. At this size a float still resolves a tenth of a micrometre."""

MAX_POINTS: Final = 1_000_000
"""Largest number of control points in a document."""


@dataclass(frozen=True, eq=False)
class Curve:
    """One control polygon, in millimetres.

    Parameters
    ----------
    points
        Control points, shape (n, 2); finite, at most `MAX_COORDINATE_MM` in size. They are copied
        and made read-only.
    closed
        Whether the polygon is closed. A polygon of fewer than three points is drawn open.
    name
        What the user calls it.

    Raises
    ------
    NinepointError
        If the points are not (n, 2) finite numbers of an admitted size; the message names the
        first bad point, counted from 1.
    """

    points: NDArray[np.float64]
    closed: bool = True
    name: str = "Curve"

    def __post_init__(self) -> None:
        points = np.array(self.points, dtype=np.float64)
        if points.size == 0:
            points = points.reshape(0, 2)
        if points.ndim != 2 or points.shape[1] != 2:
            raise NinepointError(f"A curve needs two coordinates a point, not {points.shape}.")
        # A comparison with nan is false, so this catches nan as well.
        bad = ~(np.abs(points) <= MAX_COORDINATE_MM).all(axis=1)
        if bad.any():
            index = int(bad.argmax())
            x, y = points[index]
            raise NinepointError(
                f"Point {index + 1} of {self.name!r} is ({x:g}, {y:g}); coordinates must be"
                f" finite and at most {MAX_COORDINATE_MM:g} mm."
            )
        points.flags.writeable = False
        object.__setattr__(self, "points", points)

    @property
    def is_loop(self) -> bool:
        """Whether the limit curve is drawn closed: closed, and at least three points."""
        return self.closed and len(self.points) >= 3

    def limit(self, parameters: Parameters) -> LimitCurve:
        """Limit curve of the polygon; two points give a segment, one a dot, none nothing."""
        return LimitCurve(self.points, parameters.mask, self.is_loop)

    def moved(self, indices: ArrayLike, positions: ArrayLike) -> Curve:
        """Copy with the points at ``indices`` (k,) put at ``positions`` (k, 2) or (2,)."""
        points = self.points.copy()
        points[np.asarray(indices, dtype=np.intp)] = positions
        return replace(self, points=points)

    def inserted(self, index: int, position: ArrayLike) -> Curve:
        """Copy with a new point before point ``index`` (0 to n)."""
        return replace(self, points=np.insert(self.points, index, position, axis=0))

    def without(self, indices: ArrayLike) -> Curve:
        """Copy without the points at ``indices``."""
        return replace(
            self, points=np.delete(self.points, np.asarray(indices, dtype=np.intp), axis=0)
        )


@dataclass(frozen=True, eq=False)
class Document:
    """Curves that share one scheme.

    Parameters
    ----------
    curves
        The curves, drawn in this order.
    parameters
        The member of the family that draws all of them; Calm by default.

    Raises
    ------
    NinepointError
        If the curves have more than `MAX_POINTS` points in all.
    """

    curves: tuple[Curve, ...] = ()
    parameters: Parameters = field(default_factory=lambda: PRESETS["Calm"])

    def __post_init__(self) -> None:
        object.__setattr__(self, "curves", tuple(self.curves))
        total = sum(len(curve.points) for curve in self.curves)
        if total > MAX_POINTS:
            raise NinepointError(
                f"The drawing has {total:,} control points; at most {MAX_POINTS:,} are admitted."
            )

    def with_curve(self, index: int, curve: Curve) -> Document:
        """Copy with another curve at ``index``."""
        curves = list(self.curves)
        curves[index] = curve
        return replace(self, curves=tuple(curves))

    def with_curve_added(self, curve: Curve) -> Document:
        """Copy with one more curve at the end."""
        return replace(self, curves=(*self.curves, curve))

    def without_curves(self, indices: set[int] | frozenset[int]) -> Document:
        """Copy without the curves at ``indices``."""
        kept = tuple(curve for i, curve in enumerate(self.curves) if i not in indices)
        return replace(self, curves=kept)

    def with_parameters(self, parameters: Parameters) -> Document:
        """Copy drawn by another member of the family."""
        return replace(self, parameters=parameters)
