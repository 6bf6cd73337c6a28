"""Inverse design: move a point of the limit curve by the smallest change of the polygon."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.basis import BasicLimitFunction
from core.ends import extended, reach
from core.errors import NinepointError
from core.limit import span_of
from core.mask import Mask


def control_weights(
    count: int, mask: Mask, closed: bool, t: float
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Which control points the curve point ``C(t)`` is made of, and with what weights.

    Parameters
    ----------
    count
        Number n of control points, at least 2.
    mask
        The scheme.
    closed
        Closed or open polygon; the weights contain the end rules (phantom points eliminated).
    t
        Parameter: any real number when closed, 0 <= t <= n - 1 when open.

    Returns
    -------
    indices, weights
        ``C(t) = sum_k weights[k] p_{indices[k]}``; the indices are distinct, the weights sum to 1.
    """
    left, right = reach(mask)
    span, tau = span_of(t, count if closed else count - 1, closed)
    weights = BasicLimitFunction(mask).weights(tau)
    if closed:
        places = np.arange(span - left, span + right + 2) % count
        indices, inverse = np.unique(places, return_inverse=True)
        total = np.zeros(len(indices))
        np.add.at(total, inverse, weights)
        return indices, total
    # Far ends are not read, and those of the piece [first, last) count only where they are real.
    # Both end systems read 2 (left + right) points, so that much more on each side is enough.
    margin = 3 * (left + right + 2)
    first, last = max(span - margin, 0), min(span + margin, count)
    units = extended(np.eye(last - first), mask, closed=False)
    window = units[span - first : span - first + len(weights)]
    # At t = n - 1 the last row of the window lies beyond the extension; its weight is 0.
    return np.arange(first, last), weights[: len(window)] @ window


def pull(
    points: NDArray[np.float64],
    mask: Mask,
    closed: bool,
    t: float,
    target: ArrayLike,
    pinned: Collection[int] = (),
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Which control points have to move, and whereto, to put ``C(t)`` exactly on a target.

    Of all changes that do so it is the one with the least sum of squared moves: with
    ``C(t) = sum_j w_j p_j``, each free point moves by ``w_j / sum_k w_k^2`` times the way to go.
    The cost does not depend on the number of points.

    Parameters
    ----------
    points
        Control points, shape (n, 2), n >= 2.
    mask, closed, t
        The curve and the place on it, as in `control_weights`.
    target
        Where ``C(t)`` shall be, shape (2,).
    pinned
        Indices of control points that stay.

    Returns
    -------
    indices, positions
        Shapes (k,) and (k, 2), the indices rising.

    Raises
    ------
    NinepointError
        If all points that carry the place are pinned.
    """
    indices, weights = control_weights(len(points), mask, closed, t)
    free = ~np.isin(indices, list(pinned))
    strength = float(weights[free] @ weights[free])
    # Below this the neighbours would move by a million times the way to go.
    if strength < 1e-12:
        raise NinepointError("All points that hold this part of the curve are pinned.")
    way = np.asarray(target, dtype=np.float64) - weights @ points[indices]
    moves = np.outer(weights[free] / strength, way)
    return indices[free], points[indices[free]] + moves


def pulled(
    points: ArrayLike,
    mask: Mask,
    closed: bool,
    t: float,
    target: ArrayLike,
    pinned: Collection[int] = (),
) -> NDArray[np.float64]:
    """All control points after `pull`, shape (n, 2)."""
    polygon = np.array(points, dtype=np.float64)
    indices, positions = pull(polygon, mask, closed, t, target, pinned)
    polygon[indices] = positions
    return polygon
