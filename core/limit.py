"""The limit curve: exact points at dyadic parameters, by one matrix product.

Notes
-----
Coordinates are stored apart, all x, then all y: so a product of windows of control points and a
table writes the points once, where they stay, and no copy turns them round. What is returned is
the transpose of that, an (n, 2) array whose columns are contiguous.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.basis import BasicLimitFunction
from core.ends import extended
from core.mask import Mask
from core.windows import product, scattered, windows_of

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

    _IS_EXACT: ClassVar = True
    """Whether tables are made of exact values, or of quick ones (`BasicLimitFunction`)."""

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
        self.closed = closed
        self.spans = len(polygon) if closed else max(len(polygon) - 1, 0)
        """Number of unit intervals of t: n when closed, n - 1 when open."""
        self._lay_out(mask)

    def _lay_out(self, mask: Mask) -> None:
        """Make the endless polygon."""
        coordinates = columns(self.control_points, mask, self.closed)
        coordinates.flags.writeable = False
        self._read(coordinates, mask)

    def _read(self, coordinates: NDArray[np.float64], mask: Mask) -> None:
        """Evaluate from now on the endless polygon (2, m), as far as the scheme reads it."""
        self.mask = mask
        self._basis = BasicLimitFunction(mask, self._IS_EXACT)
        self._coordinates = coordinates
        # One view for many products: to make it costs more than a small one.
        self._windows = windows_of(coordinates, mask.end - mask.start + 1, self.spans)
        self._cells: NDArray[np.float64] | None = None

    @property
    def endless_points(self) -> NDArray[np.float64]:
        """The polygon with its phantom points, see `core.ends.extended`; read-only."""
        return self._coordinates.T

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
        _check_level(level)
        polygon = self.control_points
        if self.spans == 0:
            return polygon.copy()
        if level == 0:
            curve = product(self._windows, self._basis.table(0))[:, :, 0]
            if not self.closed:
                curve = np.concatenate([curve, polygon[-1:].T], axis=1)
        else:
            # Cells read one point less than spans do; the first begins half a span before t = 0.
            if self._cells is None:
                size = self.mask.end - self.mask.start
                self._cells = windows_of(self._coordinates, size, self.spans + 1)
            cells = product(self._cells, self._basis.cell_table(level)[:, :-1]).reshape(2, -1)
            first = 2 ** (level - 1)
            curve = cells[:, first : first + (self.spans << level) + (not self.closed)]
        if not self.closed:
            # The end rules hold up to rounding; a contour has to end exactly where it was told to.
            curve[:, 0], curve[:, -1] = polygon[0], polygon[-1]
        return curve.T

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
        point: NDArray[np.float64] = self._windows[:, :, span].T @ weights
        return point

    def span_of(self, t: float) -> tuple[int, float]:
        """Span and place in it of a parameter: `span_of` for this curve."""
        return span_of(t, self.spans, self.closed)

    def span_points(
        self, spans: slice | NDArray[np.intp], level: int, order: int = 0
    ) -> NDArray[np.float64]:
        """Exact points of some spans, both ends included; or derivatives with respect to t.

        Parameters
        ----------
        spans
            Which spans ``[i, i + 1]``: a slice or an array of indices within ``range(self.spans)``.
            A slice costs no index array.
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
        _check_level(level)
        points = product(self._windows[:, :, spans], self._basis.span_table(level, order))
        if order == 0 and not self.closed:
            self._pin_ends(points, spans)
        return points.transpose(1, 2, 0)

    def span_starts(
        self,
        spans: slice | NDArray[np.intp],
        level: int,
        order: int = 0,
        out: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Values of `span_points` without the ends of the spans, each coordinate apart.

        Parameters
        ----------
        spans, level, order
            As in `span_points`.
        out
            Array for the result.

        Returns
        -------
        ndarray
            Shape (2, k, 2^level). The start of an open curve is exact up to rounding only.
        """
        _check_level(level)
        return product(self._windows[:, :, spans], self._basis.table(level, order), out)

    def scattered_points(
        self, spans: NDArray[np.intp], places: NDArray[np.intp], level: int
    ) -> NDArray[np.float64]:
        """Exact points at ``t = spans[i] + places[i] / 2^level``, each coordinate apart.

        Parameters
        ----------
        spans
            Spans within ``range(self.spans)``, shape (k,).
        places
            Integers within ``range(2^level + 1)``, shape (k,): the end of a span is a part of it.
        level
            Dyadic level, 0 to `MAX_LEVEL`.

        Returns
        -------
        ndarray
            Shape (2, k). The ends of an open curve are exact up to rounding only.
        """
        _check_level(level)
        return scattered(self._windows, self._basis.span_table(level), spans, places)

    def _pin_ends(self, points: NDArray[np.float64], spans: slice | NDArray[np.intp]) -> None:
        """Put the ends of an open curve, among points of spans (2, k, m), where they belong."""
        first, last = 0, self.spans - 1
        if isinstance(spans, slice):
            chosen = range(*spans.indices(self.spans))
            if first in chosen:
                points[:, chosen.index(first), 0] = self.control_points[0]
            if last in chosen:
                points[:, chosen.index(last), -1] = self.control_points[-1]
        else:
            points[:, spans == first, 0] = self.control_points[0][:, None]
            points[:, spans == last, -1] = self.control_points[-1][:, None]


def span_of(t: float, spans: int, closed: bool) -> tuple[int, float]:
    """Span i and place tau, 0 <= tau < 1, of a parameter; the end of an open curve is (n - 1, 0).

    Parameters
    ----------
    t
        The parameter.
    spans
        Number of spans of the curve, at least 1.
    closed
        Whether t is taken modulo the number of spans.

    Raises
    ------
    ValueError
        If the curve is open and t lies beyond its ends.
    """
    if closed:
        t %= spans
    elif not 0 <= t <= spans:
        raise ValueError(f"t must lie between 0 and {spans}, not {t}")
    span = int(t)
    return span % spans if closed else span, t - span


def columns(
    points: NDArray[np.float64],
    mask: Mask,
    closed: bool,
    sides: tuple[int, int] | None = None,
) -> NDArray[np.float64]:
    """Coordinates of `core.ends.extended`, each in a row of its own, (2, m); no view of points."""
    endless = extended(points, mask, closed, sides) if len(points) else points.copy()
    return np.ascontiguousarray(endless.T)


def _check_level(level: int) -> None:
    if not 0 <= level <= MAX_LEVEL:
        raise ValueError(f"level must lie between 0 and {MAX_LEVEL}, not {level}")
