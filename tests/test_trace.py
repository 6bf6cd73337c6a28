import numpy as np
import pyqtgraph as pg
import pytest
from PySide6.QtGui import QBrush, QColor, QImage, QPen

from app.trace import LEAST_STEP_PX, MARK_RADIUS_PX, Trace

SIZE = 400, 200
INK, GROUND, MARK = (QColor(name) for name in ("#000000", "#ffffff", "#ff0000"))


@pytest.fixture
def view(qtbot):
    view = pg.GraphicsView(background=GROUND)
    qtbot.addWidget(view)
    view.resize(*SIZE)
    return view


@pytest.fixture
def trace(view):
    """A trace in a bare view of t = 0 .. 40 and values 0 .. 20, ten pixels a unit."""
    box = pg.ViewBox()
    view.setCentralItem(box)
    box.setRange(xRange=(0, 40), yRange=(0, 20), padding=0)
    trace = Trace()
    trace.pen = QPen(INK, 3.0)
    trace.mark_pen, trace.mark_brush = QPen(MARK, 1.0), QBrush(MARK)
    box.addItem(trace, ignoreBounds=True)
    view.show()
    return trace


def picture(trace):
    return trace.getViewWidget().grab().toImage().convertToFormat(QImage.Format.Format_RGB32)


def darkness(image, x):
    """Middle of the dark pixels of a column, in pixels from above; None without."""
    rows = [y for y in range(image.height()) if image.pixelColor(x, y).lightness() < 128]
    return None if not rows else (rows[0] + rows[-1] + 1) / 2


@pytest.mark.parametrize("count", [5, 101, 5001])
def test_the_line_runs_where_the_function_is_however_fine_it_comes(trace, count):
    """Coordinates of pixels: t = x / 10, value = (200 - y) / 10; to within half a pixel."""
    t = np.linspace(0, 40, count)
    trace.put(t, 5 + t / 4)
    image = picture(trace)
    for x in (20, 133, 250, 380):
        expected = 200 - 10 * (5 + (x + 0.5) / 10 / 4)
        assert darkness(image, x) == pytest.approx(expected, abs=0.75)


def test_the_last_vertex_is_drawn_whatever_is_left_out(trace):
    """The far end lies off the even spacing, like that of a step response beyond its support."""
    t = np.append(np.linspace(0, 20, 1000), 40.0)
    trace.put(t, np.full(len(t), 10.0))
    image = picture(trace)
    assert (t[1] - t[0]) * 10 < LEAST_STEP_PX
    assert darkness(image, 395) == pytest.approx(100, abs=0.75)


def test_marks_are_discs_of_so_many_pixels_about_their_places(trace):
    trace.put(np.array([0.0, 40.0]), np.array([2.0, 2.0]))
    trace.marks = np.array([[10.0, 15.0], [30.0, 5.0]])
    image = picture(trace)
    for x, y in ((100, 50), (300, 150)):
        assert image.pixelColor(x, y) == MARK
        assert image.pixelColor(x, round(y - MARK_RADIUS_PX + 1)).hue() == MARK.hue()
        assert image.pixelColor(x, round(y - MARK_RADIUS_PX - 3)) == GROUND


def test_another_function_comes_without_the_marks_of_the_last(trace):
    trace.put(np.array([0.0, 40.0]), np.array([2.0, 2.0]))
    trace.marks = np.array([[10.0, 15.0]])
    trace.put(np.array([0.0, 40.0]), np.array([2.0, 2.0]))
    assert picture(trace).pixelColor(100, 50) == GROUND
    trace.clear()
    assert darkness(picture(trace), 200) is None
