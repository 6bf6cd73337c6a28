"""Maps over planes of the parameter space: class, Hölder lower bound, overshoot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.continuity import certificate
from core.family import Neighbours, Parameters, Scalar, exact
from core.hoelder import branch_and_bound
from core.mask import Mask

MAP_ITERATIONS: Final = 6
"""Largest L of the norms in a map; `core.continuity` goes on to 10 for a single member."""

BLOCK_ROWS: Final = 8
"""Rows of a map that are computed at a time, and can be shown at once."""

_STEP_LEVEL: Final = 4
"""Dyadic level of the step responses in a map: overshoot to within some 1e-3 of its size."""


_UNDECIDED: Final = 1e-9
"""Distance of a norm from 1 at which the map does not claim the class."""

_TRIED_ABOVE: Final = 0.3
"""How far above the estimated exponent a class is still tried."""


class Quantity(Enum):
    """What a map shows."""

    CLASS = "class"
    HOELDER = "hoelder"
    OVERSHOOT = "overshoot"


@dataclass(frozen=True)
class Plane:
    """A rectangle in the parameter space.

    Attributes
    ----------
    origin
        Parameters at (u, v) = (0, 0); exact.
    u_axis, v_axis
        Change of (alpha, beta, gamma) per unit of u and v.
    u_range, v_range
        First and last value of u and v.
    neighbours
        Which reading of the family.
    """

    origin: tuple[Fraction, Fraction, Fraction]
    u_axis: tuple[int, int, int]
    v_axis: tuple[int, int, int]
    u_range: tuple[Fraction, Fraction]
    v_range: tuple[Fraction, Fraction]
    neighbours: Neighbours = "translated"

    @classmethod
    def of_axes(cls, first: str, second: str, through: Parameters, reach: Scalar = 1) -> Plane:
        """Plane of two parameters, from -reach to reach, the third as in ``through``."""
        names = ("alpha", "beta", "gamma")
        origin = [getattr(through, n) if n not in (first, second) else Fraction(0) for n in names]
        size = exact(reach, "reach")
        return cls(
            (origin[0], origin[1], origin[2]),
            _unit(first),
            _unit(second),
            (-size, size),
            (-size, size),
            through.neighbours,
        )

    @classmethod
    def symmetric(cls, reach: Scalar = 1) -> Plane:
        """Plane alpha = gamma: u is both of them, v is beta."""
        size, zero = exact(reach, "reach"), Fraction(0)
        return cls((zero, zero, zero), (1, 0, 1), (0, 1, 0), (-size, size), (-size, size))

    @classmethod
    def of_sum(cls, total: Scalar, reach: Scalar = 1) -> Plane:
        """Plane alpha + beta + gamma = total: u is alpha, v is gamma."""
        size, zero = exact(reach, "reach"), Fraction(0)
        origin = (zero, exact(total, "total"), zero)
        return cls(origin, (1, -1, 0), (0, -1, 1), (-size, size), (-size, size))

    def member(self, u: Fraction, v: Fraction) -> Parameters:
        """The member at a place of the plane."""
        alpha, beta, gamma = (
            o + a * u + b * v for o, a, b in zip(self.origin, self.u_axis, self.v_axis, strict=True)
        )
        return Parameters(alpha, beta, gamma, self.neighbours)

    def places(self, size: int) -> tuple[list[Fraction], list[Fraction]]:
        """``size`` evenly spaced values of u and of v, exact."""

        def spaced(ends: tuple[Fraction, Fraction]) -> list[Fraction]:
            return [ends[0] + (ends[1] - ends[0]) * k / (size - 1) for k in range(size)]

        return spaced(self.u_range), spaced(self.v_range)


def parameter_map(
    plane: Plane, quantity: Quantity, size: int = 101
) -> Iterator[tuple[slice, NDArray[np.float64]]]:
    """Values of a quantity over a plane, in blocks of rows.

    The masks are affine in the parameters, so that all members of a block are treated by the same
    few array operations. Leaving the iteration ends the work.

    Parameters
    ----------
    plane
        Where.
    quantity
        CLASS: the largest n certified by Theorem 2.1 with L up to `MAP_ITERATIONS`, -1 without a
        certificate; at most the class of `core.continuity.certificate`. HOELDER: the lower bound
        that the same norms give, at least -1. OVERSHOOT: of the step response, at dyadic points of
        a coarse level; nan where there is no limit.
    size
        Number of values of u and of v, at least 2.

    Yields
    ------
    rows, values
        A slice of v and the values, shape (rows, size): ``values[i, j]`` belongs to the i-th v of
        the slice and the j-th u.
    """
    us, vs = plane.places(size)
    for first in range(0, size, BLOCK_ROWS):
        rows = slice(first, min(first + BLOCK_ROWS, size))
        u, v = np.meshgrid(np.array([float(x) for x in us]), np.array([float(x) for x in vs[rows]]))
        masks = _Masks.over(plane, u.ravel(), v.ravel())
        if quantity is Quantity.OVERSHOOT:
            values = masks.overshoots()
        else:
            classes, exponents = masks.norms()
            values = classes if quantity is Quantity.CLASS else exponents
        values = values.reshape(u.shape)
        if quantity is Quantity.CLASS:
            # Members with factors (1+z) to spare can do better than their plane: ask each of them.
            for i, j in np.argwhere(masks.have_more_factors().reshape(u.shape)):
                found = certificate(plane.member(us[j], vs[rows][i]).mask).order
                values[i, j] = values[i, j] if found is None else max(values[i, j], found)
        yield rows, values


def smoothest_beta(
    alpha: Scalar, beta_range: tuple[Scalar, Scalar] = (-2, 1), steps: int = 24
) -> tuple[float, float]:
    """Ridge of the map alpha = gamma: the beta with the largest Hölder exponent.

    Bounded optimisation by golden sections, from the best of ``steps`` + 1 evenly spaced values;
    the exponent is read as the upper end of the interval, which is the exact value wherever an
    invariant polytope closes.

    Parameters
    ----------
    alpha
        Value of alpha and gamma.
    beta_range
        Where to look.
    steps
        Number of intervals of the first scan.

    Returns
    -------
    beta, exponent
        The maximum found. The exponent is not unimodal in beta, so a narrow peak between the scan's
        values can be missed.
    """
    low, high = (float(exact(end, "beta")) for end in beta_range)

    def exponent(beta: float) -> float:
        mask = Parameters(alpha, Fraction(beta).limit_denominator(10**9), alpha).mask
        return branch_and_bound(mask, 1.0, 2_000).upper

    scan = np.linspace(low, high, steps + 1)
    best = int(np.argmax([exponent(float(beta)) for beta in scan]))
    left, right = float(scan[max(best - 1, 0)]), float(scan[min(best + 1, steps)])
    golden = (5**0.5 - 1) / 2
    inner = [right - golden * (right - left), left + golden * (right - left)]
    values = [exponent(beta) for beta in inner]
    for _ in range(40):
        if values[0] >= values[1]:
            right = inner[1]
            inner = [right - golden * (right - left), inner[0]]
            values = [exponent(inner[0]), values[0]]
        else:
            left = inner[0]
            inner = [inner[1], left + golden * (right - left)]
            values = [values[1], exponent(inner[1])]
    at_scan = (exponent(float(scan[best])), float(scan[best]))
    found, beta = max(at_scan, *zip(values, inner, strict=True))
    return beta, found


@dataclass(frozen=True, eq=False)
class _Masks:
    """Many masks of one support, with the factors (1+z) that all of them have.

    ``quotients[k]`` are the coefficients of ``a(z) / (1+z)^multiplicity`` of the k-th member.
    """

    multiplicity: int
    start: int
    masks: NDArray[np.float64]
    quotients: NDArray[np.float64]

    @classmethod
    def over(cls, plane: Plane, u: NDArray[np.float64], v: NDArray[np.float64]) -> _Masks:
        """Masks at many places of a plane, by their affine dependence on (u, v)."""
        zero, one = Fraction(0), Fraction(1)
        base = plane.member(zero, zero).mask
        u_part = plane.member(one, zero).mask - base
        v_part = plane.member(zero, one).mask - base
        parts = [part for part in (base, u_part, v_part) if part.numerators]
        multiplicity = min(part.factored()[0] for part in parts)
        start, end = min(p.start for p in parts), max(p.end for p in parts)

        def spread(part: Mask, last: int) -> NDArray[np.float64]:
            return np.array([float(part[i]) for i in range(start, last + 1)])

        def combined(divide: int) -> NDArray[np.float64]:
            last = end - divide
            rows = [spread(part.divided(divide), last) for part in (base, u_part, v_part)]
            return rows[0] + u[:, None] * rows[1] + v[:, None] * rows[2]

        return cls(multiplicity, start, combined(0), combined(multiplicity))

    def norms(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Class and Hölder lower bound from the norms of all iterations."""
        top = self.multiplicity - 1
        history = list(self._iterated_norms(self._derived(top)))
        exponents = np.max(
            [top - np.log2(norms) / (k + 1) for k, norms in enumerate(history)], axis=0
        )
        # The rate at which norms grow in the end estimates rho, so that classes far above the
        # exponent need no trial. A wrong estimate can only lower the class that is shown.
        rate = (history[-1] / history[-3]) ** (1 / 2)
        highest = np.ceil(top - np.log2(rate) + _TRIED_ABOVE) - 1
        classes = np.where(np.min(history, axis=0) < 1 - _UNDECIDED, float(top), -1.0)
        for order in range(top - 1, -1, -1):
            open_members = np.flatnonzero((classes < 0) & (highest >= order))
            for norms in self._iterated_norms(self._derived(order)[open_members]):
                classes[open_members[norms < 1 - _UNDECIDED]] = order
        return classes, np.maximum(exponents, -1.0)

    def have_more_factors(self) -> NDArray[np.bool_]:
        """Which members have a further factor (1+z), to rounding."""
        signs = np.where(np.arange(self.quotients.shape[1]) % 2, -1.0, 1.0)
        return np.asarray(np.abs(self.quotients @ signs) < 1e-12)

    def _iterated_norms(self, steps: NDArray[np.float64]) -> Iterator[NDArray[np.float64]]:
        """Norms of the iterated masks for L = 1 .. `MAP_ITERATIONS`, one value a row."""
        iterated = np.ones((len(steps), 1))
        for iterations in range(1, MAP_ITERATIONS + 1):
            iterated = _folded(iterated, steps)
            yield _norms(iterated, 2**iterations)

    def _derived(self, order: int) -> NDArray[np.float64]:
        """Coefficients of b for the class of an order, one row a member."""
        rows = self.quotients * 2.0**order
        for _ in range(self.multiplicity - 1 - order):
            rows = _folded_with_sum(rows)
        return rows

    def overshoots(self) -> NDArray[np.float64]:
        """``max S - 1`` over the dyadic points of `_STEP_LEVEL`, nan without a limit."""
        size = self.masks.shape[1]
        inner = np.arange(1, size - 1)
        index = 2 * inner[:, None] - inner[None, :]
        inside = (index >= 0) & (index < size)
        matrices = np.where(inside, self.masks[:, np.clip(index, 0, size - 1)], 0.0)
        matrices -= np.eye(len(inner))
        matrices[:, 0] = 1.0
        right = np.zeros((len(self.masks), len(inner), 1))
        right[:, 0] = 1.0
        singular = np.abs(np.linalg.det(matrices)) < 1e-14
        matrices[singular] = np.eye(len(inner))
        values = np.pad(np.linalg.solve(matrices, right)[:, :, 0], ((0, 0), (1, 1)))
        for level in range(_STEP_LEVEL):
            step = 2**level
            finer = np.zeros((len(values), 2 * (size - 1) * step + 1))
            for i in range(size):
                finer[:, i * step : i * step + values.shape[1]] += self.masks[:, i, None] * values
            values = finer
        period = 2**_STEP_LEVEL
        padded = np.pad(values, ((0, 0), (0, -values.shape[1] % period)))
        sums = padded.reshape(len(values), -1, period)[:, ::-1].cumsum(axis=1)
        found = np.maximum(sums.max(axis=(1, 2)) - 1, 0.0)
        found[singular] = np.nan
        return np.asarray(found)


def _unit(name: str) -> tuple[int, int, int]:
    return (int(name == "alpha"), int(name == "beta"), int(name == "gamma"))


def _folded(iterated: NDArray[np.float64], steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """One more factor: ``b^[L+1](z) = b^[L](z^2) b(z)``, row by row."""
    length, size = iterated.shape[1], steps.shape[1]
    result = np.zeros((len(iterated), 2 * length - 1 + size - 1))
    for i in range(size):
        result[:, i : i + 2 * length - 1 : 2] += steps[:, i, None] * iterated
    return result


def _folded_with_sum(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows times (1+z)."""
    return np.pad(rows, ((0, 0), (0, 1))) + np.pad(rows, ((0, 0), (1, 0)))


def _norms(iterated: NDArray[np.float64], period: int) -> NDArray[np.float64]:
    """Norms ``max_i sum_j |b_{i - period j}|``, row by row."""
    padded = np.pad(np.abs(iterated), ((0, 0), (0, -iterated.shape[1] % period)))
    rows = padded.shape[1] // period
    return np.asarray(padded.reshape(len(iterated), rows, period).sum(axis=1).max(axis=1))
