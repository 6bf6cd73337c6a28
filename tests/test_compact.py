"""What is kept of a short curve holds for each view of it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.camera import Camera
from app.compact import SHORT, Compact
from app.drawn import traced
from app.figure import Figure
from app.spans import SpanVertices
from core.affine import IDENTITY, Affine
from core.document import Curve
from core.family import PRESETS, Parameters
from core.live import LiveCurve
from oracles import convergent_members

TURN = Affine(np.array([[0.6, -0.8], [0.8, 0.6]]), np.array([30.0, -20.0]))


def scribble(count, seed, closed=True):
    return Curve(np.random.default_rng(seed).uniform(-50, 50, (count, 2)), closed)


@given(convergent_members(), st.integers(2, SHORT), st.booleans(), st.integers(0, 99))
def test_the_box_holds_curve_and_polygon(member, count, closed, seed):
    curve = scribble(count, seed, closed)
    limit = LiveCurve(curve.points, member.mask, curve.is_loop)
    left, bottom, right, top = Compact(
        curve, limit, IDENTITY, SpanVertices(range(limit.spans))
    ).box
    points = np.concatenate([limit.points(6), curve.points])
    assert (points >= np.array([left, bottom]) - 1e-9).all()
    assert (points <= np.array([right, top]) + 1e-9).all()


@pytest.mark.parametrize("placed", [IDENTITY, TURN])
def test_a_carried_curve_is_where_it_was_carried(placed):
    curve = scribble(20, 1)
    figure = Figure(curve, PRESETS["Tight"])
    before = figure.compact
    assert figure.follow(curve.carried(placed), PRESETS["Tight"])
    t, points = figure.compact.vertices(0.01)
    _, known = before.vertices(0.01)
    if placed is IDENTITY:
        np.testing.assert_array_equal(points, known)
    else:
        expected = placed(LiveCurve(curve.points, PRESETS["Tight"].mask, True).points(6))
        at = np.rint(t * 64).astype(int) % len(expected)
        np.testing.assert_allclose(points, expected[at], atol=1e-9)


def test_it_is_kept_while_the_view_moves_and_dropped_with_a_change():
    curve = scribble(20, 2)
    figure = Figure(curve, PRESETS["Calm"])
    kept = figure.compact
    for x in range(5):
        traced(figure, Camera(x_mm=float(x)), 1.0)
    assert figure.compact is kept
    figure.follow(curve.moved([3], [(1.0, 2.0)]), PRESETS["Calm"])
    assert figure.compact is not kept
    kept = figure.compact
    figure.follow(figure.curve, Parameters("1/10", "-1/2", 0))
    assert figure.compact is not kept


def test_a_curve_out_of_view_is_not_evaluated(monkeypatch):
    figure = Figure(scribble(20, 3), PRESETS["Calm"])
    monkeypatch.setattr("app.spans.SpanVertices.of", None)
    drawn = traced(figure, Camera(x_mm=5000.0), 1.0)
    assert len(drawn.vertices_px) == len(drawn.polygon.vertices) == 0
    assert drawn.shown.tolist() == []


def test_a_longer_curve_has_none():
    assert Figure(scribble(SHORT + 1, 4), PRESETS["Calm"]).compact is None
