"""What a DXF file of ours says, read by ezdxf: nothing here knows how the file was written.

ezdxf reads five microseconds a vertex. Of a polyline with very many the vertices are read as what
they are, rows of numbers, by NumPy, and ezdxf reads the file with the first few instead.
"""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.formats.readback import MOST_POINTS, Readback, arcs_read, numbers_in

if TYPE_CHECKING:
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import Polyline
    from ezdxf.entities.spline import Spline

MANY: Final = 50_000
"""Vertices from which on a polyline is not read by ezdxf alone."""

_SHORTEST_VERTEX: Final = len(" 10\n0.0\n 20\n0.0\n")

_LEFT: Final = 2
"""Vertices that are left to ezdxf."""

_UNITS: Final = {(4, 1): "mm", (1, 0): "in"}
"""Units by ``$INSUNITS`` and ``$MEASUREMENT``."""

_HEAD: Final = re.compile(rb"\n  0\n(LW)?POLYLINE\n")

_COUNT: Final = re.compile(rb"AcDbPolyline\n 90\n(\d+)\n")
"""What a polyline says of its vertices: ezdxf does not look at it, others allocate by it."""

_VERTEX: Final = re.compile(rb"  0\nVERTEX\n  8\n[^\n]*\n")

_CODES: Final = ((10, 20), (10, 20, 42), (10, 20, 30), (10, 20, 30, 42))
"""Group codes of a vertex."""

_COARSE: Final = 4
"""Parts of each piece of a spline at which its second derivative is looked at."""


def outlines(data: bytes, fine: float) -> tuple[str, list[Readback]]:
    """Unit and contours of a file.

    Parameters
    ----------
    data
        The file.
    fine
        How far the polygons of the outlines may leave the contours.

    Returns
    -------
    unit
        "mm", "in", or "" if the file does not say.
    list of Readback
        In the order of the file; a POINT has one point.

    Raises
    ------
    NinepointError
        If ezdxf cannot read it, its audit finds faults, or it has entities that we do not write.
    """
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.point import Point
    from ezdxf.entities.polyline import Polyline
    from ezdxf.entities.spline import Spline
    from ezdxf.filemanagement import read
    from ezdxf.lldxf.const import DXFError

    short, long = _shortened(data)
    try:
        drawing = read(io.StringIO(short.decode("ascii")))
        faults = drawing.audit().errors
    except (DXFError, ValueError, KeyError, IndexError) as error:
        raise NinepointError(f"ezdxf cannot read it ({type(error).__name__})") from error
    if faults:
        raise NinepointError(f"ezdxf finds a fault in it: {faults[0].message}")
    marks = drawing.header.get("$INSUNITS", 0), drawing.header.get("$MEASUREMENT", -1)
    counts = [int(number) for number in _COUNT.findall(data)]
    found: list[Readback] = []
    polylines = 0
    for entity in drawing.modelspace():
        layer = str(entity.dxf.layer)
        if isinstance(entity, (LWPolyline, Polyline)):
            rows, closed = _rows(entity)
            rows = long.get(polylines, rows)
            if isinstance(entity, LWPolyline) and counts[polylines : polylines + 1] != [len(rows)]:
                raise NinepointError("a polyline says that it has another number of vertices")
            polylines += 1
            found.append(arcs_read(rows[:, :2], rows[:, 2], closed, layer, fine))
        elif isinstance(entity, Spline):
            found.append(_spline(entity, layer, fine))
        elif isinstance(entity, Point):
            place = np.array([entity.dxf.location])[:, :2]
            found.append(Readback(place, 0.0, False, 1, layer))
        else:
            raise NinepointError(f"it holds a {entity.dxftype()}")
    return _UNITS.get(marks, ""), found


def _rows(entity: LWPolyline | Polyline) -> tuple[NDArray[np.float64], bool]:
    """Rows x, y, bulge of a polyline, and whether it is closed."""
    from ezdxf.entities.lwpolyline import LWPolyline

    if isinstance(entity, LWPolyline):
        return np.array(entity.get_points("xyb")).reshape(-1, 3), entity.closed
    rows = [(*vertex.dxf.location.vec2, vertex.dxf.bulge) for vertex in entity.vertices]
    return np.array(rows).reshape(-1, 3), entity.is_closed


def _spline(entity: Spline, layer: str, fine: float) -> Readback:
    """Readback of a spline; ezdxf's routines evaluate it."""
    tool = entity.construction_tool()
    breaks = np.unique(tool.knots())
    count = len(breaks) - 1

    def points(parts: int) -> NDArray[np.float64]:
        share = np.arange(parts) / parts
        at = (breaks[:-1, None] + share * np.diff(breaks)[:, None]).ravel()
        return np.array([place.vec2 for place in tool.points([*at.tolist(), float(breaks[-1])])])

    # The second difference of a cubic is its second derivative at the middle, which is linear in a
    # piece: within it, it is at most three times as large as at the inner points.
    coarse = points(_COARSE)
    second = np.diff(coarse, n=2, axis=0)
    inner = np.arange(len(second)) % _COARSE != _COARSE - 1
    bend = 3 * float(np.hypot(*second[inner].T).max()) * _COARSE**2
    parts = int(np.clip(np.ceil(np.sqrt(bend / 8 / fine)), 1, max(MOST_POINTS // count, _COARSE)))
    line = points(parts)
    controls = tool.control_points
    # In every bit: what evaluates the spline may round its ends apart.
    closed = tuple(controls[0]) == tuple(controls[-1])
    return Readback(line, bend / 8 / parts**2, closed, count, layer)


def _shortened(data: bytes) -> tuple[bytes, dict[int, NDArray[np.float64]]]:
    """File with few vertices of each long polyline, and the rows x, y, bulge of these.

    The keys count all polylines of the file from 0.
    """
    if len(data) < MANY * _SHORTEST_VERTEX:
        return data, {}
    parts, done = [], 0
    long = {}
    for number, head in enumerate(_HEAD.finditer(data)):
        if head[1]:
            mark = b" 10\n"
            begin = data.find(b"\n" + mark, head.end()) + 1
            end = data.find(b"\n  0\n", begin) + 1
        else:
            mark = b"  0\nVERTEX\n"
            begin = data.find(b"\n" + mark, head.end()) + 1
            end = data.find(b"\n  0\nSEQEND\n", begin) + 1
        if end - begin < MANY * _SHORTEST_VERTEX:
            continue
        cut = begin
        for _ in range(_LEFT):
            cut = data.find(b"\n" + mark, cut) + 1
        block = data[begin:end]
        long[number] = _numbers(block if head[1] else _VERTEX.sub(b"", block))
        parts.append(data[done:cut])
        done = end
    return b"".join([*parts, data[done:]]), long


def _numbers(block: bytes) -> NDArray[np.float64]:
    """Rows x, y, bulge of vertices whose group codes and values alternate, line by line."""
    values = numbers_in(block.decode("ascii"), block.count(b"\n"))
    for codes in _CODES:
        width = 2 * len(codes)
        if len(values) % width:
            continue
        table = values.reshape(-1, width)
        if (table[:, ::2] == codes).all():
            bulges = table[:, -1] if codes[-1] == 42 else np.zeros(len(table))
            return np.column_stack([table[:, 1], table[:, 3], bulges])
    raise NinepointError("the vertices of a polyline have other group codes")
