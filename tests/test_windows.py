"""Windows of long arrays."""

import numpy as np
import pytest

from core.windows import maxima_between, product, running_max, scattered, windows_of


@pytest.mark.parametrize("count", [1, 7, 5000])
def test_products_are_those_of_each_window(count):
    rng = np.random.default_rng(count)
    coordinates, table = rng.normal(size=(2, count + 4)), rng.normal(size=(5, 40))
    windows = windows_of(coordinates, 5, count)
    assert not windows.flags.writeable
    expected = [[row[k : k + 5] @ table for k in range(count)] for row in coordinates]
    np.testing.assert_allclose(product(windows, table), expected, atol=1e-12)
    whole = np.zeros((2, count * 40 + 1))
    product(windows, table, whole[:, :-1].reshape(2, count, 40))
    np.testing.assert_allclose(whole[:, :-1].reshape(2, count, 40), expected, atol=1e-12)
    assert (whole[:, -1] == 0).all()


@pytest.mark.parametrize("count", [0, 1, 500])
def test_scattered_entries_are_those_of_the_product(count):
    rng = np.random.default_rng(count)
    coordinates, table = rng.normal(size=(2, 30)), rng.normal(size=(5, 40))
    windows = windows_of(coordinates, 5, 26)
    places, columns = rng.integers(0, 26, count), rng.integers(0, 40, count)
    expected = product(windows, table)[:, places, columns]
    np.testing.assert_allclose(scattered(windows, table, places, columns), expected, atol=1e-12)


@pytest.mark.parametrize("size", [1, 2, 3, 8, 13])
def test_the_running_maximum_is_that_of_each_window(size):
    values = np.random.default_rng(size).normal(size=(2, 30))
    expected = [[max(row[k : k + size]) for k in range(31 - size)] for row in values]
    np.testing.assert_array_equal(running_max(values, size), expected)


def test_maxima_between_are_those_of_each_run():
    rng = np.random.default_rng(4)
    values = rng.normal(size=(2, 60))
    first = rng.integers(0, 60, 300)
    last = np.minimum(first + rng.integers(0, 6, 300), 59)
    last[::50] = 59
    expected = [
        [max(row[begin : end + 1]) for begin, end in zip(first, last, strict=True)]
        for row in values
    ]
    np.testing.assert_array_equal(maxima_between(values, first, last), expected)
