"""Boxes hold what they are made of, and meet what is near."""

import numpy as np

from app.pixel_box import around, gathered, meeting


def test_a_box_is_around_all_with_a_margin():
    boxes = np.array([(0.0, 5.0, 10.0, 9.0), (50.0, -2.0, 60.0, 8.0)]).T
    assert around(boxes, 3.0) == (-3.0, -5.0, 63.0, 12.0)
    left, top, right, bottom = around(np.zeros((4, 0)), 3.0)
    assert left > right
    assert top > bottom


def test_boxes_meet_a_region_with_their_margin():
    boxes = np.array([(0.0, 0.0, 10.0, 10.0), (50.0, 50.0, 60.0, 60.0)]).T
    assert meeting(boxes, np.array([(12.0, 0.0, 20.0, 9.0)]), 3.0).tolist() == [True, False]
    assert meeting(boxes, np.array([(12.0, 0.0, 20.0, 9.0)]), 1.0).tolist() == [False, False]


def test_many_boxes_are_gathered_in_a_few():
    low = np.stack([np.arange(100.0), np.arange(100.0)])
    found = np.array(gathered(np.concatenate([low, low + 1]), 2.0))
    assert len(found) <= 8
    for corner in low.T:
        assert ((found[:, :2] <= corner - 2) & (found[:, 2:] >= corner + 3)).all(axis=1).any()
    assert gathered(np.zeros((4, 0)), 2.0) == []
