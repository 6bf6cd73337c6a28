"""Affine maps of the plane, as SVG writes them."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Matrix(NamedTuple):
    """Affine map (x, y) -> (a x + c y + e, b x + d y + f)."""

    a: float
    b: float
    c: float
    d: float
    e: float
    f: float

    def after(self, first: Matrix) -> Matrix:
        """The map that does ``first``, then this one."""
        a, b, c, d, e, f = self
        p, q, r, s, t, u = first
        return Matrix(
            a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s,
            a * t + c * u + e, b * t + d * u + f,
        )  # fmt: skip

    def of(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pictures of points (..., 2). A factor 1 and a term 0 change no bit."""
        a, b, c, d, e, f = self
        placed = np.empty_like(points)
        x, y = points[..., 0], points[..., 1]
        placed[..., 0] = a * x + (c * y if c else 0.0) + e
        placed[..., 1] = d * y + (b * x if b else 0.0) + f
        return placed

    @property
    def scale(self) -> float:
        """Largest factor by which a distance grows: the larger singular value."""
        a, b, c, d = self[:4]
        return (math.hypot(a + d, b - c) + math.hypot(a - d, b + c)) / 2


IDENTITY: Final = Matrix(1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
"""The map that leaves all points where they are."""
