"""Import: files of other programs are read in the background, asked about, and handed over."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QProgressDialog, QWidget

from app.adding import add_curves
from app.dialogs import Dialogs
from app.files import Files
from app.import_way import Way
from app.session import Session
from app.settings import Settings
from app.worker import Task, Worker
from core.document import Document
from core.errors import NinepointError
from core.family import PRESETS, Parameters

if TYPE_CHECKING:
    from app.import_dialog import ImportDialog
    from core.formats.sketch import Sketch
    from core.polytope import Cancelled

SHOWN_AFTER_MS: Final = 300
"""A file that is read sooner needs no bar."""


@dataclass(frozen=True, eq=False)
class Job:
    """Something to be taken over.

    Attributes
    ----------
    name
        What it is called: "wing.dxf".
    verb
        What the user does: "Open", "Import", "Paste".
    decode
        Reads it, in the background; may raise NinepointError.
    parameters
        Tells the scheme that lines are to be fitted for.
    use
        Takes the drawing that it becomes.
    refuse
        Takes what is wrong with it.
    """

    name: str
    verb: str
    decode: Callable[[], Sketch | Document]
    parameters: Callable[[], Parameters]
    use: Callable[[Document], None]
    refuse: Callable[[NinepointError], None]


class Importer(QObject):
    """Takes files and texts over, one after the other; nothing changes before the last yes.

    A drawing of ours, also one inside an SVG, and files of points are taken without a question;
    lines of other programs are shown in a dialog first.

    Parameters
    ----------
    session
        The document.
    files
        Asks before changes are lost, and remembers what was opened.
    settings
        Keeps the choice of the dialog.
    dialogs
        Asks for files and shows errors.
    window
        The window that the dialog belongs to.

    Signals
    -------
    told(sentence)
        What was imported, for the status bar.
    added()
        There are new curves, and they are selected: the view should show them.
    """

    told = Signal(str)
    added = Signal()

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
        self._waiting: deque[Job] = deque()
        self._job: Job | None = None
        self.dialog: ImportDialog | None = None
        self.bar: QProgressDialog | None = None
        self._reading, self._fitting, self._painting = (Worker(self) for _ in range(3))
        self._reading.done.connect(self._take)
        self._reading.idle.connect(self._end_if_lost)
        self._late = QTimer(self)
        self._late.setSingleShot(True)
        self._late.setInterval(SHOWN_AFTER_MS)
        self._late.timeout.connect(self._show_bar)

    @property
    def is_busy(self) -> bool:
        """Whether something is read or asked about."""
        return self._job is not None

    def ask(self) -> None:
        """Let the user choose files, and add their curves to the drawing."""
        self.add(self._dialogs.paths_to_import(self._settings.folder))

    def open(self, path: Path) -> None:
        """Open a foreign file as a new drawing, whose changes may be lost by now."""
        left = self._session.document

        def use(document: Document) -> None:
            # The window was not blocked while the file was read.
            if self._session.document is left or self._files.may_leave():
                self._files.take(document, path)

        self.take(
            Job(
                path.name,
                "Open",
                lambda: read(path),
                lambda: PRESETS["Calm"],
                use,
                lambda error: self._files.refuse("Cannot open", path, error),
            )
        )

    def add(self, paths: Sequence[Path]) -> None:
        """Add the curves of files to the drawing, one step of undo for each."""
        for path in paths:
            self._add_file(path)

    def _add_file(self, path: Path) -> None:
        def use(document: Document) -> None:
            if self.add_document(document, "Import", path.name):
                self._settings.folder = path.absolute().parent

        self.take(
            Job(
                path.name,
                "Import",
                lambda: read(path),
                self._own_parameters,
                use,
                lambda error: self._dialogs.error("Cannot import", str(error)),
            )
        )

    def _own_parameters(self) -> Parameters:
        return self._session.document.parameters

    def add_document(self, document: Document, verb: str, name: str) -> bool:
        """Add the curves of a drawing; tell whether they are there."""
        own = self._session.document.parameters
        was_empty = not any(curve.count for curve in self._session.document.curves)
        try:
            count = add_curves(self._session, document, verb)
        except NinepointError as error:
            self._dialogs.error(f"Cannot {verb.lower()}", f"{name}: {error}")
            return False
        self.added.emit()
        words = "1 curve" if count == 1 else f"{count:,} curves"
        follows = "" if was_empty or document.parameters == own else ", drawn by this scheme"
        self.told.emit(f"{verb.removesuffix('e')}ed {words} from {name}{follows}.")
        return True

    def take(self, job: Job) -> None:
        """Take something over, after what is being taken over now."""
        self._waiting.append(job)
        if self._job is None:
            self._next()

    def stop(self) -> None:
        """End all work; returns when nothing runs any more."""
        self._waiting.clear()
        self._late.stop()
        for worker in (self._reading, self._fitting, self._painting):
            worker.stop()

    def cancel(self) -> None:
        """Give up what is being read, and all that waits."""
        self._waiting.clear()
        self._reading.cancel()
        self._end()

    def _next(self) -> None:
        if self._waiting:
            self._job = self._waiting.popleft()
            self._late.start()
            self._reading.ask(_decoding(self._job))

    def _end(self) -> None:
        """Go on with what waits."""
        self._job = None
        self._hide_bar()
        self._next()

    def _end_if_lost(self) -> None:
        """A fault of the program was shown in the place of a result."""
        if self._job is not None and self.dialog is None and not self._reading.is_busy:
            self._end()

    def _take(self, found: Sketch | Document | NinepointError) -> None:
        job = self._job
        if job is None:
            return
        self._hide_bar()
        if isinstance(found, NinepointError):
            job.refuse(found)
        elif isinstance(found, Document):
            job.use(found)
        elif found.document is not None:
            job.use(found.document)
        else:
            self._show_dialog(job, found)
            return
        self._end()

    def _show_dialog(self, job: Job, sketch: Sketch) -> None:
        from app.import_dialog import ImportDialog  # not needed for our own files

        dialog = ImportDialog(
            sketch,
            job.name,
            job.verb,
            job.parameters(),
            Way.read(self._settings.import_way),
            self._fitting,
            self._painting,
            self._window,
        )
        dialog.finished.connect(lambda result: self._close(job, dialog, bool(result)))
        self.dialog = dialog
        dialog.open()

    def _close(self, job: Job, dialog: ImportDialog, accepted: bool) -> None:
        self.dialog = None
        dialog.deleteLater()
        if accepted and dialog.found is not None and dialog.found.document is not None:
            self._settings.import_way = dialog.way.text
            job.use(dialog.found.document)
        elif not accepted:
            self._waiting.clear()
        self._end()

    def _show_bar(self) -> None:
        if self._job is None or self.dialog is not None:
            return
        bar = QProgressDialog(f"Reading {self._job.name} ...", "Cancel", 0, 0, self._window)
        bar.setWindowTitle(self._job.verb)
        bar.setMinimumDuration(0)
        bar.canceled.connect(self.cancel)
        self.bar = bar
        bar.open()

    def _hide_bar(self) -> None:
        self._late.stop()
        bar, self.bar = self.bar, None
        if bar is not None:
            bar.canceled.disconnect(self.cancel)
            bar.close()
            bar.deleteLater()


def read(path: Path) -> Sketch | Document:
    """Contents of a file; to be called in the background, where its readers are loaded, too."""
    import core.formats.fitted  # noqa: F401  (what comes next needs it)
    from core.formats import open_document
    from core.formats.foreign import SUFFIXES, read_sketch

    return read_sketch(path) if path.suffix.lower() in SUFFIXES else open_document(path)


def _decoding(job: Job) -> Task:
    """Task that reads; what is wrong is its result."""

    def task(_cancelled: Cancelled, _send: Callable[[Any], None]) -> Any:
        try:
            found = job.decode()
            if not isinstance(found, Document):
                found.low  # noqa: B018  (found here, and kept, rather than in the window's thread)
        except NinepointError as error:
            return error
        return found

    return task
