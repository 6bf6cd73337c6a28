"""The joint spectral radius of a mask's matrices from below: by the best of many products.

Notes
-----
Every product of k matrices gives a lower bound of rho, its spectral radius to the power 1/k. It is
computed by LAPACK, and widened by `ROUNDING` and by the first-order condition number of the
eigenvalue; that last step is an estimate where the eigenvalue is nearly defective.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.basis import MEMORY
from core.mask import Mask

ROUNDING: Final = 1 + 1e-10
"""Factor on all bounds of rho that covers the rounding of norms of products."""

_STEPS: Final = 40
"""How often the map of ellipsoids is applied; the norm does not get much better after that."""

WORD_LENGTH: Final = 6
"""Longest products whose spectral radii are tried as lower bounds of rho."""

_PROMISING: Final = 1 + 1e-6
"""A product is looked at in full if its mean spectral radius, so stretched, may be the largest."""

_SQUARINGS: Final = 4
"""How often products are squared to see which may matter; more do not tell more."""

_SMALL: Final = 0.99
"""Norm of a squared product below which it cannot be promising: `_PROMISING` to the power -96 and
some rounding."""

_REAL: Final = 1e-9
"""Norm of a part of an eigenvector of norm 1 below which the part is rounding."""


@dataclass(frozen=True, eq=False)
class Radius:
    """The two matrices in well-scaled coordinates, and the best product found.

    Attributes
    ----------
    multiplicity
        Full multiplicity m of (1+z).
    matrices
        Shape (2, d, d).
    word
        Digits of the product; empty where the matrices are numbers.
    value, lower
        Its mean spectral radius, and the same rounded down: a lower bound of rho.
    leading
        Its leading eigenvector, one column, or the real and imaginary part as two.
    """

    multiplicity: int
    matrices: NDArray[np.float64]
    word: tuple[int, ...]
    value: float
    lower: float
    leading: NDArray[np.float64]

    def exponent(self, rho: float) -> float:
        """Hölder exponent that a joint spectral radius would give."""
        return self.multiplicity - 1 - float(np.log2(rho))


def transition_matrices(mask: Mask) -> tuple[int, NDArray[np.float64]]:
    """Multiplicity m of (1+z) and the matrices ``B_0, B_1``, shape (2, d, d), d >= 1."""
    multiplicity, quotient = mask.factored()
    return multiplicity, matrices_of(quotient.values * 2.0 ** (multiplicity - 1))


def matrices_of(b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Matrices ``(B_e)_{ij} = b_{2i-j+e}`` of the coefficients ``b_0, b_1, ...``."""
    size = max(len(b) - 1, 1)
    index = np.arange(size)
    place = 2 * index[:, None] - index[None, :] + np.arange(2)[:, None, None]
    inside = (place >= 0) & (place < len(b))
    return np.where(inside, b[np.clip(place, 0, len(b) - 1)], 0.0)


def rho_floor(mask: Mask) -> float:
    """Lower bound of the joint spectral radius of the transition matrices."""
    return radius_of(mask).lower


@lru_cache(maxsize=MEMORY)
def radius_of(mask: Mask) -> Radius:
    """Scale the matrices well, and find the product with the largest mean spectral radius."""
    multiplicity, matrices = transition_matrices(mask)
    if matrices.shape[1] == 1:
        # b has one or two coefficients; the matrices are numbers and rho is the larger one.
        value = float(np.abs(matrices).max())
        return Radius(multiplicity, matrices, (), value, value, np.ones((1, 1)))
    matrices = well_scaled(matrices)
    words, mean = _promising_words(matrices)
    found = []
    for word in words:
        found.append((_spectral_radius(matrices, word), word))
        if found[-1][0][1] * ROUNDING >= mean:
            break  # the others cannot be better
    # Among products that are as good up to rounding the shortest one, which comes first.
    largest = max(lower for (_, lower, _), _ in found)
    (value, lower, leading), word = next(f for f in found if f[0][1] * ROUNDING >= largest)
    return Radius(multiplicity, matrices, word, value, lower / ROUNDING, leading)


def _promising_words(matrices: NDArray[np.float64]) -> tuple[list[tuple[int, ...]], float]:
    """Words up to `WORD_LENGTH` with nearly the largest mean spectral radius, and that radius.

    A product P of k matrices that are divided by the larger one of their own spectral radii can
    only matter if ``||P^n|| >= 1`` for all n. Squaring all of them is faster than looking for the
    eigenvalues of one, and leaves few.
    """
    words, codes = _lyndon_words(WORD_LENGTH)
    products, kept = matrices, [matrices[codes[0]]]
    for ranks in codes[1:]:
        # The new digit leads the code and is the factor on the left.
        products = np.matmul(matrices[:, None], products).reshape(-1, *matrices.shape[1:])
        kept.append(products[ranks])
    powers, lengths = np.concatenate(kept), np.array([len(word) for word in words])
    least = mean_radii(matrices, np.array(1)).max()
    with np.errstate(all="ignore"):  # what overflows matters
        high = powers / least ** lengths[:, None, None]
        for _ in range(_SQUARINGS):
            high = high @ high
        alive = np.flatnonzero(~(np.abs(high).max(axis=(1, 2)) < _SMALL / len(high[0])))
    means = mean_radii(powers[alive], lengths[alive])
    largest = means.max()
    return [words[k] for k in alive[means * _PROMISING >= largest]], float(largest)


