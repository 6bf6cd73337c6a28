"""A window in a process of its own, which says when it was painted and what memory it holds.

``python tests/benchmarks/started.py WHAT UNTIL [FILE]`` opens a window, ``bare`` (an empty QWidget)
or ``ninepoint``, and ends when it is ``painted`` for the first time or ``settled``. It prints the
time of day in seconds, and the resident memory now and at its most in bytes.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

KIB = 1024
BARE_SIZE = (1280, 800)  # that of Ninepoint's window


def memory() -> tuple[int, int]:
    """Resident bytes of this process, now and at their most."""
    status = Path("/proc/self/status")
    if status.exists():
        fields = dict(line.split(":", 1) for line in status.read_text().splitlines())
        now, most = (int(fields[key].split()[0]) * KIB for key in ("VmRSS", "VmHWM"))
        return now, most
    from resource import RUSAGE_SELF, getrusage

    most = getrusage(RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else KIB)
    return most, most  # such a system tells only the most


def end() -> None:
    """Say how it is, and leave at once: a window's farewell is not measured."""
    now = time.time()
    sys.stdout.write(" ".join(map(str, (now, *memory()))))
    sys.stdout.flush()
    os._exit(0)


def open_bare() -> None:
    from PySide6.QtCore import QTimer
    from PySide6.QtWidgets import QApplication, QWidget

    class Bare(QWidget):
        def paintEvent(self, event):  # noqa: N802
            QTimer.singleShot(0, end)

    application = QApplication(sys.argv[:1])
    window = Bare()
    window.resize(*BARE_SIZE)
    window.show()
    application.exec()


def open_ninepoint(until: str, files: list[str]) -> None:
    """Do what ``python3 app`` does, with an ear at the window."""
    import gc

    if files:
        from app.cli import main
    else:
        from app.entrance import main
    from app.loading import load_numpy, load_qt

    gc.disable()  # as app.entrance does before it imports the window
    load_qt()  # this, too, and
    load_numpy()
    from PySide6.QtCore import QSettings, QTimer

    from app import launch

    class Watched(launch.MainWindow):
        def paintEvent(self, event):  # noqa: N802
            if until == "painted":
                QTimer.singleShot(0, end)  # before that which the window does after its paint
            super().paintEvent(event)

        def rest(self):
            """End when all is loaded and nothing is computed any more."""
            if self.analysis.is_at_rest:
                QTimer.singleShot(0, end)
            else:
                self.analysis.rested.connect(end)

        def __init__(self, **parts):
            super().__init__(**parts)
            self.completed.connect(self.rest)

    launch.MainWindow = Watched
    QSettings.setDefaultFormat(QSettings.Format.IniFormat)
    scope = QSettings.Scope.UserScope
    QSettings.setPath(QSettings.Format.IniFormat, scope, os.environ["NINEPOINT_SETTINGS"])
    sys.argv[1:] = files
    main()


if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).resolve().parents[2])
    what, until, *files = sys.argv[1:]
    if what == "bare":
        open_bare()
    else:
        open_ninepoint(until, files)
