"""Chords whose deviation follows from second derivatives, and how closely they may lie."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chords import KINDS, bounds, deviation, polygon, some_places
from core.bent import Bending
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.shape import curvatures, tangents
from effort import costly
from oracles import convergent_members

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


@costly
@given(
    convergent_members(["translated"]),
    KINDS,
    st.integers(3, 40),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([0.1, 1e-2, 1e-4]),
)
def test_the_curve_keeps_within_the_bound_of_any_chord(
    parameters, kind, count, seed, closed, tolerance
):
    curve = LimitCurve(polygon(kind, seed, count), parameters.mask, closed)
    bending = Bending.of(curve, tolerance)
    if bending is None:
        return
    for part in bending.parts():
        stretch = bending.stretch(part)
        places = some_places(stretch, seed)
        for chord, bound in zip(pairwise(places), bounds(stretch, places), strict=True):
            assert deviation(stretch, *chord) <= bound


@given(st.integers(0, 10**6), st.sampled_from([20, 100, 128, 200, 500]))
def test_bounds_are_those_of_the_notes_however_many_knots_are_between(seed, width):
    """The notes chord by chord: A and B, and at each knot between, the kink of the polygon."""
    curve = LimitCurve(polygon("rough", seed, 8), PRESETS["Calm"].mask, True)
    bending = Bending.of(curve, 1e-3)
    stretch = bending.stretch(*bending.parts())
    step = 1 << (bending.place_level - bending.level)
    knots = np.arange(stretch._bends.shape[1]) * step
    rng = np.random.default_rng(seed)
    first = np.sort(rng.integers(0, int(knots[-1]) - width, 30))
    last = first + width
    start, stop = stretch.at(first), stretch.at(last)
    found = stretch._off_lines(first, last, stop - start)
    for begin, end, way, off in zip(first, last, (stop - start).T, found, strict=True):
        inner = knots[(knots > begin) & (knots < end)]
        x, y = (np.interp([begin, *inner, end], knots, values) for values in stretch._bends)
        values = way[0] * y - way[1] * x
        line = np.interp([begin, *inner, end], [begin, end], values[[0, -1]])
        expected = abs(values[0] + values[-1]) / 2 + abs(values[-1] - values[0]) / np.sqrt(243)
        expected += abs(values - line).max()
        assert off == pytest.approx(expected, rel=1e-9, abs=1e-12)


@given(st.integers(0, 10**6), st.sampled_from(list(PRESETS)))
def test_bounds_of_chords_that_fit_are_hardly_larger_than_their_deviations(seed, name):
    curve = LimitCurve(polygon("rough", seed, 8), PRESETS[name].mask, True)
    bending = Bending.of(curve, 1e-4)
    stretch = bending.stretch(*bending.parts())
    places = stretch.density().cuts(stretch.fixed(), 3)
    chords, found = list(pairwise(places))[::20], bounds(stretch, places)[::20]
    seen = [deviation(stretch, *chord) for chord in chords]
    assert np.median(seen / found) >= 0.92


@pytest.mark.parametrize("name", ["B-spline", "Tight"])
def test_a_parabola_is_as_far_from_its_chords_as_they_ask(name):
    """The schemes generate parabolas: a chord over h lies ``h^2 / 4`` below, seen upright."""
    t = np.arange(80.0) - 40
    curve = LimitCurve(np.stack([t, t**2], axis=1), PRESETS[name].mask, False)
    bending = Bending.of(curve, 1e-3)
    assert bending.parts() == [(0, 79)]
    stretch = bending.stretch((0, 79))
    # Where nothing is read beyond the ends.
    first = np.arange(20, 58) << bending.place_level
    for width in (20, 300, 1024):
        last = first + (width << (bending.place_level - 10))
        start, stop = stretch.at(first), stretch.at(last)
        way = stop - start
        upright = way[0] ** 2 / 4
        found = stretch.deviations(first, last, start, stop, 0.0)
        expected = upright * way[0] / np.hypot(*way)
        assert (found >= expected).all()
        unmeasured = expected < 1e-3
        np.testing.assert_allclose(found[unmeasured], expected[unmeasured], rtol=1e-6, atol=1e-10)


@pytest.mark.parametrize("name", ["B-spline", "Calm", "Lagrange", "Tight"])
def test_an_inflection_is_as_far_from_its_chord_as_it_asks(name):
    """The schemes generate cubics: x^3 leaves its chord from -w to w by ``2 w^3 / sqrt(27)``."""
    t = np.arange(80.0) - 40
    curve = LimitCurve(np.stack([t, t**3], axis=1), PRESETS[name].mask, False)
    bending = Bending.of(curve, 1e-2)
    stretch = bending.stretch((0, 79))
    for width in (10, 60, 120):
        w = width / 1024
        half, middle = width << (bending.place_level - 10), 40 << bending.place_level
        first, last = np.array([middle - half]), np.array([middle + half])
        start, stop = stretch.at(first), stretch.at(last)
        way = stop - start
        expected = 2 * w**3 / np.sqrt(27) * way[0] / np.hypot(*way)
        found = stretch.deviations(first, last, start, stop, 0.0)
        assert expected <= found <= expected * (1 + 1e-6) + 1e-8


@pytest.mark.parametrize("name", PRESETS)
def test_the_density_is_that_of_the_curvature(name):
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    bending = Bending.of(curve, 0.001)
    stretch = bending.stretch(*bending.parts())
    speed = np.hypot(*tangents(curve, 11).T)
    needed = np.sqrt(np.abs(curvatures(curve, 11)) / (8 * 0.001)) * speed / 2**11
    found = stretch.density().sums
    assert found[-1] == pytest.approx(needed.sum(), rel=0.02)
    half = found[len(found) // 2]
    assert half == pytest.approx(needed[: len(needed) // 2].sum(), rel=0.02)


@given(convergent_members(["translated"]), st.integers(0, 10**6), st.booleans())
def test_places_are_exact_points_of_the_curve(parameters, seed, closed):
    curve = LimitCurve(polygon("rough", seed, 9), parameters.mask, closed)
    bending = Bending.of(curve, 1e-3)
    if bending is None:
        return
    stretch = bending.stretch(*bending.parts())
    last = curve.spans << bending.place_level
    places = np.unique([0, *np.random.default_rng(seed).integers(0, last, 30), last])
    exact = np.array([curve.at(t) for t in places * 0.5**bending.place_level])
    np.testing.assert_allclose(stretch.at(places).T, exact, rtol=0, atol=1e-10)
    if not closed:
        assert stretch.at(places)[:, [0, -1]].T.tolist() == curve.control_points[[0, -1]].tolist()


def test_long_curves_are_cut_into_all_of_their_spans():
    rng = np.random.default_rng(0)
    points = np.cumsum(rng.normal(size=(30_000, 2)), axis=0)
    points[:200] *= 30
    bending = Bending.of(LimitCurve(points, PRESETS["Calm"].mask, True), 1e-3)
    parts = bending.parts()
    assert len(parts) > 2
    assert parts[0][0] == 0
    assert parts[-1][1] == 30_000
    assert all(a[1] == b[0] < b[1] for a, b in pairwise(parts))


def test_it_is_told_where_second_derivatives_do_not_serve():
    def of(points, parameters, tolerance):
        return Bending.of(LimitCurve(points, parameters.mask, True), tolerance)

    calm = PRESETS["Calm"]
    assert of(SHAPE, calm, 0.01) is not None
    assert of(SHAPE, calm, 100.0) is None  # chords longer than spans
    assert of(SHAPE, calm, 1e-9) is None  # more chords in a span than there are places
    assert of(np.array(SHAPE) + 1e12, calm, 0.01) is None  # no digits are left
    assert of(SHAPE, Parameters(0, 1, 0), 0.01) is None  # not C^2
    assert of(SHAPE, Parameters(1, 0, 0, "mirrored"), 0.01) is None  # nor this, for another reason
    assert of([(5, 5)] * 20, calm, 0.01) is None  # a dot
