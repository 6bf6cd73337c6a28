import msgspec
import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage

from app.export_picture import CHECKS, MARGINS_PX, PAPER, Look, drawn
from app.style import DARK, LIGHT
from core.document import Curve, Document
from core.formats import prepare
from core.profiles import named
from drawings import letter_f

LOOK = Look(400, 300, 1.0)
SQUARE = Document((Curve([(0, 0), (40, 0), (40, 30), (0, 30)]),))


def content_of(name, document=SQUARE, **fields):
    return prepare(document, msgspec.structs.replace(named(name), **fields))


def pixels(picture):
    """Colours of the pixels, shape (height, width, 3), 0 to 255."""
    image = picture.image.convertToFormat(QImage.Format.Format_RGBA8888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)
    return rows[..., :3].astype(int)


def places_of(picture, colour, within=60):
    """Columns and rows of the pixels of nearly a colour."""
    wanted = QColor(colour)
    off = np.abs(pixels(picture) - [wanted.red(), wanted.green(), wanted.blue()]).max(axis=2)
    rows, columns = np.nonzero(off <= within)
    return np.stack([columns, rows], axis=1)


@pytest.mark.parametrize("name", ["laser", "svg", "pdf", "png", "laser-r12", "cad"])
def test_what_is_written_fills_the_frame(name):
    content = content_of(name, letter_f())
    picture = drawn(content, None, LOOK)
    frame = picture.frame
    left, top, right, bottom = MARGINS_PX
    assert frame.width() == pytest.approx(400 - left - right, abs=1) or frame.height() == (
        pytest.approx(300 - top - bottom, abs=1)
    )
    assert frame.left() >= left - 1
    assert frame.top() >= top - 1
    low, high = content.box
    assert frame.width() / frame.height() == pytest.approx(
        (high - low)[0] / (high - low)[1], rel=1e-3
    )
    ink = places_of(picture, LIGHT.curve_active)
    corners = [ink.min(axis=0), ink.max(axis=0) + 1]
    assert np.abs(np.array([[frame.left(), frame.top()], [frame.right(), frame.bottom()]]) - corners
                  ).max() <= 2.5  # fmt: skip


def test_the_size_is_told_in_millimetres_in_any_unit():
    for unit in ("mm", "in"):
        content = content_of("laser", letter_f(), unit=unit)
        picture = drawn(content, None, LOOK)
        low, high = content.box
        factor = {"mm": 1.0, "in": 25.4}[unit]
        wide, tall = (f"{factor * size:.2f} mm" for size in high - low)
        assert (picture.width, picture.height) == (wide, tall)
        assert tall == "50.00 mm"


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_formats_with_a_page_show_it_as_it_comes_out(palette):
    look = Look(400, 300, 1.0, palette)
    content = content_of("svg", colour="#0000ff")
    picture = drawn(content, None, look)
    middle = picture.frame.center().toPoint()
    assert picture.image.pixelColor(middle).name() == PAPER
    assert picture.image.pixelColor(2, 2).name() == palette.background
    assert len(places_of(picture, "#0000ff")) > 100


def test_no_ground_is_shown_as_checks():
    picture = drawn(content_of("png", transparent=True), None, LOOK)
    seen = {picture.image.pixelColor(180 + k, 120).name() for k in range(20)}
    assert seen == set(CHECKS)
    white = drawn(content_of("png", transparent=False), None, LOOK)
    assert {white.image.pixelColor(180 + k, 120).name() for k in range(20)} == {PAPER}


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_black_lines_without_a_page_are_seen_on_any_ground(palette):
    picture = drawn(content_of("laser"), None, Look(400, 300, 1.0, palette))
    assert len(places_of(picture, palette.curve_active)) > 100
    red = drawn(content_of("laser", colour="#ff0000"), None, Look(400, 300, 1.0, palette))
    assert len(places_of(red, "#ff0000")) > 100


def test_entities_are_marked_at_their_ends_until_there_are_too_many():
    few = drawn(content_of("svg", tolerance_mm=0.1, colour="#ff0000"), None, LOOK)
    many = drawn(content_of("svg-polyline", tolerance_mm=0.0001, colour="#ff0000"), None, LOOK)
    assert len(places_of(few, LIGHT.accent, 90)) > 10
    assert len(places_of(many, LIGHT.accent, 90)) == 0


def test_the_outline_before_the_offset_is_drawn_where_it_was():
    """Both have an origin of their own; what they have in common is the drawing's coordinates."""
    small = Document((Curve(SQUARE.curves[0].points * 0.5 + (10, 7.5)),))
    content = content_of("svg", colour="#ff0000")
    original = content_of("svg", small)
    picture = drawn(content, original, LOOK)
    ghost = places_of(picture, LIGHT.ghost, 30)
    centre = np.array([picture.frame.center().x(), picture.frame.center().y()])
    np.testing.assert_allclose((ghost.min(axis=0) + ghost.max(axis=0) + 1) / 2, centre, atol=2)
    size = np.array([picture.frame.width(), picture.frame.height()])
    np.testing.assert_allclose(np.ptp(ghost, axis=0), size / 2, atol=4)


def test_the_origin_is_marked_where_it_is_in_sight():
    assert len(places_of(drawn(content_of("laser", origin="corner"), None, LOOK),
                         LIGHT.influence)) > 5  # fmt: skip
    assert len(places_of(drawn(content_of("laser", letter_f()), None, LOOK), LIGHT.influence)) == 0
    assert len(places_of(drawn(content_of("svg"), None, LOOK), LIGHT.influence)) == 0


def test_tables_are_points():
    content = content_of("points", tolerance_mm=0.5)
    picture = drawn(content, None, LOOK)
    assert len(places_of(picture, LIGHT.accent, 40)) > 4 * content.count


def test_a_single_point_is_drawn_too():
    dot = Document((Curve([(5, 5)]),))
    content = prepare(dot, msgspec.structs.replace(named("points"), entity="control points"))
    assert len(places_of(drawn(content, None, LOOK), LIGHT.accent, 40)) > 4


@pytest.mark.parametrize("shift", [0.0, 1e8])
def test_far_from_the_origin_nothing_shakes(shift):
    document = Document((Curve(SQUARE.curves[0].points + shift),))
    picture = drawn(content_of("laser", document, tolerance_mm=0.1), None, LOOK)
    near = drawn(content_of("laser", tolerance_mm=0.1), None, LOOK)
    assert picture.frame.width() == pytest.approx(near.frame.width(), abs=0.5)
    assert len(places_of(picture, LIGHT.curve_active)) == pytest.approx(
        len(places_of(near, LIGHT.curve_active)), rel=0.05
    )


def test_a_dense_screen_has_more_pixels_of_the_same_picture():
    once, twice = (drawn(content_of("svg"), None, Look(400, 300, r)) for r in (1.0, 2.0))
    assert (twice.image.width(), twice.image.height()) == (800, 600)
    assert twice.frame == once.frame


def test_it_can_be_cancelled_between_parts_and_needs_room():
    asked = []

    def cancelled():
        asked.append(1)
        return len(asked) > 1

    content = content_of("laser", letter_f())
    assert drawn(content, None, LOOK, cancelled) is None
    assert len(asked) == 2
    assert drawn(content, None, Look(30, 300, 1.0)) is None
