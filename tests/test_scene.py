"""What is drawn is the curve, to a quarter of a pixel, and is computed only when needed."""

import numpy as np
import pytest

from app.camera import Camera
from app.ribbons import FAINT, Influence
from app.scene import NOTHING, Overlay, Scene
from app.style import SIZES
from core.document import Curve, Document
from core.family import PRESETS, Parameters
from core.view import BUDGET
from mouse import BOAT, boat, by

CAMERA = Camera(60, 30, 5.0, 900, 600)


def drawn(document, camera=CAMERA, origin=None, overlay=NOTHING, scene=None):
    scene = Scene() if scene is None else scene
    scene.update(document, document if origin is None else origin, camera, 1.0, overlay)
    return scene


def following(*weights):
    return Overlay(influences=(Influence(0, np.arange(len(weights)), np.array(weights)),))


def away(polyline, places):
    """Distance of each place from a polyline: a slow oracle."""
    start, way = polyline[:-1], np.diff(polyline, axis=0)
    length = np.maximum((way**2).sum(axis=1), 1e-300)
    share = np.clip((way * (places[:, None] - start)).sum(axis=2) / length, 0, 1)
    feet = start + share[..., None] * way
    return np.hypot(*(feet - places[:, None]).transpose(2, 0, 1)).min(axis=1)


@pytest.mark.parametrize("member", PRESETS)
@pytest.mark.parametrize("scale", [0.1, 5.0, 200.0])
@pytest.mark.parametrize("closed", [True, False])
def test_the_drawn_curve_is_the_curve_to_a_quarter_pixel(member, scale, closed):
    document = Document((Curve(BOAT, closed),), PRESETS[member])
    middle = document.curves[0].limit(document.parameters).at(5.2)
    camera = Camera(*middle, scale, 900, 600)
    outlines = list(drawn(document, camera).curves[0].outline_line.pieces())
    exact = camera.to_pixels(document.curves[0].limit(document.parameters).points(10))
    seen = ((exact >= 0) & (exact <= (900, 600))).all(axis=1)
    assert seen.sum() > 10
    found = [away(outline, exact[seen]) for outline in outlines]
    assert np.min(found, axis=0).max() <= 0.25


def test_what_is_out_of_view_costs_little():
    near = drawn(boat(), Camera(60, 30, 500.0, 900, 600)).curves[0]
    assert len(near.vertices_px) <= BUDGET
    elsewhere = drawn(boat(), Camera(1e6, 0, 500.0, 900, 600)).curves[0]
    assert len(elsewhere.vertices_px) == 0


def test_curves_that_did_not_change_are_drawn_again_as_they_are():
    document = Document((Curve(BOAT), Curve([(0, 0), (5, 0), (5, 5)])))
    scene = drawn(document)
    first, second = scene.curves
    changed = document.with_curve(0, document.curves[0].moved([2], (100, 0)))
    drawn(changed, scene=scene)
    assert scene.curves[0] is not first
    assert scene.curves[1] is second


def test_a_move_of_the_view_keeps_the_limit_curve():
    scene = drawn(boat())
    document = Document((Curve(BOAT),))
    scene = drawn(document)
    limit = scene.curves[0].limit
    drawn(document, CAMERA.moved(10, 0), scene=scene)
    assert scene.curves[0].limit is limit
    assert scene.curves[0].points_px[0, 0] == pytest.approx(CAMERA.to_pixels(BOAT[0])[0] + 10)


