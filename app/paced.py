"""Values that come faster than one can read them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QWidget

T = TypeVar("T")


class Paced(Generic[T]):
    """Hands on the first of some values at once, and of those that follow the newest in a while.

    Parameters
    ----------
    take
        Takes the values.
    interval_ms
        The least time between two of them.
    parent
        With whom it ends.
    """

    def __init__(self, take: Callable[[T], None], interval_ms: int, parent: QWidget) -> None:
        self._take = take
        self._waiting: list[T] = []
        self._pause = QTimer(parent)
        self._pause.setSingleShot(True)
        self._pause.setInterval(interval_ms)
        self._pause.timeout.connect(self._go_on)

    def offer(self, value: T) -> None:
        """Hand on a value, now or after the pause; unless another one comes until then."""
        self._waiting = [value]
        if not self._pause.isActive():
            self._go_on()

    def settle(self, value: T) -> None:
        """Hand on a value now, whatever was before."""
        self._waiting = []
        self._pause.stop()
        self._take(value)

    def _go_on(self) -> None:
        if self._waiting:
            self._pause.start()
            self._take(self._waiting.pop())
