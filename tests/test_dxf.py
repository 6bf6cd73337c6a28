import io
import subprocess
import sys
from pathlib import Path

import ezdxf
import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.document import Curve, Document
from core.errors import NinepointError
from core.family import PRESETS
from core.formats import dxf
from core.formats.contours import Contours
from core.formats.tables import Tables
from core.profiles import Profile, named
from drawings import documents, letter_f
from effort import costly
from independent import (
    chord_error,
    exact_points,
    farthest,
    seen_by_ezdxf,
    seen_by_gdal,
)

ROOT = Path(__file__).parent.parent
KINDS = {
    ("arcs", "R2000"): "LWPOLYLINE",
    ("polyline", "R2000"): "LWPOLYLINE",
    ("arcs", "R12"): "POLYLINE",
    ("polyline", "R12"): "POLYLINE",
    ("spline", "R2000"): "SPLINE",
    ("control points", "R2000"): "POINT",
    ("limit points", "R12"): "POINT",
}
coarse = st.sampled_from([0.1, 1.0])
OUTLINES = [kind for kind in KINDS if "points" not in kind[0]]


def profile_of(kind, **fields):
    entity, version = kind
    return Profile(
        name="test", title="Test", format="dxf", entity=entity, version=version, **fields
    )


def encoded(document, tolerance=0.01, name="laser", **fields):
    profile = msgspec.structs.replace(named(name).within(tolerance), **fields)
    return dxf.encode((Tables if profile.is_table else Contours).of(document, profile), "title")


def reread(data):
    drawing = ezdxf.read(io.StringIO(data.decode("ascii")))
    auditor = drawing.audit()
    assert auditor.errors == []
    assert auditor.fixes == []
    return drawing


@costly
@given(documents, coarse, st.sampled_from(OUTLINES), st.sampled_from(["mm", "in"]))
def test_ezdxf_sees_the_exact_curves_within_the_tolerance(document, tolerance, kind, unit):
    """Document, file, another reader, both ways: within what the file promises."""
    content = Contours.of(document, profile_of(kind, unit=unit, tolerance_mm=tolerance))
    factor = content.profile.unit_mm
    fine = 0.2 * tolerance
    found = seen_by_ezdxf(dxf.encode(content, ""), fine / factor)
    assert len(found) == len(content.contours)
    for (points, closed, _), contour in zip(found, content.contours, strict=True):
        assert closed == contour.closed == contour.curve.is_loop
        line = points * factor
        if closed and (line[0] != line[-1]).any():
            line = np.concatenate([line, line[:1]])
        exact = exact_points(contour.curve, document.parameters)
        reach = contour.shape.deviation + fine
        assert farthest(exact, line) <= reach
        assert farthest(line, exact) <= reach + chord_error(exact)


@costly
@given(documents, st.sampled_from(OUTLINES))
def test_gdal_sees_the_exact_curves(tmp_path_factory, document, kind):
    content = Contours.of(document, profile_of(kind, tolerance_mm=0.1))
    path = tmp_path_factory.mktemp("gdal") / "a.dxf"
    path.write_bytes(dxf.encode(content, ""))
    found = seen_by_gdal(path)
    assert len(found) == len(content.contours)
    for (points, closed, layer), contour in zip(found, content.contours, strict=True):
        assert layer == contour.layer
        if contour.closed:
            assert closed or np.hypot(*(points[0] - points[-1])) < 1e-9
        exact = exact_points(contour.curve, document.parameters)
        assert farthest(points, exact) <= contour.shape.deviation + chord_error(exact) + 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_of_entity_is_what_was_asked_for(kind):
    content = profile_of(kind)
    made = (Tables if content.is_table else Contours).of(letter_f(), content)
    drawing = reread(dxf.encode(made, ""))
    assert {entity.dxftype() for entity in drawing.modelspace()} == {KINDS[kind]}
    assert drawing.dxfversion == {"R2000": "AC1015", "R12": "AC1009"}[kind[1]]


@costly
@given(documents)
def test_lwpolylines_have_the_very_vertices_and_bulges(document):
    for entity in ("arcs", "polyline"):
        content = Contours.of(document, profile_of((entity, "R2000"), tolerance_mm=0.1))
        drawing = reread(dxf.encode(content, ""))
        for found, contour in zip(drawing.modelspace(), content.contours, strict=True):
            vertices = np.array(found.get_points("xyb"))
            assert vertices[:, :2].tobytes() == contour.shape.points.tobytes()
            bulges = getattr(contour.shape, "bulges", np.zeros(len(vertices)))
            assert vertices[:, 2].tolist() == bulges.tolist()
            assert found.closed == contour.closed


@costly
@given(documents)
def test_splines_are_clamped_with_simple_inner_knots_and_close_in_every_bit(document):
    content = Contours.of(document, profile_of(("spline", "R2000"), tolerance_mm=0.1))
    drawing = reread(dxf.encode(content, ""))
    for found, contour in zip(drawing.modelspace(), content.contours, strict=True):
        assert found.dxf.flags == 8
        assert found.dxf.degree == 3
        assert not found.closed
        assert len(found.fit_points) == 0
        knots = np.array(found.knots)
        assert (knots[:4] == knots[0]).all()
        assert (knots[-4:] == knots[-1]).all()
        assert (np.diff(knots[3:-3]) > 0).all()
        controls = np.array(found.control_points)[:, :2]
        assert controls.tobytes() == contour.shape.controls.tobytes()
        assert (controls[0].tobytes() == controls[-1].tobytes()) >= contour.closed


