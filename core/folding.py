"""The L-fold mask: the one step of a scheme that does the work of L steps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def folded(before: NDArray[np.float64], mask: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients of ``b^[L](z) = b^[L-1](z^2) b(z)``, so that ``b^[1] = b``.

    Parameters
    ----------
    before
        Coefficients of ``b^[L-1]``, shape (k,), k >= 1.
    mask
        Coefficients of b, shape (n,), n >= 1.

    Returns
    -------
    ndarray
        Shape (2 k - 2 + n,). Its even and odd coefficients are convolutions of those before with
        the even and the odd ones of b.
    """
    longer = np.empty(2 * len(before) - 2 + len(mask))
    longer[::2] = np.convolve(before, mask[::2])[: len(longer[::2])]
    longer[1::2] = np.convolve(before, mask[1::2]) if len(mask) > 1 else 0.0
    return longer


def norm(mask: NDArray[np.float64], iterations: int) -> float:
    """Norm ``max_i sum_j |b_{i - 2^L j}|`` of an L-fold mask (paper, Theorem 2.1)."""
    period = 2**iterations
    padded = np.concatenate([mask, np.zeros(-len(mask) % period)])
    return float(np.abs(padded).reshape(-1, period).sum(axis=0).max())
