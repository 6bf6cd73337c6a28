"""What a foreign drawing holds: traces of cubics in millimetres, and what is known of its unit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
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

    @property
    def box(self) -> NDArray[np.float64]:
        """Smallest and largest x and y of the cubics themselves, shape (2, 2), but for rounding."""
        controls = self.controls
        ends, inner = controls[:, [0, 3]], controls[:, 1:3]
        low, high = ends.min(axis=(0, 1)), ends.max(axis=(0, 1))
        # Only a cubic whose inner control points lie beyond can turn beyond.
        far = ((inner < low) | (inner > high)).any(axis=(1, 2))
        if far.any():
            turns = _turns(controls[far])
            low, high = np.fmin(low, turns.min(axis=0)), np.fmax(high, turns.max(axis=0))
        corners: NDArray[np.float64] = np.stack([low, high])
        return corners


def _turns(controls: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of cubics (n, 4, 2) where a coordinate is stationary, shape (2 n, 2).

    A place without such a point gives a value of the cubic somewhere else.
    """
    p, q, r, s = (controls[:, index] for index in range(4))
    # A third of the derivative is a + 2 b t + c t^2.
    a, b, c = q - p, p - 2 * q + r, s - p - 3 * (r - q)
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    # Of the two formulas for a root the one that does not subtract; either may divide by zero.
    stable = -(b + np.copysign(root, b))
    with np.errstate(divide="ignore", invalid="ignore"):
        places = np.concatenate([a / stable, stable / c])
    t = np.clip(np.nan_to_num(places, nan=0.0, posinf=0.0, neginf=0.0), 0.0, 1.0)
    u = 1 - t
    p, q, r, s = (np.concatenate([part, part]) for part in (p, q, r, s))
    values: NDArray[np.float64] = (
        u**3 * p + 3 * u**2 * t * q + 3 * u * t**2 * r + t**3 * s
    )
    return values


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
        """Smallest x and y of all curves, in mm; see `Trace.box`."""
        corner: NDArray[np.float64] = self._box[0]
        return corner

    @property
    def high(self) -> NDArray[np.float64]:
        """Largest x and y of all curves, in mm; see `Trace.box`."""
        corner: NDArray[np.float64] = self._box[1]
        return corner

    @cached_property
    def _box(self) -> NDArray[np.float64]:
        boxes = np.array([trace.box for trace in self.traces])
        corners: NDArray[np.float64] = np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
        return corners

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
