"""Subdivision the textbook way: refine a polygon once, or several times.

This is the definition of the scheme, written to be read. The window shows exact limit points
(``core.limit``); the tests use this module as their oracle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.ends import extended, reach
from core.mask import Mask


def refine(points: ArrayLike, mask: Mask, closed: bool) -> NDArray[np.float64]:
    """Refine a control polygon once; see `subdivide`."""
    return subdivide(points, mask, closed, 1)


def subdivide(points: ArrayLike, mask: Mask, closed: bool, levels: int) -> NDArray[np.float64]:
    """Refine a control polygon ``levels`` times: ``P_m = sum_j a_{m-2j} p_j`` (paper, eq. 2.1).

    Parameters
    ----------
    points
        Control points, shape (n, d).
    mask
        The scheme.
    closed
        Whether the polygon is closed (indices modulo n) or open (odd reflection at the ends,
        theory section 7: the phantom points are added once, before the first refinement).
    levels
        Number of refinements, at least 0.

    Returns
    -------
    ndarray
        Closed: shape (n 2^levels, d); point m has the parameter ``(m + 1/2) / 2^levels - 1/2``.
        Open: the first control point, the refined points with a parameter inside (0, n - 1),
        and the last control point, shape ((n - 1) 2^levels + 2, d). Level 0, and fewer than two
        points, give the polygon itself.
    """
    polygon = np.asarray(points, dtype=np.float64)
    count = len(polygon)
    if levels == 0 or count == 0 or (count == 1 and not closed):
        return polygon.copy()
    if closed:
        for _ in range(levels):
            polygon = _refined_closed(polygon, mask)
        return polygon
    ends = polygon[[0, -1]]
    polygon = extended(polygon, mask, closed=False)
    first = -reach(mask)[0]
    for _ in range(levels):
        polygon, first = _refined_line(polygon, first, mask)
    half = 2 ** (levels - 1)
    inside = polygon[half - first : half - first + (count - 1) * 2**levels]
    return np.concatenate([ends[:1], inside, ends[1:]])


def _refined_closed(polygon: NDArray[np.float64], mask: Mask) -> NDArray[np.float64]:
    """One refinement of a closed polygon, new point 0 being the even rule at old point 0."""
    count = len(polygon)
    refined = np.zeros((2 * count, *polygon.shape[1:]))
    for parity in (0, 1):
        for offset, weight in mask.stencil(parity).items():
            refined[parity::2] += float(weight) * np.roll(polygon, -offset, axis=0)
    return refined


def _refined_line(
    polygon: NDArray[np.float64], first: int, mask: Mask
) -> tuple[NDArray[np.float64], int]:
    """Refine a piece ``p_first, p_{first+1}, ...`` of an endless polygon as far as it reaches."""
    last = first + len(polygon) - 1
    low, high = 2 * last + mask.start, 2 * first + mask.end
    spread = np.zeros((2 * len(polygon) - 1, *polygon.shape[1:]))
    spread[::2] = polygon
    full = np.stack([np.convolve(column, mask.values) for column in spread.T], axis=-1)
    # Entry k of the full convolution is P_{2 first + start + k}; those that read points beyond the
    # piece are left out.
    begin = high - 1 - (2 * first + mask.start)
    end = low + 2 - (2 * first + mask.start)
    return full[begin:end], high - 1
