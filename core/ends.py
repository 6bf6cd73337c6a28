"""How a polygon goes on beyond its points: cyclically, or by odd reflection (theory, section 7)."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.errors import NoLimitError
from core.mask import Mask


def reach(mask: Mask) -> tuple[int, int]:
    """Number of phantom points that the curve reads beyond the first and the last span's ends.

    ``C(t)`` for t in [i, i+1) reads ``p_{i - left}, ..., p_{i + 1 + right}``.
    """
    return mask.end - 1, -mask.start


def extended(
    points: NDArray[np.float64],
    mask: Mask,
    closed: bool,
    sides: tuple[int, int] | None = None,
) -> NDArray[np.float64]:
    """Polygon with the phantom points that make it endless, as far as the curve reads them.

    Parameters
    ----------
    points
        Control points ``p_0..p_{n-1}``, shape (n, d), n >= 1.
    mask
        The scheme; it decides how far, and at open ends which points are reflected.
    closed
        Closed: indices modulo n, so that each of the n spans finds its points. Open: odd
        reflection ``p_{-j} = 2 e_0 - p_j``, with the end points ``e_0, e_{n-1}`` in place of
        ``p_0, p_{n-1}`` such that the limit curve starts at ``p_0`` and ends at ``p_{n-1}``. For a
        symmetric mask they are those points themselves.
    sides
        Numbers ``left, right`` of phantom points, at least those of ``reach(mask)``, which they
        are by default.

    Returns
    -------
    ndarray
        Points ``p_{-left}, ...``; shape (n + left + right, d) when open, one more when closed.

    Raises
    ------
    NoLimitError
        For an asymmetric mask without a unique limit, whose ends cannot be placed.
    """
    left, right = sides or reach(mask)
    count = len(points)
    if count >= far((left, right)):
        # In memory each coordinate has a row of its own, as products want it.
        endless = np.empty((points.shape[1], left + count + right + closed)).T
        endless[left : left + count] = points
        write_ends(endless, points, mask, closed, (left, right))
        return endless
    if closed:
        return points[np.arange(-left, count + right + 1) % count]
    if count == 1:
        return np.repeat(points, left + right + 1, axis=0)
    polygon = points
    if not mask.is_symmetric:
        polygon = points.copy()
        polygon[[0, -1]] = end_points(points, mask)
    return _reflected(polygon, left, right)


def far(sides: tuple[int, int]) -> int:
    """Number of points from which on the two ends of an open polygon do not see each other.

    The phantom points and the centre of an end, with ``sides`` as in `extended`, are made of fewer
    points than half of it.
    """
    return 2 * (max(sides) + 1)


def write_ends(
    endless: NDArray[np.float64],
    points: NDArray[np.float64],
    mask: Mask,
    closed: bool,
    sides: tuple[int, int],
) -> None:
    """Write the phantom points, and the centres of the reflections, of a long polygon.

    The cost does not depend on the number of points.

    Parameters
    ----------
    endless
        The array of `extended`, written in place; between its ends it is not touched.
    points
        Control points, at least `far` of them.
    mask, closed, sides
        As in `extended`.
    """
    left, right = sides
    count = len(points)
    if closed:
        endless[:left] = points[count - left :]
        endless[left + count :] = points[: right + 1]
        return
    first, last = points[[0, -1]] if mask.is_symmetric else end_points(points, mask)
    endless[left], endless[left + count - 1] = first, last
    endless[:left] = 2 * first - points[left:0:-1]
    endless[left + count :] = 2 * last - points[count - 2 : count - 2 - right : -1]


def end_points(points: NDArray[np.float64], mask: Mask) -> NDArray[np.float64]:
    """Centres ``e_0`` and ``e_{n-1}`` of the odd reflections, shape (2, d), for n >= 2 points.

    They solve the 2 x 2 system "the limit at t = 0 is p_0, at t = n - 1 is p_{n-1}". The system
    is well conditioned in the useful range (1.38 at (3/10, -3/5, -1/5)); where it is singular, far
    outside, the end points stay where they are and the curve does not reach them.
    """
    if len(points) >= far(reach(mask)):
        start, end = _centre_weights(mask)
        return np.stack([start @ points[: len(start)], end @ points[-len(end) :]])
    return _solved_centres(points, mask)


@lru_cache(maxsize=MEMORY)
def _centre_weights(mask: Mask) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Weights of the first points in ``e_0``, and of the last ones in ``e_{n-1}``, far apart."""
    size = far(reach(mask))
    start, end = _solved_centres(np.eye(size), mask)
    return start[: size // 2], end[size // 2 :]


def _solved_centres(points: NDArray[np.float64], mask: Mask) -> NDArray[np.float64]:
    """Solve the 2 x 2 system of `end_points`."""
    left, right = reach(mask)
    ends = points[[0, -1]]
    weights = _end_weights(mask)
    units = np.zeros((len(points), 2))
    units[0, 0] = units[-1, 1] = 1.0

    def limits(polygon: NDArray[np.float64]) -> NDArray[np.float64]:
        endless = _reflected(polygon, left, right)
        size = len(weights)
        return np.stack([weights @ endless[:size], weights @ endless[-size:]])

    try:
        shift = np.linalg.solve(limits(units), ends - limits(points))
    except np.linalg.LinAlgError:
        return ends
    return ends + shift


def end_rules(mask: Mask) -> tuple[tuple[Fraction, ...], ...]:
    """Rules of the first refinement near the start of an open polygon, phantom points eliminated.

    The polygon must be longer than the support of the rules, so that its ends do not meet. The
    rules at its end are those of the mirrored mask, in reverse order.

    Returns
    -------
    tuple of rows
        Row m holds the exact weights of ``p_0, p_1, ...`` in the new point ``P_m``, all rows of
        one length. Row 0 is the first point itself, which is carried along; the rows end before
        the first ``P_m`` that follows the ordinary rule. For symmetric masks they hold at every
        level; for asymmetric ones at the first, after which the phantom points are refined along.

    Raises
    ------
    NoLimitError
        For an asymmetric mask whose first point cannot be placed.
    """
    left, _ = reach(mask)
    centre = _reflection_centre(mask)
    # P_m reads p_j from j = ceil((m - end) / 2) on: the ordinary rule needs j >= 0, or, where
    # e_0 takes the place of p_0, j >= 1.
    first_ordinary = mask.end - 1 if mask.is_symmetric else mask.end + 1
    rows = [{0: Fraction(1)}]
    for m in range(1, first_ordinary):
        row: dict[int, Fraction] = {}
        for j in range(-left, (m - mask.start) // 2 + 1):
            weight = mask[m - 2 * j]
            if j > 0:
                row[j] = row.get(j, Fraction(0)) + weight
                continue
            # p_j = 2 e_0 - p_{-j} beyond the end, and e_0 at it.
            for k, share in centre.items():
                row[k] = row.get(k, Fraction(0)) + (2 if j < 0 else 1) * weight * share
            if j < 0:
                row[-j] = row.get(-j, Fraction(0)) - weight
        rows.append(row)
    width = max((k for row in rows for k, weight in row.items() if weight), default=0) + 1
    return tuple(tuple(row.get(k, Fraction(0)) for k in range(width)) for row in rows)


def _reflection_centre(mask: Mask) -> dict[int, Fraction]:
    """Exact weights of ``p_0, p_1, ...`` in the centre ``e_0`` of the odd reflection."""
    if mask.is_symmetric:
        return {0: Fraction(1)}
    limit = dict(BasicLimitFunction(mask).limit_stencil().items())
    zero = Fraction(0)
    pivot = limit.get(0, zero) + 2 * sum((w for j, w in limit.items() if j < 0), zero)
    if pivot == 0:
        raise NoLimitError("The end rules have no solution for these parameters.")
    far = max(max(limit), -min(limit))
    centre = {k: (limit.get(-k, zero) - limit.get(k, zero)) / pivot for k in range(1, far + 1)}
    return {0: 1 / pivot, **centre}


def _end_weights(mask: Mask) -> NDArray[np.float64]:
    """Weights of ``p_{i-left}..p_{i+right}`` in the limit point ``C(i)``."""
    return BasicLimitFunction(mask).table(0)[:-1, 0]


def _reflected(polygon: NDArray[np.float64], left: int, right: int) -> NDArray[np.float64]:
    """Odd reflection about both end points, repeated as often as a short polygon needs it."""
    return np.pad(polygon, ((left, right), (0, 0)), mode="reflect", reflect_type="odd")
