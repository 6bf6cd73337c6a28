"""A limit curve whose control points move, one event after the other, and whose scheme changes."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.ends import extended, far, reach, write_ends
from core.extreme import largest, least
from core.limit import LimitCurve, columns
from core.mask import Mask
from core.ranges import around, within

SIDE: Final = 8
"""Phantom points that are kept at each end: what the widest masks of the family read."""

_SIDES: Final = (SIDE, SIDE)

_MANY_SHARE: Final = 1 / 16
"""Share of the points from which on all spans count as touched: sorting would cost more."""


class LiveCurve(LimitCurve):
    """A `LimitCurve` that owns its control points and lets them, and the scheme, change.

    It keeps one array of the polygon with its phantom points, and one view of its windows. A move
    writes the moved points into it, and what follows of them at the ends; a change of the scheme
    writes the ends alone. Neither the time nor the memory depends on the number of points. Spans
    are evaluated from that array, so nothing adds up: after any number of moves the curve is that
    of its control points, to rounding.

    Parameters
    ----------
    points, mask, closed
        As for `LimitCurve`. The points are copied.

    Notes
    -----
    `control_points`, `endless_points` and `padded` are read-only views of what moves.
    """

    _IS_EXACT = False

    def _lay_out(self, mask: Mask) -> None:
        self._asked: tuple[NDArray[np.intp], tuple[range, ...]] | None = None
        self._points = self.control_points
        self._store = columns(self._points, mask, self.closed, _SIDES)
        self._points.flags.writeable = True
        self.control_points, self.padded = _shown(self._points), _shown(self._store)
        self._show(mask)

    def recast(self, mask: Mask) -> None:
        """Draw the same control points by another scheme.

        Raises
        ------
        NoLimitError
            If the scheme has no unique limit; then nothing has changed.
        """
        if self.spans:
            self._write_ends(mask)
        self._show(mask)

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
        self.put(moved, positions)
        return self.reading(moved)

    def put(self, indices: NDArray[np.intp], positions: ArrayLike) -> None:
        """The same, without a look at what has changed; ``indices`` are an array."""
        points = self._points
        chosen, stored = _placed(indices)
        points[chosen] = positions
        if indices.size:
            is_short = len(points) < far(_SIDES)
            if not is_short:
                self._store[:, stored] = points[chosen].T
            if is_short or any(self._at_ends(indices)):
                self._write_ends(self.mask)

    def reading(self, indices: ArrayLike) -> tuple[range, ...]:
        """Spans that read some control points, as `move` tells them.

        In a drag the same array is asked about again and again. If it cannot be written, the answer
        is the same object.
        """
        moved = np.asarray(indices, dtype=np.intp)
        if moved.flags.writeable:
            return self._spans_of(moved)
        if self._asked is None or self._asked[0] is not moved:
            self._asked = moved, self._spans_of(moved)
        return self._asked[1]

    def _spans_of(self, moved: NDArray[np.intp]) -> tuple[range, ...]:
        count = len(self._points)
        if moved.size == 0:
            return ()
        if count < far(_SIDES):
            return (range(self.spans),) if self.spans else ()
        at_start, at_end = self._at_ends(moved)
        if moved.size > _MANY_SHARE * count:
            return (range(self.spans),)
        left, right = reach(self.mask)
        touched = around(moved, 1 + right, left + 1)
        if not self.closed:
            # A centre moves with the points that it is made of, and reflects the spans' windows.
            if at_start:
                touched.append((0, left + 1))
            if at_end:
                touched.append((count - 2 - right, self.spans))
        return within(touched, self.spans, self.closed)

    def _at_ends(self, moved: NDArray[np.intp]) -> tuple[bool, bool]:
        """Whether points lie so near the start, or the end, that phantom points follow them."""
        first, last = (moved.item(),) * 2 if moved.size == 1 else (least(moved), largest(moved))
        return first <= SIDE, last >= len(self._points) - 1 - SIDE

    def _write_ends(self, mask: Mask) -> None:
        points, store = self._points, self._store
        if len(points) < far(_SIDES):
            store[:] = extended(points, mask, self.closed, _SIDES).T
        else:
            write_ends(store.T, points, mask, self.closed, _SIDES)

    def _show(self, mask: Mask) -> None:
        """Let the curve read as much of the store as a scheme needs."""
        self._asked = None
        left, right = reach(mask)
        store = self.padded
        self._read(store[:, SIDE - left : store.shape[1] - SIDE + right], mask)


def _placed(
    indices: NDArray[np.intp],
) -> tuple[slice, slice] | tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Where points are, and where the store has them.

    The one point of a drag is written as a slice three times as fast as by an array.
    """
    if indices.size != 1:
        return indices, SIDE + indices
    index = indices.item()
    return slice(index, index + 1), slice(SIDE + index, SIDE + index + 1)


def _shown(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """View of an array that cannot be written."""
    view = array.view()
    view.flags.writeable = False
    return view
