import re
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from core.document import Document
from core.errors import FileError
from core.family import PRESETS
from core.formats import dxf, svg, tables
from core.formats.contours import Contours
from core.formats.tables import Tables
from core.formats.verify import verify
from core.profiles import PROFILES, named
from drawings import letter_f

WRITTEN = [name for name, profile in PROFILES.items() if profile.format not in ("pdf", "png")]
PATH = Path("a.file")


def made(name, document=None, **fields):
    profile = msgspec.structs.replace(named(name), **fields)
    document = document or letter_f()
    content = (Tables if profile.is_table else Contours).of(document, profile)
    encoder = {"dxf": dxf, "svg": svg}.get(profile.format, tables)
    return encoder.encode(content, "title"), content


def refused(data, content, words):
    with pytest.raises(FileError, match=r"read back, the file is not the drawing: ") as told:
        verify(data, content, PATH)
    assert words in str(told.value)
    assert str(told.value).endswith("Nothing was written.")


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("unit", ["mm", "in"])
@pytest.mark.parametrize("origin", ["drawing", "corner"])
def test_what_is_written_passes(name, unit, origin):
    verify(*made(name, unit=unit, origin=origin), PATH)


@pytest.mark.parametrize("name", WRITTEN)
def test_a_digit_that_is_another_is_found(name):
    """The last digit of a coordinate before the point is changed: it moves by five units."""
    data, content = made(name)
    mark = {"dxf": rb" [12]0\n-?\d*(\d)\.", "svg": rb"(?<=[ MLC])-?\d*(\d)\."}
    number = re.compile(mark.get(content.profile.format, rb",-?\d*(\d)\."))
    first = max(data.find(b"ENTITIES"), data.find(b"</metadata>"), 0)
    if content.profile.format == "dxf" and content.profile.version == "R12":
        first = data.find(b"VERTEX")
    last = data.find(b"OBJECTS") if b"OBJECTS" in data else len(data)
    places = [found.start(1) for found in number.finditer(data, first, last)]
    for place in np.random.default_rng(3).choice(places, 12):
        digit = bytes([48 + (data[place] - 48 + 5) % 10])
        with pytest.raises(FileError, match="read back"):
            verify(data[:place] + digit + data[place + 1 :], content, PATH)


@pytest.mark.parametrize("name", WRITTEN)
def test_a_file_of_another_drawing_is_refused(name):
    other, _ = made(name, letter_f().with_parameters(PRESETS["Tight"]))
    _, content = made(name)
    with pytest.raises(FileError, match="read back"):
        verify(other, content, PATH)


@pytest.mark.parametrize("name", ["laser", "laser-r12", "cad", "svg", "svg-polyline"])
def test_a_curve_left_out_is_found(name):
    data, _ = made(name, Document(letter_f().curves[:1]))
    _, content = made(name)
    with pytest.raises(FileError, match=r"instead of|another size"):
        verify(data, content, PATH)


@pytest.mark.parametrize(
    ("name", "before", "after", "words"),
    [
        ("laser", b" 70\n1\n 10", b" 70\n0\n 10", "is open in it"),
        ("laser", b"$INSUNITS\n 70\n4", b"$INSUNITS\n 70\n1", "its unit is not stated"),
        ("laser", b"$MEASUREMENT\n 70\n1", b"$MEASUREMENT\n 70\n0", "its unit is not stated"),
        ("laser", b"AcDbEntity\n  8\nCURVES", b"AcDbEntity\n  8\n0", "is on another layer"),
        ("laser", b"AcDbPolyline\n 90\n5", b"AcDbPolyline\n 90\n6", "says that it"),
        ("laser-r12", b"30\n0.0\n 70\n1\n", b"30\n0.0\n 70\n0\n", "is open in it"),
        ("laser", b"SECTION", b"SECTIOM", "ezdxf"),
        ("svg", b"Z\"", b"\"", "is open in it"),
        ("svg-polyline", b"Z\"", b"\"", "is open in it"),
        ("svg", b'height="50mm"', b'height="50in"', "its page has a scale"),
        ("svg", b'"50mm" viewBox', b'"50" viewBox', "its page has"),
        ("svg", b'<g id="STROKE"', b'<g id="S"', "is on another layer"),
        ("svg", b"</svg>", b"", "it is no XML"),
        ("svg", b"<g id", b'<g transform="scale(2)" id', "transform"),
        ("points", b"t,x,y", b"t,y,x", "columns have other names"),
        ("points", b",1\n", b",2\n", "its numbers are others"),
    ],
)
def test_each_kind_of_fault_is_named(name, before, after, words):
    data, content = made(name)
    if before == b"AcDbPolyline\n 90\n5":
        before = re.search(rb"AcDbPolyline\n 90\n\d+", data)[0]
        after = before + b"1"
    if b"viewBox" in before:
        data = data.replace(b'mm"\n     viewBox', b'mm" viewBox')
    assert before in data
    refused(data.replace(before, after, 1), content, words)


def test_a_promise_that_is_not_kept_is_found():
    data, content = made("laser")
    tight = tuple(
        replace(contour, shape=replace(contour.shape, deviation=contour.shape.deviation / 3))
        for contour in content.contours
    )
    false = replace(content, contours=tight)
    refused(data, false, "is further from the exact curve than stated")


def test_a_contour_that_was_cut_is_joined_again(monkeypatch):
    monkeypatch.setattr(svg, "MAX_PATH_BYTES", 400)
    for name in ("svg", "svg-polyline"):
        data, content = made(name)
        assert max(svg.path_counts(content)) > 1
        verify(data, content, PATH)
        cut = re.search(rb'd="(M\S+ \S+)', data[data.find(b'd="M') + 9 :])
        refused(data.replace(cut[1], b"M1.5 2.5"), content, "a contour that was cut has a gap")
