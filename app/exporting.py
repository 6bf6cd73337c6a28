"""Export: format and tolerance are asked once, the size is shown first, Ctrl+E repeats."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from app.dialogs import Dialogs
from app.fields import NumberField, shown_number, typed_number
from app.files import Files
from app.guard import guarded
from app.session import Session
from app.settings import Settings
from core.document import Document
from core.errors import NinepointError, ParameterError

if TYPE_CHECKING:
    from core.formats import ExportReport


@dataclass(frozen=True)
class Format:
    """A file format, as the dialog presents it."""

    suffix: str
    name: str
    use: str


FORMATS: Final = (
    Format("svg", "SVG", "drawing programs and lasers"),
    Format("dxf", "DXF", "CAD and CNC, R2000"),
)
"""What curves can be exported to; a path's suffix decides."""

DEFAULT_TOLERANCE_MM: Final = "0.01"
"""Finer than laser cutters and printers place their tool."""


@dataclass(frozen=True)
class Target:
    """Where the last export went, and how fine it was."""

    path: Path
    tolerance_mm: float


class Exporter(QObject):
    """Asks what an export needs, writes it, and can do the same again.

    Parameters
    ----------
    session
        The document.
    files
        Knows what the drawing is called.
    settings
        Keeps format, tolerance and folder.
    dialogs
        Asks for the file's name and shows errors.
    window
        The window that the dialog belongs to.

    Signals
    -------
    told(sentence)
        What was written, for the status bar.
    """

    told = Signal(str)

    def __init__(
        self,
        session: Session,
        files: Files,
        settings: Settings,
        dialogs: Dialogs,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._session = session
        self._files = files
        self._settings = settings
        self._dialogs = dialogs
        self._window = window
        self._last: Target | None = None
        self.dialog: ExportDialog | None = None
        files.opened.connect(self._forget)

    def ask(self) -> None:
        """Open the dialog; the export follows when it is accepted."""
        self._session.commit()
        dialog = ExportDialog(self._session.document, self._settings, self._window)
        dialog.accepted.connect(self._choose_path)
        dialog.finished.connect(dialog.deleteLater)
        self.dialog = dialog
        dialog.open()

    def repeat(self) -> None:
        """Export again to the same file; ask if nothing was exported from this drawing yet."""
        if self._last is None:
            self.ask()
        else:
            self._session.commit()
            self._write(self._last)

    def _forget(self) -> None:
        # Another drawing must not overwrite what this one was exported to.
        self._last = None

    def _choose_path(self) -> None:
        if self.dialog is None:
            return
        chosen, tolerance = self.dialog.format, self.dialog.tolerance
        self._settings.export_format = chosen.suffix
        self._settings.export_tolerance = shown_number(tolerance)
        name = Path(self._files.title).stem + "." + chosen.suffix
        path = self._dialogs.path_to_export(self._settings.export_folder / name, chosen.name)
        if path is None:
            return
        if path.suffix.lower() != "." + chosen.suffix:
            path = path.with_name(f"{path.name}.{chosen.suffix}")
        self._settings.export_folder = path.parent
        self._write(Target(path, float(tolerance)))

    def _write(self, target: Target) -> None:
        from core.formats import export, profile_for  # writers are not needed for the first paint

        try:
            profile = profile_for(target.path).within(target.tolerance_mm)
            report = export(self._session.document, target.path, profile)
        except NinepointError as error:
            self._dialogs.error("Cannot export", str(error))
            return
        self._last = target
        self.told.emit(f"Exported {target.path.name}: {described(report)}.")


class ExportDialog(QDialog):
    """Format and tolerance, and what will come of them.

    Parameters
    ----------
    document
        What will be exported.
    settings
        Format and tolerance of the last time.
    """

    def __init__(
        self, document: Document, settings: Settings, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Export")
        self._document = document
        self.choice = QComboBox()
        self.choice.setAccessibleName("Format")
        for form in FORMATS:
            self.choice.addItem(f"{form.name} \u2013 {form.use}", form)
        suffixes = [form.suffix for form in FORMATS]
        if settings.export_format in suffixes:
            self.choice.setCurrentIndex(suffixes.index(settings.export_format))
        self.field = NumberField("tolerance", check_tolerance)
        self.field.set_explanation("Largest distance of the written curve from the exact one")
        self.field.set_number(_remembered(settings))
        self.field.setFixedWidth(self.field.fontMetrics().horizontalAdvance("0.000000") + 18)
        self.preview = QLabel()
        self.preview.setAccessibleName("What will be written")
        self.preview.setWordWrap(True)
        self.preview.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.preview.setMinimumWidth(self.preview.fontMetrics().averageCharWidth() * 52)
        self.preview.setMinimumHeight(self.preview.fontMetrics().lineSpacing() * 2)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.export = self.buttons.addButton("&Export...", QDialogButtonBox.ButtonRole.AcceptRole)
        self.buttons.button(QDialogButtonBox.StandardButton.Cancel).setIcon(QIcon())
        self._lay_out()
        self.export.setDefault(True)  # after the layout, which makes a button of its own choice so
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self.choice.currentIndexChanged.connect(self._show_preview)
        self.field.entered.connect(self._show_preview)
        self.field.refused.connect(self._refuse)
        self.field.textEdited.connect(lambda: self.export.setEnabled(True))
        self._show_preview()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(10)
        tolerance = QHBoxLayout()
        tolerance.setSpacing(8)
        tolerance.addWidget(self.field)
        tolerance.addWidget(QLabel("mm"))
        tolerance.addStretch()
        label = QLabel("&Tolerance")
        label.setBuddy(self.field)
        form.addRow("&Format", self.choice)
        form.addRow(label, tolerance)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(18, 16, 18, 14)
        layout.setSpacing(14)
        layout.addLayout(form)
        layout.addWidget(self.preview)
        layout.addWidget(self.buttons)

    @property
    def format(self) -> Format:
        """The format chosen."""
        return FORMATS[self.choice.currentIndex()]

    @property
    def tolerance(self) -> Fraction:
        """The tolerance in force, in mm."""
        return self.field.number

    @guarded
    def accept(self) -> None:
        """Close with yes, unless the tolerance typed is nonsense."""
        if not self.field.fault:
            super().accept()

    def _show_preview(self) -> None:
        try:
            report = trial(self._document, self.format, float(self.tolerance))
        except NinepointError as error:
            self._refuse(str(error))
            return
        self.preview.setText(described(report))
        self.export.setEnabled(True)

    def _refuse(self, sentence: str) -> None:
        self.preview.setText(sentence)
        self.export.setEnabled(False)


def trial(document: Document, form: Format, tolerance_mm: float) -> ExportReport:
    """Report of an export that is not written: the very numbers that writing will give.

    Raises
    ------
    NinepointError
        If the document cannot be exported so.
    """
    from core.formats import profile_for, survey

    if not any(curve.count for curve in document.curves):
        raise NinepointError("There is nothing to export yet: the drawing has no points.")
    return survey(document, profile_for(f"drawing.{form.suffix}").within(tolerance_mm))


def described(report: ExportReport) -> str:
    """Words of a report, in the window's letters: "105.60 × 62.00 mm, closed, ..."."""
    # Unbreakable spaces keep the bound together in a narrow window.
    bound = report.summary.replace("deviation <= ", "deviation\u00a0\u2264\u00a0")
    return bound.replace(" x ", " \u00d7 ").removesuffix(" mm") + "\u00a0mm"


def check_tolerance(number: Fraction) -> None:
    """Refuse a tolerance that is not greater than 0; the writer knows the finer limits."""
    if number <= 0:
        raise ParameterError("tolerance must be greater than 0.")


def _remembered(settings: Settings) -> Fraction:
    try:
        number = typed_number(settings.export_tolerance, "tolerance")
        check_tolerance(number)
    except ParameterError:
        return Fraction(DEFAULT_TOLERANCE_MM)
    return number
