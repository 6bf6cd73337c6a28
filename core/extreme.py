"""Least and largest entries of short arrays.

NumPy's reductions take a microsecond before they look at the first number; to ask for the place of
an extreme, and for what is there, takes a third of it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def least(values: NDArray[np.generic]) -> Any:
    """Least entry of an array that has one, as a number of Python; nan if there is one."""
    return values.item(values.argmin())


def largest(values: NDArray[np.generic]) -> Any:
    """Largest entry of an array that has one, as a number of Python; nan if there is one."""
    return values.item(values.argmax())


def same(one: NDArray[np.generic], other: NDArray[np.generic]) -> bool:
    """Whether two arrays of one type have the same shape and the same bits."""
    return one is other or (one.shape == other.shape and one.tobytes() == other.tobytes())
