"""The limit curve as cubic Bézier curves with common tangents, with the proven deviation.

Notes
-----
A cubic from A to B that keeps the unit tangents T and S there has two numbers left, the lengths a
and b of its handles: ``c_1 = A + a T``, ``c_2 = B - b S``. They follow from least squares over the
samples p_k: with a place u_k on the cubic for each, what counts is the distance along the normal,
while u_k moves to the foot of p_k after each round (Gauss-Newton with the places eliminated).

Proof of the deviation. Whatever the places u_k are, with 0 for A and 1 for B, the step between two
samples is compared with the cubic between their places, at equal shares. The chords of both are no
further apart than their ends, ``|p_k - B(u_k)|``, and the cubic leaves its chord by at most
``(u_k+1 - u_k)^2 max |B''| / 8``, the second derivative being largest at an end. The curve in turn
keeps to the polygon of the samples by `core.samples`, at equal shares as well. So the sum of the
three bounds the distance of curve and cubic as moving points (Fréchet), hence the Hausdorff
distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.flatten import polyline
from core.limit import LimitCurve
from core.touching import TouchingFit, touching

_ROUNDS: Final = 5
"""Rounds of least squares; the error has settled to a percent by then."""

_FITTED: Final = 128
"""Number of samples that take part in the least squares, at most."""

_STEPS: Final = 3
"""Steps to the feet of all samples, from places at equal shares of the length."""

_ALONG: Final = 0.01
"""Weight of distances along the curve, which do not count, but keep straight pieces determined."""

_PRIOR: Final = 1e-8
"""Weight of a third of the way as the length of a handle, where few samples leave it open."""

_LONGEST_HANDLE: Final = 2.0
"""Longest handle, in lengths of the way along the samples: beyond, the cubic has a loop."""


@dataclass(frozen=True, eq=False)
class Beziers:
    """A chain of cubic Bézier curves.

    Attributes
    ----------
    controls
        Control points, shape (n, 4, 2), in the direction of t. Each curve starts with the very
        numbers that the one before ends with, and when closed the last one ends where the first
        one starts. Straight pieces have their handles at thirds.
    closed
        Whether the curve is closed.
    smooth
        Whether neighbours have a common tangent everywhere; else there may be corners.
    deviation
        Proven bound of the Hausdorff distance between the chain and the exact curve, in the unit
        of the points.
    """

    controls: NDArray[np.float64]
    closed: bool
    smooth: bool
    deviation: float


def beziers(curve: LimitCurve, tolerance: float) -> Beziers:
    """Cubics with common tangents, within ``tolerance`` of the curve.

    Their ends lie on the curve and have its exact tangents. Where the curve stands still, so that
    it has no tangent, or turns back within a small part of the tolerance, lines take over; a scheme
    that is not proven C^1 gives lines only.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.

    Returns
    -------
    Beziers
        Pieces start at t = 0 and are as long as they can be, each from where the last one ends.
        Without spans, none.

    Raises
    ------
    NinepointError
        As `core.flatten.polyline`.
    """
    pieces = touching(curve, tolerance, _Cubics) if tolerance > 0 else None
    if pieces is None:
        flat = polyline(curve, tolerance)
        if curve.spans == 0:
            return Beziers(np.zeros((0, 4, 2)), False, False, flat.deviation)
        joints, smooth, deviation = flat.points, False, flat.deviation
        handles = np.full((len(joints) - (not curve.closed), 2, 2), np.nan)
    else:
        joints = np.stack([pieces.joints.real, pieces.joints.imag], axis=1)
        if not curve.closed:
            joints = np.concatenate([joints, curve.control_points[-1:]])
        handles, smooth = pieces.rows.reshape(-1, 2, 2), pieces.smooth
        deviation = pieces.deviation
    controls = np.empty((len(handles), 4, 2))
    controls[:, 0] = joints[: len(handles)]
    controls[:, 3] = np.roll(joints, -1, axis=0)[: len(handles)]
    way = controls[:, 3] - controls[:, 0]
    thirds = np.stack([controls[:, 0] + way / 3, controls[:, 3] - way / 3], axis=1)
    controls[:, 1:3] = np.where(np.isnan(handles), thirds, handles)
    # Dots are left where coincident control points stop the curve.
    extended = (controls != controls[:, :1]).any(axis=(1, 2))
    return Beziers(controls[extended], curve.closed, smooth, deviation)


class _Cubics(TouchingFit):
    """The fit of cubics. Its rows are the two inner control points."""

    columns = 4

    def smooth(
        self,
        start: NDArray[np.complex128],
        way: NDArray[np.complex128],
        tangents: tuple[NDArray[np.complex128], NDArray[np.complex128]],
        seen: NDArray[np.complex128],
        whole: bool,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `TouchingFit`. Both handles point forward."""
        before, after = tangents
        lengths = np.zeros(seen.shape)
        np.cumsum(np.abs(np.diff(seen, axis=1)), axis=1, out=lengths[:, 1:])
        total = lengths[:, -1]
        exists = total > 0
        u = np.divide(lengths, total[:, None], out=np.zeros_like(lengths), where=exists[:, None])
        first, second = total / 3, total / 3
        # So many samples determine two lengths as well as all of them do.
        some = slice(None, None, seen.shape[1] // _FITTED + 1)
        fitted, places = seen[:, some], u[:, some]
        for _ in range(_ROUNDS):
            inner = first * before, way - second * after
            places, forward = _feet(places, way, inner, fitted)
            first, second = _handles(places, way, tangents, forward, fitted, total / 3)
        exists &= (first > 0) & (second > 0)
        exists &= np.maximum(first, second) < _LONGEST_HANDLE * total
        inner = first * before, way - second * after
        if fitted.shape == seen.shape:
            u, _ = _feet(places, way, inner, seen)
        else:
            for _ in range(_STEPS):
                u, _ = _feet(u, way, inner, seen)
        u[:, 0], u[:, -1] = 0, 1
        errors = np.abs(seen - _values(u, way, inner)).max(axis=1)
        if whole:
            bend = 6 * np.maximum(
                np.abs(inner[1] - 2 * inner[0]), np.abs(inner[0] - 2 * inner[1] + way)
            )
            errors += bend * np.abs(np.diff(u, axis=1)).max(axis=1) ** 2 / 8
        errors[~exists] = np.inf
        controls = inner[0] + start, inner[1] + start
        return errors, np.stack([x for c in controls for x in (c.real, c.imag)], axis=1)


def _values(
    u: NDArray[np.float64],
    way: NDArray[np.complex128],
    inner: tuple[NDArray[np.complex128], NDArray[np.complex128]],
) -> NDArray[np.complex128]:
    """Points of the cubics 0, inner, way at the places u, shape (k, m)."""
    one, two, three = 3 * inner[0], 3 * inner[1], way
    v = 1 - u
    return np.asarray(u * (v * v * one[:, None] + u * (v * two[:, None] + u * three[:, None])))


def _slopes(
    u: NDArray[np.float64],
    way: NDArray[np.complex128],
    inner: tuple[NDArray[np.complex128], NDArray[np.complex128]],
) -> NDArray[np.complex128]:
    """Their derivatives with respect to u."""
    one, two, three = 3 * inner[0], 6 * (inner[1] - inner[0]), 3 * (way - inner[1])
    v = 1 - u
    return np.asarray(v * v * one[:, None] + u * (v * two[:, None] + u * three[:, None]))


def _feet(
    u: NDArray[np.float64],
    way: NDArray[np.complex128],
    inner: tuple[NDArray[np.complex128], NDArray[np.complex128]],
    seen: NDArray[np.complex128],
) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    """Places nearer to the feet of what is seen, by a step of Newton's, and ``forward``.

    This is the conjugate of the direction of the cubics where the step began: a factor of it turns
    the way along them into the real axis.
    """
    slopes = _slopes(u, way, inner)
    size = np.abs(slopes)
    forward = np.divide(slopes.conj(), size, out=np.ones_like(slopes), where=size > 0)
    along = ((seen - _values(u, way, inner)) * forward).real
    moved = u + np.divide(along, size, out=np.zeros_like(along), where=size > 0)
    moved = np.minimum(np.maximum(moved, 0.0), 1.0)
    return moved, forward


def _handles(
    u: NDArray[np.float64],
    way: NDArray[np.complex128],
    tangents: tuple[NDArray[np.complex128], NDArray[np.complex128]],
    forward: NDArray[np.complex128],
    seen: NDArray[np.complex128],
    prior: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lengths of the handles by least squares, shape (k,) each."""
    v = 1 - u
    # In this frame the real part is along the curve.
    rest = (seen - (u * u * (3 - 2 * u)) * way[:, None]) * forward
    weight = 3 * u * v
    one = (weight * v) * (tangents[0][:, None] * forward)
    two = (-weight * u) * (tangents[1][:, None] * forward)

    def product(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.float64]:
        return np.asarray((a.imag * b.imag + _ALONG * a.real * b.real).sum(axis=1))

    weight = _PRIOR * u.shape[1]
    aa, ab, bb = product(one, one) + weight, product(one, two), product(two, two) + weight
    a, b = product(one, rest) + weight * prior, product(two, rest) + weight * prior
    determinant = aa * bb - ab * ab
    return (bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant
