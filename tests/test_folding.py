"""The L-fold mask, against products of symbols."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.folding import folded, norm
from core.mask import Mask

MASKS = st.lists(st.integers(-3, 3), min_size=1, max_size=9).map(lambda c: [1, *c, 1])


@given(MASKS, st.integers(1, 4))
def test_the_folded_mask_is_the_product_of_spread_symbols(coefficients, iterations):
    mask = np.array(coefficients, dtype=float)
    found, expected = mask, Mask(0, (Fraction(1),))
    for _ in range(iterations - 1):
        found = folded(found, mask)
    for k in range(iterations):
        spread = {2**k * i: Fraction(c) for i, c in enumerate(coefficients)}
        expected = expected * Mask.from_mapping(spread)
    np.testing.assert_array_equal(found, expected.values)


@given(MASKS, st.integers(1, 4))
def test_the_norm_is_the_largest_sum_over_one_residue(coefficients, iterations):
    mask, period = np.array(coefficients, dtype=float), 2**iterations
    sums = [sum(abs(c) for c in coefficients[r::period]) for r in range(period)]
    assert norm(mask, iterations) == max(sums)


def test_a_mask_of_one_coefficient_folds():
    assert folded(np.array([3.0]), np.array([3.0])).tolist() == [9.0]
