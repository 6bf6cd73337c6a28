from collections import Counter

import pytest
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QKeySequence, QPalette
from PySide6.QtTest import QTest

from answers import Answers
from app.actions import COMMANDS, CONTEXT_MENU, MENUS, TOOL_BAR, Reach
from app.assets import icon_path
from app.icons import MODES
from app.keysheet import KeySheet, keys_in_words, sheet
from app.style import DARK
from app.theme import window_palette
from app.window import MainWindow
from core.family import PRESETS, Parameters

Key = Qt.Key
BY_KEY = {command.key: command for command in COMMANDS}


@pytest.fixture
def window(qtbot):
    window = MainWindow(dialogs=Answers())
    qtbot.addWidget(window)
    with qtbot.waitSignal(window.completed):
        window.show()
    window.activateWindow()
    window.canvas.setFocus()
    return window


def menu_actions(menu):
    for action in menu.actions():
        if action.menu():
            yield from menu_actions(action.menu())
        elif not action.isSeparator():
            yield action


def test_names_are_unique():
    assert len(BY_KEY) == len(COMMANDS)


def test_every_row_is_complete():
    for command in COMMANDS:
        assert command.menu in MENUS, command.key
        assert command.tip, command.key
        assert not command.tip.endswith("..."), command.key
        assert not command.icon or icon_path(command.icon).is_file(), command.key
    assert {key for key in (*TOOL_BAR, *CONTEXT_MENU) if key} <= set(BY_KEY)


def test_no_key_means_two_things(qtbot):
    keys = Counter(sequence.toString() for command in COMMANDS for sequence in command.sequences)
    assert [key for key, count in keys.items() if count > 1] == []


def test_plain_letters_and_digits_work_on_the_canvas_only(qtbot):
    for command in COMMANDS:
        for sequence in command.sequences:
            if len(sequence.toString()) == 1 and sequence.toString() != "?":
                assert command.reach is Reach.CANVAS, command.key


@pytest.mark.parametrize(
    ("key", "keys"),
    [
        ("new", "Ctrl+N"),
        ("open", "Ctrl+O"),
        ("save", "Ctrl+S"),
        ("save as", "Ctrl+Shift+S"),
        ("import", "Ctrl+I"),
        ("export", "Ctrl+Shift+E"),
        ("export again", "Ctrl+E"),
        ("quit", "Ctrl+Q"),
        ("undo", "Ctrl+Z"),
        ("redo", "Ctrl+Shift+Z"),
        ("cut", "Ctrl+X"),
        ("copy", "Ctrl+C"),
        ("paste", "Ctrl+V"),
        ("duplicate", "Ctrl+D"),
        ("select all", "Ctrl+A"),
        ("closed", "Ctrl+Shift+C"),
        ("zoom in", "Ctrl+="),
        ("zoom in", "Ctrl++"),
        ("zoom out", "Ctrl+-"),
        ("real size", "1"),
        ("fit selection", "3"),
        ("fit", "5"),
        ("select", "V"),
        ("pen", "P"),
        ("hand", "H"),
        ("keys", "F1"),
        ("keys", "?"),
    ],
)
def test_the_usual_keys(qtbot, key, keys):
    assert QKeySequence(keys) in BY_KEY[key].sequences


def test_the_menus_hold_every_action_once(window):
    listed = Counter(
        action.objectName()
        for top in window.menuBar().actions()
        for action in menu_actions(top.menu())
        if action.objectName() in BY_KEY
    )
    assert listed == Counter(list(BY_KEY))
    assert [top.text() for top in window.menuBar().actions()] == list(MENUS)


def test_letters_called_by_alt_are_unique_in_each_menu(window):
    for top in window.menuBar().actions():
        letters = Counter()
        for action in top.menu().actions():
            text = action.text().replace("&&", "")
            if "&" in text:
                letters[text[text.index("&") + 1].lower()] += 1
        assert all(count == 1 for count in letters.values()), (top.text(), letters)


def test_undo_and_redo_carry_the_name_of_the_step(window):
    undo, redo = window.commands["undo"], window.commands["redo"]
    assert not undo.isEnabled()
    assert not redo.isEnabled()
    window.scheme.choose_preset("Tight")
    assert undo.isEnabled()
    assert undo.text() == "&Undo Preset Tight"
    undo.trigger()
    assert not undo.isEnabled()
    assert redo.text() == "&Redo Preset Tight"
    redo.trigger()
    assert window.session.document.parameters == PRESETS["Tight"]


