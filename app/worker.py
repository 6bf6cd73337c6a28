"""A worker: computes in the background, one task at a time, and hands the result to the window."""

from __future__ import annotations

import contextlib
import gc
import sys
from collections.abc import Callable
from threading import Thread
from typing import Any

from PySide6.QtCore import QObject, Signal

from core.polytope import Cancelled

Task = Callable[[Cancelled, Callable[[Any], None]], Any]
"""Computes something; it may ask whether it is cancelled, and send parts before the result."""


class _Quiet:
    """Keeps Python from searching for garbage while a task runs.

    It searches in the thread that happens to allocate, and would take windows that are garbage
    apart there; Qt does not admit that.
    """

    def __init__(self) -> None:
        self._threads: set[Thread] = set()
        self._searched = False

    def begin(self, thread: Thread) -> None:
        """A thread begins to run."""
        if not self._threads:
            self._searched = gc.isenabled()
        self._threads.add(thread)
        gc.disable()

    def end(self, thread: Thread) -> None:
        """A thread has come to its end, or as good as that."""
        if thread not in self._threads:
            return
        self._threads.remove(thread)
        # A worker that is gone has not told of the end of its thread.
        self._threads = {other for other in self._threads if other.is_alive()}
        if not self._threads and self._searched:
            gc.enable()


_QUIET = _Quiet()


class Worker(QObject):
    """Runs tasks in a thread of its own; of those that wait, only the newest is kept.

    Each task has a generation number. What a cancelled one sends is not heard any more, even if it
    is on its way already.

    The thread is one of Python's. Qt's pool waits for its threads when it is destroyed; where that
    happens within Python's lock, a task would wait for the lock, and both forever.

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
        self._thread: Thread | None = None
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
        thread = self._thread
        if thread is not None:
            thread.join()
            _QUIET.end(thread)

    def _start(self) -> None:
        task, self._waiting = self._waiting, None
        if task is None:
            return
        self._running = True
        self._generation += 1
        thread = Thread(target=self._job(self._generation, task), daemon=True)
        self._thread = thread
        _QUIET.begin(thread)
        thread.start()

    def _job(self, generation: int, task: Task) -> Callable[[], None]:
        """What the thread does; signals carry what it finds over to the window's thread."""

        def cancelled() -> bool:
            return self._cancelled >= generation

        def send(part: Any) -> None:
            if not cancelled():
                with contextlib.suppress(RuntimeError):
                    self._came.emit(generation, part)

        def job() -> None:
            result, fault = None, None
            try:
                result = task(cancelled, send)
            except Exception:
                fault = sys.exc_info()
            with contextlib.suppress(RuntimeError):  # the window is gone, and the worker with it
                self._ended.emit(generation, result, fault)

        return job

    def _take_part(self, generation: int, part: Any) -> None:
        if generation > self._cancelled:
            self.sent.emit(part)

    def _take_result(self, generation: int, result: Any, fault: Any) -> None:
        self._running = False
        heard = generation > self._cancelled
        if self._thread is not None:
            _QUIET.end(self._thread)
        self._start()
        if fault is not None:
            sys.excepthook(*fault)
        elif heard:
            self.done.emit(result)
        if not self._running:
            self.idle.emit()
