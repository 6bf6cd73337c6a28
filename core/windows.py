"""Windows of long arrays, one at each place: their products with tables, and their maxima."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

_WHOLE: Final = 2**17
"""Number of values up to which one product is faster than several."""

_CHUNK: Final = 1024
"""Windows in each product beyond that: a copy of them, some 300 kB, stays in the cache."""

_SEVERAL: Final = 1024
"""Single entries up to which it is faster to gather all that is multiplied at once."""


def windows_of(coordinates: NDArray[np.float64], size: int, count: int) -> NDArray[np.float64]:
    """Windows as a read-only view: ``out[r, c, k] = coordinates[c, k + r]``.

    Parameters
    ----------
    coordinates
        Shape (2, m), m >= count + size - 1: each coordinate in a row of its own.
    size, count
        Length of a window; number of windows.

    Returns
    -------
    ndarray
        Shape (size, 2, count).
    """
    row, item = coordinates.strides
    return np.lib.stride_tricks.as_strided(
        coordinates, (size, 2, count), (item, row, item), writeable=False
    )


def product(
    windows: NDArray[np.float64],
    table: NDArray[np.float64],
    out: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """``out[c, k, m] = sum_r windows[r, c, k] table[r, m]``, in chunks where there is much."""
    size, _, count = windows.shape
    # Rows of a copy are runs of the windows: sixty times less to read than to multiply.
    if out is None:
        if count * table.shape[1] <= _WHOLE:
            return (windows.reshape(size, -1).T @ table).reshape(2, count, -1)
        out = np.empty((2, count, table.shape[1]))
    held = np.empty((size, 2, min(count, _CHUNK)))
    for begin in range(0, count, _CHUNK):
        part = windows[:, :, begin : begin + _CHUNK]
        factor = held[:, :, : part.shape[2]]
        np.copyto(factor, part)
        np.matmul(factor.transpose(1, 2, 0), table, out=out[:, begin : begin + _CHUNK])
    return out


def scattered(
    windows: NDArray[np.float64],
    table: NDArray[np.float64],
    places: NDArray[np.intp],
    columns: NDArray[np.intp],
) -> NDArray[np.float64]:
    """``out[c, i] = sum_r windows[r, c, places[i]] table[r, columns[i]]``.

    Each takes as long as twenty entries of a `product`. Indices within the arrays are expected.
    """
    if len(places) <= _SEVERAL:
        out: NDArray[np.float64]
        out = np.einsum("rci,ri->ci", windows[:, :, places], table[:, columns])
        return out
    out = np.zeros((2, len(places)))
    weight, part = np.empty((2, len(places)))
    for window, row in zip(windows, table, strict=True):
        row.take(columns, out=weight, mode="clip")
        for coordinate, total in zip(window, out, strict=True):
            coordinate.take(places, out=part, mode="clip")
            part *= weight
            total += part
    return out


def running_max(values: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Largest of each ``size`` consecutive entries of the last axis, by doubling."""
    reach = 1
    while reach < size:
        step = min(reach, size - reach)
        values = np.maximum(values[..., :-step], values[..., step:])
        reach += step
    return values


def maxima_between(
    values: NDArray[np.float64], first: NDArray[np.intp], last: NDArray[np.intp]
) -> NDArray[np.float64]:
    """``out[r, i] = max(values[r, first[i] : last[i] + 1])``, soon if these are one or two."""
    found = np.empty((len(values), len(first)))
    longer = np.flatnonzero(last - first > 1)
    ends = np.stack([first[longer], last[longer]], axis=1).ravel()
    for row, out in zip(values, found, strict=True):
        row.take(first, mode="clip", out=out)
        np.maximum(out, row.take(last, mode="clip"), out=out)
        if len(longer):
            out[longer] = np.maximum(out[longer], np.maximum.reduceat(row, ends)[::2])
    return found
