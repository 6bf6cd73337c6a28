"""Entries of long rows, taken without checks and without copies of all."""

import tracemalloc

import numpy as np

from core.vectors import gathered, taken


def test_gathered_are_the_entries_of_each_row_and_beyond_the_end_the_last():
    rows = np.random.default_rng(2).normal(size=(2, 90))[:, 20:50]
    indices = np.array([[0, 7, 29], [30, 44, 7]])
    np.testing.assert_array_equal(gathered(rows, indices), rows[:, np.minimum(indices, 29)])
    np.testing.assert_array_equal(taken(rows[0], indices[0]), rows[0, indices[0]])


def test_rows_that_lie_apart_are_not_copied():
    rows, indices = np.zeros((2, 200_000))[:, 8:-8], np.arange(16)
    tracemalloc.start()
    gathered(rows, indices)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 20_000
