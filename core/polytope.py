"""Symmetric polytopes ``{V c : sum |c| <= 1}``: the norm they define, and growing an invariant one.

References
----------
Guglielmi, Protasov: Exact computation of joint spectral characteristics of linear operators,
Found. Comput. Math. 13 (2013). Mejstrik: Improved invariant polytope algorithm and applications,
ACM TOMS 46 (2020).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

Cancelled = Callable[[], bool]
"""Asked by long searches now and then; True ends them."""

INSIDE: Final = 1 + 1e-8
"""A point of at most this norm counts as inside; the factor goes into the stated bound."""

_PIVOT: Final = 1e-12
"""Smallest entry that a pivot may have; below it is rounding."""

_MAX_PIVOTS: Final = 500
"""Pivots after which a linear program is given up; some ten are usual."""


def never() -> bool:
    """Answer of a search that nobody cancels."""
    return False


def polytope_norm(
    vertices: NDArray[np.float64], start: NDArray[np.float64], point: NDArray[np.float64]
) -> float:
    """Upper bound of ``min sum |c|`` over ``vertices @ c = point``, on the minimum's side of 1.

    Parameters
    ----------
    vertices
        Shape (d, n), the first d columns linearly independent; the polytope is the hull of the
        columns and their negatives.
    start
        Inverse of the first d columns, where the search begins.
    point
        Shape (d,).

    Returns
    -------
    float
        The search ends as soon as the point is proven inside or outside. A norm at most 1 proves
        that it lies inside: the combination found is checked against the point. What it misses is
        added with the basis it is measured in, so that only the rounding of that check remains,
        some 1e-15.

    Notes
    -----
    Revised simplex method. With the signs of the columns chosen so that the coefficients are not
    negative, any basis is feasible, so no first phase is needed.
    """
    columns = list(range(len(point)))
    coefficients = start @ point
    signs = np.where(coefficients < 0, -1.0, 1.0)
    inverse = signs[:, None] * start
    coefficients = np.abs(coefficients)
    for _ in range(_MAX_PIVOTS):
        if coefficients.sum() <= 1:
            break
        prices = inverse.sum(axis=0) @ vertices
        entering = int(np.abs(prices).argmax())
        # The prices, made feasible, bound the minimum from below: the point may be proven outside.
        if coefficients.sum() > INSIDE * abs(prices[entering]):
            break
        if abs(prices[entering]) <= 1 + _PIVOT:
            break
        sign = np.sign(prices[entering])
        direction = inverse @ (sign * vertices[:, entering])
        positive = direction > _PIVOT
        if not positive.any():
            break
        ratios = np.full(len(columns), np.inf)
        ratios[positive] = coefficients[positive] / direction[positive]
        leaving = int(ratios.argmin())
        step = ratios[leaving]
        coefficients = np.maximum(coefficients - step * direction, 0.0)
        coefficients[leaving] = step
        row = inverse[leaving] / direction[leaving]
        inverse = inverse - np.outer(direction, row)
        inverse[leaving] = row
        columns[leaving] = entering
        signs[leaving] = sign
    # The updated inverse has lost digits where columns are nearly parallel: solve once more.
    combination = _solution(vertices[:, columns], point, signs * coefficients)
    missed = point - vertices[:, columns] @ combination
    return float(np.abs(combination).sum() + np.abs(start @ missed).sum())


def _solution(
    columns: NDArray[np.float64], point: NDArray[np.float64], fallback: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Coefficients of a point over a basis; the fallback where it is singular to rounding."""
    try:
        return np.asarray(np.linalg.solve(columns, point), dtype=np.float64)
    except np.linalg.LinAlgError:
        return fallback


def invariant_polytope(
    matrices: NDArray[np.float64],
    seeds: NDArray[np.float64],
    max_vertices: int,
    cancelled: Cancelled = never,
) -> bool:
    """Try to grow a symmetric polytope that all matrices map into itself.

    Parameters
    ----------
    matrices
        Shape (k, d, d).
    seeds
        Shape (d, n): columns that span the space; the first d are linearly independent.
    max_vertices
        Number of vertices at which to give up.
    cancelled
        Asked before each image; True ends the search.

    Returns
    -------
    bool
        True proves that the joint spectral radius of the matrices is at most `INSIDE`: all images
        of all vertices lie in the polytope, stretched by that factor. False proves nothing.
    """
    size = seeds.shape[0]
    start = np.asarray(np.linalg.inv(seeds[:, :size]), dtype=np.float64)
    vertices = seeds
    fresh = list(range(vertices.shape[1]))
    while fresh:
        added = []
        for index in fresh:
            for matrix in matrices:
                if cancelled():
                    return False
                image = matrix @ vertices[:, index]
                if polytope_norm(vertices, start, image) > INSIDE:
                    if vertices.shape[1] >= max_vertices:
                        return False
                    added.append(vertices.shape[1])
                    vertices = np.column_stack([vertices, image])
        fresh = added
    return True
