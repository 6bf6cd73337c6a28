"""The curves of a document as a file of outlines holds them.

Notes
-----
A file holds rounded numbers, so what is proven is proven for those. With d decimals a point moves
by at most ``r = sqrt(1/2) 10^-d``. That moves a polyline, a cubic, and a spline by at most r, as
their points are averages of the control points with weights that are not negative.

An arc from A to B with the bulge b is ``A + (B - A) z``, z being on the arc from 0 to 1 in the
complex plane. There ``w = z / (1 - z)`` runs along the ray from 0 under an angle of half of what
the arc turns by, that is ``2 atan b``: so ``z = w / (1 + w)``, and with w kept in its distance from
0 ``|dz/db| = 2 / (1 + b^2) |w| / |1 + w|^2 <= 1/2``, the largest value being that of ``|w| = 1``.
Hence a change of the bulge by e moves no point of the arc by more than e/2 chords, whatever the
bulge; and a change of A and B by r moves it by at most ``r (|1 - z| + |z|) <= r sqrt(1 + b^2)``, as
this sum is largest at the arc's middle. Bulges get so many decimals that ``e/2 chords`` is at most
``10^-d / 4``. All of these bounds are for points that move along together (Fréchet).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from core.arcs import Arcs, arcs
from core.beziers import Beziers, beziers
from core.document import Curve, Document
from core.errors import NinepointError
from core.flatten import Polyline, polyline
from core.formats import decimals
from core.formats.boxes import Shape, box_of
from core.formats.layers import layer_names
from core.formats.toolpath import toolpaths
from core.limit import LimitCurve
from core.profiles import Profile
from core.profiles import decimals as decimals_of
from core.splines import Spline, spline

GUARD_DIGITS: Final = {"dxf": 4}
"""Decimals beyond those of the tolerance: 0.01 mm is written with 6. CAD programs go on computing
with the vertices, so they get more than a picture."""

PICTURE_GUARD: Final = 2
"""Decimals beyond those of the tolerance in other formats: 0.01 mm is written with 4."""

MAX_BULGE_PLACES: Final = 15
"""Decimals of a bulge, at most: as many as a float has."""

_CORNER: Final = math.sqrt(0.5)
"""How far rounding moves a point, in units of the last decimal."""

_ROUNDED_ARC: Final = 1.25
"""The same for the points of an arc that turns by less than a half circle, its bulge rounded too:
``sqrt(1/2) sqrt(2) + 1/4``."""

_FLOATS: Final = 8 * float(np.finfo(float).eps)
"""Rounding of the floats themselves on the way into the file, as a share of the largest
coordinate: a shift, a scaling, and a rounding."""


@dataclass(frozen=True, eq=False)
class Contour:
    """One curve as it stands in the file.

    Attributes
    ----------
    curve
        The curve of the document.
    layer
        Name of its layer, in ASCII.
    shape
        Rounded to the decimals of the file and in its unit, y up. No vertex equals the one
        before it. The deviation is in mm and includes the rounding.
    """

    curve: Curve
    layer: str
    shape: Shape

    @property
    def name(self) -> str:
        """Name of the curve."""
        return self.curve.name

    @property
    def closed(self) -> bool:
        """Whether the contour is closed."""
        return self.shape.closed

    @property
    def is_bent(self) -> bool:
        """Whether it is of arcs, not all of which are lines."""
        return isinstance(self.shape, Arcs) and bool(self.shape.bulges.any())

    @property
    def pieces(self) -> int:
        """Number of lines, arcs, cubics, or parts of a spline."""
        shape = self.shape
        if isinstance(shape, Beziers):
            return len(shape.controls)
        if isinstance(shape, Spline):
            return len(shape.knots) - 1
        return len(shape.points) - (not shape.closed)

    @property
    def count(self) -> int:
        """Number of pieces, or of the vertices of a polyline."""
        shape = self.shape
        return len(shape.points) if isinstance(shape, Polyline) else self.pieces

    @property
    def box(self) -> NDArray[np.float64]:
        """Smallest and largest x and y of the exact shape, shape (2, 2), in the unit of the file.

        For arcs and cubics their extremes count, not only their ends.
        """
        return box_of(self.shape)


@dataclass(frozen=True, eq=False)
class Contours:
    """What can be drawn of a document with a profile.

    Attributes
    ----------
    document, profile
        What they are made of; with a kerf, a profile of polylines.
    contours
        One for each curve, in the order of the document; curves of no extent (no point, a dot)
        are left out. With a kerf, the ways of the tool, each with the curve that it follows
        (`core.formats.toolpath`).
    shift
        What was added to the coordinates of the document, in the unit of the file.
    places
        Number of decimals of the coordinates.
    notes
        Sentences on what is not as the profile asks.
    """

    document: Document
    profile: Profile
    contours: tuple[Contour, ...]
    shift: NDArray[np.float64]
    places: int
    notes: tuple[str, ...]

    @classmethod
    def of(cls, document: Document, profile: Profile) -> Contours:
        """Make the contours so that deviation and rounding together stay within the tolerance.

        Raises
        ------
        NinepointError
            If nothing is left to draw, the tolerance is finer than the digits of the coordinates,
            or the routines that make the shapes refuse.
        """
        drawn = [c for c in document.curves if not (c.points == c.points[:1]).all()]
        if not drawn:
            raise NinepointError(
                "There is nothing to export: no curve has two points at different places."
            )
        unit = profile.unit_mm
        limits = [curve.limit(document.parameters) for curve in drawn]
        largest = max(float(np.abs(limit.endless_points).max()) for limit in limits)
        largest = (largest + abs(profile.kerf_mm)) / unit
        wanted = decimals_of(profile.tolerance_mm / unit, _guard(profile))
        # A corner as the origin makes coordinates up to twice as large.
        places = min(wanted, decimals.most_places(4 * largest))
        moved = _ROUNDED_ARC if profile.entity == "arcs" else _CORNER
        rounding = (moved * 10.0**-places + _FLOATS * largest) * unit
        if rounding >= profile.tolerance_mm / 2:
            raise NinepointError(
                f"Coordinates of {largest * unit:g} mm cannot be written within"
                f" {profile.tolerance_mm:g} mm; choose a larger tolerance."
            )
        tolerance = profile.tolerance_mm - rounding
        if profile.kerf_mm:
            made, notes = toolpaths(drawn, limits, profile.kerf_mm, tolerance)
            if profile.entity != "polyline":
                notes.append("With a kerf the contours are polylines.")
                profile = msgspec.structs.replace(profile, entity="polyline")
        else:
            made, notes = _shapes(drawn, limits, profile.entity, tolerance)
        found = [(curve, _scaled(shape, 1 / unit, rounding)) for curve, shape in made]
        shift = np.zeros(2)
        if profile.origin == "corner":
            shift = -np.min([box_of(shape)[0] for _, shape in found], axis=0)
        found = [(curve, _rounded(_shifted(shape, shift), places)) for curve, shape in found]
        found = [(curve, shape) for curve, shape in found if _has_extent(shape)]
        if not found:
            raise NinepointError(
                "There is nothing to export: the drawing is smaller than the tolerance resolves."
            )
        names = [curve.name for curve, _ in found]
        layers = layer_names(names if profile.layers == "by curve" else None, len(found))
        contours = tuple(
            Contour(curve, layer, shape)
            for (curve, shape), layer in zip(found, layers, strict=True)
        )
        return cls(document, profile, contours, shift, places, tuple(notes))

    @property
    def deviation_mm(self) -> float:
        """Proven bound of the distance between the curves and what the file holds.

        With a kerf, the distance from the offset, in the sense of `core.formats.kerf`.
        """
        return max(contour.shape.deviation for contour in self.contours)

    @property
    def box(self) -> NDArray[np.float64]:
        """Smallest and largest x and y of all contours, shape (2, 2), in the unit of the file."""
        boxes = np.array([contour.box for contour in self.contours])
        return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height."""
        low, high = self.box
        width, height = ((high - low) * self.profile.unit_mm).tolist()
        return width, height

    @property
    def count(self) -> int:
        """Number of arcs, cubics, pieces of splines, or vertices of polylines."""
        return sum(contour.count for contour in self.contours)

    @property
    def closed(self) -> int:
        """Number of closed contours."""
        return sum(contour.closed for contour in self.contours)

    @property
    def layers(self) -> tuple[str, ...]:
        """Names of the layers, each once."""
        return tuple(dict.fromkeys(contour.layer for contour in self.contours))


