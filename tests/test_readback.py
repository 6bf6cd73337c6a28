import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.formats import readback
from core.formats.readback import arcs_read, cubics_read, keep_near
from independent import farthest

seeds = st.integers(0, 2**16)


@given(seeds, st.integers(2, 60), st.integers(1, 80), st.floats(0.01, 3))
def test_points_keep_near_exactly_if_their_distance_says_so(seed, size, count, reach):
    generator = np.random.default_rng(seed)
    line = generator.normal(size=(size, 2)).cumsum(axis=0) * generator.choice([0.1, 1, 10])
    points = line[generator.integers(0, size, count)] + generator.normal(size=(count, 2))
    far = farthest(points, line)
    assert not keep_near(points, line, far * 0.999 - 1e-12)
    assert keep_near(points, line, far * 1.001 + 1e-12)
    assert keep_near(points, line, reach) == (far <= reach)


def test_a_line_of_one_place_and_a_reach_of_nothing():
    dot = np.array([(1.0, 2.0), (1.0, 2.0)])
    assert keep_near(dot, dot, 0.0)
    assert not keep_near(dot + 1e-9, dot, 0.0)
    assert keep_near(dot + 0.5, dot, 1.0)
    segment = np.array([(0.0, 0.0), (8.0, 0.0)])
    assert keep_near(np.array([(4.0, 0.0)]), segment, 0.0)


def test_long_segments_are_cut_so_that_cells_stay_few(monkeypatch):
    monkeypatch.setattr(readback, "MOST_POINTS", 100)
    line = np.array([(0.0, 0.0), (1e6, 0.0), (1e6, 1e6)])
    points = np.array([(3e5, 0.01), (1e6 - 0.01, 5e5)])
    assert keep_near(points, line, 0.011)
    assert not keep_near(points, line, 0.009)


@given(st.floats(-0.95, 0.95), st.floats(1e-4, 0.1))
def test_an_arc_is_read_as_points_on_its_circle(bulge, fine):
    points = np.array([(0.0, 0.0), (2.0, 0.0)])
    found = arcs_read(points, np.array([bulge, 0.0]), False, "L", fine)
    assert found.slack <= fine
    assert found.line[0].tolist() == [0, 0]
    assert found.line[-1].tolist() == [2, 0]
    if abs(bulge) > 1e-6:
        # The circle's centre, from the right triangle of half a chord and the arc's height.
        radius = (1 + bulge**2) / (2 * abs(bulge))
        centre = np.array([1, (1 - bulge**2) / (2 * bulge)])
        off = np.hypot(*(found.line - centre).T)
        assert np.allclose(off, radius, rtol=1e-9)
    # To the left of its way is a turn to the left: the arc itself lies to the right.
    assert (found.line[:, 1] * bulge <= 1e-12).all()


def test_closed_arcs_return_to_their_start_and_pieces_are_counted():
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    for bulges in (np.zeros(4), np.full(4, 0.1)):
        closed = arcs_read(square, bulges, True, "", 0.01)
        assert closed.line[0].tolist() == closed.line[-1].tolist()
        assert (closed.closed, closed.count) == (True, 4)
        assert arcs_read(square, bulges, False, "", 0.01).count == 3


@given(seeds, st.integers(1, 5), st.floats(1e-3, 1.0))
def test_cubics_leave_their_points_by_no_more_than_is_said(seed, count, fine):
    controls = np.random.default_rng(seed).normal(size=(count, 4, 2))
    controls[1:, 0] = controls[:-1, 3]
    found = cubics_read(controls, False, "L", fine)
    assert (found.count, found.layer) == (count, "L")
    assert found.slack <= fine
    u = np.linspace(0, 1, 301)[:, None]
    v = 1 - u
    for a, b, c, d in controls:
        dense = v**3 * a + 3 * u * v * v * b + 3 * u * u * v * c + u**3 * d
        assert farthest(dense, found.line) <= found.slack + 1e-12


def test_the_number_of_parts_is_bounded(monkeypatch):
    monkeypatch.setattr(readback, "MOST_POINTS", 64)
    controls = np.random.default_rng(1).normal(size=(4, 4, 2))
    found = cubics_read(controls, False, "", 1e-12)
    assert len(found.line) == 4 * 16 + 1
    assert found.slack == pytest.approx(
        cubics_read(controls, False, "", 1e-3).slack, rel=1e9
    )
