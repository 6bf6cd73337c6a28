"""What a hand does to a document: pure functions, each with the name that undo shows."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.handles import EdgeHit
from app.point_set import PointSet
from core.affine import Affine
from core.document import MAX_COORDINATE_MM, Curve, Document
from core.errors import NinepointError

_COVERED: Final = 4
"""Part of a step up to which a curve lies on another one."""


def counted(verb: str, count: int, noun: str = "point") -> str:
    """Name of an edit: "Move point", "Move 3 points"."""
    return f"{verb} {noun}" if count == 1 else f"{verb} {count} {noun}s"


def moved(
    document: Document, points: Iterable[tuple[int, int]], delta_mm: ArrayLike
) -> Document:
    """Document with some points shifted by ``delta_mm`` (2,); they stop at the admitted edge."""
    return shifted(document, PointSet.of(points).by_curve, delta_mm)


def shifted(
    document: Document, points: Mapping[int, ArrayLike], delta_mm: ArrayLike
) -> Document:
    """The same as `moved`, with the indices of the points given for each curve."""
    shift = np.asarray(delta_mm, dtype=np.float64)
    for index, members in points.items():
        curve = document.curves[index]
        if np.size(members) == curve.count:
            try:
                document = document.with_curve(index, curve.carried(Affine.shift(shift)))
                continue
            except NinepointError:  # only some of the points stop at the edge
                pass
        places = np.minimum(curve.places(members) + shift, MAX_COORDINATE_MM)
        places = np.maximum(places, -MAX_COORDINATE_MM)
        document = document.with_curve(index, curve.moved(members, places))
    return document


def with_moved(
    document: Document, index: int, points: ArrayLike, places_mm: ArrayLike
) -> Document:
    """Document with some points of one curve elsewhere; at the admitted edge they stop."""
    places = np.clip(places_mm, -MAX_COORDINATE_MM, MAX_COORDINATE_MM)
    return document.with_curve(index, document.curves[index].moved(points, places))


def without_points(document: Document, points: Iterable[tuple[int, int]]) -> Document:
    """Document without some points; a curve that has none left goes with them."""
    grouped = PointSet.of(points).by_curve
    emptied = set()
    for index, members in grouped.items():
        curve = document.curves[index].without(members)
        document = document.with_curve(index, curve)
        if not curve.count:
            emptied.add(index)
    return document.without_curves(emptied) if emptied else document


def with_point_on_edge(document: Document, hit: EdgeHit) -> tuple[Document, tuple[int, int]]:
    """Document with a new point on an edge of a polygon, and the pair (curve, point) it has."""
    curve = document.curves[hit.curve]
    start = curve.points[hit.edge]
    end = curve.points[(hit.edge + 1) % len(curve.points)]
    place = start + hit.share * (end - start)
    new = hit.edge + 1
    return document.with_curve(hit.curve, curve.inserted(new, place)), (hit.curve, new)


def with_new_curve(document: Document, points_mm: ArrayLike, closed: bool) -> Document:
    """Document with one more curve, named by its number."""
    number = len(document.curves) + 1
    name = unused(f"Curve {number}", {curve.name for curve in document.curves})
    places = np.clip(points_mm, -MAX_COORDINATE_MM, MAX_COORDINATE_MM)
    return document.with_curve_added(Curve(places, closed, name))


def with_curves(document: Document, curves: Iterable[Curve]) -> Document:
    """Document with more curves at the end; names that are taken get a number.

    Raises
    ------
    NinepointError
        If there would be too many points.
    """
    taken = {curve.name for curve in document.curves}
    numbers: dict[str, int] = {}
    added = []
    for curve in curves:
        name = unused(curve.name, taken, numbers)
        taken.add(name)
        added.append(curve if name == curve.name else replace(curve, name=name))
    return replace(document, curves=(*document.curves, *added))


def unused(name: str, taken: Container[str], numbers: dict[str, int] | None = None) -> str:
    """The name itself, or with the next number that is free: "Wing", "Wing 2", "Wing 3".

    Parameters
    ----------
    name
        What is wanted.
    taken
        Names that there are.
    numbers
        Where to go on for each name without its number, if many are asked for; it is kept up.
    """
    if name not in taken:
        return name
    found = re.fullmatch(r"(.*?) (\d{1,9})", name, re.ASCII | re.DOTALL)
    stem, number = (found[1], int(found[2])) if found else (name, 1)
    number = max(number, 1 if numbers is None else numbers.get(stem, 1))
    while f"{stem} {number}" in taken or number == 1:
        number += 1
    if numbers is not None:
        numbers[stem] = number
    return f"{stem} {number}"


def chosen(document: Document, selection: PointSet) -> Document:
    """What is copied when some points are selected.

    Curves all of whose points are selected, as they are; of others the selected points as an open
    curve, which on a closed one begins behind its longest stretch that is not selected; and the
    whole drawing if no point is selected.
    """
    if not selection:
        return document
    curves = []
    for index, members in selection.by_curve.items():
        curve = document.curves[index]
        if len(members) == curve.count:
            curves.append(curve)
            continue
        if curve.closed:
            gaps = np.diff(members, append=members[0] + curve.count)
            members = np.roll(members, -1 - int(gaps.argmax()))
        curves.append(Curve(curve.places(members), False, curve.name))
    return replace(document, curves=tuple(curves))


def shifted_curves(curves: Iterable[Curve], delta_mm: ArrayLike) -> tuple[Curve, ...]:
    """Curves elsewhere.

    Raises
    ------
    NinepointError
        If that leads beyond `MAX_COORDINATE_MM`.
    """
    shift = Affine.shift(np.asarray(delta_mm, dtype=np.float64))
    return tuple(curve.carried(shift) for curve in curves)


def centred(curves: Sequence[Curve], place_mm: ArrayLike) -> tuple[Curve, ...]:
    """Curves whose box has its middle at a place."""
    boxes = np.array([curve.box for curve in curves if curve.count])
    if not len(boxes):
        return tuple(curves)
    middle = (boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2
    return shifted_curves(curves, np.asarray(place_mm) - middle)


def uncovered(document: Document, curves: Sequence[Curve], step_mm: float) -> tuple[Curve, ...]:
    """Curves moved to the lower right by as few steps as it takes to lie on none that is there.

    Two curves lie on each other if their points do, up to a quarter of a step.
    """
    first = next((curve for curve in curves if curve.count), None)
    if first is None:
        return tuple(curves)
    rivals = [curve.points for curve in document.curves if curve.count == first.count]
    for count in range(len(rivals) + 1):
        shift = np.array([step_mm, -step_mm]) * count
        places = first.points + shift
        if not any((np.abs(rival - places) < step_mm / _COVERED).all() for rival in rivals):
            return shifted_curves(curves, shift) if count else tuple(curves)
    return tuple(curves)
