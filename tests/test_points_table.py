import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication

from app.opening import ready_document
from app.panels import PointsPanel
from app.point_set import PointSet
from app.points_table import as_text, from_text, with_rows
from app.session import Selection, Session
from core.document import Curve, Document


@pytest.fixture
def session():
    return Session(ready_document())


@pytest.fixture
def told():
    return []


@pytest.fixture
def panel(qtbot, session, told):
    panel = PointsPanel(session)
    qtbot.addWidget(panel)
    panel.told.connect(told.append)
    panel.show()
    return panel


@pytest.fixture
def table(panel):
    return panel.table


def select(session, *rows):
    session.select(Selection(PointSet({0: rows}), 0))


def points(session):
    return session.document.curves[0].points


def test_rows_go_and_come_back_as_the_same_floats(session, table):
    third = np.array([1 / 3, -2e-7])
    session.edit(session.document.with_curve(0, Curve([third, third * 7, (0, 1)])), "Set")
    table.copy()
    text = QGuiApplication.clipboard().text()
    assert text.splitlines()[2] == "0.0\t1.0"
    assert (from_text(text) == points(session)).all()


def test_the_selected_rows_are_copied(session, table, told):
    select(session, 1, 3)
    table.copy()
    assert QGuiApplication.clipboard().text() == "60.0\t-8.0\n118.0\t45.0\n"
    assert told == ["Copied 2 points as numbers."]


def test_as_many_rows_take_their_places_one_by_one(session, table):
    select(session, 1, 3)
    QGuiApplication.clipboard().setText("1;1,5\n2;2,5\n")
    table.paste()
    assert points(session)[[1, 3]].tolist() == [[1, 1.5], [2, 2.5]]
    assert len(points(session)) == 8
    assert session.undo_name == "Paste 2 points"
    session.undo()
    assert (points(session) == ready_document().curves[0].points).all()


def test_other_numbers_of_rows_stand_where_the_first_was(session, table):
    before = points(session)
    select(session, 2, 3)
    QGuiApplication.clipboard().setText("x\ty\n1\t1\n2\t2\n3\t3\n")
    table.paste()
    expected = np.concatenate([before[:2], [(1, 1), (2, 2), (3, 3)], before[4:]])
    assert (points(session) == expected).all()
    assert session.selection.points == PointSet({0: [2, 3, 4]})


def test_without_a_selection_they_follow_the_last(session, table):
    QGuiApplication.clipboard().setText("1 1\n")
    table.paste()
    assert points(session)[-1].tolist() == [1, 1]
    assert len(points(session)) == 9


def test_cut_rows_are_gone_and_on_the_clipboard(session, table):
    select(session, 0, 1)
    table.cut()
    assert len(points(session)) == 6
    assert session.undo_name == "Cut 2 points"
    assert from_text(QGuiApplication.clipboard().text())[0].tolist() == [10, 10]
    select(session, *range(6))
    table.cut()
    assert session.document.curves == ()


@pytest.mark.parametrize("text", ["", "hello", "1 2\n3 x", "1 2 3", "1 2e99"])
def test_nonsense_is_told_and_changes_nothing(session, table, told, text):
    before = session.document
    QGuiApplication.clipboard().setText(text)
    table.paste()
    assert session.document is before
    assert told[0].startswith("The clipboard")
    assert told[0].endswith(".")


def test_without_a_curve_there_is_a_sentence_for_each(session, table, told):
    session.replace(Document(), None)
    for act in (table.copy, table.cut, table.paste):
        act()
    assert len(told) == 3
    assert all(sentence.endswith(".") for sentence in told)


def test_rows_are_replaced_in_place():
    curve = Curve(np.arange(8.0).reshape(4, 2))
    changed, rows = with_rows(curve, np.array([1, 3]), np.array([[9.0, 9.0]]))
    assert changed.points.tolist() == [[0, 1], [9, 9], [4, 5]]
    assert rows.tolist() == [1]
    assert as_text(changed.points).count("\n") == 3
