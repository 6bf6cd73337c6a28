import re
import xml.etree.ElementTree as ET
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import store
from core.document import Curve, Document
from core.formats import svg
from core.formats.contours import Contours
from core.formats.embedded import embedded
from core.profiles import named
from drawings import documents, letter_f
from effort import costly

NAMES = ("svg", "svg-polyline")
PATH = re.compile(rb"<path .*?</path>", re.DOTALL)


def encoded(document, name="svg"):
    return svg.encode(Contours.of(document, named(name).within(0.1)), "title")


@cache
def letter():
    """The text of a drawing that many tests damage."""
    return encoded(letter_f())


@costly
@given(documents, st.sampled_from(NAMES))
def test_the_document_comes_back_in_every_bit(document, name):
    found = embedded(encoded(document, name))
    assert store.encode(found) == store.encode(document)


@pytest.mark.parametrize(
    "name",
    ["a < b & c > d ]]>", '"quotes"', "翼 🛩", "tab\there \r\n", "\ufffe\uffff", r"\uffff", " a "],
)
def test_any_name_comes_back(name):
    document = Document((Curve([(0, 0), (1, 1)], name=name),))
    (curve,) = embedded(encoded(document)).curves
    assert curve.name == name


def test_curves_that_are_not_drawn_come_back_too():
    document = Document((*letter_f().curves, Curve([]), Curve([(1, 2)], name="Dot")))
    found = embedded(encoded(document))
    assert [curve.count for curve in found.curves] == [10, 4, 0, 1]


def test_the_root_of_a_parsed_file_does_as_well():
    assert embedded(ET.fromstring(letter())) is not None


def test_a_document_longer_than_readers_take_is_in_several_texts(monkeypatch):
    monkeypatch.setattr(svg, "MAX_PATH_BYTES", 2000)
    points = np.random.default_rng(1).normal(size=(500, 2))
    document = Document((Curve(points, False),))
    data = encoded(document, "svg-polyline")
    assert data.count(b"<ninepoint:part>") > 5
    for part in re.findall(rb"<ninepoint:part>(.*?)</ninepoint:part>", data, re.DOTALL):
        assert len(part) <= 2000
    assert embedded(data).curves[0].points.tobytes() == points.tobytes()


@pytest.mark.parametrize(
    "change",
    [
        lambda data: data.replace(b"\nC", b" C"),
        lambda data: data.replace(b"\n", b"\r\n"),
        lambda data: data.replace(b"<path ", b'<path id="path9"\n   '),
        lambda data: data.replace(b'fill="none"', b'fill="#123456"'),
        lambda data: data.replace(b"</svg>", b"<defs><path d='M0 0'/></defs></svg>"),
        lambda data: data.replace(b"<title>", b"<desc>x</desc><title>"),
        lambda data: re.sub(rb"\n( *)(\[|\")", rb"\n\1    \2", data),
    ],
)
def test_what_changes_no_geometry_does_not_matter(change):
    data = letter()
    assert change(data) != data
    assert embedded(change(data)) is not None


def moved(data):
    return re.sub(rb'd="M\S+', b'd="M7.5', data, count=1)


def without_a_path(data):
    return PATH.sub(b"", data, count=1)


def with_one_instead_of_another(data):
    first, _ = PATH.findall(data)
    return PATH.sub(lambda match: first, data)


@pytest.mark.parametrize(
    "change",
    [
        moved,
        without_a_path,
        with_one_instead_of_another,
        lambda data: data.replace(b"<path ", b'<path transform="translate(1)" ', 1),
        lambda data: data.replace(b"<g ", b'<g transform="scale(2)" ', 1),
        lambda data: data.replace(b"<svg ", b'<svg transform="scale(2)" ', 1),
        lambda data: data.replace(b"<g ", b'<g style="transform:scale(2)" ', 1),
        lambda data: data.replace(b"</svg>", b"<style>path{transform:scale(2)}</style></svg>"),
        lambda data: data.replace(b"</svg>", b"<circle r='3'/></svg>"),
        lambda data: data.replace(b"</svg>", b"<path d='M0 0L1 1'/></svg>"),
        lambda data: data.replace(b"</svg>", b"<svg><path d='M0 0'/></svg></svg>"),
        lambda data: data.replace(b"</svg>", b"<text>a</text></svg>"),
        lambda data: data.replace(b'viewBox="0 0', b'viewBox="1 0'),
        lambda data: data.replace(b'width="48', b'width="96', 1),
        lambda data: data.replace(b"[100.0,", b"[101.0,", 1),
        lambda data: data.replace(b"Letter F", b"Letter G"),
        lambda data: re.sub(rb"<metadata>.*</metadata>", b"", data, flags=re.DOTALL),
        lambda data: data.replace(b"ninepoint:drawing", b"ninepoint:painting"),
        lambda data: data[: len(data) // 2],
        lambda data: b"",
        lambda data: b"\xff\xfe",
        lambda data: b'<!DOCTYPE svg [<!ENTITY a "b">]>' + data.partition(b"?>")[2],
    ],
)
def test_a_file_that_shows_something_else_gives_no_document(change):
    data = letter()
    assert change(data) != data
    assert embedded(change(data)) is None


def test_depth_is_no_danger():
    data = letter()
    deep = data.replace(b"</svg>", b"<g>" * 20_000 + b"</g>" * 20_000 + b"</svg>")
    assert embedded(deep) is not None


@given(st.data())
def test_no_flipped_byte_of_a_path_or_of_the_document_passes(data):
    whole = letter()
    place = data.draw(st.integers(0, len(whole) - 1))
    value = data.draw(st.integers(0, 255))
    flipped = whole[:place] + bytes([value]) + whole[place + 1 :]
    found = embedded(flipped)
    assert found is None or store.encode(found) == store.encode(letter_f())
