import gc
import sys
from threading import Event

import pytest
import shiboken6
from PySide6.QtCore import QCoreApplication, QThread

from app.worker import Worker


@pytest.fixture
def worker(qtbot):
    worker = Worker()
    yield worker
    worker.stop()


def held(gate, result):
    """A task that runs until its gate opens."""

    def task(_cancelled, _send):
        assert gate.wait(10)
        return result

    return task


def test_a_task_runs_elsewhere_and_is_heard_here(qtbot, worker):
    here = QThread.currentThread()
    heard = []
    worker.done.connect(lambda result: heard.append(QThread.currentThread()))
    with qtbot.waitSignal(worker.idle):
        worker.ask(lambda _cancelled, _send: QThread.currentThread() is here)
    assert heard == [here]


def test_of_the_tasks_that_wait_the_newest_is_done(qtbot, worker):
    gate, results = Event(), []
    worker.done.connect(results.append)
    worker.ask(held(gate, "first"))
    for name in ("second", "third", "fourth"):
        worker.ask(held(gate, name))
    assert worker.is_busy
    with qtbot.waitSignal(worker.idle):
        gate.set()
    assert results == ["first", "fourth"]
    assert not worker.is_busy


def test_what_is_cancelled_is_not_heard(qtbot, worker):
    gate, results, parts = Event(), [], []
    worker.done.connect(results.append)
    worker.sent.connect(parts.append)

    def task(cancelled, send):
        assert gate.wait(10)
        send("late")
        return cancelled()

    worker.ask(task)
    worker.ask(held(gate, "waits"))
    worker.cancel()
    assert not worker.is_busy
    with qtbot.waitSignal(worker.idle):
        gate.set()
    assert (results, parts) == ([], [])


def test_a_task_asked_for_after_a_cancelled_one_is_heard(qtbot, worker):
    gate, results = Event(), []
    worker.done.connect(results.append)
    worker.ask(held(gate, "old"))
    worker.cancel()
    worker.ask(held(gate, "new"))
    with qtbot.waitSignal(worker.done):
        gate.set()
    assert results == ["new"]


def test_parts_come_in_order_before_the_result(qtbot, worker):
    heard = []
    worker.sent.connect(heard.append)
    worker.done.connect(heard.append)

    def task(_cancelled, send):
        for part in range(3):
            send(part)
        return "all"

    with qtbot.waitSignal(worker.idle):
        worker.ask(task)
    assert heard == [0, 1, 2, "all"]


def test_a_fault_is_reported_and_the_next_task_is_done(qtbot, worker, monkeypatch):
    reported, results = [], []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: reported.append(kind))
    worker.done.connect(results.append)
    with qtbot.waitSignal(worker.idle):
        worker.ask(lambda _cancelled, _send: 1 // 0)
    with qtbot.waitSignal(worker.idle):
        worker.ask(lambda _cancelled, _send: "well")
    assert reported == [ZeroDivisionError]
    assert results == ["well"]


def test_stopping_waits_for_the_end(qtbot, worker):
    begun, ended = Event(), []

    def task(cancelled, _send):
        begun.set()
        while not cancelled():
            QThread.yieldCurrentThread()
        ended.append(True)

    worker.ask(task)
    assert begun.wait(10)
    worker.stop()
    assert ended == [True]
    QCoreApplication.processEvents()
    assert not worker.is_busy


def test_nothing_is_searched_for_garbage_while_a_task_runs(qtbot, worker):
    """Else windows would be taken apart in the task's thread."""
    gate, seen = Event(), []
    assert gc.isenabled()

    def task(_cancelled, _send):
        seen.append(gc.isenabled())
        assert gate.wait(10)

    worker.ask(task)
    worker.ask(task)
    with qtbot.waitSignal(worker.idle):
        gate.set()
    assert seen == [False, False]
    assert gc.isenabled()
    gate.clear()
    worker.ask(task)
    gate.set()
    worker.stop()
    assert gc.isenabled()


def test_a_worker_that_is_gone_takes_no_task_with_it(qtbot):
    """Its end must not wait for the task: that waits for Python's lock, which it may hold."""
    gate, ended = Event(), Event()

    def task(_cancelled, send):
        assert gate.wait(10)
        send("part")
        ended.set()

    lost = Worker()
    lost.ask(task)
    shiboken6.delete(lost)
    gate.set()
    assert ended.wait(10)
    following = Worker()
    with qtbot.waitSignal(following.idle):
        following.ask(lambda _cancelled, _send: None)
    assert gc.isenabled()
