"""Exports of all examples, opened by programs that we did not write.

Outside the default suite: ``python3 tests tests/acceptance -s`` prints the table. The programs are
Debian's packages inkscape (with python3-cssselect, python3-lxml, python3-tinycss2) and freecad.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from app.assets import example_paths
from core.formats import export, open_document, profile_for

TOLERANCE_MM = 0.01
PX_PER_MM = 96 / 25.4
INKSCAPE_EXTENSIONS = Path("/usr/share/inkscape/extensions")

FREECAD_SCRIPT = """
import FreeCAD, Part, importDXF, json
importDXF.open({path!r})
edges = [e for o in FreeCAD.ActiveDocument.Objects for e in o.Shape.Edges]
chains = Part.sortEdges(edges)
box = Part.makeCompound(edges).BoundBox
closed = sum(Part.Wire(chain).isClosed() for chain in chains)
answer = [box.XMin, box.YMin, box.XLength, box.YLength, len(chains), closed]
open({answer!r}, "w").write(json.dumps(answer))
"""


def needed(program):
    found = shutil.which(program)
    assert found, f"{program} is not installed: apt-get install inkscape freecad"
    return found


def exact_box(document):
    points = np.concatenate([c.limit(document.parameters).points(8) for c in document.curves])
    return points.min(axis=0), points.max(axis=0)


def seen_by_inkscape(svg, folder):
    """Boxes that Inkscape reports, in mm: rows x, y (down), width, height; strokes left out."""
    bare = folder / "bare.svg"
    text = re.sub(r'\sstroke-width="[^"]*"', "", svg.read_text())
    text = re.sub(r'\sstroke="[^"]*"', ' stroke="none"', text)
    text = re.sub(r"stroke:\s*[^;\"]*", "stroke:none", text)
    bare.write_text(text)
    run = subprocess.run(
        [needed("inkscape"), "--query-all", bare], capture_output=True, text=True, check=True
    )
    rows = [line.split(",") for line in run.stdout.splitlines() if line.startswith("path")]
    assert rows, run.stdout
    return np.array([[float(x) / PX_PER_MM for x in row[1:]] for row in rows])


def joined(boxes):
    """Width and height of the box around boxes."""
    low, high = boxes[:, :2].min(axis=0), (boxes[:, :2] + boxes[:, 2:]).max(axis=0)
    return high - low


def report(program, path, size, contours, error):
    print(f"  {program:22} {path.name:16} {size[0]:9.3f} x {size[1]:8.3f} mm"
          f" {contours:3} contours  box off by {error:.4f} mm")  # fmt: skip


@pytest.fixture(params=example_paths(), ids=lambda path: path.stem)
def drawing(request):
    return request.param.stem, open_document(request.param)


def test_inkscape_opens_the_svg_at_true_size(drawing, tmp_path):
    name, document = drawing
    path = tmp_path / f"{name}.svg"
    export(document, path, profile_for(path).within(TOLERANCE_MM))
    boxes = seen_by_inkscape(path, tmp_path)
    low, high = exact_box(document)
    error = np.abs(joined(boxes) - (high - low)).max()
    report("Inkscape", path, joined(boxes), len(boxes), error)
    assert error <= 2 * TOLERANCE_MM
    assert len(boxes) == len(document.curves)


def test_inkscape_opens_the_dxf_at_true_size(drawing, tmp_path):
    name, document = drawing
    path = tmp_path / f"{name}.dxf"
    export(document, path, profile_for(path).within(TOLERANCE_MM))
    converted = tmp_path / "from-dxf.svg"
    with converted.open("wb") as out:
        subprocess.run(
            ["/usr/bin/python3", "dxf_input.py", path],
            cwd=INKSCAPE_EXTENSIONS, stdout=out, check=True,
        )  # fmt: skip
    boxes = seen_by_inkscape(converted, tmp_path)
    low, high = exact_box(document)
    error = np.abs(joined(boxes) - (high - low)).max()
    report("Inkscape, dxf_input.py", path, joined(boxes), len(boxes), error)
    assert error <= 2 * TOLERANCE_MM
    assert len(boxes) == len(document.curves)


def test_freecad_opens_the_dxf_in_its_place_at_true_size_and_closed(drawing, tmp_path):
    name, document = drawing
    path = tmp_path / f"{name}.dxf"
    export(document, path, profile_for(path).within(TOLERANCE_MM))
    script, answer = tmp_path / "look.py", tmp_path / "answer.json"
    script.write_text(FREECAD_SCRIPT.format(path=str(path), answer=str(answer)))
    subprocess.run([needed("freecadcmd"), script], capture_output=True, check=True)
    x, y, width, height, contours, closed = json.loads(answer.read_text())
    low, high = exact_box(document)
    error = np.abs(np.array([x, y, x + width, y + height]) - [*low, *high]).max()
    report("FreeCAD", path, (width, height), contours, error)
    assert error <= 2 * TOLERANCE_MM
    assert contours == len(document.curves)
    assert closed == sum(curve.closed for curve in document.curves)
