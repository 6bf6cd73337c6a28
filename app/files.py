"""New, open, save, recent files, and the question before changes are lost."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from app.dialogs import DOCUMENT_SUFFIX, Answer, Dialogs
from app.session import Session
from app.settings import Settings
from core.document import Document
from core.errors import FileError, NinepointError

UNTITLED = "Untitled"
"""Name of a drawing that has no file yet."""


class Files(QObject):
    """The window's side of files: what is asked, shown and remembered around each of them.

    Parameters
    ----------
    session
        The document; it is only touched when a file was read or written whole.
    settings
        Keeps the recent files and the last folder.
    dialogs
        Asks the questions and shows the errors.

    Signals
    -------
    told(sentence)
        Something worth a line in the status bar happened.
    opened()
        The document was exchanged: the view should show all of it.
    title_changed()
        `title` changed.
    recent_changed()
        The list of recent files changed.
    foreign(path)
        A file of another program is to be opened: the user has to be asked how.
    """

    told = Signal(str)
    opened = Signal()
    title_changed = Signal()
    recent_changed = Signal()
    foreign = Signal(Path)

    def __init__(
        self,
        session: Session,
        settings: Settings,
        dialogs: Dialogs,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._settings = settings
        self._dialogs = dialogs
        self._stem = UNTITLED
        self._source: Path | None = None

    @property
    def source(self) -> Path | None:
        """The file that the drawing was read from, of whatever format; None for a new one."""
        return self._source

    @property
    def title(self) -> str:
        """Name of the file, or what a drawing without a file is called."""
        path = self._session.path
        return self._stem if path is None else path.name

    @property
    def suggestion(self) -> Path:
        """Where Save As proposes to write."""
        path = self._session.path
        if path is not None:
            return path
        return self._settings.folder / (self._stem + DOCUMENT_SUFFIX)

    @property
    def recent(self) -> list[Path]:
        """Files opened or saved, the latest first."""
        return self._settings.recent

    def new(self) -> None:
        """Begin an empty drawing, once the present one may be left."""
        if self.may_leave():
            self._exchange(Document(), None, UNTITLED)

    def open(self) -> None:
        """Let the user choose a file and open it."""
        if self.may_leave():
            path = self._dialogs.path_to_open(self._settings.folder)
            if path is not None:
                self._read(path)

    def open_path(self, path: Path) -> bool:
        """Open a file that was named: a recent one, a dropped one.

        A drawing becomes the session's file; files of other formats become a drawing without a
        file, so that saving never overwrites them.

        Returns
        -------
        bool
            Whether it is open now. If not, the user was told why, and nothing has changed; or it
            is a drawing of another program, and the user is being asked about it (`foreign`).
        """
        return self.may_leave() and self._read(path)

    def open_example(self, path: Path) -> bool:
        """Open an example as a drawing without a file: saving asks for a name."""
        return self.may_leave() and self._read(path, as_copy=True)

    def clear_recent(self) -> None:
        """Forget the recent files."""
        self._settings.clear_recent()
        self.recent_changed.emit()

    def save(self) -> bool:
        """Save under the present name, or ask for one; tell whether it is saved."""
        path = self._session.path
        return self.save_as() if path is None else self._write(path)

    def save_as(self) -> bool:
        """Ask for a name and save under it; tell whether it is saved."""
        path = self._dialogs.path_to_save(self.suggestion)
        if path is None:
            return False
        if path.suffix.lower() != DOCUMENT_SUFFIX:
            path = path.with_name(path.name + DOCUMENT_SUFFIX)
        return self._write(path)

    def may_leave(self) -> bool:
        """Ask about unsaved changes, if there are any; tell whether the drawing may be left."""
        self._session.commit()
        if not self._session.is_modified:
            return True
        answer = self._dialogs.unsaved(self.title)
        return self.save() if answer is Answer.SAVE else answer is Answer.DISCARD

    def _read(self, path: Path, as_copy: bool = False) -> bool:
        from core.formats import open_document  # readers are not needed for the first paint
        from core.formats.foreign import SUFFIXES

        if path.suffix.lower() in SUFFIXES:
            self.foreign.emit(path)
            return False
        try:
            document = open_document(path)
        except NinepointError as error:
            self.refuse("Cannot open", path, error)
            return False
        self.take(document, path, as_copy)
        return True

    def take(self, document: Document, path: Path, as_copy: bool = False) -> None:
        """Go over to what was read from a file, and remember the file."""
        self.show_document(document, path, as_copy)
        if not as_copy:
            self._remember(path)
        self.told.emit(f"Opened {path.name}.")

    def show_document(self, document: Document, path: Path, as_copy: bool = False) -> None:
        """Exchange the document for one that was read from ``path``, and remember nothing."""
        own = path.suffix.lower() == DOCUMENT_SUFFIX and not as_copy
        self._exchange(document, path.absolute() if own else None, path.stem)
        self._source = path.absolute()

    def refuse(self, title: str, path: Path, error: NinepointError) -> None:
        """Say why a file is not open; one that is gone leaves the list of recent files."""
        sentence = str(error)
        listed = path.absolute()
        if not path.exists() and listed in self._settings.recent:
            self._settings.remove_recent(listed)
            self.recent_changed.emit()
            sentence = f"{path.name} is no longer there. It was taken off the list of recent files."
        self._dialogs.error(title, sentence)

    def _write(self, path: Path) -> bool:
        from core.store import save  # not needed for the first paint

        self._session.commit()
        try:
            save(self._session.document, path)
        except FileError as error:
            self._dialogs.error("Cannot save", str(error))
            return False
        self._session.mark_saved(path.absolute())
        self._stem = path.stem
        self._remember(path)
        self.title_changed.emit()
        self.told.emit(f"Saved {path.name}.")
        return True

    def _remember(self, path: Path) -> None:
        self._settings.folder = path.absolute().parent
        self._settings.add_recent(path)
        self.recent_changed.emit()

    def _exchange(self, document: Document, path: Path | None, stem: str) -> None:
        self._stem = stem
        self._source = None
        self._session.replace(document, path)
        self.title_changed.emit()
        self.opened.emit()
