"""Fixtures of the whole suite: no screen, no settings of the user, no exception lost."""

import os
import sys

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")  # as `app.theme.styled_application` has it

import pytest
from hypothesis import settings

settings.register_profile("suite", deadline=None, derandomize=True, max_examples=24)
settings.register_profile("thorough", deadline=None, max_examples=1000)
settings.load_profile("suite")


@pytest.fixture(autouse=True)
def no_swallowed_exception(request, monkeypatch):
    """Turn pyqtgraph's ``printExc`` into a failure: it hides exceptions of mouse handlers."""
    if "qtbot" not in request.fixturenames:
        yield
        return
    import pyqtgraph
    import pyqtgraph.debug

    swallowed = []

    def remember(*args, **kwargs):
        swallowed.append(sys.exc_info()[1] or args)

    monkeypatch.setattr(pyqtgraph.debug, "printExc", remember)
    pyqtgraph.setConfigOption("mouseRateLimit", 0)
    yield
    assert not swallowed, f"pyqtgraph swallowed {swallowed}"


@pytest.fixture(autouse=True)
def own_settings(request, tmp_path_factory):
    """Keep QSettings of the tests apart from those of the user, and empty."""
    if "qtbot" not in request.fixturenames:
        return
    from PySide6.QtCore import QSettings

    folder = tmp_path_factory.mktemp("settings")
    QSettings.setDefaultFormat(QSettings.Format.IniFormat)
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder))


@pytest.fixture
def canvas(qtbot):
    """A canvas that shows the polygon of a boat, fitted."""
    from mouse import boat, shown

    return shown(qtbot, boat())


@pytest.fixture
def session(canvas):
    """The session of the canvas."""
    return canvas.session


@pytest.fixture
def mouse(canvas):
    """A mouse over the canvas."""
    from mouse import Mouse

    return Mouse(canvas)
