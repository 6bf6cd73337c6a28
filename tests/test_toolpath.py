"""Tools along curves: what becomes of them, and what is said about it."""

import msgspec
import numpy as np
import pytest
from hypothesis import given

from core.document import Curve, Document
from core.errors import FileError, NinepointError
from core.formats import dxf, export
from core.formats.contours import Contours
from core.formats.verify import verify
from core.profiles import PROFILES, named
from drawings import documents, letter_f
from effort import costly

PLATE = Curve([(0, 0), (100, 0), (100, 60), (0, 60)], name="Plate")
HOLE = Curve([(40, 20), (60, 20), (60, 40), (40, 40)], name="Hole")


def cut(*curves, kerf=1.0, name="laser", **fields):
    profile = msgspec.structs.replace(named(name), kerf_mm=kerf, **fields)
    return Contours.of(Document(curves), profile)


@costly
@given(documents)
def test_files_of_any_closed_drawing_read_back_as_its_offset(tmp_path_factory, document):
    folder = tmp_path_factory.mktemp("cut")
    closed = Document(
        tuple(Curve(curve.points, True) for curve in document.curves if curve.count > 2),
        document.parameters,
    )
    profile = msgspec.structs.replace(named("laser"), kerf_mm=0.2, tolerance_mm=0.05)
    try:
        report = export(closed, folder / "a.dxf", profile)
    except NinepointError as error:
        sayings = ("nothing is left", "nothing to export", "lie on each other")
        if not any(words in str(error) for words in sayings):
            raise
        return
    assert report.deviation <= 0.05
    assert report.closed_contours == report.contours


@pytest.mark.parametrize(
    "name", [name for name, profile in PROFILES.items() if not profile.is_table]
)
def test_all_profiles_of_contours_can_be_cut(name):
    content = cut(PLATE, HOLE, name=name)
    assert content.profile.entity == "polyline"
    assert [contour.name for contour in content.contours] == ["Plate", "Hole"]
    assert content.deviation_mm <= content.profile.tolerance_mm


def test_the_kerf_is_in_millimetres_whatever_the_unit():
    metric = cut(PLATE, kerf=2.0)
    assert cut(PLATE, kerf=2.0, unit="in").size_mm == pytest.approx(metric.size_mm, abs=0.02)


def test_tables_of_points_have_no_kerf_and_say_so(tmp_path):
    profile = msgspec.structs.replace(named("points"), kerf_mm=1.0)
    with_kerf = export(letter_f(), tmp_path / "a.csv", profile)
    plain = export(letter_f(), tmp_path / "b.csv", named("points"))
    assert (with_kerf.width_mm, with_kerf.entities) == (plain.width_mm, plain.entities)
    assert "Tables of points have no kerf" in " ".join(with_kerf.notes)
    assert "kerf" not in " ".join(plain.notes)


def test_an_open_curve_is_refused_in_a_sentence():
    with pytest.raises(NinepointError, match=r"^'Stroke' is open, and a kerf needs closed curves"):
        Contours.of(letter_f(), msgspec.structs.replace(named("laser"), kerf_mm=0.1))


def test_notes_say_what_became_of_the_curves():
    notes = cut(PLATE, HOLE, kerf=11.0).notes
    assert "'Hole' is gone: the tool does not fit." in notes
    second = Curve(np.add(PLATE.points, [101.0, 0.0]), name="Second")
    joined = "'Plate' and 'Second' become one contour: the tool does not fit between them."
    assert joined in cut(PLATE, second, kerf=15.0).notes
    assert joined not in cut(PLATE, second, kerf=1.0).notes
    crossing = Curve(np.add(PLATE.points, [50.0, 20.0]), name="Other")
    assert "'Plate' and 'Other' cross: what both enclose is not part of the piece." in (
        cut(PLATE, crossing, kerf=1.0).notes
    )
    assert any("1 place, near" in note for note in cut(PLATE, HOLE, kerf=11.0).notes)


@pytest.mark.parametrize("kerf", [1.0, -1.0])
@pytest.mark.parametrize("fault", ["moved", "missing", "plain"])
def test_a_file_with_another_offset_is_found(tmp_path, kerf, fault):
    content = cut(PLATE, HOLE, kerf=kerf)
    other = {
        "moved": cut(PLATE, HOLE, kerf=kerf + 0.05),
        "missing": cut(PLATE, kerf=kerf),
        "plain": Contours.of(Document((PLATE, HOLE)), named("laser-r12")),
    }[fault]
    # Only what is checked against the exact curves shall tell: the file is that of its contours.
    forged = forgery(other, content)
    with pytest.raises(FileError, match="1 mm off the exact curves"):
        verify(dxf.encode(forged, "a"), forged, tmp_path / "a.dxf")
    verify(dxf.encode(content, "a"), content, tmp_path / "a.dxf")


def forgery(shown, told):
    """Contours of one drawing that are said to be made of another."""
    return Contours(
        told.document, told.profile, shown.contours, np.zeros(2), told.places, told.notes
    )