def mean_radii(powers: NDArray[np.float64], lengths: NDArray[np.intp]) -> NDArray[np.float64]:
    """Mean spectral radii of products, shape (k, d, d), of so many factors each; not rounded."""
    sizes: NDArray[np.float64] = np.abs(np.linalg.eigvals(powers)).max(axis=1)
    return sizes ** (1 / lengths)


def well_scaled(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Similar matrices for which the Euclidean norm is nearly extremal.

    The dominant eigenvector X of the positive map ``X -> sum_e B_e^T X B_e``, with eigenvalue
    lambda, is an ellipsoid with ``B_e^T X B_e <= lambda X``, so ``||B_e||_X <= sqrt(lambda)``, and
    ``rho >= sqrt(lambda / 2)``. A share of the unit matrix keeps it away from being singular.
    """
    size = matrices.shape[1]
    rows, columns, straight, crossed = _pairs(size)
    # Entry (i, j) of the image is the sum of B_ki B_lj X_kl; X is symmetric, so X_kl, k <= l, do.
    flat = matrices.reshape(len(matrices), -1)
    products = (flat.T @ flat).ravel()
    step = products[straight] + products[crossed] * (rows != columns)[:, None]
    image = (rows == columns).astype(float)
    step /= np.abs(image @ step).max()
    for _ in range(_STEPS):
        image = image @ step
    ellipsoid = np.empty((size, size))
    ellipsoid[rows, columns] = ellipsoid[columns, rows] = image
    ellipsoid = ellipsoid / ellipsoid.trace() + 1e-9 * np.eye(size)
    root = np.linalg.cholesky(ellipsoid).T
    scaled: NDArray[np.float64] = root @ matrices @ np.linalg.inv(root)
    return scaled


@cache
def _pairs(size: int) -> tuple[NDArray[np.intp], ...]:
    """Places (k, l), k <= l, of a symmetric matrix, and of their products in `well_scaled`.

    Returns
    -------
    rows, columns
        k and l of each place.
    straight, crossed
        Places of ``B_ki B_lj`` and of ``B_li B_kj`` among all products of two entries, a row for
        each (k, l) and a column for each (i, j).
    """
    rows, columns = np.triu_indices(size)
    k, l, i, j = rows[:, None], columns[:, None], rows, columns  # noqa: E741
    straight = (k * size + i) * size**2 + l * size + j
    crossed = (l * size + i) * size**2 + k * size + j
    return rows, columns, straight, crossed


def _spectral_radius(
    matrices: NDArray[np.float64], word: tuple[int, ...]
) -> tuple[float, float, NDArray[np.float64]]:
    """Mean spectral radius of the product of a word, the same rounded down, and its eigenvector.

    The eigenvector comes as one column, or, if it is complex, as its real and imaginary parts.
    """
    power = matrices[word[0]]
    for digit in word[1:]:
        power = matrices[digit] @ power
    values, vectors = np.linalg.eig(power)
    index = int(np.abs(values).argmax())
    vector = vectors[:, index]
    size = abs(values[index])
    try:
        left = np.linalg.inv(vectors)[index]
        condition = float(np.linalg.norm(left) * np.linalg.norm(vector))
    except np.linalg.LinAlgError:
        condition = np.inf
    eps = float(np.finfo(np.float64).eps)
    error = 10 * eps * condition * float(np.linalg.norm(power))
    parts = [vector.real, vector.imag]
    columns = np.column_stack([part for part in parts if np.linalg.norm(part) > _REAL])
    lower = max(size - error, 0.0) ** (1 / len(word))
    return size ** (1 / len(word)), lower, columns


@cache
def _lyndon_words(longest: int) -> tuple[list[tuple[int, ...]], list[list[int]]]:
    """Binary words that are smaller than all their rotations: one for each primitive product.

    Returns
    -------
    words, codes
        The words by rising length; and for each length their codes ``sum_k word[k] 2^k``.
    """
    by_length = [
        [
            word
            for word in product((0, 1), repeat=length)
            if all(word < word[k:] + word[:k] for k in range(1, length))
        ]
        for length in range(1, longest + 1)
    ]
    codes = [[sum(e << k for k, e in enumerate(word)) for word in words] for words in by_length]
    return [word for words in by_length for word in words], codes


def improved(radius: Radius, words: list[tuple[int, ...]], means: NDArray[np.float64]) -> Radius:
    """The same matrices with the best of some words, if one of them beats the present product.

    ``means`` are the mean spectral radii of the words, not rounded.
    """
    for word, mean in zip(words, means.tolist(), strict=True):
        if mean <= radius.lower * ROUNDING**2:
            continue
        value, lower, leading = _spectral_radius(radius.matrices, word)
        if lower > radius.lower * ROUNDING**2:
            radius = replace(radius, word=word, value=value, lower=lower, leading=leading)
    return radius
