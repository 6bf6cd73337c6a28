"""Degrees of the polynomials that a scheme generates and reproduces (theory, section 5).

References
----------
Dyn, Hormann, Sabin, Shen: Polynomial reproduction by symmetric subdivision schemes,
J. Approx. Theory 155 (2008).
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

from core.basis import MEMORY
from core.mask import Mask

_POSITIONS = (Fraction(-1, 4), Fraction(1, 4))
"""Where the even and the odd rule of a dual scheme place the new point, relative to the old one."""


def generation_degree(mask: Mask) -> int:
    """Largest d such that all polynomials of degree d are limits of polynomial data.

    It is the multiplicity of (1+z) less 1; -1 if the rules do not even keep constants.
    """
    return mask.factored()[0] - 1


@lru_cache(maxsize=MEMORY)
def reproduction_degree(mask: Mask) -> int:
    """Largest d such that data of a polynomial of degree d lead to that very polynomial.

    Refining ``p(i)`` must give ``p`` at the new places: the moments of both stencils,
    ``sum_j e^r_j j^k``, equal ``(-1/4)^k`` and ``(1/4)^k`` for all k up to d; -1 if they do not
    even sum to 1. A 9-point rule cannot reproduce degree 9.
    """
    degree = 0
    while all(
        sum((w * Fraction(j) ** degree for j, w in mask.stencil(parity).items()), Fraction(0))
        == position**degree
        for parity, position in enumerate(_POSITIONS)
    ):
        degree += 1
    return degree - 1
