"""Sets of control points are sets of pairs, and large ones cost nothing to speak of."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.point_set import PointSet

PAIRS = st.sets(st.tuples(st.integers(0, 3), st.integers(0, 9)))


@given(PAIRS, PAIRS)
def test_it_behaves_as_a_set_of_pairs(mine, others):
    one, other = PointSet.of(mine), PointSet.of(others)
    assert one == mine
    assert frozenset(mine) == one
    assert (one == other) == (mine == others)
    assert len(one) == len(mine)
    assert list(one) == sorted(mine)
    for both in (other, others):
        assert one | both == mine | others
        assert one - both == mine - others
        assert one & both == mine & others
    assert hash(one) == hash(PointSet.of(list(mine)))
    for pair in mine | others:
        assert (pair in one) == (pair in mine)
    for curve in range(4):
        assert one.of_curve(curve).tolist() == sorted(p for c, p in mine if c == curve)
    assert set(one.by_curve) == {curve for curve, _ in mine}


@given(PAIRS, st.lists(st.integers(0, 8), max_size=5))
def test_within_keeps_what_exists(pairs, sizes):
    kept = PointSet.of(pairs).within(sizes)
    assert kept == {(c, p) for c, p in pairs if c < len(sizes) and p < sizes[c]}


def test_what_is_no_pair_is_not_in_it():
    points = PointSet({0: [3, 1, 1]})
    assert (0, 1) in points
    assert 1 not in points
    assert (0, 1, 2) not in points
    assert points != 3
    assert repr(points) == "PointSet({0: [1, 3]})"
    with pytest.raises(ValueError, match="read-only"):
        points.of_curve(0)[0] = 9


def test_a_million_points_are_some_megabytes_and_no_pairs():
    everything = PointSet({2: np.arange(1_000_000)})
    assert len(everything) == 1_000_000
    assert (2, 999_999) in everything
    assert (everything | {(1, 5)}) - {(2, 0)} == (everything - {(2, 0)}) | {(1, 5)}
    assert everything.within([0, 0, 1_000_000]) is everything
    assert everything.of_curve(2).nbytes <= 8_000_000
