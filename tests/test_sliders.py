import re
from fractions import Fraction

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from app.opening import ready_document
from app.session import Session
from app.sliders import (
    CUSTOM,
    NEIGHBOUR_TIPS,
    PRESET_TIPS,
    STEPS_PER_UNIT,
    SchemePanel,
    default,
)
from core.continuity import smoothness
from core.family import PRESETS, Parameters, default_box
from core.gibbs import step_gibbs
from core.wording import class_name

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def session():
    return Session(ready_document())


@pytest.fixture
def panel(qtbot, session):
    window = QWidget()
    qtbot.addWidget(window)
    panel = SchemePanel(session)
    other = QWidget()  # somewhere for the focus to go
    other.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    layout = QVBoxLayout(window)
    layout.addWidget(panel)
    layout.addWidget(other)
    panel.other, panel.top = other, window  # a window lives as long as something holds it
    window.resize(420, 360)
    window.show()
    qtbot.waitExposed(window)
    window.activateWindow()
    return panel


def place(track, value):
    """Where a value lies on a track, in whole pixels."""
    return QPoint(round(track.x_of(value)), track.height() // 2)


def drag(track, *values, modifier=Qt.KeyboardModifier.NoModifier, release=True):
    QTest.mousePress(track, LEFT, Qt.KeyboardModifier.NoModifier, place(track, track.value()))
    for value in values:
        QTest.mouseMove(track, place(track, value))
    if release:
        QTest.mouseRelease(track, LEFT, modifier, place(track, track.value()))


def type_into(field, text):
    field.setFocus()
    field.selectAll()
    if text.isascii():
        QTest.keyClicks(field, text)
    else:
        field.insert(text)  # QTest aborts on letters that no key of its table has
    QTest.keyClick(field, Key.Key_Return)


def states(session):
    """Number of undo steps there are."""
    count = 0
    while session.undo_name is not None:
        session.undo()
        count += 1
    return count


def test_a_drag_is_one_named_step(panel, session):
    drag(panel.tracks["beta"], -90, -80, -70)
    beta = session.document.parameters.beta
    assert beta == Fraction(panel.tracks["beta"].value(), STEPS_PER_UNIT)
    assert abs(beta - Fraction(-7, 20)) <= Fraction(1, 50)
    assert session.undo_name == "Set beta " + panel.fields["beta"].text()
    assert session.undo_name.startswith("Set beta \N{MINUS SIGN}0.3")
    assert states(session) == 1
    assert session.document.parameters == PRESETS["Calm"]


def test_a_click_beside_the_handle_brings_it_there(panel, session):
    track = panel.tracks["alpha"]
    QTest.mouseClick(track, LEFT, Qt.KeyboardModifier.NoModifier, place(track, 60))
    assert abs(session.document.parameters.alpha - Fraction(3, 10)) <= Fraction(1, 50)
    assert states(session) == 1


def test_pressing_the_handle_changes_nothing(panel, session):
    track = panel.tracks["beta"]
    before = session.document
    QTest.mouseClick(track, LEFT, Qt.KeyboardModifier.NoModifier, place(track, track.value()))
    assert session.document is before
    assert session.undo_name is None
    assert not session.in_gesture


def test_escape_during_a_drag_restores_the_very_document(panel, session):
    before = session.document
    track = panel.tracks["gamma"]
    drag(track, 20, 80, release=False)
    assert session.document.parameters.gamma != 0
    QTest.keyClick(track, Key.Key_Escape)
    assert session.document is before
    assert track.value() == 0
    QTest.mouseMove(track, place(track, 150))
    QTest.mouseRelease(track, LEFT, Qt.KeyboardModifier.NoModifier, place(track, 150))
    assert session.document is before
    assert session.undo_name is None


def test_shift_moves_finely(panel, session):
    track = panel.tracks["beta"]
    start = place(track, track.value())
    for modifier, way in ((Qt.KeyboardModifier.NoModifier, 40), (SHIFT, 4)):
        QTest.mousePress(track, LEFT, modifier, start)
        QTest.mouseMove(track, start)
        steps = (track.maximum() - track.minimum()) / track._length * way
        QApplication.sendEvent(track, moved(track, start + QPoint(40, 0), modifier))
        assert track.value() == pytest.approx(-STEPS_PER_UNIT / 2 + steps, abs=1)
        QTest.keyClick(track, Key.Key_Escape)
        assert session.undo_name is None


def moved(widget, position, modifiers):
    from PySide6.QtCore import QEvent
    from PySide6.QtGui import QMouseEvent

    point = QPointF(position)
    return QMouseEvent(
        QEvent.Type.MouseMove, point, widget.mapToGlobal(point), LEFT, LEFT, modifiers
    )


@pytest.mark.parametrize("part", ["track", "label"])
def test_double_click_resets_to_the_mark(panel, session, part):
    session.edit(session.document.with_parameters(Parameters("1/3", "1/7", "-1/9")), "Set")
    for name, expected in (("alpha", 0), ("beta", Fraction(-1, 2)), ("gamma", 0)):
        widget = panel.tracks[name]
        if part == "label":
            layout = panel.layout()
            grid = layout.itemAt(2).layout()
            widget = grid.itemAtPosition(["alpha", "beta", "gamma"].index(name), 0).widget()
        QTest.mouseDClick(widget, LEFT)
        assert getattr(session.document.parameters, name) == expected
        assert session.undo_name.startswith(f"Set {name} ")


def test_a_burst_of_arrows_is_one_step(qtbot, panel, session):
    track = panel.tracks["beta"]
    track.setFocus()
    for _ in range(5):
        QTest.keyClick(track, Key.Key_Right)
    assert session.document.parameters.beta == Fraction(-95, 200)
    assert session.in_gesture
    qtbot.waitUntil(lambda: not session.in_gesture)
    QTest.keyClick(track, Key.Key_Left)
    panel.settle()
    assert session.undo_name == "Set beta \N{MINUS SIGN}0.48"
    assert states(session) == 2


def test_a_burst_ends_when_the_focus_goes(panel, session):
    panel.tracks["alpha"].setFocus()
    QTest.keyClick(panel.tracks["alpha"], Key.Key_PageUp)
    assert session.in_gesture
    panel.other.setFocus()
    assert not session.in_gesture
    assert session.document.parameters.alpha == Fraction(1, 20)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.25", Fraction(1, 4)),
        ("1/4", Fraction(1, 4)),
        ("-1/3", Fraction(-1, 3)),
        ("25.4/2", Fraction(127, 10)),
        ("0,125", Fraction(1, 8)),
        ("\N{MINUS SIGN}0.5", Fraction(-1, 2)),
        (" 1e-3 ", Fraction(1, 1000)),
    ],
)
def test_a_typed_number_is_taken_exactly(panel, session, text, value):
    type_into(panel.fields["alpha"], text)
    assert session.document.parameters.alpha == value
    assert panel.fields["alpha"].number == value
    assert states(session) == 1


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("abc", "must be a number"),
        ("1/0", "divides by zero"),
        ("", "must be a number"),
        ("101", "must lie between"),
        ("1.000,5", "must be a number"),
        ("nan", "must be a number"),
    ],
)
def test_nonsense_is_refused_and_escape_restores(qtbot, panel, session, text, reason):
    field, before = panel.fields["beta"], session.document
    with qtbot.waitSignal(panel.refused) as refused:
        type_into(field, text)
        if not text:
            field.clear()
            QTest.keyClick(field, Key.Key_Return)
    assert reason in refused.args[0]
    assert reason in field.toolTip()
    assert session.document is before
    QTest.keyClick(field, Key.Key_Escape)
    assert field.text() == "\N{MINUS SIGN}0.5"
    assert not field.fault
    assert reason not in field.toolTip()