def bulge_places(arcs: Arcs, places: int) -> int:
    """Decimals of the bulges, so that their rounding moves no arc by more than ``10^-places / 4``.

    See the notes of this module; `MAX_BULGE_PLACES` at most.
    """
    ends = np.roll(arcs.points, -1, axis=0)
    longest = float(np.hypot(*(ends - arcs.points).T).max())
    more = max(math.ceil(math.log10(longest)), 0) if longest > 0 else 0
    return min(places + more, MAX_BULGE_PLACES)


def _guard(profile: Profile) -> int:
    return GUARD_DIGITS.get(profile.format, PICTURE_GUARD)


def _shapes(
    curves: Sequence[Curve], limits: Sequence[LimitCurve], entity: str, tolerance: float
) -> tuple[list[tuple[Curve, Shape]], list[str]]:
    """Shapes of curves, and sentences on those that are of another kind."""
    notes = []
    found = []
    for curve, limit in zip(curves, limits, strict=True):
        shape = _shape(limit, entity, tolerance)
        if isinstance(shape, Polyline) and entity == "spline":
            notes.append(f"{curve.name!r} is too rough for a spline, so it is a polyline.")
        found.append((curve, shape))
    return found, notes


def _shape(limit: LimitCurve, entity: str, tolerance: float) -> Shape:
    """The curve as an entity; a polyline where a segment or a rough curve has to do without."""
    if entity == "arcs":
        return arcs(limit, tolerance)
    if entity == "cubics":
        return beziers(limit, tolerance)
    if entity == "spline" and (found := spline(limit, tolerance)) is not None:
        return found
    return polyline(limit, tolerance)


