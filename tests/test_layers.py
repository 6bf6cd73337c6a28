import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.formats.layers import ALL, MAX_LENGTH, layer_names


@given(st.lists(st.text(max_size=40), max_size=30))
def test_names_are_ascii_short_and_different(names):
    found = layer_names(names, len(names))
    assert len(found) == len(set(found)) == len(names)
    for name in found:
        assert re.fullmatch("[A-Z0-9_-]+", name)
        assert len(name) <= MAX_LENGTH
        assert name not in {"0", "DEFPOINTS"}


@pytest.mark.parametrize(
    ("name", "layer"),
    [
        ("Letter F", "LETTER_F"),
        ("Flügel über", "FLUGEL_UBER"),
        ("翼", "CURVE"),
        ("", "CURVE"),
        ("0", "CURVE_0"),
        ("Defpoints", "CURVE_DEFPOINTS"),
        ("a/b:c*d", "A_B_C_D"),
        ("x" * 40, "X" * MAX_LENGTH),
    ],
)
def test_a_name_keeps_its_letters(name, layer):
    assert layer_names([name], 1) == [layer]


def test_equal_names_are_counted_also_where_they_are_cut():
    assert layer_names(["a", "A", "a", "a_2"], 4) == ["A", "A_2", "A_3", "A_2_2"]
    long = layer_names(["y" * 40] * 3, 3)
    assert long == ["Y" * 31, "Y" * 29 + "_2", "Y" * 29 + "_3"]


def test_one_layer_for_all():
    assert layer_names(None, 3) == [ALL] * 3


def test_many_equal_names_take_no_time_for_each_other():
    assert len(set(layer_names(["curve"] * 20_000, 20_000))) == 20_000
