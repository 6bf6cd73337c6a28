"""The import dialog: what a file of another program holds, and how its lines become curves."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Final

from PySide6.QtCore import QEvent, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QIcon, QPalette
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QRadioButton,
    QScrollArea,
    QStackedWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.fields import NumberField
from app.guard import guarded
from app.import_found import Found, contents, taking
from app.import_picture import sight_of
from app.import_preview import Preview
from app.import_way import Way
from app.style import palette_of
from app.worker import Worker
from core.errors import ParameterError
from core.family import Parameters
from core.formats.sketch import UNITS_MM, Sketch

FIRST_SIZE: Final = (880, 560)
SIDE_PX: Final = 300
"""Breadth of the column of choices."""

INDENT_PX: Final = 22
"""Where the words of a choice begin, and what belongs to it."""

NOTES_LINES: Final = 5
"""Lines of notes that are seen without scrolling."""

MOST_FITTED: Final = 2_000
"""Lines and curves of a file up to which fitting begins by itself: it takes seconds."""

SHOWN_AFTER_MS: Final = 150
"""A bar that is gone sooner only flickers."""

WORDS: Final = {
    "mm": "Millimetres",
    "cm": "Centimetres",
    "m": "Metres",
    "in": "Inches",
    "ft": "Feet",
    "pt": "Points, 1/72 inch",
    "px": "Pixels, 1/96 inch",
    "µm": "Micrometres",
}
"""Names of the units of `UNITS_MM`."""


class ImportDialog(QDialog):
    """Unit, size and notes of a foreign drawing, its picture, and the choice of what it becomes.

    Parameters
    ----------
    sketch
        What was read.
    name
        What it is called: "wing.dxf", "the clipboard".
    verb
        What the button says: "Import".
    parameters
        The scheme that will draw the curves.
    way
        How it was done the last time.
    fitting, painting
        Workers in the background; they belong to whoever ends them.
    """

    def __init__(
        self,
        sketch: Sketch,
        name: str,
        verb: str,
        parameters: Parameters,
        way: Way,
        fitting: Worker,
        painting: Worker,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(f"{verb} {name}")
        self._sketch = sketch
        self._parameters = parameters
        self._fitting = fitting
        self._pieces = sum(len(trace.controls) for trace in sketch.traces)
        self.found: Found | None = None
        self.preview = Preview(painting)
        self.unit = QComboBox()
        self.unit.setAccessibleName("Unit of the file")
        self.unit.setToolTip("What a number in the file means; another unit changes the size")
        for unit in UNITS_MM:
            self.unit.addItem(f"{WORDS[unit]} ({unit})" if unit in WORDS else unit, unit)
        self.unit.setCurrentIndex(list(UNITS_MM).index(sketch.unit))
        self.doubt = QLabel("A guess: please check the size.")
        self.doubt.setVisible(not sketch.is_unit_known)
        self.size_label = QLabel()
        self.size_label.setAccessibleName("Size of the drawing")
        self.contents = QLabel(contents(sketch))
        self.contents.setAccessibleName("Contours of the file")
        pieces = "line or curve" if self._pieces == 1 else "lines and curves"
        self.pieces = QLabel(f"{self._pieces:,} {pieces}")
        self.pieces.setAccessibleName("Pieces of the contours")
        self.fit = QRadioButton("&Fit curves within")
        self.fit.setToolTip("Few control points whose curves keep to the lines, proven")
        self.field = NumberField("tolerance", check_tolerance)
        self.field.set_explanation("Largest distance between a line of the file and its curve")
        self.field.set_number(way.tolerance)
        self.field.setFixedWidth(self.field.fontMetrics().horizontalAdvance("0.000000") + 18)
        self.vertices = QRadioButton("Take the &vertices as control points")
        self.vertices.setToolTip(
            "The corners and joints of the lines become control points; the curves run near them"
        )
        wants_fit = way.is_fit and self._pieces <= MOST_FITTED
        (self.fit if wants_fit else self.vertices).setChecked(True)
        self.outcome = QLabel()
        self.outcome.setAccessibleName("What it becomes")
        self.outcome.setWordWrap(True)
        self.outcome.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.progress = QProgressBar()
        self.progress.setAccessibleName("Progress of the fit")
        self.progress.setRange(0, len(sketch.traces) if len(sketch.traces) > 1 else 0)
        self.progress.setTextVisible(False)
        self.halt = QToolButton()
        self.halt.setText("&Stop")
        self.halt.setToolTip("Stop the fit; the dialog stays open")
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.take = self.buttons.addButton(f"&{verb}", QDialogButtonBox.ButtonRole.AcceptRole)
        self.buttons.button(QDialogButtonBox.StandardButton.Cancel).setIcon(QIcon())
        self._late = QTimer(self)
        self._late.setSingleShot(True)
        self._late.setInterval(SHOWN_AFTER_MS)
        self._lay_out()
        self.take.setDefault(True)
        self._colour()
        self.resize(*FIRST_SIZE)
        self._connect()
        self.preview.show_sight(sight_of(sketch))
        self._show_size()
        self._ask()

    def _connect(self) -> None:
        self.unit.currentIndexChanged.connect(self._change_unit)
        self.fit.toggled.connect(self._ask)
        self.field.entered.connect(self._fit_anew)
        self.field.refused.connect(self._refuse)
        self.field.textEdited.connect(lambda: self.fit.setChecked(True))
        self.halt.clicked.connect(self._stop)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._late.timeout.connect(lambda: self.state.setCurrentIndex(1))
        self._fitting.sent.connect(self.progress.setValue)
        self._fitting.done.connect(self._show)
        self._fitting.idle.connect(self._end_if_lost)

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.addRow("&Unit", self.unit)
        form.addRow("", self.doubt)
        form.addRow("Size", self.size_label)
        form.addRow("Contours", self.contents)
        form.addRow("Made of", self.pieces)
        tolerance = QHBoxLayout()
        tolerance.setSpacing(8)
        for part in (self.fit, self.field, QLabel("mm")):
            tolerance.addWidget(part)
        tolerance.addStretch()
        running = QWidget()
        row = QHBoxLayout(running)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.progress, 1)
        row.addWidget(self.halt)
        self.state = QStackedWidget()
        for page in (self.outcome, running):
            self.state.addWidget(page)
        self.state.setFixedHeight(4 * self.fontMetrics().lineSpacing())
        side = QVBoxLayout()
        side.setSpacing(8)
        side.addLayout(form)
        side.addSpacing(6)
        side.addWidget(_line())
        side.addSpacing(6)
        side.addLayout(tolerance)
        side.addWidget(self.vertices)
        side.addSpacing(2)
        side.addWidget(self.state)
        side.addStretch(1)
        if self._sketch.notes:
            side.addWidget(_heading("Not as in the file"))
            side.addWidget(self._notes())
        column = QWidget()
        column.setLayout(side)
        side.setContentsMargins(0, 0, 0, 0)
        column.setFixedWidth(SIDE_PX)
        both = QHBoxLayout()
        both.setSpacing(18)
        both.addWidget(self.preview, 1)
        both.addWidget(column)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 14)
        layout.setSpacing(14)
        layout.addLayout(both, 1)
        layout.addWidget(self.buttons)
        order = (self.unit, self.fit, self.vertices, self.field, self.halt, self.preview)
        for first, second in pairwise(order):
            self.setTabOrder(first, second)
        self.fit.setFocus()

    def _notes(self) -> QScrollArea:
        words = QLabel("\n".join(f"\N{EN DASH} {note}" for note in self._sketch.notes))
        words.setAccessibleName("Notes on the file")
        words.setWordWrap(True)
        words.setAlignment(Qt.AlignmentFlag.AlignTop)
        words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        area = QScrollArea()
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setWidget(words)
        line = self.fontMetrics().lineSpacing()
        area.setMinimumHeight(2 * line)
        area.setMaximumHeight(min(words.heightForWidth(SIDE_PX - 20), NOTES_LINES * line) + 4)
        return area

    @property
    def way(self) -> Way:
        """How the lines are taken over."""
        return Way(self.fit.isChecked(), self.field.number)

    @property
    def factor(self) -> float:
        """How much larger the drawing is than in the unit of the file."""
        return UNITS_MM[self.unit.currentData()] / UNITS_MM[self._sketch.unit]

    @property
    def is_busy(self) -> bool:
        """Whether it is being found out what the drawing becomes."""
        return self.found is None and self._fitting.is_busy

    @guarded
    def accept(self) -> None:
        """Close with yes, if there is something to be taken over."""
        if not self.field.fault and self.found is not None and self.found.document is not None:
            super().accept()

    @guarded
    def done(self, result: int) -> None:
        """End the work in the background with the dialog."""
        self._late.stop()
        self._fitting.cancel()
        self.preview.end()
        super().done(result)

    @guarded
    def sizeHint(self) -> QSize:
        """Preview and choices side by side."""
        return QSize(*FIRST_SIZE)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Warn in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "outcome"):
            self._colour()

    def _colour(self) -> None:
        palette = QPalette()
        palette.setColor(QPalette.ColorRole.WindowText, QColor(palette_of(self).warning))
        self.doubt.setPalette(palette)
        fails = self.found is not None and self.found.document is None
        self.outcome.setPalette(palette if fails else QPalette())

    def _change_unit(self) -> None:
        self._show_size()
        self._ask()

    def _show_size(self) -> None:
        width, height = ((self._sketch.high - self._sketch.low) * self.factor).tolist()
        self.size_label.setText(f"{_length(width)} \u00d7 {_length(height)} mm")

    def _fit_anew(self) -> None:
        if self.fit.isChecked():
            self._ask()
        else:
            self.fit.setChecked(True)

    def _ask(self) -> None:
        """Find out what the drawing becomes as things are chosen now."""
        self.found = None
        self.take.setEnabled(False)
        self.progress.setValue(0)
        self._late.start()
        self._fitting.cancel()
        self._fitting.ask(
            taking(self._sketch, self.unit.currentData(), self._parameters, self.way)
        )

    def _stop(self) -> None:
        self._fitting.cancel()
        self._show(Found(None, "Stopped. Choose a larger tolerance, or take the vertices."))

    def _refuse(self, sentence: str) -> None:
        self._fitting.cancel()
        self._show(Found(None, sentence))

    def _end_if_lost(self) -> None:
        """A fault of the program was shown in the place of a result."""
        if self.found is None and not self._fitting.is_busy and self.isVisible():
            self._show(Found(None, "This did not succeed. Choose another way, or tolerance."))

    def _show(self, found: Found) -> None:
        self._late.stop()
        self.found = found
        self.state.setCurrentIndex(0)
        self.outcome.setText(found.words)
        self.take.setEnabled(found.document is not None)
        self._colour()
        if found.sight is not None:
            self.preview.show_sight(found.sight)


def check_tolerance(number: Fraction) -> None:
    """Refuse a tolerance that is not greater than 0; the fit knows the finer limits."""
    if number <= 0:
        raise ParameterError("tolerance must be greater than 0.")


def _length(value: float) -> str:
    """A length in mm: two decimals, or as many as a small one needs."""
    return f"{value:.2f}" if value >= 1 or value == 0 else f"{value:.3g}"


def _heading(words: str) -> QLabel:
    label = QLabel(words)
    label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
    return label


def _line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setForegroundRole(QPalette.ColorRole.Mid)
    return line
