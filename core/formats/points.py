"""Points in two columns, x and y: CSV, TSV, plain text, airfoil coordinates (.dat). Read only.

What is taken
-------------
One point a line, in millimetres. The columns are separated by semicolons, tabs, commas or blanks;
the first line with two numbers decides, and all others must follow it. Where commas do not
separate, the decimal sign may be a comma instead of a point, but not both in one file. Lines of
words before the first point (a title, names of columns), blank lines and whatever follows a ``#``
are passed over. UTF-8, or UTF-16 with its mark.

Airfoils come in Selig's order (trailing edge, upper side, nose, lower side, trailing edge), which
is a polygon as it stands, or in Lednicer's form (a line with the two numbers of points, then upper
and lower side, both from the nose), which is brought into Selig's order.

Closed or open
--------------
The polygon is closed if its last point repeats the first (up to the rounding of a computed
repetition); the repetition is dropped. It is closed too, keeping both points, if the gap is no
wider than one hundredth of the drawing and than the median edge: a blunt trailing edge. A polygon
of fewer than three different points is open. The caller can decide otherwise.
"""

from __future__ import annotations

import codecs
import io
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core import atomic
from core.document import MAX_COORDINATE_MM, MAX_POINTS, Curve, Document
from core.errors import FileError

SUFFIXES: Final = (".csv", ".tsv", ".txt", ".dat")
"""Suffixes of files that are read as points."""

MAX_LINES: Final = 2 * MAX_POINTS
"""Largest number of lines, titles, remarks and blank lines included."""

MAX_TITLE_LINES: Final = 20
"""Number of lines of words before the first point after which a file holds no points."""

REPEATED: Final = 1e-9
"""Gap, as a share of the extent, up to which the last point repeats the first."""

BLUNT: Final = 1e-2
"""Gap, as a share of the extent, up to which a trailing edge is blunt instead of open."""

_MIN_SIDE: Final = 3
"""Fewest points of an airfoil's side; a line "2 2" is a point and no count."""

_BLANKS: Final = ""
"""Separator of columns that stand apart by any number of blanks."""

_MAX_LINE: Final = 10_000
"""Number of characters after which a line is no point."""

_SHOWN: Final = 40
"""Number of characters of a faulty text that a message quotes."""


def read(path: str | Path, closed: bool | None = None) -> Document:
    """Read a point file as a drawing of one curve.

    Parameters
    ----------
    path
        The file.
    closed
        Whether the curve is closed; None lets the points decide (see the module). True drops a
        repeated last point, False keeps all points.

    Returns
    -------
    Document
        The curve, named after the title of a ``.dat`` file or after the file, drawn by the default
        member of the family.

    Raises
    ------
    FileError
        If the file cannot be read or is not two columns of admitted numbers; with the line.
    """
    return decode(atomic.read(path), path, closed)


def decode(data: bytes, path: str | Path, closed: bool | None = None) -> Document:
    """Drawing that the text of a point file describes; see `read`.

    Parameters
    ----------
    data
        Contents of the file, or of a clipboard.
    path
        Its name, for the curve and the messages.
    closed
        As in `read`.

    Raises
    ------
    FileError
        If it is not two columns of admitted numbers; with the line.
    """
    path = Path(path)
    if not data.strip():
        raise FileError(path, "the file is empty.")
    # A carriage return alone ends a line too (old Macintosh files).
    if max(data.count(b"\n"), data.count(b"\r")) > MAX_LINES:
        raise FileError(path, f"it has more than {MAX_LINES:,} lines; thin it out.")
    rows = _Rows.parsed(_lines(data, path), path)
    points = _in_selig_order(rows, path)
    if closed is None:
        closed, repeated = closure(points)
    else:
        repeated = closed and closure(points)[1]
    if repeated:
        points = points[:-1]
    return Document((Curve(points, closed, _name(rows.titles, path)),))


