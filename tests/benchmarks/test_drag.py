"""From mouse event to painted picture: one point of many is dragged, the curve follows.

Run with ``python3 tests tests/benchmarks``. The figures are for Qt's raster engine, offscreen.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from itertools import cycle
from pathlib import Path
from time import perf_counter, sleep

import numpy as np
import pytest
from comparison import Comparison
from dragged import PAUSE_S
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QPaintEvent
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


class Watched(Canvas):
    """A canvas that counts its paints."""

    paints = 0

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802
        super().paintEvent(event)
        self.paints += 1


def paint(canvas: Watched) -> None:
    """Let the loop of events do all that leads to the next paint, and that paint."""
    before = canvas.paints
    while canvas.paints == before:
        QApplication.processEvents()


@pytest.fixture
def size() -> tuple[int, int]:
    return 900, 600


@pytest.fixture
def canvas(qtbot: QtBot, count: int, size: tuple[int, int]) -> Watched:
    shown = Watched(Session(flower(count)))
    qtbot.addWidget(shown)
    shown.resize(*size)
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
    benchmark: BenchmarkFixture, comparison: Comparison, canvas: Watched, count: int
) -> None:
    (drawn,) = canvas.scene.curves
    start = QPointF(*drawn.places_px(np.array([count // 8]))[0])
    send(canvas, QEvent.Type.MouseButtonPress, start, LEFT)
    circle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    places = cycle([start + QPointF(40 * np.cos(a), 40 * np.sin(a)) for a in circle])

    def move() -> None:
        send(canvas, QEvent.Type.MouseMove, next(places), NONE)
        paint(canvas)

    benchmark(move)
    times = np.sort(benchmark.stats.stats.data) * 1e3
    median, late = np.quantile(times, (0.5, 0.99))
    what = f"mouse event to painted, one point of {count:,}"
    comparison.row(what, f"{median:.2f} ms, p99 {late:.2f} ms", "2.5 ms, 8 ms")
    send(canvas, QEvent.Type.MouseButtonRelease, start + QPointF(40, 0), LEFT)
    assert canvas.session.undo_name == "Move point"


@pytest.mark.parametrize("count", [1_000_000])
def test_drag_at_the_pace_of_a_hand(comparison: Comparison, canvas: Watched, count: int) -> None:
    """Other programs have used the processor's caches by then; and it has to wake up."""
    (drawn,) = canvas.scene.curves
    start = QPointF(*drawn.places_px(np.array([count // 8]))[0])
    send(canvas, QEvent.Type.MouseButtonPress, start, LEFT)
    times: dict[bool, list[float]] = {False: [], True: []}
    for k in range(640):
        angle, rests = k * 2 * np.pi / 64, k // 16 % 2 == 1
        end = perf_counter() + PAUSE_S
        while not rests and perf_counter() < end:
            pass
        if rests:
            sleep(PAUSE_S)
        begin = perf_counter()
        place = start + QPointF(40 * np.cos(angle), 40 * np.sin(angle))
        send(canvas, QEvent.Type.MouseMove, place, NONE)
        paint(canvas)
        times[rests].append(1e3 * (perf_counter() - begin))
    send(canvas, QEvent.Type.MouseButtonRelease, start + QPointF(40, 0), LEFT)
    awake, rested = (np.median(times[rests]) for rests in (False, True))
    what = f"the same every {1e3 * PAUSE_S:.0f} ms, the processor awake; at rest meanwhile"
    comparison.row(what, f"{awake:.2f} ms; {rested:.2f} ms")


@pytest.mark.parametrize("count", [1000])
def test_pull_the_curve(benchmark: BenchmarkFixture, canvas: Watched, count: int) -> None:
    canvas.show_polygon = False  # so that no control point is in the way
    x, y = canvas.scene.curves[0].vertices_px[count // 8]
    start = QPointF(x, y)
    send(canvas, QEvent.Type.MouseButtonPress, start, LEFT)
    circle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    places = cycle([start + QPointF(40 * np.cos(a), 40 * np.sin(a)) for a in circle])

    def move() -> None:
        send(canvas, QEvent.Type.MouseMove, next(places), NONE)
        paint(canvas)

    benchmark(move)
    send(canvas, QEvent.Type.MouseButtonRelease, start + QPointF(40, 0), LEFT)
    assert canvas.session.undo_name == "Pull curve"


@pytest.mark.parametrize("count", [20, 1000, 1_000_000])
def test_zoom(benchmark: BenchmarkFixture, canvas: Watched, count: int) -> None:
    factors = cycle([1.2, 1 / 1.2])

    def zoom() -> None:
        canvas.zoom_by(next(factors))
        paint(canvas)

    benchmark(zoom)


@pytest.mark.parametrize("size", [(1920, 1080)])
@pytest.mark.parametrize("count", [20, 450, 1_000_000])
def test_full_frame(
    benchmark: BenchmarkFixture, comparison: Comparison, canvas: Watched, count: int
) -> None:
    """All of a large window: grid, rulers, curve, polygon, and handles where they are shown."""
    ways = cycle([3.0, -3.0])

    def pan() -> None:
        canvas.look(canvas.camera.moved(next(ways), 0.0))
        paint(canvas)

    benchmark(pan)
    assert canvas.show_grid
    median = 1e3 * float(np.median(benchmark.stats.stats.data))
    comparison.row(f"full frame 1920 x 1080 while panned, {count:,} points", f"{median:.2f} ms",
                   "8.3 ms")  # fmt: skip


def test_drag_in_a_real_window(comparison: Comparison) -> None:
    """One point of a million under the hand of xdotool, in the window itself."""
    assert all(map(shutil.which, ("Xvfb", "xdotool"))), "apt-get install xvfb xdotool"
    run = subprocess.run(
        [sys.executable, Path(__file__).with_name("dragged.py"), "1000000"],
        capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    times = np.array(run.stdout.split(), dtype=float)
    assert len(times) > 200
    median, late = np.quantile(times, (0.5, 0.99))
    what = "real window under Xvfb, mouse event to painted, one point of 1,000,000"
    comparison.row(what, f"{median:.2f} ms, p99 {late:.2f} ms", "2.5 ms, 8 ms")
    edges = np.array([0, 1, 2, 3, 4, 6, 8, 12, np.inf])
    counts, _ = np.histogram(times, edges)
    spread = ", ".join(
        f"< {edge:g} ms: {count}" for edge, count in zip(edges[1:], counts, strict=True) if count
    )
    comparison.row("  of its events", spread)
