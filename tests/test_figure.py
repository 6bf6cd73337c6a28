"""A figure follows moves, however they come about, and refuses what are no moves."""

import numpy as np
import pytest

from app.figure import COMPARED, Figure, differing
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
        assert figure.follow(curve)
    anew = Figure(curve, CALM)
    np.testing.assert_allclose(figure.limit.points(3), anew.limit.points(3), atol=1e-12)
    for mine, other in ((figure.outline, anew.outline), (figure.polygon, anew.polygon)):
        np.testing.assert_allclose(seen(mine).vertices, seen(other).vertices, atol=1e-12)


def test_there_and_back_is_exact():
    curve = circle(5000)
    figure = Figure(curve, CALM)
    before = seen(figure.outline).vertices
    assert figure.follow(curve.moved([3, 4000], (70.0, 80.0)))
    assert figure.follow(curve)
    np.testing.assert_array_equal(seen(figure.outline).vertices, before)


def test_what_is_no_move_is_not_followed():
    figure = Figure(circle(30), CALM)
    for other in (circle(31), circle(30, closed=False)):
        assert not figure.follow(other)
    assert figure.curve.count == 30
    large = circle(COMPARED + 1)
    assert not Figure(large, CALM).follow(Curve(large.points))


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


def test_without_a_limit_there_is_a_polygon(monkeypatch):
    def refuse(points, mask, closed):
        raise NoLimitError("no limit")

    monkeypatch.setattr("app.figure.LiveCurve", refuse)
    figure = Figure(circle(30), CALM)
    assert figure.limit is figure.outline is None
    assert len(seen(figure.polygon).vertices) > 20
    assert not figure.follow(circle(30))
