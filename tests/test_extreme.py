"""Extremes and equality of short arrays are those of NumPy."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hn

from core.extreme import largest, least, same

arrays = hn.arrays(np.float64, hn.array_shapes(max_dims=2, max_side=9),
                   elements=st.floats(allow_nan=False))  # fmt: skip


@given(arrays)
def test_they_are_the_extremes(values):
    assert least(values) == values.min()
    assert largest(values) == values.max()
    assert largest(values.T[::-1]) == values.max()


def test_nan_is_told_and_not_passed_over():
    assert np.isnan(least(np.array([1.0, np.nan, 2.0])))
    assert np.isnan(largest(np.array([1.0, np.nan, 2.0])))


@given(arrays, arrays)
def test_arrays_are_the_same_in_every_bit_or_not(one, other):
    assert same(one, one.copy())
    assert same(one, np.asfortranarray(one))
    if not np.array_equal(one, other):
        assert not same(one, other)
    assert not same(np.zeros(2), np.zeros(3))
    assert not same(np.zeros(2), np.zeros(2) * -1.0)
