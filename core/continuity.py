"""The continuity class that Theorem 2.1 of the paper certifies (theory, section 8).

References
----------
Dyn, Levin: Subdivision schemes in geometric modelling, Acta Numerica 11 (2002), section 4.
Shi et al., as cited by the paper for Theorem 2.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY
from core.folding import folded, norm
from core.hoelder import (
    HoelderInterval,
    exact_interval,
    first_interval,
    quick_interval,
)
from core.mask import Mask
from core.polytope import Cancelled, never
from core.radius import rho_floor

MAX_ITERATIONS: Final = 10
"""Largest L that is tried. The masks of the L-fold scheme double in length with each step."""

_UNDECIDED: Final = 1e-9
"""Distance of a floating-point norm from 1 below which the exact norm decides, at least."""


@dataclass(frozen=True)
class Certificate:
    """Proof that a scheme is C^order: ``||b^[iterations]|| = norm < 1`` for ``order``.

    Attributes
    ----------
    order
        Largest n that Theorem 2.1 certifies within `MAX_ITERATIONS`, or None if not even C^0 is.
    iterations
        Smallest L with a norm below 1, or None.
    norm
        The norm at that L: a fraction when computed exactly, else a float; None without a proof.
    """

    order: int | None
    iterations: int | None
    norm: Fraction | float | None


def derived(mask: Mask, order: int) -> Mask:
    """Factor b of ``a(z) = (1+z)^(order+1) / 2^order b(z)`` (paper, Theorem 2.1).

    Raises
    ------
    ArithmeticError
        If ``(1+z)^(order+1)`` does not divide the symbol.
    """
    return mask.divided(order + 1).scaled(Fraction(2) ** order)


def iterated_norm(b: Mask, iterations: int) -> Fraction:
    """Exact norm ``||b^[L]|| = max_i sum_j |b^[L]_{i - 2^L j}|``, 0 <= i < 2^L.

    ``b^[L](z) = b(z) b(z^2) ... b(z^(2^(L-1)))``; computed in integers over one denominator.
    """
    iterated = [1]
    for _ in range(iterations):
        longer = [0] * (2 * len(iterated) - 2 + len(b.numerators))
        for k, value in enumerate(iterated):
            for i, c in enumerate(b.numerators):
                longer[2 * k + i] += value * c
        iterated = longer
    period = 2**iterations
    sums = [0] * period
    for k, value in enumerate(iterated):
        sums[k % period] += abs(value)
    return Fraction(max(sums), b.denominator**iterations)


def certificate(mask: Mask, exact: bool = False) -> Certificate:
    """Largest class C^n that Theorem 2.1 proves with L up to `MAX_ITERATIONS`.

    Parameters
    ----------
    mask
        A mask whose rules sum to 1.
    exact
        Whether the norm is returned as an exact fraction, for a final proof. The class and L are
        the same in both ways: a norm that floats cannot tell from 1 is computed exactly.

    Returns
    -------
    Certificate
        A proof, or ``order`` None: the theorem is sufficient only, so that is no disproof.
    """
    found = _certificate(mask)
    if not exact or found.order is None or found.iterations is None:
        return found
    exactly = iterated_norm(derived(mask, found.order), found.iterations)
    return Certificate(found.order, found.iterations, exactly)


@lru_cache(maxsize=MEMORY)
def _certificate(mask: Mask) -> Certificate:
    multiplicity, _ = mask.factored()
    # b of a lower order has the factors (1+z)/2 more: eigenvalues of its matrices are those of the
    # last b, halved each time. Norms are never below them, so orders whose own is 1 or more need no
    # trial: all that are not below the exponent that the eigenvalue bounds.
    exponent = multiplicity - 1 - float(np.log2(rho_floor(mask)))
    highest = min(multiplicity - 1, ceil(exponent) - 1)
    for order in range(highest, -1, -1):
        b = derived(mask, order)
        for iterations, (size, error) in enumerate(_float_norms(b.values), start=1):
            if size - error >= 1:
                continue
            if size + error < 1:
                return Certificate(order, iterations, size)
            exact = iterated_norm(b, iterations)
            if exact < 1:
                return Certificate(order, iterations, float(exact))
    return Certificate(None, None, None)


class Convergence(Enum):
    """What is known of the convergence of a scheme to continuous curves."""

    PROVEN = "proven"
    DISPROVEN = "disproven"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Smoothness:
    """All that is proven of the class of a scheme.

    Attributes
    ----------
    certificate
        What Theorem 2.1 gives.
    exponent
        Interval of the Hölder exponent.
    not_class
        Smallest n for which it is proven that the limits are not C^n in general.
    """

    certificate: Certificate
    exponent: HoelderInterval
    not_class: int

    @property
    def order(self) -> int | None:
        """Largest n with C^n proven: by Theorem 2.1, or by an exponent above n; None without."""
        by_exponent = ceil(self.exponent.lower) - 1
        by_theorem = -1 if self.certificate.order is None else self.certificate.order
        order = max(by_exponent, by_theorem)
        return order if order >= 0 else None

    @property
    def convergence(self) -> Convergence:
        """Whether the scheme converges to continuous curves."""
        if self.order is not None:
            return Convergence.PROVEN
        return Convergence.DISPROVEN if self.not_class == 0 else Convergence.UNDECIDED


class Effort(Enum):
    """How long the Hölder exponent is looked for; the interval is proven in any case."""

    GLANCE = "some 2 ms: within the frame of a slider's move"
    QUICK = "some 5 ms, up to 30"
    FULL = "some 50 ms, up to 3 s: as far as it goes"


def smoothness(
    mask: Mask, effort: Effort = Effort.QUICK, cancelled: Cancelled = never
) -> Smoothness:
    """Class of a scheme from both sides: proven, and proven not (theory, section 8).

    A scheme with an exponent of at most n is not C^n, except that limits of an exponent n may
    still be; an exponent of at most 0 means that the scheme does not converge to continuous
    curves. A symbol ``(1+z)^m`` up to a factor gives splines of degree m - 1, which are C^(m-2)
    and no more.

    Parameters
    ----------
    mask
        A mask whose rules sum to 1.
    effort
        How far the exponent is narrowed.
    cancelled
        Asked now and then; True ends the narrowing of `Effort.FULL`.
    """
    if effort is Effort.GLANCE:
        exponent = first_interval(mask)
    elif effort is Effort.QUICK:
        exponent = quick_interval(mask)
    else:
        exponent = exact_interval(mask, cancelled)
    multiplicity, quotient = mask.factored()
    if len(quotient.numerators) == 1:
        not_class = multiplicity - 1
    elif exponent.upper <= 0:
        not_class = 0
    else:
        not_class = floor(exponent.upper) + 1
    return Smoothness(certificate(mask), exponent, not_class)


def _float_norms(step: NDArray[np.float64]) -> Iterator[tuple[float, float]]:
    """Norms for L = 1, 2, ..., each with a bound of its rounding error.

    Each coefficient of the L-fold mask is a sum of at most len(step)^L products of L factors. Its
    rounding, doubled for the rounding of the coefficients of b themselves, is below
    ``2 L (len(step) + 1) eps`` times the same sum of absolute values, whose norm is at most
    ``||b||^L``.
    """
    eps = float(np.finfo(np.float64).eps)
    single = norm(step, 1)
    mask = step
    for iterations in range(1, MAX_ITERATIONS + 1):
        error = 2 * iterations * (len(step) + 1) * eps * single**iterations
        yield norm(mask, iterations), max(error, _UNDECIDED)
        mask = folded(mask, step)
