import gc
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from app.entrance import INTERRUPTED, OUR_ERROR, USER_ERROR, main, open_window, status_of
from core.errors import FileError

ROOT = Path(__file__).parents[1]


@pytest.fixture
def calls(monkeypatch):
    """What the window was called with, instead of a window."""
    calls = []
    stand_in = ModuleType("app.launch")
    stand_in.run = lambda *args: calls.append((*args, gc.isenabled())) or 7
    monkeypatch.setitem(sys.modules, "app.launch", stand_in)
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    return calls


def test_a_start_without_words_opens_the_window(calls):
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 7
    assert calls == [(None, None, None, "system", False)]
    assert gc.isenabled()


def test_garbage_is_searched_for_again_if_the_window_fails(calls, monkeypatch):
    monkeypatch.setattr(sys.modules["app.launch"], "run", lambda *args: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        open_window()
    assert gc.isenabled()


def test_a_start_without_words_needs_no_command_line():
    code = (
        "import sys; from types import ModuleType; stand_in = ModuleType('app.launch')\n"
        "stand_in.run = lambda *args: print('click' in sys.modules) or 0\n"
        "sys.modules['app.launch'] = stand_in; sys.argv[1:] = []\n"
        "from app.__main__ import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "False\n"


@pytest.mark.parametrize(
    ("error", "status", "sentence"),
    [
        (FileError(Path("a.csv"), "it is bad."), USER_ERROR, "a.csv: it is bad."),
        (MemoryError(), USER_ERROR, "there is not enough memory for this."),
        (PermissionError(13, "Permission denied", "a"), USER_ERROR, "a: Permission denied."),
        (KeyboardInterrupt(), INTERRUPTED, "stopped."),
        (ZeroDivisionError("x"), OUR_ERROR, "this is a fault of the program, please report it:"),
    ],
)
def test_each_end_has_its_status_and_its_sentence(error, status, sentence):
    def fail():
        raise error

    told = []
    assert status_of(fail, told.append) == status
    assert told[0].startswith(sentence)


def test_a_library_that_lacks_is_left_to_who_installs_it():
    def fail():
        raise ImportError("libEGL.so.1")

    with pytest.raises(ImportError):
        status_of(fail, lambda sentence: None)


def test_what_the_first_paint_does_not_need_is_not_loaded_for_it(tmp_path):
    later = ["msgspec", "PySide6.QtSvg", "pyqtgraph", "click", "ezdxf", "core.store", "core.cells",
             "app.drops"]  # fmt: skip
    code = (
        "import sys\n"
        "from app.loading import load_qt; load_qt()\n"
        "from app.launch import run\n"
        "from PySide6.QtWidgets import QWidget\n"
        "import app.window\n"
        f"later = {later}\n"
        "paint = app.window.MainWindow.paintEvent\n"
        "def first(window, event):\n"
        "    print([name for name in later if name in sys.modules])\n"
        "    sys.stdout.flush()\n"
        "    import os; os._exit(0)\n"
        "app.window.MainWindow.paintEvent = first\n"
        "run(None, None, None, 'system')\n"
    )
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "XDG_CONFIG_HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, env=environment
    )
    assert done.stdout == "[]\n", done.stderr
