"""The grid, and the trees of edges that Clipper gives."""

import numpy as np
import pytest

from core.errors import NinepointError
from core.formats.clipping import Grid, doubled_area, engine_of, grown, length, library, tree

SQUARE = np.array([(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)])


def nested(count):
    """Squares, each inside the one before."""
    return [SQUARE * (1 - k / count) + 4 * k / count for k in range(count)]


def test_what_the_grid_takes_it_gives_back_to_half_a_unit():
    places = np.random.default_rng(2).uniform(1e6, 1e6 + 50, (200, 2))
    grid = Grid.of([places], 0.1, 0.01)
    assert np.log2(grid.scale).is_integer()
    rows = grid.put(places, 4)
    assert (rows[:, :2] == np.rint(rows[:, :2])).all()
    assert (rows[:, 2] == 5).all()
    assert 1 / grid.scale <= 0.01 / 1024
    assert np.abs(grid.taken(rows) - places).max() <= 0.5 / grid.scale + 1e-9
    with pytest.raises(NinepointError, match="cannot be offset within 1e-06 mm"):
        Grid.of([places * 1e5], 0.1, 1e-6)


def test_edges_are_nested_as_they_lie_and_turn_by_turns():
    clipper = library()
    grid = Grid.of(nested(300), 0.0, 0.01)
    paths = [grid.put(square, k) for k, square in enumerate(nested(300))]
    nodes = tree(engine_of(clipper, paths).execute2(clipper.ClipType.Union))
    for depth in range(300):
        (node,) = nodes
        assert set(node.rows[:, 2]) == {depth + 1}
        assert (doubled_area(node.rows) > 0) == (depth % 2 == 0)
        nodes = node.inner
    assert nodes == ()


def test_growing_keeps_connected_parts_together():
    clipper = library()
    plate = np.column_stack([SQUARE * 1000, np.full(4, 1.0)])
    hole = np.column_stack([SQUARE[::-1] * 250 + 3000, np.full(4, 2.0)])
    far = np.add(plate, [20_000.0, 0.0, 2.0])
    parts = grown(clipper, [plate, hole, far], -500.0, 1.0)
    assert sorted(len(part) for part in parts) == [1, 2]
    assert grown(clipper, [plate], -4001.0, 1.0) == []


def test_length_and_area_are_those_of_the_closed_polygon():
    assert length(SQUARE) == 32
    assert doubled_area(SQUARE) == 128
    assert doubled_area(SQUARE[::-1] + 1e6) == -128
