"""Vertices are put between others, and runs stay runs."""

import numpy as np
import pytest

from app.splice import Inset
from core.runs import Runs


def line(*parts):
    """Runs whose vertices lie at (t, 0)."""
    t = np.concatenate([np.asarray(part, dtype=float) for part in parts])
    starts = np.concatenate([[0], np.cumsum([len(part) for part in parts])])
    return Runs(np.stack([t, np.zeros(len(t))], axis=-1), t, starts, 0.0)


def put(runs, *t):
    t = np.array(t, dtype=float)
    return Inset(runs).filled([(t, np.stack([t, np.ones(len(t))], axis=-1))])


def parts(runs):
    return [run[:, 0].tolist() for run in runs.runs()]


@pytest.mark.parametrize(
    ("before", "new", "after"),
    [
        ([[0, 9]], [3, 4, 5], [[0, 3, 4, 5, 9]]),
        ([[0, 2, 4, 6]], [2, 3, 4], [[0, 2, 3, 4, 6]]),
        ([[0, 1], [8, 9]], [3, 4], [[0, 1], [3, 4], [8, 9]]),
        ([[0, 3], [6, 9]], [2, 4], [[0, 2, 4], [6, 9]]),
        ([[0, 3], [6, 9]], [5, 7], [[0, 3], [5, 7, 9]]),
        ([[0, 3], [6, 9]], [2, 7], [[0, 2, 7, 9]]),
        ([[0, 3], [4, 5], [6, 9]], [2, 7], [[0, 2, 7, 9]]),
        ([[0, 3], [6, 9]], [3, 6], [[0, 3, 6, 9]]),
        ([[0, 3]], [0, 1], [[0, 1, 3]]),
        ([[0, 3]], [2, 3], [[0, 2, 3]]),
        ([[5, 8]], [0, 2], [[0, 2], [5, 8]]),
        ([[5, 8]], [9, 10], [[5, 8], [9, 10]]),
        ([[5, 8]], [4, 9], [[4, 9]]),
    ],
)
def test_new_vertices_go_between_those_before_and_behind(before, new, after):
    found = put(line(*before), *new)
    assert parts(found) == after
    assert found.parameters.tolist() == found.vertices[:, 0].tolist()


def test_nothing_at_all_becomes_one_run():
    nothing = Runs(np.zeros((0, 2)), np.zeros(0), np.zeros(1, dtype=np.intp), 0.0)
    assert parts(put(nothing, 1, 2, 3)) == [[1, 2, 3]]
