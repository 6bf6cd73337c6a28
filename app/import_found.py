"""What a foreign drawing becomes, found in the background, and told in words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.import_picture import Sight, sight_of
from app.import_way import Way
from app.worker import Task
from core.document import Document
from core.errors import NinepointError
from core.family import Parameters
from core.formats.fitted import fitted
from core.formats.foreign import polygons
from core.formats.sketch import Sketch
from core.polytope import Cancelled

STRAIGHT: Final = 1e-9
"""Distance of a handle from the third of its line, in parts of the coordinates: rounding."""


@dataclass(frozen=True, eq=False)
class Found:
    """What a way of taking a sketch over has come to.

    Attributes
    ----------
    document
        The drawing, None if there is none.
    words
        What it has become, or why there is none.
    sight
        What the preview shows of it.
    """

    document: Document | None
    words: str
    sight: Sight | None = None


def taking(sketch: Sketch, unit: str, parameters: Parameters, way: Way) -> Task:
    """Task that takes a sketch over, in a unit; it sends the number of contours that are done."""

    def task(cancelled: Cancelled, send: Callable[[Any], None]) -> Found:
        scaled = sketch if unit == sketch.unit else sketch.in_unit(unit)
        try:
            if way.is_fit:
                tolerance = float(way.tolerance)
                document, deviation = fitted(scaled, parameters, tolerance, cancelled, send)
            else:
                document, deviation = polygons(scaled, parameters), None
        except NinepointError as error:
            return Found(None, str(error), sight_of(scaled))
        return Found(document, outcome(document, deviation, scaled), sight_of(scaled, document))

    return task


def contents(sketch: Sketch) -> str:
    """How many contours a sketch has: "3, of which 2 are closed"."""
    total, closed = len(sketch.traces), sum(trace.closed for trace in sketch.traces)
    if total == 1:
        return "1, closed" if closed else "1, open"
    if closed in (0, total):
        return f"{total:,}, all {'closed' if closed else 'open'}"
    return f"{total:,}, of which {closed:,} {'is' if closed == 1 else 'are'} closed"


def outcome(document: Document, deviation: float | None, sketch: Sketch) -> str:
    """What a drawing has become: "16 control points. Deviation ≤ 0.0099 mm, proven."."""
    count = sum(curve.count for curve in document.curves)
    points = f"{count:,} control point{'' if count == 1 else 's'}"
    if deviation is not None:
        return f"{points}.\nDeviation \u2264\u00a0{rounded_up(deviation)}\u00a0mm, proven."
    if any(_is_bent(trace.controls) for trace in sketch.traces):
        return f"{points}.\nThe curves run near them; what the file has between them is lost."
    return f"{points}.\nThe curves run near them, and do not keep to the lines."


def rounded_up(value: float) -> str:
    """Two significant digits of a bound, rounded so that it stays one."""
    text = f"{value:.1e}"
    if float(text) < value:
        digits, _, exponent = text.partition("e")
        text = f"{float(digits) + 0.1:.1f}e{exponent}"
    return f"{float(text):.2g}"


def _is_bent(controls: NDArray[np.float64]) -> bool:
    """Whether some cubic is no straight line of even speed."""
    thirds = (2 * controls[:, 0] + controls[:, 3]) / 3
    return bool(np.abs(controls[:, 1] - thirds).max() > STRAIGHT * np.abs(controls).max())
