"""Cubics that touch, within a tolerance; each stated deviation is measured again by brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.bends import ChordBounds
from core.beziers import beziers
from core.continuity import smoothness
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from oracles import convergent_members

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]
STEPS = 150


def drawn(chain):
    """Points on the cubics by de Casteljau's algorithm, one row of complex numbers."""
    level = (chain.controls @ (1, 1j))[:, :, None]
    u = np.linspace(0, 1, STEPS + 1)
    while level.shape[1] > 1:
        level = (1 - u) * level[:, :-1] + u * level[:, 1:]
    return level[:, 0, :].ravel()


def drawing_error(chain):
    """How far the cubics can leave the polygon of `drawn`: a bound by their second differences."""
    bends = np.abs(np.diff(chain.controls @ (1, 1j), n=2, axis=1))
    return 6 * bends.max(initial=0) / (8 * STEPS**2)


def furthest(points, polygon):
    """Largest distance of points from a polygon, both complex."""
    start, way = polygon[:-1], np.diff(polygon)
    square = np.where(way == 0, 1, abs(way) ** 2)
    away = 0.0
    for block in np.array_split(points, -(-len(points) // 200)):
        off = block[:, None] - start
        share = np.clip((off * way.conj()).real / square, 0, 1)
        away = max(away, abs(off - share * way).min(axis=1).max())
    return away


def dense_points(curve, level):
    points = curve.points(level) @ (1, 1j)
    return np.append(points, points[:1]) if curve.closed else points


def is_a_chain(chain):
    ends = np.roll(chain.controls[:, 3], 1, axis=0)
    gaps = (ends != chain.controls[:, 0]).any(axis=1)
    return not (gaps if chain.closed else gaps[1:]).any()


def corners(chain):
    """Angles between neighbours, from their handles."""
    z = chain.controls @ (1, 1j)
    turns = np.angle((z[:, 1] - z[:, 0]) / np.roll(z[:, 3] - z[:, 2], 1))
    return abs(turns if chain.closed else turns[1:])


@given(
    st.one_of(convergent_members(), st.sampled_from(list(PRESETS.values()))),
    st.integers(2, 8),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([5.0, 0.3, 0.03]),
)
def test_curve_and_cubics_keep_to_each_other(parameters, n, seed, closed, tolerance):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    curve = LimitCurve(points, parameters.mask, closed)
    try:
        chain = beziers(curve, tolerance)
    except NinepointError:
        # Refused as too rough, which nearly continuous curves only are.
        assert smoothness(parameters.mask).exponent.lower < 4 / 5
        return
    assert chain.closed == closed
    assert chain.deviation <= tolerance
    assert is_a_chain(chain)
    dense, line = dense_points(curve, 9), drawn(chain)
    if len(chain.controls) < 300:
        assert furthest(dense, line) <= chain.deviation + drawing_error(chain)
        assert furthest(line[::10], dense) <= chain.deviation + ChordBounds(curve).at(9).max()
    if not closed:
        assert chain.controls[0, 0].tolist() == points[0].tolist()
        assert chain.controls[-1, 3].tolist() == points[-1].tolist()


@given(
    st.sampled_from(list(PRESETS.values())), st.integers(3, 8), st.integers(0, 10**6), st.booleans()
)
def test_neighbours_have_a_common_tangent(parameters, n, seed, closed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(n, 2))
    chain = beziers(LimitCurve(points, parameters.mask, closed), 0.01)
    assert chain.smooth
    assert corners(chain).max(initial=0) < 1e-9


@given(convergent_members(["mirrored"]), st.integers(0, 10**6))
def test_smooth_is_said_only_of_what_is_smooth(parameters, seed):
    points = np.random.default_rng(seed).uniform(0, 30, size=(6, 2))
    try:
        chain = beziers(LimitCurve(points, parameters.mask, True), 0.1)
    except NinepointError:
        return
    if chain.smooth:
        assert smoothness(parameters.mask).order >= 1
        assert corners(chain).max() < 1e-6


@pytest.mark.parametrize(("name", "uniform"), [("Calm", 27), ("Tight", 19)])
def test_far_fewer_cubics_than_by_cutting_uniformly(name, uniform):
    chain = beziers(LimitCurve(SHAPE, PRESETS[name].mask, True), 0.01)
    assert len(chain.controls) <= 0.6 * uniform


@pytest.mark.parametrize("name", PRESETS)
def test_the_ends_lie_on_the_curve(name):
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    exact = curve.points(12)
    for x, y in beziers(curve, 0.01).controls[:, 0]:
        assert np.hypot(*(exact - (x, y)).T).min() < 1e-9


def test_a_straight_polygon_is_one_straight_cubic():
    for count in (2, 6, 1000):
        straight = np.outer(np.arange(count), [3.0, 4.0])
        chain = beziers(LimitCurve(straight, PRESETS["Calm"].mask, False), 0.01)
        (control,) = chain.controls
        assert control[[0, 3]].tolist() == straight[[0, -1]].tolist()
        np.testing.assert_allclose(control @ (4, -3), 0, atol=1e-9)


def test_a_curve_that_turns_back_keeps_its_bound():
    for name in PRESETS:
        curve = LimitCurve([(0, 0), (30, 0), (10, 0), (40, 0)], PRESETS[name].mask, False)
        chain = beziers(curve, 0.01)
        found = furthest(dense_points(curve, 9), drawn(chain))
        assert found <= chain.deviation + drawing_error(chain) <= 0.011
        assert len(chain.controls) < 20


def test_coincident_points_leave_no_dots():
    points = np.repeat([(0, 0), (10, 0), (10, 10), (0, 10)], 10, axis=0)
    for closed in (True, False):
        for name in PRESETS:
            curve = LimitCurve(points, PRESETS[name].mask, closed)
            chain = beziers(curve, 0.01)
            assert is_a_chain(chain)
            assert (chain.controls != chain.controls[:, :1]).any(axis=(1, 2)).all()
            found = furthest(dense_points(curve, 4), drawn(chain))
            assert found <= chain.deviation + drawing_error(chain) <= 0.011
            assert len(chain.controls) < 120


@pytest.mark.parametrize("n", [0, 1])
def test_a_dot_has_no_cubics(n):
    chain = beziers(LimitCurve(np.full((n, 2), 5.0), PRESETS["Calm"].mask, False), 0.01)
    assert chain.controls.shape == (0, 4, 2)
    assert chain.deviation == 0


def test_a_tolerance_beyond_the_size_of_a_closed_curve_leaves_a_closed_chain():
    chain = beziers(LimitCurve(SHAPE, PRESETS["Calm"].mask, True), 1000)
    assert len(chain.controls) >= 3
    assert np.isfinite(chain.controls).all()
    assert is_a_chain(chain)


def test_huge_offsets_do_not_spoil_the_bound():
    curve = LimitCurve(np.add(SHAPE, 1e7), PRESETS["Calm"].mask, True)
    chain = beziers(curve, 0.01)
    assert len(chain.controls) <= 16
    found = furthest(dense_points(curve, 7), drawn(chain))
    assert found <= chain.deviation + drawing_error(chain)
    assert chain.deviation <= 0.01


def test_long_curves_are_cut_in_lanes_without_a_gap():
    angle = np.linspace(0, 40 * np.pi, 3000)
    spiral = LimitCurve(
        angle[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1),
        PRESETS["Tight"].mask,
        False,
    )
    chain = beziers(spiral, 0.0001)
    assert chain.smooth
    assert is_a_chain(chain)
    assert corners(chain).max() < 1e-9
    assert chain.deviation <= 0.0001


def test_members_without_proven_tangents_give_lines():
    rough = Parameters("3/10", "-1/2", "-1/3", "mirrored")
    assert smoothness(rough.mask).order == 0
    curve = LimitCurve(SHAPE, rough.mask, True)
    chain = beziers(curve, 0.5)
    assert not chain.smooth
    np.testing.assert_allclose(np.diff(chain.controls, n=2, axis=1), 0, atol=1e-12)
    assert furthest(dense_points(curve, 8), drawn(chain)) <= chain.deviation <= 0.5


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan")])
def test_tolerances_must_be_positive(tolerance):
    with pytest.raises(NinepointError, match="greater than 0"):
        beziers(LimitCurve(SHAPE, PRESETS["Calm"].mask, True), tolerance)


def test_divergent_members_are_refused_in_a_sentence():
    with pytest.raises(NinepointError, match="No deviation can be proven"):
        beziers(LimitCurve(SHAPE, Parameters(50, 0, 0).mask, True), 0.01)
