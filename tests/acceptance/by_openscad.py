"""OpenSCAD: imports DXF and SVG as areas, and exports their outlines as SVG and bodies as STL.

It has areas only: drawings with open curves are not for it.
"""

import os
import re
import subprocess

import numpy as np

from debian import needed
from seen import DRAWING, PAGE, seen_in_svg

TITLE = "OpenSCAD"
FORMATS = ("dxf", "svg")
FINE = 360
"""Its $fn: lines for a whole circle, and for a Bézier curve."""


def look(paths, folder):
    """What is in the files, None where it is nothing, and the version of the program."""
    said = subprocess.run([needed("openscad"), "--version"], capture_output=True, text=True)
    return [outline(path, folder) for path in paths], said.stderr.split()[-1]


def outline(path, folder):
    """The outline that it exports; its body must have the same box."""
    flat = made(f'import("{path.resolve()}", $fn={FINE});', folder / f"{path.stem}-out.svg")
    if flat is None:
        return None
    body = made(
        f'linear_extrude(1) import("{path.resolve()}", $fn={FINE});',
        folder / f"{path.stem}-out.stl",
    )
    seen = seen_in_svg(flat, DRAWING)
    vertices = re.findall(r"vertex (\S+) (\S+)", body.read_text())
    points = np.array(vertices, dtype=float)
    assert np.abs([points.min(axis=0), points.max(axis=0)] - seen.corners).max() < 1e-3
    if path.suffix == ".svg":
        # What it imports stands on the axis; its exports are as high as they are.
        seen.frame = PAGE
        seen.lines = [line - (0, page_height(path)) for line in seen.lines]
    return seen


def made(text, path):
    script = path.with_suffix(".scad")
    script.write_text(text)
    path.unlink(missing_ok=True)
    subprocess.run(
        [needed("openscad"), "-o", path, script], capture_output=True, check=False,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    return path if path.exists() else None


def page_height(path):
    """Height of the page in mm."""
    return float(re.search(r'height="([\d.]+)mm"', path.read_text())[1])
