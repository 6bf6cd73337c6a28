from fractions import Fraction

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.map_panel import SIZE, MapPanel
from app.opening import ready_document
from app.session import Session
from core.atlas import Quantity
from core.continuity import certificate
from core.family import PRESETS, Parameters, default_box

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def session():
    return Session(ready_document())


@pytest.fixture
def panel(qtbot, session):
    window = QWidget()
    qtbot.addWidget(window)
    panel = MapPanel(session)
    panel.other, panel.top = QWidget(), window
    panel.other.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    layout = QVBoxLayout(window)
    layout.addWidget(panel, 1)
    layout.addWidget(panel.other)
    window.resize(300, 460)
    window.show()
    qtbot.waitExposed(window)
    window.activateWindow()
    yield panel
    panel.stop()


def complete(qtbot, panel):
    qtbot.waitUntil(lambda: not panel.is_busy and not np.isnan(panel.chart.values).any())
    return panel.chart.values


def choose(session, parameters):
    session.edit(session.document.with_parameters(parameters), "Set")


def at(panel, alpha, beta):
    return panel.chart.place_px(alpha, beta).toPoint()


def test_it_shows_the_proven_classes_of_the_box(qtbot, panel):
    values = complete(qtbot, panel)
    assert values.shape == (SIZE, SIZE)
    box = default_box("translated")
    for row, column in ((0, 0), (50, 50), (70, 30)):
        u = box["alpha"][0] + Fraction(column, SIZE - 1) * (box["alpha"][1] - box["alpha"][0])
        v = box["beta"][0] + Fraction(row, SIZE - 1) * (box["beta"][1] - box["beta"][0])
        proven = certificate(Parameters(u, v, 0).mask).order
        assert 0 <= values[row, column] <= proven
    assert panel.words.text() == "at least C\u00b3"


@pytest.mark.parametrize("index", range(len(Quantity)))
def test_each_quantity_has_words(qtbot, panel, index):
    panel.quantity.setCurrentIndex(index)
    complete(qtbot, panel)
    expected = ("at least C\u00b3", "H\u00f6lder exponent at least 3.", "overshoot about 0.0 %")
    assert panel.words.text().startswith(expected[index])


def test_nothing_is_computed_unseen(qtbot, session, monkeypatch):
    panel = MapPanel(session)
    qtbot.addWidget(panel)
    choose(session, PRESETS["Lean"])
    panel.quantity.setCurrentIndex(1)
    assert not panel.is_busy


def test_the_cross_follows_and_another_gamma_is_another_map(qtbot, panel, session):
    before = complete(qtbot, panel).copy()
    choose(session, PRESETS["Lean"])
    assert panel.chart.cross == (0.3, -0.6)
    assert np.array_equal(panel.chart.values, before)
    assert panel.is_busy
    qtbot.waitUntil(lambda: not panel.is_busy)
    assert not np.array_equal(panel.chart.values, before)
    choose(session, PRESETS["Calm"])
    qtbot.waitUntil(lambda: not panel.is_busy)
    assert np.array_equal(panel.chart.values, before)


def test_the_same_plane_is_not_computed_again(qtbot, panel, session):
    complete(qtbot, panel)
    choose(session, PRESETS["B-spline"])
    assert not panel.is_busy
    assert panel.chart.cross == (0.0, -1.0)


def test_only_some_maps_are_kept(qtbot, panel, session, monkeypatch):
    monkeypatch.setattr("app.map_panel.KEPT", 2)
    panel.quantity.setCurrentIndex(2)
    for step in range(5):
        choose(session, Parameters(0, 0, Fraction(step, 100)))
        qtbot.waitUntil(lambda: not panel.is_busy)
    assert len(panel._kept) <= 2


def test_a_drag_is_one_named_step(qtbot, panel, session):
    chart = panel.chart
    QTest.mousePress(chart, LEFT, pos=at(panel, 0.1, -0.5))
    QTest.mouseMove(chart, at(panel, 0.2, -0.6))
    QTest.mouseMove(chart, at(panel, 0.25, -0.75))
    QTest.mouseRelease(chart, LEFT, pos=at(panel, 0.25, -0.75))
    p = session.document.parameters
    assert float(p.alpha) == pytest.approx(0.25, abs=0.01)
    assert float(p.beta) == pytest.approx(-0.75, abs=0.01)
    assert (p.alpha * 200).denominator == (p.beta * 200).denominator == 1
    assert p.gamma == 0
    assert session.undo_name.startswith("Set alpha 0.2")
    session.undo()
    assert session.undo_name is None
    assert session.document.parameters == PRESETS["Calm"]


def test_escape_restores_the_very_document(panel, session):
    before = session.document
    QTest.mousePress(panel.chart, LEFT, pos=at(panel, 0.1, -0.9))
    assert session.document is not before
    QTest.keyClick(panel.chart, Key.Key_Escape)
    assert session.document is before
    QTest.mouseMove(panel.chart, at(panel, 0.3, -0.3))
    assert session.document is before


def test_a_drag_ends_at_the_edge_of_the_map(panel, session):
    QTest.mousePress(panel.chart, LEFT, pos=at(panel, 0, -0.5))
    QTest.mouseMove(panel.chart, (QPointF(at(panel, 0.5, 0.25)) + QPointF(400, -400)).toPoint())
    QTest.mouseRelease(panel.chart, LEFT)
    p = session.document.parameters
    assert (p.alpha, p.beta) == (Fraction(1, 2), Fraction(1, 4))


def test_arrows_are_one_step_a_burst(qtbot, panel, session):
    panel.chart.setFocus()
    for _ in range(3):
        QTest.keyClick(panel.chart, Key.Key_Right)
    QTest.keyClick(panel.chart, Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    p = session.document.parameters
    assert (p.alpha, p.beta) == (Fraction(3, 200), Fraction(-9, 20))
    panel.other.setFocus()
    assert not session.in_gesture
    session.undo()
    assert session.undo_name is None


def test_the_symmetric_plane_sets_both(qtbot, panel, session):
    choose(session, PRESETS["Lean"])
    panel.plane.setCurrentIndex(1)
    assert "not on this plane" in panel.words.text()
    QTest.mouseClick(panel.chart, LEFT, pos=at(panel, 0.25, -0.5))
    p = session.document.parameters
    assert p.alpha == p.gamma
    assert session.undo_name.startswith("Set alpha and gamma 0.2")
    assert panel.chart.cross is not None


def test_a_member_beyond_the_map_has_no_cross(panel, session):
    choose(session, Parameters(10, 0, 0))
    assert panel.chart.value_here() is None
    assert panel.words.text() == "outside the map"
    panel.grab()


def test_mirrored_maps_are_narrower(qtbot, panel, session):
    choose(session, Parameters("1/10", "-1/2", 0, "mirrored"))
    complete(qtbot, panel)
    (left, right), _ = panel.chart._ranges
    assert (left, right) == (-0.3, 0.3)


def test_hiding_ends_the_work(qtbot, panel):
    panel.hide()
    assert not panel.is_busy
