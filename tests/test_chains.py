import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.formats import chains
from core.formats.outlines import straight
from core.formats.sketch import Trace


def line(a, b, layer="", name=""):
    ends = np.array([[a], [b]], dtype=float)
    return Trace(straight(*ends), False, name, layer)


def corners(trace):
    return trace.nodes.tolist()


SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


@given(order=st.permutations(range(4)), flips=st.lists(st.booleans(), min_size=4, max_size=4))
def test_sides_of_a_square_are_one_closed_contour_in_any_order_and_direction(order, flips):
    sides = []
    for k in order:
        a, b = SQUARE[k], SQUARE[(k + 1) % 4]
        sides.append(line(b, a) if flips[k] else line(a, b))
    (whole,) = chains.joined(sides)
    assert whole.closed
    assert sorted(map(tuple, corners(whole))) == sorted(SQUARE)
    assert (whole.controls[1:, 0] == whole.controls[:-1, 3]).all()
    assert (whole.controls[-1, 3] == whole.controls[0, 0]).all()
    # It begins with the first line of the file, in that one's direction.
    assert whole.controls[0].tolist() == sides[0].controls[0].tolist()


def test_an_open_chain_stays_open():
    (whole,) = chains.joined([line((0, 0), (1, 0)), line((2, 5), (1, 0)), line((2, 5), (9, 9))])
    assert not whole.closed
    assert corners(whole) == [[0, 0], [1, 0], [2, 5], [9, 9]]


def test_where_three_ends_meet_nothing_is_joined():
    star = [line((0, 0), end) for end in [(1, 0), (0, 1), (-1, -1)]]
    assert chains.joined(star) == tuple(star)


def test_layers_are_not_mixed():
    parts = [line((0, 0), (1, 0), "A"), line((1, 0), (1, 1), "B")]
    assert chains.joined(parts) == tuple(parts)


def test_a_small_gap_is_closed_and_counted_and_a_wide_one_is_not():
    near = [line((0, 0), (10, 0)), line((10, 9e-5), (10, 10))]
    (whole,) = chains.joined(near)
    assert whole.deviation == pytest.approx(2 * 9e-5)
    assert (whole.controls[1, 0] == whole.controls[0, 3]).all()
    far = [line((0, 0), (10, 0)), line((10, 1.1e-4), (10, 10))]
    assert chains.joined(far) == tuple(far)


def test_a_moved_line_stays_one():
    (whole,) = chains.joined([line((0, 0), (10, 0)), line((10, 9e-5), (10, 10))])
    for a, p, q, b in whole.controls.tolist():
        assert np.allclose(p, (2 * np.array(a) + b) / 3, atol=1e-12)
        assert np.allclose(q, (np.array(a) + 2 * np.array(b)) / 3, atol=1e-12)


def test_a_line_drawn_twice_is_no_contour():
    twice = [line((0, 0), (5, 0)), line((5, 0), (0, 0))]
    assert chains.joined(twice) == tuple(twice)


def test_closed_traces_keep_their_place():
    ring = Trace(np.zeros((1, 4, 2)), True, "ring")
    away = line((50, 50), (60, 50))
    found = chains.joined([line((0, 0), (5, 0)), ring, line((5, 0), (5, 5)), away])
    assert [len(trace.controls) for trace in found] == [2, 1, 1]
    assert found[1] is ring


def test_ten_thousand_lines_are_one_contour():
    turn = np.linspace(0, 2 * np.pi, 10_000, endpoint=False)
    points = 500 * np.column_stack([np.cos(turn), np.sin(turn)])
    controls = straight(points, np.roll(points, -1, axis=0))
    order = np.random.default_rng(1).permutation(len(points))
    (whole,) = chains.joined([Trace(controls[k : k + 1], False) for k in order])
    assert whole.closed
    assert len(whole.controls) == 10_000