@pytest.mark.parametrize("kind", OUTLINES)
def test_y_is_up_and_nothing_is_mirrored(kind):
    content = Contours.of(letter_f((0.0, 0.0)), profile_of(kind))
    (points, closed, _), (_, stroke_closed, _) = seen_by_ezdxf(dxf.encode(content, ""), 0.01)
    assert closed
    assert not stroke_closed
    # The arms of the F reach to the right at the top, where its foot has nothing.
    foot, top = points[points[:, 1] < 10], points[points[:, 1] > 40]
    assert foot[:, 0].max() < 20 < top[:, 0].max()


@pytest.mark.parametrize(("unit", "marks"), [("mm", (4, 1)), ("in", (1, 0))])
def test_both_headers_say_the_unit_and_readers_find_what_they_need(unit, marks):
    drawing = reread(encoded(letter_f(), unit=unit))
    assert (drawing.header["$INSUNITS"], drawing.header["$MEASUREMENT"]) == marks
    assert "$PDMODE" not in drawing.header
    assert drawing.header["$PSVPSCALE"] == 1


def test_r12_states_no_unit_has_no_handles_and_says_nothing_on_the_way(caplog, capfd):
    data = encoded(letter_f(), name="laser-r12")
    assert b"$INSUNITS" not in data
    assert b"$MEASUREMENT" not in data
    assert b"\n  5\n" not in data.partition(b"ENTITIES")[2]
    assert b"$PDMODE" not in data
    assert not caplog.records
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("origin", ["drawing", "corner"])
def test_the_extents_are_written_also_if_a_corner_is_the_origin(kind, origin):
    # ezdxf takes the null vector for no extent at all.
    document = Document((Curve([(0, 0), (30, 40)]),))
    profile = profile_of(kind, origin=origin)
    content = (Tables if profile.is_table else Contours).of(document, profile)
    drawing = reread(dxf.encode(content, ""))
    assert np.allclose(drawing.header["$EXTMIN"], (0, 0, 0), atol=1e-6)
    assert np.allclose(drawing.header["$EXTMAX"], (30, 40, 0), atol=1e-6)


def test_layers_are_declared_with_the_colour():
    data = encoded(letter_f(), layers="by curve", colour="#ff0000")
    drawing = reread(data)
    assert [entity.dxf.layer for entity in drawing.modelspace()] == ["LETTER_F", "STROKE"]
    assert {drawing.layers.get(name).color for name in ("LETTER_F", "STROKE")} == {1}


@pytest.mark.parametrize(
    ("colour", "index"),
    [("#000000", 7), ("#ff0000", 1), ("#00ff00", 3), ("#0000ff", 5), ("#fe0102", 1)],
)
def test_a_colour_is_the_nearest_of_the_index(colour, index):
    assert dxf.colour_index(colour) == index


def test_the_first_view_shows_the_whole_drawing():
    drawing = reread(encoded(letter_f()))
    (view,) = drawing.viewports.get("*Active")
    low, high = (np.array(drawing.header[name])[:2] for name in ("$EXTMIN", "$EXTMAX"))
    assert np.allclose(tuple(view.dxf.center)[:2], (low + high) / 2)
    assert view.dxf.height > (high - low).max()


@pytest.mark.parametrize("name", ["laser", "laser-r12", "cad"])
def test_the_same_drawing_gives_the_same_bytes_also_in_another_process(name):
    script = (
        "import sys; from test_dxf import encoded, letter_f;"
        f"sys.stdout.buffer.write(encoded(letter_f(), name={name!r}))"
    )
    other = subprocess.run(
        [sys.executable, "-c", script],
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}", "PYTHONHASHSEED": "7"},
        capture_output=True,
        check=True,
    )
    assert encoded(letter_f(), name=name) == other.stdout
    assert not ezdxf.options.write_fixed_meta_data_for_testing


def test_ezdxf_is_not_imported_before_a_dxf_file_is_written():
    script = "import sys, core.formats; sys.exit('ezdxf' in sys.modules)"
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True)


def test_coordinates_of_any_size_keep_all_their_digits():
    document = Document((Curve([(1e9 / 3, -1e9 / 7), (1e9, 1e-5), (5.5, 1e8 + 0.1)]),))
    content = Contours.of(document, profile_of(("polyline", "R2000"), tolerance_mm=100.0))
    (found,) = reread(dxf.encode(content, "")).modelspace()
    (contour,) = content.contours
    assert np.array(found.get_points("xy")).tobytes() == contour.shape.points.tobytes()


def test_points_are_those_of_the_table():
    profile = profile_of(("limit points", "R2000"), unit="in", layers="by curve")
    content = Tables.of(letter_f().with_parameters(PRESETS["Tight"]), profile)
    drawing = reread(dxf.encode(content, ""))
    found = np.array([tuple(point.dxf.location)[:2] for point in drawing.modelspace()])
    assert found.tolist() == np.concatenate(content.points).tolist()
    layers = [point.dxf.layer for point in drawing.modelspace()]
    assert layers.count("LETTER_F") == len(content.points[0])


@pytest.mark.parametrize(
    ("limit", "fields"), [("MAX_VERTICES", {}), ("MAX_POINTS", {"entity": "limit points"})]
)
def test_too_many_vertices_or_points_are_refused(monkeypatch, limit, fields):
    monkeypatch.setattr(dxf, limit, 20)
    with pytest.raises(NinepointError, match="at most 20 are written"):
        encoded(letter_f(), **fields)
