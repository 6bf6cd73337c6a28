"""Inkscape: opens SVG, and DXF through its dxf_input.py; boxes as it states them."""

import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from debian import needed
from seen import DRAWING, PX_PER_MM, SVG, Seen, paths_of, seen_in_svg

TITLE = "Inkscape"
FORMATS = ("dxf", "svg")
EXTENSIONS = Path("/usr/share/inkscape/extensions")


def look(paths, folder):
    """What is in the files, and the version of the program."""
    said = subprocess.run([needed("inkscape"), "--version"], capture_output=True, text=True)
    seen = [(from_dxf if path.suffix == ".dxf" else from_svg)(path, folder) for path in paths]
    return seen, said.stdout.split()[1]


def from_svg(path, folder):
    """The paths that Inkscape saves, and the boxes that it states."""
    saved = resaved(path, folder)
    found = seen_in_svg(saved)
    found.box = stated(path, folder)
    return found


def resaved(path, folder):
    """The file as Inkscape saves it as a plain SVG."""
    saved = folder / f"{path.stem}-saved.svg"
    subprocess.run(
        [needed("inkscape"), "--export-plain-svg", "-o", saved, path],
        capture_output=True, check=True,
    )  # fmt: skip
    return saved


def from_dxf(path, folder):
    """The paths that the importer makes, with the boxes that Inkscape states of them."""
    converted = folder / f"{path.stem}-converted.svg"
    with converted.open("wb") as out:
        subprocess.run(
            ["/usr/bin/python3", "dxf_input.py", path.resolve()],
            cwd=EXTENSIONS, stdout=out, check=True,
        )  # fmt: skip
    root = ET.parse(converted).getroot()
    foot = np.array([0, float(root.get("height")) / PX_PER_MM])
    found = paths_of(root)
    seen = Seen(
        [points / PX_PER_MM + foot for points, _, _ in found],
        len(found),
        sum(closed for _, closed, _ in found),
        sum((kinds for _, _, kinds in found[1:]), found[0][2]),
        DRAWING,
    )
    seen.box = stated(converted, folder) + foot
    return seen


def stated(path, folder):
    """Box of all paths by ``--query-all``, in mm, y up and 0 at the top; strokes left out."""
    bare = folder / "bare.svg"
    tree = ET.parse(path)
    for element in tree.iter(f"{SVG}path"):
        element.set("style", "fill:none;stroke:none")
        element.attrib.pop("stroke", None)
    tree.write(bare)
    run = subprocess.run(
        [needed("inkscape"), "--query-all", bare], capture_output=True, text=True, check=True
    )
    rows = [line.split(",") for line in run.stdout.splitlines() if line.startswith("path")]
    assert rows, run.stdout + run.stderr
    x, y, width, height = np.array([[float(word) for word in row[1:]] for row in rows]).T
    low, high = (x.min(), -(y + height).max()), ((x + width).max(), -y.min())
    return np.array([low, high]) / PX_PER_MM


