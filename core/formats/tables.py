"""Tables of points: CSV, TSV and JSON of control points or of exact points of the curves.

Numbers are the shortest decimals that read back as the same floats; where there is no value (the
scheme is not proven smooth enough, or the curve stands still) a field stays empty, in JSON null.
With several curves a last column counts them from 1. A closed control polygon repeats its first
point in CSV and TSV, by which Ninepoint and others see that it is closed; JSON says it in words.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from core.chords import chord_constant
from core.continuity import smoothness
from core.document import Curve, Document
from core.errors import NinepointError
from core.limit import MAX_LEVEL, LimitCurve
from core.profiles import Profile
from core.shape import curvatures, tangents

CONTROL_COLUMNS: Final[tuple[str, ...]] = ("x", "y")

LIMIT_COLUMNS: Final[tuple[str, ...]] = ("t", "x", "y", "dx", "dy", "curvature")
"""Parameter, point, derivative with respect to t, and signed curvature, positive to the left."""

MAX_ROWS: Final = 1_000_000
"""Largest number of rows that is written."""

_ORDER_OF_CURVATURE: Final = 2


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of one curve, shape (n, number of columns), in the unit of the file."""

    curve: Curve
    rows: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Tables:
    """What a table of a document holds.

    Attributes
    ----------
    document, profile
        What they are made of.
    columns
        Names of the columns.
    tables
        One for each curve that has points.
    deviation_mm
        Proven bound of the distance between the curves and the polygons through limit points; 0
        for control points.
    notes
        Sentences on what is missing.
    """

    document: Document
    profile: Profile
    columns: tuple[str, ...]
    tables: tuple[Table, ...]
    deviation_mm: float
    notes: tuple[str, ...]

    @classmethod
    def of(cls, document: Document, profile: Profile) -> Tables:
        """Make the tables of a profile.

        Limit points are those of one dyadic level, the coarsest at which the polygon through them
        is proven to keep within the tolerance.

        Raises
        ------
        NinepointError
            If there are no points, the scheme does not converge, or there would be more than
            `MAX_ROWS` rows.
        """
        curves = [curve for curve in document.curves if curve.count]
        if not curves:
            raise NinepointError("There is nothing to export: the drawing has no points.")
        notes: list[str] = []
        if profile.kerf_mm:
            notes.append("Tables of points have no kerf: these are points of the curves.")
        deviation = 0.0
        if profile.entity == "control points":
            columns = CONTROL_COLUMNS
            rows = [curve.points.copy() for curve in curves]
        else:
            columns = LIMIT_COLUMNS
            limits = [curve.limit(document.parameters) for curve in curves]
            level, deviation = _level(limits, profile.tolerance_mm)
            order = smoothness(document.parameters.mask).order
            if order is None or order < _ORDER_OF_CURVATURE:
                missing = "curvature is" if order == 1 else "tangents and curvature are"
                notes.append(f"The {missing} left out: C^{_ORDER_OF_CURVATURE} is not proven here.")
            rows = [limit_rows(limit, level) for limit in limits]
        for values in rows:
            _convert(values, columns, profile.unit_mm)
        first = columns.index("x")
        if profile.origin == "corner":
            low = np.min([values[:, first : first + 2].min(axis=0) for values in rows], axis=0)
            for values in rows:
                values[:, first : first + 2] -= low
        tables = tuple(Table(*pair) for pair in zip(curves, rows, strict=True))
        return cls(document, profile, columns, tables, deviation, tuple(notes))

    @property
    def points(self) -> list[NDArray[np.float64]]:
        """Points of the curves, shape (n, 2) each, in the unit of the file."""
        first = self.columns.index("x")
        return [table.rows[:, first : first + 2] for table in self.tables]

    @property
    def box(self) -> NDArray[np.float64]:
        """Smallest and largest x and y of the points, shape (2, 2), in the unit of the file."""
        low = np.min([points.min(axis=0) for points in self.points], axis=0)
        high = np.max([points.max(axis=0) for points in self.points], axis=0)
        return np.stack([low, high])

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height."""
        low, high = self.box
        width, height = ((high - low) * self.profile.unit_mm).tolist()
        return width, height

    @property
    def count(self) -> int:
        """Number of points."""
        return sum(len(table.rows) for table in self.tables)

    @property
    def closed(self) -> int:
        """Number of closed curves."""
        return sum(table.curve.is_loop for table in self.tables)


def limit_rows(limit: LimitCurve, level: int) -> NDArray[np.float64]:
    """Exact points of a curve at every dyadic t of a level, see `LIMIT_COLUMNS`.

    Returns
    -------
    ndarray
        Shape (k, 6), a row for each entry of ``limit.points(level)``, in the unit of the control
        points; nan where the class that is proven gives no value, and where the curve stands still.
    """
    order = smoothness(limit.mask).order
    points = limit.points(level)
    rows = np.full((len(points), len(LIMIT_COLUMNS)), math.nan)
    rows[:, 0], rows[:, 1:3] = limit.parameters(level), points
    if order is not None and order >= 1:
        rows[:, 3:5] = tangents(limit, level)
    if order is not None and order >= _ORDER_OF_CURVATURE:
        rows[:, 5] = curvatures(limit, level)
    return rows


def cell(value: float) -> str:
    """Shortest text that gives the very same float again; nothing where there is no value."""
    return "" if math.isnan(value) else repr(value)


def encode(tables: Tables, title: str) -> bytes:
    """Text of a table in the format of its profile, UTF-8.

    Parameters
    ----------
    tables
        What to write.
    title
        Name of the drawing, for JSON.
    """
    if tables.profile.format == "json":
        return _encoded_json(tables, title)
    separator = "," if tables.profile.format == "csv" else "\t"
    several = len(tables.tables) > 1
    lines = [separator.join([*tables.columns, "curve"] if several else tables.columns)]
    for number, table in enumerate(tables.tables, start=1):
        ending = f"{separator}{number}" if several else ""
        values = table.rows.tolist()
        if tables.columns == CONTROL_COLUMNS and table.curve.is_loop:
            values.append(values[0])
        lines += [separator.join(map(cell, row)) + ending for row in values]
    return ("\n".join(lines) + "\n").encode()


def _encoded_json(tables: Tables, title: str) -> bytes:
    curves = [
        {
            "closed": table.curve.is_loop,
            "name": _writable(table.curve.name),
            "rows": table.rows.tolist(),
        }
        for table in tables.tables
    ]
    whole = {
        "columns": tables.columns,
        "curves": curves,
        "title": _writable(title),
        "unit": tables.profile.unit,
    }
    # One row a line. In JSON a text holds no "],[" without a quotation mark, but rows have none.
    text = msgspec.json.encode(whole)
    return _by_lines(text) + b"\n"


def _by_lines(text: bytes) -> bytes:
    """JSON with each row of numbers on a line of its own."""
    parts = text.split(b'"rows":[[')
    for k in range(1, len(parts)):
        rows, ending, rest = parts[k].partition(b"]]")
        parts[k] = rows.replace(b"],[", b"],\n[") + ending + rest
    return b'"rows":[\n['.join(parts)


def _writable(name: str) -> str:
    """Name with a question mark for each half of a character, which UTF-8 cannot hold."""
    return name.encode("utf-8", "replace").decode()


def _convert(rows: NDArray[np.float64], columns: tuple[str, ...], unit_mm: float) -> None:
    """Change rows from millimetres into a unit, in place."""
    if unit_mm == 1:
        return
    for k, column in enumerate(columns):
        if column == "curvature":
            rows[:, k] *= unit_mm
        elif column != "t":
            rows[:, k] /= unit_mm


def _level(limits: list[LimitCurve], tolerance: float) -> tuple[int, float]:
    """Coarsest level whose polygon keeps within a tolerance, and the bound of its distance."""
    mask = limits[0].mask
    bends = [
        float(np.hypot(*np.diff(limit.endless_points, n=2, axis=0).T).max(initial=0.0))
        for limit in limits
        if limit.spans
    ]
    spans = sum(limit.spans for limit in limits)
    largest = max(bends, default=0.0)
    for level in range(MAX_LEVEL + 1):
        bound = chord_constant(mask, level) * largest
        if bound <= tolerance:
            return level, bound
        if spans << level + 1 > MAX_ROWS:
            break
    raise NinepointError(
        f"Points within {tolerance:g} mm would be more than {MAX_ROWS:,};"
        " choose a larger tolerance."
    )
