"""Slow textbook routines in exact fractions: what the fast ones are compared with."""

from fractions import Fraction
from math import comb, factorial

from hypothesis import strategies as st

from core.family import Parameters


def refined(points, mask):
    """One refinement of the bi-infinite data ``points: {index: value}``, by the definition."""
    new = {}
    for j, value in points.items():
        for i, a in mask.items():
            new[2 * j + i] = new.get(2 * j + i, Fraction(0)) + a * value
    return new


def refined_closed(points, mask):
    """One refinement of a closed polygon: ``P_m = sum_j a_{m-2j} p_{j mod n}``."""
    count = len(points)
    new = [Fraction(0)] * (2 * count)
    for m in range(2 * count):
        for j in range((m - mask.end) // 2, (m - mask.start) // 2 + 1):
            new[m] += mask[m - 2 * j] * points[j % count]
    return new


def bspline_value(degree, x):
    """Uniform B-spline of a degree with the knots 0..degree+1, by truncated powers."""
    total = sum(
        (-1) ** k * comb(degree + 1, k) * max(x - k, Fraction(0)) ** degree
        for k in range(degree + 2)
    )
    return total / factorial(degree)


def step_value(phi, x):
    """Exact step response at a dyadic x of the symbol: ``sum_{i<=0} phi(x - i)``."""
    width = phi.mask.end - phi.mask.start
    return sum((phi.at(x + j) for j in range(width + 1)), Fraction(0))


def reproduces(mask, degree):
    """Whether data of a polynomial go over into finer data of the same polynomial, exactly."""
    for parity, position in ((0, Fraction(-1, 4)), (1, Fraction(1, 4))):
        stencil = mask.stencil(parity)
        for power in range(degree + 1):
            new = sum((w * Fraction(j) ** power for j, w in stencil.items()), Fraction(0))
            if new != position**power:
                return False
    return True


def fractions(size=2, denominator=48):
    """Exact parameters of moderate size."""
    return st.fractions(-size, size, max_denominator=denominator)


def members(neighbours=("translated", "mirrored")):
    """Any member of the family."""
    return st.builds(Parameters, fractions(), fractions(), fractions(), st.sampled_from(neighbours))


def convergent_members(neighbours=("translated", "mirrored")):
    """Members close to the presets, which converge."""
    small = st.fractions(Fraction(-1, 3), Fraction(1, 3), max_denominator=48)
    beta = st.fractions(-1, 0, max_denominator=48)
    return st.builds(Parameters, small, beta, small, st.sampled_from(neighbours))