@pytest.mark.parametrize("member", ["Calm", "Tight"])
@pytest.mark.parametrize("count", [12, 120, 2000])
@pytest.mark.parametrize("offset", [0.0, 1e7])
def test_a_pushed_paper_shows_the_curve_to_a_quarter_pixel(member, count, offset):
    """By steps of a hand, and by leaps that nothing found before covers; at rest and zoomed in."""
    rng = np.random.default_rng(count)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    flower = (100 + 10 * np.sin(9 * angle))[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
    curve = Curve(flower + offset)
    document = Document((curve,), PRESETS[member])
    exact_mm = curve.limit(document.parameters).points(12 if count == 12 else 7)
    for scale in (2.5, 40.0):
        camera = Camera(*(exact_mm[0] - 50 / scale), scale, 900, 600)
        scene, kept = drawn(document, camera), 0
        for step in range(24):
            before = scene.curves[0]
            size = 700 if step % 12 == 11 else 15
            camera = camera.moved(*rng.uniform(-size, size, 2))
            (now,) = drawn(document, camera, scene=scene).curves
            kept += now.parameters is before.parameters
            for places_mm, line in (
                (exact_mm, now.outline_line), (curve.points, now.polygon_line)
            ):  # fmt: skip
                places = camera.to_pixels(places_mm)
                seen = places[((places >= 0) & (places <= (900, 600))).all(axis=1)]
                if len(seen):
                    some = rng.choice(seen, 60)
                    found = [away(piece, some) for piece in line.pieces()]
                    assert np.min(found, axis=0).max() <= 0.25
            np.testing.assert_array_equal(now.shown, drawn(document, camera).curves[0].shown)
        assert kept >= 8


def test_a_pushed_paper_is_looked_at_anew_for_another_curve_scheme_or_scale():
    scene = drawn(boat())
    document = Document((Curve(BOAT),))
    drawn(document, scene=scene)
    for change in (
        lambda: (document, CAMERA.zoomed(1.5)),
        lambda: (document.with_parameters(PRESETS["Tight"]), CAMERA.moved(3, 0)),
        lambda: (document.with_curve(0, Curve(1.1 * np.array(BOAT))), CAMERA.moved(3, 0)),
    ):
        drawn(document, CAMERA, scene=scene)
        drawn(document, CAMERA.moved(5, 5), scene=scene)
        other, camera = change()
        now = drawn(other, camera, scene=scene).curves[0]
        fresh = drawn(other, camera).curves[0]
        np.testing.assert_array_equal(now.vertices_px, fresh.vertices_px)


def test_the_ghost_is_the_part_of_the_old_shape_that_changed():
    count = 60
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    circle = Curve(50 * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    origin = Document((circle,))
    now = origin.with_curve(0, circle.moved([30], (-70, 0)))
    camera = Camera(0, 0, 5.0, 900, 600)
    scene = drawn(now, camera, origin)
    (ghost,) = scene.ghosts[0].pieces()
    exact = camera.to_pixels(circle.limit(origin.parameters).points(5))
    # The 7-point member reaches 13/2 spans, so the ghost runs from t = 23 to 37.
    assert away(ghost, exact[24 * 32 : 36 * 32]).max() < 0.3
    assert away(ghost, exact[: 20 * 32]).min() > 5
    assert drawn(now, camera, now).ghosts == {}


def test_the_ghost_of_other_parameters_is_the_whole_old_shape():
    origin = boat()
    scene = drawn(origin.with_parameters(PRESETS["Lagrange"]), CAMERA, origin)
    outline = drawn(origin).curves[0].outline_line
    for part, own in zip(scene.ghosts[0].pieces(), outline.pieces(), strict=True):
        np.testing.assert_array_equal(part, own)


def test_the_ribbon_is_as_broad_as_the_curve_follows_the_hand():
    document = boat()
    alone = Overlay(influences=(Influence(0, np.array([2]), np.ones(1)),))
    scene = drawn(document, overlay=alone)
    ribbon = np.concatenate([line.outline(0, 0.0) for line in scene.ribbons])
    curve = document.curves[0]
    moved = document.with_curve(0, curve.moved([2], curve.points[2] + by(0.0, 1.0)))
    parameters = document.parameters
    follows = (moved.curves[0].limit(parameters).at(2.0) - curve.limit(parameters).at(2.0))[1]
    place = CAMERA.to_pixels(curve.limit(parameters).at(2.0))
    nearest = np.hypot(*(ribbon - place).T).min()
    assert nearest == pytest.approx(SIZES.ribbon_width * follows, rel=0.02)


def test_all_weights_1_give_a_ribbon_of_full_breadth_all_around():
    scene = drawn(boat(), overlay=following(*np.ones(8)))
    (ribbon,) = scene.ribbons
    outline = np.concatenate(list(drawn(boat()).curves[0].outline_line.pieces()))
    sides = ribbon.outline(0, 0.0)
    assert away(outline, sides).min() == pytest.approx(SIZES.ribbon_width, abs=0.5)


def test_a_weak_influence_is_not_drawn():
    assert drawn(boat(), overlay=following(FAINT / 2, *np.zeros(7))).ribbons == ()


@pytest.mark.parametrize("count", [0, 1, 2])
@pytest.mark.parametrize("closed", [True, False])
def test_few_points(count, closed):
    curve = Curve(BOAT[:count], closed)
    scene = drawn(Document((curve,)), overlay=following(*np.ones(count)))
    assert len(scene.curves[0].points_px) == count
    if count == 2:
        (outline,) = scene.curves[0].outline_line.pieces()
        np.testing.assert_allclose(outline[[0, -1]], scene.curves[0].points_px)


@pytest.mark.parametrize("neighbours", ["translated", "mirrored"])
def test_absurd_parameters_stay_finite(neighbours):
    document = boat().with_parameters(Parameters(100, 100, 100, neighbours))
    scene = drawn(document, origin=boat(), overlay=following(*np.ones(8)))
    ribbons = [line.vertices for line in scene.ribbons]
    for part in (scene.curves[0].vertices_px, *ribbons, *scene.ghosts[0].pieces()):
        assert np.isfinite(part).all()
    assert len(scene.curves[0].vertices_px) <= BUDGET


def test_a_scheme_without_limit_has_points_but_no_curve(monkeypatch):
    from core.errors import NoLimitError

    def refuse(mask):
        raise NoLimitError("no limit")

    monkeypatch.setattr("app.figure.bounds", refuse)
    scene = drawn(boat())
    assert not scene.has_limit
    assert len(scene.curves[0].vertices_px) == 0
    assert len(scene.curves[0].points_px) == 8


def test_overlays_resemble_each_other_by_what_they_show():
    assert NOTHING.resembles(Overlay())
    assert not NOTHING.resembles(Overlay(preview=boat().curves[0]))
    assert not NOTHING.resembles(Overlay(rubber_band=(np.zeros(2), np.ones(2))))


def test_points_within_a_rectangle_drawn_in_any_direction():
    scene = drawn(boat())
    low, high = scene.curves[0].points_px[[0, 3]]
    expected = {
        (0, k)
        for k, place in enumerate(scene.curves[0].points_px)
        if (place >= np.minimum(low, high)).all() and (place <= np.maximum(low, high)).all()
    }
    assert len(expected) >= 2
    across = np.array([low[0], high[1]]), np.array([high[0], low[1]])
    for corner, opposite in ((low, high), (high, low), across, across[::-1]):
        assert scene.points_within(corner, opposite) == expected


@pytest.mark.parametrize("count", [0, 1, 2, 8, 5000])
def test_the_nearest_point_is_found_among_any_number(count):
    rng = np.random.default_rng(count)
    scene = drawn(Document((Curve(rng.uniform(0, 100, (count, 2))),)))
    for place in rng.uniform(0, 900, (20, 2)):
        distances = np.hypot(*(scene.curves[0].points_px - place).T)
        hit = scene.nearest_point(place, 10.0)
        if hit is None:
            assert not (distances <= 10.0).any()
        else:
            assert distances[hit.point] == distances.min()


def test_a_curve_that_follows_moves_is_drawn_as_if_built_anew():
    rng = np.random.default_rng(7)
    angle = np.linspace(0, 2 * np.pi, 20_000, endpoint=False)
    curve = Curve(40 * np.stack([np.cos(angle), np.sin(angle)], axis=-1) + (60, 30))
    origin = document = Document((curve,))
    scene = drawn(document)
    figure = scene.curves[0].figure
    for _ in range(20):
        indices = rng.integers(0, curve.count, 3)
        curve = curve.moved(indices, rng.uniform(0, 90, (3, 2)))
        document = Document((curve,), document.parameters)
        camera = CAMERA.moved(float(rng.uniform(-9, 9)), 0.0)
        drawn(document, camera, origin, scene=scene)
        (now,) = scene.curves
        assert now.figure is figure
        (anew,) = drawn(document, camera).curves
        # Which chords suffice can hang on a last bit; where both have a vertex, it is the same.
        assert np.isclose(len(now.parameters), len(anew.parameters), rtol=0.05)
        common = np.intersect1d(now.parameters, anew.parameters)
        assert len(common) > 0.9 * len(anew.parameters)
        one, other = (
            seen.vertices_px[np.searchsorted(seen.parameters, common)] for seen in (now, anew)
        )
        np.testing.assert_allclose(one, other, atol=1e-9)
        np.testing.assert_array_equal(now.limit.control_points, curve.points)
    drawn(origin, scene=scene)
    np.testing.assert_array_equal(scene.curves[0].vertices_px, drawn(origin).curves[0].vertices_px)


def test_a_long_curve_has_few_vertices_at_any_zoom():
    angle = np.linspace(0, 2 * np.pi, 100_000, endpoint=False)
    radius = 40 + np.sin(9 * angle)
    circle = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    document = Document((Curve(circle),))
    for scale in (0.1, 5.0, 500.0, 5e5):
        (seen,) = drawn(document, Camera(40, 0, scale, 900, 600)).curves
        assert len(seen.vertices_px) <= 2000
        assert sum(len(line) for line in seen.polygon_line.pieces()) <= 2000


def test_a_ghost_over_the_seam_is_one_line():
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    circle = Curve(50 * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    origin = Document((circle,))
    now = origin.with_curve(0, circle.moved([0], (70, 0)))
    (ghost,) = drawn(now, Camera(0, 0, 5.0, 900, 600), origin).ghosts[0].pieces()
    assert np.hypot(*np.diff(ghost, axis=0).T).max() < 50


def test_moves_drawn_by_splices_are_the_curve_to_a_quarter_pixel():
    rng = np.random.default_rng(3)
    for closed in (True, False):
        for member in ("Calm", "Tight", "Lean"):
            angle = np.linspace(0, 6, 120)
            curve = Curve(40 * np.stack([np.cos(angle), np.sin(angle)], axis=-1), closed)
            document = Document((curve,), PRESETS[member])
            camera = Camera(20, 10, 9.0, 900, 600)
            scene = drawn(document, camera)
            splices = 0
            for index in (60, 61, 0, 119, 5, 60):
                curve = curve.moved([index], rng.uniform(-40, 40, 2))
                document = Document((curve,), document.parameters)
                drawn(document, camera, scene=scene)
                (now,) = scene.curves
                splices += now.splice is not None
                limit = curve.limit(document.parameters)
                exact = camera.to_pixels(limit.points(6))
                seen = ((exact >= 0) & (exact <= (900, 600))).all(axis=1)
                found = [away(line, exact[seen][::3]) for line in now.outline_line.pieces()]
                assert np.min(found, axis=0).max() <= 0.25
                back = [away(exact, line[::7]) for line in now.outline_line.pieces()]
                assert np.concatenate(back).max() <= 1.0
                polygon = camera.to_pixels(curve.points)
                seen = ((polygon >= 0) & (polygon <= (900, 600))).all(axis=1)
                found = [away(line, polygon[seen]) for line in now.polygon_line.pieces()]
                assert np.min(found, axis=0).max() <= 0.25
                np.testing.assert_array_equal(
                    now.shown, drawn(document, camera).curves[0].shown
                )
                assert (np.diff(now.parameters) >= 0).all()
            assert splices >= 2


@pytest.mark.parametrize("count", [2, 8, 5000])
@pytest.mark.parametrize("closed", [True, False])
def test_the_nearest_edge_is_found_among_any_number(count, closed):
    angle = np.linspace(0, 6.2, count) ** 1.1
    points = 25 * np.stack([np.cos(angle), np.sin(angle)], axis=-1) + (60, 30)
    scene = drawn(Document((Curve(points, closed),)))
    polygon = scene.curves[0].points_px
    loop = scene.curves[0].curve.is_loop
    ring = np.concatenate([polygon, polygon[:1]]) if loop else polygon
    for place in 0.5 * (ring[1:] + ring[:-1])[:: max(count // 9, 1)]:
        hit = scene.nearest_edge(place + 0.01, 6.0)
        start, end = ring[hit.edge : hit.edge + 2]
        foot = start + hit.share * (end - start)
        assert np.hypot(*(foot - place)) <= 0.02
    assert scene.nearest_edge(np.array([2.0, 2.0]), 6.0) is None
