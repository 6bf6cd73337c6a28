"""Arcs of circles and ellipses as cubics, with a proven bound of what they are off.

Notes
-----
An arc of the unit circle over an angle a is replaced by the cubic with the same ends and tangents
whose handles have the length k = 4/3 tan(a/4), so that its middle lies on the circle too (Goldapp,
CAGD 8, 1991). With it ``|B(t)|^2 - 1`` has double roots at 0 and 1 (common tangents) and at 1/2
(symmetry), and degree 6, so it is ``c (t (1 - t) (1 - 2t))^2``. The coefficient of t^6 is
``|P3 - 3 P2 + 3 P1 - P0|^2``, which gives c = 16 sin^6(a/4) / cos^2(a/4) for a up to half a turn.
With u = t (1 - t), the square is ``u^2 (1 - 4 u)``, at most 1/108 at u = 1/6. So

    0 <= |B(t)| - 1 <= (|B(t)|^2 - 1) / 2 <= 2/27 sin^6(a/4) / cos^2(a/4).

Each ray between the ends meets cubic and arc, hence this bounds their Hausdorff distance. An
ellipse is an affine picture of the unit circle, in which no distance grows by more than the larger
half axis.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

QUARTER: Final = math.pi / 2
"""Largest angle of a piece."""

_STEEPEST: Final = 2 / 27 / math.cos(QUARTER / 4) ** 2
"""Bound of the deviation over (a/4)^6 for pieces up to a quarter turn, as sin x <= x."""

_MAX_RATIO: Final = 1e16
"""Half axis over tolerance beyond which floats do not resolve the tolerance anyway."""


def deviation(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Bound of the distance between unit arcs of some angles, up to pi, and their cubics."""
    quarter = np.abs(angles) / 4
    bound: NDArray[np.float64] = 2 / 27 * np.sin(quarter) ** 6 / np.cos(quarter) ** 2
    return bound


def pieces(
    longest: NDArray[np.float64], sweeps: NDArray[np.float64], tolerance: float
) -> NDArray[np.intp]:
    """Number of equal pieces of each arc, so that each keeps to the tolerance.

    Parameters
    ----------
    longest
        Larger half axes, shape (n,), finite.
    sweeps
        Angles, shape (n,), in radians, of any sign, at most a turn.
    tolerance
        Admitted distance, positive, in the unit of the half axes.
    """
    ratio = np.minimum(longest / tolerance, _MAX_RATIO)
    fine = np.abs(sweeps) / 4 * (ratio * _STEEPEST) ** (1 / 6)
    coarse = np.abs(sweeps) / QUARTER * (1 - 1e-15)  # two quarters make a half, not three
    return np.maximum(np.ceil(np.maximum(fine, coarse)), 1).astype(np.intp)


def cubics(
    centres: NDArray[np.float64],
    firsts: NDArray[np.float64],
    seconds: NDArray[np.float64],
    starts: NDArray[np.float64],
    sweeps: NDArray[np.float64],
    counts: NDArray[np.intp],
) -> NDArray[np.float64]:
    """Cubics of the arcs ``centre + first cos a + second sin a``, one arc after the other.

    Parameters
    ----------
    centres, firsts, seconds
        Centres and conjugate half axes, shape (n, 2).
    starts, sweeps
        First angle of each arc and the angle it turns by, shape (n,).
    counts
        Number of equal pieces of each arc, from `pieces`.

    Returns
    -------
    NDArray[np.float64]
        Shape (counts.sum(), 4, 2). Neighbours on an arc have common points bit for bit; the ends
        of an arc are rounded, so who knows them better puts them in.
    """
    total = int(counts.sum())
    owner = np.repeat(np.arange(len(counts)), counts)
    index = np.arange(total) - np.repeat(np.cumsum(counts) - counts, counts)
    step = (sweeps / counts)[owner]
    low = starts[owner] + index * step
    # The end of a piece is computed as the start of the next one is.
    high = starts[owner] + (index + 1) * step
    handle = 4 / 3 * np.tan(step / 4)
    cos_low, sin_low, cos_high, sin_high = np.cos(low), np.sin(low), np.cos(high), np.sin(high)
    unit = np.empty((total, 4, 2))
    unit[:, 0, 0], unit[:, 0, 1] = cos_low, sin_low
    unit[:, 1, 0], unit[:, 1, 1] = cos_low - handle * sin_low, sin_low + handle * cos_low
    unit[:, 2, 0], unit[:, 2, 1] = cos_high + handle * sin_high, sin_high - handle * cos_high
    unit[:, 3, 0], unit[:, 3, 1] = cos_high, sin_high
    controls: NDArray[np.float64] = (
        centres[owner, None, :]
        + unit[:, :, :1] * firsts[owner, None, :]
        + unit[:, :, 1:] * seconds[owner, None, :]
    )
    return controls


def pin(
    controls: NDArray[np.float64],
    counts: NDArray[np.intp],
    starts: NDArray[np.float64],
    ends: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Put the known ends (n, 2) of arcs into their cubics, in place.

    Returns
    -------
    NDArray[np.float64]
        Bound of how far a point of each arc has moved, shape (n,).
    """
    tails = np.cumsum(counts) - 1
    heads = tails - counts + 1
    before, after = starts - controls[heads, 0], ends - controls[tails, 3]
    controls[heads, 0], controls[tails, 3] = starts, ends
    moved: NDArray[np.float64] = np.hypot(*before.T) + np.hypot(*after.T)
    return moved


def piece_count(longest: float, sweep: float, tolerance: float) -> int:
    """Number of equal pieces of one arc, as `pieces` has it."""
    ratio: float = min(longest / tolerance, _MAX_RATIO)
    fine: float = abs(sweep) / 4 * (ratio * _STEEPEST) ** (1 / 6)
    coarse = abs(sweep) / QUARTER * (1 - 1e-15)
    return max(math.ceil(max(fine, coarse)), 1)


def unit_deviation(angle: float) -> float:
    """Bound of the distance between one unit arc and its cubic, as `deviation` has it."""
    quarter = angle / 4
    return 2 / 27 * math.sin(quarter) ** 6 / math.cos(quarter) ** 2


def arc(
    centre: tuple[float, float],
    first: tuple[float, float],
    second: tuple[float, float],
    start: float,
    sweep: float,
    count: int,
) -> list[float]:
    """Cubics of one arc, as `cubics` has them, eight numbers each.

    A drawing has many arcs of few pieces, for which NumPy takes ten times as long.
    """
    (x, y), (ux, uy), (vx, vy) = centre, first, second
    step = sweep / count
    handle = 4 / 3 * math.tan(step / 4)
    numbers: list[float] = []
    cos, sin = math.cos(start), math.sin(start)
    ax, ay = x + cos * ux + sin * vx, y + cos * uy + sin * vy
    dx, dy = handle * (cos * vx - sin * ux), handle * (cos * vy - sin * uy)
    for index in range(1, count + 1):
        cos, sin = math.cos(start + index * step), math.sin(start + index * step)
        bx, by = x + cos * ux + sin * vx, y + cos * uy + sin * vy
        ex, ey = handle * (cos * vx - sin * ux), handle * (cos * vy - sin * uy)
        numbers += (ax, ay, ax + dx, ay + dy, bx - ex, by - ey, bx, by)
        ax, ay, dx, dy = bx, by, ex, ey
    return numbers
