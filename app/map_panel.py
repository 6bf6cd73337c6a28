"""The map panel: one number over a plane of parameters, to look at and to choose from."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QTimer
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from app.chart import Chart, Scale
from app.fields import shown_number
from app.guard import guarded
from app.session import Session
from app.worker import Task, Worker
from core.atlas import Plane, Quantity, parameter_map
from core.document import Document
from core.family import Parameters, default_box
from core.polytope import Cancelled
from core.wording import class_name

SIZE: Final = 101
"""Values of each parameter in a map: in the proven box, steps of 1/100 and less."""

PAUSE_MS: Final = 120
"""A map through another plane is begun when the parameters have rested for so long."""

KEPT: Final = 8
"""Maps that are kept: all quantities and planes of a session's few values of gamma."""

PLANES: Final = ("\u03b1, \u03b2", "\u03b1 = \u03b3, \u03b2")
"""The planes on offer: through the present gamma, and that of the symmetric members."""

SCALES: Final = {
    Quantity.CLASS: Scale("Class", 0, 5, 1, lambda value: class_name(round(value))),
    Quantity.HOELDER: Scale("H\u00f6lder exponent", 0, 5, 1, lambda value: f"{value:.0f}"),
    Quantity.OVERSHOOT: Scale("Overshoot", 0, 0.5, 0.1, lambda value: f"{100 * value:.0f} %"),
}
"""How each quantity is coloured and labelled."""

Key = tuple[Plane, Quantity]


