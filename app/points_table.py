"""The table of points as such: its rows go to a spreadsheet and come back as numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QTableView, QWidget

from app.edits import counted
from app.point_set import PointSet
from app.session import Selection, Session
from core.document import Curve
from core.errors import NinepointError

SOURCE: Final = Path("The clipboard")
"""What stands in messages in the place of a file's name."""


class PointsTable(QTableView):
    """Table whose selected rows are cut, copied and pasted as two columns of numbers.

    Parameters
    ----------
    session
        The document, whose current curve is shown.

    Signals
    -------
    told(sentence)
        What was done, or why not.
    """

    told = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session

    def copy(self) -> None:
        """Copy the selected rows; without any, all of them."""
        curve = self._curve
        if curve is None or not curve.count:
            self.told.emit("There are no points to copy.")
            return
        rows = self._rows
        places = curve.places(rows) if len(rows) else curve.points
        QGuiApplication.clipboard().setText(as_text(places))
        self.told.emit(f"Copied {_points(len(places))} as numbers.")

    def cut(self) -> None:
        """Copy the selected rows and delete their points."""
        curve, rows = self._curve, self._rows
        if curve is None or not len(rows):
            self.told.emit("No row is selected that could be cut.")
            return
        self.copy()
        index = self._session.selection.curve
        document = self._session.document.with_curve(index, curve.without(rows))
        if len(rows) == curve.count:
            document = self._session.document.without_curves({index})
        self._session.commit()
        self._session.select(Selection(curve=index))
        self._session.edit(document, counted("Cut", len(rows)))

    def paste(self) -> None:
        """Put numbers in the place of the selected rows, or behind the last if none is selected."""
        curve = self._curve
        if curve is None:
            self.told.emit("There is no curve yet that points could be pasted into.")
            return
        try:
            places = from_text(QGuiApplication.clipboard().text())
            changed, pasted = with_rows(curve, self._rows, places)
            index = self._session.selection.curve
            document = self._session.document.with_curve(index, changed)
        except NinepointError as error:
            self.told.emit(str(error))
            return
        self._session.commit()
        self._session.edit(document, counted("Paste", len(places)))
        self._session.select(Selection(PointSet({index: pasted}), index))
        self.told.emit(f"Pasted {_points(len(places))}.")

    @property
    def _curve(self) -> Curve | None:
        curves = self._session.document.curves
        return curves[self._session.selection.curve] if curves else None

    @property
    def _rows(self) -> NDArray[np.intp]:
        """The selected rows; the session knows them all, the table marks no more than some."""
        selection = self._session.selection
        return selection.points.of_curve(selection.curve)


def as_text(places: NDArray[np.float64]) -> str:
    """Points as lines of x, tab, y; the shortest decimals that read back as the same floats."""
    return "".join(f"{x!r}\t{y!r}\n" for x, y in places.tolist())


def from_text(text: str) -> NDArray[np.float64]:
    """Points of two columns of numbers, shape (n, 2); see `core.formats.points`.

    Raises
    ------
    FileError
        If they are no such columns; with the line.
    """
    from core.formats import points

    (curve,) = points.decode(text.encode("utf-8", "replace"), SOURCE, closed=False).curves
    return curve.points


def with_rows(
    curve: Curve, rows: NDArray[np.intp], places: NDArray[np.float64]
) -> tuple[Curve, NDArray[np.intp]]:
    """Curve with points in the place of some rows, and the rows that they have.

    As many points as rows take their places one by one; others stand together, where the first of
    the rows was, or at the end if there are none.
    """
    if len(rows) == len(places):
        return curve.moved(rows, places), rows
    first = int(rows[0]) if len(rows) else curve.count
    rest = curve.without(rows)
    return rest.inserted(first, places), np.arange(first, first + len(places))


def _points(count: int) -> str:
    return "1 point" if count == 1 else f"{count:,} points"
