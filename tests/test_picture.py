"""Painting: hard cases do no harm, and what shall be seen is seen."""


import numpy as np
import pytest
from PySide6.QtGui import QColor, QPalette

from app.session import Selection
from app.style import DARK, LIGHT
from core.document import MAX_COORDINATE_MM, Curve, Document
from core.family import PRESETS, Parameters
from mouse import BOAT, Mouse, by, shown


def picture(canvas):
    return canvas.grab().toImage()


HARD_POINTS = {
    "none": np.zeros((0, 2)),
    "one": np.array([(3.0, 4.0)]),
    "two": np.array([(0.0, 0.0), (50.0, 20.0)]),
    "equal": np.full((6, 2), 7.0),
    "collinear": np.stack([np.arange(9.0), np.zeros(9)], axis=-1),
    "huge": MAX_COORDINATE_MM * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]),
    "tiny": 1e-9 * np.array(BOAT),
    "mixed": np.array([(0.0, 0.0), (1e9, 0.0), (1e-9, 1e-9), (5.0, -1e9)]),
    "far": MAX_COORDINATE_MM - 200.0 + np.array(BOAT, dtype=float),
}


@pytest.mark.parametrize("name", HARD_POINTS)
@pytest.mark.parametrize("closed", [True, False])
def test_hard_points_are_painted(qtbot, name, closed):
    parameters = PRESETS["Lean"]
    canvas = shown(qtbot, Document((Curve(HARD_POINTS[name], closed),), parameters))
    mouse = Mouse(canvas)
    for factor in (1.0, 1e3, 1e9, 1e-12, 1e-9):
        canvas.zoom_by(factor)
        picture(canvas)
        mouse.move((450, 300))
    canvas.fit_all()
    mouse.drag((440, 290), (460, 310), (500, 400))
    picture(canvas)
    canvas.select_all()
    canvas.nudge(1, 1)
    picture(canvas)


@pytest.mark.parametrize("neighbours", ["translated", "mirrored"])
@pytest.mark.parametrize("values", [(100, 100, 100), (-100, 100, -100), (3, -3, 3)])
def test_absurd_parameters_are_painted(qtbot, neighbours, values):
    for scale in (1.0, 8e6):
        document = Document((Curve(np.array(BOAT) * scale),), Parameters(*values, neighbours))
        canvas = shown(qtbot, document)
        mouse = Mouse(canvas)
        place = mouse.point(4)
        mouse.press(place)
        for step in range(4):
            mouse.move(place + by(10 * step, 5))
            picture(canvas)
        mouse.release()
        for factor in (1e6, 1e-9):
            canvas.zoom_by(factor)
            picture(canvas)


@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_the_canvas_follows_the_colour_scheme(canvas, palette):
    colours = QPalette()
    dark = palette is DARK
    colours.setColor(QPalette.ColorRole.Window, QColor("#222222" if dark else "#ffffff"))
    colours.setColor(QPalette.ColorRole.WindowText, QColor("#ffffff" if dark else "#000000"))
    canvas.setPalette(colours)
    canvas.show_grid = False
    image = picture(canvas)
    assert image.pixelColor(60, 60).name() == palette.background
    x, y = canvas.scene.curves[0].vertices_px[0]
    assert image.pixelColor(int(x), int(y)).name() != palette.background


def test_a_point_is_drawn_where_it_is_and_filled_when_selected(canvas, session):
    x, y = (int(v) for v in canvas.scene.curves[0].points_px[4])
    assert picture(canvas).pixelColor(x, y).name() == LIGHT.point_fill
    session.select(Selection(frozenset({(0, 4)})))
    assert picture(canvas).pixelColor(x, y).name() == LIGHT.point_selected
    canvas.show_polygon = False
    assert picture(canvas).pixelColor(x, y).name() != LIGHT.point_selected


def test_ghost_and_influence_are_seen_in_a_drag_only(canvas, mouse):
    def orange(image):
        return any(
            QColor(image.pixel(x, y)).hue() in range(15, 45) and
            QColor(image.pixel(x, y)).saturation() > 60
            for x in range(100, 880, 2) for y in range(60, 560, 2)
        )  # fmt: skip

    place = mouse.point(4)
    assert not orange(picture(canvas))
    mouse.press(place)
    mouse.move(place + by(30, 40))
    assert orange(picture(canvas))
    assert len(canvas.scene.ghosts) == 1
    mouse.release()
    assert not orange(picture(canvas))
    assert canvas.scene.ghosts == {}


def test_a_curve_that_runs_level_has_no_blot(canvas):
    canvas.show_polygon = canvas.show_grid = False
    image = picture(canvas)
    x, y = (int(v) for v in Mouse(canvas).on_curve(5.0))
    for row in range(y - 3, y + 4):
        line = [image.pixelColor(x + k, row).lightness() for k in range(-5, 6)]
        assert np.abs(np.diff(line)).max() < 60


def test_thousands_of_points_are_not_shown(qtbot):
    angle = np.linspace(0, 2 * np.pi, 3000, endpoint=False)
    crowd = Document((Curve(100 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)),))
    canvas = shown(qtbot, crowd)
    picture(canvas)
    assert canvas.scene.curves[0].shown is None
