"""What is known of the scheme of the document: roughly at once, and sharply when the hand rests."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from PySide6.QtCore import QObject, QTimer, Signal

from app.session import Session
from app.worker import Task, Worker
from core.continuity import Convergence, Effort, Smoothness, smoothness
from core.document import Document
from core.family import Parameters
from core.hoelder import HoelderInterval
from core.polytope import Cancelled
from core.report import Report, report
from core.wording import class_statement

REST_MS: Final = 150
"""The hand rests when no parameter has changed for so long."""

LIVE_MS: Final = 60
"""Where a glance leaves more to be said while parameters change, a thread looks again so often: one
that computes all the time would take the breath from the curve that follows the hand (measured: 18
instead of 11 ms a frame)."""

SHARP: Final = 1e-3
"""Width of a Hölder interval below which its digits are told instead of its ends."""


@dataclass(frozen=True)
class Finding:
    """What is proven of a member.

    Attributes
    ----------
    parameters
        The member.
    smoothness
        Class and Hölder interval.
    report
        All of it, if it was asked for and the hand rests.
    """

    parameters: Parameters
    smoothness: Smoothness
    report: Report | None = None

    @property
    def is_convergent(self) -> bool:
        """Whether it is proven that there is a continuous limit."""
        return self.smoothness.convergence is Convergence.PROVEN

    @property
    def statement(self) -> str:
        """The class in one line: ``C³ proven, not C⁴``."""
        smooth = self.smoothness
        return class_statement(smooth.order, smooth.not_class, smooth.convergence)

    @property
    def exponent(self) -> str:
        """The Hölder exponent, as far as it is known: ``Hölder 3.778–3.828``."""
        return f"H\u00f6lder {exponent_words(self.smoothness.exponent)}"

    @property
    def notice(self) -> str:
        """A sentence about what is drawn, or "" where there is a limit curve."""
        if self.is_convergent:
            return ""
        if self.smoothness.convergence is Convergence.DISPROVEN:
            return "This scheme does not converge, proven: drawn at a finite level."
        return "Convergence undecided: drawn at a finite level."


class Analysis(QObject):
    """Follows the parameters of a session.

    Each change is glanced at on the spot, so that the badge is painted with the curve. What a
    glance leaves wide is looked at again in the background; when the parameters rest the finding is
    narrowed, and the report made if somebody reads it.

    Parameters
    ----------
    session
        The document.

    Signals
    -------
    changed(finding)
        There is another `Finding`.
    rested()
        Nothing more will be found until the parameters change.
    """

    changed = Signal(object)
    rested = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._wants_report = False
        self._started = False
        self.finding: Finding | None = None
        self._quick, self._deep = Worker(self), Worker(self)
        self._live, self._rest = QTimer(self), QTimer(self)
        for timer, delay, act in (
            (self._live, LIVE_MS, self._look),
            (self._rest, REST_MS, self._narrow),
        ):
            timer.setSingleShot(True)
            timer.setInterval(delay)
            timer.timeout.connect(act)
        self._quick.done.connect(self._take_quick)
        self._deep.done.connect(self._take)
        for worker in (self._quick, self._deep):
            worker.idle.connect(self._tell_rest)
        session.changed.connect(self._on_changed)

    @property
    def is_at_rest(self) -> bool:
        """Whether nothing more will be found until the parameters change."""
        waits = self._live.isActive() or self._rest.isActive()
        return not (waits or self._quick.is_busy or self._deep.is_busy)

    def start(self) -> None:
        """Begin; the program's first paint does not wait for it."""
        self._started = True
        self._ask()

    def want_report(self, wanted: bool) -> None:
        """Make the report as well, from now on, or no longer."""
        self._wants_report = wanted
        found = self.finding
        is_missing = found is None or found.report is None
        if wanted and is_missing and self._started and not self._rest.isActive():
            self._deep.cancel()
            self._narrow()

    def stop(self) -> None:
        """End all work; returns when nothing runs any more."""
        self._live.stop()
        self._rest.stop()
        for worker in (self._quick, self._deep):
            worker.stop()

    def _on_changed(self, old: Document, new: Document) -> None:
        if self._started and old.parameters is not new.parameters:
            self._ask()

    def _ask(self) -> None:
        self._deep.cancel()
        self._rest.start()
        parameters = self._session.document.parameters
        finding = Finding(parameters, smoothness(parameters.mask, Effort.GLANCE))
        if not (finding.smoothness.exponent.is_narrow or self._live.isActive()):
            self._live.start()
        self._take(finding)

    def _look(self) -> None:
        self._quick.ask(_quick(self._session.document.parameters))

    def _narrow(self) -> None:
        self._deep.ask(_deep(self._session.document.parameters, self._wants_report))

    def _take_quick(self, finding: Finding) -> None:
        # One that comes late is of other parameters, or says less than the deep one before it.
        known = self.finding
        if known is None or (
            finding.parameters is known.parameters
            and finding.smoothness.exponent.width < known.smoothness.exponent.width
        ):
            self._take(finding)

    def _take(self, finding: Finding) -> None:
        self.finding = finding
        self.changed.emit(finding)

    def _tell_rest(self) -> None:
        if self.is_at_rest:
            self.rested.emit()


def _quick(parameters: Parameters) -> Task:
    """Task that finds what can be found within a frame or two."""

    def task(_cancelled: Cancelled, _send: Callable[[Any], None]) -> Finding:
        return Finding(parameters, smoothness(parameters.mask))

    return task


def _deep(parameters: Parameters, with_report: bool) -> Task:
    """Task that finds all, up to a second or two."""

    def task(cancelled: Cancelled, _send: Callable[[Any], None]) -> Finding:
        if not with_report:
            smooth = smoothness(parameters.mask, Effort.FULL, cancelled)
            return Finding(parameters, smooth)
        found = report(parameters, cancelled)
        return Finding(parameters, found.smoothness, found)

    return task


def exponent_words(interval: HoelderInterval) -> str:
    """A Hölder interval in short: its two ends, or the digits in which they agree.

    The ends are rounded outwards to three decimals. Digits that agree are cut off and never
    rounded, which the dots say.
    """
    low, high = interval.lower, interval.upper
    if low == high == round(low):
        return _signed(f"{low:.0f}")
    if interval.width < SHARP:
        for digits in (5, 4, 3):
            if _down(low, digits) == _down(high, digits):
                return _signed(f"{_down(low, digits):.{digits}f}\u2026")
    return f"{_signed(f'{_down(low, 3):.3f}')}\u2013{_signed(f'{-_down(-high, 3):.3f}')}"


def _down(value: float, digits: int) -> float:
    scale = 10.0**digits
    return math.floor(value * scale) / scale


def _signed(text: str) -> str:
    return text.replace("-", "\N{MINUS SIGN}")
