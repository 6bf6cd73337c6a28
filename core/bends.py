"""How far a curve leaves the chords of the parts of its spans, by what each span reads."""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY
from core.chords import ROUNDING, cell_constant, chord_constant
from core.folding import folded
from core.limit import LimitCurve
from core.mask import Mask
from core.parallel import each
from core.windows import product, running_max, windows_of

_REFINED: Final = 3
"""Refinements after which second differences are looked at again: a window of control points is as
wide as a span then, about."""

_CHUNK: Final = 2**13
"""Spans whose refined second differences are held at a time."""


class ChordBounds:
    """Proven bounds of the distance between a curve and its chords, for each span.

    Parameters
    ----------
    curve
        The limit curve, at least one span.

    Notes
    -----
    With second differences D2p of the control points that a span reads, its parts of level L keep
    within ``chord_constant(L) max |D2p|`` of their chords. They are cells of the three times
    refined polygon too, which keep within ``cell_constant(L - 3) max |D2P|`` of them, P being the
    few refined points that the cells of the span read: these are all near it, which matters where
    a curve bends unevenly. The smaller bound counts.
    """

    def __init__(self, curve: LimitCurve) -> None:
        self._curve = curve
        self._mask = curve.mask
        polygon = curve.endless_points.T
        steps = polygon[:, 1:] - polygon[:, :-1]
        self._differences = steps[:, 1:] - steps[:, :-1]

    def at(self, level: int, spans: slice = slice(None)) -> NDArray[np.float64]:
        """Bounds for the chords of the ``2^level`` equal parts of each of some spans.

        Raises
        ------
        NoLimitError
            If the scheme is not seen to converge (see `core.chords`).
        """
        found = chord_constant(self._mask, level) * self._largest[spans]
        if level < _REFINED:
            return found
        refined = cell_constant(self._mask, level - _REFINED) * self._refined[spans]
        return np.minimum(found, refined)

    @cached_property
    def _largest(self) -> NDArray[np.float64]:
        """Largest second difference that each span reads."""
        reads = self._mask.end - self._mask.start - 1
        return running_max(np.hypot(*self._differences), reads)[: self._curve.spans]

    @cached_property
    def _refined(self) -> NDArray[np.float64]:
        """Largest second difference of the refined polygon that the parts of each span read."""
        matrix = _refinement(self._mask)
        spans = self._curve.spans
        windows = windows_of(self._differences, len(matrix), spans)

        def largest(begin: int) -> NDArray[np.float64]:
            x, y = product(windows[:, :, begin : begin + _CHUNK], matrix)
            squares = x * x
            squares += y * y
            found: NDArray[np.float64] = squares.max(axis=1)
            return found

        found = np.concatenate(each(largest, range(0, spans, _CHUNK)))
        np.sqrt(found, out=found)
        found *= ROUNDING
        return found


@lru_cache(maxsize=MEMORY)
def _refinement(mask: Mask) -> NDArray[np.float64]:
    """Matrix that makes of the second differences a span reads those that its parts read.

    With ``D2P_m = P_m - 2 P_(m-1) + P_(m-2)``, the symbol of their refinement is
    ``b = a / (1+z)^2``, so that ``D2P_m = sum_j b^[3]_(m - 8 j) D2p_j``, the support of b^[3]
    starting at 7 start. The span 0 reads p_j, j = 1 - end .. 1 - start, and its parts, the cells 4
    to 11 (`core.parts.refinements`), P_m, m = 5 - end .. 11 - start.

    Returns
    -------
    ndarray
        Shape (end - start - 1, end - start + 5).
    """
    symbol = mask.divided(2).values
    iterated = symbol
    for _ in range(_REFINED - 1):
        iterated = folded(iterated, symbol)
    parts = 2**_REFINED
    coarse = np.arange(3 - mask.end, 2 - mask.start)
    fine = np.arange(7 - mask.end, 12 - mask.start)
    index = fine - parts * coarse[:, None] - (parts - 1) * mask.start
    inside = (index >= 0) & (index < len(iterated))
    matrix: NDArray[np.float64] = np.where(
        inside, iterated[np.clip(index, 0, len(iterated) - 1)], 0.0
    )
    matrix.flags.writeable = False
    return matrix
