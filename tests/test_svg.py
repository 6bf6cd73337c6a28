import re
import xml.etree.ElementTree as ET

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.document import Curve, Document
from core.formats import svg
from core.formats.contours import Contours
from core.profiles import named
from drawings import documents, extents, letter_f
from effort import costly
from independent import (
    chord_error,
    exact_points,
    farthest,
    ink_of_resvg,
    seen_by_svgpathtools,
)

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = f"{{{svg.INKSCAPE}}}"
TOLERANCE = 0.01
NAMES = ("svg", "svg-polyline", "svg-blue")
names = st.sampled_from(NAMES)
coarse = st.sampled_from([0.1, 1.0])
NUMBER = r"-?\d+(?:\.\d*[1-9])?"
DATA = re.compile(
    rf"M{NUMBER} {NUMBER}(?:( L{NUMBER} {NUMBER})+|( C{NUMBER}(?: {NUMBER}){{5}})+)Z?"
)


def contours_of(document, tolerance=TOLERANCE, name="svg", **fields):
    profile = msgspec.structs.replace(named(name).within(tolerance), **fields)
    return Contours.of(document, profile)


def encoded(document, tolerance=TOLERANCE, title="title", name="svg", **fields):
    return svg.encode(contours_of(document, tolerance, name, **fields), title)


def paths_in(root):
    """Points of the paths in the page's coordinates, all of them control points, and their Z."""
    found = []
    for element in root.iter(f"{SVG}path"):
        words = element.get("d")
        assert DATA.fullmatch(words)
        numbers = np.array(re.findall(NUMBER, words), dtype=float)
        found.append((numbers.reshape(-1, 2), words.endswith("Z")))
    return found


def page(root, unit="mm"):
    """Width and height, checked to be the view box's."""
    width, height = root.get("width"), root.get("height")
    assert width.endswith(unit)
    assert height.endswith(unit)
    width, height = width.removesuffix(unit), height.removesuffix(unit)
    assert root.get("viewBox") == f"0 0 {width} {height}"
    return np.array([float(width), float(height)])


@costly
@given(documents, coarse, names, st.sampled_from(["mm", "in"]))
def test_svgpathtools_sees_the_exact_curves_within_the_tolerance(document, tolerance, name, unit):
    """Document, file, another reader, both ways: within what the file promises."""
    content = contours_of(document, tolerance, name, unit=unit)
    found = seen_by_svgpathtools(svg.encode(content, ""))
    origin, _ = svg.page(content)
    assert len(found) == len(content.contours)
    for (points, closed), contour in zip(found, content.contours, strict=True):
        assert closed >= contour.closed
        line = (points + origin - content.shift) * content.profile.unit_mm
        exact = exact_points(contour.curve, document.parameters)
        reach = contour.shape.deviation + 1e-9
        assert farthest(exact, line) <= reach + chord_error(line)
        assert farthest(line, exact) <= reach + chord_error(exact)


@costly
@given(documents, coarse, names)
def test_the_page_is_the_box_of_the_contours(document, tolerance, name):
    content = contours_of(document, tolerance, name)
    root = ET.fromstring(svg.encode(content, ""))
    last = 10.0**-content.places
    stroke = content.profile.width_mm
    for side, extent in zip(page(root), content.size_mm, strict=True):
        assert side >= last / 2
        if extent > last:
            assert extent - last / 100 <= side <= extent + 2 * last
        elif extent == 0:
            assert stroke <= side <= stroke + 2 * last
    low, high = extents(document)
    assert (page(root) >= np.ptp([low, high], axis=0) - 2 * tolerance).all()


@pytest.mark.parametrize("name", NAMES)
def test_the_arms_of_an_f_are_at_the_top_right(name):
    root = ET.fromstring(encoded(letter_f(), name=name))
    (points, closed), (_, stroke_closed) = paths_in(root)
    assert closed
    assert not stroke_closed
    # A small y is at the top of a page.
    top, foot = points[points[:, 1] < 10], points[points[:, 1] > 40]
    assert foot[:, 0].max() < 12 < top[:, 0].max()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("unit", ["mm", "in"])
def test_a_renderer_draws_the_page_at_true_size_and_the_f_upright(name, unit):
    fine = 20
    content = contours_of(letter_f(), name=name, unit=unit, width_mm=0.1)
    box, size, ink = ink_of_resvg(svg.encode(content, ""), fine)
    assert np.abs(size - content.size_mm).max() <= 1 / fine
    assert np.abs(box - [0, 0, *content.size_mm]).max() <= 0.1 + 1 / fine
    letter = ink[:, : 35 * fine]
    top, foot = letter[: 10 * fine], letter[-10 * fine :]
    assert np.flatnonzero(foot.any(axis=0)).max() < 12 * fine
    assert np.flatnonzero(top.any(axis=0)).max() > 20 * fine


