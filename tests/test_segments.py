"""Segments of arrays, short and long ones, against loops over them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.segments import Segments


@pytest.fixture(params=[3, 60], ids=["short", "long"])
def counts(request):
    counts = np.random.default_rng(0).integers(0, 2 * request.param, 200)
    counts[[0, 7, 8, -1]] = 0
    return counts


def test_each_entry_belongs_to_the_segment_that_holds_it(counts):
    segments = Segments(counts)
    expected = [segment for segment, count in enumerate(counts) for _ in range(count)]
    assert segments.owners.tolist() == expected
    assert segments.size == len(expected)
    values = np.random.default_rng(1).normal(size=len(counts))
    np.testing.assert_array_equal(segments.spread(values), values[expected])


def test_sums_and_maxima_are_those_of_the_parts(counts):
    segments = Segments(counts)
    values = np.random.default_rng(2).uniform(size=segments.size)
    parts = np.split(values, segments.starts[1:])
    sums = [part.sum() for part in parts]
    np.testing.assert_allclose(segments.sums(values), sums, rtol=1e-13)
    largest = [part.max(initial=0.0) for part in parts]
    np.testing.assert_array_equal(segments.maxima(values), largest)


@given(
    st.lists(st.integers(0, 60), min_size=1, max_size=40).filter(any),
    st.floats(0, 1),
    st.integers(0, 10**6),
)
def test_maxima_above_what_is_asked_are_told_and_others_are_kept_below(counts, asked, seed):
    segments = Segments(np.array(counts))
    values = np.random.default_rng(seed).uniform(size=segments.size)
    exact, found = segments.maxima(values), segments.maxima(values, asked)
    large = exact > asked
    np.testing.assert_array_equal(found[large], exact[large])
    assert (found[~large] >= exact[~large]).all()
    assert (found[~large] <= asked).all()
    assert found.max() <= values.max()
