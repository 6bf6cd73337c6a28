"""What the basic limit function looks like: height, depth, negative lobes, integral."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Final

import numpy as np

from core.basis import MEMORY, BasicLimitFunction
from core.cells import Cells, Interval, excess
from core.mask import Mask

_SAMPLE_LEVEL: Final = 8
"""Dyadic level at which the signs of phi are read off: a lobe narrower than 1/256 can be missed."""

_ZERO: Final = 1e-12
"""Sampled values smaller than this have no sign: rounding."""


@dataclass(frozen=True)
class Profile:
    """Shape of phi.

    Attributes
    ----------
    height
        Proven interval of ``max phi``.
    depth
        Proven interval of ``-min phi``; ``Interval(0, 0)`` where phi is proven non-negative.
    negative_lobes
        Intervals of t in which phi is negative, from left to right, read off samples.
    integral
        ``integral phi dt``, exact: the sum over the integers, since all shifts of phi sum to 1.
    """

    height: Interval
    depth: Interval
    negative_lobes: tuple[tuple[float, float], ...]
    integral: Fraction


@lru_cache(maxsize=MEMORY)
def profile(mask: Mask) -> Profile:
    """Profile of the basic limit function.

    A mask without negative coefficients gives a function without negative values; otherwise the
    depth is enclosed, and an interval that begins at 0 proves no sign.

    Raises
    ------
    NoLimitError
        If the scheme has no unique limit.
    """
    phi = BasicLimitFunction(mask)
    # Cell j reads p_i, i = j - end + 1 .. j - start: the datum 1 at i = 0 stands at end - 1 - j.
    impulse = np.eye(mask.end - mask.start)
    height, depth = excess(Cells(mask, impulse))
    if all(n >= 0 for n in mask.numerators):
        depth = Interval(0.0, 0.0)
    return Profile(
        height,
        depth,
        _negative_lobes(phi),
        sum(phi.integer_values.values(), Fraction(0)),
    )


def _negative_lobes(phi: BasicLimitFunction) -> tuple[tuple[float, float], ...]:
    """Runs of negative samples; they end halfway to the next sample."""
    t = phi.parameters(_SAMPLE_LEVEL)
    negative = phi.values(_SAMPLE_LEVEL) < -_ZERO
    changes = np.flatnonzero(np.diff(negative.astype(int)))
    middles = (t[changes] + t[changes + 1]) / 2
    return tuple(
        (float(left), float(right)) for left, right in zip(middles[::2], middles[1::2], strict=True)
    )
