import gzip

import numpy as np
import pytest

from core import atomic
from core.errors import FileError, NinepointError
from core.family import PRESETS
from core.formats import foreign
from core.formats.outlines import straight
from core.formats.sketch import UNITS_MM, Sketch, Trace
from damage import damaged, dxf, svg

FILES = 2000
"""Damaged files of each kind in each run; `tests/acceptance/test_damaged_files.py` reads as many
as one likes."""


@pytest.fixture
def write(tmp_path):
    def write(name, data):
        path = tmp_path / name
        path.write_bytes(data)
        return path

    return write


@pytest.fixture
def refusal(write):
    def refusal(name, data):
        with pytest.raises(FileError) as caught:
            foreign.read_sketch(write(name, data))
        return str(caught.value).removeprefix(name)

    return refusal


def polyline(points, closed, name="", layer=""):
    points = np.array(points, dtype=float)
    ends = np.roll(points, -1, axis=0) if closed else points[1:]
    return Trace(straight(points[: len(ends)], ends), closed, name, layer)


def assert_sound(sketch):
    """What the contract of `Sketch` promises."""
    assert sketch.traces
    assert sketch.unit in UNITS_MM
    for trace in sketch.traces:
        controls = trace.controls
        assert controls.ndim == 3
        assert controls.shape[1:] == (4, 2)
        assert len(controls) >= 1
        assert np.isfinite(controls).all()
        assert np.abs(controls).max() <= 1.0001e9
        assert (controls[1:, 0] == controls[:-1, 3]).all()
        assert not trace.closed or (controls[-1, 3] == controls[0, 0]).all()
        assert 0 <= trace.deviation < np.inf
    for note in sketch.notes:
        assert note.endswith(".")


def assert_sound_or_refused(path):
    """Whether the file is refused; nothing but a `FileError` may come out."""
    try:
        sketch = foreign.read_sketch(path)
    except FileError as error:
        sentence = str(error)
    else:
        assert_sound(sketch)
        return False
    assert sentence.startswith(path.name)
    assert sentence.endswith(".")
    return True


@pytest.mark.parametrize("name", ["a.svg", "a.dxf", "a", "a.SVG"])
def test_a_file_is_read_as_what_it_is_not_as_what_it_is_called(write, name):
    assert len(foreign.read_sketch(write(name, svg(1))).traces) == 8
    assert foreign.read_sketch(write(name, dxf(1))).traces


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-be"])
def test_an_svg_in_another_encoding_is_known(write, encoding):
    text = '<svg xmlns="http://www.w3.org/2000/svg"><line x2="4"/></svg>'
    mark = b"\xfe\xff" if encoding == "utf-16-be" else b""
    assert foreign.read_sketch(write("a.svg", mark + text.encode(encoding))).traces


def test_a_compressed_svg_is_expanded(write):
    path = write("a.svgz", gzip.compress(svg(1)))
    assert len(foreign.read_sketch(path).traces) == 8


def test_a_compressed_bomb_is_refused(refusal, monkeypatch):
    monkeypatch.setattr(atomic, "MAX_BYTES", 1_000_000)
    message = refusal("a.svgz", gzip.compress(b" " * 20_000_000))
    assert message == ": it expands to more than 1 MB."


@pytest.mark.parametrize("cut", [3, 12, 100])
def test_a_compressed_file_that_is_cut_off_is_refused(refusal, cut):
    message = refusal("a.svgz", gzip.compress(svg(1))[:cut])
    assert message == ": its compression is damaged; the file may be cut off."


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", ": the file is empty."),
        (b"\n \t", ": the file is empty."),
        (b"%PDF-1.7 ", ": it is a PDF; SVG and DXF can be read."),
        (b"\x89PNG\r\n\x1a\n", ": it is a PNG picture; SVG and DXF can be read."),
        (b"PK\x03\x04", ": it is a ZIP archive; unpack it first; SVG and DXF can be read."),
        (b"AC1027\0\0", ": it is a DWG, which only CAD programs read; save it as a DXF."),
        (b"x,y\n1,2\n", ", line 1: it is no DXF: it does not begin with a group code."),
        (b"<html><body/></html>", ": it is no SVG drawing: its outermost element is <html>."),
    ],
)
@pytest.mark.parametrize("name", ["a.svg", "a.dxf"])
def test_what_is_neither_is_refused_in_a_sentence(refusal, name, data, message):
    assert refusal(name, data) == message


def test_a_missing_file_or_a_folder_is_refused(tmp_path):
    for path in (tmp_path, tmp_path / "none.svg"):
        with pytest.raises(FileError):
            foreign.read_sketch(path)


@pytest.mark.parametrize("make", [svg, dxf])
@pytest.mark.parametrize("part", range(4))
def test_damaged_files_are_read_soundly_or_refused(write, make, part):
    name = f"drawing.{make.__name__}"
    for seed in range(part * FILES // 4, (part + 1) * FILES // 4):
        path = write(name, damaged(make(seed % 20), seed))
        assert_sound_or_refused(path)


@pytest.mark.parametrize("make", [svg, dxf])
@pytest.mark.parametrize("seed", range(10))
def test_whole_files_are_read_soundly(write, make, seed):
    assert_sound(foreign.read_sketch(write("a", make(seed))))


def test_vertices_become_control_polygons():
    sketch = Sketch(
        (
            polyline([(0, 0), (4, 0), (4, 3)], True, "triangle"),
            polyline([(0, 0), (1, 1), (2, 0), (9, 9)], False, "", "Cut"),
            polyline([(5, 5), (6, 6)], False, "", "0"),
        ),
        "mm",
        True,
    )
    document = foreign.polygons(sketch)
    assert document.parameters == PRESETS["Calm"]
    assert [curve.name for curve in document.curves] == ["triangle", "Cut", "Curve 3"]
    assert [curve.closed for curve in document.curves] == [True, False, False]
    assert document.curves[0].points.tolist() == [[0, 0], [4, 0], [4, 3]]
    assert document.curves[1].points.tolist() == [[0, 0], [1, 1], [2, 0], [9, 9]]


def test_too_many_vertices_are_refused_in_a_sentence(monkeypatch):
    monkeypatch.setattr(foreign, "MAX_POINTS", 3)
    with pytest.raises(NinepointError, match="4 vertices; at most 3"):
        foreign.polygons(Sketch((polyline([(0, 0), (1, 1), (2, 0), (9, 9)], False),), "mm", True))


def test_a_unit_that_makes_a_drawing_too_large_is_refused():
    sketch = Sketch((polyline([(0, 0), (5e8, 0)], False),), "mm", False)
    with pytest.raises(NinepointError, match="Choose a smaller unit"):
        foreign.polygons(sketch.in_unit("m"))
