"""GDAL, through pyogrio: DXF, and CSV of points."""

import warnings
from collections import Counter

import numpy as np
import pyogrio

from independent import seen_by_gdal
from seen import DRAWING, Seen

TITLE = "GDAL"
FORMATS = ("dxf", "csv")


ARC_STEP = 0.1
"""Degrees of the chords that it makes of arcs; it makes 4 of itself, and 8 for a spline's point."""


def look(paths, folder):
    """What is in the files, and the version of the library."""
    pyogrio.set_gdal_config_options({"OGR_ARC_STEPSIZE": ARC_STEP})
    seen = [points_in(path) if path.suffix == ".csv" else lines_in(path) for path in paths]
    return seen, pyogrio.__gdal_version_string__


def lines_in(path):
    found = seen_by_gdal(path)
    # The ends of what it makes of arcs and splines are rounded.
    closed = sum(
        bool(np.hypot(*(points[0] - points[-1])) < 1e-9) for points, _, _ in found
    )
    kinds = Counter({"LineString": len(found)})
    return Seen([points for points, _, _ in found], len(found), closed, kinds, DRAWING)


def points_in(path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about names of drivers
        head, _, _, columns = pyogrio.raw.read(
            path, read_geometry=False, AUTODETECT_TYPE="YES"
        )
    named = dict(zip(head["fields"].tolist(), columns, strict=True))
    points = np.stack([named["x"], named["y"]], axis=1).astype(float)
    numbers = named.get("curve", np.ones(len(points)))
    lines = [points[numbers == number] for number in np.unique(numbers)]
    return Seen(lines, len(lines), None, Counter({"Point": len(points)}), DRAWING)
