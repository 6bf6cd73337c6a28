import io
import re

import ezdxf
import msgspec
import numpy as np
import pytest

from core.arcs import Arcs
from core.document import Curve, Document
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats import dxf, verify_dxf
from core.formats.contours import Contour, Contours
from core.profiles import named
from drawings import letter_f


def content_of(shapes, version):
    """Contours of any shapes; their curves do not matter here."""
    profile = msgspec.structs.replace(named("laser"), version=version)
    curve = Curve([(0, 0), (1, 1)])
    contours = tuple(Contour(curve, "CURVES", shape) for shape in shapes)
    return Contours(Document((curve,)), profile, contours, np.zeros(2), 6, ())


def circle(count, closed=True, bent=False):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    points = np.round(100 * np.stack([np.cos(angle), np.sin(angle)], axis=1), 6)
    if not bent:
        return Polyline(points, closed, 0.0)
    bulges = np.full(count, round(np.tan(np.pi / 2 / count), 9))
    bulges[-1] *= closed
    return Arcs(points, bulges, closed, True, 0.0)


@pytest.mark.parametrize("version", ["R2000", "R12"])
@pytest.mark.parametrize("bent", [False, True])
def test_long_polylines_are_read_as_ezdxf_reads_them(monkeypatch, version, bent):
    shapes = [circle(3), circle(500, True, bent), circle(700, False, bent), circle(2, False)]
    data = dxf.encode(content_of(shapes, version), "")
    _, whole = verify_dxf.outlines(data, 1e-4)
    monkeypatch.setattr(verify_dxf, "MANY", 100)
    short, long = verify_dxf._shortened(data)
    assert len(short) < len(data) / 2
    assert sorted(long) == [1, 2]
    _, found = verify_dxf.outlines(data, 1e-4)
    for one, other, shape in zip(whole, found, shapes, strict=True):
        assert one.line.tobytes() == other.line.tobytes()
        assert one.closed == other.closed == shape.closed
        assert one.count == other.count == len(shape.points) - (not shape.closed)


@pytest.mark.parametrize("version", ["R2000", "R12"])
def test_damage_in_a_long_polyline_is_found(monkeypatch, version):
    monkeypatch.setattr(verify_dxf, "MANY", 100)
    data = dxf.encode(content_of([circle(500)], version), "")
    middle = data.find(b"\n 20\n", data.find(b"ENTITIES") + 8000)
    for damage in (b"\n 21\n", b"\n 20\nx", b"\n 20\nnan", b"\n"):
        with pytest.raises(NinepointError):
            verify_dxf.outlines(data[:middle] + damage + data[middle + 5 :], 1.0)


def test_units_are_those_of_the_header():
    for name, unit, said in (("laser", "mm", "mm"), ("laser", "in", "in"), ("laser-r12", "mm", "")):
        profile = msgspec.structs.replace(named(name), unit=unit)
        data = dxf.encode(Contours.of(letter_f(), profile), "")
        assert verify_dxf.outlines(data, 0.1)[0] == said


def test_a_spline_that_ends_beside_its_start_is_open():
    data = dxf.encode(Contours.of(letter_f(), named("cad")), "")
    _, (letter, stroke) = verify_dxf.outlines(data, 0.01)
    assert letter.closed
    assert not stroke.closed
    second = data.rfind(b"  0\nSPLINE\n")
    end = re.findall(rb" 10\n(\S+)\n", data[:second])[-1]
    at = data.rfind(b" 10\n" + end, 0, second) + len(b" 10\n" + end) - 1
    moved = data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :]
    _, (letter, _) = verify_dxf.outlines(moved, 0.01)
    assert not letter.closed


def test_other_entities_are_refused():
    drawing = ezdxf.new("R2000", units=4)
    drawing.modelspace().add_circle((0, 0), 3)

    text = io.StringIO()
    drawing.write(text)
    with pytest.raises(NinepointError, match="it holds a CIRCLE"):
        verify_dxf.outlines(text.getvalue().encode(), 0.1)
