import errno
import os
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import store
from core.document import Curve, Document
from core.errors import FileError, NinepointError
from core.formats import (
    EXPORTED,
    MAX_TOLERANCE_MM,
    OPENED,
    ExportReport,
    export,
    open_document,
    survey,
)
from drawings import extents, letter_f


@pytest.fixture
def drawing(tmp_path):
    path = tmp_path / "letter.ninepoint"
    store.save(letter_f(), path)
    return path


def test_a_drawing_and_each_kind_of_point_file_are_opened_by_their_ending(tmp_path, drawing):
    assert [curve.name for curve in open_document(drawing).curves] == ["Letter F", "Stroke"]
    for suffix in (".csv", ".tsv", ".txt", ".dat", ".CSV", ".Dat"):
        path = tmp_path / f"points{suffix}"
        path.write_text("1 2\n3 4\n")
        assert open_document(path).curves[0].points.tolist() == [[1, 2], [3, 4]]


def test_the_caller_may_close_or_open_all_curves(tmp_path, drawing):
    points = tmp_path / "points.csv"
    points.write_text("0,0\n9,0\n9,9\n0,9\n")
    for path in (points, drawing):
        for closed in (True, False):
            assert {curve.closed for curve in open_document(path, closed).curves} == {closed}
    assert [curve.closed for curve in open_document(drawing).curves] == [True, False]


@pytest.mark.parametrize("name", ["a.svg", "a.json", "a", "a.csv.gz", "a."])
def test_other_endings_are_refused_with_those_that_can_be_opened(tmp_path, name):
    path = tmp_path / name
    path.write_text("1 2\n3 4\n")
    with pytest.raises(FileError) as caught:
        open_document(path)
    assert str(caught.value).startswith(f"{name}: ")
    for suffix in OPENED:
        assert suffix in str(caught.value)


@pytest.mark.parametrize("name", ["a.pdf", "a", "a.ninepoint"])
def test_other_endings_are_refused_with_those_that_can_be_exported(tmp_path, name):
    with pytest.raises(FileError) as caught:
        export(letter_f(), tmp_path / name)
    for suffix in EXPORTED:
        assert suffix in str(caught.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [*EXPORTED, ".SVG", ".Dxf"])
def test_the_report_tells_what_was_written(tmp_path, suffix):
    path = tmp_path / f"f{suffix}"
    report = export(letter_f(), path, 0.05)
    low, high = extents(letter_f())
    assert report.path == path
    assert (report.width_mm, report.height_mm) == pytest.approx(tuple(high - low), abs=0.1)
    assert (report.contours, report.closed_contours) == (2, 1)
    assert 0 < report.deviation <= 0.05
    written = path.read_bytes()
    vertices = re.findall(rb"[ML\n]L?[\d.]+ [\d.]+", written) or re.findall(rb"\n 10\n", written)
    assert suffix.lower() == ".dxf" or report.vertices == len(vertices)


@pytest.mark.parametrize(
    ("contours", "closed", "kind"),
    [
        (1, 1, "closed"),
        (1, 0, "open"),
        (3, 3, "3 closed contours"),
        (3, 0, "3 open contours"),
        (3, 2, "3 contours, 2 of them closed"),
    ],
)
def test_the_summary_is_one_line(tmp_path, contours, closed, kind):
    report = ExportReport(tmp_path, 200, 24.019, contours, closed, 1312, 0.00971)
    assert report.summary == f"200.00 x 24.02 mm, {kind}, 1,312 vertices, deviation <= 0.0098 mm"


@given(st.floats(1e-9, MAX_TOLERANCE_MM))
def test_the_deviation_in_the_summary_is_still_a_bound(deviation):
    summary = ExportReport("a", 1, 1, 1, 1, 2, deviation).summary
    shown = float(re.search(r"<= (\S+) mm", summary)[1])
    assert deviation * (1 - 1e-9) <= shown <= 1.11 * deviation


@pytest.mark.parametrize("tolerance", [0, -1, 1e-7, 101, float("nan"), float("inf")])
def test_tolerances_that_make_no_sense_are_refused(tmp_path, tolerance):
    with pytest.raises(NinepointError, match="tolerance must lie between 1e-06 and 100 mm"):
        export(letter_f(), tmp_path / "a.svg", tolerance)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", EXPORTED)
def test_a_refused_export_leaves_the_old_file(tmp_path, monkeypatch, suffix):
    path = tmp_path / f"old{suffix}"
    export(letter_f(), path)
    before = path.read_bytes()
    diverging = letter_f().with_parameters(type(letter_f().parameters)(100, 100, 100))
    for document in (Document(), Document((Curve([(1, 1)]),)), diverging):
        with pytest.raises(NinepointError):
            export(document, path)

    def no_space(file, data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "write", no_space)
    with pytest.raises(FileError, match="the disk is full"):
        export(letter_f((1.0, 1.0)), path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("suffix", EXPORTED)
def test_an_export_replaces_the_old_one_whole(tmp_path, suffix):
    path, fresh = tmp_path / f"a{suffix}", tmp_path / "fresh" / f"a{suffix}"
    fresh.parent.mkdir()
    export(letter_f((5.0, 5.0)), path, 0.001)
    export(letter_f(), path)
    export(letter_f(), fresh)
    assert path.read_bytes() == fresh.read_bytes()


@pytest.mark.parametrize("suffix", EXPORTED)
def test_a_survey_tells_what_an_export_would_write_and_writes_nothing(tmp_path, suffix):
    path = tmp_path / f"letter{suffix}"
    planned = survey(letter_f(), path, 0.02)
    assert list(tmp_path.iterdir()) == []
    assert export(letter_f(), path, 0.02) == planned
