import msgspec
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core.arcs import Arcs
from core.document import Curve, Document
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.flatten import Polyline
from core.formats.contours import Contours, bulge_places
from core.profiles import PROFILES, Profile, named
from core.splines import Spline
from drawings import documents, extents, letter_f, tolerances
from effort import costly

DRAWN = {
    entity: Profile(
        name="test", title="Test", format=form, entity=entity, version=version
    )
    for form, entity, version in [
        ("dxf", "arcs", "R2000"),
        ("dxf", "polyline", "R12"),
        ("dxf", "spline", "R2000"),
        ("svg", "cubics", ""),
    ]
}  # fmt: skip
drawn = st.sampled_from(list(DRAWN.values()))


def with_(profile, **fields):
    return msgspec.structs.replace(profile, **fields)


def numbers(shape):
    if isinstance(shape, (Arcs, Polyline)):
        return shape.points
    return shape.controls.reshape(-1, 2)


@costly
@given(documents, drawn, tolerances)
def test_the_deviation_with_the_rounding_stays_within_the_tolerance(document, profile, tolerance):
    contours = Contours.of(document, profile.within(tolerance))
    assert 0.7 * 10.0**-contours.places <= contours.deviation_mm <= tolerance


@costly
@given(documents, drawn, tolerances)
def test_the_box_is_that_of_the_exact_curves(document, profile, tolerance):
    contours = Contours.of(document, profile.within(tolerance))
    # The dense points are exact, but the extreme may lie between them: hence only one side.
    low, high = extents(document)
    assert (contours.box[0] <= low + tolerance).all()
    assert (contours.box[1] >= high - tolerance).all()
    width, height = contours.size_mm
    assert (width, height) == tuple((contours.box[1] - contours.box[0]).tolist())


@costly
@given(documents, drawn)
def test_an_inch_is_25_4_millimetres_and_nothing_else(document, profile):
    profile = profile.within(0.1)
    metric, inch = (Contours.of(document, with_(profile, unit=unit)) for unit in ("mm", "in"))
    assert inch.deviation_mm <= 0.1
    assert np.abs(inch.box * 25.4 - metric.box).max() <= 0.2
    assert np.allclose(inch.size_mm, metric.size_mm, atol=0.2)


@costly
@given(documents, drawn)
def test_the_corner_becomes_the_origin_and_nothing_is_turned(document, profile):
    placed, shifted = (
        Contours.of(document, with_(profile.within(0.1), origin=origin))
        for origin in ("drawing", "corner")
    )
    unit = 10.0**-placed.places
    assert np.abs(shifted.box[0]).max() <= 2 * unit
    for one, other in zip(placed.contours, shifted.contours, strict=True):
        moved = numbers(other.shape) - shifted.shift
        if len(moved) == len(numbers(one.shape)):
            assert np.abs(moved - numbers(one.shape)).max() <= 2 * unit
    assert (placed.shift == 0).all()


@given(documents, drawn, tolerances)
@costly
def test_all_numbers_have_the_decimals_of_the_file(document, profile, tolerance):
    contours = Contours.of(document, profile.within(tolerance))
    for contour in contours.contours:
        found = numbers(contour.shape)
        assert np.array_equal(found, np.round(found, contours.places))


angles = st.integers(-900, 900).map(lambda n: n / 1000)


@given(angles, st.integers(1, 300), st.integers(2, 6), st.integers(0, 2**16))
def test_rounding_moves_no_point_of_an_arc_by_more_than_is_said(bulge, chord, places, seed):
    """The bound of the module's notes, against arcs that are moved and bent at random."""
    shift = np.random.default_rng(seed).uniform(-0.5, 0.5, 5) * 10.0**-places
    arc = Arcs(np.array([(0.0, 0.0), (chord, 0.0)]), np.array([bulge, 0.0]), False, True, 0.0)
    fine = 10.0 ** -bulge_places(arc, places)
    start, end = complex(*shift[:2]), chord + complex(*shift[2:4])
    other = bulge + shift[4] * 10.0**places * fine
    share = np.linspace(1e-6, 1 - 1e-6, 101)
    ray = share / (1 - share)

    def on_arc(from_, to, tangent):
        # An arc to the left lies to the right of its chord.
        w = ray * np.exp(-2j * np.arctan(tangent) * -1)
        return from_ + (to - from_) * w / (1 + w)

    assume(abs(other) < 1)
    moved = np.abs(on_arc(0, chord, bulge) - on_arc(start, end, other)).max()
    assert moved <= 1.25 * 10.0**-places * (1 + 1e-9)


def test_one_contour_for_each_curve_closed_as_it_is():
    for profile in DRAWN.values():
        contours = Contours.of(letter_f(), profile)
        assert [contour.name for contour in contours.contours] == ["Letter F", "Stroke"]
        assert [contour.closed for contour in contours.contours] == [True, False]
        assert contours.closed == 1
        assert contours.count == sum(contour.count for contour in contours.contours)


