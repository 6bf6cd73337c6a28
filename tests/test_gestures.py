"""Gestures: derived from where they began, so that nothing drifts and Escape is exact."""

import numpy as np
import pytest

from app.gestures import MovePoints, Pan, Pointer, PullCurve, RubberBand, one_axis
from app.handles import CurveHit, PointHit
from app.session import Selection
from mouse import Mouse, boat, by, shown


@pytest.fixture
def canvas(qtbot):
    return shown(qtbot, boat())


def test_the_larger_component_is_kept():
    np.testing.assert_array_equal(one_axis(np.array([3.0, -5.0])), [0, -5])
    np.testing.assert_array_equal(one_axis(np.array([-5.0, 3.0])), [-5, 0])
    np.testing.assert_array_equal(one_axis(np.array([2.0, 2.0])), [2, 0])


def test_a_thousand_small_moves_end_where_one_large_move_does(canvas):
    start = Mouse(canvas).point(3)
    ends = []
    for stops in (np.linspace(0, 1, 1000), [1.0]):
        gesture = MovePoints(canvas, Pointer(start), PointHit(0, 3, 0.0))
        for share in stops:
            gesture.move(Pointer(start + share * np.array([70.0, 31.0])))
        ends.append(canvas.session.document.curves[0].points.copy())
        gesture.cancel()
    np.testing.assert_array_equal(ends[0], ends[1])


def test_a_pull_is_the_least_change_that_lands(canvas):
    document = canvas.session.document
    curve, t = document.curves[0], 3.5
    place = curve.limit(document.parameters).at(t)
    start = canvas.camera.to_pixels(place)
    gesture = PullCurve(canvas, Pointer(start), CurveHit(0, t, 0.0))
    gesture.move(Pointer(start + by(20.0, -40.0)))
    after = canvas.session.document.curves[0]
    way = np.array([20.0, 40.0]) / canvas.camera.scale
    np.testing.assert_allclose(
        after.limit(document.parameters).at(t), place + way, atol=1e-9
    )
    change = after.points - curve.points
    # Least norm: parallel to the weights, hence all points move in the direction of the hand.
    np.testing.assert_allclose(change[:, 0] * way[1], change[:, 1] * way[0], atol=1e-9)
    (influence,) = gesture.overlay.influences
    expected = np.zeros((len(change), 2))
    expected[influence.indices] = np.outer(influence.shares, way)
    np.testing.assert_allclose(change, expected, atol=1e-9)
    gesture.finish()
    assert canvas.session.undo_name == "Pull curve"


def test_a_gesture_that_the_session_has_ended_is_dead(canvas):
    start = Mouse(canvas).point(3)
    gesture = MovePoints(canvas, Pointer(start), PointHit(0, 3, 0.0))
    gesture.move(Pointer(start + by(20, 0)))
    assert gesture.is_alive
    canvas.session.commit()
    assert not gesture.is_alive
    canvas.session.begin("Set beta")
    assert not gesture.is_alive


def test_panning_back_is_exact(canvas):
    before = canvas.camera
    gesture = Pan(canvas, Pointer(np.array([100.0, 100.0])))
    gesture.move(Pointer(np.array([333.0, 17.0])))
    assert canvas.camera != before
    gesture.cancel()
    assert canvas.camera == before


def test_a_rubber_band_makes_the_caught_curve_active_only_if_it_must(canvas):
    document = canvas.session.document
    other = document.curves[0].moved(range(8), document.curves[0].points + by(300.0, 0.0))
    canvas.session.edit(document.with_curve_added(other), "Add")
    canvas.fit_all()
    canvas.session.select(Selection(curve=1))
    gesture = RubberBand(canvas, Pointer(np.zeros(2)))
    gesture.move(Pointer(np.array([900.0, 600.0])))
    assert len(canvas.session.selection.points) == 16
    assert canvas.session.selection.curve == 1
    gesture.move(Pointer(canvas.camera.to_pixels((200.0, -50.0))))
    assert {curve for curve, _ in canvas.session.selection.points} == {0}
    assert canvas.session.selection.curve == 0
