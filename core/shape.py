"""Tangents and curvature of a limit curve, as far as its class allows them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.continuity import smoothness
from core.errors import SmoothnessError
from core.limit import LimitCurve


def tangents(curve: LimitCurve, level: int) -> NDArray[np.float64]:
    """Exact first derivatives ``dC/dt`` at the parameters of ``curve.points(level)``.

    Parameters
    ----------
    curve
        The limit curve.
    level
        Dyadic level, as for `LimitCurve.points`.

    Returns
    -------
    ndarray
        Shape of ``curve.points(level)``; zero where there is no span.

    Raises
    ------
    SmoothnessError
        If the scheme is not proven C^1.
    """
    return _derivatives(curve, level, 1)


def second_derivatives(curve: LimitCurve, level: int) -> NDArray[np.float64]:
    """Exact second derivatives with respect to t; see `tangents`. The scheme must be proven C^2."""
    return _derivatives(curve, level, 2)


def curvatures(curve: LimitCurve, level: int) -> NDArray[np.float64]:
    """Signed curvature ``(x' y'' - y' x'') / |C'|^3``, positive where the curve turns left.

    Returns
    -------
    ndarray
        Shape (k,), one value for each point of ``curve.points(level)``, in 1 over the unit of the
        points; nan where the speed is zero up to rounding, since curvature is not defined there.

    Raises
    ------
    SmoothnessError
        If the scheme is not proven C^2.
    """
    second = second_derivatives(curve, level)
    first = tangents(curve, level)
    turning = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    speed = np.hypot(*first.T)
    # A derivative is a sum of some 17 products of points and weights: this is its rounding.
    rounding = 64 * np.finfo(float).eps * np.abs(curve.control_points).max(initial=0.0)
    undefined = np.full(len(speed), np.nan)
    return np.asarray(np.divide(turning, speed**3, out=undefined, where=speed > rounding))


def _derivatives(curve: LimitCurve, level: int, order: int) -> NDArray[np.float64]:
    proven = smoothness(curve.mask).order
    if proven is None or proven < order:
        known = "not even continuity is" if proven is None else f"only C^{proven} is"
        what = "tangents need" if order == 1 else "curvature needs"
        raise SmoothnessError(f"For these parameters {known} proven, and {what} C^{order}.")
    if curve.spans == 0:
        return np.zeros_like(curve.points(level))
    spans = curve.span_points(slice(None), level, order)
    values = spans[:, :-1].reshape(-1, 2)
    return values if curve.closed else np.concatenate([values, spans[-1, -1:]])
