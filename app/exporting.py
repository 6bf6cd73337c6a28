"""Export: who receives the file is asked once, what comes of it is shown, Ctrl+E repeats it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.dialogs import Dialogs
from app.export_dialog import ExportDialog
from app.export_shelf import Shelf
from app.export_survey import NO_MEMORY, described
from app.files import Files
from app.pages import register_encoders
from app.session import Session
from app.settings import Settings
from app.worker import Task, Worker
from core.document import Document
from core.errors import FileError, NinepointError
from core.formats import ExportReport, export
from core.polytope import Cancelled
from core.profiles import Profile

TITLE: Final = "Cannot export"
"""Of the message when there is no dialog to say it in."""


@dataclass(frozen=True)
class Target:
    """A file to write, and what it is to be."""

    path: Path
    profile: Profile


class Exporter(QObject):
    """Asks what an export needs, writes it in the background, and can do the same again.

    Parameters
    ----------
    session
        The document.
    files
        Knows what the drawing is called, and which file it came from.
    settings
        Keeps profiles and folder.
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
        register_encoders()
        self._session = session
        self._files = files
        self._settings = settings
        self._dialogs = dialogs
        self._window = window
        self._shelf = Shelf(session, settings)
        self._last: Target | None = None
        self._drawing = 0
        self._worker = Worker(self)
        self._worker.done.connect(self._take)
        self.dialog: ExportDialog | None = None
        files.opened.connect(self._forget)

    def ask(self) -> None:
        """Open the dialog; the export follows when it is accepted."""
        self._session.commit()
        dialog = ExportDialog(
            lambda: self._session.document,
            self._shelf,
            self._settings,
            self._dialogs,
            self._window,
        )
        dialog.wanted.connect(self._choose_path)
        dialog.finished.connect(self._close)
        self.dialog = dialog
        dialog.open()

    def repeat(self) -> None:
        """Export again to the same file; ask if nothing was exported from this drawing yet."""
        if self._last is None:
            self.ask()
        else:
            self._session.commit()
            self.told.emit(f"Writing {self._last.path.name}\u2026")
            self._write(self._last)

    def stop(self) -> None:
        """Wait until a file that is being written is there; nothing is begun any more."""
        if self.dialog is not None:
            self.dialog.set_busy(False)
            self.dialog.reject()
        self._worker.stop()

    def _forget(self) -> None:
        # Another drawing must not overwrite what this one was exported to.
        self._last = None
        self._drawing += 1

    def _close(self) -> None:
        if self.dialog is not None:
            self.dialog.deleteLater()
            self.dialog = None

    def _choose_path(self, profile: Profile) -> None:
        if self.dialog is None:
            return
        name = Path(self._files.title).stem + profile.suffix
        kind = f"{profile.format.upper()} files"
        path = self._dialogs.path_to_export(self._settings.export_folder / name, kind)
        if path is None:
            return
        if path.suffix.lower() != profile.suffix:
            path = path.with_name(path.name + profile.suffix)
        self._settings.export_folder = path.parent
        self.dialog.set_busy(True)
        self._write(Target(path, profile))

    def _write(self, target: Target) -> None:
        sources = [self._session.path, self._files.source]
        self._worker.ask(_task(self._session.document, target, self._drawing, sources))

    def _take(self, outcome: Outcome) -> None:
        if outcome.report is None:
            if self.dialog is not None:
                self.dialog.tell_fault(outcome.fault)
            else:
                self._dialogs.error(TITLE, outcome.fault)
            return
        if outcome.drawing == self._drawing:
            self._last = outcome.target
        if self.dialog is not None:
            self.dialog.set_busy(False)
            self.dialog.remember()
            self.dialog.accept()
        self.told.emit(f"Exported {outcome.target.path.name}: {described(outcome.report)}.")


@dataclass(frozen=True)
class Outcome:
    """What became of an export.

    Attributes
    ----------
    target
        The file.
    drawing
        Which of the drawings that were open it shows.
    report
        What was written, or None.
    fault
        Why it was not.
    """

    target: Target
    drawing: int
    report: ExportReport | None
    fault: str = ""


def _task(
    document: Document, target: Target, drawing: int, sources: list[Path | None]
) -> Task:
    """Task that writes a file; once begun it comes to its end."""

    def task(_cancelled: Cancelled, _send: Callable[[Any], None]) -> Outcome:
        try:
            _refuse_source(target.path, sources)
            report = export(document, target.path, target.profile)
        except NinepointError as error:
            return Outcome(target, drawing, None, str(error))
        except OSError as error:
            fault = FileError(target.path, f"{error.strerror or type(error).__name__}.")
            return Outcome(target, drawing, None, str(fault))
        except MemoryError:
            return Outcome(target, drawing, None, NO_MEMORY)
        return Outcome(target, drawing, report)

    return task


def _refuse_source(path: Path, sources: list[Path | None]) -> None:
    """Refuse to overwrite the file that the drawing came from."""
    for source in sources:
        if source is not None and path.exists() and source.exists() and path.samefile(source):
            raise FileError(path, "this is the file that the drawing came from; choose another.")
