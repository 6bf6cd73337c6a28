import gc

import pytest
from PySide6.QtCore import qInstallMessageHandler, qWarning

from app import launch
from app.launch import IDLE_MESSAGE, run


@pytest.fixture
def as_in_a_terminal():
    """Qt's own messages as they are without the tests' logging of them."""
    before = qInstallMessageHandler(None)
    yield
    qInstallMessageHandler(before)


def test_a_screenshot_is_silent(qtbot, tmp_path, as_in_a_terminal, capfd):
    assert run(None, tmp_path / "window.png", (900, 600), "light") == 0
    assert capfd.readouterr() == ("", "")


def test_the_search_for_garbage_begins_after_the_first_paint(qtbot, tmp_path, monkeypatch):
    searched = []
    monkeypatch.setattr(gc, "freeze", lambda: searched.append("frozen"))
    monkeypatch.setattr(gc, "set_threshold", lambda *numbers: searched.append("rarely"))
    monkeypatch.setattr(launch, "_draw", lambda window, *args: window.painted.emit() or 0)
    gc.disable()
    try:
        run(None, tmp_path / "window.png")
        assert gc.isenabled()
    finally:
        gc.enable()
    run(None, tmp_path / "window.png")
    assert searched == ["frozen", "rarely"]  # who has not stopped the search keeps it as it is


def test_other_messages_of_qt_are_told(qtbot, tmp_path, as_in_a_terminal, capfd, monkeypatch):
    def tell(*args):
        qWarning(IDLE_MESSAGE)
        qWarning("Something else, which matters")
        return 0

    monkeypatch.setattr(launch, "_draw", tell)
    assert run(None, tmp_path / "window.png") == 0
    assert capfd.readouterr().err == "Something else, which matters\n"


def test_the_handler_before_is_put_back(qtbot, tmp_path):
    def handler(kind, context, message):
        pass

    before = qInstallMessageHandler(handler)
    try:
        assert run(None, tmp_path / "window.png") == 0
    finally:
        after = qInstallMessageHandler(before)
    assert after is handler
