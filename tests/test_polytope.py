"""Norms of symmetric polytopes, and invariant polytopes of matrices with a known radius."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from core.polytope import INSIDE, invariant_polytope, polytope_norm

SEEDS = st.integers(0, 10**6)


@given(SEEDS, st.integers(2, 5), st.integers(0, 12))
def test_the_norm_is_the_optimum_of_the_linear_program(seed, size, more):
    rng = np.random.default_rng(seed)
    vertices = np.column_stack([np.eye(size), rng.normal(size=(size, more))])
    point = 2 * rng.normal(size=size)
    both = np.column_stack([vertices, -vertices])
    best = linprog(np.ones(both.shape[1]), A_eq=both, b_eq=point, bounds=(0, None)).fun
    norm = polytope_norm(vertices, np.eye(size), point)
    assert norm >= best * (1 - 1e-9)
    # The search ends once the side of 1 is known.
    assert (norm > INSIDE) == (best > INSIDE)


@given(SEEDS)
def test_an_accepted_family_of_matrices_does_not_grow(seed):
    rng = np.random.default_rng(seed)
    matrices = rng.normal(size=(2, 3, 3))
    matrices /= 1.3 * max(np.linalg.norm(m, 2) for m in matrices)
    assert invariant_polytope(matrices, np.eye(3), 200)
    product = np.eye(3)
    for k in range(60):
        product = matrices[(seed >> (k % 20)) & 1] @ product
    assert np.abs(np.linalg.eigvals(product)).max() <= INSIDE**60


def test_a_growing_matrix_has_no_invariant_polytope():
    assert not invariant_polytope(np.array([[[1.01, 0.0], [0.0, 0.5]]]), np.eye(2), 40)


def test_the_golden_pair_is_decided_at_its_exact_radius():
    """(1 1; 0 1) and (1 0; 1 1): the radius is the golden ratio, by their product."""
    pair = np.array([[[1.0, 1.0], [0.0, 1.0]], [[1.0, 0.0], [1.0, 1.0]]])
    golden = (1 + 5**0.5) / 2
    values, vectors = np.linalg.eig(pair[0] @ pair[1])
    leading = vectors[:, np.abs(values).argmax()].real
    seeds = np.column_stack([0.02 * np.eye(2), leading, pair[1] @ leading / golden])
    assert invariant_polytope(pair / golden, seeds, 60)
    assert not invariant_polytope(pair / (golden * 0.99), seeds, 60)


def test_a_cancelled_search_proves_nothing():
    assert not invariant_polytope(np.zeros((1, 2, 2)), np.eye(2), 10, cancelled=lambda: True)
