"""A figure follows moves, however they come about, and refuses what are no moves."""

import numpy as np
import pytest

from app.figure import COMPARED, Figure, differing
from core.affine import Affine
from core.document import Curve
from core.errors import NoLimitError
from core.family import PRESETS
from core.view import view

CALM = PRESETS["Calm"]


def circle(count, closed=True):
    angle = np.linspace(0, 6, count)
    return Curve(50 * np.stack([np.cos(angle), np.sin(angle)], axis=-1), closed)


def seen(pyramid):
    return view(pyramid, np.full(2, -99.0), np.full(2, 99.0), 0.01)


@pytest.mark.parametrize("count", [2, 5, 30, 5000])
@pytest.mark.parametrize("closed", [True, False])
def test_a_figure_that_followed_is_that_of_the_curve(count, closed):
    rng = np.random.default_rng(count)
    curve = circle(count, closed)
    figure = Figure(curve, CALM)
    for _ in range(6):
        curve = curve.moved(rng.integers(0, count, 2), rng.uniform(-60, 60, (2, 2)))
        assert figure.follow(curve, CALM)
    anew = Figure(curve, CALM)
    np.testing.assert_allclose(figure.limit.points(3), anew.limit.points(3), atol=1e-12)
    for mine, other in ((figure.outline, anew.outline), (figure.polygon, anew.polygon)):
        np.testing.assert_allclose(seen(mine).vertices, seen(other).vertices, atol=1e-12)


def test_there_and_back_is_exact():
    curve = circle(5000)
    figure = Figure(curve, CALM)
    before = seen(figure.outline).vertices
    assert figure.follow(curve.moved([3, 4000], (70.0, 80.0)), CALM)
    assert figure.follow(curve, CALM)
    np.testing.assert_array_equal(seen(figure.outline).vertices, before)


def test_what_is_no_move_is_not_followed():
    figure = Figure(circle(30), CALM)
    for other in (circle(31), circle(30, closed=False)):
        assert not figure.follow(other, CALM)
    assert figure.curve.count == 30
    large = circle(COMPARED + 1)
    assert not Figure(large, CALM).follow(Curve(large.points), CALM)


def test_strangers_of_a_few_points_are_compared():
    curve = circle(30)
    other = Curve(curve.points).moved([4], (1.0, 1.0))
    assert differing(curve, other).tolist() == [4]


def test_spans_are_told_without_a_change():
    figure = Figure(circle(5000), CALM)
    (spans,) = figure.touched(np.array([100]))
    assert spans.start < 100 < spans.stop
    assert len(spans) <= 18
    np.testing.assert_array_equal(figure.limit.control_points, figure.curve.points)


def test_without_a_limit_there_is_a_polygon_until_there_is_one(monkeypatch):
    def refuse(mask):
        raise NoLimitError("no limit")

    monkeypatch.setattr("app.figure.bounds", refuse)
    curve = circle(30)
    figure = Figure(curve, CALM)
    assert figure.limit is figure.outline is None
    assert not figure.is_proven
    assert len(seen(figure.polygon).vertices) > 20
    moved = curve.moved([3], (0.0, 0.0))
    monkeypatch.undo()
    assert figure.follow(moved, PRESETS["Tight"])
    anew = Figure(moved, PRESETS["Tight"])
    np.testing.assert_allclose(seen(figure.outline).vertices, seen(anew.outline).vertices)


@pytest.mark.parametrize("count", [2, 5, 30, 5000])
@pytest.mark.parametrize("closed", [True, False])
def test_another_scheme_is_followed(count, closed):
    curve = circle(count, closed)
    figure = Figure(curve, CALM)
    for name in ("Tight", "Lean", "Lagrange"):
        curve = curve.moved([count // 2], (count, len(name)))
        assert figure.follow(curve, PRESETS[name])
        anew = Figure(curve, PRESETS[name])
        np.testing.assert_allclose(figure.limit.points(3), anew.limit.points(3), atol=1e-12)
        for mine, other in ((figure.outline, anew.outline), (figure.polygon, anew.polygon)):
            np.testing.assert_allclose(seen(mine).vertices, seen(other).vertices, atol=1e-12)


@pytest.mark.parametrize("count", [30, 5000])
def test_a_curve_that_is_carried_is_followed_through_its_place(count):
    curve = circle(count)
    figure = Figure(curve, CALM)
    for step in range(3):
        curve = curve.carried(Affine.shift((3.5, -1.25))).moved([1], (step, step))
        assert figure.follow(curve, CALM)
        points = figure.placed(figure.limit.control_points)
        np.testing.assert_allclose(points, curve.points, atol=1e-12)
        anew = Figure(curve, CALM)
        assert (figure.placed.offset == (3.5 * (step + 1), -1.25 * (step + 1))).all()
        for mine, other in ((figure.outline, anew.outline), (figure.polygon, anew.polygon)):
            low, high = np.full(2, -99.0), np.full(2, 99.0)
            placed = view(mine, low, high, 0.01, placed=figure.placed)
            np.testing.assert_allclose(placed.vertices, seen(other).vertices, atol=1e-12)
    stranger = Curve(curve.points).moved([0], (9.0, 9.0))
    assert not figure.follow(stranger, CALM)
