import gc
import importlib
import inspect
import pkgutil
import sys

import pytest
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

import app
from app.guard import guarded
from app.window import MainWindow

# Called by Qt when it likes: an exception must not leave them.
ENTRY_POINTS = ("app.__main__",)


def qt_classes():
    """Every class of the application that derives from a class of Qt's."""
    found = set()
    for module in pkgutil.iter_modules(app.__path__, "app."):
        if module.name in ENTRY_POINTS:
            continue
        for _, member in inspect.getmembers(importlib.import_module(module.name), inspect.isclass):
            if issubclass(member, QObject) and member.__module__.startswith("app."):
                found.add(member)
    return sorted(found, key=lambda cls: cls.__qualname__)


def overrides(cls):
    """Methods that a class defines under a name that a class of Qt's (or pyqtgraph's) has too."""
    foreign = [base for base in cls.__mro__ if not base.__module__.startswith("app")]
    for name, member in vars(cls).items():
        known = any(name in vars(base) for base in foreign if base is not object)
        if inspect.isfunction(member) and known and not name.startswith("__"):
            yield name, member


def test_the_application_has_overrides_to_check():
    names = {f"{cls.__name__}.{name}" for cls in qt_classes() for name, _ in overrides(cls)}
    assert {"MainWindow.closeEvent", "Canvas.mousePressEvent", "Track.paintEvent"} <= names


@pytest.mark.parametrize("cls", qt_classes(), ids=lambda cls: cls.__name__)
def test_every_override_is_guarded(cls):
    bare = [name for name, member in overrides(cls) if not getattr(member, "is_guarded", False)]
    assert bare == [], f"{cls.__qualname__}: wear @guarded"


class Fragile(QWidget):
    @guarded
    def paintEvent(self, event):  # noqa: N802
        return [][1 // 0]

    @guarded
    def resizeEvent(self, event):  # noqa: N802
        raise ValueError("resize")

    @guarded
    def closeEvent(self, event):  # noqa: N802
        raise ValueError("close")


def test_an_exception_in_an_override_is_reported_and_survived(qtbot, monkeypatch):
    reported = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: reported.append(kind))
    widget = Fragile()
    qtbot.addWidget(widget)
    widget.resize(50, 50)
    widget.show()
    widget.repaint()
    widget.grab()
    widget.resize(60, 60)
    widget.close()
    assert set(reported) == {ZeroDivisionError, ValueError}


def test_the_guard_hands_on_arguments_and_result():
    class Sum:
        @guarded
        def add(self, first, second=0):
            """Add."""
            return first + second

    assert Sum().add(2, second=3) == 5
    assert Sum.add.__doc__ == "Add."
    assert Sum.add.is_guarded


def test_calls_that_return_nothing_keep_the_count_of_none(qtbot):
    # PySide6 6.12 below Python 3.12 loses a reference to None on each such call, until the
    # interpreter aborts. From 3.12 on None is immortal and the count must not move at all.
    widget = QWidget()
    qtbot.addWidget(widget)
    gc.collect()
    before = sys.getrefcount(None)
    for _ in range(1_000):
        widget.update()
    after = sys.getrefcount(None)
    assert abs(after - before) <= (50 if sys.version_info < (3, 12) else 0)


def test_a_window_that_is_gone_leaves_no_hook(qtbot):
    window = MainWindow()
    qtbot.addWidget(window)
    assert sys.excepthook.__module__ != "app.failures"
