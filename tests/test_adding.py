import numpy as np
import pytest

from app.adding import add_curves
from app.opening import ready_document
from app.point_set import PointSet
from app.session import Session
from core.document import MAX_POINTS, Curve, Document
from core.errors import NinepointError
from core.family import PRESETS

TWO = Document((Curve(np.eye(2), False, "Slot"), Curve(np.eye(2) + 3, False, "Curve 1")))


def test_curves_are_added_in_one_step_and_selected():
    session = Session(ready_document())
    assert add_curves(session, TWO, "Import") == 2
    assert [curve.name for curve in session.document.curves] == ["Curve 1", "Slot", "Curve 2"]
    assert session.undo_name == "Import 2 curves"
    assert session.selection.points == PointSet({1: [0, 1], 2: [0, 1]})
    assert session.selection.curve == 1
    session.undo()
    assert session.undo_name is None
    assert len(session.document.curves) == 1


def test_the_drawing_keeps_its_scheme_unless_it_is_empty():
    tight = TWO.with_parameters(PRESETS["Tight"])
    session = Session(ready_document())
    add_curves(session, tight, "Paste")
    assert session.document.parameters == PRESETS["Calm"]
    session = Session(Document())
    add_curves(session, tight, "Paste")
    assert session.document.parameters == PRESETS["Tight"]


def test_an_open_gesture_is_complete_before():
    session = Session(ready_document())
    session.begin("Set beta")
    session.adjust(session.document.with_parameters(PRESETS["Tight"]))
    add_curves(session, TWO, "Import")
    session.undo()
    assert session.undo_name == "Set beta"


@pytest.mark.parametrize("points", [0, MAX_POINTS])
def test_nothing_and_too_much_change_nothing(points):
    document = Document((Curve(np.zeros((points, 2))),))
    session = Session(ready_document())
    before = session.document
    with pytest.raises(NinepointError):
        add_curves(session, document, "Import")
    assert session.document is before
    assert session.undo_name is None
