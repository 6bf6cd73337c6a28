"""Undo and redo equal a list of snapshots, whatever is done."""

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
        history.record(document(x))
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
    history.record(document(2))
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
    history.record(document(1), "Set beta -0.5")
    history.commit()
    assert history.undo_name == "Set beta -0.5"


def test_undo_within_a_gesture_cancels_it():
    history = History(document(0))
    start = history.document
    history.begin("Move point")
    history.record(document(1))
    history.undo()
    assert history.document is start
    assert not history.in_gesture


def test_recording_the_same_document_is_no_step():
    history = History(document(0))
    history.record(history.document, "nothing")
    assert history.undo_name is None


class Snapshots(RuleBasedStateMachine):
    """The model: a plain list of documents and a place in it."""

    def __init__(self):
        super().__init__()
        start = document(0)
        self.history = History(start)
        self.states = [start]
        self.place = 0
        self.gesture = None

    @rule(x=st.integers(0, 100))
    def edit(self, x):
        new = document(x)
        self.history.record(new, "edit")
        if self.gesture is not None:
            self.gesture = (self.gesture[0], new)
        else:
            self.states = [*self.states[: self.place + 1], new]
            self.place += 1

    @precondition(lambda self: self.gesture is None)
    @rule()
    def begin(self):
        self.history.begin("drag")
        self.gesture = (self.states[self.place], None)

    @precondition(lambda self: self.gesture is not None)
    @rule()
    def commit(self):
        self.history.commit()
        if self.gesture[1] is not None:
            self.states = [*self.states[: self.place + 1], self.gesture[1]]
            self.place += 1
        self.gesture = None

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
