"""The panel of curves and the table of their points, which is also the view for screen readers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np
from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QSize,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QStackedLayout,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from app.curves_list import CurvesList
from app.fields import typed_number
from app.guard import guarded
from app.point_set import PointSet
from app.points_table import PointsTable
from app.session import Selection, Session
from app.theme import soften
from core.document import Curve, Document
from core.errors import NinepointError

AXES: Final = ("x", "y")
"""Columns of the table."""

SHOWN_DECIMALS: Final = 3
"""Decimals of a coordinate in mm: micrometres."""

ROW_PADDING_PX: Final = 8
"""Air above and below the words of a row, together."""

MAX_SYNCHRONISED: Final = 2_000
"""Up to so many selected points are marked in the table; more would take longer than a frame."""

Index = QModelIndex | QPersistentModelIndex

TOLD_ROWS: Final = 64
"""Number of changed rows up to which each is told to the table by itself."""

TELLING_MS: Final = 50
"""While a hand moves points, the table follows so often: nobody could read more, and painting it
each time would cost the curve a tenth of its speed."""

RIGHT: Final = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
"""Where a coordinate stands in its cell."""

TELLING: Final = (
    Qt.ItemDataRole.DisplayRole,
    Qt.ItemDataRole.EditRole,
    Qt.ItemDataRole.AccessibleTextRole,
)
"""What a cell is asked for that its coordinate answers."""

ROOT: Final = QModelIndex()
"""What a table has as the parent of all of its cells."""


class CurvesPanel(QWidget):
    """List of the curves: the current one is that which new points go to.

    Choosing a curve selects all of its points; a double click, or F2, renames it.

    Parameters
    ----------
    session
        The document.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._showing = False
        self.list = CurvesList(session)
        self.list.setAccessibleName("Curves")
        self.list.setFrameShape(QListWidget.Shape.NoFrame)
        soften(self.list)
        self.list.currentRowChanged.connect(self._choose)
        self.list.itemChanged.connect(self._rename)
        self.empty = QLabel("No curves yet. Take the pen (P) and click on the canvas.")
        self._layout = _with_empty_state(self, self.list, self.empty)
        session.changed.connect(self._on_changed)
        session.selection_changed.connect(self._on_selected)
        self._show()

    def _choose(self, row: int) -> None:
        if self._showing or row < 0:
            return
        count = self._session.document.curves[row].count
        self._session.select(Selection(PointSet({row: np.arange(count)}), row))

    def _rename(self, item: QListWidgetItem) -> None:
        if self._showing:
            return
        index = self.list.row(item)
        curve = self._session.document.curves[index]
        name = item.text().strip()
        if name and name != curve.name:
            document = self._session.document.with_curve(index, replace(curve, name=name))
            self._session.edit(document, f"Rename curve to {name}")
        else:
            self._show()

    def _on_changed(self, old: Document, new: Document) -> None:
        if not new.lists_as(old):
            self._show()

    def _on_selected(self, old: Selection, new: Selection) -> None:
        if old.curve != new.curve:
            self._show()

    def _show(self) -> None:
        self._showing = True
        try:
            document = self._session.document
            self.list.clear()
            for curve in document.curves:
                item = QListWidgetItem(curve.name)
                item.setFlags(item.flags() | Qt.ItemFlag.ItemIsEditable)
                item.setToolTip(_described(curve))
                item.setData(Qt.ItemDataRole.AccessibleDescriptionRole, _described(curve))
                item.setSizeHint(QSize(0, self.list.fontMetrics().height() + ROW_PADDING_PX))
                self.list.addItem(item)
            if document.curves:
                self.list.setCurrentRow(self._session.selection.curve)
            self._layout.setCurrentIndex(0 if document.curves else 1)
        finally:
            self._showing = False

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Mark the selection in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "list"):
            soften(self.list)


