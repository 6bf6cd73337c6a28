"""What is left out of a library is not missed, and Python is as it was."""

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


def printed(code):
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return done.stdout.split()


def test_numpy_writes_no_docstrings_and_works():
    """Also where others ask for the docstrings, such as its own masked arrays do."""
    assert printed(
        "import sys\n"
        "from app.loading import DOCUMENTATION, load_numpy\n"
        "load_numpy()\n"
        "import numpy as np\n"
        "print(bool(np.add.reduce.__doc__ or np.zeros.__doc__ or np.float64.conjugate.__doc__))\n"
        "print(any(name in sys.modules for name in DOCUMENTATION))\n"
        "import ezdxf, numpy.ma, pyqtgraph\n"
        "print(np.linalg.solve(np.eye(2), [1.0, 2.0])[1], np.ma.masked_equal([1, 2], 2).sum())"
    ) == ["False", "False", "2.0", "1"]


def test_a_numpy_that_is_loaded_already_keeps_its_docstrings():
    assert printed(
        "import numpy as np\n"
        "from app.loading import load_numpy\n"
        "load_numpy()\n"
        "print(bool(np.zeros.__doc__))"
    ) == ["True"]


def test_a_numpy_with_other_modules_is_loaded_as_a_whole():
    """A later one may write its docstrings elsewhere."""
    assert printed(
        "import app.loading as loading\n"
        "loading.DOCUMENTATION = ('numpy.elsewhere',)\n"
        "loading.load_numpy()\n"
        "import sys, numpy as np\n"
        "print(bool(np.zeros.__doc__), 'numpy.elsewhere' in sys.modules)"
    ) == ["True", "False"]