def test_marks_follow_the_document(window):
    session, commands = window.session, window.commands
    assert commands["preset Calm"].isChecked()
    assert commands["closed"].isChecked()
    session.edit(session.document.with_parameters(Parameters("1/3", 0, 0, "mirrored")), "Set")
    assert not any(commands[f"preset {name}"].isChecked() for name in PRESETS)
    assert commands["neighbours mirrored"].isChecked()
    commands["preset Lean"].trigger()
    assert session.document.parameters == PRESETS["Lean"]
    assert commands["neighbours translated"].isChecked()
    commands["preset Lean"].trigger()
    assert commands["preset Lean"].isChecked()


def test_what_needs_a_selection_or_a_curve_is_off_without(window):
    commands = window.commands
    assert not commands["delete"].isEnabled()
    window.canvas.select_all()
    assert commands["delete"].isEnabled()
    commands["delete"].trigger()
    for key in ("delete", "closed", "reverse", "delete curve", "fit selection"):
        assert not commands[key].isEnabled(), key


def test_tools_are_taken_by_letter_on_the_canvas(window):
    for key, letter in (("pen", Key.Key_P), ("hand", Key.Key_H), ("select", Key.Key_V)):
        QTest.keyClick(window.canvas, letter)
        assert window.canvas.tool == key
        assert window.commands[key].isChecked()


def test_letters_typed_into_a_field_stay_there(window):
    field = window.scheme.fields["alpha"]
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "p1/5?")
    assert field.text() == "p1/5?"
    assert window.canvas.tool == "select"


def test_undo_reaches_the_drawing_from_a_field_that_is_not_being_edited(window):
    field = window.scheme.fields["alpha"]
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "1/4")
    QTest.keyClick(field, Key.Key_Return)
    assert window.session.document.parameters == Parameters("1/4", "-1/2", 0)
    QTest.keyClick(field, Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.parameters == PRESETS["Calm"]
    assert field.text() == "0"


def test_undo_takes_a_whole_burst_back_and_redo_brings_it_again(window):
    track = window.scheme.tracks["beta"]
    track.setFocus()
    for _ in range(3):
        QTest.keyClick(track, Key.Key_Right)
    moved = window.session.document
    window.commands["undo"].trigger()
    assert window.session.document.parameters == PRESETS["Calm"]
    window.commands["redo"].trigger()
    assert window.session.document is moved


def test_icons_take_the_colour_of_the_text(window):
    def ink(key):
        image = window.commands[key].icon().pixmap(20, 20).toImage()
        colours = Counter(
            image.pixelColor(x, y).name()
            for x in range(image.width())
            for y in range(image.height())
            if image.pixelColor(x, y).alpha() == 255
        )
        return colours.most_common(1)[0][0]

    window.setPalette(window_palette(DARK))
    for command in COMMANDS:
        if command.icon and window.commands[command.key].isEnabled():
            assert ink(command.key) == DARK.text, command.key


def test_both_modes_of_every_icon_are_drawn_in_the_end(qtbot, window):
    """At first only those that are seen; what Qt makes up for the other has other colours."""
    for command in COMMANDS:
        if command.icon:
            icon = window.commands[command.key].icon()
            for mode, group in MODES.items():
                ink = window.palette().color(group, QPalette.ColorRole.ButtonText)
                image = icon.pixmap(QSize(20, 20), mode).toImage()
                colours = {
                    image.pixelColor(x, y).name()
                    for x in range(image.width())
                    for y in range(image.height())
                    if image.pixelColor(x, y).alpha() == 255
                }
                assert ink.name() in colours, command.key


def test_the_sheet_of_keys_tells_all_of_them(qtbot):
    told = {keys for _, rows in sheet() for keys, _ in rows}
    for command in COMMANDS:
        if command.sequences:
            assert keys_in_words(command) in told, command.key
    dialog = KeySheet()
    qtbot.addWidget(dialog)
    dialog.show()
    assert dialog.height() < 800
    assert dialog.width() < 1280