def test_a_value_beyond_the_track_is_shown_truly(panel, session):
    type_into(panel.fields["gamma"], "7/2")
    assert session.document.parameters.gamma == Fraction(7, 2)
    assert panel.tracks["gamma"].value() == panel.tracks["gamma"].maximum()
    assert panel.fields["gamma"].text() == "3.5"


def test_what_the_session_changes_never_comes_back(panel, session):
    edits = []
    session.changed.connect(lambda old, new: edits.append(new))
    document = session.document.with_parameters(Parameters("1/3", "12345/100000", -2, "mirrored"))
    session.edit(document, "From elsewhere")
    assert edits == [document]
    assert session.document is document
    assert panel.fields["alpha"].text() == "1/3"
    assert panel.fields["beta"].text() == "0.12345"
    assert panel.preset.currentText() == CUSTOM
    assert panel.neighbours["mirrored"].isChecked()


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_one_step_and_is_recognised(panel, session, name):
    session.edit(session.document.with_parameters(Parameters("1/3", "1/7", 0)), "Set")
    index = panel.preset.findText(name)
    panel.preset.setCurrentIndex(index)
    panel.preset.activated.emit(index)
    assert session.document.parameters == PRESETS[name]
    assert session.undo_name == f"Preset {name}"
    assert panel.preset.currentText() == name
    assert panel.preset.findText(CUSTOM) < 0
    assert panel.description.text() == PRESET_TIPS[name]


