"""The story in a real window, driven by xdotool; its result is read from the saved file.

Outside the default suite: ``python3 tests tests/acceptance``. It needs Debian's packages xvfb,
xdotool and openbox.
"""

import os
import shutil
import subprocess
import sys
import time
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest
from PySide6.QtCore import QPoint

from answers import Answers
from app.assets import resources
from app.window import MainWindow
from core import store
from independent import seen_by_ezdxf
from mouse import Mouse

SIZE = (1280, 800)
PATIENCE_S = 30


def until(condition):
    """Wait for a condition; there is no signal from another process."""
    for _ in range(PATIENCE_S * 20):
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError("nothing happened")


@pytest.fixture
def display():
    for program in ("Xvfb", "xdotool", "openbox"):
        assert shutil.which(program), f"apt-get install xvfb xdotool openbox: no {program}"
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[write], stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(write)
    with os.fdopen(read) as pipe:
        name = ":" + pipe.readline().strip()
    manager = subprocess.Popen(["openbox"], env={**os.environ, "DISPLAY": name})
    yield name
    manager.terminate()
    server.terminate()
    manager.wait()
    server.wait()


class Hand:
    """xdotool on one window."""

    def __init__(self, display, window):
        self.environment = {**os.environ, "DISPLAY": display}
        self.window = window

    def do(self, *words):
        command = ["xdotool", *map(str, words)]
        run = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return run.stdout.strip()

    def move(self, x, y):
        self.do("mousemove", "--window", self.window, round(x), round(y))

    def drag(self, start, stop):
        self.move(*start)
        self.do("mousedown", 1)
        for share in (0.2, 0.5, 0.8, 1.0):
            self.move(*(np.asarray(start) + share * (np.asarray(stop) - start)))
        self.do("mouseup", 1)

    def press(self, *keys):
        self.do("key", "--clearmodifiers", *keys)


def export(hand, path, key):
    """Export by keys alone: the dialog, the profile by a key, then the file's name."""

    def windows():
        return hand.do("search", "--onlyvisible", "--name", "^Export$").split()

    hand.press("ctrl+shift+e")
    until(windows)
    hand.press(key, "Return")
    until(lambda: hand.do("getactivewindow") != hand.window)
    time.sleep(0.5)  # the second dialog takes the place of the first
    hand.do("type", str(path))
    hand.press("Return")
    until(path.exists)
    until(lambda: not windows())


@pytest.fixture
def twin(qtbot):
    """The same window without a screen, which tells where things are."""
    window = MainWindow(dialogs=Answers())
    qtbot.addWidget(window)
    window.resize(*SIZE)
    with qtbot.waitSignal(window.completed):
        window.show()
    return window


def test_drag_slide_undo_redo_and_save_in_a_real_window(display, twin, tmp_path):
    path = tmp_path / "wing.ninepoint"
    shutil.copy(resources() / "examples" / "airfoil.ninepoint", path)
    opened = store.load(path)
    twin.files.open_path(path)
    canvas = twin.canvas
    corner = canvas.mapTo(twin, QPoint(0, 0))
    corner = np.array([corner.x(), corner.y()])
    place = np.rint(Mouse(canvas).point(7)) + corner
    track = twin.scheme.tracks["beta"]
    row = track.mapTo(twin, QPoint(0, track.height() // 2))
    handle = np.array([row.x() + track.x_of(track.value()), row.y()])
    further = np.array([row.x() + track.x_of(-150), row.y()])

    environment = {**os.environ, "DISPLAY": display, "XDG_CONFIG_HOME": str(tmp_path)}
    environment.pop("QT_QPA_PLATFORM", None)
    program = subprocess.Popen(
        [sys.executable, "-m", "app", "--size", "x".join(map(str, SIZE)), path], env=environment
    )
    try:
        look = Hand(display, "")
        window = until(lambda: look.do("search", "--onlyvisible", "--name", "wing.ninepoint"))
        hand = Hand(display, window.split()[0])
        hand.do("windowactivate", "--sync", hand.window)
        until(lambda: hand.do("getwindowname", hand.window).startswith("wing.ninepoint"))
        time.sleep(1)  # the plots come after the first paint, and the docks then rest

        def title():
            return hand.do("getwindowname", hand.window)

        hand.drag(place, place + np.array([14, -25]))
        until(lambda: "*" in title())
        hand.press("ctrl+s")
        until(lambda: "*" not in title())
        dragged = store.load(path)
        moved = dragged.curves[0].points[7] - opened.curves[0].points[7]
        np.testing.assert_allclose(moved * canvas.camera.scale, (14, 25), atol=1e-6)

        hand.drag(handle, further)
        until(lambda: "*" in title())
        hand.press("ctrl+s")
        until(lambda: "*" not in title())
        slid = store.load(path)
        assert float(slid.parameters.beta) == pytest.approx(-0.75, abs=0.03)

        hand.press("ctrl+z")
        hand.press("ctrl+z")
        until(lambda: "*" in title())
        hand.press("ctrl+s")
        until(lambda: "*" not in title())
        assert store.encode(store.load(path)) == store.encode(opened)

        hand.press("ctrl+shift+z")
        until(lambda: "*" in title())
        hand.press("ctrl+s")
        until(lambda: "*" not in title())
        assert store.encode(store.load(path)) == store.encode(dragged)

        for suffix, key in ((".svg", "i"), (".dxf", "Home")):
            export(hand, tmp_path / f"exported{suffix}", key)
        (line,) = ezdxf.readfile(tmp_path / "exported.dxf").modelspace()
        assert line.closed
        # Arcs reach beyond their vertices.
        ((drawn, _, _),) = seen_by_ezdxf((tmp_path / "exported.dxf").read_bytes(), 0.001)
        exact = dragged.curves[0].limit(dragged.parameters).points(8)
        np.testing.assert_allclose(np.ptp(drawn, axis=0), np.ptp(exact, axis=0), atol=0.02)
        box = ET.parse(tmp_path / "exported.svg").getroot().get("viewBox").split()[2:]
        np.testing.assert_allclose([*map(float, box)], np.ptp(exact, axis=0), atol=0.02)

        hand.press("ctrl+q")
        assert program.wait(PATIENCE_S) == 0
    finally:
        program.kill()
        program.wait()
