"""Text of files of a million vertices, against ezdxf's own writer and one f-string a vertex.

Run with ``python3 tests tests/benchmarks``; the table comes at the end. What ezdxf writes is timed
with a tenth of the vertices: its time grows with their number.
"""

from __future__ import annotations

import io
from pathlib import Path

import msgspec
import numpy as np
import pytest
from comparison import Comparison
from ezdxf.filemanagement import new

from core.arcs import Arcs
from core.document import Curve, Document
from core.flatten import Polyline
from core.formats import dxf, export, named, svg
from core.formats.contours import Contour, Contours
from core.formats.readback import numbers_in
from core.formats.verify_dxf import outlines as dxf_outlines
from core.formats.verify_svg import outlines as svg_outlines

MILLION = 1_000_000
SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


def contours(name: str, places: int, version: str | None = None, bent: bool = False) -> Contours:
    """A circle of a million vertices, as some 200 mm are cut."""
    angle = np.linspace(0, 2 * np.pi, MILLION, endpoint=False)
    points = np.round(100 + 100 * np.stack([np.cos(angle), np.sin(angle)], axis=1), places)
    bulges = np.round(np.full(MILLION, np.pi / 2 / MILLION), 8)
    shape = Arcs(points, bulges, True, True, 0.0) if bent else Polyline(points, True, 0.0)
    profile = named(name)
    if version is not None:
        profile = msgspec.structs.replace(profile, version=version)
    curve = Curve(SHAPE)
    one = Contour(curve, "CURVES", shape)
    return Contours(Document((curve,)), profile, (one,), np.zeros(2), places, ())


def points_of(content: Contours) -> np.ndarray:
    shape = content.contours[0].shape
    assert isinstance(shape, (Arcs, Polyline))
    return shape.points


def by_f_strings(content: Contours) -> bytes:
    """Path data as one writes it first."""
    steps = "\nL".join(f"{x:.4f} {y:.4f}" for x, y in points_of(content).tolist())
    return f'<path d="M{steps}Z"/>'.encode()


def by_ezdxf(content: Contours, share: int) -> str:
    drawing = new("R2000", units=4)
    line = drawing.modelspace().add_lwpolyline([], close=True)
    vertices = np.zeros((MILLION // share, 5))
    vertices[:, :2] = points_of(content)[::share]
    line.lwpoints.extend(vertices)
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def test_svg_of_a_million_vertices(comparison: Comparison) -> None:
    content = contours("svg-polyline", 4)
    found = comparison.seconds(
        {"ours": lambda: svg.encode(content, ""), "f-strings": lambda: by_f_strings(content)}
    )
    comparison.row("SVG of a million vertices", f"{found['ours']:.2f} s", "0.3 s")
    ratio = found["f-strings"] / found["ours"]
    comparison.row("the same, against an f-string a vertex", f"{ratio:.1f} times faster")
    assert len(svg.encode(content, "")) > 10 * MILLION


@pytest.mark.parametrize(
    ("version", "bent"), [("R2000", False), ("R2000", True), ("R12", False)]
)
def test_dxf_of_a_million_vertices(comparison: Comparison, version: str, bent: bool) -> None:
    content = contours("laser", 6, version, bent)
    share = 10
    found = comparison.seconds(
        {"ours": lambda: dxf.encode(content, ""), "ezdxf": lambda: by_ezdxf(content, share)}
    )
    what = f"DXF {version} of a million vertices{', with arcs' * bent}"
    comparison.row(what, f"{found['ours']:.2f} s", "0.6 s")
    ratio = found["ezdxf"] * share / found["ours"]
    comparison.row("the same, against ezdxf's writer of LWPOLYLINE", f"{ratio:.0f} times faster")


def test_reading_back_a_million_vertices(comparison: Comparison) -> None:
    """What it costs that a file is read before it replaces the old one."""
    drawn = {
        "DXF": (dxf.encode(contours("laser", 6), ""), dxf_outlines),
        "SVG": (svg.encode(contours("svg-polyline", 4), ""), svg_outlines),
    }
    for name, (data, read) in drawn.items():
        seconds = comparison.seconds({name: lambda data=data, read=read: read(data, 0.001)})[name]
        comparison.row(f"{name} of a million vertices read back", f"{seconds:.2f} s", "2 s")
    words = "1.25 " * MILLION
    assert len(numbers_in(words, MILLION)) == MILLION


@pytest.mark.parametrize("name", ["laser", "laser-r12", "cad", "svg"])
def test_small_drawing(comparison: Comparison, tmp_path: Path, name: str) -> None:
    """All of an export: curve, file, reading it back, replacing the old one."""
    profile = named(name)
    document = Document((Curve(SHAPE),))
    path = tmp_path / f"a{profile.suffix}"
    seconds = comparison.seconds({name: lambda: export(document, path, profile)})[name]
    count = export(document, path, profile).entities
    comparison.row(f"export of a small drawing, {name}", f"{seconds * 1e3:.0f} ms")
    assert count < 200
