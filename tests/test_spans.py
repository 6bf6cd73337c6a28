"""Spans drawn one by one keep to the tolerance, and take no more vertices than they need."""

import numpy as np
import pytest

from app.spans import FINEST, SpanVertices
from core.family import PRESETS
from core.limit import LimitCurve

POINTS = np.random.default_rng(5).uniform(0, 100, (40, 2))


@pytest.mark.parametrize("member", PRESETS)
@pytest.mark.parametrize("closed", [True, False])
def test_vertices_lie_on_the_curve_and_chords_near_it(member, closed):
    limit = LimitCurve(POINTS, PRESETS[member].mask, closed)
    t, points = SpanVertices(range(3, 12)).of(limit, 0.05)
    assert (t[0], t[-1]) == (3, 12)
    assert (np.diff(t) > 0).all()
    np.testing.assert_allclose(points, [limit.at(place) for place in t], atol=1e-9)
    start, way = points[:-1], np.diff(points, axis=0)
    for share in (0.25, 0.5, 0.75):
        on_curve = np.array([limit.at(place) for place in t[:-1] + share * np.diff(t)])
        assert np.hypot(*(on_curve - start - share * way).T).max() <= 0.05


def test_a_straight_line_takes_one_chord_a_span():
    line = np.stack([np.arange(20.0), np.zeros(20)], axis=-1)
    t, _ = SpanVertices(range(19)).of(LimitCurve(line, PRESETS["Calm"].mask, False), 1e-6)
    assert t.tolist() == list(range(20))


def test_what_is_too_fine_is_refused():
    limit = LimitCurve(POINTS, PRESETS["Calm"].mask, True)
    assert SpanVertices(range(40)).of(limit, 100 * 4.0 ** -(FINEST + 3)) is None
