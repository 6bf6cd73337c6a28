"""The limit curve: exact points at dyadic parameters, by one matrix product."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from core.basis import BasicLimitFunction
from core.ends import extended
from core.mask import Mask

MAX_LEVEL = 20
"""Finest dyadic level that is tabulated: a million points per span."""


class LimitCurve:
    """The curve to which a control polygon converges under subdivision.

    Parameters
    ----------
    points
        Control points, shape (n, 2), finite; n >= 0. They are copied.
    mask
        Mask of a scheme whose rules sum to 1. If it does not converge, `points` gives the finite
        values of the refinement equation, which grow with the level.
    closed
        Closed: t runs through [0, n), indices are taken modulo n. Open: t runs through
        [0, n - 1], from the first control point to the last, by the end rules of `core.ends`.

    Raises
    ------
    ValueError
        If the points are not an (n, 2) array of finite numbers.
    NoLimitError
        If the scheme has no unique limit.
    """

    def __init__(self, points: ArrayLike, mask: Mask, closed: bool) -> None:
        polygon = np.array(points, dtype=np.float64)
        if polygon.size == 0:
            polygon = polygon.reshape(0, 2)
        if polygon.ndim != 2 or polygon.shape[1] != 2:
            raise ValueError(f"control points must have the shape (n, 2), not {polygon.shape}")
        if not np.isfinite(polygon).all():
            raise ValueError("control points must be finite")
        polygon.flags.writeable = False
        self.control_points = polygon
        self.mask = mask
        self.closed = closed
        self._basis = BasicLimitFunction(mask)
        self.endless_points = extended(polygon, mask, closed) if len(polygon) else polygon

    @property
    def spans(self) -> int:
        """Number of unit intervals of t: n when closed, n - 1 when open."""
        count = len(self.control_points)
        return count if self.closed else max(count - 1, 0)

    def parameters(self, level: int) -> NDArray[np.float64]:
        """Parameters ``t = k / 2^level`` of the entries of `points`."""
        count = self.spans * 2**level
        if not self.closed and len(self.control_points):
            count += 1
        parameters: NDArray[np.float64] = np.arange(count) / 2**level
        return parameters

    def points(self, level: int) -> NDArray[np.float64]:
        """Exact points of the limit curve at ``t = k / 2^level`` (theory, section 6).

        Parameters
        ----------
        level
            Dyadic level, 0 to `MAX_LEVEL`.

        Returns
        -------
        ndarray
            Shape (n 2^level, 2) closed, ((n - 1) 2^level + 1, 2) open; exact up to rounding, some
            8 eps times the largest coordinate for convergent schemes.
        """
        polygon = self.control_points
        if self.spans == 0:
            return polygon.copy()
        curve = self.span_points(slice(None), level)[:, :-1].reshape(-1, 2)
        if self.closed:
            return curve
        return np.concatenate([curve, polygon[-1:]])

    def at(self, t: float) -> NDArray[np.float64]:
        """Exact point of the curve at any parameter, shape (2,).

        Parameters
        ----------
        t
            Closed: any real number, taken modulo n. Open: 0 <= t <= n - 1. The curve must have at
            least one span.
        """
        span, tau = self.span_of(t)
        weights = self._basis.weights(tau)
        if tau == 0 and span == self.spans:
            span, weights = span - 1, np.concatenate([[0.0], weights[:-1]])
        return weights @ self.endless_points[span : span + len(weights)]

    def span_of(self, t: float) -> tuple[int, float]:
        """Span i and place tau, 0 <= tau < 1, of a parameter; the end of an open curve is (n-1, 0).

        Raises
        ------
        ValueError
            If the curve is open and t lies beyond its ends.
        """
        if self.closed:
            t %= self.spans
        elif not 0 <= t <= self.spans:
            raise ValueError(f"t must lie between 0 and {self.spans}, not {t}")
        span = int(t)
        return span % self.spans if self.closed else span, t - span

    def span_points(
        self, spans: slice | NDArray[np.intp], level: int, order: int = 0
    ) -> NDArray[np.float64]:
        """Exact points of some spans, both ends included; or derivatives with respect to t.

        Parameters
        ----------
        spans
            Which spans ``[i, i + 1]``: a slice or an array of indices within ``range(self.spans)``.
        level
            Dyadic level, 0 to `MAX_LEVEL`.
        order
            Which derivative; 0 for the points. Only sensible up to the class of the scheme, which
            `core.shape` makes sure of.

        Returns
        -------
        ndarray
            Shape (k, 2^level + 1, 2): for each span the values at ``t = i + m / 2^level``. The last
            value of a span is, up to rounding, the first of the next.
        """
        if not 0 <= level <= MAX_LEVEL:
            raise ValueError(f"level must lie between 0 and {MAX_LEVEL}, not {level}")
        indices = np.arange(self.spans)[spans]
        table = self._basis.table(level, order)
        windows = sliding_window_view(self.endless_points, len(table), axis=0)
        points = np.empty((len(indices), 2**level + 1, 2))
        points[:, :-1] = np.matmul(windows[indices], table).transpose(0, 2, 1)
        # The end t = i + 1 is read with the window of span i: the first column, one point on.
        points[:, -1] = windows[indices, :, 1:] @ table[:-1, 0]
        if order == 0 and not self.closed:
            # The end rules hold up to rounding; a contour has to end exactly where it was told to.
            points[indices == 0, 0] = self.control_points[0]
            points[indices == self.spans - 1, -1] = self.control_points[-1]
        return points
