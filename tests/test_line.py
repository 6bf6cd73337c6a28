"""Lines in pieces: cuts stay where they are, and what two lines have in common is told."""

from itertools import pairwise

import numpy as np
import pytest

import app.line
from app.line import MOST_IN_PIECE, PIECE, UNCUT, WHOLE, Line, line_of, stride_of
from core.runs import Runs


def runs(*parts):
    """Runs on a circle, each given by its t."""
    t = np.concatenate([np.asarray(part, dtype=float) for part in parts])
    starts = np.concatenate([[0], np.cumsum([len(part) for part in parts])])
    vertices = 200 + 100 * np.stack([np.cos(t / 50), np.sin(t / 50)], axis=-1)
    return Runs(vertices, t, starts, 0.0)


def segments(line):
    """What tells each segment, in their order: a slow oracle."""
    found = []
    for first, after in zip(line.starts[:-1], line.starts[1:], strict=True):
        piece = line.vertices[first:after]
        loop = (piece[0] == piece[-1]).all()
        for k in range(first, after - 1):
            caps = (not loop and k == first, not loop and k == after - 2)
            ends = tuple(line.vertices[k : k + 2].ravel().tolist())
            found.append((line.t[first], line.t[k], line.t[k + 1], *ends, *caps))
    return found


def test_pieces_are_the_runs_where_they_are_short():
    before = runs([0, 1, 2], [5, 6, 8, 9])
    assert stride_of(before) == UNCUT
    line = line_of(before, 0, UNCUT)
    for piece, run in zip(line.pieces(), before.runs(), strict=True):
        np.testing.assert_array_equal(piece, run)


def test_a_long_line_is_cut_at_fixed_places_and_the_pieces_meet():
    before = runs(np.arange(0, 300, 0.25))
    stride = stride_of(before)
    assert np.log2(stride) == np.round(np.log2(stride))
    line = line_of(before, 0, stride)
    pieces = list(line.pieces())
    assert PIECE / 2 <= np.mean([len(piece) for piece in pieces]) <= 2 * PIECE
    for piece, following in pairwise(pieces):
        np.testing.assert_array_equal(piece[-1], following[0])
    assert (line.t[line.starts[1:-1]] % stride == 0).all()
    assert sum(len(piece) - 1 for piece in pieces) == len(before.parameters) - 1


def test_where_vertices_are_dense_a_piece_is_cut_by_their_number():
    t = np.concatenate([np.arange(0, 100, 0.5), np.arange(100, 110, 0.005), np.arange(110, 200)])
    line = line_of(runs(t), 0, 32.0)
    counts = np.diff(line.starts) - 1
    assert counts.max() <= MOST_IN_PIECE
    assert counts.min() >= 1
    assert len(t) > WHOLE


def test_a_loop_that_is_seen_whole_meets_itself():
    before = runs(np.arange(0.0, 61.0))
    line = line_of(before, 60, UNCUT)
    (piece,) = line.pieces()
    np.testing.assert_array_equal(piece[0], piece[-1])
    first, last = np.arange(60) == 0, np.arange(60) == 59
    assert np.flatnonzero(line.widened(first)).tolist() == [0, 1, 59]
    assert np.flatnonzero(line.widened(last)).tolist() == [0, 58, 59]


def test_the_neighbours_of_a_segment_in_a_loop_of_several_are_over_its_own_seam():
    parts = [np.arange(0.0, count) for count in (5, 7)]
    loops = [Line(runs(t).vertices, t, np.array([0, len(t)])) for t in parts]
    for loop in loops:
        loop.vertices[-1] = loop.vertices[0]
    line = Line(
        np.concatenate([loop.vertices for loop in loops]),
        np.concatenate([loop.t + 100 * place for place, loop in enumerate(loops)]),
        np.array([0, 5, 12]),
    )
    chosen = np.arange(10) == 9
    assert {4, 8, 9} <= set(np.flatnonzero(line.widened(chosen)).tolist()) <= {3, 4, 8, 9}


def test_runs_go_on_over_the_seam_of_a_loop():
    line = line_of(runs([0, 1, 2], [10, 11], [57, 58, 60]), 60, UNCUT)
    assert [len(piece) for piece in line.pieces()] == [2, 5]
    assert line.t.tolist() == [10, 11, 57, 58, 60, 61, 62]


@pytest.mark.parametrize("few", [0, 512])
@pytest.mark.parametrize("stride", [UNCUT, 8.0])
def test_segments_that_only_one_line_has_are_told(stride, few, monkeypatch):
    monkeypatch.setattr(app.line, "_FEW", few)
    rng = np.random.default_rng(1)
    t = np.arange(0.0, 61.0)
    line = line_of(runs(t), 60, stride)
    for _ in range(40):
        low, high = np.sort(rng.integers(0, 60, 2))
        inner = np.sort(rng.uniform(low, high, rng.integers(0, 9)))
        changed = np.unique(np.concatenate([t[t <= low], inner, t[t >= high]]))
        near = np.searchsorted(changed, [low, high])
        parts = [changed] if rng.random() < 0.6 else [changed[: near[0] + 1], changed[near[1] :]]
        other = runs(*[part for part in parts if len(part) > 1])
        other.vertices[rng.integers(len(other.vertices))] += rng.choice([0.0, 1.0])
        after = line_of(other, 60, stride)
        for one, two in ((line, after), (after, line)):
            mine, others = one.own(two)
            for owner, own, left in ((one, mine, two), (two, others, one)):
                known = set(segments(left))
                lone = np.array([segment not in known for segment in segments(owner)])
                assert not (lone & ~own).any()
                assert few or not (own & ~lone).any()


def test_what_is_before_and_behind_all_changes_is_common():
    line = line_of(runs(np.arange(0.0, 61.0)), 0, UNCUT)
    changed = runs([*range(21), 20.5, *range(22, 61)])
    mine, others = line.own(line_of(changed, 0, UNCUT))
    assert np.flatnonzero(mine).tolist() == np.flatnonzero(others).tolist() == [20, 21]


def test_a_line_has_all_in_common_with_itself_and_nothing_with_none():
    line = line_of(runs(np.arange(0.0, 61.0)), 60, 8.0)
    nothing = Line(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp))
    same = line_of(runs(np.arange(0.0, 61.0)), 60, 8.0)
    assert not any(mask.any() for mask in line.own(same))
    mine, others = line.own(nothing)
    assert mine.all()
    assert len(others) == 0
