from fractions import Fraction

import pytest

from app.import_way import FIRST_TOLERANCE, Way
from app.settings import Settings


@pytest.mark.parametrize("is_fit", [True, False])
@pytest.mark.parametrize("tolerance", [Fraction(1, 100), Fraction(1, 3), Fraction(254, 10)])
def test_a_way_is_remembered(is_fit, tolerance):
    settings = Settings()
    settings.import_way = Way(is_fit, tolerance).text
    assert Way.read(settings.import_way) == Way(is_fit, tolerance)


@pytest.mark.parametrize("text", ["", "fit", "fit x", "fit 0", "fit -1", "bend 0.1", "0.1"])
def test_nonsense_counts_as_absent(text):
    assert Way.read(text) == Way(True, FIRST_TOLERANCE)
