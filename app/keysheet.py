"""The sheet of keys: written from the table of actions, and the mouse's manners beside it."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon, QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from app.actions import COMMANDS, MENUS, Command, Reach, native

MOUSE: Final = (
    ("Click", "select a point"),
    ("Shift + click", "add to the selection"),
    ("Drag on empty", "select by a rectangle"),
    ("Drag a point", "move it; Shift keeps an axis"),
    ("Esc while dragging", "put everything back"),
    ("Double click on an edge", "insert a point"),
    ("Wheel", "zoom at the cursor"),
    ("Middle drag, Space + drag", "move the view"),
    ("Tab, Shift + Tab", "next, previous point"),
    ("Arrows", "nudge; Shift ten times as far"),
    ("Double click on a slider", "back to its mark"),
    ("Drop files, SVG, numbers", "open them, or add the curves"),
    ("Drag from the list of curves", "copy to another program"),
    ("Copy, paste in the table", "points as two columns of numbers"),
)
"""What the mouse, and keys without an action, do."""

Rows = list[tuple[str, str]]


class KeySheet(QDialog):
    """All keys at a glance."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Keys")
        page = QWidget()
        columns = QHBoxLayout(page)
        columns.setSpacing(36)
        columns.setContentsMargins(20, 16, 20, 16)
        for column in _columns():
            part = QVBoxLayout()
            part.setSpacing(4)
            metrics = self.fontMetrics()
            widest = max(metrics.horizontalAdvance(keys) for _, rows in column for keys, _ in rows)
            for title, rows in column:
                self._add(part, title, rows, widest)
            part.addStretch()
            columns.addLayout(part)
        area = QScrollArea()
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setWidget(page)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.button(QDialogButtonBox.StandardButton.Close).setIcon(QIcon())
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(area)
        layout.addWidget(buttons)
        room = page.sizeHint()
        margins = layout.contentsMargins()
        extra = buttons.sizeHint().height() + layout.spacing()
        self.resize(
            room.width() + margins.left() + margins.right() + 4,
            room.height() + extra + margins.top() + margins.bottom() + 4,
        )

    def _add(self, part: QVBoxLayout, title: str, rows: Rows, keys_px: int) -> None:
        heading = QLabel(title)
        font = heading.font()
        font.setBold(True)
        heading.setFont(font)
        part.addWidget(heading)
        grid = QGridLayout()
        grid.setHorizontalSpacing(16)
        grid.setVerticalSpacing(3)
        grid.setColumnStretch(1, 1)
        grid.setColumnMinimumWidth(0, keys_px)
        grid.setContentsMargins(0, 2, 0, 12)
        for row, (keys, words) in enumerate(rows):
            label = QLabel(keys)
            label.setForegroundRole(label.palette().ColorRole.PlaceholderText)
            grid.addWidget(label, row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(QLabel(words), row, 1)
        part.addLayout(grid)


def sheet() -> list[tuple[str, Rows]]:
    """Sections of the sheet: title, and rows of keys and what they do."""
    sections: list[tuple[str, Rows]] = []
    for menu in MENUS:
        rows = [
            (keys_in_words(command), command.words)
            for command in COMMANDS
            if command.menu == menu and command.sequences and command.reach is Reach.WINDOW
        ]
        if rows:
            sections.append((menu.replace("&", ""), rows))
    canvas = [
        (keys_in_words(command), command.words)
        for command in COMMANDS
        if command.sequences and command.reach is Reach.CANVAS
    ]
    return [*sections, ("On the canvas", canvas), ("Mouse and points", list(MOUSE))]


def _columns() -> list[list[tuple[str, Rows]]]:
    """The sections in two columns: menus left, canvas and mouse right."""
    sections = sheet()
    return [sections[:-2], sections[-2:]]


def keys_in_words(command: Command) -> str:
    """The keys of an action as this system writes them: "Ctrl+Z", "F1 or ?".

    Of a standard key's bindings only the first is told: the others are keys such as "Undo", which
    few keyboards have.
    """
    told: list[QKeySequence] = []
    for key in command.keys:
        bound = [QKeySequence(key)] if isinstance(key, str) else QKeySequence.keyBindings(key)[:1]
        told.extend(sequence for sequence in bound if sequence not in told)
    return " or ".join(native(sequence) for sequence in told)
