"""LibreCAD: prints DXF into PDF, whose lines are then read.

Version 2.2.0 prints with 1200 dpi, whatever else it is asked for, onto the sheet that the file
names. So a copy is printed that names a large sheet, by the scale that fills it: then the steps of
the printer's numbers are small. Nothing but the sheet differs. The print is centred, so its middle
is taken to be where the file says that the drawing's middle is.
"""

import os
import re
import subprocess
from collections import Counter

import ezdxf
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from debian import needed, version_of
from seen import DRAWING, Seen
from traced import MM_PER_POINT, strokes

TITLE = "LibreCAD"
FORMATS = ("dxf",)
SHEET_MM = 4000.0
FILLED = 0.97
"""Share of the sheet that is filled."""

LIMITS = re.compile(r"(\$PLIMMAX\n *10\n)[^\n]*(\n *20\n)[^\n]*")


def look(paths, folder):
    """What is in the files, and the version of the program."""
    return [printed(path, folder) for path in paths], version_of("librecad")


def printed(path, folder):
    """The lines of the printed page."""
    header = ezdxf.readfile(path).header
    size = np.subtract(header["$EXTMAX"], header["$EXTMIN"])[:2]
    scale = float(f"{FILLED * SHEET_MM / size.max():.3g}")
    text, count = LIMITS.subn(rf"\g<1>{SHEET_MM}\g<2>{SHEET_MM}", path.read_text())
    assert count == 1
    large = folder / f"{path.stem}-large.dxf"
    large.write_text(text)
    subprocess.run(
        [needed("librecad"), "dxf2pdf", "-c", "-s", str(scale), large.name],
        cwd=folder, capture_output=True, check=True,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    found, page, unit = strokes(large.with_suffix(".pdf"))
    # Qt makes the sheet a whole number of points, and LibreCAD takes it for what it is called.
    stretch = SHEET_MM / page / scale
    lines = [points * stretch for points, _, _ in found]
    points = np.concatenate(lines)
    middle = np.add(header["$EXTMIN"], header["$EXTMAX"])[:2] / 2
    move = middle - (points.min(axis=0) + points.max(axis=0)) / 2
    lines = [line + move for line in lines]
    step = unit * MM_PER_POINT / scale
    contours, closed = chains(lines, 2 * step)
    return Seen(lines, contours, closed, Counter(), DRAWING, None, step / 2)


def chains(lines, near):
    """Number of contours, and of closed ones, of lines that join in any direction."""
    ends = np.concatenate([line[[0, -1]] for line in lines])
    pairs = cKDTree(ends).query_pairs(near, output_type="ndarray")
    _, joint = joined(pairs, len(ends))
    is_loose = np.bincount(joint) % 2 == 1
    both = np.arange(len(ends)).reshape(-1, 2)
    contours, contour = joined(np.concatenate([pairs, both]), len(ends))
    is_open = np.zeros(contours, dtype=bool)
    is_open[contour[is_loose[joint]]] = True
    return int(contours), int((~is_open).sum())


def joined(pairs, count):
    """Number of groups that pairs connect, and the group of each."""
    links = coo_array((np.ones(len(pairs)), pairs.T), (count, count))
    return connected_components(links, directed=False)
