"""The questions that the program asks in windows of their own; tests answer in their place.

Qt's dialogs are imported where they are asked for: their classes take 2 ms to make, which the first
paint need not wait for.
"""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

DOCUMENT_SUFFIX = ".ninepoint"
"""Suffix of Ninepoint's own files."""

_OWN = "*.ninepoint"
_DRAWINGS = "*.svg *.svgz *.dxf"
_POINTS = "*.csv *.tsv *.txt *.dat *.json"

OPEN_FILTERS = (
    f"All that can be opened ({_OWN} {_DRAWINGS} {_POINTS})"
    f";;Ninepoint drawings ({_OWN});;SVG and DXF ({_DRAWINGS});;Points ({_POINTS})"
    ";;All files (*)"
)
ABOUT_ICON_PX = 64
SAVE_FILTERS = "Ninepoint drawings (*.ninepoint)"


class Answer(Enum):
    """What shall happen to changes that are not saved."""

    SAVE = "save"
    DISCARD = "discard"
    CANCEL = "cancel"


class Dialogs:
    """File choosers, questions and error messages over a window.

    Parameters
    ----------
    parent
        The window that they belong to.
    """

    def __init__(self, parent: QWidget) -> None:
        self._parent = parent

    def path_to_open(self, folder: Path) -> Path | None:
        """Let the user choose a file to open, or None."""
        from PySide6.QtWidgets import QFileDialog

        chosen, _ = QFileDialog.getOpenFileName(self._parent, "Open", str(folder), OPEN_FILTERS)
        return Path(chosen) if chosen else None

    def paths_to_import(self, folder: Path) -> list[Path]:
        """Let the user choose files whose curves are added to the drawing; none if cancelled."""
        from PySide6.QtWidgets import QFileDialog

        chosen, _ = QFileDialog.getOpenFileNames(self._parent, "Import", str(folder), OPEN_FILTERS)
        return [Path(name) for name in chosen]

    def path_to_save(self, suggestion: Path) -> Path | None:
        """Let the user choose the name of a drawing, or None; it ends in the right suffix."""
        return self._new_path("Save as", suggestion, SAVE_FILTERS)

    def path_to_export(self, suggestion: Path, kind: str) -> Path | None:
        """Let the user choose the name of an exported file, or None.

        Parameters
        ----------
        suggestion
            Folder and name proposed; its suffix is kept.
        kind
            What such files are called: "SVG".
        """
        return self._new_path("Export", suggestion, f"{kind} (*{suggestion.suffix})")

    def _new_path(self, title: str, suggestion: Path, filters: str) -> Path | None:
        from PySide6.QtWidgets import QApplication, QFileDialog

        # The dialog adds the suffix itself, so its question before overwriting names the very
        # file that will be written.
        over = QApplication.activeModalWidget() or self._parent  # such as the export's own window
        dialog = QFileDialog(over, title, str(suggestion.parent), filters)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix(suggestion.suffix.removeprefix("."))
        dialog.selectFile(suggestion.name)
        accepted = dialog.exec()
        files = dialog.selectedFiles()
        dialog.deleteLater()
        return Path(files[0]) if accepted and files else None

    def words(self, title: str, question: str, suggestion: str) -> str | None:
        """Let the user type a line of words, or None."""
        from PySide6.QtWidgets import QApplication, QInputDialog, QLineEdit

        over = QApplication.activeModalWidget() or self._parent
        normal = QLineEdit.EchoMode.Normal
        typed, accepted = QInputDialog.getText(over, title, question, normal, suggestion)
        return typed if accepted else None

    def unsaved(self, title: str) -> Answer:
        """Ask what shall happen to the changes of the drawing called ``title``."""
        from PySide6.QtWidgets import QMessageBox

        box = QMessageBox(
            QMessageBox.Icon.Warning,
            "Unsaved changes",
            f"Save the changes to \u201c{title}\u201d?",
            QMessageBox.StandardButton.Save
            | QMessageBox.StandardButton.Discard
            | QMessageBox.StandardButton.Cancel,
            self._parent,
        )
        box.setInformativeText("They are lost if you discard them.")
        box.setDefaultButton(QMessageBox.StandardButton.Save)
        box.setEscapeButton(QMessageBox.StandardButton.Cancel)
        chosen = box.exec()
        box.deleteLater()
        if chosen == QMessageBox.StandardButton.Save:
            return Answer.SAVE
        return Answer.DISCARD if chosen == QMessageBox.StandardButton.Discard else Answer.CANCEL

    def error(self, title: str, sentence: str) -> None:
        """Show what went wrong; returns at once."""
        from PySide6.QtWidgets import QMessageBox

        box = QMessageBox(
            QMessageBox.Icon.Warning,
            title,
            sentence,
            QMessageBox.StandardButton.Ok,
            self._parent,
        )
        box.open()
        box.finished.connect(box.deleteLater)

    def about(self) -> None:
        """Show name, version and licence; returns at once."""
        from PySide6.QtWidgets import QMessageBox

        box = QMessageBox(self._parent)
        box.setWindowTitle("About Ninepoint")
        box.setIconPixmap(QGuiApplication.windowIcon().pixmap(ABOUT_ICON_PX))
        box.setText(f"<b>Ninepoint</b> {program_version()}")
        box.setInformativeText(
            "Curves by a three-parameter nine-point subdivision scheme: exact limit curves,"
            " shaped by three sliders. Free software, MIT licence."
        )
        box.open()
        box.finished.connect(box.deleteLater)


def program_version() -> str:
    """Version of the installed program; "" in a checkout that was never installed."""
    from importlib import metadata  # rarely wanted, and slow to load

    try:
        return metadata.version("ninepoint")
    except metadata.PackageNotFoundError:
        return ""
