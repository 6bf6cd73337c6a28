import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given

from core.document import Curve, Document
from core.errors import NinepointError
from core.formats import svg
from core.formats.contours import Contours
from drawings import documents, extents, letter_f, tolerances

SVG = "{http://www.w3.org/2000/svg}"
TOLERANCE = 0.01


def encoded(document, tolerance=TOLERANCE, title="title"):
    return svg.encode(Contours.of(document, tolerance, svg.GUARD_DIGITS), title)


def parsed(data):
    """Root element, and for each path its points in the page's coordinates and its Z."""
    root = ET.fromstring(data)
    paths = []
    for element in root.iter(f"{SVG}path"):
        words = element.get("d")
        assert re.fullmatch(r"M[\d.]+ [\d.]+( L[\d.]+ [\d.]+)+Z?", words)
        numbers = re.findall(r"[\d.]+", words)
        paths.append((np.array(numbers, dtype=float).reshape(-1, 2), words.endswith("Z")))
    return root, paths


def page(root):
    """Width and height in mm, checked to be the view box's."""
    width, height = root.get("width"), root.get("height")
    assert width.endswith("mm")
    assert height.endswith("mm")
    width, height = width.removesuffix("mm"), height.removesuffix("mm")
    assert root.get("viewBox") == f"0 0 {width} {height}"
    return float(width), float(height)


@given(documents, tolerances)
def test_the_paths_have_the_extents_of_the_exact_curves(document, tolerance):
    _, paths = parsed(encoded(document, tolerance))
    points = np.concatenate([points for points, _ in paths])
    low, high = extents(document)
    # Vertices lie on the curves, which lie within the tolerance of the chords.
    assert np.abs(np.ptp(points, axis=0) - (high - low)).max() <= 2 * tolerance


@given(documents, tolerances)
def test_the_page_is_the_box_of_the_contours(document, tolerance):
    root, paths = parsed(encoded(document, tolerance))
    points = np.concatenate([points for points, _ in paths])
    for low, high, side in zip(points.min(axis=0), points.max(axis=0), page(root), strict=True):
        if high > low:
            assert (low, high) == (0, side)
        else:
            assert side == 2 * low == svg.STROKE_MM


def test_every_vertex_lies_where_it_is_in_the_drawing_and_nothing_is_mirrored():
    document = letter_f()
    contours = Contours.of(document, TOLERANCE, svg.GUARD_DIGITS)
    _, paths = parsed(svg.encode(contours, "F"))
    corner = contours.low[0], contours.high[1]
    assert len(paths) == 2
    for (points, closed), line in zip(paths, contours.polylines, strict=True):
        back = np.column_stack([corner[0] + points[:, 0], corner[1] - points[:, 1]])
        assert np.abs(back - line.points).max() < 1e-9
        assert closed == line.closed


def test_the_arms_of_an_f_are_at_the_top_right():
    document = letter_f()
    _, ((points, closed), _) = parsed(encoded(Document(document.curves[:1] * 2)))
    assert closed
    x, y = (points - points.mean(axis=0)).T
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    # Vertices crowd where the arms are: at the right of the stem, and in the upper half, which
    # has the small y on a page.
    assert points[x.argmax(), 1] < middle[1]
    assert points[points[:, 1] > middle[1], 0].max() < points[points[:, 1] < middle[1], 0].max()
    assert len(x) == len(y)


def test_numbers_have_no_zeros_at_the_end_and_no_exponents():
    (data,) = re.findall(rb' d="([^"]*)"', encoded(Document((letter_f().curves[0],))))
    for number in re.findall(rb"[^ \nMLZ]+", data):
        assert re.fullmatch(rb"\d+(\.\d*[1-9])?", number)


def test_there_are_no_fills_and_no_transforms():
    data = encoded(letter_f())
    assert b"transform" not in data
    assert data.count(b'fill="none"') == data.count(b"<path") == 2


def test_the_same_drawing_gives_the_same_bytes():
    assert encoded(letter_f()) == encoded(letter_f())


def test_the_place_of_the_drawing_does_not_change_the_file():
    assert encoded(letter_f((0.0, 0.0))) == encoded(letter_f((256.0, -512.0)))


@pytest.mark.parametrize(
    "name", ["a < b & c > d", '"quotes"', "翼 Flügel 🛩", "a\0b\x1b\ud800c\uffff"]
)
def test_any_name_gives_well_formed_xml(name):
    document = Document((Curve([(0, 0), (1, 1)], name=name),))
    root, _ = parsed(encoded(document, title=name))
    readable = re.sub("[\0\x1b\ud800\uffff]", "", name)
    assert [element.text for element in root.iter(f"{SVG}title")] == [readable, readable]


@pytest.mark.parametrize("end", [(30, 0), (0, 30)])
def test_a_straight_line_has_a_page_that_can_be_shown(end):
    root, _ = parsed(encoded(Document((Curve([(0, 0), end]),))))
    assert sorted(page(root)) == [svg.STROKE_MM, 30]


def test_a_path_longer_than_readers_take_is_refused(monkeypatch):
    monkeypatch.setattr(svg, "MAX_PATH_BYTES", 1000)
    with pytest.raises(NinepointError, match=r"'Letter F' needs .* vertices"):
        encoded(letter_f())
