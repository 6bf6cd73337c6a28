"""Lines that are stroked on a page of PDF, as MuPDF sees them."""

import re
import subprocess

import numpy as np

from debian import needed

MM_PER_POINT = 25.4 / 72
PARTS = 1024
"""Points of a Bézier curve."""

STEP = re.compile(r"<(moveto|lineto|curveto|closepath)([^/]*)/>")
NUMBER = re.compile(r'="([^"]+)"')


def strokes(path):
    """Each stroke: points in mm, y up, 0 at the foot of the page; whether closed; kinds of steps.

    Also the size of the page in mm, and that of the first numbers' unit in points.
    """
    trace = subprocess.run(
        [needed("mutool"), "trace", path], capture_output=True, text=True, check=True
    ).stdout
    page = np.array(re.search(r'mediabox="([^"]+)"', trace)[1].split(), dtype=float)
    height = page[3] - page[1]
    found = []
    unit = 1.0
    for part in trace.split("<stroke_path")[1:]:
        a, b, c, d, e, f = map(float, re.search(r'transform="([^"]+)"', part)[1].split())
        unit = float(np.hypot(a, b))
        points, is_closed, kinds = read(part.partition("</stroke_path>")[0])
        moved = points @ np.array([[a, b], [c, d]]) + (e, f)
        # The trace has y down, as on a screen.
        found.append(((moved * (1, -1) + (0, height)) * MM_PER_POINT, is_closed, kinds))
    return found, (page[2:] - page[:2]) * MM_PER_POINT, unit


def read(part):
    """Points, closed flag, and kinds of the steps of one path."""
    lines, kinds, is_closed = [], [], False
    last = None
    for kind, words in STEP.findall(part):
        kinds.append(kind)
        if kind == "closepath":
            is_closed = True
            lines.append(lines[0][:1])
            continue
        ends = np.array(NUMBER.findall(words), dtype=float).reshape(-1, 2)
        if kind == "curveto":
            ends = bezier(np.concatenate([last, ends]))
        lines.append(ends)
        last = ends[-1:]
    return np.concatenate(lines), is_closed, kinds


def bezier(controls):
    """Points of a cubic."""
    t = np.linspace(0, 1, PARTS)[:, None]
    p, q, r, s = controls
    return (1 - t) ** 3 * p + 3 * (1 - t) ** 2 * t * q + 3 * (1 - t) * t**2 * r + t**3 * s
