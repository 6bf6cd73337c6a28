"""JSON of control points, as `core.formats.tables` writes it. Read only.

What is taken
-------------
An object with ``columns`` (``["x", "y"]``), ``unit`` and ``curves``, each with ``name``, ``closed``
and ``rows`` of numbers; or nothing but a list of points ``[[x, y], ...]``, in millimetres, which
closes by the same signs as other files of points (`core.formats.points`). A table of exact points
of the curves is refused: as control points they would draw other curves.
"""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from core import atomic
from core.document import MAX_POINTS, Curve, Document
from core.errors import FileError, NinepointError
from core.formats import points
from core.formats.sketch import UNITS_MM
from core.formats.tables import CONTROL_COLUMNS
from core.store import MAX_CURVES

SUFFIX: Final = ".json"
"""Suffix of files that are read as this JSON."""

_MAX_BRACKETS: Final = 2 * (MAX_POINTS + MAX_CURVES)
"""Each point and each curve has one bracket, and names may have some: a count before parsing."""

_SHOWN: Final = 60
"""Number of characters of a faulty text that a message quotes."""


# A field that is not known is passed over: other programs may add their own.


class _CurveRecord(msgspec.Struct, frozen=True):
    rows: list[tuple[float, float]]
    closed: bool = False
    name: str = ""


class _TableRecord(msgspec.Struct, frozen=True):
    curves: list[_CurveRecord]
    unit: str = "mm"


class _Header(msgspec.Struct, frozen=True):
    """What is looked at before the points, by which files of other kinds are told apart."""

    columns: tuple[str, ...] = CONTROL_COLUMNS
    format: str = ""


_TABLE_DECODER: Final = msgspec.json.Decoder(_TableRecord)
_HEADER_DECODER: Final = msgspec.json.Decoder(_Header)
_POINTS_DECODER: Final = msgspec.json.Decoder(list[tuple[float, float]])


def read(path: str | Path) -> Document:
    """Read a file of control points as a drawing.

    Raises
    ------
    FileError
        If the file cannot be read, or `decode` refuses it.
    """
    return decode(atomic.read(path), path)


def decode(data: bytes, path: str | Path) -> Document:
    """Drawing that a JSON text describes, drawn by the default member of the family.

    Parameters
    ----------
    data
        The text, UTF-8.
    path
        Its name, for the messages and for curves without one.

    Raises
    ------
    FileError
        If it is damaged, of another form, or describes something that a document must not hold.
    """
    path = Path(path)
    data = data.removeprefix(b"\xef\xbb\xbf").strip()
    if not data:
        raise FileError(path, "the file is empty.")
    if data.count(b"[") > _MAX_BRACKETS:
        raise FileError(path, f"it holds more than {MAX_POINTS:,} points.")
    try:
        if data.startswith(b"["):
            return _of_points(_POINTS_DECODER.decode(data), path)
        _require_control_points(_HEADER_DECODER.decode(data), path)
        return _of_table(_TABLE_DECODER.decode(data), path)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise _damage(error, data, path) from error
    except FileError:
        raise
    except NinepointError as error:
        raise FileError(path, str(error)) from error


def _of_points(rows: list[tuple[float, float]], path: Path) -> Document:
    """Drawing of one curve through nothing but points."""
    if not rows:
        raise FileError(path, "there are no points in it.")
    whole = Curve(_array(rows), closed=False, name=path.stem)
    closed, is_repeated = points.closure(whole.points)
    kept = whole.points[:-1] if is_repeated else whole.points
    return Document((Curve(kept, closed, path.stem),))


def _of_table(record: _TableRecord, path: Path) -> Document:
    if record.unit not in UNITS_MM:
        raise FileError(
            path, f"there is no unit {record.unit[:_SHOWN]!r}; {', '.join(UNITS_MM)} are known."
        )
    if len(record.curves) > MAX_CURVES:
        raise FileError(path, f"it holds more than {MAX_CURVES:,} curves.")
    if not any(curve.rows for curve in record.curves):
        raise FileError(path, "there are no points in it.")
    factor = UNITS_MM[record.unit]
    return Document(
        tuple(
            Curve(_array(curve.rows) * factor, curve.closed, curve.name or f"Curve {number}")
            for number, curve in enumerate(record.curves, 1)
        )
    )


def _array(rows: list[tuple[float, float]]) -> NDArray[np.float64]:
    flat = itertools.chain.from_iterable(rows)
    return np.fromiter(flat, dtype=np.float64, count=2 * len(rows)).reshape(-1, 2)


def _require_control_points(header: _Header, path: Path) -> None:
    if header.format == "ninepoint":
        raise FileError(path, "it is a Ninepoint drawing; let its name end in .ninepoint.")
    if header.columns != CONTROL_COLUMNS:
        shown = ", ".join(header.columns)[:_SHOWN]
        raise FileError(
            path,
            f"it has the columns {shown}; only control points, x and y, can be read from JSON.",
        )


def _damage(error: Exception, data: bytes, path: Path) -> FileError:
    """Fault of a text that is not JSON, or not of our form, with its line if it has one."""
    message = str(error)
    if isinstance(error, msgspec.ValidationError):
        fault, _, place = message.partition(" - at `$")
        where = f" at {place.rstrip('`').lstrip('.')}" if place.strip("`") else ""
        return FileError(path, f"it does not have the form of points{where}: {fault}.")
    if isinstance(error, RecursionError):
        return FileError(path, "it is nested too deeply to be points.")
    if "truncated" in message:
        return FileError(path, "the file is cut off here.", data.count(b"\n") + 1)
    if isinstance(error, UnicodeDecodeError):
        return FileError(path, "it is not UTF-8 text.")
    if (found := re.search(r"\(byte (\d+)\)", message)) is None:
        return FileError(path, f"it is damaged ({message[:_SHOWN]}).")
    line = data.count(b"\n", 0, int(found[1])) + 1
    fault = message.removeprefix("JSON is malformed: ").removesuffix(found[0]).strip()
    return FileError(path, f"it is damaged, or no JSON ({fault}).", line)
