import re
import zlib

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.document import Curve, Document
from core.errors import NinepointError
from core.formats import svg
from core.formats.contours import Contours
from core.formats.pdf import MAX_SIDE, encode
from core.profiles import named
from drawings import documents, letter_f
from effort import costly
from independent import chord_error, exact_points, farthest

MM = 25.4 / 72
NUMBER = rb"-?\d+(?:\.\d+)?"


def contours_of(document, tolerance=0.01, **fields):
    return Contours.of(document, msgspec.structs.replace(named("pdf").within(tolerance), **fields))


def objects_in(data):
    """Objects of a file, found by the table at its end alone."""
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n\Z", data)[1])
    assert data[start:].startswith(b"xref\n0 ")
    count = int(data[start:].split()[2])
    places = re.findall(rb"(\d{10}) 00000 n \n", data[start:])
    assert len(places) == count - 1
    found = {}
    for number, place in enumerate(map(int, places), start=1):
        head = b"%d 0 obj\n" % number
        assert data[place:].startswith(head)
        found[number] = data[place + len(head) : data.index(b"\nendobj\n", place)]
    return found


def content_of(objects):
    length, stream = re.fullmatch(
        rb"<< /Length (\d+) /Filter /FlateDecode >>\nstream\n(.*)\nendstream", objects[4], re.S
    ).groups()
    assert len(stream) == int(length)
    return zlib.decompress(stream)


def page_mm(objects):
    """Sides of the page in mm."""
    box = re.search(rb"/MediaBox \[0 0 (\S+) (\S+)\] /UserUnit (\d+)", objects[3])
    return np.array([float(box[1]), float(box[2])]) * int(box[3]) * MM


def paths_in(objects):
    """Dense points of the paths in mm on the page, and whether they are closed."""
    lines = content_of(objects).decode().splitlines()
    matrix = [float(word) for word in lines[0].split()[:6]]
    assert matrix[1:3] + matrix[4:] == [0, 0, 0, 0]
    scale = matrix[0] * int(re.search(rb"/UserUnit (\d+)", objects[3])[1]) * MM
    found, points = [], []
    u = np.linspace(0, 1, 33)[1:, None]
    for line in lines[1:]:
        *words, operator = line.split()
        if operator in "mlc":
            numbers = np.array(words, dtype=float).reshape(-1, 2)
        if operator == "m":
            points = [numbers]
        elif operator == "l":
            points.append(numbers)
        elif operator == "c":
            zero, (one, two, three), v = points[-1][-1], numbers, 1 - u
            points.append(v**3 * zero + 3 * u * v * (v * one + u * two) + u**3 * three)
        elif operator in ("s", "S"):
            closing = [points[0]] if operator == "s" else []
            found.append((np.concatenate(points + closing) * scale, operator == "s"))
    return found


@costly
@given(
    documents, st.sampled_from([0.1, 1.0]), st.sampled_from(["cubics", "polyline"]),
    st.sampled_from(["mm", "in"]),
)  # fmt: skip
def test_a_reader_sees_the_exact_curves_within_the_tolerance(document, tolerance, entity, unit):
    content = contours_of(document, tolerance, entity=entity, unit=unit)
    objects = objects_in(encode(content, ""))
    origin, size = svg.page(content)
    corner = (origin - (0, size[1]) - content.shift) * content.profile.unit_mm
    found = paths_in(objects)
    assert len(found) == len(content.contours)
    for (points, closed), contour in zip(found, content.contours, strict=True):
        assert closed == contour.closed
        line = points + corner
        exact = exact_points(contour.curve, document.parameters)
        reach = contour.shape.deviation + 1e-6
        assert farthest(exact, line) <= reach + chord_error(line)
        assert farthest(line, exact) <= reach + chord_error(exact)


def test_the_page_is_the_box_to_a_nanometre():
    content = contours_of(letter_f())
    objects = objects_in(encode(content, ""))
    np.testing.assert_allclose(page_mm(objects), svg.page(content)[1], atol=1e-6)
    points = np.concatenate([points for points, _ in paths_in(objects)])
    np.testing.assert_allclose(points.min(axis=0), 0, atol=0.02)
    np.testing.assert_allclose(points.max(axis=0), page_mm(objects), atol=0.02)


@pytest.mark.parametrize("factor", [1, 100, 1e5])
def test_pages_of_any_size_keep_within_what_readers_take(factor):
    curve = Curve(np.array([(0, 0), (80, 0), (80, 30), (0, 60)]) * factor)
    content = contours_of(Document((curve,)), min(0.01 * factor, 100.0))
    objects = objects_in(encode(content, ""))
    unit = int(re.search(rb"/UserUnit (\d+)", objects[3])[1])
    assert page_mm(objects).max() / MM / unit <= MAX_SIDE
    np.testing.assert_allclose(page_mm(objects), svg.page(content)[1], rtol=1e-6)
    (points, _), *_ = paths_in(objects)
    np.testing.assert_allclose(np.ptp(points, axis=0), page_mm(objects), rtol=1e-3)


def test_colour_and_width_are_those_of_the_profile():
    content = contours_of(letter_f(), colour="#ff8000", width_mm=0.01)
    lines = content_of(objects_in(encode(content, ""))).splitlines()
    assert lines[1] == b"1 0.501961 0 RG"
    assert lines[2] == b"0.01 w 1 j"


def test_layers_are_named_and_each_contour_is_on_its_own():
    content = contours_of(letter_f(), layers="by curve")
    objects = objects_in(encode(content, ""))
    names = [
        bytes.fromhex(re.search(rb"/Name <FEFF(\w+)>", objects[k])[1].decode()).decode("utf-16-be")
        for k in (6, 7)
    ]
    assert names == ["Letter F", "Stroke"]
    assert re.findall(rb"/OC /(L\d) BDC", content_of(objects)) == [b"L0", b"L1"]
    assert b"/OCGs [6 0 R 7 0 R]" in objects[1]
    assert b"/L0 6 0 R /L1 7 0 R" in objects[3]
    assert len(objects_in(encode(contours_of(letter_f()), ""))) == 6


@pytest.mark.parametrize("title", ["wing", "Fl\u00fcgel \U0001f600", "(a)\\ \n", "\ud800", ""])
def test_a_title_of_any_letters_is_kept(title):
    info = objects_in(encode(contours_of(letter_f()), title))[5]
    words = bytes.fromhex(re.search(rb"/Title <FEFF(\w*)>", info)[1].decode())
    assert words.decode("utf-16-be") == title.replace("\ud800", "?")


def test_the_same_drawing_gives_the_same_bytes():
    assert encode(contours_of(letter_f()), "a") == encode(contours_of(letter_f()), "a")
    data = encode(contours_of(letter_f()), "a")
    assert b"Date" not in data


def test_arcs_are_refused():
    content = Contours.of(letter_f(), named("laser"))
    with pytest.raises(NinepointError, match="cubics or polylines"):
        encode(content, "")
