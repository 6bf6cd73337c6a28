"""Ranges around moved points: disjoint, rising, and just the ones that are meant."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.ranges import around, united, within


@given(
    st.lists(st.integers(0, 59), min_size=1, max_size=8),
    st.integers(0, 9),
    st.integers(1, 9),
    st.booleans(),
)
def test_they_hold_what_lies_near_and_nothing_else(
    indices: list[int], before: int, after: int, closed: bool
) -> None:
    spans = 60
    ranges = within(around(np.array(indices), before, after), spans, closed)
    near = {i + k for i in indices for k in range(-before, after)}
    wanted = {i % spans for i in near} if closed else {i for i in near if 0 <= i < spans}
    assert [i for part in ranges for i in part] == sorted(wanted)
    assert all(a.stop < b.start for a, b in pairwise(ranges))


def test_one_turn_is_everything() -> None:
    assert within([(-3, 8)], 10, closed=True) == (range(10),)
    assert within([], 10, closed=True) == ()


@given(st.sets(st.integers(0, 9)), st.sets(st.integers(0, 9)))
def test_united_is_the_union(one: set[int], other: set[int]) -> None:
    arrays = [np.array(sorted(some), dtype=np.intp) for some in (one, other)]
    assert united(*arrays).tolist() == sorted(one | other)
