"""Long rows of numbers, as vectors of the plane have them for each coordinate."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def lengths(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths of vectors, which are neither so long nor so short that squares overflow."""
    squares = x * x
    squares += y * y
    return np.sqrt(squares, out=squares)


def gathered(rows: NDArray[np.float64], indices: NDArray[np.intp]) -> NDArray[np.float64]:
    """``rows[:, indices]`` for indices >= 0; those beyond the end are the last one.

    Each row lies in one piece: of rows that as a whole do not, NumPy's ``take`` copies all.
    """
    found = np.empty((len(rows), *indices.shape))
    for row, out in zip(rows, found, strict=True):
        row.take(indices, out=out, mode="clip")
    return found


def taken(values: NDArray[Any], indices: NDArray[np.intp]) -> NDArray[Any]:
    """``values[indices]`` for indices >= 0 that need no check: half of the time."""
    return values.take(indices, mode="clip")