def _lines(data: bytes, path: Path) -> Iterable[str]:
    """Lines of the text, one at a time; bytes that are not UTF-8 come as lone surrogates."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding, faults = "utf-16", "replace"
    elif b"\0" in data:
        raise FileError(
            path,
            "it is not a text file, or not in UTF-8.",
            data.count(b"\n", 0, data.index(b"\0")) + 1,
        )
    else:
        encoding, faults = "utf-8-sig", "surrogateescape"
    return io.TextIOWrapper(io.BytesIO(data), encoding, faults)


@dataclass(frozen=True, eq=False)
class _Rows:
    """The file's points as they stand, (n, 2), with what is known about their places."""

    points: NDArray[np.float64]
    titles: tuple[str, ...]
    count_line: int
    blank_after_count: bool

    @classmethod
    def parsed(cls, lines: Iterable[str], path: Path) -> _Rows:
        """Read all lines.

        A list of floats is appended to, twice a line: nothing faster in pure Python says in which
        line a fault is.
        """
        numbers: list[float] = []
        titles: list[tuple[int, str]] = []
        separator: str | None = None
        points_line = commas_line = 0
        first_line, blank_after = 0, False
        limit = MAX_COORDINATE_MM
        for number, line in enumerate(lines, 1):
            if len(line) > _MAX_LINE:
                raise FileError(path, "this line is too long for a point.", number)
            if "#" in line:
                line = line.partition("#")[0]
            line = line.strip()
            if not line:
                blank_after = blank_after or number == first_line + 1
                continue
            if separator is None:
                separator = _separator(line)
                if separator is None:
                    titles.append((number, line))
                    if len(titles) > MAX_TITLE_LINES:
                        break
                    continue
                first_line, blank_after = number, False
                for place, title in titles:
                    _require_words(title, separator, path, place)
            fields = line.split(separator or None)
            try:
                first, second = fields
                if separator != ",":
                    points_line = points_line or ("." in line and number)
                    if "," in line:
                        commas_line = commas_line or number
                        first, second = first.replace(",", "."), second.replace(",", ".")
                x, y = float(first), float(second)
                # A comparison with nan is false; float() would read 1_000.
                if not (-limit <= x <= limit and -limit <= y <= limit) or "_" in line:
                    raise ValueError
            except ValueError:
                x, y = _read_with_care(fields, path, number)
            numbers.append(x)
            numbers.append(y)
            if len(numbers) > 2 * MAX_POINTS:
                raise FileError(path, f"it has more than {MAX_POINTS:,} points; thin it out.")
        if separator is None:
            raise _no_points(titles, path)
        if points_line and commas_line:  # then 1,234 could mean either number
            line_of_both = max(points_line, commas_line)
            raise FileError(path, "decimal points and decimal commas are mixed.", line_of_both)
        return cls(
            np.array(numbers).reshape(-1, 2),
            tuple(title for _, title in titles),
            first_line,
            blank_after,
        )


def _separator(line: str) -> str | None:
    """Separator of a line with two numbers, None if the line does not hold two numbers."""
    if ";" in line:
        candidates = [";"]
    elif "\t" in line:
        candidates = ["\t"]
    else:
        # "1,5 2,5" has two decimal commas, "1, 2" and "1,2" a separating one.
        candidates = [_BLANKS, ","]
    for separator in candidates:
        fields = _fields(line.split(separator or None))
        if len(fields) >= 2 and all(_number(field) is not None for field in fields[:2]):
            return separator
    return None


def _fields(parts: list[str]) -> list[str]:
    """Columns without quotation marks, and without empty ones at the end of the line."""
    fields = [part.strip(' \t"') for part in parts]
    while len(fields) > 2 and not fields[-1]:
        fields.pop()
    return fields


def _number(text: str) -> float | None:
    """Value of a text, which may be nan or infinite, or None if it is no number."""
    if "_" in text or text.startswith(",") or text.endswith(","):
        return None
    try:
        return float(text.replace(",", ".", 1))
    except ValueError:
        return None


