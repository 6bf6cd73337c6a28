"""What a hand does to a document: pure functions, each with the name that undo shows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from app.handles import EdgeHit
from app.point_set import PointSet
from core.affine import Affine
from core.document import MAX_COORDINATE_MM, Curve, Document
from core.errors import NinepointError


def counted(verb: str, count: int) -> str:
    """Name of an edit: "Move point", "Move 3 points"."""
    return f"{verb} point" if count == 1 else f"{verb} {count} points"


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
        places = np.clip(curve.places(members) + shift, -MAX_COORDINATE_MM, MAX_COORDINATE_MM)
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
    names = {curve.name for curve in document.curves}
    number = len(document.curves) + 1
    while f"Curve {number}" in names:
        number += 1
    places = np.clip(points_mm, -MAX_COORDINATE_MM, MAX_COORDINATE_MM)
    return document.with_curve_added(Curve(places, closed, f"Curve {number}"))
