"""The fields of an export profile: those that its format has, each with a sentence on its use."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any, Final

import msgspec
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QHBoxLayout, QLabel, QWidget

from app.colour_field import ColourField
from app.fields import NumberField
from core.errors import NinepointError, ParameterError
from core.profiles import ENTITIES, LAYERS, ORIGINS, UNITS_MM, VERSIONS, Profile

COLUMNS: Final = 2
"""Fields side by side."""

_TABLES: Final = ("csv", "tsv", "json")
_OUTLINES: Final = ("dxf", "svg", "pdf", "png")
_PAGES: Final = ("svg", "pdf", "png")

WORDS: Final = {
    "arcs": "Arcs",
    "polyline": "Straight lines",
    "spline": "Spline",
    "cubics": "B\u00e9zier curves",
    "control points": "Control points",
    "limit points": "Points of the curve",
    "mm": "Millimetres",
    "in": "Inches",
    "one": "One for all",
    "by curve": "One for each curve",
    "drawing": "As drawn",
    "corner": "Lower left corner",
    "csv": "CSV, commas",
    "tsv": "TSV, tabs",
    "json": "JSON",
}
"""What the values of a profile are called here, if not as they are."""


@dataclass(frozen=True)
class Row:
    """One field of a profile, as the dialog presents it.

    Attributes
    ----------
    key
        Field of `core.profiles.Profile`.
    label
        Its name; "&" marks the letter that Alt calls.
    tip
        A sentence on what it means.
    applies
        Whether a profile has it.
    choices
        The values that a format admits; none for a number or a colour.
    unit
        Of a number.
    """

    key: str
    label: str
    tip: str
    applies: Callable[[Profile], bool]
    choices: Callable[[str], tuple[Any, ...]] = lambda _format: ()
    unit: str = ""

    @property
    def words(self) -> str:
        """The label without the mark."""
        return self.label.replace("&", "")


def _draws(profile: Profile) -> bool:
    return not profile.is_table


ROWS: Final = (
    Row(
        "format", "F&ile", "How the columns of the table are separated.",
        lambda p: p.format in _TABLES, lambda _: _TABLES,
    ),
    Row(
        "entity", "&Content",
        "What the curves become in the file. Arcs and straight lines are read by every machine;"
        " splines and B\u00e9zier curves are few and smooth.",
        lambda _: True, lambda form: ENTITIES[form],
    ),
    Row(
        "version", "&Version", "R2000 is read by all newer programs and knows the unit; R12 by"
        " old machines, but it states no unit.",
        lambda p: p.format == "dxf", lambda _: VERSIONS,
    ),
    Row(
        "tolerance_mm", "&Tolerance",
        "Largest distance of what is written from the exact curve. A larger one takes fewer parts.",
        lambda p: p.entity != "control points", unit="mm",
    ),
    Row(
        "unit", "&Unit", "Unit of the numbers in the file. The drawing keeps its size.",
        lambda p: p.format not in ("pdf", "png"), lambda _: tuple(UNITS_MM),
    ),
    Row(
        "layers", "La&yers", "Whether all curves share a layer, or each has one of its name.",
        lambda p: p.format in ("dxf", "svg", "pdf"), lambda _: LAYERS,
    ),
    Row(
        "origin", "Ori&gin",
        "Where x and y are 0: where they are in the drawing, or at the lower left corner of what"
        " is written.",
        lambda p: p.format == "dxf" or p.format in _TABLES, lambda _: ORIGINS,
    ),
    Row(
        "kerf_mm", "&Kerf",
        "How far the tool runs from the part: outlines grow and holes shrink by it, below 0 the"
        " other way. Half the width of the cut keeps the part's size.",
        _draws, unit="mm",
    ),
    Row(
        "colour", "Co&lour", "Colour of the lines. Machines tell cutting from engraving by it;"
        " a DXF file has the nearest of its 255 colours.",
        lambda p: p.format in _OUTLINES,
    ),
    Row(
        "width_mm", "Line &width", "Width of the lines. Laser services often ask for 0.01 mm.",
        lambda p: p.format in _PAGES, unit="mm",
    ),
    Row(
        "dpi", "Resolutio&n", "Pixels of the picture in an inch: 96 for screens, 300 for print.",
        lambda p: p.format == "png", unit="dpi",
    ),
    Row(
        "transparent", "&Background", "What is behind the lines.",
        lambda p: p.format == "png", lambda _: (True, False),
    ),
)  # fmt: skip
"""All fields, in their order."""

_GROUNDS: Final = {True: "Transparent", False: "White"}


class ProfileFields(QWidget):
    """Shows a profile and takes changes of it.

    Signals
    -------
    changed(profile)
        The user has changed a field; a `Profile`.
    refused(sentence)
        What the fields show is no profile, and why.
    """

    changed = Signal(object)
    refused = Signal(str)

    def __init__(self, profile: Profile, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._profile = profile
        self._fault = ""
        self._showing = False
        self._was_refused = False
        self.editors: dict[str, QComboBox | NumberField | ColourField] = {}
        self._labels: dict[str, QLabel] = {}
        self._cells: dict[str, QWidget] = {}
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(10)
        self._grid.setVerticalSpacing(8)
        for column in range(COLUMNS):
            self._grid.setColumnStretch(2 * column + 1, 1)
        for row in ROWS:
            self._add(row)
        self.show_profile(profile)

    @property
    def profile(self) -> Profile:
        """The last profile that was whole."""
        return self._profile

    @property
    def fault(self) -> str:
        """Why what the fields show is no profile; empty if it is one."""
        number = next((e.fault for e in self._seen() if isinstance(e, NumberField) and e.fault), "")
        colour = next((e.fault for e in self._seen() if isinstance(e, ColourField) and e.fault), "")
        return number or colour or self._fault

    def show_profile(self, profile: Profile) -> None:
        """Show another profile; emits nothing."""
        self._profile, self._fault = profile, ""
        self._showing = True
        for row in ROWS:
            self._show(row, profile)
        self._showing = False
        self._arrange()

    def _add(self, row: Row) -> None:
        editor: QComboBox | NumberField | ColourField
        if row.key == "colour":
            editor = ColourField(self)
            editor.entered.connect(self._take)
            editor.refused.connect(self._refuse)
        elif row.unit:
            editor = NumberField(row.words.lower(), lambda number: self._check(row, number), self)
            editor.set_explanation(row.tip)
            editor.entered.connect(self._take)
            editor.refused.connect(self._refuse)
            editor.textEdited.connect(self._forget_fault)
        else:
            editor = QComboBox(self)
            editor.currentIndexChanged.connect(self._take)
        editor.setAccessibleName(row.words if not row.unit else f"{row.words} in {row.unit}")
        editor.setToolTip(row.tip)
        label = QLabel(row.label, self)
        label.setToolTip(row.tip)
        label.setBuddy(editor)
        self.editors[row.key], self._labels[row.key] = editor, label
        self._cells[row.key] = self._with_unit(editor, row.unit) if row.unit else editor

    def _with_unit(self, editor: QWidget, unit: str) -> QWidget:
        cell = QWidget(self)
        line = QHBoxLayout(cell)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(6)
        line.addWidget(editor, 1)
        mark = QLabel(unit)
        mark.setForegroundRole(mark.palette().ColorRole.PlaceholderText)
        widths = [mark.fontMetrics().horizontalAdvance(row.unit) for row in ROWS]
        mark.setFixedWidth(max(widths) + 2)
        line.addWidget(mark)
        return cell

    def _show(self, row: Row, profile: Profile) -> None:
        editor, value = self.editors[row.key], getattr(profile, row.key)
        if isinstance(editor, NumberField):
            editor.set_number(Fraction(repr(value)))
        elif isinstance(editor, ColourField):
            editor.set_colour(value)
        else:
            choices = row.choices(profile.format)
            editor.clear()
            for choice in choices:
                words = _GROUNDS[choice] if isinstance(choice, bool) else WORDS.get(choice, choice)
                editor.addItem(words, choice)
            editor.setCurrentIndex(choices.index(value) if value in choices else -1)

    def _arrange(self) -> None:
        """Lay out what the profile has, in two columns; the keyboard goes through it in order."""
        shown = [row for row in ROWS if row.applies(self._profile)]
        for row in ROWS:
            for part in (self._labels[row.key], self._cells[row.key]):
                self._grid.removeWidget(part)
                part.setVisible(row in shown)
        for place, row in enumerate(shown):
            line, column = divmod(place, COLUMNS)
            self._grid.addWidget(self._labels[row.key], line, 2 * column)
            self._grid.addWidget(self._cells[row.key], line, 2 * column + 1)
        for row, following in pairwise(shown):
            QWidget.setTabOrder(self.editors[row.key], self.editors[following.key])

    def _seen(self) -> list[QComboBox | NumberField | ColourField]:
        return [self.editors[row.key] for row in ROWS if row.applies(self._profile)]

    def _values(self) -> dict[str, Any]:
        """What the fields show, as fields of a profile."""
        found: dict[str, Any] = {}
        for row in ROWS:
            editor = self.editors[row.key]
            if not row.applies(self._profile):
                continue
            if isinstance(editor, NumberField):
                found[row.key] = _float(editor.number)
            elif isinstance(editor, ColourField):
                found[row.key] = editor.colour
            else:
                found[row.key] = editor.currentData(Qt.ItemDataRole.UserRole)
        return found

    def _take(self) -> None:
        """Make a profile of what the fields show."""
        if self._showing:
            return
        self._fault = ""
        try:
            profile = msgspec.structs.replace(self._profile, **self._values())
        except NinepointError as error:
            self._fault = str(error)
            self._refuse(self._fault)
            return
        before, self._profile = self._profile, profile
        if [r.applies(profile) for r in ROWS] != [r.applies(before) for r in ROWS]:
            self._arrange()
        if self.fault:
            self._refuse(self.fault)
        else:
            self._was_refused = False
            self.changed.emit(profile)

    def _refuse(self, sentence: str) -> None:
        self._was_refused = True
        self.refused.emit(sentence)

    def _forget_fault(self) -> None:
        """While a refused number is mended, the one in force counts again."""
        if self._was_refused and not self.fault:
            self._was_refused = False
            self.changed.emit(self._profile)

    def _check(self, row: Row, number: Fraction) -> None:
        try:
            msgspec.structs.replace(self._profile, **{row.key: _float(number)})
        except NinepointError as error:
            raise ParameterError(str(error)) from error


def _float(number: Fraction) -> float:
    """Nearest float; infinity beyond them."""
    try:
        return float(number)
    except OverflowError:
        return math.copysign(math.inf, number)
