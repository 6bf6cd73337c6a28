"""Text of many decimal numbers at once: from arrays to bytes, without a loop over the numbers.

Numbers are made integers, scaled by a power of ten. Four digits at a time come from a table of ten
thousand texts, into a matrix of bytes whose rows have one width; what is not needed, zeros before
and after a number among it, is a zero byte there, and all of these are taken out at the end.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

LARGEST: Final = 2**51
"""Size that scaled numbers stay below. A decimal number as a float, times its power of ten, is off
by two roundings, a share of 2^-52 together: up to here by less than a half."""

_GROUP: Final = 4
"""Digits that are looked up together."""

_BASE: Final = 10**_GROUP

_ROWS: Final = 2**14
"""Rows that are made at a time: their matrix fits the processor's cache."""


def rounded(values: NDArray[np.float64], places: int) -> NDArray[np.float64]:
    """The numbers with ``places`` decimals: the floats that their texts are read back as.

    A whole number divided by a power of ten up to 10^22 is rounded once, as a reader rounds the
    decimal number. Times ``10^places`` the numbers must be at most `LARGEST` in size.
    """
    return np.asarray(np.rint(values * 10.0**places) / 10.0**places + 0.0)


def most_places(largest: float) -> int:
    """Largest number of decimals with which numbers up to ``largest`` can be written."""
    return math.floor(math.log10(LARGEST / max(largest, 1.0)))


def text(
    between: tuple[bytes, ...],
    values: NDArray[np.float64],
    places: tuple[int, ...],
    least: int = 0,
) -> bytes:
    """Text of rows of numbers.

    Parameters
    ----------
    between
        What stands before, between, and after the k numbers of a row: k + 1 texts without zero
        bytes.
    values
        Numbers, shape (n, k); times ``10^places`` at most `LARGEST` in size.
    places
        Number of decimals of each column; numbers are rounded to them.
    least
        Decimals that are written even if they are zero, 0 or 1; zeros beyond are left out, and
        so is a point with nothing behind it.

    Returns
    -------
    bytes
        The rows one after the other.
    """
    if not len(values):
        return b""
    factors = 10.0 ** np.array(places)
    # Column by column: NumPy is ten times slower along the short axis.
    largest = [float(max(column.max(), -column.min())) for column in values.T]
    layout = _Layout(between, np.rint(largest * factors).tolist(), places, least)
    parts = []
    for first in range(0, len(values), _ROWS):
        block = np.rint(values[first : first + _ROWS] * factors)
        parts.append(layout.filled(block.astype(np.int64)))
    return b"".join(parts)


def word(value: float, places: int) -> str:
    """Text of one number with at most ``places`` decimals."""
    return text((b"", b""), np.array([[value]]), (places,)).decode()


class _Layout:
    """Columns of the matrix of a row."""

    def __init__(
        self, between: tuple[bytes, ...], largest: list[float], places: tuple[int, ...], least: int
    ) -> None:
        self.least = least
        self.columns: list[tuple[int, int, int, int]] = []
        row = bytearray(between[0])
        for size, decimals, after in zip(largest, places, between[1:], strict=True):
            whole = -(-len(str(int(size) // 10**decimals)) // _GROUP)
            part = -(-decimals // _GROUP)
            self.columns.append((len(row), whole, part, decimals))
            row += bytes(1 + _GROUP * whole + (part > 0) + _GROUP * part)
            row += after
        self.row = np.frombuffer(bytes(row), dtype=np.uint8)

    def filled(self, numbers: NDArray[np.int64]) -> bytes:
        """Text of some rows."""
        matrix = np.empty((len(numbers), len(self.row)), dtype=np.uint8)
        matrix[:] = self.row
        for values, (place, whole, part, decimals) in zip(numbers.T, self.columns, strict=True):
            sizes = np.abs(values)
            if decimals:
                high, low = np.divmod(sizes, 10**decimals)
            else:
                high, low = sizes, sizes
            matrix[:, place] = (values < 0) * np.uint8(ord("-"))
            place += 1
            for k in reversed(range(whole)):
                above, group = np.divmod(high, _BASE) if k else (0, high)
                index = group + _BASE * (np.equal(above, 0) * (1 + (k == whole - 1)))
                _put(matrix, place + _GROUP * k, _leading()[index])
                high = np.asarray(above)
            place += _GROUP * whole
            if not part:
                continue
            if self.least:
                matrix[:, place] = ord(".")
            else:
                matrix[:, place] = (low > 0) * np.uint8(ord("."))
            place += 1
            low = low * 10 ** (_GROUP * part - decimals)
            for k in reversed(range(part)):
                rest, group = np.divmod(low, _BASE) if k else (None, low)
                if k == part - 1:
                    ends = np.ones(len(group), dtype=bool)
                keeps = 1 + (self.least > 0 and k == 0)
                _put(matrix, place + _GROUP * k, _trailing()[group + _BASE * (ends * keeps)])
                if rest is not None:
                    ends &= group == 0
                    low = rest
        return matrix.tobytes().translate(None, b"\0")


def _put(matrix: NDArray[np.uint8], place: int, groups: NDArray[np.uint32]) -> None:
    """Write four bytes into each row: as one number, which is faster than as four."""
    column = np.ndarray(
        (len(matrix),), np.uint32, matrix.data, offset=place, strides=(matrix.strides[0],)
    )
    column[:] = groups


@cache
def _leading() -> NDArray[np.uint32]:
    """Texts of groups: all digits; none of the zeros before; none but the last digit of 0."""
    full = [f"{n:04d}" for n in range(_BASE)]
    bare = [text.lstrip("0").rjust(_GROUP, "\0") for text in full]
    return _packed([*full, *bare, "\0\0\x000", *bare[1:]])


@cache
def _trailing() -> NDArray[np.uint32]:
    """Texts of groups: all digits; none of the zeros behind; none but the first digit of 0."""
    full = [f"{n:04d}" for n in range(_BASE)]
    bare = [text.rstrip("0").ljust(_GROUP, "\0") for text in full]
    return _packed([*full, *bare, "0\0\0\0", *bare[1:]])


def _packed(texts: list[str]) -> NDArray[np.uint32]:
    return np.frombuffer("".join(texts).encode(), dtype=np.uint32).copy()
