"""The curves of a document as a file of outlines holds them: polylines within a tolerance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.document import Document
from core.errors import NinepointError
from core.flatten import Polyline, polyline

_LARGEST_ROUNDING: Final = 0.75
"""How far rounding moves a vertex, in units of the last decimal: the root of 1/2, and something
for the rounding of the floats themselves."""


@dataclass(frozen=True, eq=False)
class Contours:
    """What can be drawn of a document, in millimetres, y up.

    Attributes
    ----------
    names
        Names of the curves, one for each polyline.
    polylines
        The curves within the tolerance, in the order of the document, their vertices rounded to
        the decimals that the file holds; no vertex equals the one before it, and the first is not
        repeated when closed. Curves of no extent (no point, a dot) are left out. The deviations
        include the rounding.
    decimals
        Number of decimals of the coordinates.
    """

    names: tuple[str, ...]
    polylines: tuple[Polyline, ...]
    decimals: int

    @classmethod
    def of(cls, document: Document, tolerance_mm: float, guard_digits: int) -> Contours:
        """Flatten a document so that deviation and rounding together stay within a tolerance.

        Parameters
        ----------
        document
            The curves and their scheme.
        tolerance_mm
            Largest admitted distance between a curve and its contour in the file.
        guard_digits
            Decimals beyond those of the tolerance, at least 2: with 2, a drawing within 0.01 mm
            has 4. They also hide that the last digits of a float vary from machine to machine.

        Raises
        ------
        NinepointError
            If nothing is left to draw, or `core.flatten.polyline` refuses.
        """
        decimals = max(math.ceil(-math.log10(tolerance_mm)), 0) + guard_digits
        rounding = _LARGEST_ROUNDING * 10.0**-decimals
        names, polylines = [], []
        for curve in document.curves:
            if (curve.points == curve.points[:1]).all():
                continue
            flat = polyline(curve.limit(document.parameters), tolerance_mm - rounding)
            points = _distinct(np.round(flat.points, decimals), flat.closed)
            if len(points) > 1:
                names.append(curve.name)
                polylines.append(Polyline(points, flat.closed, flat.deviation + rounding))
        if not polylines:
            raise NinepointError(
                "There is nothing to export: no curve has two points at different places."
            )
        return cls(tuple(names), tuple(polylines), decimals)

    @property
    def deviation_mm(self) -> float:
        """Proven bound of the distance between the curves and what the file holds."""
        return max(line.deviation for line in self.polylines)

    @property
    def low(self) -> NDArray[np.float64]:
        """Smallest x and y of all vertices."""
        corners = np.array([line.points.min(axis=0) for line in self.polylines])
        return np.asarray(corners.min(axis=0), dtype=np.float64)

    @property
    def high(self) -> NDArray[np.float64]:
        """Largest x and y of all vertices."""
        corners = np.array([line.points.max(axis=0) for line in self.polylines])
        return np.asarray(corners.max(axis=0), dtype=np.float64)

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return sum(len(line.points) for line in self.polylines)

    @property
    def closed(self) -> int:
        """Number of closed contours."""
        return sum(line.closed for line in self.polylines)


def _distinct(points: NDArray[np.float64], closed: bool) -> NDArray[np.float64]:
    """Vertices that differ from the one before; coincident control points give equal ones."""
    before = np.roll(points, 1, axis=0)
    differs = (points != before).any(axis=1)
    if not closed:
        differs[0] = True
    kept: NDArray[np.float64] = points[differs]
    return kept
