"""From mouse event to painted picture: one point of many is dragged, the curve follows.

Run with ``python3 tests tests/benchmarks``. The figures are for Qt's raster engine, offscreen.
"""

from __future__ import annotations

from itertools import cycle

import numpy as np
import pytest
from comparison import Comparison
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication
from pytest_benchmark.fixture import BenchmarkFixture
from pytestqt.qtbot import QtBot

from app.canvas import Canvas
from app.session import Session
from core import Curve, Document

NONE = Qt.MouseButton.NoButton
LEFT = Qt.MouseButton.LeftButton


def flower(count: int) -> Document:
    """A closed curve with nine petals, some 200 mm across."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 100 + 10 * np.sin(9 * angle)
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return Document((Curve(points),))


@pytest.fixture
def canvas(qtbot: QtBot, count: int) -> Canvas:
    shown = Canvas(Session(flower(count)))
    qtbot.addWidget(shown)
    shown.resize(900, 600)
    with qtbot.waitExposed(shown):
        shown.show()
    QApplication.processEvents()
    return shown


def send(canvas: Canvas, kind: QEvent.Type, place: QPointF, button: Qt.MouseButton) -> None:
    held = NONE if kind == QEvent.Type.MouseButtonRelease else LEFT
    event = QMouseEvent(
        kind, place, canvas.mapToGlobal(place), button, held, Qt.KeyboardModifier.NoModifier
    )
    QApplication.sendEvent(canvas, event)


@pytest.mark.parametrize("count", [20, 1000, 100_000, 1_000_000])
def test_drag_one_point(
    benchmark: BenchmarkFixture, comparison: Comparison, canvas: Canvas, count: int
) -> None:
    (drawn,) = canvas.scene.curves
    start = QPointF(*drawn.places_px(np.array([count // 8]))[0])
    send(canvas, QEvent.Type.MouseButtonPress, start, LEFT)
    circle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    places = cycle([start + QPointF(40 * np.cos(a), 40 * np.sin(a)) for a in circle])

    def move() -> None:
        send(canvas, QEvent.Type.MouseMove, next(places), NONE)
        canvas.repaint()

    benchmark(move)
    times = np.sort(benchmark.stats.stats.data) * 1e3
    median, late = np.quantile(times, (0.5, 0.99))
    what = f"mouse event to painted, one point of {count:,}"
    comparison.row(what, f"{median:.2f} ms, p99 {late:.2f} ms", "2.5 ms, 8 ms")
    send(canvas, QEvent.Type.MouseButtonRelease, start + QPointF(40, 0), LEFT)
    assert canvas.session.undo_name == "Move point"


@pytest.mark.parametrize("count", [1000])
def test_pull_the_curve(benchmark: BenchmarkFixture, canvas: Canvas, count: int) -> None:
    canvas.show_polygon = False  # so that no control point is in the way
    x, y = canvas.scene.curves[0].vertices_px[count // 8]
    start = QPointF(x, y)
    send(canvas, QEvent.Type.MouseButtonPress, start, LEFT)
    circle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    places = cycle([start + QPointF(40 * np.cos(a), 40 * np.sin(a)) for a in circle])

    def move() -> None:
        send(canvas, QEvent.Type.MouseMove, next(places), NONE)
        canvas.repaint()

    benchmark(move)
    send(canvas, QEvent.Type.MouseButtonRelease, start + QPointF(40, 0), LEFT)
    assert canvas.session.undo_name == "Pull curve"


@pytest.mark.parametrize("count", [20, 1000, 1_000_000])
def test_zoom(benchmark: BenchmarkFixture, canvas: Canvas, count: int) -> None:
    factors = cycle([1.2, 1 / 1.2])

    def zoom() -> None:
        canvas.zoom_by(next(factors))
        canvas.repaint()

    benchmark(zoom)
