"""The example documents: they open, have their real sizes, and their curves are sound."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from core import store
from core.formats import points

EXAMPLES = Path(__file__).parents[1] / "resources" / "examples"
NAMES = ("airfoil", "gasket", "glyph", "guitar", "vase")

LEVEL = 6
"""Samples of a span: 64. Chords of the longest span bend by 40 mm / 8 / 64^2, about 0.001 mm."""

CHORD_MM = 200.0


def opened(name):
    return store.load(EXAMPLES / f"{name}.ninepoint")


def limit(document, curve, level=LEVEL):
    return curve.limit(document.parameters).points(level)


def limits(document, level=LEVEL):
    return {curve.name: limit(document, curve, level) for curve in document.curves}


def box(curve):
    """Lower left corner and size of a sampled curve."""
    return curve.min(axis=0), np.ptp(curve, axis=0)


def distances(places, path, closed):
    """Distance of each place from a polyline."""
    start = path if closed else path[:-1]
    chord = (np.roll(path, -1, axis=0) if closed else path[1:]) - start
    away = places[:, None] - start
    share = np.clip((away * chord).sum(axis=-1) / (chord**2).sum(axis=-1), 0.0, 1.0)
    return np.hypot(*(away - share[..., None] * chord).T).min(axis=0)


def cross(one, other):
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def crossings(path, closed):
    """Number of pairs of edges that meet although they are no neighbours."""
    start = path if closed else path[:-1]
    end = np.roll(path, -1, axis=0) if closed else path[1:]
    count = len(start)
    side_start = cross((end - start)[:, None], start - start[:, None])
    side_end = cross((end - start)[:, None], end - start[:, None])
    splits = side_start * side_end < 0
    one, other = np.nonzero(np.triu(splits & splits.T, k=2))
    return int((~(closed & (one == 0) & (other == count - 1))).sum())


def inside(places, path):
    """Whether each place lies inside a closed polyline (parity of the edges to its right)."""
    end = np.roll(path, -1, axis=0)
    x, y = places[:, 0, None], places[:, 1, None]
    spans = (path[:, 1] > y) != (end[:, 1] > y)
    rise = np.where(end[:, 1] == path[:, 1], 1.0, end[:, 1] - path[:, 1])
    at = path[:, 0] + (y - path[:, 1]) * (end[:, 0] - path[:, 0]) / rise
    return (spans & (at > x)).sum(axis=1) % 2 == 1


def area(path):
    """Signed area of a closed polyline, positive when it runs counterclockwise."""
    return cross(path, np.roll(path, -1, axis=0)).sum() / 2


def curvature(path):
    """Curvature of an open, finely sampled curve at its inner samples."""
    before, after = path[1:-1] - path[:-2], path[2:] - path[1:-1]
    lengths = np.hypot(*before.T) * np.hypot(*after.T) * np.hypot(*(path[2:] - path[:-2]).T)
    return 2 * cross(before, after) / lengths


def turns(values):
    """Number of extrema of a sequence."""
    return int((np.diff(np.sign(np.diff(values))) != 0).sum())


def naca2412(x, side):
    """Surface of the NACA 2412 at the shares x of the chord, +1 upper, -1 lower side, in mm.

    Abbott and von Doenhoff, Theory of Wing Sections, section 6.4; the trailing edge is the
    standard one with the coefficient -0.1015, 0.504 mm thick on a chord of 200 mm.
    """
    camber, place, thickness = 0.02, 0.4, 0.12
    half = (
        5
        * thickness
        * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
    )
    scale = camber / np.where(x < place, place, 1 - place) ** 2
    line = scale * (np.where(x < place, 0.0, 1 - 2 * place) + 2 * place * x - x**2)
    angle = np.arctan(2 * scale * (place - x))
    return CHORD_MM * np.column_stack(
        [x - side * half * np.sin(angle), line + side * half * np.cos(angle)]
    )


def true_airfoil():
    """Outline of the NACA 2412 in Selig's order; closing it draws the blunt trailing edge."""
    x = (1 - np.cos(np.linspace(0, np.pi, 1001))) / 2
    return np.concatenate([naca2412(x[::-1], +1), naca2412(x[1:], -1)])


def test_a_planted_crossing_is_found():
    bow = np.array([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]])
    assert crossings(bow, closed=True) == 1
    assert crossings(bow[[0, 2, 1, 3]], closed=True) == 0


@pytest.mark.parametrize("name", NAMES)
def test_the_curves_have_names_and_do_not_cross_themselves(name):
    document = opened(name)
    names = [curve.name for curve in document.curves]
    assert len(set(names)) == len(names)
    assert all(names)
    for curve in document.curves:
        assert crossings(limit(document, curve, level=4), curve.closed) == 0, curve.name


@pytest.mark.parametrize("name", NAMES)
def test_the_drawings_use_presets_and_few_points_with_at_most_four_decimals(name):
    document = opened(name)
    assert document.parameters.name is not None
    for curve in document.curves:
        assert len(curve.points) <= 60
        assert curve.closed == (name != "vase")
        np.testing.assert_array_equal(curve.points, curve.points.round(4))


@pytest.mark.parametrize("name", ["gasket", "glyph", "guitar"])
def test_outlines_run_counterclockwise_and_holes_inside_them_clockwise(name):
    curves = limits(opened(name), level=3)
    outline = curves.pop("outline")
    assert area(outline) > 0
    for hole_name, hole in curves.items():
        assert area(hole) < 0, hole_name
        assert inside(hole, outline).all(), hole_name


