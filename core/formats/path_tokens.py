"""Commands and numbers of the ``d`` attribute of SVG paths, 40 MB of it in a second.

The grammar is that of SVG 1.1 and 2: numbers may touch where nothing is ambiguous (``1.5.5-3``),
a comma may stand between numbers only, and the two flags of an arc are single digits that need no
separator (``a1 1 0 0110 10``). Python's regular expressions check it and NumPy reads the numbers.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

COMMANDS: Final = "MmZzLlHhVvCcSsQqTtAa"
"""Letters of all commands."""

# Possessive quantifiers (++): each part of the text is looked at once, and nothing is remembered.
_NUMBER: Final = r"[+-]?(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?+"
_BLANK: Final = r"[ \t\n\r\f]*+"
_COMMA: Final = rf"{_BLANK},?+{_BLANK}"

_PATH: Final = re.compile(
    rf"(?>{_BLANK}[{COMMANDS}](?:{_BLANK}{_NUMBER}(?:{_COMMA}{_NUMBER})*+)?+)*+".encode()
)
_ARC: Final = re.compile(
    (_COMMA.join([rf"({_NUMBER})"] * 3 + ["([01])"] * 2 + [rf"({_NUMBER})"] * 2)).encode()
)
_ARCS: Final = re.compile(
    rf"([aA]{_BLANK})((?:{_COMMA.join([_NUMBER] * 3 + ['[01]'] * 2 + [_NUMBER] * 2)}{_COMMA})++)"
    .encode()
)
_ARC_SPREAD: Final = rb"\1 \2 \3 \4 \5 \6 \7 "

# A point that begins a number right behind another number: "1.5.5" and "1e5.5".
_TOUCHING_POINT: Final = re.compile(rb"(\.[0-9]+(?:[eE][+-]?[0-9]+)?|[eE][+-]?[0-9]+)(?=\.)")

_SEPARATOR, _OF_NUMBER, _COMMAND = 0, 1, 2
_KINDS: Final = np.full(256, _OF_NUMBER, dtype=np.uint8)
_KINDS[list(b" \t\n\r\f,")] = _SEPARATOR
_KINDS[list(COMMANDS.encode())] = _COMMAND
_BLANKED: Final = bytes.maketrans((COMMANDS + ",").encode(), b" " * (len(COMMANDS) + 1))

_BLOCK: Final = 1 << 22
"""Number of bytes that are looked at together, so that the masks stay small."""


_SHORT: Final = 4000
"""Number of bytes up to which Python splits path data faster than NumPy."""

_TOGETHER: Final = 1000
"""Number of runs whose numbers are handed over together."""

_TOKEN: Final = re.compile(rf"[{COMMANDS}]|{_NUMBER}".encode())

ARITIES: Final = {
    "M": 2, "Z": 0, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7
}  # fmt: skip
"""Numbers that a segment of each command takes."""

_ARITY_OF: Final = np.zeros(256, dtype=np.intp)
for _letter, _count in ARITIES.items():
    _ARITY_OF[[ord(_letter), ord(_letter.lower())]] = _count


class Run(NamedTuple):
    """A command and all numbers behind it, those of equal commands that follow at once included.

    One beyond the range of floats is infinite.
    """

    letter: str
    numbers: list[float] | NDArray[np.float64]


def runs(text: str) -> tuple[Iterator[Run], bool]:
    """Split path data, up to the first fault of the grammar.

    Returns
    -------
    Iterator[Run], bool
        The commands, and whether there was no fault. Numbers of one command may still be too few
        or too many.
    """
    data = text.encode("ascii", "replace")
    if b"a" in data or b"A" in data:
        data = _ARCS.sub(_spread, data)
    match = _PATH.match(data)
    end = match.end() if match else 0
    is_whole = end == len(data) or not data[end:].strip()
    if end <= _SHORT:
        return iter(_few(data[:end])), is_whole
    return _many(_spaced(data[:end])), is_whole


def numbers(text: str) -> list[float] | NDArray[np.float64] | None:
    """Numbers of a list as ``points`` and ``viewBox`` have it, None if it is none."""
    found, is_whole = runs("M" + text)
    first = next(found)
    return first.numbers if is_whole and next(found, None) is None else None


def _spread(run: re.Match[bytes]) -> bytes:
    """Numbers of arcs with blanks between them."""
    return run[1] + _ARC.sub(_ARC_SPREAD, run[2])


def _few(data: bytes) -> list[Run]:
    found: list[Run] = []
    for token in _TOKEN.findall(data):
        if token.isalpha():
            values: list[float] = []
            found.append(Run(token.decode(), values))
        else:
            values.append(float(token))
    return found


def _many(data: bytes) -> Iterator[Run]:
    letters, places, starts = _places(data)
    values = _numbers(data, len(starts))
    offsets = np.append(np.searchsorted(starts, places), len(starts))
    # A command whose numbers are no full segments stays alone, so that the fault stays in place.
    arities = np.maximum(_ARITY_OF[letters], 1)
    counts = np.diff(offsets)
    alone = (counts % arities != 0) | (counts == 0)
    alone |= np.isin(letters, list(b"MmZz"))
    begins = np.ones(len(letters), dtype=bool)
    begins[1:] = (letters[1:] != letters[:-1]) | alone[1:] | alone[:-1]
    firsts = np.flatnonzero(begins)
    bounds = offsets[np.append(firsts, len(letters))]
    names = letters[firsts].tobytes().decode()
    for low in range(0, len(names), _TOGETHER):
        some = bounds[low : low + _TOGETHER + 1]
        if some[-1] - some[0] > _SHORT * _TOGETHER:
            near: list[float] | NDArray[np.float64] = values[some[0] : some[-1]]
        else:
            near = values[some[0] : some[-1]].tolist()  # short lists are faster than short arrays
        ends = (some - some[0]).tolist()
        for index, name in enumerate(names[low : low + _TOGETHER]):
            yield Run(name, near[ends[index] : ends[index + 1]])


def _spaced(data: bytes) -> bytes:
    """The same data, no two numbers of which touch."""
    for sign in (b"-", b"+"):
        data = data.replace(sign, b" " + sign)
        for exponent in (b"e", b"E"):
            data = data.replace(exponent + b" " + sign, exponent + sign)
    return _TOUCHING_POINT.sub(rb"\1 ", data)


def _places(data: bytes) -> tuple[NDArray[np.uint8], NDArray[np.intp], NDArray[np.intp]]:
    """Commands, their places, and the places where numbers start."""
    characters = np.frombuffer(data, dtype=np.uint8)
    letters, starts = [], []
    before = _SEPARATOR
    for low in range(0, len(characters), _BLOCK):
        kinds = _KINDS[characters[low : low + _BLOCK]]
        of_number = kinds == _OF_NUMBER
        begins = of_number.copy()
        begins[1:] &= ~of_number[:-1]
        begins[0] &= before != _OF_NUMBER
        letters.append(np.flatnonzero(kinds == _COMMAND) + low)
        starts.append(np.flatnonzero(begins) + low)
        before = int(kinds[-1])
    none = np.zeros(0, dtype=np.intp)
    places = np.concatenate([none, *letters])
    return characters[places], places, np.concatenate([none, *starts])


def _numbers(data: bytes, count: int) -> NDArray[np.float64]:
    if count == 0:
        return np.zeros(0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # what it says where it cannot read on; the grammar can
        return np.fromstring(data.translate(_BLANKED), dtype=np.float64, count=count, sep=" ")
