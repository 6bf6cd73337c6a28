"""The response to a jump and to a kink: overshoot, ringing, zeta test (theory, section 9).

References
----------
Amat et al., as cited by the paper for Theorem 2.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY, BasicLimitFunction
from core.cells import Cells, Interval, excess
from core.mask import Mask

SAMPLE_LEVEL: Final = 10
"""Dyadic level of the sampled step response: smooth maxima are met to within some 1e-7."""

RINGING: Final = 1e-3
"""Deviation from 1 or 0 that counts as ringing."""

ZETA_ITERATIONS: Final = 6
"""Largest k for which the zeta criterion is evaluated."""


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

        Each sample is exact up to rounding; `step_gibbs` bounds what lies between them.
        """
        return max(float(self._sampled.max()) - 1.0, 0.0)

    @property
    def undershoot(self) -> float:
        """``-min S`` over the dyadic points of `SAMPLE_LEVEL`, at least 0; see `overshoot`."""
        return max(-float(self._sampled.min()), 0.0)

    @property
    def ringing_length(self) -> float:
        """Distance from the jump beyond which S stays within `RINGING` of 1 and 0, in spans.

        Read off the samples; the jump lies at t = 1/2.
        """
        t = BasicLimitFunction(self.mask).parameters(SAMPLE_LEVEL)
        away = np.where(t < 1 / 2, np.abs(self._sampled - 1), np.abs(self._sampled))
        return float(np.abs(t - 1 / 2)[away > RINGING].max(initial=0.0))


@dataclass(frozen=True)
class Gibbs:
    """How far the response to a jump or a kink leaves the data, as proven intervals.

    Attributes
    ----------
    overshoot
        Interval of the largest excess above the data; for the step, of ``max S - 1``.
    undershoot
        Interval of the largest excess below the data; for the step, of ``-min S``.
    """

    overshoot: Interval
    undershoot: Interval


@dataclass(frozen=True)
class Violation:
    """A negative partial sum of Theorem 2.2: ``zeta_residue^[iterations](index) = value < 0``."""

    iterations: int
    residue: int
    index: int
    value: Fraction


@lru_cache(maxsize=MEMORY)
def falls_monotonically(mask: Mask) -> bool:
    """Whether the step response is proven to fall all the way, so that it cannot overshoot.

    S falls if the scheme for differences, ``a(z) / (1+z)``, has no negative coefficient. That is
    sufficient, not necessary.
    """
    return all(n >= 0 for n in mask.divided().numerators)


@lru_cache(maxsize=MEMORY)
def step_gibbs(mask: Mask) -> Gibbs:
    """Overshoot and undershoot of the step response; both zero where `falls_monotonically`.

    Intervals are at most `core.cells.WIDTH` wide for convergent schemes of moderate roughness; the
    upper end is infinite where the scheme is not seen to converge.
    """
    if falls_monotonically(mask):
        return Gibbs(Interval(0.0, 0.0), Interval(0.0, 0.0))
    step = np.where(_places(mask) <= 0, 1.0, 0.0)
    return Gibbs(*excess(Cells(mask, step), 0.0, 1.0))


@lru_cache(maxsize=MEMORY)
def ramp_gibbs(mask: Mask) -> Gibbs:
    """Excess of the response to the ramp ``p_i = max(i - 1/2, 0)`` above and below the ramp.

    Above it is what the scheme cuts off the kink at t = 1/2; below it is overshoot, zero for
    schemes that never leave the hull of their points. Linear data are reproduced, so the ramp's
    own side is subtracted from the data of each cell.
    """
    places = _places(mask)
    ramp = np.maximum(places - 0.5, 0.0)
    cell = np.arange(mask.start, mask.end + 1)[:, None]
    rest = ramp - np.where(cell <= 0, 0.0, places - 0.5)
    above, below = excess(Cells(mask, rest))
    return Gibbs(above, Interval(0.0, 0.0) if falls_monotonically(mask) else below)


def _places(mask: Mask) -> NDArray[np.float64]:
    """Indices i of the control points that the cells j = start..end read, one row a cell."""
    cell = np.arange(mask.start, mask.end + 1, dtype=np.float64)
    return cell[:, None] - mask.end + 1 + np.arange(mask.end - mask.start, dtype=np.float64)


@lru_cache(maxsize=MEMORY)
def zeta_violation(mask: Mask, iterations: int = ZETA_ITERATIONS) -> Violation | None:
    """First negative partial sum of Theorem 2.2 for k = 1..iterations, or None if there is none.

    ``zeta_l^[k](i)`` sums the k-fold mask over ``2^k tau + l``, tau <= i for i < 0 and tau >= i for
    i > 0; exact. The theorem asks for all k, so None is no proof that there is no Gibbs effect.
    """
    folded = Mask(0, (Fraction(1),))
    for k in range(1, iterations + 1):
        spread = {2 * i: c for i, c in folded.items()}
        folded = Mask.from_mapping(spread) * mask
        period = 2**k
        for residue in range(period):
            taus = range((folded.start - residue) // period, (folded.end - residue) // period + 1)
            coefficients = {tau: folded[period * tau + residue] for tau in taus}
            for index, value in _partial_sums(coefficients):
                if value < 0:
                    return Violation(k, residue, index, value)
    return None


def _partial_sums(coefficients: dict[int, Fraction]) -> list[tuple[int, Fraction]]:
    """Sums up to each index below 0, and from each index above 0, by rising index."""
    sums = []
    total = Fraction(0)
    for tau in sorted(tau for tau in coefficients if tau < 0):
        total += coefficients[tau]
        sums.append((tau, total))
    above = []
    total = Fraction(0)
    for tau in sorted((tau for tau in coefficients if tau > 0), reverse=True):
        total += coefficients[tau]
        above.append((tau, total))
    return sums + above[::-1]