class PointsModel(QAbstractTableModel):
    """The control points of the current curve, one a row, x and y in mm.

    Signals
    -------
    refused(sentence)
        A typed coordinate was refused.
    """

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._curve = self._told = self._present()
        self._telling = QTimer(self)
        self._telling.setSingleShot(True)
        self._telling.setInterval(TELLING_MS)
        self._telling.timeout.connect(self._tell_changes)
        session.changed.connect(lambda _old, _new: self._follow())
        session.selection_changed.connect(lambda _old, _new: self._follow())

    def _present(self) -> Curve | None:
        curves = self._session.document.curves
        return curves[self._session.selection.curve] if curves else None

    def _follow(self) -> None:
        old, new = self._curve, self._present()
        if old is new:
            return
        if old is not None and new is not None and old.count == new.count:
            self._curve = new
            if not self._session.in_gesture:
                self._tell_changes()
            elif not self._telling.isActive():
                self._telling.start()
        else:
            self.beginResetModel()
            self._curve = self._told = new
            self.endResetModel()

    def _tell_changes(self) -> None:
        """Have the rows that changed shown anew: the table asks only for those in view."""
        old, new, self._told = self._told, self._curve, self._curve
        if old is None or new is None or old is new:
            return
        # Beyond a move of all points together nothing may have changed.
        changed = old.differences(new) if old.placed is new.placed else None
        if changed is None or len(changed) > TOLD_ROWS:
            rows = [(0, self.rowCount() - 1)]
        else:
            rows = [(row, row) for row in changed.tolist()]
        for first, last in rows:
            self.dataChanged.emit(self.index(first, 0), self.index(last, len(AXES) - 1))

    @guarded
    def rowCount(self, parent: Index = ROOT) -> int:
        """Number of control points."""
        return 0 if self._curve is None or parent.isValid() else self._curve.count

    @guarded
    def columnCount(self, parent: Index = ROOT) -> int:
        """Two: x and y."""
        return 0 if parent.isValid() else len(AXES)

    @guarded
    def headerData(
        self,
        section: int,
        orientation: Qt.Orientation,
        role: int = Qt.ItemDataRole.DisplayRole,
    ) -> Any:
        """Names of the columns; the points are counted from 1."""
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        if orientation == Qt.Orientation.Horizontal:
            return f"{AXES[section]} (mm)"
        return str(section + 1)

    @guarded
    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """A coordinate: rounded for the eye, in full for editing."""
        if self._curve is None or not index.isValid():
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT
        if role not in TELLING:
            return None
        value = float(self._curve.places([index.row()])[0, index.column()])
        if role == Qt.ItemDataRole.DisplayRole:
            return shown_length(value)
        if role == Qt.ItemDataRole.EditRole:
            return f"{value:.12g}"
        if role == Qt.ItemDataRole.AccessibleTextRole:
            axis = AXES[index.column()]
            return f"Point {index.row() + 1}, {axis} {shown_length(value)} millimetres"
        return None

    @guarded
    def flags(self, index: Index) -> Qt.ItemFlag:
        """Each coordinate can be selected and edited."""
        return super().flags(index) | Qt.ItemFlag.ItemIsEditable

    @guarded
    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Move a point to a typed coordinate; nonsense is refused and changes nothing."""
        if role != Qt.ItemDataRole.EditRole or self._curve is None:
            return False
        row, axis = index.row(), index.column()
        text = str(value)
        if text == self.data(index, Qt.ItemDataRole.EditRole):
            return False
        try:
            position = self._curve.places([row])[0]
            position[axis] = float(typed_number(text, AXES[axis]))
            moved = self._curve.moved(row, position)
        except NinepointError as error:
            self.refused.emit(str(error))
            return False
        document = self._session.document.with_curve(self._session.selection.curve, moved)
        self._session.edit(document, f"Set {AXES[axis]} of point {row + 1}")
        return True


class PointsPanel(QWidget):
    """Table of the current curve's points; its selection is that of the canvas.

    Parameters
    ----------
    session
        The document.

    Signals
    -------
    refused(sentence)
        A typed coordinate was refused.
    told(sentence)
        Rows were copied or pasted, or could not be.
    """

    refused = Signal(str)
    told = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._showing = False
        self.model = PointsModel(session, self)
        self.table = PointsTable(session)
        self.table.told.connect(self.told)
        self.table.setAccessibleName("Points of the current curve")
        self.table.setModel(self.model)
        soften(self.table)
        self.table.setFrameShape(QTableView.Shape.NoFrame)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setAlternatingRowColors(True)
        self.table.setShowGrid(False)
        # Tab leaves the table, so that the keyboard is not trapped in a long list.
        self.table.setTabKeyNavigation(False)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        rows = self.table.verticalHeader()
        rows.setDefaultSectionSize(self.table.fontMetrics().height() + ROW_PADDING_PX)
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        rows.setDefaultAlignment(Qt.AlignmentFlag.AlignCenter)
        rows.setMinimumWidth(rows.fontMetrics().horizontalAdvance("0000") + 8)
        self.empty = QLabel("The points of the current curve are listed here.")
        self._layout = _with_empty_state(self, self.table, self.empty)
        self.model.refused.connect(self.refused)
        self.model.modelReset.connect(self._show_selection)
        self.table.selectionModel().selectionChanged.connect(self._select)
        session.selection_changed.connect(lambda _old, _new: self._show_selection())
        self._show_selection()

    def _select(self) -> None:
        if self._showing:
            return
        curve = self._session.selection.curve
        rows = {index.row() for index in self.table.selectionModel().selectedRows()}
        self._session.select(Selection(PointSet({curve: sorted(rows)}), curve))

    def _show_selection(self) -> None:
        self._layout.setCurrentIndex(0 if self.model.rowCount() else 1)
        selection = self._session.selection
        points = selection.points.of_curve(selection.curve)
        rows = points[points < self.model.rowCount()].tolist()
        chosen = QItemSelection()
        for row in rows[:MAX_SYNCHRONISED]:
            first = self.model.index(row, 0)
            chosen.select(first, self.model.index(row, len(AXES) - 1))
        self._showing = True
        try:
            self.table.selectionModel().select(
                chosen, QItemSelectionModel.SelectionFlag.ClearAndSelect
            )
        finally:
            self._showing = False
        if len(rows) == 1:
            self.table.scrollTo(self.model.index(rows[0], 0))

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Mark the selection in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "table"):
            soften(self.table)


def shown_length(value: float) -> str:
    """A length in mm as it is shown in tables: micrometres, with a true minus sign."""
    return f"{value:.{SHOWN_DECIMALS}f}".replace("-", "\N{MINUS SIGN}")


def _described(curve: Curve) -> str:
    kind = "closed" if curve.closed else "open"
    count = curve.count
    return f"{kind}, {count:,} point{'' if count == 1 else 's'}"


def _with_empty_state(parent: QWidget, view: QWidget, empty: QLabel) -> QStackedLayout:
    """Lay a view out with the words that take its place while it is empty."""
    empty.setWordWrap(True)
    empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
    empty.setMargin(16)
    empty.setForegroundRole(empty.palette().ColorRole.PlaceholderText)
    outer = QVBoxLayout(parent)
    outer.setContentsMargins(0, 0, 0, 0)
    stack = QStackedLayout()
    stack.addWidget(view)
    stack.addWidget(empty)
    outer.addLayout(stack)
    return stack
