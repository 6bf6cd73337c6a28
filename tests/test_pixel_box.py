"""Boxes hold what they are made of, and meet what is near."""

import numpy as np
import pytest

from app.pixel_box import MOST_PARTS, apart, around, meeting


def test_a_box_is_around_all_with_a_margin():
    places = np.array([(0.0, 5.0), (10.0, 9.0), (60.0, -2.0)])
    assert around(places, 3.0) == (-3.0, -5.0, 63.0, 12.0)
    left, top, right, bottom = around(np.zeros((0, 2)), 3.0)
    assert left > right
    assert top > bottom


def test_places_meet_a_box_within_a_reach():
    places = np.array([(10.0, 0.0), (50.0, 50.0), (15.0, 11.5)])
    assert meeting(places, (12.0, 0.0, 20.0, 9.0), 3.0).tolist() == [True, False, True]
    assert meeting(places, (12.0, 0.0, 20.0, 9.0), 1.0).tolist() == [False, False, False]


@pytest.mark.parametrize("beside", [0, 2])
def test_places_of_several_rows_are_held_in_a_few_boxes_with_those_beside_them(beside):
    rng = np.random.default_rng(0)
    rows = tuple(rng.uniform(0, 900, (2, 400, 2)))
    for count in (1, 2, 30, 400):
        chosen = np.sort(rng.choice(400, count, replace=False))
        found = np.array(apart(rows, chosen, beside, 2.0))
        assert 1 <= len(found) <= MOST_PARTS
        held = (chosen[:, None] + np.arange(-beside, beside + 1)).clip(0, 399).ravel()
        for row in rows:
            for place in row[held]:
                inside = (found[:, :2] <= place - 2) & (found[:, 2:] >= place + 2)
                assert inside.all(axis=1).any()
    assert apart(rows, np.zeros(0, dtype=int), beside, 2.0) == []


def test_places_far_apart_in_the_row_are_in_boxes_of_their_own():
    row = np.stack([np.arange(100.0), np.zeros(100)], axis=-1)
    assert apart((row,), np.array([3, 4, 60]), 1, 0.5) == [
        (1.5, -0.5, 5.5, 0.5), (58.5, -0.5, 61.5, 0.5)
    ]  # fmt: skip
