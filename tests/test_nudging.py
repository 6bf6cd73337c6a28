"""A burst of nudges is one step of undo."""

import numpy as np
import pytest

from app.nudging import BURST_MS, Nudging
from app.session import Selection, Session
from core.document import Curve, Document


@pytest.fixture
def session(qtbot):
    session = Session(Document((Curve([(0, 0), (10, 0), (10, 10)]),)))
    session.select(Selection(frozenset({(0, 1)})))
    return session


@pytest.fixture
def nudging(session):
    return Nudging(session)


def place(session, point=1):
    return tuple(session.document.curves[0].points[point])


def test_a_burst_is_one_step(session, nudging):
    start = session.document
    for _ in range(3):
        nudging.nudge(1, 0)
    nudging.settle()
    assert place(session) == (13, 0)
    assert session.undo_name == "Move point"
    session.undo()
    assert session.document is start


def test_the_burst_ends_by_itself(qtbot, session, nudging):
    nudging.nudge(1, 0)
    assert nudging.is_open
    qtbot.waitUntil(lambda: not nudging.is_open, timeout=10 * BURST_MS)
    assert not session.in_gesture
    nudging.nudge(1, 0)
    nudging.settle()
    session.undo()
    assert place(session) == (11, 0)


def test_another_selection_begins_another_burst(session, nudging):
    nudging.nudge(1, 0)
    session.select(Selection(frozenset({(0, 0), (0, 2)})))
    nudging.nudge(0, 1)
    nudging.settle()
    assert session.undo_name == "Move 2 points"
    session.undo()
    assert session.undo_name == "Move point"
    assert place(session) == (11, 0)


def test_nothing_is_nudged_without_a_selection_or_within_another_gesture(session, nudging):
    session.begin("Set beta")
    nudging.nudge(1, 0)
    assert place(session) == (10, 0)
    session.cancel()
    session.select(Selection())
    nudging.nudge(1, 0)
    assert session.undo_name is None


def test_undo_takes_an_open_burst_back(session, nudging):
    start = session.document
    nudging.nudge(1, 0)
    session.undo()
    assert session.document is start
    nudging.nudge(0, 1)
    nudging.settle()
    np.testing.assert_array_equal(place(session), (10, 1))
