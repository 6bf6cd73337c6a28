"""What a file holds and the window shows: frozen values, so that undo is a list of them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.affine import IDENTITY, Affine
from core.errors import NinepointError
from core.extreme import largest, least
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.ranges import united

if TYPE_CHECKING:
    from core.profiles import Profile

MAX_COORDINATE_MM: Final = 1e9
"""Largest admitted coordinate. At this size a float still resolves a tenth of a micrometre."""

MAX_POINTS: Final = 1_000_000
"""Largest number of control points in a document."""

_MOVED_SHARE: Final = 1 / 16
"""Share of a curve's points up to which moves are kept apart from the points that they change."""


class _Base:
    """Points that several curves have in common."""

    def __init__(self, points: NDArray[np.float64]) -> None:
        self.points = points

    @cached_property
    def box(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower and upper corner; there must be a point."""
        # Column by column, which is ten times faster than along the first axis.
        columns = self.points.T
        return np.array([c.min() for c in columns]), np.array([c.max() for c in columns])


class _Moves(NamedTuple):
    """What a curve has different from the points of its base.

    All of them are ``placed``; then those at rising ``indices`` have other ``positions``. Its
    ``name`` is an object of its own; a curve that came from another one by `Curve.moved` knows that
    one's name, its ``origin``, and rising indices of the points that were moved then.
    """

    base: _Base
    placed: Affine
    indices: NDArray[np.intp]
    positions: NDArray[np.float64]
    name: object
    origin: object
    moved: NDArray[np.intp]


_NONE: Final = np.zeros(0, dtype=np.intp)


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

    Notes
    -----
    A curve that comes from `moved` or `carried` keeps the other curve and what is different, so
    that an event of a drag costs what moves and not what there is; its ``points`` are made when
    they are asked for. Who draws it asks for `placed`, `differences` and `places` instead.
    """

    points: NDArray[np.float64]
    closed: bool = True
    name: str = "Curve"
    _moves: _Moves = field(init=False, repr=False)

    def __post_init__(self) -> None:
        points = np.array(self.points, dtype=np.float64)
        if points.size == 0:
            points = points.reshape(0, 2)
        if points.ndim != 2 or points.shape[1] != 2:
            raise NinepointError(f"A curve needs two coordinates a point, not {points.shape}.")
        _check(points, np.arange(len(points)), self.name)
        points.flags.writeable = False
        object.__setattr__(self, "points", points)
        moves = _Moves(
            _Base(points), IDENTITY, _NONE, np.zeros((0, 2)), object(), object(), _NONE
        )
        object.__setattr__(self, "_moves", moves)

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        # Reached only where an attribute is missing: the points of a moved curve, once.
        if name != "points" or "_moves" not in vars(self):
            raise AttributeError(name)
        moves = self._moves
        points = moves.placed(moves.base.points)
        points[moves.indices] = moves.positions
        points.flags.writeable = False
        object.__setattr__(self, "points", points)
        return points

    @property
    def count(self) -> int:
        """Number of control points."""
        return len(self._moves.base.points)

    @property
    def placed(self) -> Affine:
        """Map by which the points lie elsewhere than those that `differences` compares with."""
        return self._moves.placed

    @property
    def box(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower and upper corner of the control points, of which there must be one."""
        moves = self._moves
        if moves.placed.is_shift and not len(moves.indices):
            low, high = moves.base.box
            return moves.placed(low), moves.placed(high)
        return _Base(self.points).box

    @property
    def is_loop(self) -> bool:
        """Whether the limit curve is drawn closed: closed, and at least three points."""
        return self.closed and self.count >= 3

    def limit(self, parameters: Parameters) -> LimitCurve:
        """Limit curve of the polygon; two points give a segment, one a dot, none nothing."""
        return LimitCurve(self.points, parameters.mask, self.is_loop)

    def moved(self, indices: ArrayLike, positions: ArrayLike) -> Curve:
        """Copy with the points at ``indices`` (k,) put at ``positions`` (k, 2) or (2,)."""
        chosen = np.asarray(indices, dtype=np.intp)
        if chosen.ndim != 1:
            chosen = chosen.reshape(-1)
        count = self.count
        if len(chosen):
            first, last = least(chosen), largest(chosen)
            if not -count <= first <= last < count:
                raise IndexError(f"{self.name!r} has {count} points")
            if first < 0:
                chosen = chosen % count
        places = np.empty((len(chosen), 2))
        places[:] = positions
        _check(places, chosen, self.name)
        # Of several positions for one point the last one holds.
        if len(chosen) > _MOVED_SHARE * count:
            points = self.points.copy()
            points[chosen] = places
            return replace(self, points=points)
        if len(chosen) > 1 and not (chosen[1:] > chosen[:-1]).all():
            chosen, last = np.unique(chosen[::-1], return_index=True)
            places = places[::-1][last]
        # An array that cannot change is kept: in a drag it is known again by that.
        if chosen.flags.writeable:
            chosen = chosen.copy()
            chosen.flags.writeable = False
        before, changed = self._moves, chosen
        if len(before.indices):
            together = np.concatenate([before.indices, chosen])[::-1]
            changed, last = np.unique(together, return_index=True)
            places = np.concatenate([before.positions, places])[::-1][last]
        curve = self._with(
            _Moves(before.base, before.placed, changed, places, object(), before.name, chosen)
        )
        return replace(curve) if len(changed) > _MOVED_SHARE * count else curve

    def carried(self, placed: Affine) -> Curve:
        """Copy with all points carried by an affine map; its cost does not depend on their number.

        Raises
        ------
        NinepointError
            If the map leads beyond `MAX_COORDINATE_MM`.
        """
        if not self.count:
            return self
        before = self._moves
        whole, positions = placed.after(before.placed), placed(before.positions)
        corners = np.concatenate([*whole.box(*before.base.box), positions.ravel()])
        if not np.abs(corners).max() <= MAX_COORDINATE_MM:
            raise NinepointError(
                f"{self.name!r} would leave the sheet: coordinates are at most"
                f" {MAX_COORDINATE_MM:g} mm."
            )
        return self._with(
            _Moves(before.base, whole, before.indices, positions, object(), object(), _NONE)
        )

    def _with(self, moves: _Moves) -> Curve:
        curve = object.__new__(Curve)
        vars(curve).update(closed=self.closed, name=self.name, _moves=moves)
        return curve

    def differences(self, other: Curve) -> NDArray[np.intp] | None:
        """Indices of the points that may lie elsewhere in another curve, rising.

        That is, elsewhere than where `placed` puts both. None if the curves have no common origin
        that tells it without comparing all points.
        """
        mine, others = self._moves, other._moves
        if mine.base is not others.base:
            return None
        # Curves that came from one, or one from the other, differ in what was moved since.
        if mine.origin is others.origin:
            return united(mine.moved, others.moved)
        if mine.origin is others.name:
            return mine.moved
        if others.origin is mine.name:
            return others.moved
        return united(mine.indices, others.indices)

    def places(self, indices: ArrayLike) -> NDArray[np.float64]:
        """Positions of the points at ``indices`` (k,), shape (k, 2)."""
        chosen = np.asarray(indices, dtype=np.intp)
        moves = self._moves
        if chosen is moves.indices:
            return moves.positions.copy()
        positions: NDArray[np.float64] = moves.base.points[chosen]
        if moves.placed is not IDENTITY:
            positions = moves.placed(positions)
        if len(moves.indices):
            found = moves.indices.searchsorted(chosen)
            moved = moves.indices.take(found, mode="clip") == chosen
            positions[moved] = moves.positions[found[moved]]
        return positions

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
    profiles
        Export profiles that belong to the drawing, with different names.

    Raises
    ------
    NinepointError
        If the curves have more than `MAX_POINTS` points in all, or two profiles the same name.
    """

    curves: tuple[Curve, ...] = ()
    parameters: Parameters = field(default_factory=lambda: PRESETS["Calm"])
    profiles: tuple[Profile, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "curves", tuple(self.curves))
        total = sum(curve.count for curve in self.curves)
        if total > MAX_POINTS:
            raise NinepointError(
                f"The drawing has {total:,} control points; at most {MAX_POINTS:,} are admitted."
            )

        object.__setattr__(self, "profiles", tuple(self.profiles))
        if len({profile.name for profile in self.profiles}) < len(self.profiles):
            raise NinepointError("Two export profiles of the drawing have the same name.")

    def lists_as(self, other: Document) -> bool:
        """Whether it has as many curves, each of the same name, kind and number of points."""
        return len(self.curves) == len(other.curves) and all(
            one is two or (one.count, one.closed, one.name) == (two.count, two.closed, two.name)
            for one, two in zip(self.curves, other.curves, strict=True)
        )

    def with_profile(self, profile: Profile) -> Document:
        """Copy with an export profile, in place of one of the same name."""
        others = tuple(held for held in self.profiles if held.name != profile.name)
        return replace(self, profiles=(*others, profile))

    def without_profile(self, name: str) -> Document:
        """Copy without the export profile of a name."""
        kept = tuple(held for held in self.profiles if held.name != name)
        return replace(self, profiles=kept)

    def with_curve(self, index: int, curve: Curve) -> Document:
        """Copy with another curve at ``index``."""
        before = self.curves[index]
        curves = list(self.curves)
        curves[index] = curve
        if curve.count > before.count:
            return replace(self, curves=tuple(curves))
        # What was admitted stays so, and thousands of curves are not counted for each move.
        document = object.__new__(Document)
        vars(document).update(vars(self), curves=tuple(curves))
        return document

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


def _check(points: NDArray[np.float64], indices: NDArray[np.intp], name: str) -> None:
    """Refuse points that are not admitted; the message counts them from 1 by ``indices``."""
    # A comparison with nan is false, so this catches nan as well.
    if not len(points) or largest(np.abs(points)) <= MAX_COORDINATE_MM:
        return
    bad = ~(np.abs(points) <= MAX_COORDINATE_MM).all(axis=1)
    first = int(bad.argmax())
    x, y = points[first]
    raise NinepointError(
        f"Point {indices[first] + 1} of {name!r} is ({x:g}, {y:g}); coordinates must be"
        f" finite and at most {MAX_COORDINATE_MM:g} mm."
    )
