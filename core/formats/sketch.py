"""What a foreign drawing holds: traces of cubics in millimetres, and what is known of its unit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError

if TYPE_CHECKING:
    from core.document import Document

UNITS_MM: Final = {
    "mm": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "in": 25.4,
    "ft": 304.8,
    "pt": 25.4 / 72,
    "px": 25.4 / 96,
    "µm": 0.001,
}
"""Millimetres of the units that a user can choose from."""


@dataclass(frozen=True, eq=False)
class Trace:
    """One connected contour.

    Attributes
    ----------
    controls
        Cubic Bézier curves, shape (n, 4, 2), n >= 1, in mm, y up; each starts with the very numbers
        that the one before ends with, and when closed the last one ends where the first one
        starts. Straight pieces have their inner control points at thirds.
    closed
        Whether the contour is closed.
    name, layer
        As the file calls them, or "".
    deviation
        Bound of the distance in mm between the exact shape of the file and the cubics: 0 for
        lines and cubics, more for arcs and splines that are no cubics.
    """

    controls: NDArray[np.float64]
    closed: bool
    name: str = ""
    layer: str = ""
    deviation: float = 0.0

    @property
    def nodes(self) -> NDArray[np.float64]:
        """Ends of the cubics, shape (n, 2) closed, (n + 1, 2) open."""
        starts = self.controls[:, 0]
        return starts.copy() if self.closed else np.concatenate([starts, self.controls[-1:, 3]])


@dataclass(frozen=True, eq=False)
class Sketch:
    """The contours of a foreign file.

    Attributes
    ----------
    traces
        The contours, in the order of the file; at least one.
    unit
        Name of the unit of the file's numbers, a key of `UNITS_MM`.
    is_unit_known
        Whether the file says so; else it is a guess, and the user should look at the size.
    notes
        Sentences on what was left out or repaired, for the user.
    document
        The drawing that our own exports carry inside, if it still matches the contours.
    """

    traces: tuple[Trace, ...]
    unit: str
    is_unit_known: bool
    notes: tuple[str, ...] = ()
    document: Document | None = None

    @property
    def low(self) -> NDArray[np.float64]:
        """Smallest x and y of the control points of all cubics, in mm: no curve goes beyond."""
        corners = [trace.controls.min(axis=(0, 1)) for trace in self.traces]
        return np.asarray(np.min(corners, axis=0), dtype=np.float64)

    @property
    def high(self) -> NDArray[np.float64]:
        """Largest x and y of the control points of all cubics, in mm."""
        corners = [trace.controls.max(axis=(0, 1)) for trace in self.traces]
        return np.asarray(np.max(corners, axis=0), dtype=np.float64)

    def in_unit(self, unit: str) -> Sketch:
        """Sketch whose numbers are taken in another unit of `UNITS_MM`; so its size changes.

        Raises
        ------
        NinepointError
            If there is no such unit.
        """
        if unit not in UNITS_MM:
            raise NinepointError(f"There is no unit {unit!r}; {', '.join(UNITS_MM)} are known.")
        factor = UNITS_MM[unit] / UNITS_MM[self.unit]
        traces = tuple(
            replace(trace, controls=trace.controls * factor, deviation=trace.deviation * factor)
            for trace in self.traces
        )
        own = self.document if unit == self.unit else None
        return replace(self, traces=traces, unit=unit, is_unit_known=True, document=own)
