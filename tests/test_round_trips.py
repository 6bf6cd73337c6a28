"""What leaves comes back: by our own readers and by others, for all profiles and units.

The deviation is measured between dense points of the exact curves and of what was read; nothing is
taken from the bounds that the writers prove, but the tolerance that was asked for.
"""

from dataclasses import fields

import msgspec
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core.document import Curve, Document
from core.family import Parameters
from core.formats import PROFILES, Profile, export, open_document, prepare
from core.formats.foreign import read_sketch
from core.formats.svg import page
from drawings import coordinates, documents, letter_f
from effort import costly
from independent import (
    chord_error,
    exact_points,
    farthest,
    ink_of_resvg,
    seen_by_ezdxf,
    seen_by_gdal,
    seen_by_svgpathtools,
)

OWN = Profile(
    name="polyline", title="Own", format="dxf", entity="polyline", version="R2000"
)
OUTLINES = {
    profile.name: profile
    for profile in (*PROFILES.values(), OWN)
    if profile.format in ("dxf", "svg")
}
SVGS = [name for name, profile in OUTLINES.items() if profile.format == "svg"]
DXFS = [name for name, profile in OUTLINES.items() if profile.format == "dxf"]
UNITS = ["mm", "in"]
PARTS = 33
"""Points of a cubic."""

MOST = 4096
"""Exact points of a curve, at least half as many."""

SYMMETRIES = [
    np.array(matrix)
    for matrix in (
        [[1, 0], [0, 1]], [[-1, 0], [0, 1]], [[1, 0], [0, -1]], [[-1, 0], [0, -1]],
        [[0, 1], [1, 0]], [[0, -1], [1, 0]], [[0, 1], [-1, 0]], [[0, -1], [-1, 0]],
    )
]  # fmt: skip

names = st.text(max_size=12)
floats = st.floats(-1e4, 1e4, allow_subnormal=True)
wild = st.builds(
    Document,
    st.lists(
        st.builds(
            Curve,
            st.lists(st.tuples(floats, floats), max_size=9),
            st.booleans(),
            names,
        ),
        max_size=3,
    ),
    # Members around Lagrange, all of which converge.
    st.builds(
        lambda wing, sides: Parameters(str(wing), str(-abs(wing)), str(wing), sides),
        st.fractions(-1, 1, max_denominator=8).map(lambda share: share / 4),
        st.sampled_from(["translated", "mirrored"]),
    ),
    st.sampled_from([(), (OWN,), (OWN, PROFILES["laser"])]),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("trips")


def assert_same(found, document):
    """All fields are equal, floats in every bit."""
    assert {field.name for field in fields(Document)} == {"curves", "parameters", "profiles"}
    assert found.parameters == document.parameters
    assert found.profiles == document.profiles
    assert len(found.curves) == len(document.curves)
    for one, other in zip(found.curves, document.curves, strict=True):
        assert one.points.tobytes() == other.points.tobytes()
        assert (one.closed, one.name) == (other.closed, other.name)


@costly
@given(wild, st.sampled_from(SVGS), st.sampled_from(UNITS), st.sampled_from([1.0, 50.0]))
def test_a_document_comes_back_from_its_svg_in_every_field(folder, document, name, unit, tolerance):
    # Something has to be there to be drawn.
    drawn = Curve([(0, 0), (30, 10), (50, -10), (20, 40)], True, "drawn")
    document = Document((*document.curves, drawn), document.parameters, document.profiles)
    path = folder / "document.svg"
    profile = msgspec.structs.replace(OUTLINES[name], unit=unit, tolerance_mm=tolerance)
    export(document, path, profile)
    assert_same(read_sketch(path).document, document)


@costly
@given(
    documents,
    st.sampled_from(sorted(OUTLINES)),
    st.sampled_from(UNITS),
    st.sampled_from(["drawing", "corner"]),
    st.sampled_from([0.02, 0.1, 1.0]),
)
def test_a_curve_comes_back_within_the_tolerance(folder, document, name, unit, origin, tolerance):
    """Document, file of any profile and unit, our reader: dense points, both ways."""
    assume(ends_differ(document))
    profile = msgspec.structs.replace(
        OUTLINES[name], unit=unit, origin=origin, tolerance_mm=tolerance
    )
    path = folder / f"curve{profile.suffix}"
    export(document, path, profile)
    sketch = read_sketch(path)
    assert sketch.is_unit_known == (profile.version != "R12")
    sketch = sketch.in_unit(unit)
    back = place(document, profile)
    curves = [curve for curve in document.curves if (curve.points != curve.points[0]).any()]
    assert len(sketch.traces) == len(curves)
    for trace, curve in zip(sketch.traces, curves, strict=True):
        assert trace.closed == curve.is_loop
        line = dense(trace) + back
        exact = exact_points(curve, document.parameters, MOST)
        reach = tolerance + trace.deviation + 1e-9
        assert farthest(exact, line) <= reach + chord_error(line)
        assert farthest(line, exact) <= reach + chord_error(exact)


def ends_differ(document):
    """Whether no open curve starts or ends where one does: readers of DXF join these."""
    loose = [curve.points[[0, -1]] for curve in document.curves if not curve.is_loop]
    return not loose or len(np.unique(np.concatenate(loose), axis=0)) == 2 * len(loose)


def place(document, profile):
    """What brings a drawing that was read, in mm, back to where the document has it."""
    content = prepare(document, profile)
    corner = -content.shift
    if profile.format == "svg":
        origin, size = page(content)
        corner = corner + origin - (0, size[1])
    return corner * profile.unit_mm


def dense(trace):
    """Points of all cubics."""
    t = np.linspace(0, 1, PARTS)[:, None, None]
    p, q, r, s = (trace.controls[:, k] for k in range(4))
    points = (1 - t) ** 3 * p + 3 * (1 - t) ** 2 * t * q + 3 * (1 - t) * t**2 * r + t**3 * s
    return points.transpose(1, 0, 2).reshape(-1, 2)


@costly
@given(
    st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=12, unique=True),
    st.booleans(),
    st.sampled_from(["csv", "tsv", "json"]),
)
def test_control_points_come_back_in_every_bit(folder, points, closed, form):
    curve = Curve(np.array(points) / 3, closed, "drawn")
    path = folder / f"points.{form}"
    profile = Profile(name="own", title="Own", format=form, entity="control points")
    export(Document((curve,)), path, profile)
    (found,) = open_document(path, None if form == "json" else closed).curves
    assert found.points.tobytes() == curve.points.tobytes()
    assert found.closed == closed


