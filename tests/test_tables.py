import csv
import io
import json
import math

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.document import Curve, Document
from core.errors import NinepointError
from core.family import PRESETS, Parameters
from core.formats import points, tables
from core.formats.tables import CONTROL_COLUMNS, LIMIT_COLUMNS, Tables, cell, limit_rows
from core.profiles import Profile
from core.shape import curvatures, tangents
from drawings import documents, letter_f
from effort import costly
from independent import farthest

ROUGH = Parameters("3/10", "-1/2", "-1/3", "mirrored")


def profile_of(form="csv", entity="limit points", **fields):
    return Profile(name="test", title="Test", format=form, entity=entity, **fields)


def rows_of(data, separator=","):
    head, *lines = csv.reader(io.StringIO(data.decode()), delimiter=separator)
    return head, np.array([[float(field or "nan") for field in line] for line in lines])


@given(documents, st.sampled_from(["csv", "tsv"]))
def test_control_points_read_back_in_every_bit(document, form):
    content = Tables.of(document, profile_of(form, "control points"))
    head, rows = rows_of(tables.encode(content, ""), "," if form == "csv" else "\t")
    several = len(document.curves) > 1
    assert head == [*CONTROL_COLUMNS, *["curve"] * several]
    for number, curve in enumerate(document.curves, start=1):
        own = rows[rows[:, 2] == number, :2] if several else rows
        wanted = curve.points
        if curve.is_loop:
            wanted = np.concatenate([wanted, wanted[:1]])
        assert own.tobytes() == wanted.tobytes()


@pytest.mark.parametrize("form", ["csv", "tsv"])
@pytest.mark.parametrize("index", [0, 1])
def test_control_points_of_one_curve_open_again_as_they_were(tmp_path, form, index):
    curve = letter_f().curves[index]
    path = tmp_path / f"a.{form}"
    content = Tables.of(Document((curve,)), profile_of(form, "control points"))
    path.write_bytes(tables.encode(content, ""))
    (again,) = points.read(path).curves
    assert again.points.tobytes() == curve.points.tobytes()
    assert again.closed == curve.closed


@costly
@given(documents, st.sampled_from([0.1, 1.0]))
def test_the_polygon_through_limit_points_keeps_within_the_tolerance(document, tolerance):
    content = Tables.of(document, profile_of(tolerance_mm=tolerance))
    assert 0 <= content.deviation_mm <= tolerance
    for curve, found in zip(document.curves, content.points, strict=True):
        line = np.concatenate([found, found[:1]]) if curve.is_loop else found
        exact = curve.limit(document.parameters).points(9)
        assert farthest(exact, line) <= content.deviation_mm + 1e-9


def test_limit_rows_are_exact_points_tangents_and_curvature():
    limit = letter_f().curves[0].limit(PRESETS["Tight"])
    rows = limit_rows(limit, 3)
    assert rows[:, 0].tolist() == limit.parameters(3).tolist()
    assert rows[:, 1:3].tobytes() == np.ascontiguousarray(limit.points(3)).tobytes()
    assert np.array_equal(rows[:, 3:5], tangents(limit, 3))
    assert np.array_equal(rows[:, 5], curvatures(limit, 3), equal_nan=True)


def test_what_is_not_proven_stays_empty_and_is_told():
    content = Tables.of(letter_f().with_parameters(ROUGH), profile_of(tolerance_mm=5.0))
    assert content.notes == ("The tangents and curvature are left out: C^2 is not proven here.",)
    assert np.isnan(content.tables[0].rows[:, 3:]).all()
    lines = tables.encode(content, "").decode().splitlines()
    assert lines[1].endswith(",,,,1")
    smooth = Tables.of(letter_f(), profile_of())
    assert smooth.notes == () or "curvature" in smooth.notes[0]


@costly
@given(documents, st.sampled_from(["control points", "limit points"]))
def test_json_holds_the_same_numbers_and_the_names(document, entity):
    content = Tables.of(document, profile_of("json", entity, tolerance_mm=1.0))
    whole = json.loads(tables.encode(content, "title"))
    assert (whole["title"], whole["unit"]) == ("title", "mm")
    assert whole["columns"] == list(content.columns)
    for found, table in zip(whole["curves"], content.tables, strict=True):
        assert np.array_equal(np.array(found["rows"], dtype=float), table.rows, equal_nan=True)
        assert (found["closed"], found["name"]) == (table.curve.is_loop, table.curve.name)


def test_json_has_a_row_a_line_whatever_the_names_are():
    document = Document((Curve([(0, 1), (2, 3)], name='"rows":[[1],[2]] \ud800'),))
    content = Tables.of(document, profile_of("json", "control points"))
    data = tables.encode(content, "a],[b")
    assert b"[\n[0.0,1.0],\n[2.0,3.0]]" in data
    assert json.loads(data)["curves"][0]["name"] == '"rows":[[1],[2]] ?'


@pytest.mark.parametrize("entity", ["control points", "limit points"])
def test_inches_scale_lengths_derivatives_and_curvature_but_not_t(entity):
    metric, inch = (Tables.of(letter_f(), profile_of(entity=entity, unit=u)) for u in ("mm", "in"))
    factors = {"t": 1, "curvature": 25.4}
    for one, other in zip(metric.tables, inch.tables, strict=True):
        for k, column in enumerate(metric.columns):
            wanted = one.rows[:, k] * factors.get(column, 1 / 25.4)
            assert np.allclose(other.rows[:, k], wanted, rtol=1e-12, equal_nan=True)
    assert inch.size_mm == pytest.approx(metric.size_mm)


@pytest.mark.parametrize("entity", ["control points", "limit points"])
def test_the_corner_becomes_the_origin(entity):
    content = Tables.of(letter_f(), profile_of(entity=entity, origin="corner"))
    assert content.box[0].tolist() == [0, 0]
    placed = Tables.of(letter_f(), profile_of(entity=entity))
    assert np.allclose(content.box[1], placed.box[1] - placed.box[0])
    assert letter_f().curves[0].points[0].tolist() == [100, -30]


def test_the_document_is_not_changed():
    document = letter_f()
    Tables.of(document, profile_of(entity="control points", unit="in", origin="corner"))
    assert document.curves[0].points.tolist() == letter_f().curves[0].points.tolist()


def test_counts_and_columns():
    content = Tables.of(letter_f(), profile_of(entity="control points"))
    assert (content.count, content.closed, content.columns) == (14, 1, CONTROL_COLUMNS)
    assert Tables.of(letter_f(), profile_of()).columns == LIMIT_COLUMNS
    dots = Document((Curve([(1, 2)]), Curve([])))
    assert Tables.of(dots, profile_of()).count == 1


def test_nothing_and_too_much_are_refused(monkeypatch):
    for entity in ("control points", "limit points"):
        with pytest.raises(NinepointError, match="the drawing has no points"):
            Tables.of(Document((Curve([]),)), profile_of(entity=entity))
    monkeypatch.setattr(tables, "MAX_ROWS", 100)
    with pytest.raises(NinepointError, match="would be more than 100; choose a larger tolerance"):
        Tables.of(letter_f(), profile_of())


@given(st.floats(allow_infinity=False))
def test_a_cell_reads_back_as_its_number(value):
    assert cell(value) == "" if math.isnan(value) else float(cell(value)) == value


@pytest.mark.parametrize("form", ["csv", "tsv", "json"])
def test_the_same_drawing_gives_the_same_bytes(form):
    profile = msgspec.structs.replace(profile_of(), format=form)
    one, other = (tables.encode(Tables.of(letter_f(), profile), "a") for _ in range(2))
    assert one == other
