"""B-splines and NURBS of any degree as cubics: exact where they are cubics, else within a bound.

Notes
-----
*Pieces.* Between neighbouring knots a < b a spline is one polynomial, whose Bézier points are the
values of its blossom at (a, ..., a, b, ..., b) (Ramshaw 1989). De Boor's scheme with such arguments
gives them by averages alone, for all spans at once; clamped or not makes no difference. Degrees up
to 3 without weights are cubics then.

*Approximation.* Other pieces are N / w, in homogeneous coordinates. Each is compared with the cubic
g that has its ends and its derivatives there. ``N - w g`` is a polynomial of degree p + 3; the sum
of w and 1 is a product of Bernstein polynomials, so its coefficients are

    sum over j of C(p, j) C(3, k - j) / C(p + 3, k) w_j (P_j - g_(k - j)),    k = 0 .. p + 3,

with the control points P_j and the weights w_j. The polynomial lies in the convex hull of its
coefficients, so ``|N/w - g| <= max |coefficient| / min w_j`` at each parameter: a proof, not an
estimate. Pieces where this is too large are halved; it falls by 16 each time.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.formats.budget import Budget
from core.formats.dxf_tags import EntityError
from core.formats.outlines import MEETS, Outline

MAX_DEGREE: Final = 20
"""Largest degree; programs write 2, 3 and 5."""

MAX_PIECES: Final = 100_000
"""Largest number of cubics for a spline that is none itself."""

_MAX_HALVINGS: Final = 24
_MAX_WEIGHTS_RATIO: Final = 1e9
"""Largest quotient of two weights; beyond, floats leave nothing of the points."""


def spline(
    degree: int,
    knots: NDArray[np.float64],
    points: NDArray[np.float64],
    weights: NDArray[np.float64] | None,
    tolerance: float,
    budget: Budget,
) -> list[Outline]:
    """Outlines of a spline over the parameters from knot p to knot n.

    Parameters
    ----------
    degree
        Degree p.
    knots
        Shape (n + p + 1,), not falling; a knot may repeat at will.
    points, weights
        Control points (n, 2), and their weights (n,), None for equal ones.
    tolerance
        Admitted deviation where it is no cubic.
    budget
        What pays for the cubics.

    Returns
    -------
    list[Outline]
        One, raw and open; more if knots of multiplicity p + 1 cut the spline.

    Raises
    ------
    EntityError
        If these are no numbers of a spline.
    BudgetError
        If there are too many segments.
    """
    count = len(points)
    if not 1 <= degree <= MAX_DEGREE or count <= degree or len(knots) != count + degree + 1:
        raise EntityError("degree, knots and control points do not fit together")
    weights = np.ones(count) if weights is None else weights
    if len(weights) != count:
        raise EntityError("there are not as many weights as control points")
    if not (np.isfinite(knots).all() and np.isfinite(points).all()):
        raise EntityError("a coordinate is not finite")
    low, high = float(weights.min()), float(weights.max())
    if not 0 < low <= high <= _MAX_WEIGHTS_RATIO * low:
        raise EntityError("its weights are not positive, or too different")
    if (np.diff(knots) < 0).any() or not knots[degree] < knots[count]:
        raise EntityError("its knots fall, or are all equal")
    budget.draw(count - degree)
    weights = weights / high
    pieces = _pieces(degree, knots, np.column_stack([points * weights[:, None], weights]))
    if low == high and degree <= 3:
        controls, deviation = _elevated(pieces[..., :2]), 0.0
    else:
        controls, deviation = _approximated(pieces, tolerance, budget)
    return _connected(controls, deviation)


def _pieces(
    degree: int, knots: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Bézier points (s, p + 1, d) of all spans with a length; ``points`` is (n, d)."""
    spans = np.arange(degree, len(points))
    spans = spans[knots[spans] < knots[spans + 1]]
    ends = knots[spans], knots[spans + 1]
    near = points[spans[:, None] + np.arange(-degree, 1)]
    found: NDArray[np.float64] = np.empty_like(near)
    for index in range(degree + 1):
        values = near.copy()
        for level in range(1, degree + 1):
            argument = ends[1] if level <= index else ends[0]
            k = np.arange(level, degree + 1)
            left = knots[spans[:, None] - degree + k]
            right = knots[spans[:, None] + 1 + k - level]
            share = ((argument[:, None] - left) / (right - left))[..., None]
            values[:, level:] = (1 - share) * values[:, level - 1 : -1] + share * values[:, level:]
        found[:, index] = values[:, -1]
    return found