def test_counts_are_of_what_the_file_holds():
    square = Document((Curve([(0, 0), (9, 0), (9, 9), (0, 9)]),))
    for entity, profile in DRAWN.items():
        (contour,) = Contours.of(square, profile).contours
        held = {"spline": "knots", "cubics": "controls"}.get(entity, "points")
        assert contour.pieces == len(getattr(contour.shape, held)) - (entity == "spline")
        opened = Document((Curve(square.curves[0].points, False),))
        (contour,) = Contours.of(opened, profile).contours
        assert contour.count - contour.pieces == (entity == "polyline")


def test_no_vertex_is_repeated():
    corners = np.repeat([(0, 0), (10, 0), (10, 10), (0, 10)], 9, axis=0)
    for closed in (True, False):
        document = Document((Curve(corners, closed),))
        for entity in ("arcs", "polyline"):
            (contour,) = Contours.of(document, DRAWN[entity]).contours
            points = contour.shape.points
            assert (np.diff(points, axis=0) != 0).any(axis=1).all()
            assert (points[0] != points[-1]).any()


def test_an_open_curve_that_comes_back_keeps_both_ends():
    document = Document((Curve([(0, 0), (10, 0), (10, 10), (0, 0)], closed=False),))
    for profile in DRAWN.values():
        (contour,) = Contours.of(document, profile).contours
        found = numbers(contour.shape)
        assert found[0].tolist() == found[-1].tolist() == [0, 0]
        assert not contour.closed


def test_curves_without_extent_are_left_out():
    dots = (Curve([]), Curve([(1, 2)]), Curve([(1, 2)] * 5))
    segment = Curve([(0, 0), (3, 4)], closed=True, name="Segment")
    for profile in DRAWN.values():
        contours = Contours.of(Document((*dots, segment, *dots)), profile)
        assert [contour.name for contour in contours.contours] == ["Segment"]
        assert contours.closed == 0
        assert contours.count == 1 + (profile.entity == "polyline")
        for curves in ((), dots):
            with pytest.raises(NinepointError, match="nothing to export"):
                Contours.of(Document(curves), profile)


def test_a_curve_smaller_than_the_decimals_has_no_extent():
    tiny = Curve([(5, 5), (5 + 1e-8, 5), (5, 5 + 1e-8)])
    large = Curve([(0, 0), (3, 4)], name="Segment")
    for profile in DRAWN.values():
        contours = Contours.of(Document((tiny, large)), profile)
        assert [contour.name for contour in contours.contours] == ["Segment"]
        with pytest.raises(NinepointError, match="smaller than the tolerance resolves"):
            Contours.of(Document((tiny,)), profile)


@pytest.mark.parametrize(
    ("tolerance", "decimals"), [(100, 2), (1, 2), (0.1, 3), (0.05, 4), (0.01, 4), (0.001, 5)]
)
def test_the_tolerance_sets_the_decimals(tolerance, decimals):
    assert Contours.of(letter_f(), named("svg").within(tolerance)).places == decimals
    assert Contours.of(letter_f(), named("laser").within(tolerance)).places == decimals + 2


def test_large_coordinates_have_the_decimals_that_a_float_holds():
    far = letter_f((2e8, -2e8))
    contours = Contours.of(far, named("laser").within(0.01))
    assert contours.places == 6
    assert contours.deviation_mm <= 0.01
    with pytest.raises(NinepointError, match=r"Coordinates of 2e\+08 mm cannot be written"):
        Contours.of(far, named("laser").within(1e-6))


def test_what_is_too_rough_for_a_spline_becomes_a_polyline_and_is_told():
    rough = letter_f().with_parameters(Parameters("3/10", "-1/2", "-1/3", "mirrored"))
    contours = Contours.of(rough, named("cad").within(0.1))
    assert {type(contour.shape) for contour in contours.contours} == {Polyline}
    assert contours.notes[0] == "'Letter F' is too rough for a spline, so it is a polyline."
    smooth = Contours.of(letter_f(), named("cad"))
    assert {type(contour.shape) for contour in smooth.contours} == {Spline}
    assert smooth.notes == ()


def test_layers_are_one_or_one_for_each_curve():
    document = letter_f().with_parameters(PRESETS["Tight"])
    one, many = (
        Contours.of(document, with_(named("laser"), layers=layers))
        for layers in ("one", "by curve")
    )
    assert one.layers == ("CURVES",)
    assert many.layers == ("LETTER_F", "STROKE")


def test_a_kerf_gives_polylines_and_says_so():
    letter = Document(letter_f().curves[:1])
    plain = Contours.of(letter, named("laser"))
    grown = Contours.of(letter, with_(named("laser"), kerf_mm=0.5))
    assert np.abs(grown.box - plain.box - [[-0.5], [0.5]]).max() < 0.02
    assert grown.profile.entity == "polyline"
    assert isinstance(grown.contours[0].shape, Polyline)
    assert "With a kerf the contours are polylines." in grown.notes


def test_every_built_in_profile_of_contours_can_be_prepared():
    for profile in PROFILES.values():
        if not profile.is_table:
            assert Contours.of(letter_f(), profile).count > 1
