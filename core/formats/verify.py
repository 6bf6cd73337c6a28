"""A file is read by another reader before it replaces the old one, and compared with the drawing.

What is compared
----------------
The unit; the number of contours, of their pieces, which of them are closed, and their layers; the
box of all of them; and the distance from the exact curves, both ways: exact points of each curve,
evaluated densely, must lie within the deviation that the report states of what the file shows, and
what the file shows within the same of the curve. Nothing is taken from the way from the curve to
the file but its promise. Contours that are offset by a kerf are compared with all curves together
(`core.formats.verify_kerf`).

The cost is bounded: points and parts of outlines are at most `MOST_POINTS` each and contour beyond
those that the file has, contours that are looked at for their distance at most `MOST_CONTOURS`,
spread evenly. A million vertices take some two seconds; the writers themselves less.
"""

from __future__ import annotations

import csv
import io
import itertools
import json
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import FileError, NinepointError
from core.formats import svg, verify_dxf, verify_pdf, verify_svg
from core.formats.contours import Contour, Contours
from core.formats.dxf import layers_of
from core.formats.readback import MOST_POINTS, Readback, keep_near
from core.formats.tables import CONTROL_COLUMNS, Tables
from core.formats.verify_kerf import dense, keeps_distance
from core.limit import LimitCurve

MOST_CONTOURS: Final = 500
"""Contours whose distance from their curves is looked at."""

_FINE_SHARE: Final = 1 / 16
"""Share of the deviation by which polygons may leave what they stand for."""

_ROUNDING: Final = 64 * float(np.finfo(float).eps)
"""Rounding of what is compared, as a share of the largest coordinate."""


def verify(data: bytes, content: Contours | Tables, path: Path) -> None:
    """Refuse a file that does not read back as the drawing.

    Parameters
    ----------
    data
        The file, not yet written.
    content
        What it was made of.
    path
        Its name, for the message.

    Raises
    ------
    FileError
        If anything differs.
    """
    try:
        if isinstance(content, Contours):
            _verify_contours(data, content)
        elif content.profile.format == "dxf":
            _verify_points(data, content)
        elif content.profile.format == "json":
            _verify_json(data, content)
        else:
            _verify_rows(data, content)
    except NinepointError as error:
        raise FileError(
            path, f"read back, the file is not the drawing: {error}. Nothing was written."
        ) from error


def _verify_contours(data: bytes, content: Contours) -> None:
    profile = content.profile
    unit = profile.unit_mm
    fine = _FINE_SHARE * content.deviation_mm / unit
    counts = [1] * len(content.contours)
    if profile.format == "dxf":
        said, found = verify_dxf.outlines(data, fine)
        _require_unit(said, "" if profile.version == "R12" else profile.unit)
        moved = np.zeros(2)
    else:
        is_svg = profile.format == "svg"
        read = verify_svg.outlines if is_svg else verify_pdf.outlines
        said, size, found = read(data, fine)
        _require_unit(said, profile.unit)
        moved, page = svg.page(content)
        if not np.allclose(size, page, rtol=0, atol=10.0**-content.places):
            raise NinepointError("its page has another size")
        if is_svg:
            counts = svg.path_counts(content)
        else:
            moved = moved - (0.0, page[1])
            layers = list(dict.fromkeys(contour.layer for contour in content.contours))
            found = [verify_pdf.named(outline, layers) for outline in found]
    if len(found) != sum(counts):
        raise NinepointError(f"it has {len(found):,} contours instead of {sum(counts):,}")
    whole = _joined(found, counts)
    largest = float(np.abs(content.box).max())
    rounding = _ROUNDING * largest + 10.0**-content.places * (profile.format != "dxf")
    for contour, outline in zip(content.contours, whole, strict=True):
        _compare(contour, outline)
    low = np.min([outline.line.min(axis=0) for outline in whole], axis=0) + moved
    high = np.max([outline.line.max(axis=0) for outline in whole], axis=0) + moved
    slack = max(outline.slack for outline in whole) + rounding
    if np.abs(np.stack([low, high]) - content.box).max() > slack:
        raise NinepointError("its contours have another size")
    def placed(outline: Readback) -> NDArray[np.float64]:
        """Its line in the coordinates of the document."""
        line: NDArray[np.float64] = (outline.line + moved - content.shift) * unit
        return line

    if profile.kerf_mm:
        _verify_toolpaths(content, [placed(outline) for outline in whole], rounding * unit)
        return
    chosen = np.unique(np.linspace(0, len(whole) - 1, MOST_CONTOURS).astype(np.intp))
    for k in chosen.tolist():
        contour, outline = content.contours[k], whole[k]
        limit = contour.curve.limit(content.document.parameters)
        slack = (outline.slack + rounding) * unit
        if not _is_near(limit, placed(outline), contour.shape.deviation + slack):
            raise NinepointError(f"{contour.name!r} is further from the exact curve than stated")


