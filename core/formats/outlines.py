"""Outlines of foreign drawings in the file's own unit, before they are placed on the sheet."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

MEETS: Final = 1e-9
"""Gap between the ends of an outline, as a share of its size, up to which it is a rounding."""


class Outline(NamedTuple):
    """One connected contour.

    Attributes
    ----------
    controls
        Cubics as in `core.formats.sketch.Trace`, shape (n, 4, 2), n >= 1.
    closed
        Whether the last cubic ends where the first one starts.
    deviation
        Bound of the distance to the exact shape of the file, in the unit of the controls.
    """

    controls: NDArray[np.float64]
    closed: bool
    deviation: float = 0.0


def straight(starts: NDArray[np.float64], ends: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lines between points of shape (n, 2) as cubics (n, 4, 2), inner control points at thirds."""
    controls = np.empty((len(starts), 4, 2))
    controls[:, 0] = starts
    controls[:, 1] = (2 * starts + ends) / 3
    controls[:, 2] = (starts + 2 * ends) / 3
    controls[:, 3] = ends
    return controls


def polyline(points: NDArray[np.float64], closed: bool) -> Outline | None:
    """Polyline through points (n, 2), n >= 0; None if there are fewer than two.

    A closed one gets the line from its end to its start here; `outline` does the rest.
    """
    if len(points) < 2:
        return None
    ends = np.concatenate([points[1:], points[:1]]) if closed else points[1:]
    return Outline(straight(points[: len(ends)], ends), closed)


def outline(
    controls: NDArray[np.float64], closed: bool, deviation: float = 0.0
) -> Outline | None:
    """Outline of connected cubics (n, 4, 2), n >= 0; None if nothing is left of it.

    Cubics that are a single point are dropped. A closed outline gets a line from its end to its
    start if they are apart. One whose ends meet is closed whether the file says so or not; what
    rounding left between them is shared out over the last cubic, and added to the deviation.
    """
    if len(controls) == 0:
        return None
    dots = (controls == controls[:, :1]).all(axis=(1, 2))
    if dots.any():
        controls = controls[~dots]
        if len(controls) == 0:
            return None
    start, end = controls[0, 0], controls[-1, 3]
    gap = start - end
    width = float(np.abs(gap).max())
    if width == 0:
        return Outline(controls, True, deviation)
    corners = controls.reshape(-1, 2)
    if width <= MEETS * float((corners.max(axis=0) - corners.min(axis=0)).max()):
        controls = controls.copy()
        controls[-1] = moved_end(controls[-1], gap)
        controls[-1, 3] = start
        return Outline(controls, True, deviation + float(np.hypot(*gap)))
    if closed:
        line = straight(end[None], start[None])
        return Outline(np.concatenate([controls, line]), True, deviation)
    return Outline(controls, False, deviation)


def moved_end(cubic: NDArray[np.float64], by: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cubic (4, 2) whose end is moved; no point moves further, and a line stays one.

    The movement grows evenly along the parameter: t by, whose control points are at thirds.
    """
    shares: NDArray[np.float64] = np.array([[0.0], [1 / 3], [2 / 3], [1.0]])
    return cubic + shares * by


def reverse(controls: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same cubics from the end to the start."""
    return controls[::-1, ::-1]
