import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.formats.decimals import LARGEST, most_places, rounded, text, word

numbers = st.integers(-LARGEST, LARGEST) | st.integers(-100_000, 100_000)


def plain(number, places, least=0):
    """The decimal number of an integer scaled by ``10^places``, by its digits."""
    whole, part = divmod(abs(number), 10**places)
    digits = f"{part:0{places}d}".rstrip("0") if places else ""
    digits = digits or "0" * (least if places else 0)
    return "-" * (number < 0) + str(whole) + ("." + digits if digits else "")


@given(st.lists(numbers, min_size=1, max_size=20), st.integers(0, 12), st.sampled_from([0, 1]))
def test_each_number_is_written_as_its_digits(scaled, places, least):
    values = np.array(scaled) / 10.0**places
    found = text((b"<", b">"), values[:, None], (places,), least).decode()
    assert found == "".join(f"<{plain(number, places, least)}>" for number in scaled)


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=9), st.integers(0, 9))
def test_columns_have_decimals_of_their_own(pairs, places):
    values = np.array(pairs) / (1.0, 10.0**places)
    found = text((b"", b" ", b"\n"), values, (0, places)).decode()
    assert found == "".join(f"{a} {plain(b, places)}\n" for a, b in pairs)


def test_blocks_of_rows_join_without_a_seam():
    values = np.arange(70_000)[:, None] / 10
    found = text((b"", b" "), values, (1,)).split()
    assert [float(number) for number in found] == values.ravel().tolist()


def test_no_rows_give_no_text():
    assert text((b"a", b"b"), np.zeros((0, 1)), (3,)) == b""


def test_there_is_no_minus_zero():
    assert text((b"", b" ", b""), np.array([[-0.0, -0.0001]]), (2, 2)) == b"0 0"
    assert str(rounded(np.array([-1e-9]), 3)[0]) == "0.0"


@given(st.floats(-1e6, 1e6), st.integers(0, 9))
def test_a_text_reads_back_as_the_rounded_number_in_every_bit(value, places):
    number = float(rounded(np.array([value]), places)[0])
    assert float(word(number, places)) == number
    assert abs(number - value) <= 0.5000001 * 10.0**-places + 1e-9


@given(st.floats(1e-3, 1e9))
def test_as_many_places_as_the_digits_of_a_float_allow(largest):
    places = most_places(largest)
    assert max(largest, 1) * 10.0**places <= LARGEST * (1 + 1e-12)
    assert max(largest, 1) * 10.0 ** (places + 1) > LARGEST * (1 - 1e-12)


@pytest.mark.parametrize(
    ("value", "places", "found"), [(12, 4, "12"), (0.5, 1, "0.5"), (7.0, 0, "7")]
)
def test_a_word_is_short(value, places, found):
    assert word(value, places) == found
