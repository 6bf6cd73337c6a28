"""A real window under Xvfb, in which xdotool drags a control point; prints the latencies in ms.

``python tests/benchmarks/dragged.py COUNT`` opens Ninepoint's window on a display of its own with a
closed curve of COUNT points. Each latency is the time from when the window's process is given a
mouse event until what it changed has been painted and handed to the display.
"""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path
from time import perf_counter

SIZE = (1280, 800)
MOVES = 400
PAUSE_S = 0.012  # between two moves, as a mouse of 80 Hz


def display() -> tuple[subprocess.Popen[bytes], str]:
    """Start a display; return its server and name."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(write)
    with os.fdopen(read) as pipe:
        return server, ":" + pipe.readline().strip()


def drag(window: int, start: tuple[float, float]) -> None:
    """Press at a place of the window, move in a circle, and release."""
    from math import cos, pi, sin

    x, y = start
    words = ["mousemove", "--window", window, round(x), round(y), "sleep", 0.2, "mousedown", 1]
    for step in range(1, MOVES + 1):
        angle = step * 2 * pi / 64
        words += ["mousemove", "--window", window, round(x + 40 * cos(angle))]
        words += [round(y + 40 * sin(angle)), "sleep", PAUSE_S]
    subprocess.run(["xdotool", *map(str, words), "mouseup", "1"], check=True)


def main(count: int) -> list[float]:
    """Open the window, have a point dragged, and return the latencies in ms."""
    import numpy as np
    from PySide6.QtCore import QPoint, QTimer

    import app.canvas
    import app.window
    from app.theme import styled_application
    from core import Curve, Document

    times: list[float] = []

    class Watched(app.canvas.Canvas):
        """Notes when moves arrive, and when what they changed has been painted."""

        since: float | None = None

        def mouseMoveEvent(self, event):  # noqa: N802
            if self.since is None and event.buttons():
                self.since = perf_counter()
            super().mouseMoveEvent(event)

        def paintEvent(self, event):  # noqa: N802
            waits = self._is_due  # if so, this paint is not yet all
            super().paintEvent(event)
            if self.since is not None and not waits:
                QTimer.singleShot(0, self.painted)  # the display has been given the picture then

        def painted(self):
            if self.since is not None:
                times.append(1e3 * (perf_counter() - self.since))
                self.since = None

    app.window.Canvas = Watched
    application = styled_application(sys.argv[0])
    window = app.window.MainWindow()
    window.resize(*SIZE)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 100 + 10 * np.sin(9 * angle)
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    window.session.replace(Document((Curve(points),)), None)
    window.show()

    def begin() -> None:
        canvas = window.canvas
        corner = canvas.mapTo(window, QPoint(0, 0))
        x, y = canvas.camera.to_pixels(points[count // 8])
        hand = threading.Thread(
            target=drag, args=(int(window.winId()), (corner.x() + x, corner.y() + y))
        )
        hand.start()

        def look() -> None:
            if not hand.is_alive():
                application.exit()  # the drawing need not be saved

        timer = QTimer(window)
        timer.timeout.connect(look)
        timer.start(200)

    window.completed.connect(lambda: QTimer.singleShot(1500, begin))
    application.exec()
    if window.session.undo_name != "Move point":
        raise SystemExit("the point was not taken")
    return times


if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).resolve().parents[2])
    server, name = display()
    os.environ.update(DISPLAY=name, QT_QPA_PLATFORM="xcb", OPENBLAS_NUM_THREADS="1")
    try:
        sys.stdout.write(" ".join(f"{time:.3f}" for time in main(int(sys.argv[1]))))
        sys.stdout.flush()
    finally:
        server.terminate()
        server.wait()
    os._exit(0)  # a window's farewell is not measured
