"""Arcs that touch, within a tolerance; every stated deviation is measured again by brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arcs import arcs
from core.bends import ChordBounds
from core.continuity import smoothness
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from oracles import convergent_members

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


def pieces(chain):
    """Start, end and bulge of each arc, as complex numbers and floats."""
    vertices = chain.points @ (1, 1j)
    ends = np.roll(vertices, -1)
    count = len(vertices) if chain.closed else len(vertices) - 1
    return vertices[:count], ends[:count], chain.bulges[:count]


def tangents_of(chain):
    """Unit tangents at the start and at the end of each arc."""
    start, end, bulge = pieces(chain)
    direction = (end - start) / abs(end - start)
    half = np.exp(2j * np.arctan(bulge))
    return direction / half, direction * half


def drawn(chain, count=200):
    """Points on each arc, shape (n, count + 1), by the definition of a bulge."""
    start, end, bulge = (values[:, None] for values in pieces(chain))
    share = np.linspace(0, 1, count + 1)
    turn = 4 * np.arctan(bulge)
    with np.errstate(invalid="ignore"):
        arc = start + (end - start) * (np.exp(1j * turn * share) - 1) / (np.exp(1j * turn) - 1)
    line = start + (end - start) * share
    return np.where(bulge == 0, line, arc)


def furthest_from(chain, points):
    """Largest distance of points from the chain: to each circle within its sector, or the ends."""
    nearest = np.full(len(points), np.inf)
    for start, end, bulge in zip(*pieces(chain), strict=True):
        chord = end - start
        # In this frame the piece runs from -1 to 1.
        z = (points - (start + end) / 2) / (chord / 2)
        ends = np.minimum(abs(z - 1), abs(z + 1))
        if abs(bulge) < 1e-9:
            found = np.where(abs(z.real) <= 1, abs(z.imag), ends)
        else:
            centre = 1j * (1 - bulge**2) / (2 * bulge)
            apex = -1j * bulge
            radius = abs(centre - apex)
            direction = (z - centre) / (apex - centre)
            inside = abs(np.angle(direction)) <= abs(2 * np.arctan(bulge))
            found = np.where(inside, abs(abs(z - centre) - radius), ends)
        nearest = np.minimum(nearest, found * abs(chord) / 2)
    return nearest.max()


def furthest_from_curve(points, dense):
    """Largest distance of points, a thousand of them, from the polygon of dense curve points."""
    points = points[:: len(points) // 1000 + 1]
    start, way = dense[:-1], np.diff(dense)
    away = 0.0
    for block in np.array_split(points, -(-len(points) // 200)):
        off = block[:, None] - start
        share = (off * way.conj()).real / np.maximum(abs(way) ** 2, 1e-300)
        away = max(away, abs(off - np.clip(share, 0, 1) * way).min(axis=1).max())
    return away


def dense_points(curve, level):
    points = curve.points(level) @ (1, 1j)
    return np.append(points, points[:1]) if curve.closed else points


@given(
    st.one_of(convergent_members(), st.sampled_from(list(PRESETS.values()))),
    st.integers(2, 8),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([5.0, 0.3, 0.03]),
)
def test_curve_and_arcs_keep_to_each_other(parameters, n, seed, closed, tolerance):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    try:
        chain = arcs(curve, tolerance)
    except NinepointError:
        # Refused as too rough, which nearly continuous curves only are.
        assert smoothness(parameters.mask).exponent.lower < 4 / 5
        return
    assert chain.closed == closed
    assert chain.deviation <= tolerance
    assert len(chain.bulges) == len(chain.points)
    dense = dense_points(curve, 9)
    assert furthest_from(chain, dense) <= chain.deviation
    # What a polygon of points leaves out of a rough curve is more than of a smooth one.
    polygon_error = ChordBounds(curve).at(9).max()
    assert furthest_from_curve(drawn(chain, 20).ravel(), dense) <= chain.deviation + polygon_error
    if not closed:
        assert chain.points[[0, -1]].tolist() == points[[0, -1]].tolist()
        assert chain.bulges[-1] == 0


@given(
    st.sampled_from(list(PRESETS.values())), st.integers(3, 8), st.integers(0, 10**6), st.booleans()
)
def test_neighbours_have_a_common_tangent(parameters, n, seed, closed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    chain = arcs(LimitCurve(points, parameters.mask, closed), 0.01)
    if not chain.smooth:
        # It may turn back in a sixteenth of the tolerance, where a line takes over.
        start, end, bulge = pieces(chain)
        assert abs(end - start)[bulge == 0].min() < 0.01 / 16
        return
    before, after = tangents_of(chain)
    turns = np.angle(np.roll(before, -1) / after)
    assert abs(turns if closed else turns[:-1]).max() < 1e-9


@given(convergent_members(["mirrored"]), st.integers(0, 10**6))
def test_smooth_is_said_only_of_what_is_smooth(parameters, seed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(6, 2))
    try:
        chain = arcs(LimitCurve(points, parameters.mask, True), 0.1)
    except NinepointError:
        return
    order = smoothness(parameters.mask).order
    if chain.smooth:
        assert order >= 1
        before, after = tangents_of(chain)
        assert abs(np.angle(np.roll(before, -1) / after)).max() < 1e-6
    elif order == 0:
        assert not chain.bulges.any()


@pytest.mark.parametrize(("name", "uniform"), [("Calm", 70), ("Tight", 58)])
def test_far_fewer_arcs_than_by_cutting_uniformly(name, uniform):
    chain = arcs(LimitCurve(SHAPE, PRESETS[name].mask, True), 0.01)
    assert len(chain.points) <= 0.8 * uniform


def test_every_second_vertex_lies_on_the_curve():
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    chain = arcs(curve, 0.01)
    exact = curve.points(12)
    for x, y in chain.points[::2]:
        assert np.hypot(*(exact - (x, y)).T).min() < 1e-9


def test_a_straight_polygon_is_one_line():
    for count in (2, 6, 1000):
        straight = np.outer(np.arange(count), [3.0, 4.0])
        chain = arcs(LimitCurve(straight, PRESETS["Calm"].mask, False), 0.01)
        assert chain.points.tolist() == [straight[0].tolist(), straight[-1].tolist()]
        assert chain.bulges.tolist() == [0, 0]


def test_a_circle_takes_few_arcs_of_its_radius():
    angle = np.arange(24) * np.pi / 12
    circle = LimitCurve(
        50 * np.stack([np.cos(angle), np.sin(angle)], axis=1), PRESETS["Lagrange"].mask, True
    )
    chain = arcs(circle, 0.01)
    assert len(chain.points) <= 8
    start, end, bulge = pieces(chain)
    radii = abs(end - start) * (1 + bulge**2) / (4 * bulge)
    np.testing.assert_allclose(radii, 50, atol=0.05)


def test_a_symmetric_curve_gets_about_as_many_arcs_on_both_sides():
    angle = np.arange(12) * np.pi / 6
    heart = np.stack([30 * np.sin(angle) ** 3, 24 * np.cos(angle) - 9 * np.cos(2 * angle)], axis=1)
    chain = arcs(LimitCurve(heart, PRESETS["Calm"].mask, True), 0.01)
    left, right = (chain.points[:, 0] < -0.1).sum(), (chain.points[:, 0] > 0.1).sum()
    assert abs(left - right) <= 3


def test_a_curve_that_turns_back_keeps_its_bound():
    for name in PRESETS:
        curve = LimitCurve([(0, 0), (30, 0), (10, 0), (40, 0)], PRESETS[name].mask, False)
        chain = arcs(curve, 0.01)
        dense = dense_points(curve, 9)
        assert furthest_from(chain, dense) <= chain.deviation <= 0.01
        assert len(chain.points) < 20


def test_coincident_points_make_no_arcs_of_no_length():
    points = np.repeat([(0, 0), (10, 0), (10, 10), (0, 10)], 20, axis=0)
    for closed in (True, False):
        for name in PRESETS:
            curve = LimitCurve(points, PRESETS[name].mask, closed)
            chain = arcs(curve, 0.01)
            start, end, _ = pieces(chain)
            assert (start != end).all()
            assert furthest_from(chain, dense_points(curve, 5)) <= chain.deviation <= 0.01
            assert len(chain.points) < 100


@pytest.mark.parametrize("n", [0, 1])
def test_a_dot_is_its_own_chain(n):
    chain = arcs(LimitCurve(np.full((n, 2), 5.0), PRESETS["Calm"].mask, False), 0.01)
    assert len(chain.points) == len(chain.bulges) == n
    assert chain.deviation == 0


def test_a_tolerance_beyond_the_size_of_a_closed_curve_leaves_a_closed_chain():
    chain = arcs(LimitCurve(SHAPE, PRESETS["Calm"].mask, True), 1000)
    assert len(chain.points) >= 3
    assert np.isfinite(chain.points).all()
    assert np.isfinite(chain.bulges).all()


def test_huge_offsets_do_not_spoil_the_bound():
    curve = LimitCurve(np.add(SHAPE, 1e7), PRESETS["Calm"].mask, True)
    chain = arcs(curve, 0.01)
    assert len(chain.points) <= 70
    assert furthest_from(chain, dense_points(curve, 7)) <= chain.deviation <= 0.01


def test_long_curves_are_cut_in_lanes_without_a_gap():
    angle = np.linspace(0, 40 * np.pi, 3000)
    spiral = LimitCurve(
        angle[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1),
        PRESETS["Tight"].mask,
        False,
    )
    chain = arcs(spiral, 0.0001)
    assert chain.smooth
    before, after = tangents_of(chain)
    assert abs(np.angle(before[1:] / after[:-1])).max() < 1e-9
    assert furthest_from(chain, dense_points(spiral, 2)[::7]) <= chain.deviation <= 0.0001


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan")])
def test_tolerances_must_be_positive(tolerance):
    with pytest.raises(NinepointError, match="greater than 0"):
        arcs(LimitCurve(SHAPE, PRESETS["Calm"].mask, True), tolerance)


def test_divergent_members_are_refused_in_a_sentence():
    with pytest.raises(NinepointError, match="No deviation can be proven"):
        arcs(LimitCurve(SHAPE, Parameters(50, 0, 0).mask, True), 0.01)
