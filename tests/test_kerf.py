"""Offsets by the radius of a tool, against distances measured from dense points."""

import builtins
import math
import shlex
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.formats.kerf import offset
from drawings import F_POINTS

TOLERANCE = 0.005
SQUARE = np.array([(0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (0.0, 20.0)])
HOLE = np.array([(10.0, 5.0), (20.0, 5.0), (20.0, 15.0), (10.0, 15.0)])


def moved(x, y):
    return np.add(SQUARE, [x, y])


def circle(radius, centre=(0.0, 0.0), count=400):
    turn = 2 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(turn), np.sin(turn)], axis=1) + centre


def along(points, step):
    """Dense points of a closed polygon."""
    parts = []
    for start, end in zip(points, np.roll(points, -1, axis=0), strict=True):
        count = max(math.ceil(math.dist(start, end) / step), 1)
        parts.append(start + np.arange(count)[:, None] / count * (end - start))
    return np.concatenate(parts)


def away(places, polygons):
    """Distance of each place from the nearest of some polygons."""
    least = np.full(len(places), np.inf)
    for polygon in polygons:
        for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
            way = end - start
            share = np.clip((places - start) @ way / (way @ way), 0, 1)
            least = np.minimum(least, np.hypot(*(places - start - share[:, None] * way).T))
    return least


def doubled_area(points):
    x, y = np.transpose(points)
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def box(ring):
    return [*ring.points.min(axis=0), *ring.points.max(axis=0)]


@pytest.mark.parametrize("kerf", [0.05, 0.1, 1.0, 25.0, -0.05, -0.1, -1.0, -9.5])
@pytest.mark.parametrize("turned", [False, True])
def test_a_circle_has_another_radius(kerf, turned):
    polygon = circle(10.0, (100.0, -50.0))[:: -1 if turned else 1]
    found = offset([polygon], kerf, TOLERANCE)
    (ring,) = found.rings
    bound = found.deviation + 10 * (1 - math.cos(math.pi / 400))
    assert found.deviation <= TOLERANCE
    radii = np.hypot(*(along(ring.points, 0.01) - (100.0, -50.0)).T)
    assert np.abs(radii - 10 - kerf).max() <= bound
    assert (doubled_area(ring.points) > 0) == (not turned)
    assert (found.gone, found.crossing, len(found.rounded)) == ((), (), 0)


def test_a_hole_shrinks_as_its_plate_grows_and_the_other_way_round():
    plate, hole = offset([SQUARE, HOLE], 2.0, TOLERANCE).rings
    assert box(plate) == pytest.approx([-2, -2, 32, 22], abs=TOLERANCE)
    assert box(hole) == pytest.approx([12, 7, 18, 13], abs=TOLERANCE)
    plate, hole = offset([SQUARE, HOLE], -2.0, TOLERANCE).rings
    assert box(plate) == pytest.approx([2, 2, 28, 18], abs=TOLERANCE)
    assert box(hole) == pytest.approx([8, 3, 22, 17], abs=TOLERANCE)


def test_an_island_in_a_hole_grows_as_its_plate_does():
    found = offset([circle(2.0), circle(20.0), circle(10.0)], 1.0, TOLERANCE)
    assert [ring.sources for ring in found.rings] == [(0,), (1,), (2,)]
    widths = [float(np.ptp(ring.points[:, 0])) for ring in found.rings]
    assert widths == pytest.approx([6, 42, 18], abs=2 * TOLERANCE)


def test_direction_and_start_are_those_of_the_polygon():
    for polygons in ([SQUARE, HOLE], [SQUARE[::-1], HOLE], [SQUARE, HOLE[::-1]]):
        for kerf in (1.0, -1.0):
            for polygon, ring in zip(polygons, offset(polygons, kerf, 0.01).rings, strict=True):
                assert (doubled_area(ring.points) > 0) == (doubled_area(polygon) > 0)
                assert math.dist(ring.points[0], polygon[0]) < 2


