"""No event of the mouse takes memory, or makes arrays, in proportion to the number of points."""

import tracemalloc

import numpy as np
import pytest

from app.session import Selection
from core.document import Curve, Document
from mouse import Mouse, by, shown

COUNT = 200_000
ADMITTED = COUNT * 16 // 10
"""A tenth of what one array of all the points takes."""


@pytest.fixture
def canvas(qtbot):
    angle = np.linspace(0, 2 * np.pi, COUNT, endpoint=False)
    radius = 100 + 10 * np.sin(9 * angle)
    circle = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return shown(qtbot, Document((Curve(circle),)))


def most(action):
    """Bytes that an action takes at its height."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        action()
        return tracemalloc.get_traced_memory()[1] - before
    finally:
        tracemalloc.stop()


def test_no_event_of_a_drag_takes_memory_for_all_points(canvas):
    mouse = Mouse(canvas)
    place = canvas.camera.to_pixels(canvas.session.document.curves[0].points[COUNT // 8])
    # The tables of the scheme are made once.
    mouse.drag(place, place + by(30, -20))
    canvas.repaint()
    canvas.session.undo()
    steps = {
        "hover": lambda: mouse.move(place + by(1, 1)),
        "press": lambda: mouse.press(place),
        "first move": lambda: mouse.move(place + by(9, 9)),
        "paint": canvas.repaint,
        "next move": lambda: mouse.move(place + by(30, -20)),
        "paint again": canvas.repaint,
        "release": mouse.release,
        "last paint": canvas.repaint,
        "hover elsewhere": lambda: mouse.move((450, 300)),
        "undo": canvas.session.undo,
        "paint after undo": canvas.repaint,
        "pan": lambda: canvas.look(canvas.camera.moved(5, 5)),
        "paint after pan": canvas.repaint,
        "zoom": lambda: canvas.zoom_by(3.0),
        "paint after zoom": canvas.repaint,
        "nudge": lambda: canvas.nudge(1, 1),
        "paint after nudge": canvas.repaint,
    }
    taken = {name: most(step) for name, step in steps.items()}
    assert max(taken.values()) < ADMITTED, taken
    assert canvas.session.selection == Selection(canvas.session.selection.points)
    assert len(canvas.session.selection.points) == 1


def test_no_event_of_a_pull_takes_memory_for_all_points(canvas):
    canvas.show_polygon = False
    mouse = Mouse(canvas)
    place = canvas.scene.curves[0].vertices_px[50]
    # The tables of the scheme are made once.
    mouse.drag(place, place + by(30, -20))
    canvas.repaint()
    canvas.session.undo()
    canvas.grab()
    steps = {
        "press": lambda: mouse.press(place),
        "first move": lambda: mouse.move(place + by(9, 9)),
        "paint": canvas.repaint,
        "next move": lambda: mouse.move(place + by(30, -20)),
        "paint again": canvas.repaint,
        "release": mouse.release,
    }
    taken = {name: most(step) for name, step in steps.items()}
    assert max(taken.values()) < ADMITTED, taken
    assert canvas.session.undo_name == "Pull curve"
