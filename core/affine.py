"""Affine maps of the plane: limit curves follow them exactly, so what is known of one is kept."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Affine:
    """The map ``p -> matrix p + offset``.

    Parameters
    ----------
    matrix
        Shape (2, 2), not singular.
    offset
        Shape (2,).
    """

    matrix: NDArray[np.float64]
    offset: NDArray[np.float64]

    @classmethod
    def shift(cls, offset: ArrayLike) -> Affine:
        """The translation by ``offset`` (2,)."""
        return cls(np.eye(2), np.asarray(offset, dtype=np.float64))

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Images of points, shape (..., 2)."""
        if self is IDENTITY:
            return points.copy(order="K")  # to the bit: a sum would turn -0.0 into 0.0
        if self.is_shift:
            return points + self.offset
        # Not by a matrix product, whose last bits depend on how many points there are.
        right, up = self.matrix.T
        image: NDArray[np.float64] = points[..., :1] * right + points[..., 1:] * up + self.offset
        return image

    @cached_property
    def is_shift(self) -> bool:
        """Whether it only moves."""
        return bool((self.matrix == np.eye(2)).all())

    @cached_property
    def inverse(self) -> Affine:
        """The map that leads back."""
        if self.is_shift:
            return Affine(self.matrix, -self.offset)
        back = np.asarray(np.linalg.inv(self.matrix), dtype=np.float64)
        return Affine(back, -back @ self.offset)

    @cached_property
    def stretch(self) -> float:
        """Largest factor by which it stretches a distance."""
        return 1.0 if self.is_shift else float(np.linalg.norm(self.matrix, 2))

    def after(self, first: Affine) -> Affine:
        """The map that does ``first``, then this one."""
        return Affine(self.matrix @ first.matrix, self(first.offset))

    def box(
        self, lower: NDArray[np.float64], upper: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Corners of the smallest upright rectangle around the image of one, itself (2,), (2,)."""
        corners = np.array([[x, y] for x in (lower[0], upper[0]) for y in (lower[1], upper[1])])
        image = self(corners)
        return image.min(axis=0), image.max(axis=0)


IDENTITY: Final = Affine.shift(np.zeros(2))
"""The map that leaves everything where it is."""
