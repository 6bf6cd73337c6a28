"""Distances from curves and what contours enclose, against plain loops."""

import math

import numpy as np
import pytest

from core.family import PRESETS
from core.formats.verify_kerf import dense, distances, enclosed, keeps_distance
from core.limit import LimitCurve

MASK = PRESETS["Calm"].mask
SQUARE = [(0, 0), (40, 0), (40, 30), (0, 30)]


def circle(radius, centre, count):
    turn = 2 * np.pi * (np.arange(count + 1) % count) / count
    return radius * np.stack([np.cos(turn), np.sin(turn)], axis=1) + centre


def test_distances_are_those_of_a_loop_over_all_segments():
    rng = np.random.default_rng(5)
    starts = rng.uniform(0, 10, (101, 2))
    ways = rng.uniform(-1, 1, (101, 2))
    ways[7] = 0
    places = rng.uniform(-2, 12, (60, 2))
    found = distances(places, starts, ways, 1.5)
    for place, distance in zip(places, found, strict=True):
        each = []
        for start, way in zip(starts, ways, strict=True):
            share = np.clip((place - start) @ way / (way @ way or 1), 0, 1)
            each.append(math.dist(place, start + share * way))
        assert distance == pytest.approx(min(each) if min(each) <= 1.5 else math.inf)


def test_enclosed_is_the_even_odd_rule():
    lines = [circle(10, (0, 0), 60), circle(5, (0, 0), 60)[::-1], circle(2, (0, 0), 60)]
    starts = np.concatenate([line[:-1] for line in lines])
    ways = np.concatenate([np.diff(line, axis=0) for line in lines])
    radii = np.array([1, 3, 7, 11])
    for turn in (0.3, 2.0, 4.0):
        places = radii[:, None] * [math.cos(turn), math.sin(turn)]
        assert enclosed(places, starts, ways).tolist() == [True, False, True, False]


@pytest.mark.parametrize("closed", [True, False])
def test_a_dense_polygon_leaves_its_curve_by_no_more_than_it_says(closed):
    limit = LimitCurve(SQUARE, MASK, closed)
    points, slack = dense(limit, 64)
    assert len(points) <= 65
    assert (points[0] == points[-1]).all() == closed
    finer, _ = dense(limit, 4096)
    away = distances(finer, points[:-1], np.diff(points, axis=0), 10.0)
    assert away.max() <= slack + 1e-12


def test_only_an_offset_by_the_kerf_keeps_its_distance():
    # A curve of the family near a circle, offset by a plain one.
    turn = 2 * np.pi * np.arange(40) / 40
    ring = LimitCurve(20 * np.stack([np.cos(turn), np.sin(turn)], axis=1), MASK, True)
    radius = float(np.hypot(*ring.points(4).T).mean())
    off = float(np.abs(np.hypot(*ring.points(6).T) - radius).max()) + 0.01
    grown, shrunk = (circle(radius + kerf, (0, 0), 400) for kerf in (2.0, -2.0))
    assert keeps_distance([ring], [grown], 2.0, off)
    assert keeps_distance([ring], [shrunk], -2.0, off)
    assert not keeps_distance([ring], [grown], 2.1, off)
    assert not keeps_distance([ring], [shrunk], 2.0, off)  # the wrong side
    assert not keeps_distance([ring], [grown, shrunk], 2.0, off)  # one too many
    assert not keeps_distance([ring], [grown + 0.05], 2.0, off)
    small = LimitCurve(5 * np.stack([np.cos(turn), np.sin(turn)], axis=1), MASK, True)
    assert not keeps_distance([ring, small], [grown], 2.0, off)  # the hole is missing