class MapPanel(QWidget):
    """A map of class, Hölder exponent or overshoot; a click or a drag in it sets the parameters.

    It is computed in the background, and only while it is seen.

    Parameters
    ----------
    session
        The document.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._shown: Key | None = None
        self._kept: dict[Key, NDArray[np.float64]] = {}
        self._worker = Worker(self)
        self._worker.sent.connect(self._take)
        self._worker.done.connect(self._keep)
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE_MS)
        self._pause.timeout.connect(self._compute)
        self.quantity, self.plane = QComboBox(), QComboBox()
        self.chart = Chart()
        self.words = QLabel()
        self._lay_out()
        for choice in (self.quantity, self.plane):
            choice.currentIndexChanged.connect(self._compute)
        self.chart.begun.connect(lambda: session.begin(self._name(session.document.parameters)))
        self.chart.chosen.connect(self._choose)
        self.chart.ended.connect(session.commit)
        self.chart.dropped.connect(session.cancel)
        session.changed.connect(self._on_changed)

    def _lay_out(self) -> None:
        self.quantity.setAccessibleName("Quantity of the map")
        self.plane.setAccessibleName("Plane of the map")
        for quantity, scale in SCALES.items():
            self.quantity.addItem(scale.name, quantity)
        for name in PLANES:
            self.plane.addItem(name)
        self.quantity.setToolTip("What the map shows")
        self.plane.setToolTip(
            "Which members the map shows: all \u03b1 and \u03b2 with the present \u03b3, or those"
            " with \u03b1 = \u03b3"
        )
        self.words.setForegroundRole(self.words.palette().ColorRole.PlaceholderText)
        self.words.setAccessibleName("Value of the map at the present parameters")
        choices = QHBoxLayout()
        choices.addWidget(self.quantity, 1)
        choices.addWidget(self.plane, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 10, 12, 10)
        layout.setSpacing(8)
        layout.addLayout(choices)
        layout.addWidget(self.chart, 1)
        layout.addWidget(self.words)

    @property
    def is_busy(self) -> bool:
        """Whether the map is not complete yet."""
        return self._pause.isActive() or self._worker.is_busy

    @property
    def is_symmetric(self) -> bool:
        """Whether the plane alpha = gamma is shown."""
        return self.plane.currentIndex() == 1

    def stop(self) -> None:
        """End all work; returns when nothing runs any more."""
        self._pause.stop()
        self._worker.stop()

    def _wanted(self) -> Key:
        p = self._session.document.parameters
        box = default_box(p.neighbours)
        zero = Fraction(0)
        if self.is_symmetric:
            plane = Plane((zero, zero, zero), (1, 0, 1), (0, 1, 0), box["alpha"], box["beta"])
        else:
            plane = Plane(
                (zero, zero, p.gamma), (1, 0, 0), (0, 1, 0), box["alpha"], box["beta"], p.neighbours
            )
        return plane, self.quantity.currentData()

    def _compute(self) -> None:
        self._pause.stop()
        self._worker.cancel()
        key, before = self._wanted(), self._shown
        self._shown = key
        scale = SCALES[key[1]]
        known = self._kept.get(key)
        if known is not None:
            self.chart.show_map(key[0], known, scale)
        elif self.isVisible():
            # A map of the same kind stays until the new one has come over it, row by row.
            under = np.full((SIZE, SIZE), np.nan)
            if before is not None and self._is_like(before, key):
                under = self.chart.values.copy()
            self.chart.show_map(key[0], under, scale)
            self._worker.ask(_map_task(*key))
        self._mark()

    @staticmethod
    def _is_like(one: Key, other: Key) -> bool:
        """Whether two maps show the same quantity over the same ranges."""
        same_ranges = (one[0].u_range, one[0].u_axis) == (other[0].u_range, other[0].u_axis)
        return same_ranges and one[1] is other[1]

    def _take(self, part: tuple[slice, NDArray[np.float64]]) -> None:
        self.chart.show_rows(*part)
        self._tell()

    def _keep(self, _result: object) -> None:
        if self._shown is not None:
            while len(self._kept) >= KEPT:
                self._kept.pop(next(iter(self._kept)))
            self._kept[self._shown] = self.chart.values

    def _choose(self, u: float, v: float) -> None:
        """Take over a place of the map, within the gesture that is open."""
        old = self._session.document.parameters
        alpha, beta = self.chart.snapped(u, v)
        gamma = alpha if self.is_symmetric else old.gamma
        new = Parameters(alpha, beta, gamma, old.neighbours)
        if new != old and self._session.in_gesture:
            self._session.adjust(self._session.document.with_parameters(new), self._name(new))

    def _name(self, parameters: Parameters) -> str:
        first = "alpha and gamma" if self.is_symmetric else "alpha"
        alpha, beta = shown_number(parameters.alpha), shown_number(parameters.beta)
        return f"Set {first} {alpha}, beta {beta}"

    def _on_changed(self, old: Document, new: Document) -> None:
        if old.parameters is new.parameters or not self.isVisible():
            return
        if self._wanted() != self._shown:
            self._pause.start()
        self._mark()

    def _mark(self) -> None:
        """Put the cross at the present member, if it lies in the plane."""
        p = self._session.document.parameters
        lies_here = not self.is_symmetric or p.alpha == p.gamma
        self.chart.mark((float(p.alpha), float(p.beta)) if lies_here else None)
        self._tell()

    def _tell(self) -> None:
        value = self.chart.value_here()
        if self.chart.cross is None:
            words = "\u03b1 and \u03b3 differ: not on this plane"
        elif value is None:
            words = "outside the map"
        else:
            words = _described(self.quantity.currentData(), value)
        self.words.setText(words)

    @guarded
    def showEvent(self, event: QShowEvent) -> None:
        """Compute what will be seen."""
        super().showEvent(event)
        self._compute()

    @guarded
    def hideEvent(self, event: QHideEvent) -> None:
        """Compute no more."""
        super().hideEvent(event)
        self._pause.stop()
        self._worker.cancel()


def _map_task(plane: Plane, quantity: Quantity) -> Task:
    """Task that sends a map in blocks of rows."""

    def task(cancelled: Cancelled, send: Callable[[Any], None]) -> None:
        for block in parameter_map(plane, quantity, SIZE):
            if cancelled():
                return
            send(block)

    return task


def _described(quantity: Quantity, value: float) -> str:
    """Value of a map in words; the map's proofs are shorter than the badge's."""
    if np.isnan(value):
        return "\N{HORIZONTAL ELLIPSIS}"
    if quantity is Quantity.OVERSHOOT:
        return f"overshoot about {100 * value:.1f} %"
    if value < 0:
        return "no proof of convergence with L up to 6"
    if quantity is Quantity.CLASS:
        return f"at least {class_name(round(value))}"
    return f"H\u00f6lder exponent at least {np.floor(100 * value) / 100:.2f}"