def _elevated(pieces: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same polynomials of degree 1 to 3 as cubics."""
    while pieces.shape[1] < 4:
        degree = pieces.shape[1] - 1
        share: NDArray[np.float64] = (np.arange(1, degree + 1) / (degree + 1))[:, None]
        inner = share * pieces[:, :-1] + (1 - share) * pieces[:, 1:]
        pieces = np.concatenate([pieces[:, :1], inner, pieces[:, -1:]], axis=1)
    return pieces


def _approximated(
    pieces: NDArray[np.float64], tolerance: float, budget: Budget
) -> tuple[NDArray[np.float64], float]:
    """Cubics for homogeneous pieces (s, p + 1, 3), and the bound of what they are off."""
    places = np.arange(len(pieces), dtype=np.float64)
    done: list[NDArray[np.float64]] = []
    done_places: list[NDArray[np.float64]] = []
    deviation = 0.0
    total = len(pieces)
    for halving in range(_MAX_HALVINGS + 1):
        controls, bounds = _compared(pieces)
        good = bounds <= tolerance
        if halving == _MAX_HALVINGS:
            good[:] = True
        done.append(controls[good])
        done_places.append(places[good])
        deviation = max(deviation, float(bounds[good].max(initial=0.0)))
        pieces, places = pieces[~good], places[~good]
        if len(pieces) == 0:
            break
        total += len(pieces)
        if total > MAX_PIECES:
            raise EntityError("it needs too many curves")
        budget.draw(len(pieces))
        left, right = _halves(pieces)
        pieces = np.concatenate([left, right])
        places = np.concatenate([places, places + 0.5 ** (halving + 1)])
    if not math.isfinite(deviation):
        raise EntityError("it has points beyond all numbers")
    order = np.argsort(np.concatenate(done_places), kind="stable")
    return np.concatenate(done)[order], deviation


def _compared(pieces: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cubics with the ends and end derivatives of pieces, and their bounds (see the module)."""
    degree = pieces.shape[1] - 1
    weights = pieces[..., 2]
    points = pieces[..., :2] / weights[..., None]
    share = degree / 3
    controls = np.empty((len(pieces), 4, 2))
    controls[:, 0], controls[:, 3] = points[:, 0], points[:, -1]
    controls[:, 1] = points[:, 0] + (points[:, 1] - points[:, 0]) * (
        share * weights[:, 1] / weights[:, 0]
    )[:, None]
    controls[:, 2] = points[:, -1] + (points[:, -2] - points[:, -1]) * (
        share * weights[:, -2] / weights[:, -1]
    )[:, None]
    gaps = weights[:, :, None, None] * (points[:, :, None] - controls[:, None])
    errors = np.einsum("kji,sjix->skx", _product(degree), gaps)
    bounds: NDArray[np.float64] = np.hypot(errors[..., 0], errors[..., 1]).max(axis=1)
    bounds /= weights.min(axis=1)
    return controls, bounds


@lru_cache(maxsize=MAX_DEGREE)
def _product(degree: int) -> NDArray[np.float64]:
    """Coefficients of the product of polynomials of degrees p and 3, shape (p + 4, p + 1, 4)."""
    table = np.zeros((degree + 4, degree + 1, 4))
    for j in range(degree + 1):
        for i in range(4):
            whole = math.comb(degree + 3, i + j)
            table[i + j, j, i] = math.comb(degree, j) * math.comb(3, i) / whole
    return table


def _halves(pieces: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both halves of Bézier pieces (s, p + 1, d) by de Casteljau."""
    left, right = np.empty_like(pieces), np.empty_like(pieces)
    values = pieces
    for index in range(pieces.shape[1]):
        left[:, index], right[:, -1 - index] = values[:, 0], values[:, -1]
        values = (values[:, :-1] + values[:, 1:]) / 2
    return left, right


def _connected(controls: NDArray[np.float64], deviation: float) -> list[Outline]:
    """Outlines of cubics whose ends meet but for rounding; where they do not, a new one starts."""
    corners = controls.reshape(-1, 2)
    limit = MEETS * float((corners.max(axis=0) - corners.min(axis=0)).max())
    gaps = np.hypot(*(controls[1:, 0] - controls[:-1, 3]).T)
    meets = gaps <= limit
    controls[1:, 0][meets] = controls[:-1, 3][meets]
    parts = np.split(controls, np.flatnonzero(~meets) + 1)
    rounding = float(gaps[meets].max(initial=0.0))
    return [Outline(part, False, deviation + rounding) for part in parts]
