"""The step response and its overshoot (theory, section 9)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from core.basis import BasicLimitFunction
from core.mask import Mask

SAMPLE_LEVEL = 10
"""Dyadic level of the sampled step response: the maximum is met to within some 1e-7."""


@dataclass(frozen=True)
class StepResponse:
    """The limit of the data 1 for ``i <= 0`` and 0 for ``i > 0``: ``S(t) = sum_{i<=0} phi(t-i)``.

    Parameters
    ----------
    mask
        The scheme.
    """

    mask: Mask

    def values(self, level: int) -> NDArray[np.float64]:
        """Values of S at the parameters of `BasicLimitFunction.parameters`; outside it is 1 or 0.

        S(t) sums phi over all points to the right of t that lie a whole number of spans away, so
        it falls from 1 at the left end of the support to 0 at the right end.
        """
        phi = BasicLimitFunction(self.mask).values(level)
        period = 2**level
        padding = -len(phi) % period
        spans = np.concatenate([phi, np.zeros(padding)]).reshape(-1, period)
        sums = np.cumsum(spans[::-1], axis=0)[::-1]
        return sums.reshape(-1)[: len(phi)]

    @cached_property
    def _sampled(self) -> NDArray[np.float64]:
        return self.values(SAMPLE_LEVEL)

    @property
    def overshoot(self) -> float:
        """``max S - 1`` over the dyadic points of `SAMPLE_LEVEL`, at least 0.

        Each sample is exact up to rounding; between the samples S can be higher by some 1e-7.
        """
        return max(float(self._sampled.max()) - 1.0, 0.0)

    @property
    def undershoot(self) -> float:
        """``-min S`` over the dyadic points of `SAMPLE_LEVEL`, at least 0; see `overshoot`."""
        return max(-float(self._sampled.min()), 0.0)
