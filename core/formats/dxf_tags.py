"""DXF as tags (pairs of a group code and a value) and records, 80 MB of them in seconds.

A file of two million vertices has twenty million lines. NumPy finds the lines and reads the group
codes; values are looked at when somebody asks for them. Nothing is repaired by guessing: what
stands before the first fault is read, and the fault is told.
"""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import FileError

MAX_RECORDS: Final = 1_000_000
"""Largest number of records in a file, vertices not counted."""

MAX_LINES: Final = 24_000_000
"""Largest number of lines: 2 million vertices of a POLYLINE take 20 million."""

_BINARY: Final = b"AutoCAD Binary DXF"
_DWG: Final = re.compile(rb"(?:AC10[0-9][0-9]|AC1\.[0-9]|AC2\.[0-9]|MC0\.0)")
_CODE_WIDTH: Final = 8
"""Longest line of a group code, blanks included."""

_TAB, _LINE_FEED, _RETURN, _BLANK = 9, 10, 13, 32
_ZERO, _NINE = 48, 57
_BLOCK: Final = 1 << 20
"""Number of values that are read together."""


class EntityError(Exception):
    """A record cannot be drawn; the file as a whole can still be read."""


@dataclass(frozen=True, eq=False)
class Tags:
    """All tags of a file up to the first fault.

    Attributes
    ----------
    data
        The file.
    codes
        Group codes, shape (n,).
    starts, ends
        Where the lines of the values start and end, shape (n,).
    fault_line
        Line (from 1) of the first fault, None if the file ends as it should.
    """

    data: bytes
    codes: NDArray[np.int32]
    starts: NDArray[np.int32]
    ends: NDArray[np.int32]
    fault_line: int | None

    def value(self, index: int) -> bytes:
        """Value of a tag without blanks around it."""
        return self.data[self.starts[index] : self.ends[index]].strip()

    def numbers(self, indices: NDArray[np.intp]) -> NDArray[np.float64]:
        """Values of tags as numbers, shape (k,).

        Raises
        ------
        EntityError
            If one of them is no number.
        """
        parts = []
        for low in range(0, len(indices), _BLOCK):
            some = indices[low : low + _BLOCK]
            data = self.data
            words = [
                data[start:end]
                for start, end in zip(
                    self.starts[some].tolist(), self.ends[some].tolist(), strict=True
                )
            ]
            try:
                parts.append(_numbers(words))
            except ValueError as error:
                raise EntityError("a coordinate is no number") from error
        return np.concatenate([np.zeros(0), *parts])


def _numbers(words: list[bytes]) -> NDArray[np.float64]:
    if len(words) < _CODE_WIDTH:
        return np.array([float(word) for word in words])
    text = b" ".join(words)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = np.fromstring(text, dtype=np.float64, sep=" ")
        except DeprecationWarning:
            found = np.zeros(0)
    # An empty line, or one with two numbers, gives another count.
    return found if len(found) == len(words) else np.array([float(word) for word in words])


def tags(data: bytes, path: Path) -> Tags:
    """Tags of a text file.

    Raises
    ------
    FileError
        If it is a DWG, a binary DXF, or no DXF at all.
    """
    if not data.strip():
        raise FileError(path, "the file is empty.")
    if data.startswith(_BINARY):
        raise FileError(path, "it is a binary DXF; save it as an ASCII DXF.")
    if _DWG.match(data):
        raise FileError(path, "it is a DWG, which only CAD programs read; save it as a DXF.")
    if b"\n" not in data:
        data = data.replace(b"\r", b"\n")  # old Macintosh files
    if data.count(b"\n") > MAX_LINES:
        raise FileError(path, f"it has more than {MAX_LINES:,} lines; save a part of it as a file.")
    characters = np.frombuffer(data, dtype=np.uint8)
    ends = np.flatnonzero(characters == _LINE_FEED).astype(np.int32)
    if len(data) and data[-1] != _LINE_FEED:
        ends = np.append(ends, np.int32(len(data)))
    starts = np.concatenate([np.zeros(1, dtype=np.int32), ends[:-1] + np.int32(1)])
    count = len(ends) // 2
    codes, is_code = _codes(characters, starts[: 2 * count : 2], ends[: 2 * count : 2])
    value_starts, value_ends = starts[1 : 2 * count : 2], ends[1 : 2 * count : 2]
    end = _end_of_file(data, codes, value_starts, value_ends)
    faults = np.flatnonzero(~is_code[:end])
    kept = int(faults[0]) if len(faults) else end
    if kept == 0:
        raise FileError(path, "it is no DXF: it does not begin with a group code.", 1)
    is_whole = kept == end and end < count
    return Tags(
        data, codes[:kept], value_starts[:kept], value_ends[:kept],
        None if is_whole else 2 * kept + 1,
    )  # fmt: skip