@pytest.mark.parametrize("name", NAMES)
def test_numbers_have_no_zeros_at_the_end_and_no_exponents(name):
    root = ET.fromstring(encoded(letter_f(), name=name))
    assert len(paths_in(root)) == 2  # they match the pattern of data
    for size in (0.1, 1e6):
        document = Document((Curve(np.array([(0, 0), (1, 2), (3, 0.3)]) * size),))
        paths_in(ET.fromstring(encoded(document, 1e-5 * size, name=name)))


def test_there_are_no_fills_and_no_transforms():
    data = encoded(letter_f())
    assert b"transform" not in data
    assert data.count(b'fill="none"') == data.count(b"<path") == 2


@pytest.mark.parametrize("name", NAMES)
def test_the_same_drawing_gives_the_same_bytes(name):
    assert encoded(letter_f(), name=name) == encoded(letter_f(), name=name)


def test_the_place_of_the_drawing_does_not_change_the_paths():
    one, other = (encoded(letter_f(shift)) for shift in ((0.0, 0.0), (256.0, -512.0)))
    assert one.partition(b"</metadata>")[2] == other.partition(b"</metadata>")[2]


def test_layers_are_layers_of_inkscape_with_the_names_of_the_curves():
    by_curve, one = (
        ET.fromstring(encoded(letter_f(), layers=layers)) for layers in ("by curve", "one")
    )
    groups = by_curve.findall(f"{SVG}g")
    assert [group.get("id") for group in groups] == ["LETTER_F", "STROKE"]
    assert [group.get(f"{INKSCAPE}label") for group in groups] == ["Letter F", "Stroke"]
    assert {group.get(f"{INKSCAPE}groupmode") for group in groups} == {"layer"}
    (group,) = one.findall(f"{SVG}g")
    assert group.get(f"{INKSCAPE}label") == "Curves"
    assert len(group.findall(f"{SVG}path")) == 2


@pytest.mark.parametrize(("unit", "width"), [("mm", 0.01), ("in", 0.01 / 25.4)])
def test_colour_and_width_are_those_of_the_profile(unit, width):
    root = ET.fromstring(encoded(letter_f(), name="svg-blue", unit=unit))
    for path in root.iter(f"{SVG}path"):
        assert path.get("stroke") == "#0000ff"
        assert float(path.get("stroke-width")) == pytest.approx(width, rel=1e-5)


def test_only_thin_lines_are_hairlines_in_inkscape():
    assert b"hairline" in encoded(letter_f(), width_mm=0.1)
    assert b"hairline" not in encoded(letter_f(), width_mm=0.5)


@pytest.mark.parametrize(
    "name", ["a < b & c > d", '"quotes"', "翼 Flügel 🛩", "a\0b\x1b\ud800c\uffff"]
)
def test_any_name_gives_well_formed_xml(name):
    document = Document((Curve([(0, 0), (1, 1)], name=name),))
    root = ET.fromstring(encoded(document, title=name, layers="by curve"))
    readable = re.sub("[\0\x1b\ud800\uffff]", "", name)
    assert [element.text for element in root.iter(f"{SVG}title")] == [readable, readable]
    assert root.find(f"{SVG}g").get(f"{INKSCAPE}label") == readable


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("end", [(30, 0), (0, 30)])
def test_a_straight_line_has_a_page_that_can_be_shown(end, name):
    content = contours_of(Document((Curve([(0, 0), end]),)), name=name)
    sides = page(ET.fromstring(svg.encode(content, "")))
    assert sorted(sides) == pytest.approx([content.profile.width_mm, 30])


@pytest.mark.parametrize("name", ["svg", "svg-polyline"])
@pytest.mark.parametrize("closed", [True, False])
def test_a_path_longer_than_readers_take_is_cut_where_its_parts_join(monkeypatch, name, closed):
    curve = letter_f().curves[0]
    document = Document((Curve(curve.points, closed),))
    ((whole, is_closed),) = paths_in(ET.fromstring(encoded(document, name=name)))
    assert is_closed == closed
    monkeypatch.setattr(svg, "MAX_PATH_BYTES", 400)
    content = contours_of(document, name=name)
    root = ET.fromstring(svg.encode(content, ""))
    parts = paths_in(root)
    assert svg.path_counts(content) == [len(parts)]
    assert len(parts) > 1
    assert all(len(path.get("d")) <= 400 for path in root.iter(f"{SVG}path"))
    assert not any(z for _, z in parts)
    points = [parts[0][0][:1]]
    for part, _ in parts:
        assert part[0].tolist() == points[-1][-1].tolist()
        points.append(part[1:])
    points = np.concatenate(points)
    if closed and name == "svg-polyline":
        assert points[-1].tolist() == points[0].tolist()
        points = points[:-1]
    assert points.tolist() == whole.tolist()
