"""A foreign drawing taken over as curves of the family, each within a tolerance, proven."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.document import MAX_COORDINATE_MM, Curve, Document
from core.errors import NinepointError, NoLimitError
from core.family import PRESETS, Parameters
from core.fit import fit
from core.formats.foreign import name
from core.formats.sketch import Sketch, Trace
from core.polytope import Cancelled, never

_DOT: Final = 1e-9
"""Extent of a contour, as a share of its coordinates, up to which it is a dot: rounding."""


def silent(_count: int) -> None:
    """Takes the number of contours that are done, and tells nobody."""


def fitted(
    sketch: Sketch,
    parameters: Parameters | None = None,
    tolerance_mm: float = 0.01,
    cancelled: Cancelled = never,
    told: Callable[[int], None] = silent,
) -> tuple[Document, float]:
    """Drawing whose limit curves keep to the contours of a sketch.

    Parameters
    ----------
    sketch
        What was read.
    parameters
        Member of the family that draws it; Calm by default.
    tolerance_mm
        Largest admitted distance between a contour of the file and its curve, > 0.
    cancelled
        Asked now and then; True ends the search.
    told
        Called with the number of contours that are done, after each.

    Returns
    -------
    document
        A curve for each trace, in their order. A trace of no extent becomes a curve of one point.
    deviation
        Proven bound in mm of the Hausdorff distance between each contour of the file and its curve
        (`core.fit`), the largest of all.

    Raises
    ------
    NinepointError
        If a contour cannot be fitted so closely, or there are too many points, or a coordinate is
        not admitted, with what to do; if it was cancelled.
    """
    member = PRESETS["Calm"] if parameters is None else parameters
    largest = float(np.abs([sketch.low, sketch.high]).max())
    if largest > MAX_COORDINATE_MM:
        raise NinepointError(
            f"The drawing reaches to {largest:g} mm; at most {MAX_COORDINATE_MM:g} mm are admitted."
            " Choose a smaller unit."
        )
    curves: list[Curve] = []
    worst = 0.0
    for index, trace in enumerate(sketch.traces, 1):
        called = name(trace, index)
        try:
            points, deviation = _points(trace, member, tolerance_mm, cancelled)
        except NoLimitError as error:
            raise NinepointError(
                "Nothing can be fitted with this scheme: it has no curve that keeps to its points"
                " by a proven bound. Take the vertices, or choose other parameters first."
            ) from error
        except NinepointError as error:
            if cancelled() or len(sketch.traces) == 1:
                raise
            raise NinepointError(f"Contour {index} ({called}): {error}") from error
        curves.append(Curve(points, trace.closed, called))
        worst = max(worst, deviation)
        told(index)
    return Document(tuple(curves), member), worst


def _points(
    trace: Trace, member: Parameters, tolerance_mm: float, cancelled: Cancelled
) -> tuple[NDArray[np.float64], float]:
    """Control points of one contour, and the bound of their curve's distance."""
    low, high = trace.controls.min(axis=(0, 1)), trace.controls.max(axis=(0, 1))
    extent = math.hypot(*(high - low))
    if extent <= _DOT * float(np.abs([low, high]).max()):
        return trace.controls[:1, 0], extent + trace.deviation
    found = fit(
        trace.controls,
        member.mask,
        trace.closed,
        tolerance_mm,
        trace.deviation,
        cancelled=cancelled,
    )
    return found.points, found.deviation