def test_the_letter_f_is_neither_mirrored_nor_moved():
    letter = np.array(F_POINTS, dtype=float)
    for kerf in (1.0, -1.0):
        (ring,) = offset([letter], kerf, TOLERANCE).rings
        assert box(ring) == pytest.approx([-kerf, -kerf, 30 + kerf, 50 + kerf], abs=TOLERANCE)
        # The middle bar is shorter than the upper one, and the foot is at the left.
        at_bar = ring.points[np.abs(ring.points[:, 1] - 24) < 6]
        assert at_bar[:, 0].max() == pytest.approx(24 + kerf, abs=TOLERANCE)
        at_foot = ring.points[ring.points[:, 1] < 10]
        assert at_foot[:, 0].max() == pytest.approx(8 + kerf, abs=TOLERANCE)


def test_a_figure_of_eight_has_two_halves():
    eight = np.array([(0.0, 0.0), (20.0, 20.0), (20.0, 0.0), (0.0, 20.0)])
    (whole,) = offset([eight], 1.0, TOLERANCE).rings
    assert box(whole) == pytest.approx([-1, -1, 21, 21], abs=TOLERANCE)
    halves = offset([eight], -1.0, TOLERANCE).rings
    assert [ring.sources for ring in halves] == [(0,), (0,)]


def test_a_slot_as_wide_as_the_tool_is_told():
    slot = np.array([(0, 0), (10, 0), (10, 10), (6, 10), (6, 2), (4, 2), (4, 10), (0, 10)], float)
    fits = offset([slot], 0.9, TOLERANCE)
    assert len(fits.rounded) == 2  # two sharp inner corners: no tool gets into these
    closed = offset([slot], 1.2, TOLERANCE)
    (place,) = closed.rounded
    assert 4 - 0.02 <= place[0] <= 6 + 0.02
    assert 2 - 0.02 <= place[1] <= 10 + 0.02
    smooth = offset([circle(3.0)], -1.0, TOLERANCE)
    assert len(smooth.rounded) == 0


def test_what_vanishes_is_named_and_nothing_at_all_is_refused():
    found = offset([SQUARE, circle(1.0, (15.0, 10.0))], 1.5, TOLERANCE)
    assert [ring.sources for ring in found.rings] == [(0,)]
    assert found.gone == (1,)
    with pytest.raises(NinepointError, match="With a kerf of -11 mm nothing is left"):
        offset([SQUARE], -11.0, TOLERANCE)


def test_neighbours_become_one_and_crossing_ones_are_told():
    found = offset([SQUARE, moved(33.0, 0.0)], 2.0, TOLERANCE)
    (ring,) = found.rings
    assert set(ring.sources) == {0, 1}
    assert found.crossing == ()
    found = offset([SQUARE, moved(50.0, 0.0), moved(10.0, 10.0)], 0.5, TOLERANCE)
    assert found.crossing == ((0, 2),)


@pytest.mark.parametrize(
    "polygons",
    [[SQUARE, SQUARE], [SQUARE, SQUARE[::-1]], [SQUARE, moved(30.0, 5.0)], [SQUARE[[0, 1]]]],
)
def test_curves_that_lie_on_each_other_are_refused(polygons):
    with pytest.raises(NinepointError, match="Curves lie on each other for "):
        offset(polygons, 1.0, TOLERANCE)


def test_large_drawings_are_refused_where_the_grid_ends():
    far = offset([SQUARE + 1e6], 1.0, TOLERANCE)
    assert box(far.rings[0]) == pytest.approx(
        [1e6 - 1, 1e6 - 1, 1e6 + 31, 1e6 + 21], abs=TOLERANCE
    )
    with pytest.raises(NinepointError, match="cannot be offset within 1e-06 mm"):
        offset([SQUARE * 1e8], 1.0, 1e-6)


