"""Entities of DXF as outlines, each in a plane of its own.

Arcs, circles and flat polylines have coordinates in a plane that is given by its normal alone, the
extrusion; `plane` is the reference's "arbitrary axis algorithm". All is seen from above: heights
are dropped.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.formats import ellipses, nurbs
from core.formats.affine import IDENTITY, Matrix
from core.formats.budget import Budget
from core.formats.dxf_tags import EntityError, Record
from core.formats.outlines import Outline, polyline, straight

MAX_FIT_POINTS: Final = 5_000
"""Largest number of points of a spline that is given by points on it."""

_STRAIGHT: Final = 1e-8
"""Bulge below which an arc is a line: it leaves its chord by half of it, in chords."""

_NEARLY_UPRIGHT: Final = 1 / 64
_CLOSED, _SPLINE_FIT, _THREE_D, _MESH, _POLYFACE = 1, 4, 8, 16, 64
_FRAME_VERTEX: Final = 16


class Shape(NamedTuple):
    """What an entity draws.

    Attributes
    ----------
    outlines
        Raw outlines (see `core.formats.path_data.Drawn`), in the entity's own plane.
    matrix
        From that plane to the drawing's.
    is_flat
        Whether nothing is lost by looking from above.
    is_guess
        Whether the file leaves the shape to the program that reads it.
    """

    outlines: list[Outline]
    matrix: Matrix = IDENTITY
    is_flat: bool = True
    is_guess: bool = False


def number(values: dict[int, bytes], code: int, default: float = 0.0) -> float:
    """Finite number of a group code.

    Raises
    ------
    EntityError
        If it is none.
    """
    text = values.get(code)
    if text is None:
        return default
    try:
        found = float(text)
    except ValueError as error:
        raise EntityError("a value is no number") from error
    if not math.isfinite(found):
        raise EntityError("a value is not finite")
    return found


def integer(values: dict[int, bytes], code: int, default: int = 0) -> int:
    """Whole number of a group code; flags are sometimes written as ``1.0``."""
    return int(number(values, code, default))


def plane(values: dict[int, bytes], height: float) -> tuple[Matrix, bool]:
    """Map from an entity's plane to the drawing's, and whether the plane is level."""
    x, y, z = (number(values, code, float(code == 230)) for code in (210, 220, 230))
    size = math.hypot(x, y, z)
    if size == 0:
        x, y, z, size = 0.0, 0.0, 1.0, 1.0
    x, y, z = x / size, y / size, z / size
    if abs(x) < _NEARLY_UPRIGHT and abs(y) < _NEARLY_UPRIGHT:
        ax, ay, az = z, 0.0, -x
    else:
        ax, ay, az = -y, x, 0.0
    length = math.hypot(ax, ay, az)
    ax, ay, az = ax / length, ay / length, az / length
    bx, by = y * az - z * ay, z * ax - x * az
    is_level = x == 0 and y == 0
    if is_level:
        return (IDENTITY if z > 0 else Matrix(-1.0, 0.0, 0.0, 1.0, 0.0, 0.0)), True
    return Matrix(ax, ay, bx, by, height * x, height * y), False


def _line(record: Record, tolerance: float, budget: Budget) -> Shape:  # noqa: ARG001
    values = record.first()
    budget.draw(1)
    ends = [[number(values, 10), number(values, 20)], [number(values, 11), number(values, 21)]]
    found = polyline(np.array(ends), False)
    return Shape([found] if found else [], IDENTITY, number(values, 30) == number(values, 31))


def _arc(record: Record, tolerance: float, budget: Budget) -> Shape:
    values = record.first()
    radius = number(values, 40)
    matrix, is_level = plane(values, number(values, 30))
    start, turn = 0.0, 2 * math.pi
    is_arc = record.name == "ARC"
    if is_arc:
        first, last = number(values, 50), number(values, 51, 360.0)
        start = math.radians(math.fmod(first, 360))
        turn = math.radians((last - first) % 360) or 2 * math.pi
    centre = (number(values, 10), number(values, 20))
    one = _elliptic(centre, (radius, 0.0), (0.0, radius), start, turn, tolerance, budget)
    return Shape([one], matrix, is_level)


def _ellipse(record: Record, tolerance: float, budget: Budget) -> Shape:
    values = record.first()
    x, y, z = (number(values, code) for code in (11, 21, 31))
    nx, ny, nz = (number(values, code, float(code == 230)) for code in (210, 220, 230))
    size = math.hypot(nx, ny, nz)
    if size == 0:
        nx, ny, nz, size = 0.0, 0.0, 1.0, 1.0
    ratio = number(values, 40, 1.0) / size
    second = ((ny * z - nz * y) * ratio, (nz * x - nx * z) * ratio)
    first, last = number(values, 41), number(values, 42, 2 * math.pi)
    turn = (last - first) % (2 * math.pi)
    if turn < 1e-12 or 2 * math.pi - turn < 1e-9:  # the ends are written with 6 to 16 digits
        turn = 2 * math.pi
    centre = (number(values, 10), number(values, 20))
    one = _elliptic(centre, (x, y), second, first, turn, tolerance, budget)
    return Shape([one], IDENTITY, nx == 0 and ny == 0 and z == 0)


def _elliptic(
    centre: tuple[float, float],
    first: tuple[float, float],
    second: tuple[float, float],
    start: float,
    turn: float,
    tolerance: float,
    budget: Budget,
) -> Outline:
    (a, b), (c, d) = first, second
    longest = (math.hypot(a + d, b - c) + math.hypot(a - d, b + c)) / 2
    if not 0 < longest < math.inf:
        raise EntityError("its radius is 0 or not finite")
    count = ellipses.piece_count(longest, turn, tolerance)
    is_whole = turn == 2 * math.pi
    if is_whole:
        count = -(-count // 4) * 4  # the outermost points of a circle are nodes then
    budget.draw(count)
    numbers = ellipses.arc(centre, first, second, math.fmod(start, 2 * math.pi), turn, count)
    moved = 0.0
    if is_whole:
        moved = math.hypot(numbers[-2] - numbers[0], numbers[-1] - numbers[1])
        numbers[-2:] = numbers[:2]
    deviation = longest * ellipses.unit_deviation(turn / count) + moved
    return Outline(np.array(numbers).reshape(-1, 4, 2), is_whole, deviation)


def _light_polyline(record: Record, tolerance: float, budget: Budget) -> Shape:
    values = record.first()
    matrix, is_level = plane(values, number(values, 38))
    whole = record.tags
    xs, ys, bulged = record.all(10), record.all(20), record.all(42)
    budget.draw(len(xs))
    if len(ys) != len(xs) or (ys < xs).any():
        raise EntityError("its vertices are not complete")
    points = np.column_stack([whole.numbers(xs), whole.numbers(ys)])
    bulges = np.zeros(len(points))
    if len(bulged):
        owners = np.searchsorted(xs, bulged) - 1
        bulges[owners[owners >= 0]] = whole.numbers(bulged)[owners >= 0]
    closed = bool(integer(values, 70) & _CLOSED)
    found = bulging(points, bulges, closed, tolerance, budget)
    return Shape([found] if found else [], matrix, is_level)


def _heavy_polyline(record: Record, tolerance: float, budget: Budget) -> Shape:
    """POLYLINE with its vertices; what a curve was fitted to is left out, the fitted one drawn."""
    values = record.first()
    flags = integer(values, 70)
    if flags & (_MESH | _POLYFACE):
        raise EntityError("it is a surface")
    whole = record.tags
    low, high = record.own, record.high
    codes = whole.codes[low:high]
    heads = np.flatnonzero(codes == 0)
    count = len(heads)
    budget.draw(count)
    kept = np.ones(count, dtype=bool)
    columns = {}
    for code in (10, 20, 30, 42, 70):
        places = np.flatnonzero(codes == code)
        column = np.zeros(count)
        column[np.searchsorted(heads, places) - 1] = whole.numbers(places + low)
        columns[code] = column
    if flags & _SPLINE_FIT:
        kept = (columns[70].astype(np.int64) & _FRAME_VERTEX) == 0
    points = np.column_stack([columns[10], columns[20]])[kept]
    heights = columns[30][kept]
    bulges = columns[42][kept]
    closed = bool(flags & _CLOSED)
    if flags & _THREE_D:
        found = bulging(points, np.zeros(len(points)), closed, tolerance, budget)
        return Shape([found] if found else [], IDENTITY, bool(np.ptp(heights) == 0 if count else 1))
    matrix, is_level = plane(values, number(values, 30))
    found = bulging(points, bulges, closed, tolerance, budget)
    return Shape([found] if found else [], matrix, is_level)


def bulging(
    points: NDArray[np.float64],
    bulges: NDArray[np.float64],
    closed: bool,
    tolerance: float,
    budget: Budget,
) -> Outline | None:
    """Polyline of lines and arcs as a raw outline.

    Parameters
    ----------
    points
        Vertices (n, 2); None comes back if there are fewer than two.
    bulges
        Tangents of a quarter of the turn of each edge, shape (n,); 0 is a line.
    closed
        Whether the last vertex is joined to the first.
    tolerance, budget
        Admitted deviation of arcs, and what pays for their cubics.

    Notes
    -----
    The centre over a chord from A to B lies at ``(A + B) / 2 + n (1 - b^2) / (4 b)``, n being the
    chord turned to the left by a right angle, and the radius is ``|B - A| (1 + b^2) / (4 |b|)``.
    """
    if len(points) < 2:
        return None
    if not (np.isfinite(points).all() and np.isfinite(bulges).all()):
        raise EntityError("a coordinate is not finite")
    ends = np.concatenate([points[1:], points[:1]]) if closed else points[1:]
    starts, bulges = points[: len(ends)], bulges[: len(ends)]
    chords = ends - starts
    widths = np.hypot(*chords.T)
    curved = np.flatnonzero((np.abs(bulges) > _STRAIGHT) & (widths > 0))
    flat = float((np.abs(bulges) * widths / 2)[np.abs(bulges) <= _STRAIGHT].max(initial=0.0))
    controls = straight(starts, ends)
    if len(curved) == 0:
        return Outline(controls, closed, flat)
    b, chord = bulges[curved], chords[curved]
    with np.errstate(all="ignore"):
        left = np.column_stack([-chord[:, 1], chord[:, 0]])
        centres = (starts[curved] + ends[curved]) / 2 + left * ((1 / b - b) / 4)[:, None]
        radii = widths[curved] * (1 / np.abs(b) + np.abs(b)) / 4
    if not (np.isfinite(centres).all() and np.isfinite(radii).all()):
        raise EntityError("a bulge is too large")
    turns = 4 * np.arctan(b)
    first = np.arctan2(*(starts[curved] - centres)[:, ::-1].T)
    counts = ellipses.pieces(radii, turns, tolerance)
    budget.draw(int(counts.sum()))
    axes = np.zeros((len(curved), 2))
    axes[:, 0] = radii
    arcs = ellipses.cubics(centres, axes, axes[:, ::-1], first, turns, counts)
    moved = ellipses.pin(arcs, counts, starts[curved], ends[curved])
    bounds = radii * ellipses.deviation(turns / counts) + moved
    repeats = np.ones(len(controls), dtype=np.intp)
    repeats[curved] = counts
    is_arc = np.zeros(len(controls), dtype=bool)
    is_arc[curved] = True
    drawn = np.repeat(controls, repeats, axis=0)
    drawn[np.repeat(is_arc, repeats)] = arcs
    return Outline(drawn, closed, max(flat, float(bounds.max())))


def _spline(record: Record, tolerance: float, budget: Budget) -> Shape:
    values = record.first()
    whole = record.tags
    degree = integer(values, 71, 3)
    points, is_level = _points(record, 10)
    if len(points) == 0:
        fit, is_level = _points(record, 11)
        degree, knots, points = _through(fit, values)
        return Shape(
            nurbs.spline(degree, knots, points, None, tolerance, budget), IDENTITY, is_level, True
        )
    knots = whole.numbers(record.all(40))
    weighted = record.all(41)
    weights = whole.numbers(weighted) if len(weighted) else None
    found = nurbs.spline(degree, knots, points, weights, tolerance, budget)
    return Shape(found, IDENTITY, is_level)


def _points(record: Record, code: int) -> tuple[NDArray[np.float64], bool]:
    """Points of group codes c and c + 10, and whether their heights c + 20 are equal."""
    columns = [record.tags.numbers(record.all(code + step)) for step in (0, 10, 20)]
    if len(columns[0]) != len(columns[1]):
        raise EntityError("its points are not complete")
    is_level = len(columns[2]) == 0 or bool(np.ptp(columns[2]) == 0)
    return np.column_stack(columns[:2]), is_level


def _through(
    points: NDArray[np.float64], values: dict[int, bytes]
) -> tuple[int, NDArray[np.float64], NDArray[np.float64]]:
    """Cubic spline through points, as ezdxf guesses that CAD programs draw it."""
    if not 2 <= len(points) <= MAX_FIT_POINTS or not np.isfinite(points).all():
        raise EntityError("it has no control points, and no good points to go through")
    steps = np.hypot(*np.diff(points, axis=0).T)
    points = points[np.append(True, steps > 0)]
    if len(points) < 2:
        raise EntityError("all its points are one")
    from ezdxf.math import Vec3, fit_points_to_cad_cv

    tangents = None
    if 12 in values and 13 in values:
        tangents = [
            Vec3(number(values, code), number(values, code + 10)) for code in (12, 13)
        ]
    try:
        curve = fit_points_to_cad_cv([Vec3(x, y) for x, y in points.tolist()], tangents)
        controls = np.array([(point.x, point.y) for point in curve.control_points])
        return curve.degree, np.array(curve.knots()), controls
    except Exception as error:  # of many kinds, none of them documented
        raise EntityError("no curve goes through its points") from error


DRAWN: Final[dict[str, Callable[[Record, float, Budget], Shape]]] = {
    "LINE": _line,
    "ARC": _arc,
    "CIRCLE": _arc,
    "ELLIPSE": _ellipse,
    "LWPOLYLINE": _light_polyline,
    "POLYLINE": _heavy_polyline,
    "SPLINE": _spline,
}
"""Functions that draw entities, by name: each raises EntityError where it cannot."""
