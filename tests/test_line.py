"""Lines in pieces: cuts stay where they are, and what two lines have in common is told."""

from itertools import pairwise

import numpy as np
import pytest

from app.line import MOST_IN_PIECE, PIECE, UNCUT, WHOLE, Line, line_of, ribbon_of, stride_of
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
    assert line.loops.tolist() == [True]


def test_runs_go_on_over_the_seam_of_a_loop():
    line = line_of(runs([0, 1, 2], [10, 11], [57, 58, 60]), 60, UNCUT)
    assert [len(piece) for piece in line.pieces()] == [2, 5]
    assert line.t.tolist() == [10, 11, 57, 58, 60, 61, 62]


def padded(segment):
    """Box of a segment of `segments`."""
    places = np.array(segment[3:7]).reshape(2, 2)
    return np.concatenate([places.min(axis=0), places.max(axis=0)])


def is_held(box, boxes):
    low, high = boxes[:, :2] <= box[:2] + 1e-9, boxes[:, 2:] >= box[2:] - 1e-9
    return (low & high).all(axis=1).any()


@pytest.mark.parametrize("stride", [UNCUT, 8.0])
def test_segments_that_only_one_line_has_are_in_the_boxes_and_so_are_their_neighbours(stride):
    rng = np.random.default_rng(1)
    t = np.arange(0.0, 61.0)
    line = line_of(runs(t), 60, stride)
    areas = []
    for _ in range(120):
        low, high = np.sort(rng.integers(0, 60, 2))
        inner = np.sort(rng.uniform(low, high, rng.integers(0, 9)))
        changed = np.unique(np.concatenate([t[t <= low], inner, t[t >= high]]))
        if rng.random() < 0.3:
            changed = t
        near = np.searchsorted(changed, [low, high])
        parts = [changed] if rng.random() < 0.6 else [changed[: near[0] + 1], changed[near[1] :]]
        other = runs(*[part for part in parts if len(part) > 1])
        other.vertices[rng.integers(len(other.vertices))] += rng.choice([0.0, 1.0])
        after = line_of(other, 60, stride)
        for one, two in ((line, after), (after, line)):
            boxes = np.array(one.unlike(two, 0.0)).reshape(-1, 4)
            areas.append((np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)).sum())
            for owner, left in ((one, two), (two, one)):
                known, own = set(segments(left)), segments(owner)
                for place, segment in enumerate(own):
                    if segment in known:
                        continue
                    near = [k for k in (place - 1, place, place + 1) if 0 <= k < len(own)]
                    if owner.loops.all() and len(owner.starts) == 2:
                        near = [(place + k) % len(own) for k in (-1, 0, 1)]
                    for k in near:
                        if own[k][0] == segment[0]:  # of one piece
                            assert is_held(padded(own[k]), boxes)
    assert np.median(areas) < 0.5 * 200**2


def test_a_vertex_that_moves_is_in_one_small_box():
    line = line_of(runs(np.arange(0.0, 61.0)), 0, UNCUT)
    other = Line(line.vertices.copy(), line.t, line.starts)
    other.vertices[20] += 5.0
    ((left, top, right, bottom),) = line.unlike(other, 1.0)
    around = line.vertices[18:23]
    assert (left, top) <= tuple(around.min(axis=0) - 1.0)
    assert right - left <= np.ptp(around[:, 0]) + 7.0
    assert bottom - top <= np.ptp(around[:, 1]) + 7.0


def test_a_line_has_all_in_common_with_itself_and_nothing_with_none():
    line = line_of(runs(np.arange(0.0, 61.0)), 60, 8.0)
    nothing = Line(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp))
    same = line_of(runs(np.arange(0.0, 61.0)), 60, 8.0)
    assert line.unlike(same, 1.0) == []
    (box,) = line.unlike(nothing, 0.0)
    assert box == line.box
    assert nothing.unlike(line, 0.0) == [box]


def test_pieces_near_a_box_are_found():
    line = line_of(runs(np.arange(0, 300, 0.25)), 0, 16.0)
    for reach in (0.0, 5.0):
        for box in ((295.0, 190.0, 301.0, 210.0), (0.0, 0.0, 9.0, 9.0)):
            near = line.near(box, reach)
            for piece, vertices in enumerate(line.pieces()):
                inside = (vertices >= np.array(box[:2]) - reach) & (
                    vertices <= np.array(box[2:]) + reach
                )
                assert piece in near or not inside.all(axis=1).any()
            assert len(near) < len(line.starts) - 1


def test_a_ribbon_keeps_its_breadth_where_it_is_cut():
    vertices = np.array([(-2e4, 0.0), (2e4, 0.0)])
    ribbon = ribbon_of(vertices, np.array([1.0, 5.0]))
    np.testing.assert_allclose(ribbon.vertices, [(-1e4, 0), (1e4, 0)])
    np.testing.assert_allclose(ribbon.halves, [2.0, 4.0])
