"""From a move of a slider to everything painted: curve, basis function, step response and badge."""

from __future__ import annotations

from time import perf_counter

import numpy as np
import pytest
from comparison import Comparison
from PySide6.QtCore import QEvent, QEventLoop, QObject
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from test_drag import flower

from app.guard import guarded
from app.settings import Settings
from app.window import MainWindow
from core import Parameters

MOVES = 80
WAIT = QEventLoop.ProcessEventsFlag.WaitForMoreEvents


class Painted(QObject):
    """Notes which of some widgets have been painted."""

    def __init__(self, *widgets: QObject) -> None:
        super().__init__()
        self.missing = set[QObject]()
        self.widgets = widgets
        for widget in widgets:
            widget.installEventFilter(self)

    @guarded
    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802
        if event.type() == QEvent.Type.Paint:
            self.missing.discard(watched)
        return False


@pytest.mark.parametrize("count", [20, 100_000, 1_000_000])
def test_slider_move_to_all_painted(qtbot: QtBot, comparison: Comparison, count: int) -> None:
    window = MainWindow(settings=Settings(None))
    qtbot.addWidget(window)
    window.resize(1280, 800)
    with qtbot.waitSignal(window.completed, timeout=60_000):
        window.show()
    window.session.replace(flower(count), None)
    basis, step = window.docks.basis_plot, window.docks.step_plot
    assert basis is not None
    assert step is not None
    seen = Painted(window.canvas, basis.viewport(), step.viewport(), window.scheme.badge)
    badge, session = window.scheme.badge, window.session
    session.begin("Set alpha")
    times = []
    for k in range(MOVES):
        parameters = Parameters(f"{k}/1000", "-1/2", f"{k}/1000")
        seen.missing = {*seen.widgets}
        places = window.canvas.scene.curves[0].vertices_px
        start, before = perf_counter(), badge.sentence
        session.adjust(session.document.with_parameters(parameters))
        assert window.analysis.finding.parameters is parameters
        if badge.sentence == before:
            seen.missing.remove(badge)
        # Among very many points no vertex may move by as much as the screen can tell.
        if np.array_equal(window.canvas.scene.curves[0].vertices_px, places):
            seen.missing.remove(window.canvas)
        while seen.missing:
            QApplication.processEvents(WAIT)
        times.append(perf_counter() - start)
    session.cancel()  # nothing is left that closing would ask about
    median, late = np.quantile(np.array(times[5:]) * 1e3, (0.5, 0.95))
    row = f"slider move to curve, basis, step and badge painted, {count:,} points"
    comparison.row(row, f"{median:.1f} ms, p95 {late:.1f} ms", "16 ms")
    window.stop()