def test_the_airfoil_is_the_naca_2412_on_200_mm_within_0_05_mm():
    curve = limits(opened("airfoil"))["NACA 2412"]
    true = true_airfoil()
    there = distances(curve, true, closed=True)
    back = distances(true, curve, closed=True)
    # Everything but the rounded corners of the trailing edge follows the formula far closer.
    assert there[curve[:, 0] < 199].max() < 0.01
    assert max(there.max(), back.max()) < 0.05
    assert box(curve)[1] == pytest.approx(np.ptp(true, axis=0), abs=0.03)


def test_the_trailing_edge_is_half_a_millimetre_thick_and_sharp():
    curve = limits(opened("airfoil"))["NACA 2412"]
    edge = curve[curve[:, 0] > 199.8]
    assert np.ptp(edge[:, 1]) == pytest.approx(0.504, abs=0.1)
    upper = curve[: curve[:, 0].argmin()]
    start = upper[:, 0].argmax()
    assert (np.diff(upper[start:, 0]) < 0).all()


def test_the_point_file_is_the_formula_and_is_imported_as_a_closed_curve():
    (curve,) = points.read(EXAMPLES / "naca2412.dat").curves
    assert curve.closed
    assert len(curve.points) == 81
    x = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2
    exact = np.concatenate([naca2412(x[::-1], +1), naca2412(x[1:], -1)])
    np.testing.assert_allclose(curve.points, exact, rtol=0, atol=0.51e-6)


def test_the_guitar_is_a_classical_body_and_exactly_symmetric():
    document = opened("guitar")
    curves = limits(document)
    outline, hole = curves["outline"], curves["sound hole"]
    corner, size = box(outline)
    assert corner == pytest.approx([-182.5, 0], abs=0.01)
    assert size == pytest.approx([365, 490], abs=0.01)
    upper = outline[outline[:, 1] > 350]
    assert np.ptp(upper[:, 0]) == pytest.approx(280, abs=1)
    flank = outline[(outline[:, 1] > 250) & (outline[:, 1] < 350) & (outline[:, 0] > 0)]
    assert 2 * flank[:, 0].min() == pytest.approx(235, abs=1)
    for curve in (outline, hole):
        assert distances(curve, curve * [-1, 1], closed=True).max() < 1e-6


def test_the_guitar_bends_only_at_bouts_and_waist():
    outline = limits(opened("guitar"))["outline"]
    right = outline[outline[:, 0] > 1]
    assert turns(curvature(right)) == 3
    assert (np.diff(np.sign(curvature(right))) != 0).sum() == 2


def test_the_vase_stands_on_its_foot_240_mm_high():
    profile = limits(opened("vase"))["profile"]
    corner, size = box(profile)
    assert corner == pytest.approx([0, 0], abs=0.001)
    assert size == pytest.approx([68, 240], abs=0.001)
    assert profile[0, 0] == 0
    belly = profile[(profile[:, 1] > 22) & (profile[:, 1] < 205)]
    assert turns(curvature(belly)) == 1
    assert (np.diff(np.sign(curvature(belly))) != 0).sum() == 2


HOLES = {
    "bore": ((0, 0), 50.0),
    "bolt hole 1": ((53, 33), 6.6),
    "bolt hole 2": ((0, 33), 6.6),
    "bolt hole 3": ((-53, 33), 6.6),
    "bolt hole 4": ((-53, -33), 6.6),
    "bolt hole 5": ((0, -33), 6.6),
    "bolt hole 6": ((53, -33), 6.6),
    "oil feed": ((41, -27), 8.0),
    "oil return": ((-41, 27), 8.0),
}


@pytest.mark.parametrize("name", HOLES)
def test_the_holes_of_the_gasket_are_round_within_0_02_mm(name):
    centre, diameter = HOLES[name]
    radii = np.hypot(*(limits(opened("gasket"))[name] - centre).T)
    assert np.abs(2 * radii - diameter).max() < 0.02


def test_the_sound_hole_is_round_within_0_05_mm():
    radii = np.hypot(*(limits(opened("guitar"))["sound hole"] - [0, 338]).T)
    assert np.abs(2 * radii - 85).max() < 0.05


def test_the_gasket_measures_120_by_80_mm_and_keeps_3_mm_between_its_holes():
    curves = limits(opened("gasket"), level=4)
    assert len(curves) == 12
    corner, size = box(curves["outline"])
    assert corner == pytest.approx([-60, -40], abs=0.01)
    assert size == pytest.approx([120, 80], abs=0.01)
    for one, other in combinations(curves, 2):
        gap = distances(curves[one], curves[other], closed=True).min()
        assert gap > 3, (one, other)
        if "outline" not in (one, other):
            assert not inside(curves[one][:1], curves[other]).any()
            assert not inside(curves[other][:1], curves[one]).any()


def test_the_glyph_has_100_mm_of_height_and_is_no_mirror_image():
    document = opened("glyph")
    outline = limits(document)["outline"]
    corner, size = box(outline)
    # Round letters overshoot the base line and the height by some 1.5 % each.
    assert corner == pytest.approx([5, -1.5], abs=0.5)
    assert size == pytest.approx([83, 103], abs=0.5)
    centre = corner + size / 2
    for mirror in ([-1, 1], [1, -1], [-1, -1]):
        mirrored = (outline - centre) * mirror + centre
        assert distances(outline[::16], mirrored[::4], closed=True).max() > 5
