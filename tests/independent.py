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
NEAR = 2


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


def farthest(points, line):
    """Largest distance of points from a polygon: from the segments at its nearest vertices."""
    if len(line) == 1:
        return float(np.hypot(*(points - line).T).max())
    line = evened(line)
    nearest = cKDTree(line).query(points, NEAR)[1].reshape(len(points), NEAR)
    best = np.full(len(points), np.inf)
    for k in range(NEAR):
        for start in (nearest[:, k] - 1, nearest[:, k]):
            start = np.clip(start, 0, len(line) - 2)
            way, off = line[start + 1] - line[start], points - line[start]
            square = np.maximum((way**2).sum(axis=1), 1e-300)
            share = np.clip((off * way).sum(axis=1) / square, 0, 1)
            best = np.minimum(best, np.hypot(*(off - share[:, None] * way).T))
    return float(best.max())


def evened(line):
    """The line without long segments, so that the nearest segment has a vertex near."""
    ways = np.diff(line, axis=0)
    lengths = np.hypot(*ways.T)
    parts = np.maximum(np.ceil(lengths / max(lengths.sum(), 1e-300) * 4096), 1).astype(int)
    piece = np.repeat(np.arange(len(parts)), parts)
    number = np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts)
    inner = line[piece] + (number / parts[piece])[:, None] * ways[piece]
    return np.concatenate([inner, line[-1:]])
