"""Undo and redo equal a list of snapshots, whatever is done."""

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from core.document import Curve, Document
from core.history import History


def document(x):
    return Document((Curve([(x, 0)]),))


def test_a_gesture_is_one_step():
    start = document(0)
    history = History(start)
    history.begin("Move point")
    for x in range(5):
        history.adjust(document(x))
    last = history.document
    history.commit()
    assert history.undo_name == "Move point"
    history.undo()
    assert history.document is start
    history.redo()
    assert history.document is last


def test_cancelling_restores_the_very_document_and_what_could_be_redone():
    history = History(document(0))
    history.record(document(1), "one")
    history.undo()
    start = history.document
    history.begin("Move point")
    history.adjust(document(2))
    assert history.redo_name is None
    history.cancel()
    assert history.document is start
    assert history.redo_name == "one"


def test_an_empty_gesture_leaves_no_step():
    history = History(document(0))
    history.begin("Move point")
    history.commit()
    assert history.undo_name is None


def test_a_gesture_may_be_renamed_by_its_edits():
    history = History(document(0))
    history.begin("Set beta")
    history.adjust(document(1), "Set beta -0.5")
    history.commit()
    assert history.undo_name == "Set beta -0.5"


def test_undo_within_a_gesture_cancels_it():
    history = History(document(0))
    start = history.document
    history.begin("Move point")
    history.adjust(document(1))
    history.undo()
    assert history.document is start
    assert not history.in_gesture


def test_recording_the_same_document_is_no_step():
    history = History(document(0))
    history.record(history.document, "nothing")
    assert history.undo_name is None


def test_a_gesture_that_comes_back_to_its_origin_leaves_no_step():
    history = History(document(0))
    history.record(document(1), "one")
    history.undo()
    start = history.document
    history.begin("Set beta")
    history.adjust(document(2))
    history.adjust(start)
    history.commit()
    assert history.document is start
    assert history.undo_name is None
    assert history.redo_name == "one"


def test_an_edit_of_its_own_completes_an_open_gesture():
    history = History(document(0))
    history.begin("Move point")
    history.adjust(document(1))
    history.record(document(2), "Rename curve")
    assert not history.in_gesture
    assert history.undo_name == "Rename curve"
    history.undo()
    assert history.undo_name == "Move point"


def test_without_a_gesture_there_is_nothing_to_adjust():
    with pytest.raises(RuntimeError, match="gesture"):
        History(document(0)).adjust(document(1))


class Snapshots(RuleBasedStateMachine):
    """The model: a plain list of documents and a place in it."""

    def __init__(self):
        super().__init__()
        start = document(0)
        self.history = History(start)
        self.states = [start]
        self.place = 0
        self.gesture = None

    def _complete(self):
        if self.gesture is not None and self.gesture[1] is not None:
            self.states = [*self.states[: self.place + 1], self.gesture[1]]
            self.place += 1
        self.gesture = None

    @rule(x=st.integers(0, 100))
    def edit(self, x):
        new = document(x)
        self.history.record(new, "edit")
        self._complete()
        self.states = [*self.states[: self.place + 1], new]
        self.place += 1

    @precondition(lambda self: self.gesture is not None)
    @rule(x=st.integers(0, 100), back=st.booleans())
    def adjust(self, x, back):
        new = self.gesture[0] if back else document(x)
        self.history.adjust(new)
        self.gesture = (self.gesture[0], None if back else new)

    @precondition(lambda self: self.gesture is None)
    @rule()
    def begin(self):
        self.history.begin("drag")
        self.gesture = (self.states[self.place], None)

    @precondition(lambda self: self.gesture is not None)
    @rule()
    def commit(self):
        self.history.commit()
        self._complete()

    @precondition(lambda self: self.gesture is not None)
    @rule()
    def cancel(self):
        self.history.cancel()
        self.gesture = None

    @precondition(lambda self: self.gesture is None)
    @rule()
    def undo(self):
        self.history.undo()
        self.place = max(self.place - 1, 0)

    @precondition(lambda self: self.gesture is None)
    @rule()
    def redo(self):
        self.history.redo()
        self.place = min(self.place + 1, len(self.states) - 1)

    @invariant()
    def the_document_is_the_one_of_the_list(self):
        expected = self.states[self.place]
        if self.gesture is not None and self.gesture[1] is not None:
            expected = self.gesture[1]
        assert self.history.document is expected

    @invariant()
    def the_names_tell_what_can_be_undone_and_redone(self):
        if self.gesture is None:
            assert (self.history.undo_name is None) == (self.place == 0)
            assert (self.history.redo_name is None) == (self.place == len(self.states) - 1)


TestSnapshots = Snapshots.TestCase
TestSnapshots.settings = settings(max_examples=200, stateful_step_count=30, deadline=None)
