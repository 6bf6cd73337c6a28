"""Undo and redo: a list of immutable documents with a place in it."""

from __future__ import annotations

from typing import NamedTuple

from core.document import Document


class State(NamedTuple):
    """A document and the name of the edit that led to it ("Move 3 points")."""

    document: Document
    name: str


class History:
    """The states of one document from opening to now, with a cursor.

    A *gesture* (a drag, a slider move) folds all its edits into one state: `begin` opens it,
    `adjust` replaces its state as often as needed, `commit` keeps it, `cancel` drops it.

    Parameters
    ----------
    document
        The state that undo ends at.
    """

    def __init__(self, document: Document) -> None:
        self._states = [State(document, "")]
        self._index = 0
        self._gesture: str | None = None
        self._origin = document
        self._undone: list[State] = []

    @property
    def document(self) -> Document:
        """The document as it is now, within an open gesture too."""
        return self._states[self._index].document

    @property
    def in_gesture(self) -> bool:
        """Whether a gesture is open."""
        return self._gesture is not None

    @property
    def origin(self) -> Document:
        """The document at the start of the open gesture, or the present one."""
        return self._origin if self.in_gesture else self.document

    @property
    def undo_name(self) -> str | None:
        """Name of the edit that `undo` takes back, or None if there is none."""
        return self._states[self._index].name if self._index > 0 else None

    @property
    def redo_name(self) -> str | None:
        """Name of the edit that `redo` brings back, or None if there is none."""
        if self._index + 1 < len(self._states):
            return self._states[self._index + 1].name
        return None

    def begin(self, name: str) -> None:
        """Open a gesture, committing one that is still open."""
        self.commit()
        self._gesture = name
        self._origin = self.document

    def record(self, document: Document, name: str) -> None:
        """Make ``document`` a new state called ``name``, committing an open gesture first.

        States that were undone before are dropped. The present document is no new state.
        """
        self.commit()
        if document is not self.document:
            self._push(State(document, name))

    def adjust(self, document: Document, name: str = "") -> None:
        """Make ``document`` the state of the open gesture; a ``name`` renames the gesture.

        Going back to the very document that the gesture began with leaves no state.

        Raises
        ------
        RuntimeError
            If no gesture is open: there is nothing to adjust.
        """
        if self._gesture is None:
            raise RuntimeError("adjust needs an open gesture")
        self._gesture = name or self._gesture
        if document is self._origin:
            self._drop()
        elif self.document is self._origin:
            self._push(State(document, self._gesture))
        else:
            self._states[self._index] = State(document, self._gesture)

    def commit(self) -> None:
        """Close the gesture and keep what it did."""
        self._gesture = None

    def cancel(self) -> None:
        """Close the gesture and go back to the very document that it began with.

        What could be redone before the gesture can be redone again.
        """
        if self._gesture is not None:
            self._drop()
        self._gesture = None

    def undo(self) -> None:
        """Step back, if there is an earlier state; an open gesture is cancelled instead."""
        if self.in_gesture:
            self.cancel()
        elif self._index > 0:
            self._index -= 1

    def redo(self) -> None:
        """Step forward, if there is a later state; an open gesture is committed first."""
        self.commit()
        if self._index + 1 < len(self._states):
            self._index += 1

    def _drop(self) -> None:
        """Take the gesture's state back, if there is one, and restore what was undone before."""
        if self.document is not self._origin:
            self._index -= 1
            self._states[self._index + 1 :] = self._undone

    def _push(self, state: State) -> None:
        self._undone = self._states[self._index + 1 :]
        self._states[self._index + 1 :] = [state]
        self._index += 1