def _scaled(shape: Shape, factor: float, rounding: float) -> Shape:
    """Shape in the unit of the file; its deviation stays in mm and includes the rounding."""
    deviation = shape.deviation + rounding
    if isinstance(shape, (Arcs, Polyline)):
        return replace(shape, points=shape.points * factor, deviation=deviation)
    return replace(shape, controls=shape.controls * factor, deviation=deviation)


def _shifted(shape: Shape, shift: NDArray[np.float64]) -> Shape:
    if isinstance(shape, (Arcs, Polyline)):
        return replace(shape, points=shape.points + shift)
    return replace(shape, controls=shape.controls + shift)


def _rounded(shape: Shape, places: int) -> Shape:
    """Shape of rounded numbers, without pieces that have lost their extent."""
    if isinstance(shape, Beziers):
        controls = decimals.rounded(shape.controls, places)
        return replace(shape, controls=controls[(controls != controls[:, :1]).any(axis=(1, 2))])
    if isinstance(shape, Spline):
        return replace(shape, controls=decimals.rounded(shape.controls, places))
    points = decimals.rounded(shape.points, places)
    differs = (points != np.roll(points, -1, axis=0)).any(axis=1)
    if not shape.closed:
        differs[-1] = True
    if isinstance(shape, Polyline):
        return replace(shape, points=points[differs])
    bare = replace(shape, points=points[differs], bulges=shape.bulges[differs])
    if not len(bare.points):
        return bare
    bulges = decimals.rounded(bare.bulges, bulge_places(bare, places))
    return replace(bare, bulges=bulges)


def _has_extent(shape: Shape) -> bool:
    if isinstance(shape, Spline):
        return bool((shape.controls != shape.controls[0]).any())
    if isinstance(shape, Beziers):
        return len(shape.controls) > 0
    return len(shape.points) > 1
