"""Signs of points: only those that differ are told, each by its index."""

import numpy as np

from app.signs import Dots, Handles

PLACES = np.random.default_rng(0).uniform(20, 220, (60, 2))
INK = "#123456"


def handles(names, places=PLACES, rim=INK):
    names = np.asarray(names)
    return Handles(names, places[names], rim, "#ffffff", 3.5, 1.0)


def holds(boxes, place):
    return any(a < place[0] < c and b < place[1] < d for a, b, c, d in boxes)


def test_a_point_that_comes_or_goes_is_the_only_difference():
    fewer = [name for name in range(60) if name != 17]
    for one, other in ((fewer, range(60)), (range(60), fewer)):
        (box,) = handles(one).unlike(handles(other))
        assert holds([box], PLACES[17])
        assert box[2] - box[0] < 20


def test_a_point_that_moves_is_told_where_it_was_and_where_it_is():
    moved = PLACES.copy()
    moved[5] += (90.0, 40.0)
    for kept in (range(60), range(1, 60)):
        boxes = handles(range(60)).unlike(handles(kept, moved))
        assert holds(boxes, PLACES[5])
        assert holds(boxes, moved[5])
        assert len(boxes) <= 2 + (len(kept) < 60)


def test_points_of_another_look_all_differ():
    boxes = handles(range(60)).unlike(handles(range(60), rim="#ff0000"))
    assert all(holds(boxes, place) for place in PLACES)
    dots = Dots(np.arange(60), PLACES, INK)
    assert handles(range(60)).unlike(dots) == [handles(range(60)).box, dots.box]
    assert dots.unlike(Dots(np.arange(60), PLACES.copy(), INK)) == []
