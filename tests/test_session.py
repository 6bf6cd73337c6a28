"""The session: one signal an edit, the selection kept within the document."""

from dataclasses import replace
from pathlib import Path

import pytest

from app.session import Selection, Session
from core.document import Curve, Document
from core.family import PRESETS


@pytest.fixture
def session(qtbot):
    return Session(Document((Curve([(0, 0), (1, 0), (1, 1)]), Curve([(5, 5)]))))


@pytest.fixture
def changes(session):
    seen = []
    session.changed.connect(lambda old, new: seen.append((old, new)))
    return seen


def shorter(document):
    return document.with_curve(0, document.curves[0].without([2]))


def test_an_edit_announces_old_and_new_once(session, changes):
    old = session.document
    session.edit(shorter(old), "Delete point")
    assert changes == [(old, session.document)]
    assert session.undo_name == "Delete point"
    session.undo()
    assert session.document is old
    assert len(changes) == 2


def test_an_edit_to_the_same_document_announces_nothing(session, changes):
    session.edit(session.document, "nothing")
    assert changes == []


def test_a_cancelled_gesture_restores_the_very_document(session, changes):
    old = session.document
    session.begin("Move point")
    session.adjust(shorter(old))
    assert session.origin is old
    session.cancel()
    assert session.document is old
    assert changes[-1][1] is old
    assert session.undo_name is None


def test_the_selection_is_kept_within_the_document(session):
    session.select(Selection(frozenset({(0, 1), (0, 2), (1, 0), (7, 0)}), 1))
    assert session.selection.points == {(0, 1), (0, 2), (1, 0)}
    assert session.selection.points.of_curve(0).tolist() == [1, 2]
    session.edit(shorter(session.document), "Delete point")
    assert session.selection.points == {(0, 1), (1, 0)}
    session.edit(session.document.without_curves({1}), "Delete curve")
    assert session.selection == Selection(frozenset({(0, 1)}), 0)


def test_the_unsaved_mark_follows_undo_back_to_the_saved_state(session):
    assert not session.is_modified
    session.edit(shorter(session.document), "Delete point")
    assert session.is_modified
    session.mark_saved(Path("wing.ninepoint"))
    assert not session.is_modified
    assert session.path == Path("wing.ninepoint")
    session.undo()
    assert session.is_modified
    session.redo()
    assert not session.is_modified


def test_another_document_starts_a_new_history(session, changes):
    session.edit(shorter(session.document), "Delete point")
    session.select(Selection(frozenset({(0, 0)})))
    other = Document((Curve([(3, 3)]),))
    session.replace(other, Path("other.ninepoint"))
    assert session.document is other
    assert session.undo_name is None
    assert not session.is_modified
    assert session.selection == Selection()
    assert changes[-1][1] is other


def test_moves_of_a_drag_tell_of_no_other_status_than_the_first(session):
    told = []
    session.status_changed.connect(lambda: told.append(session.undo_name))
    session.begin("Move point")
    for x in range(1, 6):
        curve = session.document.curves[0].moved([0], (x, 0))
        session.adjust(session.document.with_curve(0, curve))
    assert told == ["Move point"]
    session.commit()
    assert told == ["Move point"] * 2


@pytest.mark.parametrize(
    "change",
    [
        lambda document: document.with_curve(0, replace(document.curves[0], name="Wing")),
        lambda document: document.with_curve(0, replace(document.curves[0], closed=False)),
        lambda document: document.with_curve_added(document.curves[1]),
        lambda document: document.with_parameters(PRESETS["Tight"]),
    ],
)
def test_what_a_menu_shows_is_told_of_within_a_gesture_too(session, change):
    session.begin("Change")
    session.adjust(session.document.with_curve(0, session.document.curves[0].moved([0], (1, 0))))
    told = []
    session.status_changed.connect(lambda: told.append(True))
    session.adjust(change(session.document))
    assert told == [True]
