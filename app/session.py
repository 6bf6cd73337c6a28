"""The only mutable thing of the program: the history of documents, the selection, the file."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from app.point_set import PointSet
from core.document import Document
from core.history import History


@dataclass(frozen=True)
class Selection:
    """Selected control points, and the curve that new points go to.

    It belongs to the view: it is neither saved nor undone.

    Parameters
    ----------
    points
        Pairs (curve, point); whatever set it is, it is held as a `PointSet`.
    curve
        The curve.
    """

    points: PointSet = field(default_factory=PointSet)
    curve: int = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", PointSet.of(self.points))

    def within(self, document: Document) -> Selection:
        """The part of the selection that exists in a document."""
        sizes = [curve.count for curve in document.curves]
        points = self.points.within(sizes)
        curve = min(self.curve, max(len(sizes) - 1, 0))
        kept = points is self.points and curve == self.curve
        return self if kept else Selection(points, curve)


class Session(QObject):
    """The document being edited.

    Views read `document`, call the verbs, and redraw on `changed`, comparing the fields that they
    read by identity. Nothing else in the program is mutable model state.

    Signals
    -------
    changed(old, new)
        The document changed, once per edit; both are `core.document.Document`.
    selection_changed(old, new)
        The selection changed; both are `Selection`.
    status_changed()
        The file's path, the unsaved mark or the names of undo and redo changed.
    """

    changed = Signal(object, object)
    selection_changed = Signal(object, object)
    status_changed = Signal()

    def __init__(self, document: Document | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._history = History(document or Document())
        self._saved = self._history.document
        self._path: Path | None = None
        self._selection = Selection()
        self._told: tuple[object, ...] = ()

    @property
    def document(self) -> Document:
        """The document as it is now."""
        return self._history.document

    @property
    def origin(self) -> Document:
        """The document at the start of the open gesture, or the present one."""
        return self._history.origin

    @property
    def selection(self) -> Selection:
        """The selected points."""
        return self._selection

    @property
    def path(self) -> Path | None:
        """The file that Save writes to, or None for a document that never was saved."""
        return self._path

    @property
    def is_modified(self) -> bool:
        """Whether the document differs from the one last opened or saved."""
        return self.document is not self._saved

    @property
    def in_gesture(self) -> bool:
        """Whether a gesture is open."""
        return self._history.in_gesture

    @property
    def undo_name(self) -> str | None:
        """Name of the edit that undo takes back."""
        return self._history.undo_name

    @property
    def redo_name(self) -> str | None:
        """Name of the edit that redo brings back."""
        return self._history.redo_name

    def begin(self, name: str) -> None:
        """Open a gesture: all edits until `commit` are one step of undo."""
        self._history.begin(name)

    def edit(self, document: Document, name: str) -> None:
        """Make ``document`` the present one: a step of undo called ``name``.

        A gesture that is open, such as a burst of arrow keys, is complete with that.
        """
        old = self.document
        self._history.record(document, name)
        self._announce(old)

    def adjust(self, document: Document, name: str = "") -> None:
        """Make ``document`` the present one within the open gesture; ``name`` renames it."""
        old = self.document
        self._history.adjust(document, name)
        self._announce(old)

    def commit(self) -> None:
        """Close the gesture and keep what it did."""
        self._history.commit()
        self._tell()

    def cancel(self) -> None:
        """Close the gesture and restore the document that it began with."""
        old = self.document
        self._history.cancel()
        self._announce(old)

    def undo(self) -> None:
        """Take the last edit back."""
        old = self.document
        self._history.undo()
        self._announce(old)

    def redo(self) -> None:
        """Bring the last undone edit back."""
        old = self.document
        self._history.redo()
        self._announce(old)

    def select(self, selection: Selection) -> None:
        """Change the selection."""
        old, self._selection = self._selection, selection.within(self.document)
        if old != self._selection:
            self.selection_changed.emit(old, self._selection)

    def replace(self, document: Document, path: Path | None) -> None:
        """Go over to another document (New, Open): a new history, nothing selected."""
        old = self.document
        self._history = History(document)
        self._saved = document
        self._path = path
        self.select(Selection())
        self._announce(old)

    def mark_saved(self, path: Path) -> None:
        """Take note that the present document is what the file holds."""
        self._path = path
        self._saved = self.document
        self._tell()

    def _announce(self, old: Document) -> None:
        new = self.document
        is_listed = new.lists_as(old)
        if old is not new:
            if not is_listed:
                self.select(self._selection)
            self.changed.emit(old, new)
        # The moves of a drag change nothing of this: each would have a window's actions looked at.
        if self._status != self._told or not (is_listed and _are_named_alike(old, new)):
            self._tell()

    @property
    def _status(self) -> tuple[object, ...]:
        return self.undo_name, self.redo_name, self.is_modified, self.path, self.in_gesture

    def _tell(self) -> None:
        self._told = self._status
        self.status_changed.emit()


def _are_named_alike(old: Document, new: Document) -> bool:
    """Whether two documents are drawn by schemes that a menu cannot tell apart."""
    one, two = old.parameters, new.parameters
    return one is two or (one.name, one.neighbours) == (two.name, two.neighbours)