def test_many_circles_take_a_moment():
    polygons = [circle(1.0, (3.0 * (k % 20), 3.0 * (k // 20)), 60) for k in range(400)]
    for kerf in (0.2, -0.2):
        found = offset(polygons, kerf, TOLERANCE)
        assert [ring.sources for ring in found.rings] == [(k,) for k in range(400)]


def test_what_a_hardly_fitting_tool_leaves_of_a_slot_is_dropped():
    turn = np.linspace(0, np.pi, 200)
    bend = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    slot = np.concatenate([30 * bend, 26 * bend[::-1]])  # 4 mm wide, as near as chords come
    for kerf, kept in ((2.0, False), (-2.0, False), (-1.99, True)):
        polygons = [slot, circle(40.0)] if kerf > 0 else [slot]
        try:
            found = offset(polygons, kerf, TOLERANCE)
        except NinepointError:
            assert not kept
            continue
        assert found.deviation <= TOLERANCE
        assert any(0 in ring.sources for ring in found.rings) == kept
        assert (0 in found.gone) != kept


stars = st.builds(
    lambda radii, start: np.array(
        [
            (r * math.cos(start + 2 * math.pi * k / len(radii)),
             r * math.sin(start + 2 * math.pi * k / len(radii)))
            for k, r in enumerate(radii)
        ]
    ),
    st.lists(st.floats(3, 20), min_size=3, max_size=12),
    st.floats(0, 6),
)  # fmt: skip
tangles = st.lists(
    st.tuples(st.integers(-10, 10), st.integers(-10, 10)), min_size=4, max_size=9, unique=True
).map(lambda corners: np.array(corners, dtype=float) + np.sin(np.array(corners) @ (3, 5))[:, None])
kerfs = st.sampled_from([0.1, 0.5, 2.0, -0.1, -0.5, -2.0])


@given(st.one_of(stars, tangles), kerfs)
def test_every_point_of_an_offset_keeps_its_distance(polygon, kerf):
    try:
        found = offset([polygon], kerf, TOLERANCE)
    except NinepointError as error:
        if "nothing is left" not in str(error) and "lie on each other" not in str(error):
            raise
        return
    assert found.deviation <= TOLERANCE
    for ring in found.rings:
        places = along(ring.points, 0.05)
        assert np.abs(away(places, [polygon]) - abs(kerf)).max() <= found.deviation


@given(stars, kerfs)
def test_all_that_is_near_enough_is_enclosed_and_nothing_else(polygon, kerf):
    try:
        rings = offset([polygon], kerf, TOLERANCE).rings
    except NinepointError:
        rings = ()
    places = np.random.default_rng(7).uniform(-24, 24, (500, 2))
    distance = away(places, [polygon])
    signed = np.where(inside(places, [polygon]), -distance, distance)
    plain = np.abs(signed - kerf) > TOLERANCE
    found = inside(places, [ring.points for ring in rings])
    np.testing.assert_array_equal(found[plain], (signed < kerf)[plain])


def inside(places, polygons):
    """Even-odd rule, ray by ray."""
    count = np.zeros(len(places), dtype=int)
    for polygon in polygons:
        for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
            across = (y0 > places[:, 1]) != (y1 > places[:, 1])
            with np.errstate(divide="ignore", invalid="ignore"):
                x = x0 + (places[:, 1] - y0) / (y1 - y0) * (x1 - x0)
            count += across & (x > places[:, 0])
    return count % 2 == 1


def test_without_pyclipr_the_sentence_tells_the_command(monkeypatch):
    real = builtins.__import__

    def lacking(name, *args, **kwargs):
        if name == "pyclipr":
            raise ImportError(name)
        return real(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", lacking)
    with pytest.raises(NinepointError) as caught:
        offset([SQUARE], 1.0, TOLERANCE)
    assert str(caught.value).endswith(f"{shlex.quote(sys.executable)} -m pip install pyclipr")