def _read_with_care(parts: list[str], path: Path, line: int) -> tuple[float, float]:
    """Read a line that is not simply two admitted numbers, or say what is wrong with it."""
    fields = _fields(parts)
    if len(fields) == 1:
        raise FileError(path, "there is only one column; x and y are needed.", line)
    if len(fields) > 2:
        raise FileError(path, f"there are {len(fields)} columns; only x and y can be read.", line)
    values = []
    for name, field in zip("xy", fields, strict=True):
        value = _number(field)
        if value is None:
            raise FileError(path, _no_number(name, field), line)
        if not math.isfinite(value):
            raise FileError(path, f"{name} is {value:g}, not a finite number.", line)
        if abs(value) > MAX_COORDINATE_MM:
            raise FileError(
                path, f"{name} is {value:g}; at most {MAX_COORDINATE_MM:g} mm are admitted.", line
            )
        values.append(value)
    return values[0], values[1]


def _no_number(name: str, field: str) -> str:
    if not field:
        return f"{name} is missing."
    if not field.isprintable():
        return f"{name} is not a number but bytes that are no UTF-8 text."
    shown = field if len(field) <= _SHOWN else field[:_SHOWN] + "..."
    return f"{name} is not a number: {shown!r}."


def _require_words(title: str, separator: str, path: Path, line: int) -> None:
    """Refuse a line before the first point that is a damaged point rather than a title.

    A title has a letter; and where columns are separated by signs none of its columns is a
    number. So no point is lost unsaid.
    """
    fields = _fields(title.split(separator or None))
    has_number = any(_number(field) is not None for field in fields)
    has_letter = any(character.isalpha() for character in title)
    if not has_letter or (separator != _BLANKS and len(fields) > 1 and has_number):
        _read_with_care(fields, path, line)


def _no_points(titles: list[tuple[int, str]], path: Path) -> FileError:
    """Fault of a file without any line of two numbers."""
    if not titles:
        return FileError(path, "there are no points in it.")
    for line, title in titles:
        if _number(title) is not None:
            return FileError(path, "there is only one column; x and y are needed.", line)
    line, _ = titles[0]
    return FileError(path, "there are no points in it: no line with two numbers, x and y.", line)


def _name(titles: tuple[str, ...], path: Path) -> str:
    """Title of an airfoil, else the file's name without its suffix."""
    is_titled = path.suffix.lower() == ".dat" and len(titles) == 1
    name = re.sub(r"\s+", " ", titles[0]) if is_titled else path.stem
    # Bytes that are not UTF-8 are most often those of the western code page.
    try:
        name.encode()
    except UnicodeEncodeError:
        return name.encode("utf-8", "surrogateescape").decode("cp1252", "replace")
    return name


def _in_selig_order(rows: _Rows, path: Path) -> NDArray[np.float64]:
    """Points as one polygon; an airfoil in Lednicer's form begins with a line of two counts."""
    points = rows.points
    upper, lower = map(float, points[0])
    sides = points[1:]
    if not (min(upper, lower) >= _MIN_SIDE and upper.is_integer() and lower.is_integer()):
        return points
    split = int(upper)
    fits = len(sides) == upper + lower
    # The coordinates are shares of the chord, so the counts stand out as a point far away.
    stands_out = rows.blank_after_count and (np.abs(sides) < _MIN_SIDE).all()
    if not stands_out and not (fits and (sides[0] == sides[split]).all()):
        return points
    if not fits:
        raise FileError(
            path,
            f"the airfoil has {len(sides)} points, but {upper:g} + {lower:g} are announced.",
            rows.count_line,
        )
    nose_repeated = bool((sides[0] == sides[split]).all())
    return np.concatenate([sides[:split][::-1], sides[split + nose_repeated :]])


def closure(points: NDArray[np.float64]) -> tuple[bool, bool]:
    """Whether a polygon is closed, and whether its last point repeats the first (see the module).

    Parameters
    ----------
    points
        Shape (n, 2), n >= 1.
    """
    if len(points) <= _MIN_SIDE:
        return False, False
    edges = np.hypot(*np.diff(points, axis=0).T)
    extent = float(np.ptp(points, axis=0).max())
    gap = float(np.hypot(*(points[-1] - points[0])))
    if gap <= REPEATED * extent:
        return True, True
    return gap <= BLUNT * extent and gap <= float(np.median(edges)), False
