"""Blocks of a polygon: an update equals building anew, and costs what moved."""

from __future__ import annotations

import tracemalloc

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.blocks import Blocks, from_chords
from core.ends import reach
from core.family import PRESETS, Parameters
from core.live import SIDE, LiveCurve
from oracles import convergent_members

SEEDS = st.integers(0, 10**6)


def scattered(count: int, seed: int) -> NDArray[np.float64]:
    return np.random.default_rng(seed).normal(0, 50, (count, 2))


def assert_same(mine: Blocks, others: Blocks) -> None:
    for held, expected in (
        (mine.boxes, others.boxes),
        (mine.deviations, others.deviations),
        (mine.bends, others.bends),
    ):
        for one, other in zip(held, expected, strict=True):
            np.testing.assert_allclose(one, other, atol=1e-9, rtol=0)


@given(convergent_members(), st.integers(2, 700), SEEDS, st.booleans())
def test_an_update_equals_new_blocks(
    member: Parameters, count: int, seed: int, closed: bool
) -> None:
    rng = np.random.default_rng(seed)
    live = LiveCurve(scattered(count, seed), member.mask, closed)
    blocks = Blocks(live)
    for _ in range(3):
        indices = rng.choice(count, size=min(2, count), replace=False)
        live.move(indices, rng.normal(0, 50, (len(indices), 2)))
        blocks.update(indices)
    assert_same(blocks, Blocks(LiveCurve(live.control_points, member.mask, closed)))


@given(convergent_members(), convergent_members(), st.integers(2, 300), SEEDS, st.booleans())
def test_another_scheme_changes_the_ends_alone(
    member: Parameters, other: Parameters, count: int, seed: int, closed: bool
) -> None:
    live = LiveCurve(scattered(count, seed), member.mask, closed)
    blocks = Blocks(live)
    live.recast(other.mask)
    blocks.update_ends()
    assert_same(blocks, Blocks(LiveCurve(live.control_points, other.mask, closed)))


@given(convergent_members(["translated", "mirrored"]))
def test_no_scheme_of_the_family_reads_further_than_blocks_look(member: Parameters) -> None:
    assert max(reach(member.mask)) <= SIDE


def test_an_update_allocates_nothing_of_size_n() -> None:
    live = LiveCurve(scattered(200_000, 1), PRESETS["Tight"].mask, True)
    blocks = Blocks(live)
    tracemalloc.start()
    try:
        live.move(100_000, (3.0, 4.0))
        blocks.update([100_000])
        live.recast(PRESETS["Lean"].mask)
        blocks.update_ends()
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000


def test_distances_are_those_from_segments() -> None:
    points = np.array([[0, 2, 5, -1, 4.0], [0, 1, 0, 0, 0.0]])
    np.testing.assert_allclose(from_chords(points), [1, 1, 1])
    np.testing.assert_allclose(from_chords(np.ones((2, 4))), [0, 0])