READERS = {
    "ezdxf": (lambda path, data: seen_by_ezdxf(data, 0.01)[0][0], DXFS),
    "GDAL": (lambda path, data: seen_by_gdal(path)[0][0], DXFS),
    "svgpathtools": (lambda path, data: seen_by_svgpathtools(data)[0][0], SVGS),
    "resvg": (lambda path, data: pixels(data), SVGS),
    "ours": (lambda path, data: dense(read_sketch(path).traces[0]), [*DXFS, *SVGS]),
    "table": (lambda path, data: table(data), ["points"]),
}


def pixels(data):
    """Middles of the dark pixels of the F, y up."""
    fine = 20
    _, _, ink = ink_of_resvg(data, fine)
    y, x = np.nonzero(ink)
    points = np.stack([x + 0.5, -(y + 0.5)], axis=1) / fine
    return points[points[:, 0] < 34]  # the stroke beside it


def table(data):
    """Points of the first curve of a CSV."""
    rows = np.genfromtxt(data.decode().splitlines(), delimiter=",", names=True)
    rows = rows[rows["curve"] == 1]
    return np.stack([rows["x"], rows["y"]], axis=1)


@pytest.mark.parametrize(
    ("reader", "name"),
    [(reader, name) for reader, (_, names) in READERS.items() for name in names],
)
def test_an_f_is_never_mirrored_or_turned(folder, reader, name):
    """Of the eight symmetries of a square only one brings the exact F onto what is seen."""
    document = letter_f()
    profile = {**OUTLINES, "points": PROFILES["points"]}[name]
    path = folder / f"{name}-{reader}{profile.suffix}"
    if reader == "resvg":  # a line of a fifth of a pixel would be too faint
        profile = msgspec.structs.replace(profile, width_mm=0.1)
    export(document, path, profile)
    seen = READERS[reader][0](path, path.read_bytes())
    exact = exact_points(document.curves[0], document.parameters)
    fits = [
        k
        for k, matrix in enumerate(SYMMETRIES)
        if farthest(centred(seen), centred(exact @ matrix)) < 0.3
    ]
    assert fits == [0]


def centred(points):
    """Points around the middle of their box."""
    return points - (points.min(axis=0) + points.max(axis=0)) / 2


def test_the_f_has_none_of_the_symmetries_itself():
    document = letter_f()
    exact = exact_points(document.curves[0], document.parameters)
    for matrix in SYMMETRIES[1:]:
        assert farthest(centred(exact @ matrix), centred(exact)) > 3


def test_every_profile_is_tried():
    assert {*OUTLINES, "points", "pdf", "png"} == {*PROFILES, OWN.name}
