"""Vertices of a few spans, without levels of detail: where there are few, that is faster."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.chords import chord_constant
from core.extreme import largest, same
from core.limit import LimitCurve
from core.mask import Mask
from core.windows import running_max

FINEST: Final = 6
"""Dyadic level beyond which a span has to be cut to what is seen of it."""


class SpanVertices:
    """Vertices of consecutive spans of a curve that moves, each span as fine as it needs.

    Parameters
    ----------
    spans
        The spans, at least one.

    Notes
    -----
    Mostly a span needs now what it needed before; so long the places t are the same array.
    """

    def __init__(self, spans: range) -> None:
        self.spans = spans
        self._limits: tuple[Mask, float, NDArray[np.float64]] | None = None
        self._levels: NDArray[np.intp] | None = None
        self._t = np.zeros(0)
        self._chosen = np.zeros(0, dtype=np.intp)

    def of(
        self, limit: LimitCurve, tolerance: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
        """Places t and points of the spans, seen or not.

        Parameters
        ----------
        limit
            A curve whose chords have a proven bound (`core.chords.chord_constant`).
        tolerance
            Largest admitted distance between curve and chords, in the unit of the points.

        Returns
        -------
        t, points
            Shapes (k,) and (k, 2), both ends included; None if a span needs a level beyond
            `FINEST`.
        """
        mask, spans = limit.mask, self.spans
        reads = mask.end - mask.start + 1
        windows = limit.endless_points[spans.start : spans.stop + reads - 1]
        steps = windows[1:] - windows[:-1]
        bends = steps[1:] - steps[:-1]
        bends = np.hypot(bends[:, 0], bends[:, 1])
        bounds = running_max(bends, reads - 2)
        # The level of a span is the number of those whose chords would be too far off.
        levels = self._admitted(mask, tolerance, largest(bounds)).searchsorted(bounds)
        finest = largest(levels)
        if finest > FINEST:
            return None
        if self._levels is None or not same(levels, self._levels):
            self._lay_out(levels, finest)
        points = limit.span_points(slice(spans.start, spans.stop), finest)
        return self._t, points.transpose(2, 0, 1).reshape(2, -1).take(self._chosen, axis=1).T

    def _admitted(self, mask: Mask, tolerance: float, bend: float) -> NDArray[np.float64]:
        """Largest second differences that the levels admit, rising: from 0 to that for ``bend``.

        If no level up to `FINEST` is fine enough, all of them.
        """
        if self._limits is None or self._limits[:2] != (mask, tolerance):
            self._limits = mask, tolerance, np.zeros(0)
        admitted = self._limits[2].tolist()
        count = len(admitted)
        # While a slider moves each scheme is seen once: no more constants are found than needed.
        while len(admitted) <= FINEST and not (admitted and admitted[-1] >= bend):
            own = tolerance / chord_constant(mask, len(admitted))
            admitted.append(max([own, *admitted[-1:]]))
        if len(admitted) > count:
            self._limits = mask, tolerance, np.array(admitted)
        return self._limits[2]

    def _lay_out(self, levels: NDArray[np.intp], finest: int) -> None:
        """Choose places t, and which of the points at the finest level they are."""
        sizes = 1 << levels
        span = np.repeat(np.arange(len(levels)), sizes)
        ends = np.cumsum(sizes)
        place = np.arange(ends[-1]) - np.repeat(ends - sizes, sizes)
        each = (1 << finest) + 1
        self._levels = levels
        self._chosen = np.append(span * each + (place << (finest - levels)[span]),
                                 len(levels) * each - 1)  # fmt: skip
        self._t = self.spans.start + np.append(span + place / sizes[span], len(levels))
