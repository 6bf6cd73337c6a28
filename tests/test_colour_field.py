import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QColorDialog

from app.colour_field import ColourField


@pytest.fixture
def field(qtbot):
    field = ColourField()
    qtbot.addWidget(field)
    field.show()
    field.set_colour("#112233")
    return field


def type_into(field, text):
    field.line.setFocus()
    field.line.selectAll()
    QTest.keyClicks(field.line, text)
    QTest.keyClick(field.line, Qt.Key.Key_Return)


@pytest.mark.parametrize(
    ("text", "colour"), [("#FF8000", "#ff8000"), ("00f", "#0000ff"), (" 1e90ff ", "#1e90ff")]
)
def test_a_typed_colour_is_handed_over(qtbot, field, text, colour):
    with qtbot.waitSignal(field.entered) as entered:
        type_into(field, text)
    assert entered.args == [colour]
    assert field.colour == field.line.text() == colour


@pytest.mark.parametrize("text", ["blue", "#12345", "#gggggg", ""])
def test_what_is_no_colour_is_refused_in_a_sentence(qtbot, field, text):
    if not text:
        field.line.clear()
    with qtbot.waitSignal(field.refused) as refused:
        type_into(field, text)
    assert refused.args[0].startswith("A colour is written like #1e90ff")
    assert field.fault == refused.args[0]
    assert field.colour == "#112233"
    with qtbot.waitSignal(field.entered):
        type_into(field, "#112233")
    assert not field.fault


def test_the_same_colour_is_no_change(field):
    entered = []
    field.entered.connect(entered.append)
    type_into(field, "#112233")
    assert entered == []


def test_the_button_opens_a_palette(qtbot, field):
    field.button.setFocus()
    QTest.keyClick(field.button, Qt.Key.Key_Space)
    dialog = field.findChild(QColorDialog)
    assert dialog.currentColor().name() == "#112233"
    with qtbot.waitSignal(field.entered) as entered:
        dialog.setCurrentColor(QColor("#00ff00"))
        dialog.accept()
    assert entered.args == ["#00ff00"]


def test_the_button_shows_the_colour_and_has_a_name(field):
    field.setAccessibleName("Colour")
    icon = field.button.icon().pixmap(16, 16).toImage()
    assert icon.pixelColor(8, 8).name() == "#112233"
    assert field.button.accessibleName() == "Choose colour"
    assert field.line.accessibleName() == "Colour"
