import itertools

import numpy as np
import pytest

from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.formats.fitted import fitted
from core.formats.outlines import straight
from core.formats.sketch import Sketch, Trace

WAVE = Trace(
    np.array([[(0, 0), (20, 40), (40, -20), (60, 20)], [(60, 20), (80, 60), (90, 90), (20, 80)]])
    .astype(float), False, "Wave",
)  # fmt: skip


def line(start, end):
    ends = np.array([start, end], dtype=float)
    return Trace(straight(ends[:1], ends[1:]), False)


def circle(radius=20.0, deviation=0.0):
    k = 0.5522847498
    quarter = np.array([(1, 0), (1, k), (k, 1), (0, 1)])
    turn = np.array([[0, 1], [-1, 0]])
    turns = [np.linalg.matrix_power(turn, count) for count in range(4)]
    return Trace(np.array([quarter @ turn for turn in turns]) * radius, True, "", "Cut", deviation)


def dense(trace, count=200):
    """Points on the cubics, by de Casteljau's algorithm."""
    t = np.linspace(0, 1, count)[:, None, None]
    row = [trace.controls[None, :, index] for index in range(4)]
    while len(row) > 1:
        row = [(1 - t) * a + t * b for a, b in itertools.pairwise(row)]
    return row[0].reshape(-1, 2)


def largest_gap(points, others):
    return max(float(np.hypot(*(others - point).T).min()) for point in points)


@pytest.mark.parametrize("name", ["Calm", "Tight", "B-spline"])
@pytest.mark.parametrize("trace", [WAVE, circle()])
def test_the_curves_keep_within_what_is_claimed(trace, name):
    tolerance = 0.05
    document, deviation = fitted(Sketch((trace,), "mm", True), PRESETS[name], tolerance)
    (curve,) = document.curves
    assert document.parameters is PRESETS[name]
    assert 0 < deviation <= tolerance
    assert curve.closed == trace.closed
    own = curve.limit(document.parameters).points(9)
    there = dense(trace, 2000)
    step = 0.05  # between neighbours of the dense points
    assert largest_gap(own[::8], there) <= deviation + step
    assert largest_gap(there[::40], own) <= deviation + step


def test_each_trace_becomes_a_curve_in_order_with_its_name():
    sketch = Sketch((WAVE, circle(), line((0, 0), (5, 5))), "mm", True)
    counts = []
    document, _ = fitted(sketch, None, 0.1, told=counts.append)
    assert [curve.name for curve in document.curves] == ["Wave", "Cut", "Curve 3"]
    assert document.curves[2].points.tolist() == [[0, 0], [5, 5]]
    assert counts == [1, 2, 3]
    assert document.parameters is PRESETS["Calm"]


def test_a_dot_stays_a_dot():
    sketch = Sketch((line((3, 4), (3, 4)), WAVE), "mm", True)
    document, deviation = fitted(sketch, None, 0.1)
    assert document.curves[0].points.tolist() == [[3, 4]]
    assert deviation <= 0.1


def test_what_the_reader_lost_counts_towards_the_tolerance():
    exact, _ = fitted(Sketch((circle(),), "mm", True), None, 0.1)
    document, deviation = fitted(Sketch((circle(deviation=0.09),), "mm", True), None, 0.1)
    assert 0.09 < deviation <= 0.1
    assert document.curves[0].count >= exact.curves[0].count


@pytest.mark.parametrize(
    ("sketch", "parameters", "tolerance", "words"),
    [
        (Sketch((WAVE,), "mm", True), None, 0.0, "greater than 0"),
        (Sketch((circle(deviation=1.0),), "mm", True), None, 0.1, "larger tolerance"),
        (Sketch((WAVE, circle(deviation=1.0)), "mm", True), None, 0.1, "Contour 2 (Cut): "),
        (Sketch((circle(2e9),), "mm", True), None, 0.1, "smaller unit"),
        (Sketch((WAVE,), "mm", True), Parameters(10, 0, 0), 0.1, "Take the vertices"),
    ],
)
def test_what_cannot_be_fitted_is_said(sketch, parameters, tolerance, words):
    with pytest.raises(NinepointError) as caught:
        fitted(sketch, parameters, tolerance)
    assert words in str(caught.value)


def test_it_ends_when_it_is_cancelled():
    done = []
    with pytest.raises(NinepointError, match="stopped"):
        fitted(
            Sketch((WAVE,) * 50, "mm", True), None, 0.05, cancelled=lambda: bool(done),
            told=done.append,
        )  # fmt: skip
    assert done == [1]
