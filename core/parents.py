"""The two parent schemes, derived exactly from their definitions (theory, section 2)."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import comb, prod

from core.mask import Mask, Stencil

_REACH = 3
"""A 7-point rule reads the control points at offsets -3..3."""


def _lagrange_stencil(position: Fraction) -> Stencil:
    """Weights that evaluate the interpolation polynomial through -3..3 at ``position``."""
    nodes = range(-_REACH, _REACH + 1)
    above, below = position.numerator, position.denominator
    weights = []
    for node in nodes:
        others = [other for other in nodes if other != node]
        # The product of (position - other) / (node - other), reduced once.
        weights.append(
            Fraction(
                prod(above - below * other for other in others),
                prod(below * (node - other) for other in others),
            )
        )
    return Stencil(-_REACH, tuple(weights))


@cache
def lagrange() -> Mask:
    """Mask of the 7-point Lagrange scheme Q (paper, eq. a1).

    The new points are values, at -1/4 (even rule) and 1/4 (odd rule), of the polynomial of degree
    6 that interpolates seven neighbours. The scheme is dual and approximating: it reproduces
    polynomials of degree 6, and it is C^2.
    """
    quarter = Fraction(1, 4)
    return Mask.from_stencils(_lagrange_stencil(-quarter), _lagrange_stencil(quarter))


@cache
def bspline() -> Mask:
    """Mask of the 7-point B-spline scheme R (paper, eq. a2): symbol ``z^-6 (1+z)^13 / 2^12``.

    Its limit curves are the uniform B-spline curves of degree 12.
    """
    degree = 12
    coefficients = tuple(Fraction(comb(degree + 1, i), 2**degree) for i in range(degree + 2))
    return Mask(-degree // 2, coefficients)
