"""A worker: computes in the background, one task at a time, and hands the result to the window."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QThreadPool, Signal

from core.polytope import Cancelled

Task = Callable[[Cancelled, Callable[[Any], None]], Any]
"""Computes something; it may ask whether it is cancelled, and send parts before the result."""


class Worker(QObject):
    """Runs tasks in a thread of its own; of those that wait, only the newest is kept.

    Each task has a generation number. What a cancelled one sends is not heard any more, even if it
    is on its way already.

    Signals
    -------
    sent(part)
        The running task has a part of its result.
    done(result)
        The running task has come to its end.
    idle()
        Nothing runs or waits any more, whatever became of the last task.
    """

    sent = Signal(object)
    done = Signal(object)
    idle = Signal()
    _came = Signal(int, object)
    _ended = Signal(int, object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pool = QThreadPool(self)
        self._pool.setMaxThreadCount(1)
        self._generation = 0
        self._cancelled = 0
        self._running = False
        self._waiting: Task | None = None
        self._came.connect(self._take_part)
        self._ended.connect(self._take_result)

    @property
    def is_busy(self) -> bool:
        """Whether a task that is not cancelled runs or waits."""
        return self._waiting is not None or (self._running and self._generation > self._cancelled)

    def ask(self, task: Task) -> None:
        """Have a task done after the one that is running, in place of any that waits."""
        self._waiting = task
        if not self._running:
            self._start()

    def cancel(self) -> None:
        """Forget the task that waits and what the running one finds."""
        self._waiting = None
        self._cancelled = self._generation

    def stop(self) -> None:
        """Cancel, and wait until nothing runs any more; to be called before the program ends."""
        self.cancel()
        self._pool.clear()
        self._pool.waitForDone()

    def _start(self) -> None:
        task, self._waiting = self._waiting, None
        if task is None:
            return
        self._running = True
        self._generation += 1
        self._pool.start(self._job(self._generation, task))

    def _job(self, generation: int, task: Task) -> Callable[[], None]:
        """What the thread does; signals carry what it finds over to the window's thread."""

        def cancelled() -> bool:
            return self._cancelled >= generation

        def send(part: Any) -> None:
            if not cancelled():
                self._came.emit(generation, part)

        def job() -> None:
            result, fault = None, None
            try:
                result = task(cancelled, send)
            except Exception:
                fault = sys.exc_info()
            self._ended.emit(generation, result, fault)

        return job

    def _take_part(self, generation: int, part: Any) -> None:
        if generation > self._cancelled:
            self.sent.emit(part)

    def _take_result(self, generation: int, result: Any, fault: Any) -> None:
        self._running = False
        heard = generation > self._cancelled
        self._start()
        if fault is not None:
            sys.excepthook(*fault)
        elif heard:
            self.done.emit(result)
        if not self._running:
            self.idle.emit()