def _codes(
    characters: NDArray[np.uint8], starts: NDArray[np.int32], ends: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.bool_]]:
    """Numbers in lines, and whether each line is a number with blanks around it, and no more.

    One pass over all lines for each column.
    """
    codes = np.zeros(len(starts), dtype=np.int32)
    digits = np.zeros(len(starts), dtype=np.uint8)
    is_code = ends - starts <= _CODE_WIDTH + 1
    is_behind = np.zeros(len(starts), dtype=bool)
    width = int(np.minimum(ends - starts, _CODE_WIDTH + 1).max(initial=0))
    for column in range(width):
        places = starts + np.int32(column)
        inside = places < ends
        here = characters[np.minimum(places, len(characters) - 1)]
        is_digit = inside & (here >= _ZERO) & (here <= _NINE)
        is_blank = ~inside | (here == _BLANK) | (here == _RETURN) | (here == _TAB)
        is_code &= is_digit | is_blank
        is_code &= ~(is_digit & is_behind)
        codes = np.where(is_digit, codes * 10 + (here.astype(np.int32) - _ZERO), codes)
        digits += is_digit
        is_behind |= is_blank & (digits > 0)
    is_code &= (digits > 0) & (digits <= 4)
    return codes, is_code


def _end_of_file(
    data: bytes, codes: NDArray[np.int32], starts: NDArray[np.int32], ends: NDArray[np.int32]
) -> int:
    """Index of the tag (0, EOF), or the number of tags."""
    # It stands at the end but for blank lines; elsewhere the text could be any value.
    place = data.rfind(b"EOF")
    while place >= 0:
        index = int(np.searchsorted(starts, place, side="right")) - 1
        if 0 <= index < len(codes) and codes[index] == 0:
            word = data[starts[index] : ends[index]].strip()
            if word == b"EOF":
                return index
        place = data.rfind(b"EOF", 0, place)
        if place < len(data) - 1_000_000:
            break
    return len(codes)


@dataclass(frozen=True, eq=False, slots=True)
class Record:
    """One entity, table entry or mark: a tag with code 0, and those up to the next one.

    Attributes
    ----------
    tags
        All tags.
    name
        Value of the tag with code 0.
    low, high
        Range of the tags behind it; a POLYLINE's has those of its vertices too.
    own
        End of the record's own tags.
    """

    tags: Tags
    name: str
    low: int
    high: int
    own: int

    def first(self) -> dict[int, bytes]:
        """First value of each group code."""
        found: dict[int, bytes] = {}
        whole = self.tags
        data = whole.data
        for code, start, end in zip(
            whole.codes[self.low : self.own].tolist(),
            whole.starts[self.low : self.own].tolist(),
            whole.ends[self.low : self.own].tolist(),
            strict=True,
        ):
            if code not in found:
                found[code] = data[start:end].strip()
        return found

    def all(self, code: int) -> NDArray[np.intp]:
        """Indices of the record's tags with a group code."""
        return np.flatnonzero(self.tags.codes[self.low : self.own] == code) + self.low


def records(whole: Tags, path: Path) -> list[Record]:
    """Records of a file; vertices belong to their POLYLINE. One that is cut off is left out.

    Raises
    ------
    FileError
        If there are more than `MAX_RECORDS`.
    """
    heads = np.flatnonzero(whole.codes == 0)
    is_vertex = _are(whole, heads, b"VERTEX")
    mains = np.flatnonzero(~is_vertex)
    if len(mains) > MAX_RECORDS:
        raise FileError(
            path, f"it has more than {MAX_RECORDS:,} records; save a part of it as a file."
        )
    after = np.append(heads, len(whole.codes))
    places = heads[mains].tolist()
    highs = np.append(heads[mains], len(whole.codes))[1:].tolist()
    owns = after[mains + 1].tolist()
    data = whole.data
    names = [
        data[start:end].strip().decode("ascii", "replace").upper()
        for start, end in zip(
            whole.starts[places].tolist(), whole.ends[places].tolist(), strict=True
        )
    ]
    found = [
        Record(whole, name, place + 1, high, own)
        for name, place, high, own in zip(names, places, highs, owns, strict=True)
    ]
    return found if whole.fault_line is None else found[:-1]


def _are(whole: Tags, indices: NDArray[np.intp], word: bytes) -> NDArray[np.bool_]:
    """Whether the values of tags begin with a word, blanks before it apart."""
    characters = np.frombuffer(whole.data, dtype=np.uint8)
    starts, ends = whole.starts[indices], whole.ends[indices]
    last = len(characters) - 1
    for _ in range(_CODE_WIDTH):
        blank = characters[np.minimum(starts, last)] == _BLANK
        if not blank.any():
            break
        starts = starts + blank
    same = ends - starts >= len(word)
    for offset, letter in enumerate(word):
        same &= characters[np.minimum(starts + offset, last)] == letter
    return same
