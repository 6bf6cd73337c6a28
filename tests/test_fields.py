from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.fields import NumberField, shown_number, typed_number
from core.errors import ParameterError


@given(st.fractions(max_denominator=10**9))
def test_what_is_shown_is_read_back_exactly(number):
    assert typed_number(shown_number(number), "x") == number


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Fraction(0), "0"),
        (Fraction(1, 4), "0.25"),
        (Fraction(-7, 20), "\N{MINUS SIGN}0.35"),
        (Fraction(1, 3), "1/3"),
        (Fraction(-22, 7), "\N{MINUS SIGN}22/7"),
        (Fraction(100), "100"),
    ],
)
def test_short_decimals_are_preferred_to_fractions(number, text):
    assert shown_number(number) == text


@pytest.fixture
def field(qtbot):
    field = NumberField("width")
    qtbot.addWidget(field)
    field.show()
    return field


def replace(field, text):
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def test_a_number_is_handed_over_once(qtbot, field):
    taken = []
    field.entered.connect(taken.append)
    replace(field, "2/8")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert taken == [Fraction(1, 4)]
    assert field.text() == "0.25"


def test_a_number_from_elsewhere_is_shown_and_not_handed_over(field):
    taken = []
    field.entered.connect(taken.append)
    field.set_number(Fraction(3, 7))
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert taken == []
    assert field.text() == "3/7"


def test_a_check_can_refuse(qtbot):
    def check(number):
        if number < 0:
            raise ParameterError("width must not be negative.")

    field = NumberField("width", check)
    qtbot.addWidget(field)
    replace(field, "-1")
    assert field.fault == "width must not be negative."
    assert field.number == 0
    field.grab()  # the frame around it is drawn
    replace(field, "1")
    assert field.fault == ""
    assert field.number == 1


def test_typing_takes_the_frame_away(field):
    replace(field, "abc")
    assert field.fault
    QTest.keyClick(field, Qt.Key.Key_Backspace)
    assert not field.fault


def test_names_reach_a_screen_reader(field):
    field.set_explanation("how wide it is")
    assert field.accessibleName() == "width"
    assert field.accessibleDescription() == "how wide it is"
    replace(field, "abc")
    assert "width must be a number" in field.accessibleDescription()
