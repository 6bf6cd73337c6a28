"""What readers that we did not write see in a file: points on its contours, and closed flags.

Points are in the unit of the file, y up; each reader is as fine as it likes, but what it gives are
points of the contours.
"""

import io
import struct
import warnings
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import pyogrio
from ezdxf.path import make_path
from scipy.spatial import cKDTree

PX_PER_MM = 96 / 25.4
NEAR = 4
"""Pieces that are looked at first for the nearest."""

PIECES = 4096
"""Pieces of a polygon, at least."""


def seen_by_ezdxf(data, fine):
    """Points that keep within ``fine``, closed flags and layers."""
    drawing = ezdxf.read(io.StringIO(data.decode("ascii")))
    auditor = drawing.audit()
    assert auditor.errors == auditor.fixes == []
    found = []
    for entity in drawing.modelspace():
        path = make_path(entity)
        points = np.array([point.vec2 for point in path.flattening(fine)])
        found.append((points, path.is_closed, entity.dxf.layer))
    return found


def seen_by_gdal(path):
    """Vertices, closed flags (the last vertex is the first), and layers."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about columns that are not there
        _, _, geometry, fields = pyogrio.raw.read(path)
    found = []
    for shape, layer in zip(geometry, fields[0], strict=True):
        order, kind, count = struct.unpack_from("<BII", shape)
        assert order == 1
        assert kind & 0xFF == 2
        columns = 3 if kind & 0x80000000 or kind >= 1000 else 2
        points = np.frombuffer(shape, dtype="<f8", offset=9, count=columns * count)
        points = points.reshape(count, columns)[:, :2]
        found.append((points, bool((points[0] == points[-1]).all()), layer))
    return found


def seen_by_svgpathtools(data, parts=32):
    """Points and closed flags; y is up and 0 at the top of the page."""
    from svgpathtools import parse_path

    found = []
    for element in ET.fromstring(data).iter("{http://www.w3.org/2000/svg}path"):
        path = parse_path(element.get("d"))
        share = np.linspace(0, 1, parts)
        points = np.concatenate([np.poly1d(segment.poly())(share) for segment in path])
        found.append((np.stack([points.real, -points.imag], axis=1), path.isclosed()))
    return found


def ink_of_resvg(data, px_per_mm):
    """Box of the ink that a renderer draws, in mm: left, top, right, bottom; and the page."""
    import resvg_py
    from PySide6.QtGui import QImage

    picture = bytes(
        resvg_py.svg_to_bytes(
            svg_string=data.decode(), zoom=px_per_mm / PX_PER_MM, background="#ffffff", dpi=96
        )
    )
    image = QImage.fromData(picture).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
    ink = rows[:, : image.width()] < 200
    columns, lines = np.flatnonzero(ink.any(axis=0)), np.flatnonzero(ink.any(axis=1))
    box = np.array([columns[0], lines[0], columns[-1] + 1, lines[-1] + 1]) / px_per_mm
    return box, np.array([image.width(), image.height()]) / px_per_mm, ink


def exact_points(curve, parameters, most=2048):
    """Some thousand points of the exact curve; a closed one ends where it starts."""
    limit = curve.limit(parameters)
    level = 0
    while limit.spans << level < most:
        level += 1
    points = limit.points(level)
    return np.concatenate([points, points[:1]]) if limit.closed else points


def chord_error(line):
    """How far a smooth curve may be from the chords of dense points of it, about."""
    return float(np.hypot(*np.diff(line, n=2, axis=0).T).max(initial=0.0)) / 4


def farthest(points, lines):
    """Largest distance of points from a polygon, or from several.

    The nearest of short pieces is among those with the nearest middles: more and more of these are
    looked at, until those left are too far away, whatever their pieces do.
    """
    lines = lines if isinstance(lines, list) else [lines]
    pieces = [pieces_of(line) for line in lines]
    starts = np.concatenate([start for start, _ in pieces])
    ways = np.concatenate([way for _, way in pieces])
    tree = cKDTree(starts + ways / 2)
    half = np.hypot(*ways.T).max() / 2
    best = np.full(len(points), np.inf)
    waiting, near = np.arange(len(points)), NEAR
    while len(waiting):
        near = min(near, len(starts))
        there = points[waiting]
        away, nearest = tree.query(there, near)
        away, nearest = away.reshape(len(there), near), nearest.reshape(len(there), near)
        off, way = there[:, None] - starts[nearest], ways[nearest]
        square = np.maximum((way**2).sum(axis=2), 1e-300)
        share = np.clip((off * way).sum(axis=2) / square, 0, 1)
        gaps = off - share[:, :, None] * way
        best[waiting] = np.hypot(gaps[:, :, 0], gaps[:, :, 1]).min(axis=1)
        if near == len(starts):
            break
        waiting = waiting[away[:, -1] - half < best[waiting]]
        near *= 4
    return float(best.max())


def pieces_of(line):
    """Starts and ways of the pieces of a polygon, none of them long; a point is a piece."""
    if len(line) == 1:
        return line, np.zeros((1, 2))
    ways = np.diff(line, axis=0)
    lengths = np.hypot(*ways.T)
    parts = np.maximum(np.ceil(lengths / max(lengths.sum(), 1e-300) * PIECES), 1).astype(int)
    number = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    steps = np.repeat(ways / parts[:, None], parts, axis=0)
    return np.repeat(line[:-1], parts, axis=0) + number[:, None] * steps, steps
