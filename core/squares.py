"""Control points by least squares: the limit curve near given points at given parameters.

Notes
-----
With samples ``C_k = sum_j w_kj p_j`` at ``t = k / SAMPLES`` and targets ``q_k``, what is made
smallest is ``sum_k (C_k - q_k)^T W_k (C_k - q_k)`` over the control points, with a symmetric 2 x 2
weight for each sample. The normal equations are solved by conjugate gradients; all products are
windows of control points times one table. For unit weights and a closed curve their matrix is
circulant: its inverse, by fast Fourier transform, is the preconditioner, so the number of steps
depends on the weights only, whatever the scheme.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.ends import extended, reach
from core.mask import Mask

LEVEL: Final = 3
"""Dyadic level of the samples."""

SAMPLES: Final = 2**LEVEL
"""Number of samples in a span."""

_PRECISION: Final = 1e-3
"""Residual, in parts of the first one, at which the steps end."""

_STEPS: Final = 12
"""Largest number of steps."""

_SMALLEST: Final = 1e-9
"""Smallest eigenvalue of the circulant matrix, in parts of the largest, that is inverted."""


class Squares:
    """Least squares for a polygon of some number of points.

    Parameters
    ----------
    count
        Number of control points: at least 1 when closed, 2 when open.
    mask
        The scheme.
    closed
        Closed or open polygon. The end points of an open one are given, not found.
    """

    def __init__(self, count: int, mask: Mask, closed: bool) -> None:
        self.count, self.mask, self.closed = count, mask, closed
        self.spans = count if closed else count - 1
        self._table = np.ascontiguousarray(BasicLimitFunction(mask).table(LEVEL))
        self._left, self._right = reach(mask)
        # Beyond so many points an end of an open polygon does not see the other.
        self._near = min(count, 4 * (max(self._left, self._right) + 1))
        few = 0 if closed else min(count, 2 * self._near)
        self._ends = extended(np.eye(few), mask, closed=False) if few else np.zeros((0, 0))
        self._eigenvalues = _eigenvalues(self._table, count)

    def values(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Samples of the curve of control points (count, 2), shape (2, spans * SAMPLES).

        The end of the last span is not among them.
        """
        endless = np.ascontiguousarray(extended(points, self.mask, self.closed).T)
        row, item = endless.strides
        windows = np.lib.stride_tricks.as_strided(
            endless, (2, self.spans, len(self._table)), (row, item, item), writeable=False
        )
        return np.asarray((windows @ self._table).reshape(2, -1))

    def solved(
        self,
        points: NDArray[np.float64],
        targets: NDArray[np.complex128],
        weights: tuple[NDArray[np.float64], ...] | None = None,
    ) -> NDArray[np.float64]:
        """Control points that bring the samples near their targets, from given ones.

        Parameters
        ----------
        points
            First guess, shape (count, 2); its end points stay when open.
        targets
            Where the samples shall be, shape (spans * SAMPLES,), complex.
        weights
            Entries xx, xy, yy of the weight of each sample; None: all count alike.
        """
        left = np.stack([targets.real, targets.imag]) - self.values(points)
        rest = self._adjoint(_weighted(left, weights))
        moved = self._preconditioned(rest)
        way, size = moved, float((rest * moved).sum())
        enough = _PRECISION**2 * size
        for _ in range(_STEPS):
            product = self._adjoint(_weighted(self.values(way), weights))
            bend = float((way * product).sum())
            if size <= enough or not bend > 0:
                break
            points = points + (size / bend) * way
            rest = rest - (size / bend) * product
            moved = self._preconditioned(rest)
            before, size = size, float((rest * moved).sum())
            way = moved + (size / before) * way
        return points

    def _adjoint(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """What the samples give back to the control points: the transpose of `values`."""
        shares = values.reshape(2, self.spans, SAMPLES) @ self._table.T
        size = self.count + self._left + self._right + self.closed
        endless = np.zeros((2, size))
        for row in range(len(self._table)):
            endless[:, row : row + self.spans] += shares[:, :, row]
        back = self._folded(endless.T)
        if not self.closed:
            back[[0, -1]] = 0.0
        return back

    def _folded(self, endless: NDArray[np.float64]) -> NDArray[np.float64]:
        """The transpose of `core.ends.extended`."""
        count, left = self.count, self._left
        if self.closed:
            places = np.arange(-left, len(endless) - left) % count
            return np.stack([np.bincount(places, part, count) for part in endless.T], axis=1)
        if count <= 2 * self._near:
            return np.asarray(self._ends.T @ endless)
        back = endless[left : left + count].copy()
        back[[0, -1]] = 0.0
        near, total = self._near, len(self._ends)
        back[:near] += self._ends[: left + 1, :near].T @ endless[: left + 1]
        beyond = self._right + 1
        back[-near:] += self._ends[total - beyond :, -near:].T @ endless[-beyond:]
        return back

    def _preconditioned(self, rest: NDArray[np.float64]) -> NDArray[np.float64]:
        spectrum = np.fft.rfft(rest, axis=0) / self._eigenvalues[:, None]
        moved = np.fft.irfft(spectrum, self.count, axis=0)
        if not self.closed:
            moved[[0, -1]] = 0.0
        return moved


def _eigenvalues(table: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Eigenvalues of the circulant matrix ``sum_k w_ki w_kj`` of a closed polygon."""
    rows = len(table)
    products = table @ table.T
    column = np.zeros(count)
    for shift in range(1 - rows, rows):
        column[shift % count] += np.trace(products, shift)
    values = np.fft.rfft(column).real
    return np.asarray(np.maximum(values, _SMALLEST * values.max()))


def _weighted(
    values: NDArray[np.float64], weights: tuple[NDArray[np.float64], ...] | None
) -> NDArray[np.float64]:
    if weights is None:
        return values
    xx, xy, yy = weights
    x, y = values
    return np.stack([xx * x + xy * y, xy * x + yy * y])
