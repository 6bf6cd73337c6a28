import errno
import json
import os
import re

import msgspec
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
    PROFILES,
    ExportReport,
    export,
    named,
    open_document,
    prepare,
    profile_for,
    register,
    survey,
)
from drawings import extents, letter_f

WRITTEN = [profile for profile in PROFILES.values() if profile.suffix in EXPORTED]


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


@pytest.mark.parametrize("name", ["a.pdf", "a.xml", "a", "a.csv.gz", "a."])
def test_other_endings_are_refused_with_those_that_can_be_opened(tmp_path, name):
    path = tmp_path / name
    path.write_text("1 2\n3 4\n")
    with pytest.raises(FileError) as caught:
        open_document(path)
    assert str(caught.value).startswith(f"{name}: ")
    for suffix in OPENED:
        assert suffix in str(caught.value)


@pytest.mark.parametrize("name", ["a.xyz", "a", "a.ninepoint"])
def test_other_endings_are_refused_with_those_that_can_be_exported(tmp_path, name):
    for run in (profile_for, lambda path: export(letter_f(), path, named("laser"))):
        with pytest.raises(FileError) as caught:
            run(tmp_path / name)
        for suffix in EXPORTED:
            assert suffix in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_file_has_the_suffix_of_its_profile(tmp_path):
    with pytest.raises(FileError, match=r"a\.svg: files of the profile CAD end in \.dxf\."):
        export(letter_f(), tmp_path / "a.svg", named("cad"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("suffix", "name", "entity"),
    [
        (".dxf", "laser", "arcs"),
        (".SVG", "svg", "cubics"),
        (".csv", "points", "limit points"),
        (".tsv", "points", "limit points"),
        (".Json", "points", "limit points"),
    ],
)
def test_a_suffix_alone_stands_for_a_profile(suffix, name, entity):
    profile = profile_for(f"a{suffix}")
    assert (profile.name, profile.entity, profile.suffix) == (name, entity, suffix.lower())


@pytest.mark.parametrize("profile", WRITTEN, ids=lambda profile: profile.name)
def test_the_report_tells_what_was_written(tmp_path, profile):
    path = tmp_path / f"f{profile.suffix.upper()}"
    report = export(letter_f(), path, profile.within(0.05))
    low, high = extents(letter_f())
    assert (report.path, report.profile) == (path, profile.within(0.05))
    assert (report.width_mm, report.height_mm) == pytest.approx(tuple(high - low), abs=0.1)
    assert (report.contours, report.closed_contours) == (2, 1)
    assert 0 < report.deviation <= 0.05
    assert report.entities == prepare(letter_f(), profile.within(0.05)).count
    assert path.stat().st_size > 0


def reported(profile, contours, closed, count=1312, notes=()):
    return ExportReport(
        "a", profile, 200, 24.019, contours, closed, count, 0.00971, notes
    )  # fmt: skip


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
def test_the_summary_is_one_line(contours, closed, kind):
    summary = reported(named("laser"), contours, closed).summary
    assert summary == f"200.00 x 24.02 mm, {kind}, 1,312 arcs, deviation <= 0.0098 mm"


@pytest.mark.parametrize(
    ("name", "one", "many"),
    [
        ("laser", "1 arc", "2 arcs"),
        ("laser-r12", "1 vertex", "2 vertices"),
        ("cad", "1 spline piece", "2 spline pieces"),
        ("svg", "1 cubic", "2 cubics"),
        ("points", "1 point", "2 points"),
    ],
)
def test_the_summary_names_what_is_counted(name, one, many):
    for count, words in ((1, one), (2, many)):
        assert f", {words}, deviation" in reported(named(name), 1, 1, count).summary


def test_control_points_have_no_deviation():
    profile = msgspec.structs.replace(named("points"), entity="control points")
    assert survey(letter_f(), profile).summary == (
        "50.00 x 50.00 mm, 2 contours, 1 of them closed, 14 control points"
    )


@given(st.floats(1e-9, MAX_TOLERANCE_MM))
def test_the_deviation_in_the_summary_is_still_a_bound(deviation):
    summary = ExportReport("a", named("svg"), 1, 1, 1, 1, 2, deviation).summary
    shown = float(re.search(r"<= (\S+) mm", summary)[1])
    assert deviation * (1 - 1e-9) <= shown <= 1.11 * deviation


def test_r12_has_a_note_on_its_unit_and_a_cut_contour_one_on_its_paths(monkeypatch):
    (note,) = survey(letter_f(), named("laser-r12")).notes
    assert note == "DXF R12 states no unit: tell the program that it is mm."
    assert survey(letter_f(), named("laser")).notes == ()
    monkeypatch.setattr("core.formats.svg.MAX_PATH_BYTES", 1000)
    notes = survey(letter_f(), named("svg-polyline")).notes
    assert notes[0].startswith("'Letter F' is cut into 3 open paths that join")


@pytest.mark.parametrize("profile", WRITTEN, ids=lambda profile: profile.name)
def test_a_refused_export_leaves_the_old_file(tmp_path, monkeypatch, profile):
    path = tmp_path / f"old{profile.suffix}"
    export(letter_f(), path, profile)
    before = path.read_bytes()
    diverging = letter_f().with_parameters(type(letter_f().parameters)(100, 100, 100))
    for document in (Document(), Document((Curve([]),)), diverging):
        with pytest.raises(NinepointError):
            export(document, path, profile)

    def no_space(file, data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "write", no_space)
    with pytest.raises(FileError, match="the disk is full"):
        export(letter_f((1.0, 1.0)), path, profile)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("profile", WRITTEN, ids=lambda profile: profile.name)
def test_a_file_that_does_not_read_back_is_never_written(tmp_path, monkeypatch, profile):
    path = tmp_path / f"old{profile.suffix}"
    export(letter_f(), path, profile)
    before = path.read_bytes()
    other = prepare(Document((letter_f().curves[1],) * 2), profile)
    monkeypatch.setattr("core.formats.prepare", lambda document, profile: other)
    for module in ("dxf", "svg", "tables"):
        monkeypatch.setattr(f"core.formats.{module}.encode", lambda content, title: before)
    encoders = dict.fromkeys(("dxf", "svg", "pdf"), lambda content, title: before)
    monkeypatch.setattr("core.formats._ENCODERS", encoders)
    with pytest.raises(FileError, match="read back, the file is not the drawing"):
        export(letter_f(), path, profile)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("profile", WRITTEN, ids=lambda profile: profile.name)
def test_an_export_replaces_the_old_one_whole(tmp_path, profile):
    path, fresh = tmp_path / f"a{profile.suffix}", tmp_path / "fresh" / f"a{profile.suffix}"
    fresh.parent.mkdir()
    export(letter_f((5.0, 5.0)), path, profile.within(0.001))
    export(letter_f(), path, profile)
    export(letter_f(), fresh, profile)
    assert path.read_bytes() == fresh.read_bytes()


@pytest.mark.parametrize("profile", WRITTEN, ids=lambda profile: profile.name)
def test_a_survey_tells_what_an_export_would_write_and_writes_nothing(tmp_path, profile):
    path = tmp_path / f"letter{profile.suffix}"
    planned = survey(letter_f(), profile.within(0.02), path)
    assert list(tmp_path.iterdir()) == []
    assert export(letter_f(), path, profile.within(0.02)) == planned


def test_a_format_of_the_window_is_written_once_it_is_registered(tmp_path, monkeypatch):
    monkeypatch.setattr("core.formats._ENCODERS", {})
    path = tmp_path / "f.png"
    with pytest.raises(FileError, match="PNG can only be written with the window"):
        export(letter_f(), path, named("png"))
    register("png", lambda contours, title: f"{title} {contours.profile.name}".encode())
    assert profile_for(path) == named("png")
    assert export(letter_f(), path, named("png")).closed_contours == 1
    assert path.read_bytes() == b"f png"
    with pytest.raises(ValueError, match="no format 'gcode'"):
        register("gcode", lambda contours, title: b"")


def test_a_json_table_is_json(tmp_path):
    path = tmp_path / "a.json"
    export(letter_f(), path, profile_for(path))
    whole = json.loads(path.read_bytes())
    assert [curve["name"] for curve in whole["curves"]] == ["Letter F", "Stroke"]