def _verify_toolpaths(
    content: Contours, lines: list[NDArray[np.float64]], rounding: float
) -> None:
    """Refuse polygons, in mm, that are not the offset of the curves."""
    curves = [curve for curve in content.document.curves if curve.is_loop]
    limits = [curve.limit(content.document.parameters) for curve in curves]
    limits = [limit for limit in limits if np.ptp(limit.control_points, axis=0).any()]
    kerf = content.profile.kerf_mm
    if not keeps_distance(limits, lines, kerf, content.deviation_mm + rounding):
        raise NinepointError(f"a contour is not {abs(kerf):g} mm off the exact curves")


def _joined(found: list[Readback], counts: list[int]) -> list[Readback]:
    """Outlines of whole contours, if some were cut into several paths."""
    whole = []
    first = 0
    for count in counts:
        parts = found[first : first + count]
        first += count
        if count == 1:
            whole += parts
            continue
        if any((a.line[-1] != b.line[0]).any() for a, b in itertools.pairwise(parts)):
            raise NinepointError("a contour that was cut has a gap")
        rest = [part.line[1:] for part in parts[1:]]
        line = np.concatenate([parts[0].line, *rest])
        closed = bool((line[0] == line[-1]).all())
        slack = max(part.slack for part in parts)
        pieces = sum(part.count for part in parts)
        whole.append(Readback(line, slack, closed, pieces, parts[0].layer))
    return whole


def _compare(contour: Contour, outline: Readback) -> None:
    if outline.closed != contour.closed:
        raise NinepointError(f"{contour.name!r} is {'open' if contour.closed else 'closed'} in it")
    if outline.layer != contour.layer:
        raise NinepointError(f"{contour.name!r} is on another layer")
    if outline.count != contour.pieces:
        raise NinepointError(
            f"{contour.name!r} has {outline.count:,} pieces instead of {contour.pieces:,}"
        )


def _is_near(limit: LimitCurve, line: NDArray[np.float64], reach: float) -> bool:
    """Whether curve and polygon are within ``reach`` of each other."""
    around, slack = dense(limit)
    points = around[:-1] if limit.closed else around
    few = points[:: -(-len(points) // MOST_POINTS)]
    seen = line[:: -(-len(line) // MOST_POINTS)]
    return keep_near(few, line, reach) and keep_near(seen, around, reach + slack)


def _verify_points(data: bytes, content: Tables) -> None:
    said, found = verify_dxf.outlines(data, np.inf)
    _require_unit(said, "" if content.profile.version == "R12" else content.profile.unit)
    wanted = np.concatenate(content.points)
    if len(found) != len(wanted):
        raise NinepointError(f"it has {len(found):,} points instead of {len(wanted):,}")
    if not np.array_equal(np.concatenate([point.line for point in found]), wanted):
        raise NinepointError("its points are others")
    layers = np.repeat(layers_of(content), [len(points) for points in content.points])
    if [point.layer for point in found] != layers.tolist():
        raise NinepointError("its points are on other layers")


def _verify_rows(data: bytes, content: Tables) -> None:
    separator = "," if content.profile.format == "csv" else "\t"
    head, *lines = csv.reader(io.StringIO(data.decode()), delimiter=separator)
    several = len(content.tables) > 1
    if head != [*content.columns, *["curve"] * several]:
        raise NinepointError("its columns have other names")
    read = np.array([[float(field or "nan") for field in line] for line in lines])
    wanted = []
    for number, table in enumerate(content.tables, start=1):
        rows = table.rows
        if content.columns == CONTROL_COLUMNS and table.curve.is_loop:
            rows = np.concatenate([rows, rows[:1]])
        numbers = np.full((len(rows), int(several)), float(number))
        wanted.append(np.concatenate([rows, numbers], axis=1))
    if not np.array_equal(read, np.concatenate(wanted), equal_nan=True):
        raise NinepointError("its numbers are others")


def _verify_json(data: bytes, content: Tables) -> None:
    whole = json.loads(data)
    if whole["unit"] != content.profile.unit or whole["columns"] != list(content.columns):
        raise NinepointError("its unit or columns are others")
    for read, table in zip(whole["curves"], content.tables, strict=True):
        rows = np.array(read["rows"], dtype=np.float64)
        if not np.array_equal(rows, table.rows, equal_nan=True):
            raise NinepointError("its numbers are others")
        if read["closed"] != table.curve.is_loop:
            raise NinepointError("a closed curve is open in it")


def _require_unit(said: str, wanted: str) -> None:
    if said != wanted:
        raise NinepointError(f"its unit is {said or 'not stated'} instead of {wanted or 'none'}")
