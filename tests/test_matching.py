"""The proven distance of a curve and a route, for any places; settling brings them near."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from chains import chain, dense, furthest, lines
from core.family import PRESETS
from core.limit import LimitCurve
from core.matching import FREE, HELD, deviations, settled
from core.route import Route
from core.squares import SAMPLES, Squares


@given(
    st.sampled_from(list(PRESETS)), st.integers(3, 9), st.booleans(), st.integers(0, 10**6),
    st.sampled_from([10.0, 0.1]),
)
def test_no_point_of_either_is_further_away_than_is_proven(name, spans, closed, seed, admitted):
    rng = np.random.default_rng(seed)
    route = Route(chain(seed, 4, closed), closed, 0.5)
    count = spans if closed else spans + 1
    places = np.sort(rng.uniform(0, route.length, spans * SAMPLES + 1))
    if closed:
        places[-1] = places[0] + route.length
    else:
        places[[0, -1]] = 0, route.length
    near = route.at(places[::SAMPLES])[:count] + rng.normal(size=count)
    curve = LimitCurve(np.stack([near.real, near.imag], axis=1), PRESETS[name].mask, closed)
    found = deviations(route, curve, places, admitted)
    assert found.shape == (spans,)
    line = dense(curve, 7)
    assert furthest(line, route.vertices) <= found.max()
    middles = (route.vertices[1:] + route.vertices[:-1]) / 2
    both = np.concatenate([route.vertices, middles])
    # The dense points are themselves a polygon, which the curve leaves by a little.
    assert furthest(both, line) <= found.max() + 0.02


def test_each_span_answers_for_its_own_part():
    route = Route(lines([(0, 0), (40, 0), (40, 3), (41, 3), (41, 0), (80, 0)], False), False, 0.01)
    points = np.stack([np.linspace(0, 80, 9), np.zeros(9)], axis=1)
    curve = LimitCurve(points, PRESETS["Calm"].mask, False)
    lengths = np.interp(np.arange(8 * SAMPLES + 1) / SAMPLES * 10, [0, 40, 41, 80], [0, 40, 47, 86])
    found = deviations(route, curve, lengths, 0.1)
    assert found[:4].max() < 1e-9
    assert 3 <= found[4] < 3.1
    assert found[5:].max() < 1e-9


def test_a_spike_between_two_samples_counts():
    route = Route(lines([(0, 0), (40.3, 0), (40.3, 9), (40.3, 0), (80, 0)], False), False, 0.01)
    points = np.stack([np.linspace(0, 80, 9), np.zeros(9)], axis=1)
    curve = LimitCurve(points, PRESETS["Calm"].mask, False)
    x = np.arange(8 * SAMPLES + 1) / SAMPLES * 10
    found = deviations(route, curve, np.where(x > 40.3, x + 18, x), 0.1)
    assert 9 <= found.max() < 9.01


def test_free_places_find_the_parameters_of_a_curve():
    polygon = np.array([(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (2, 45)])
    curve = LimitCurve(polygon, PRESETS["Calm"].mask, True)
    fine = curve.points(9)
    route = Route(lines(fine, True), True, 0.01)
    lengths = route.lengths[:: 512 // SAMPLES]
    even = np.linspace(0, route.length, len(lengths))
    squares = Squares(7, curve.mask, True)
    # A fifth of the way from the true places to even ones.
    places = 0.8 * lengths + 0.2 * even
    x, y = route.at(places[:-1]).real, route.at(places[:-1]).imag
    points = squares.solved(np.zeros((7, 2)), x + 1j * y)
    before = deviations(route, LimitCurve(points, curve.mask, True), places, 0.01).max()
    points, places = settled(route, squares, points, places, HELD, 3)
    held = deviations(route, LimitCurve(points, curve.mask, True), places, 0.01).max()
    points, places = settled(route, squares, points, places, FREE, 30)
    free = deviations(route, LimitCurve(points, curve.mask, True), places, 0.01).max()
    assert free < 0.01 < held < before
    assert (np.diff(places) >= 0).all()
    assert places[-1] == places[0] + route.length


def test_corners_keep_a_sample():
    route = Route(lines([(0, 0), (50, 0), (50, 50), (0, 50)], True), True, 0.01)
    squares = Squares(12, PRESETS["Calm"].mask, True)
    places = np.linspace(0, route.length, 12 * SAMPLES + 1) + 0.7
    nodes = route.at(places[::SAMPLES])[:12]
    points = np.stack([nodes.real, nodes.imag], axis=1)
    _, places = settled(route, squares, points, places, FREE, 4)
    at = places[:-1] % route.length
    for corner in (50, 100, 150):
        assert np.abs(at - corner).min() < 1e-9
