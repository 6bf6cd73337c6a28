import io
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import given, settings

from core.document import Curve, Document
from core.errors import NinepointError
from core.formats import dxf
from core.formats.contours import Contours
from drawings import documents, extents, letter_f, tolerances

ROOT = Path(__file__).parent.parent


def encoded(document, tolerance=0.01):
    return dxf.encode(Contours.of(document, tolerance, dxf.GUARD_DIGITS), "title")


def reread(data):
    drawing = ezdxf.read(io.StringIO(data.decode("ascii")))
    auditor = drawing.audit()
    assert auditor.errors == []
    assert auditor.fixes == []
    return drawing


def contours(drawing):
    """Points, closed flag and layer of all entities, which are polylines without bulges."""
    found = []
    for entity in drawing.modelspace():
        assert entity.dxftype() == "LWPOLYLINE"
        vertices = np.array(entity.get_points("xyseb"))
        assert (vertices[:, 2:] == 0).all()
        found.append((vertices[:, :2], entity.closed, entity.dxf.layer))
    return found


@settings(max_examples=40)
@given(documents, tolerances)
def test_the_file_holds_the_very_vertices_and_the_extents_of_the_curves(document, tolerance):
    flat = Contours.of(document, tolerance, dxf.GUARD_DIGITS)
    drawing = reread(dxf.encode(flat, ""))
    found = contours(drawing)
    for (points, closed, _), line in zip(found, flat.polylines, strict=True):
        assert points.tobytes() == line.points.tobytes()
        assert closed == line.closed
    points = np.concatenate([points for points, _, _ in found])
    low, high = extents(document)
    assert np.abs(points.min(axis=0) - low).max() <= tolerance
    assert np.abs(points.max(axis=0) - high).max() <= tolerance
    assert np.array_equal(drawing.header["$EXTMIN"][:2], points.min(axis=0))
    assert np.array_equal(drawing.header["$EXTMAX"][:2], points.max(axis=0))


def test_y_is_up_and_nothing_is_mirrored():
    (points, closed, _), (_, stroke_closed, _) = contours(reread(encoded(letter_f((0.0, 0.0)))))
    assert closed
    assert not stroke_closed
    # The arms of the F reach to the right at the top, where its foot has nothing.
    foot, top = points[points[:, 1] < 10], points[points[:, 1] > 40]
    assert foot[:, 0].max() < 20 < top[:, 0].max()


def test_both_headers_say_millimetres_and_readers_find_what_they_need():
    drawing = reread(encoded(letter_f()))
    assert drawing.dxfversion == "AC1015"
    assert drawing.header["$INSUNITS"] == 4
    assert drawing.header["$MEASUREMENT"] == 1
    assert "$PDMODE" not in drawing.header
    assert drawing.header["$PSVPSCALE"] == 1


def test_a_corner_at_the_origin_is_written_as_extent():
    # ezdxf takes the null vector for no extent at all.
    drawing = reread(encoded(Document((Curve([(0, 0), (30, 40)]),))))
    assert tuple(drawing.header["$EXTMIN"]) == (0, 0, 0)
    assert tuple(drawing.header["$EXTMAX"]) == (30, 40, 0)


def test_the_layer_of_all_contours_is_declared():
    drawing = reread(encoded(letter_f()))
    assert {layer for _, _, layer in contours(drawing)} == {dxf.LAYER}
    assert drawing.layers.get(dxf.LAYER).color == dxf.COLOUR


def test_the_first_vertex_is_not_repeated():
    (points, closed, _), _ = contours(reread(encoded(letter_f())))
    assert closed
    assert points[0].tolist() != points[-1].tolist()


def test_the_first_view_shows_the_whole_drawing():
    drawing = reread(encoded(letter_f()))
    (view,) = drawing.viewports.get("*Active")
    low, high = (np.array(drawing.header[name])[:2] for name in ("$EXTMIN", "$EXTMAX"))
    assert np.allclose(tuple(view.dxf.center)[:2], (low + high) / 2)
    assert view.dxf.height > (high - low).max()


def test_the_same_drawing_gives_the_same_bytes_also_in_another_process():
    script = (
        "import sys; from test_dxf import encoded, letter_f;"
        "sys.stdout.buffer.write(encoded(letter_f()))"
    )
    other = subprocess.run(
        [sys.executable, "-c", script],
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}", "PYTHONHASHSEED": "7"},
        capture_output=True,
        check=True,
    )
    assert encoded(letter_f()) == other.stdout
    assert not ezdxf.options.write_fixed_meta_data_for_testing


def test_ezdxf_is_not_imported_before_a_dxf_file_is_written():
    script = "import sys, core.formats; sys.exit('ezdxf' in sys.modules)"
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True)


def test_coordinates_of_any_size_keep_all_their_digits():
    document = Document((Curve([(1e9 / 3, -1e9 / 7), (1e9, 1e-5), (5.5, 1e8 + 0.1)]),))
    flat = Contours.of(document, 100.0, dxf.GUARD_DIGITS)
    ((points, _, _),) = contours(reread(dxf.encode(flat, "")))
    assert points.tobytes() == flat.polylines[0].points.tobytes()


def test_too_many_vertices_are_refused(monkeypatch):
    monkeypatch.setattr(dxf, "MAX_VERTICES", 100)
    with pytest.raises(NinepointError, match="at most 100 are written"):
        encoded(letter_f())
