"""How large the drawing is: the box around all limit curves, told when the hand rests."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QTimer, Signal

from app.drawn import Drawn
from app.session import Session
from core.document import Document
from core.errors import NoLimitError

DELAY_MS: Final = 60
"""The size is looked for when nothing has changed for so long: it must not slow a drag."""

TOLERANCE_MM: Final = 2e-3
"""How far a curve may reach beyond the box, on each side: two decimals are shown."""


class Size(NamedTuple):
    """Size of a drawing in mm.

    Attributes
    ----------
    width, height
        Sides of the box around some points of its curves.
    deviation
        How far a curve leaves the box on any side, at most, proven; infinite where nothing is.
    """

    width: float
    height: float
    deviation: float

    @property
    def is_proven(self) -> bool:
        """Whether there is a bound at all."""
        return math.isfinite(self.deviation)

    @property
    def is_sharp(self) -> bool:
        """Whether the curves keep to the box within `TOLERANCE_MM`."""
        return self.deviation <= TOLERANCE_MM


class Measure(QObject):
    """Follows the size of a session's drawing.

    Parameters
    ----------
    session
        The document.
    curves
        Called for the curves as they are drawn now.

    Signals
    -------
    changed(size)
        The `Size` now; None where nothing is drawn.
    """

    changed = Signal(object)

    def __init__(
        self, session: Session, curves: Callable[[], Sequence[Drawn]], parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._curves = curves
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(DELAY_MS)
        self._timer.timeout.connect(self.look)
        self._started = False
        session.changed.connect(self._on_changed)

    def start(self) -> None:
        """Begin; the program's first paint does not wait for it."""
        self._started = True
        self._timer.start()

    def look(self) -> None:
        """Tell the size as it is now."""
        self.changed.emit(size_of(self._curves()))

    def _on_changed(self, old: Document, new: Document) -> None:
        is_other = old.curves is not new.curves or old.parameters is not new.parameters
        if is_other and self._started:
            self._timer.start()


def size_of(curves: Sequence[Drawn]) -> Size | None:
    """Size of all limit curves together; None without a point."""
    present = [drawn for drawn in curves if drawn.curve.count]
    if not present:
        return None
    try:
        outer = np.array([_outer(drawn) for drawn in present])
        reached, deviation = np.full(4, np.inf), 0.0
        waiting = np.ones(len(present), dtype=bool)
        while True:
            # Curves that lie within the box so far are not looked at.
            ahead = np.where(waiting, (reached - outer).max(axis=1), -np.inf)
            farthest = int(ahead.argmax())
            if not ahead[farthest] > TOLERANCE_MM:
                break
            waiting[farthest] = False
            found, more = _reach(present[farthest])
            reached, deviation = np.minimum(reached, found), max(deviation, more)
    except NoLimitError:
        return Size(0.0, 0.0, math.inf)
    deviation = max(deviation, float(ahead.max()))
    width, height = (-reached[2:] - reached[:2]).tolist()
    return Size(width, height, deviation)


def _outer(drawn: Drawn) -> NDArray[np.float64]:
    """Box that holds a curve: least x and y, and the negatives of the largest, shape (4,)."""
    figure = drawn.present()
    if figure.compact is not None:
        left, bottom, right, top = figure.compact.box
        return np.array([left, bottom, -right, -top])
    if figure.outline is not None:
        box = figure.outline.box
        low, high = figure.placed.box(box[:2], -box[2:])
    else:
        return _reach(drawn)[0]
    return np.concatenate([low, -high])


def _reach(drawn: Drawn) -> tuple[NDArray[np.float64], float]:
    """The same of points of the curve, and how far it leaves that box at most."""
    from core.extent import extent  # the first paint does not wait for it

    figure = drawn.present()
    if figure.limit is None:
        raise NoLimitError("The scheme has no limit curve.")
    if figure.outline is None:
        low, high = drawn.curve.box
        return np.concatenate([low, -high]), 0.0
    found = extent(figure.outline, TOLERANCE_MM, figure.placed)
    return np.concatenate([found.lower, -found.upper]), found.deviation
