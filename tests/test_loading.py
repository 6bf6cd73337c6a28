import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]

CODE = """
import builtins, linecache
plain = builtins.__import__
from app.loading import load_qt
load_qt()
assert builtins.__import__ is plain
from app.window import MainWindow
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
print([name for name in linecache.cache if "app" in name])
application = QApplication(["ninepoint", "-platform", "offscreen"])
window = MainWindow()
window.completed.connect(lambda: QTimer.singleShot(0, application.quit))
window.show()
application.exec()
window.stop()
print(window.docks.basis_plot is not None)
"""


def test_qt_reads_no_source_and_works():
    done = subprocess.run(
        [sys.executable, "-c", CODE], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == "[]\nTrue\n"


def test_an_import_that_fails_leaves_python_as_it_was():
    code = (
        "import builtins, sys; plain = builtins.__import__; sys.modules['PySide6'] = None\n"
        "from app.loading import load_qt\n"
        "try: load_qt()\n"
        "except ImportError: print(builtins.__import__ is plain)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "True\n"
