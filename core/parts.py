"""The eight parts of a span, or of a cell: what they read, by one product with what it reads."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY
from core.folding import folded
from core.mask import Mask
from core.runs import PARTS

STEP: Final = 3
"""Refinements that are done at a time, into `PARTS` parts: few large products, not many small."""


@lru_cache(maxsize=MEMORY)
def refinements(mask: Mask) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Matrices that cut a window of control points into those of its eight parts.

    Returns
    -------
    from_span, from_cell
        Shapes (r + 1, 8 r) and (r, 8 r), r = end - start. The parts of a span ``[i, i + 1]`` and of
        a cell ``[i - 1/2, i + 1/2]`` are cells of the three times refined polygon, whose point m
        lies at ``t = (m + 1/2) / 8 - 1/2`` (theory, section 1): cells 4 to 11 of the span 0, cells
        0 to 7 of the cell 0.
    """
    parts = PARTS
    iterated = folded(folded(mask.values, mask.values), mask.values)
    width = mask.end - mask.start
    both = []
    for first, reads in ((parts // 2, width + 1), (0, width)):
        coarse = np.arange(reads) + 1 - mask.end
        fine = (first + np.arange(parts)[:, None] + np.arange(width) + 1 - mask.end).ravel()
        index = fine - parts * coarse[:, None] - (parts - 1) * mask.start
        inside = (index >= 0) & (index < len(iterated))
        matrix = np.where(inside, iterated[np.clip(index, 0, len(iterated) - 1)], 0.0)
        matrix.flags.writeable = False
        both.append(matrix)
    return both[0], both[1]
