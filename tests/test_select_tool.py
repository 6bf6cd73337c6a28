"""Selecting, moving, inserting and pulling with a real mouse; one step of undo for each drag."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.session import Selection
from core.document import MAX_COORDINATE_MM, Curve, Document
from core.family import PRESETS
from mouse import BOAT, SHIFT, Mouse, boat, by, shown

ESC = Qt.Key.Key_Escape
RING = [(40, 20), (52, 14), (64, 20), (64, 32), (52, 38), (40, 32)]


@pytest.fixture
def canvas(qtbot):
    return shown(qtbot, boat().with_curve_added(Curve(RING)))


@pytest.fixture
def session(canvas):
    return canvas.session


@pytest.fixture
def mouse(canvas):
    return Mouse(canvas)


def points(session, curve=0):
    return session.document.curves[curve].points


def selected(session):
    return sorted(session.selection.points)


def steps(session):
    """Names of all steps of undo, the last first; the session is left as it was."""
    names = []
    while session.undo_name is not None:
        names.append(session.undo_name)
        session.undo()
    for _ in names:
        session.redo()
    return names


def test_a_click_selects_the_nearest_point(mouse, session):
    mouse.click(mouse.point(3) + by(5, -5))
    assert selected(session) == [(0, 3)]
    mouse.click(mouse.point(2, curve=1))
    assert selected(session) == [(1, 2)]
    assert session.selection.curve == 1


def test_shift_adds_and_takes_out(mouse, session):
    mouse.click(mouse.point(3))
    mouse.click(mouse.point(5), keys=SHIFT)
    assert selected(session) == [(0, 3), (0, 5)]
    mouse.click(mouse.point(3), keys=SHIFT)
    assert selected(session) == [(0, 5)]


def test_a_click_on_one_of_the_selected_selects_it_alone(mouse, session):
    session.select(Selection(frozenset({(0, 1), (0, 3)})))
    mouse.click(mouse.point(3))
    assert selected(session) == [(0, 3)]


def test_a_click_on_nothing_clears_the_selection(mouse, session):
    mouse.click(mouse.point(3))
    mouse.click((40, 40))
    assert selected(session) == []
    mouse.click(mouse.point(3))
    mouse.click((40, 40), keys=SHIFT)
    assert selected(session) == [(0, 3)]


def test_a_click_on_a_curve_makes_it_the_active_one(mouse, session):
    mouse.click(mouse.on_curve(1.5, curve=1))
    assert session.selection.curve == 1
    assert session.undo_name is None
    mouse.click(mouse.on_curve(6.5))
    assert session.selection.curve == 0


def test_a_rubber_band_selects_what_is_in_it(mouse, session, canvas):
    low, high = mouse.pixels((-5, 0)), mouse.pixels((15, 50))
    mouse.drag(low, (low + high) / 2, high)
    assert selected(session) == [(0, 0), (0, 7)]
    low, high = mouse.pixels((105, 0)), mouse.pixels((125, 50))
    mouse.drag(low, high, keys=SHIFT)
    assert selected(session) == [(0, 0), (0, 2), (0, 3), (0, 7)]
    mouse.drag(low, high)
    assert selected(session) == [(0, 2), (0, 3)]
    assert session.undo_name is None
    assert canvas.overlay.rubber_band is None


def test_escape_in_a_rubber_band_restores_the_selection(mouse, session, canvas):
    mouse.click(mouse.point(3))
    mouse.press(mouse.pixels((-5, 0)))
    mouse.move(mouse.pixels((15, 50)))
    assert selected(session) == [(0, 0), (0, 7)]
    QTest.keyClick(canvas, ESC)
    assert selected(session) == [(0, 3)]
    mouse.release(mouse.pixels((30, 50)))
    assert selected(session) == [(0, 3)]


def test_a_drag_moves_a_point_and_is_one_step(mouse, session):
    start = session.document
    place = mouse.point(4)
    mouse.drag(place + by(4, 3), *(place + by(4 + k, 3 - 2 * k) for k in range(0, 40, 3)))
    way = np.array([39.0, -78.0]) / mouse.canvas.camera.scale * (1, -1)
    np.testing.assert_allclose(points(session)[4], np.array(BOAT[4]) + way, atol=1e-9)
    assert steps(session) == ["Move point"]
    session.undo()
    assert session.document is start


def test_the_release_carries_the_last_position(mouse, session):
    place = mouse.point(4)
    mouse.press(place)
    mouse.release(place + by(60, 0))
    assert points(session)[4, 0] == pytest.approx(80 + 60 / mouse.canvas.camera.scale)


def test_small_moves_count_once_a_drag_has_begun_and_a_tremor_does_not(mouse, session):
    place = mouse.point(4)
    mouse.drag(place, place + by(1, 1))
    assert session.undo_name is None
    mouse.drag(place, place + by(5, 0), place + by(1, 0))
    assert points(session)[4, 0] == pytest.approx(80 + 1 / mouse.canvas.camera.scale)


def test_a_drag_that_returns_is_no_step(mouse, session):
    start = session.document
    place = mouse.point(4)
    mouse.drag(place, place + by(30, 0), place)
    assert session.document is start
    assert session.undo_name is None
    assert not session.in_gesture


def test_all_selected_points_move_together(mouse, session):
    session.select(Selection(frozenset({(0, 1), (0, 3), (1, 0)})))
    place = mouse.point(3)
    mouse.drag(place, place + by(20, 0), place + by(50, 10))
    way = np.array([50, -10]) / mouse.canvas.camera.scale
    before = boat().curves[0].points
    np.testing.assert_allclose(points(session)[[1, 3]], before[[1, 3]] + way)
    np.testing.assert_allclose(points(session, 1)[0], RING[0] + way)
    np.testing.assert_array_equal(points(session)[[0, 2, 4]], before[[0, 2, 4]])
    assert steps(session) == ["Move 3 points"]
    assert len(session.selection.points) == 3


def test_a_drag_of_an_unselected_point_moves_it_alone(mouse, session):
    session.select(Selection(frozenset({(0, 1), (0, 3)})))
    place = mouse.point(5)
    mouse.drag(place, place + by(0, 30))
    assert steps(session) == ["Move point"]
    assert selected(session) == [(0, 5)]


def test_shift_keeps_an_axis_and_acts_at_once(mouse, session, canvas):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(50, 20))
    QTest.keyPress(canvas, Qt.Key.Key_Shift, Qt.KeyboardModifier.ShiftModifier)
    assert points(session)[4, 1] == 40
    assert points(session)[4, 0] == pytest.approx(80 + 50 / canvas.camera.scale)
    QTest.keyRelease(canvas, Qt.Key.Key_Shift)
    assert points(session)[4, 1] == pytest.approx(40 - 20 / canvas.camera.scale)
    mouse.release(place + by(20, 50), keys=SHIFT)
    assert points(session)[4, 0] == 80


def test_escape_restores_the_very_document(mouse, session, canvas):
    start = session.document
    place = mouse.point(4)
    mouse.press(place)
    for k in range(10):
        mouse.move(place + by(5 * k, 3 * k))
    assert session.document is not start
    QTest.keyClick(canvas, ESC)
    assert session.document is start
    mouse.move(place + by(80, 80))
    mouse.release(place + by(90, 90))
    assert session.document is start
    assert session.undo_name is None
    assert selected(session) == [(0, 4)]
    QTest.keyClick(canvas, ESC)
    assert selected(session) == []


def test_a_drag_goes_on_through_a_zoom(mouse, session, canvas):
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    canvas.zoom_by(2.0)
    mouse.move(place + by(21, 0))
    mouse.release()
    held = canvas.camera.to_mm(mouse.place)
    np.testing.assert_allclose(points(session)[4], held, atol=1e-9)


def test_undo_in_a_drag_ends_it(mouse, session):
    start = session.document
    place = mouse.point(4)
    mouse.press(place)
    mouse.move(place + by(20, 0))
    session.undo()
    mouse.move(place + by(40, 0))
    mouse.release(place + by(60, 0))
    assert session.document is start
    assert session.undo_name is None


def test_points_stop_at_the_largest_coordinate(qtbot):
    far = MAX_COORDINATE_MM * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    canvas = shown(qtbot, Document((Curve(far),)))
    mouse = Mouse(canvas)
    place = mouse.point(2)
    mouse.drag(place, place + by(40, 0), place + by(40, -40))
    assert points(canvas.session)[2].max() == MAX_COORDINATE_MM


@pytest.mark.parametrize(("edge", "share"), [(0, 0.5), (3, 0.3), (7, 0.6)])
def test_a_double_click_on_an_edge_inserts_a_point_there(mouse, session, edge, share):
    a, b = np.array(BOAT[edge]), np.array(BOAT[(edge + 1) % 8])
    place = a + share * (b - a)
    mouse.double_click(mouse.pixels(place) + by(2, 1))
    new = points(session)[edge + 1]
    assert len(points(session)) == 9
    across = (b - a)[0] * (new - a)[1] - (b - a)[1] * (new - a)[0]
    assert abs(across) / np.hypot(*(b - a)) < 1e-9
    assert np.hypot(*(new - place)) < 3 / mouse.canvas.camera.scale
    assert selected(session) == [(0, edge + 1)]
    assert steps(session) == ["Insert point"]


def test_a_double_click_on_the_curve_inserts_into_the_edge_of_its_span(mouse, session):
    # Far from the polygon: the belly of the boat, t = 0.5.
    mouse.double_click(mouse.on_curve(0.5))
    assert selected(session) == [(0, 1)]
    np.testing.assert_allclose(points(session)[1], (35, 1), atol=1.5)


def test_a_double_click_on_a_point_or_on_nothing_inserts_nothing(mouse, session):
    start = session.document
    mouse.double_click(mouse.point(2))
    mouse.double_click((40, 40))
    assert session.document is start
    assert not session.in_gesture


def test_the_new_point_can_be_dragged_at_once(mouse, session):
    place = mouse.pixels((35, 1))
    mouse.click(place)
    mouse.press_again(place)
    mouse.move(place + by(0, 30))
    mouse.release(place + by(0, 60))
    np.testing.assert_allclose(points(session)[1], (35, 1 - 60 / mouse.canvas.camera.scale))
    assert steps(session) == ["Move point", "Insert point"]


@pytest.mark.parametrize("member", PRESETS)
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("t", [0.0, 0.5, 2.37, 6.9])
def test_the_pulled_curve_lands_under_the_mouse(qtbot, member, closed, t):
    canvas = shown(qtbot, boat(closed).with_parameters(PRESETS[member]))
    mouse, session = Mouse(canvas), canvas.session
    canvas.show_polygon = False  # so that no control point is in the way
    start = session.document
    place = mouse.on_curve(t)
    target = place + by(37.0, -52.0)
    mouse.drag(place + by(2, 2), place + by(10, 10), target)
    assert steps(session) == ["Pull curve"]
    # Where on the curve the mouse took hold is known to the pixel; what went to the target is
    # the nearest place of the new curve.
    curve = session.document.curves[0].limit(session.document.parameters)
    drawn = canvas.camera.to_pixels(curve.points(10))
    assert np.hypot(*(drawn - target).T).min() < 0.5
    session.undo()
    assert session.document is start


def test_the_place_that_was_taken_is_the_one_that_lands(mouse, session, canvas):
    t = 2.25
    place = mouse.on_curve(t)
    mouse.drag(place, place + by(5, 5), place + by(30, 60))
    curve = session.document.curves[0].limit(session.document.parameters)
    landed = canvas.camera.to_pixels(curve.at(t))
    np.testing.assert_allclose(landed, place + by(30, 60), atol=0.5)


def test_escape_lets_the_curve_go(mouse, session, canvas):
    start = session.document
    place = mouse.on_curve(2.25)
    mouse.press(place)
    mouse.move(place + by(30, 60))
    assert canvas.overlay.grip is not None
    QTest.keyClick(canvas, ESC)
    mouse.release(place + by(30, 60))
    assert session.document is start


def test_shift_pulls_along_an_axis(mouse, session, canvas):
    t = 2.25
    before = session.document.curves[0].limit(session.document.parameters).at(t)
    place = mouse.on_curve(t)
    mouse.drag(place, place + by(10, 60), keys=SHIFT)
    after = session.document.curves[0].limit(session.document.parameters).at(t)
    assert after[0] == pytest.approx(before[0], abs=1e-9)
    assert after[1] == pytest.approx(before[1] - 60 / canvas.camera.scale, abs=0.5)


def test_a_segment_can_be_pulled(qtbot):
    canvas = shown(qtbot, Document((Curve([(0, 0), (100, 50)], closed=True),)))
    mouse = Mouse(canvas)
    place = mouse.on_curve(0.5)
    mouse.drag(place, place + by(30, 40))
    assert canvas.session.undo_name == "Pull curve"


def test_hidden_points_are_not_taken(mouse, session, canvas):
    canvas.show_polygon = False
    mouse.drag(mouse.point(1), mouse.point(1) + by(30, 30))
    assert session.undo_name is None
    assert selected(session) == []


def test_hints_follow_the_mouse_and_the_keys(mouse, session, canvas):
    mouse.move((40, 40))
    assert "double click an edge inserts" in canvas.hint
    mouse.move(mouse.point(3))
    assert "Drag moves the point" in canvas.hint
    QTest.keyPress(canvas, Qt.Key.Key_Shift, Qt.KeyboardModifier.ShiftModifier)
    assert "adds the point" in canvas.hint
    QTest.keyRelease(canvas, Qt.Key.Key_Shift)
    mouse.move(mouse.on_curve(0.5))
    assert "pulls the curve" in canvas.hint
    mouse.press(mouse.point(3))
    mouse.move(mouse.point(3) + by(20, 0))
    assert "Shift keeps an axis" in canvas.hint
    assert "mm" in canvas.hint


def test_the_cursor_says_what_a_press_would_do(mouse, canvas):
    shapes = []
    for place in ((40, 40), mouse.point(3), mouse.on_curve(0.5)):
        mouse.move(place)
        shapes.append(canvas.cursor().shape())
    assert shapes == [
        Qt.CursorShape.ArrowCursor,
        Qt.CursorShape.SizeAllCursor,
        Qt.CursorShape.PointingHandCursor,
    ]


def test_the_hint_tells_that_points_lie_too_close_to_be_shown(qtbot):
    angle = np.linspace(0, 2 * np.pi, 3000, endpoint=False)
    crowd = Document((Curve(100 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)),))
    canvas = shown(qtbot, crowd)
    mouse = Mouse(canvas)
    mouse.move((450, 300))
    assert canvas.hint.startswith("3,000 points lie too close to be shown")
    canvas.zoom_by(1000.0)
    mouse.move((450, 301))
    assert "too close" not in canvas.hint