def test_every_preset_has_a_tip():
    assert set(PRESET_TIPS) == set(PRESETS)


@pytest.mark.parametrize("name", PRESETS)
def test_the_numbers_in_the_tips_are_proven(name):
    tip, mask = PRESET_TIPS[name], PRESETS[name].mask
    (told,) = re.findall(r"C[\N{SUPERSCRIPT ONE}\u00b2\u00b3\u2070-\u2079]+", tip)
    assert told == class_name(smoothness(mask).order)
    assert class_name(smoothness(mask).not_class) == class_name(smoothness(mask).order + 1)
    gibbs = step_gibbs(mask)
    for number in re.findall(r"([\d.]+)\s%", tip):
        decimals = len(number.partition(".")[2])
        assert number == f"{100 * gibbs.overshoot.lower:.{decimals}f}"
    assert ("never overshoots" in tip) is (gibbs.overshoot.upper == gibbs.undershoot.upper == 0)


def test_the_tip_of_mirrored_neighbours_is_proven():
    assert "at most C\N{SUPERSCRIPT TWO}" in NEIGHBOUR_TIPS["mirrored"]
    for lean in ("1/100", "1/10", "3/10"):
        assert smoothness(Parameters(lean, "-1/2", 0, "mirrored").mask).not_class <= 3


@pytest.mark.parametrize("key", NEIGHBOUR_TIPS)
def test_the_tracks_reach_over_the_proven_box(panel, session, key):
    panel.neighbours[key].click()
    for name, ends in default_box(key).items():
        track = panel.tracks[name]
        assert (track.minimum(), track.maximum()) == tuple(end * STEPS_PER_UNIT for end in ends)
        assert track.minimum() <= default(name) * STEPS_PER_UNIT <= track.maximum()


def test_another_box_changes_no_number(panel, session):
    session.edit(session.document.with_parameters(Parameters("1/2", "-5/4", "-1/2")), "Set")
    panel.neighbours["mirrored"].click()
    assert session.document.parameters == Parameters("1/2", "-5/4", "-1/2", "mirrored")
    assert panel.tracks["alpha"].value() == panel.tracks["alpha"].maximum()
    assert panel.fields["alpha"].text() == "0.5"
    assert states(session) == 2


def test_the_neighbours_switch_keeps_the_weights(panel, session):
    session.edit(session.document.with_parameters(PRESETS["Lean"]), "Preset Lean")
    panel.neighbours["mirrored"].click()
    lean = PRESETS["Lean"]
    assert session.document.parameters == Parameters(
        lean.alpha, lean.beta, lean.gamma, "mirrored"
    )
    assert session.undo_name == "Neighbours mirrored"
    session.undo()
    assert panel.neighbours["translated"].isChecked()


def test_the_wheel_turns_only_with_the_focus(panel, session):
    track = panel.tracks["beta"]

    def turn():
        event = QWheelEvent(
            QPointF(40, 10), track.mapToGlobal(QPointF(40, 10)), QPoint(), QPoint(0, 120),
            Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase,
            False,
        )  # fmt: skip
        QApplication.sendEvent(track, event)

    panel.other.setFocus()
    turn()
    assert session.undo_name is None
    track.setFocus()
    turn()
    assert session.undo_name is not None


def test_every_control_has_a_name_for_screen_readers(panel):
    controls = [panel.preset, *panel.tracks.values(), *panel.fields.values()]
    controls += panel.neighbours.values()
    assert all(control.accessibleName() for control in controls)
    assert all(control.toolTip() for control in controls)
