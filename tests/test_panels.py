import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.opening import ready_document
from app.panels import CurvesPanel, PointsPanel
from app.session import Selection, Session
from core.affine import Affine
from core.document import Curve, Document

Role = Qt.ItemDataRole


@pytest.fixture
def session():
    document = ready_document()
    return Session(document.with_curve_added(Curve(np.eye(2), closed=False, name="Slot")))


@pytest.fixture
def curves(qtbot, session):
    panel = CurvesPanel(session)
    qtbot.addWidget(panel)
    panel.show()
    return panel


@pytest.fixture
def points(qtbot, session):
    panel = PointsPanel(session)
    qtbot.addWidget(panel)
    panel.show()
    return panel


def cell(panel, row, column, role=Role.DisplayRole):
    return panel.model.data(panel.model.index(row, column), role)


def test_the_curves_are_listed_with_what_they_are(curves, session):
    assert [curves.list.item(i).text() for i in range(2)] == ["Curve 1", "Slot"]
    assert curves.list.item(0).toolTip() == "closed, 8 points"
    assert curves.list.item(1).toolTip() == "open, 2 points"
    session.edit(session.document.without_curves({0}), "Delete curve")
    assert curves.list.count() == 1


def test_choosing_a_curve_selects_its_points(curves, session):
    curves.list.setCurrentRow(1)
    assert session.selection == Selection(frozenset({(1, 0), (1, 1)}), 1)


def test_the_current_curve_is_marked(curves, session):
    session.select(Selection(curve=1))
    assert curves.list.currentRow() == 1
    assert session.selection == Selection(curve=1)


def test_a_curve_is_renamed_in_one_step(curves, session):
    curves.list.item(1).setText("Key slot")
    assert session.document.curves[1].name == "Key slot"
    assert session.undo_name == "Rename curve to Key slot"
    curves.list.item(1).setText("   ")
    assert session.document.curves[1].name == "Key slot"
    assert curves.list.item(1).text() == "Key slot"


def test_an_empty_drawing_says_what_to_do(curves, points, session):
    session.replace(Document(), None)
    assert curves.empty.isVisible()
    assert points.empty.isVisible()
    session.replace(ready_document(), None)
    assert curves.list.isVisible()
    assert points.table.isVisible()


def test_the_table_shows_the_current_curve(points, session):
    assert points.model.rowCount() == 8
    assert [cell(points, 1, axis) for axis in (0, 1)] == ["60.000", "\N{MINUS SIGN}8.000"]
    session.select(Selection(curve=1))
    assert points.model.rowCount() == 2
    assert cell(points, 0, 0) == "1.000"


@pytest.mark.parametrize(
    ("text", "value"), [("12.5", 12.5), ("25.4/2", 12.7), ("-3,25", -3.25), ("1e3", 1000.0)]
)
def test_a_coordinate_is_edited_in_one_step(points, session, text, value):
    assert points.model.setData(points.model.index(3, 1), text)
    assert session.document.curves[0].points[3].tolist() == [118.0, value]
    assert session.undo_name == "Set y of point 4"
    session.undo()
    assert cell(points, 3, 1) == "45.000"


@pytest.mark.parametrize("text", ["abc", "", "nan", "1/0", "1e300"])
def test_a_coordinate_that_is_nonsense_is_refused(qtbot, points, session, text):
    before = session.document
    with qtbot.waitSignal(points.refused) as refused:
        assert not points.model.setData(points.model.index(0, 0), text)
    assert refused.args[0].endswith(".")
    assert session.document is before


def test_leaving_a_cell_unchanged_keeps_every_digit(points, session):
    third = session.document.curves[0].moved(0, (1 / 3, 2 / 3))
    session.edit(session.document.with_curve(0, third), "Move point")
    before = session.document
    index = points.model.index(0, 0)
    points.model.setData(index, points.model.data(index, Role.EditRole))
    assert session.document is before


def test_table_and_canvas_share_one_selection(points, session):
    session.select(Selection(frozenset({(0, 2), (0, 5), (1, 0)}), 0))
    rows = points.table.selectionModel().selectedRows()
    assert sorted(index.row() for index in rows) == [2, 5]
    assert (1, 0) in session.selection.points
    points.table.selectRow(6)
    assert session.selection == Selection(frozenset({(0, 6)}), 0)


def test_moves_keep_the_rows_in_view(points, session):
    resets = []
    points.model.modelReset.connect(lambda: resets.append(True))
    curve = session.document.curves[0].moved(1, (7.0, 8.0))
    session.edit(session.document.with_curve(0, curve), "Move point")
    assert cell(points, 1, 0) == "7.000"
    assert resets == []
    session.edit(session.document.with_curve(0, curve.without([0])), "Delete point")
    assert resets == [True]


def test_cells_are_read_out_in_words(points):
    spoken = cell(points, 1, 1, Role.AccessibleTextRole)
    assert spoken == "Point 2, y \N{MINUS SIGN}8.000 millimetres"


def test_only_rows_that_changed_are_shown_anew(qtbot):
    session = Session(Document((Curve(np.arange(400.0).reshape(-1, 2)),)))
    panel = PointsPanel(session)
    qtbot.addWidget(panel)
    told = []
    panel.model.dataChanged.connect(lambda first, last: told.append((first.row(), last.row())))
    curve = session.document.curves[0].moved([7, 150], [(1, 2), (3, 4)])
    session.edit(session.document.with_curve(0, curve), "Move 2 points")
    assert told == [(7, 7), (150, 150)]
    assert panel.model.data(panel.model.index(7, 1)) == "2.000"
    assert panel.model.data(panel.model.index(8, 0)) == "16.000"


@pytest.fixture
def listed(qtbot):
    """A panel of 200 points, and the rows that it is told to show anew."""
    session = Session(Document((Curve(np.arange(400.0).reshape(-1, 2)),)))
    panel = PointsPanel(session)
    qtbot.addWidget(panel)
    told = []
    panel.model.dataChanged.connect(lambda first, last: told.append((first.row(), last.row())))
    return session, panel, told


def test_all_rows_are_shown_anew_when_the_curve_is_carried_elsewhere(listed):
    session, panel, told = listed
    curve = session.document.curves[0].carried(Affine.shift((1.0, 2.0)))
    session.edit(session.document.with_curve(0, curve), "Move 200 points")
    assert told == [(0, 199)]
    assert panel.model.data(panel.model.index(7, 0)) == "15.000"


def test_within_a_drag_the_table_is_told_of_many_moves_at_once(qtbot, listed):
    session, panel, told = listed
    session.begin("Move point")
    for step in range(1, 9):
        curve = session.document.curves[0].moved([step % 2], [(step, 0.0)])
        session.adjust(session.document.with_curve(0, curve))
    assert told == []
    session.commit()
    qtbot.waitUntil(lambda: len(told) > 0)
    assert told == [(0, 0), (1, 1)]
    assert panel.model.data(panel.model.index(0, 0)) == "8.000"
