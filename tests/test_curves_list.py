import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QDrag

from app.drawing_data import DrawingData
from app.opening import ready_document
from app.panels import CurvesPanel
from app.session import Session
from core.document import Curve


@pytest.fixture
def session():
    document = ready_document()
    for name, points in (("Slot", np.eye(2)), ("Empty", np.zeros((0, 2)))):
        document = document.with_curve_added(Curve(points, False, name))
    return Session(document)


@pytest.fixture
def panel(qtbot, session):
    panel = CurvesPanel(session)
    qtbot.addWidget(panel)
    panel.show()
    return panel


@pytest.fixture
def curves(panel):
    return panel.list


def test_a_drag_offers_the_curve_as_it_is_copied(curves, session, monkeypatch):
    dragged = []
    monkeypatch.setattr(QDrag, "exec", lambda drag, action: dragged.append((drag, action)))
    curves.setCurrentRow(1)
    curves.startDrag(Qt.DropAction.CopyAction)
    ((drag, action),) = dragged
    data = drag.mimeData()
    assert isinstance(data, DrawingData)
    assert data.document.curves == (session.document.curves[1],)
    assert drag.pixmap().height() > 10  # the row of the list hangs on the mouse
    assert action == Qt.DropAction.CopyAction
    assert len(session.document.curves) == 3


def test_a_curve_without_points_is_not_dragged(curves):
    curves.setCurrentRow(2)
    assert curves.dragged() is None


def test_curves_are_not_dropped_into_the_list(curves):
    assert not curves.acceptDrops()
    assert curves.dragEnabled()
