"""The Hölder exponent of the limit functions, as a proven interval (theory, section 8).

With m the full multiplicity of (1+z) and ``b = 2^(m-1) a / (1+z)^m``, the exponent is
``m - 1 - log2(rho)``; rho is the joint spectral radius of the two matrices
``(B_e)_{ij} = b_{2i-j+e}``.

Notes
-----
What is proven: every product of k matrices gives a lower bound of rho, its spectral radius to the
power 1/k; every norm gives upper bounds. The lower bound of the exponent follows from norms of
matrices, computed in floats and widened by `ROUNDING`. The upper bound follows from eigenvalues by
LAPACK, widened by `ROUNDING` and by the first-order condition number of the eigenvalue; that last
step is an estimate where the eigenvalue is nearly defective, and the only one that is not a proof.
That the exponent cannot be larger than the formula needs stable integer shifts of phi.

References
----------
Rioul: Simple regularity criteria for subdivision schemes, SIAM J. Math. Anal. 23 (1992).
Gripenberg: Computing the joint spectral radius, Linear Algebra Appl. 234 (1996).
Guglielmi, Protasov: Exact computation of joint spectral characteristics of linear operators,
Found. Comput. Math. 13 (2013).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY
from core.mask import Mask
from core.polytope import INSIDE, Cancelled, invariant_polytope, never
from core.radius import (
    ROUNDING,
    WORD_LENGTH,
    Radius,
    improved,
    matrices_of,
    mean_radii,
    radius_of,
    well_scaled,
)

QUICK_WIDTH: Final = 0.049
"""Width that is aimed at while a slider moves."""

_FIRST_NODES: Final = 3_000
"""Products of the first quick search, some 2 ms."""

_QUICK_NODES: Final = 15_000
"""Products after which the quick search states what it has, some 8 ms."""

_QUICK_SLACK: Final = 0.0335
"""Stretch of rho for a quick polytope: log2(1.0335) is below `QUICK_WIDTH`."""

_QUICK_VERTICES: Final = 60
"""Vertices at which a quick polytope is given up, some 10 ms."""

_QUICK_SIZE: Final = 10
"""Size of the matrices, that of 9-point members with seven factors, up to which one is tried."""

_QUICK_SEED_SIZE: Final = 0.2
"""Size of the unit vectors in the first quick polytope, next to the leading eigenvector."""

_TRIED_WORDS: Final = 3
"""Longer products tried at each length: those whose norms are the largest."""

_LONGEST_WORD: Final = 60
"""Longest products that are searched; their digits fit into an integer."""

_SLACKS: Final = ((0.0, 200), (1e-6, 300), (1e-4, 600), (6.5e-4, 1500))
"""Stretches of rho for which an invariant polytope is sought, and the vertices at which each is
given up; 30 to 100 are usual, and log2(1 + 6.5e-4) is below 0.001."""

_SEED_SIZE: Final = 0.02
"""Size of the unit vectors in the first polytope, next to the leading eigenvector."""


@dataclass(frozen=True)
class HoelderInterval:
    """Interval that contains the Hölder exponent.

    Attributes
    ----------
    lower, upper
        Ends of the interval; equal up to rounding where the exponent is known exactly.
    product
        Binary digits of the product of matrices that gives the upper end, such as "0" or "01";
        empty where no matrix is needed.
    """

    lower: float
    upper: float
    product: str

    @property
    def width(self) -> float:
        """Length of the interval."""
        return self.upper - self.lower

    @property
    def is_narrow(self) -> bool:
        """Whether its width is `QUICK_WIDTH` at most, which is aimed at while a hand moves."""
        return self.width <= QUICK_WIDTH + 1e-8  # the target and its rounding


def converge_throughout(corners: Sequence[Mask], max_nodes: int = 100_000) -> bool:
    """Whether all masks between some corners are proven to give convergent schemes.

    The masks of a box of parameters are affine in them, so their matrices lie in the convex hull
    of those of the corners. If the joint spectral radius of all these together, whatever corner
    each factor is taken from, is below ``2^(m-1)``, the Hölder exponent is above 0 everywhere in
    the box, with one proof.

    Parameters
    ----------
    corners
        Masks with common factors ``(1+z)^m``.
    max_nodes
        Products after which the search gives up.

    Returns
    -------
    bool
        True is a proof; False is none of the contrary.
    """
    multiplicity = min(mask.factored()[0] for mask in corners)
    start = min(mask.start for mask in corners)
    end = max(mask.end for mask in corners) - multiplicity
    quotients = [mask.divided(multiplicity) for mask in corners]
    coefficients = np.array([[float(q[i]) for i in range(start, end + 1)] for q in quotients])
    matrices = np.concatenate([matrices_of(row) for row in coefficients])
    # Relative to 2^(m-1): b carries that factor, and the radius shall stay below it.
    steps = well_scaled(matrices) * ROUNDING
    products = steps
    nodes = 0
    while len(products):
        nodes += len(products)
        products = products[_norms(products) >= 1]
        if nodes + len(steps) * len(products) > max_nodes:
            return False
        products = np.matmul(steps[:, None], products[None]).reshape(-1, *steps.shape[1:])
    return True


def first_interval(mask: Mask) -> HoelderInterval:
    """Hölder interval at a glance, some 2 ms: mostly of width `QUICK_WIDTH`, at times 0.2 wide."""
    return _searched(mask, QUICK_WIDTH, _FIRST_NODES)[0]


@lru_cache(maxsize=MEMORY)
def quick_interval(mask: Mask) -> HoelderInterval:
    """Hölder interval within a frame or two: width `QUICK_WIDTH` as a rule.

    Branch and bound is quickest where one product dominates; where two are nearly maximal no
    ellipsoid fits, and a coarse invariant polytope does.
    """
    found, radius = _searched(mask, QUICK_WIDTH, _FIRST_NODES)
    if found.is_narrow:
        return found
    if radius.matrices.shape[1] <= _QUICK_SIZE:
        rho = radius.value * (1 + _QUICK_SLACK)
        if _admits_polytope(radius, rho, _QUICK_SEED_SIZE, _QUICK_VERTICES, never):
            return _narrower(found, _interval(radius, rho * INSIDE * ROUNDING))
    return branch_and_bound(mask, QUICK_WIDTH, _QUICK_NODES)


def branch_and_bound(mask: Mask, width: float, max_nodes: int) -> HoelderInterval:
    """Hölder interval by Gripenberg's branch and bound.

    Parameters
    ----------
    mask
        Mask with at least one factor (1+z).
    width
        Width at which the search ends; greater than 0.
    max_nodes
        Number of products after which it ends in any case, with a valid, wider interval. More
        products never give a wider one.

    Returns
    -------
    HoelderInterval
        The proven interval.
    """
    return _searched(mask, width, max_nodes)[0]


@lru_cache(maxsize=MEMORY)
def _searched(mask: Mask, width: float, max_nodes: int) -> tuple[HoelderInterval, Radius]:
    """Branch and bound; also the matrices with the best product that was met on the way."""
    radius = radius_of(mask)
    if not radius.word:
        return _interval(radius, radius.lower), radius
    target = radius.lower * 2.0**width
    # Products are kept relative to the target, so that long ones neither grow nor vanish.
    steps = radius.matrices / target
    products, words = steps, np.array([0, 1])
    shortest = np.full(len(products), np.inf)
    length, nodes, bound = 1, 0, np.inf
    while True:
        nodes += len(products)
        shortest = np.minimum(shortest, _norms(products) ** (1 / length))
        # A product whose norm fell below 1 can be split off any longer one: it needs no children.
        alive = np.flatnonzero(shortest > 1)
        products, shortest = products[alive], shortest[alive]
        words = words[alive]
        bound = min(bound, target * max(float(shortest.max(initial=1.0)), 1.0))
        spent = nodes + 2 * len(products) > max_nodes or length == _LONGEST_WORD
        if spent or not len(products):
            return _interval(radius, bound * ROUNDING), radius
        if length > WORD_LENGTH:
            largest = np.argsort(-shortest)[:_TRIED_WORDS]
            means = target * mean_radii(products[largest], np.array(length))
            radius = improved(radius, [_digits(int(words[k]), length) for k in largest], means)
            shrink = target / (radius.lower * 2.0**width)
            target /= shrink
            steps = steps * shrink
            products = products * shrink**length
            shortest = shortest * shrink
        products = np.matmul(steps[:, None], products[None]).reshape(-1, *steps.shape[1:])
        words = np.concatenate([2 * words, 2 * words + 1])
        shortest = np.tile(shortest, 2)
        length += 1


def _interval(radius: Radius, rho: float) -> HoelderInterval:
    """Interval between an upper bound of rho and the best lower bound."""
    word = "".join(map(str, radius.word))
    return HoelderInterval(radius.exponent(rho), radius.exponent(radius.lower), word)


def _digits(code: int, length: int) -> tuple[int, ...]:
    """Binary digits of a word, the first one leading."""
    return tuple(code >> place & 1 for place in reversed(range(length)))


def exact_interval(mask: Mask, cancelled: Cancelled = never) -> HoelderInterval:
    """Hölder interval as narrow as it gets: at most 3e-9 wide where an invariant polytope closes.

    If the product that gives the lower bound of rho is a maximal one, the orbit of its leading
    eigenvector spans an invariant polytope, and rho is known. Otherwise a slightly stretched rho
    admits one, and the interval is at most 0.001 wide.

    Parameters
    ----------
    mask
        Mask with at least one factor (1+z).
    cancelled
        Asked now and then; True ends the search with the best interval so far.
    """
    best = quick_interval(mask)
    _, radius = _searched(mask, QUICK_WIDTH, _FIRST_NODES)
    if not radius.word:
        return best
    for slack, max_vertices in _SLACKS:
        rho = radius.value * (1 + slack)
        if _admits_polytope(radius, rho, _SEED_SIZE, max_vertices, cancelled):
            return _narrower(best, _interval(radius, rho * INSIDE * ROUNDING))
        if cancelled():
            break
    return best


def _admits_polytope(
    radius: Radius, rho: float, seed_size: float, max_vertices: int, cancelled: Cancelled
) -> bool:
    """Whether an invariant polytope grows from the leading eigenvector, for matrices over rho."""
    steps = radius.matrices / rho
    seeds = [radius.leading]
    for digit in radius.word[:-1]:
        seeds.append(steps[digit] @ seeds[-1])
    small = seed_size * max(float(np.abs(seed).max()) for seed in seeds)
    first = np.column_stack([small * np.eye(steps.shape[1]), *seeds])
    return invariant_polytope(steps, first, max_vertices, cancelled)


def _narrower(first: HoelderInterval, second: HoelderInterval) -> HoelderInterval:
    """What two intervals of the same exponent leave together."""
    upper, word = min((first.upper, first.product), (second.upper, second.product))
    return HoelderInterval(max(first.lower, second.lower), upper, word)


def _norms(products: NDArray[np.float64]) -> NDArray[np.float64]:
    """Frobenius norms: submultiplicative, and cheap for thousands of matrices."""
    squares: NDArray[np.float64] = np.einsum("pij,pij->p", products, products)
    return np.sqrt(squares)
