"""Exact boxes of polylines, arcs, cubics and splines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.arcs import Arcs
from core.beziers import Beziers
from core.flatten import Polyline
from core.splines import Spline, pieces

Shape = Arcs | Beziers | Polyline | Spline
"""What a contour can be."""


def box_of(shape: Shape) -> NDArray[np.float64]:
    """Smallest and largest x and y of a shape, shape (2, 2).

    For arcs and cubics their extremes count, not only their ends, so it is the exact box.
    """
    if isinstance(shape, Spline):
        return _cubic_box(pieces(shape.knots, shape.controls))
    if isinstance(shape, Beziers):
        return _cubic_box(shape.controls)
    box = _extent(shape.points)
    return box if isinstance(shape, Polyline) else _arc_box(shape, box)


def _extent(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Box of points; column by column, as NumPy is ten times slower along the short axis."""
    return np.array([[column.min() for column in points.T], [column.max() for column in points.T]])


def _cubic_box(controls: NDArray[np.float64]) -> NDArray[np.float64]:
    """Box of cubics: of their ends and of the points where a coordinate's derivative is 0."""
    box = _extent(controls[:, [0, 3]].reshape(-1, 2))
    # Only where an inner control point lies beyond the ends of all can there be an extreme.
    inner = controls[:, 1:3]
    beyond = ((inner < box[0]) | (inner > box[1])).any(axis=1)
    for axis in (0, 1):
        zero, one, two, three = controls[beyond[:, axis], :, axis].T
        a, b, c = three - zero + 3 * (one - two), zero - 2 * one + two, one - zero
        # The derivative is 3 (a u^2 + 2 b u + c); this form has both roots without cancellation.
        root = -(b + np.copysign(np.sqrt(np.maximum(b * b - a * c, 0)), b))
        for top, bottom in ((root, a), (c, root)):
            u = np.divide(top, bottom, out=np.zeros_like(top), where=bottom != 0)
            u = np.clip(u, 0, 1)
            v = 1 - u
            values = v**3 * zero + 3 * u * v * (v * one + u * two) + u**3 * three
            box[0, axis] = min(box[0, axis], values.min(initial=np.inf))
            box[1, axis] = max(box[1, axis], values.max(initial=-np.inf))
    return box


def _arc_box(shape: Arcs, box: NDArray[np.float64]) -> NDArray[np.float64]:
    """Box of arcs: that of their vertices, and the outermost points of circles on an arc."""
    start, end, bulge = shape.points, np.roll(shape.points, -1, axis=0), shape.bulges
    # An arc of less than a half circle leaves its chord by its height, b/2 chords.
    height = (np.abs(bulge) * np.hypot(*(end - start).T) / 2)[:, None]
    low, high = np.minimum(start, end) - height, np.maximum(start, end) + height
    beyond = ((low < box[0]) | (high > box[1])).any(axis=1) & (bulge != 0)
    start, end, bulge = start[beyond], end[beyond], bulge[beyond][:, None]
    way = end - start
    left = np.stack([-way[:, 1], way[:, 0]], axis=1)
    # The centre lies left of the chord's middle by (1 - b^2) / (4 b) chords, for b > 0.
    centre = (start + end) / 2 + (1 - bulge**2) / (4 * bulge) * left
    radius = np.hypot(*(start - centre).T)
    for axis in (0, 1):
        for side, sign in ((0, -1.0), (1, 1.0)):
            off = centre[:, axis] + sign * radius
            point = centre.copy()
            point[:, axis] = off
            # An arc to the left lies right of its chord, as long as it is below a full circle.
            across = way[:, 0] * (point[:, 1] - start[:, 1])
            across -= way[:, 1] * (point[:, 0] - start[:, 0])
            outer = off[across * bulge[:, 0] < 0]
            if len(outer):
                box[side, axis] = (min, max)[side](box[side, axis], sign * (sign * outer).max())
    return box
