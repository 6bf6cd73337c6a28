"""A limit curve whose control points move, one event after the other."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.ends import extended, far, reach, write_ends
from core.limit import LimitCurve
from core.mask import Mask
from core.ranges import around, within

_MANY_SHARE: Final = 1 / 16
"""Share of the points from which on all spans count as touched: sorting would cost more."""


class LiveCurve(LimitCurve):
    """A `LimitCurve` that owns its control points and lets them move.

    It keeps one array of the polygon with its phantom points, and one view of its windows. A move
    writes the moved points into it, and what follows of them at the ends; neither the time nor the
    memory depends on the number of points. Spans are evaluated from that array, so nothing adds
    up: after any number of moves the curve is that of its control points, to rounding.

    Parameters
    ----------
    points, mask, closed
        As for `LimitCurve`. The points are copied.

    Notes
    -----
    `control_points` and `endless_points` are read-only views of what moves.
    """

    def __init__(self, points: ArrayLike, mask: Mask, closed: bool) -> None:
        super().__init__(points, mask, closed)
        self._points, self.control_points = _owned(self.control_points)
        self._store, self._coordinates = _owned(self._coordinates)
        self._reach = reach(mask)
        self._far = far(mask)

    def move(self, indices: ArrayLike, positions: ArrayLike) -> tuple[range, ...]:
        """Put control points at other places.

        Parameters
        ----------
        indices
            One index or several, shape (k,), each within ``range(n)``.
        positions
            Their new places, shape (2,) or (k, 2), finite.

        Returns
        -------
        tuple of ranges
            The spans that may have changed, in rising order, disjoint: 18 for one point in general
            (the curve changes for ``|t - i| < 17/2``), and those that read a moved phantom point.
        """
        moved = np.asarray(indices, dtype=np.intp)
        points, store = self._points, self._store
        points[moved] = positions
        count = len(points)
        if count < self._far:
            store[:] = extended(points, self.mask, self.closed).T
            return (range(self.spans),) if self.spans and moved.size else ()
        if moved.size == 0:
            return ()
        left, right = self._reach
        store[:, left + moved] = points[moved].T
        margin = self._far // 2
        at_start, at_end = moved.min() < margin, moved.max() >= count - margin
        if at_start or at_end:
            write_ends(store.T, points, self.mask, self.closed)
        if moved.size > _MANY_SHARE * count:
            return (range(self.spans),)
        touched = around(moved, 1 + right, left + 1)
        if not self.closed:
            # A centre moves with the points that it is made of, and reflects the spans' windows.
            if at_start:
                touched.append((0, left + 1))
            if at_end:
                touched.append((count - 2 - right, self.spans))
        return within(touched, self.spans, self.closed)


def _owned(array: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Array that may be written, and a view of it that may not."""
    array = array if array.flags.owndata else array.copy()
    array.flags.writeable = True
    view = array.view()
    view.flags.writeable = False
    return array, view
