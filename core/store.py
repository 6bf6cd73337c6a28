"""Ninepoint's own file: a document as JSON with a version and a checksum.

The text is made for version control: sorted keys, one control point a line, the same bytes for
the same document. Coordinates are the shortest decimals that read back as the same floats, scheme
parameters exact fractions. The checksum is the SHA-256 of the file without the checksum's own
line (line ends counted as one LF), so every cut and every flipped bit is found. A file without
that line is accepted unchecked: this is how one that was merged or edited by hand is opened.
"""

from __future__ import annotations

import hashlib
import itertools
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import msgspec
import numpy as np
from msgspec import UNSET, UnsetType

from core import atomic, profiles
from core.document import MAX_POINTS, Curve, Document
from core.errors import FileError, NinepointError
from core.family import Parameters
from core.profiles import Profile

SUFFIX: Final = ".ninepoint"
"""Suffix of Ninepoint's own files."""

FORMAT: Final = "ninepoint"
"""What the field "format" says, by which a foreign JSON file is told apart."""

VERSION: Final = 2
"""Latest version of the format that is read. It is written for drawings with export profiles of
their own; others are written in version 1, which older programs open too."""

_PLAIN_VERSION: Final = 1

MAX_CURVES: Final = 100_000
"""Largest number of curves in a file."""

_MAX_BRACKETS: Final = 2 * (MAX_POINTS + MAX_CURVES)
"""Each point and each curve has one bracket, and names may have some: a count before parsing."""

_CHECKSUM_LINE: Final = ' "checksum": "sha256:{}",\n'
_SHOWN: Final = 60
"""Number of characters of a faulty text that a message quotes."""


# A field that is not known is an error, not something to drop.


class _CurveRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    closed: bool
    name: str
    points: list[tuple[float, float]]


class _SchemeRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    alpha: str
    beta: str
    gamma: str
    neighbours: str


class _FileRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    curves: list[_CurveRecord]
    format: str
    parameters: _SchemeRecord
    version: int
    profiles: list[Profile] = []
    checksum: str | UnsetType = UNSET


class _Header(msgspec.Struct, frozen=True):
    """What every version of the format has."""

    format: str | None = None
    version: int | None = None


_FILE_DECODER: Final = msgspec.json.Decoder(_FileRecord)
_HEADER_DECODER: Final = msgspec.json.Decoder(_Header)


def encode(document: Document) -> bytes:
    """Text of a document's file, UTF-8; the same for equal documents.

    Raises
    ------
    NinepointError
        If the document has more than `MAX_CURVES` curves.
    """
    if len(document.curves) > MAX_CURVES:
        raise NinepointError(
            f"The drawing has {len(document.curves):,} curves; at most {MAX_CURVES:,} can be saved."
        )
    scheme = document.parameters
    lines = [b' "curves": [', b",".join(map(_encoded_curve, document.curves)), b"\n ],\n"]
    lines.append(
        (
            f' "format": "{FORMAT}",\n'
            ' "parameters": {\n'
            f'  "alpha": "{scheme.alpha}",\n'
            f'  "beta": "{scheme.beta}",\n'
            f'  "gamma": "{scheme.gamma}",\n'
            f'  "neighbours": "{scheme.neighbours}"\n'
            " },\n"
        ).encode()
    )
    if document.profiles:
        held = b",".join(b"\n  " + profiles.encode(profile) for profile in document.profiles)
        lines.append(b' "profiles": [' + held + b"\n ],\n")
    version = VERSION if document.profiles else _PLAIN_VERSION
    lines.append(f' "version": {version}\n}}\n'.encode())
    rest = b"".join(lines)
    digest = hashlib.sha256(b"{\n" + rest).hexdigest()
    return b"{\n" + _CHECKSUM_LINE.format(digest).encode() + rest


def _encoded_curve(curve: Curve) -> bytes:
    points = msgspec.json.encode(curve.points.tolist()).removeprefix(b"[").removesuffix(b"]")
    lines = points.replace(b"],[", b"],\n    [")
    body = b"[\n    " + lines + b"\n   ]" if lines else b"[]"
    closed = b"true" if curve.closed else b"false"
    name = msgspec.json.encode(_writable(curve.name))
    return (
        b'\n  {\n   "closed": ' + closed + b',\n   "name": ' + name + b',\n   "points": ' + body
    ) + b"\n  }"


def _writable(name: str) -> str:
    """Name with a question mark for each half of a character, which UTF-8 cannot hold."""
    return name.encode("utf-8", "replace").decode()


def decode(data: bytes, path: str | Path) -> Document:
    """Document that a file's text describes.

    Parameters
    ----------
    data
        Contents of the file.
    path
        Its name, for the messages.

    Raises
    ------
    FileError
        If the text is damaged, of another kind, of a newer version, or describes something that
        a document must not hold.
    """
    if not data.strip():
        raise FileError(path, "the file is empty.")
    if data.count(b"[") > _MAX_BRACKETS:
        raise FileError(path, f"it holds more than {MAX_POINTS:,} points.")
    _require_version(data, path)
    try:
        record = _FILE_DECODER.decode(data)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise _damage(error, data, path) from error
    _require_checksum(record, data, path)
    if len(record.curves) > MAX_CURVES:
        raise FileError(path, f"it holds more than {MAX_CURVES:,} curves.")
    try:
        scheme = record.parameters
        return Document(
            tuple(map(_decoded_curve, record.curves)),
            Parameters(scheme.alpha, scheme.beta, scheme.gamma, scheme.neighbours),
            tuple(record.profiles),
        )
    except NinepointError as error:
        raise FileError(path, str(error)) from error


def _decoded_curve(record: _CurveRecord) -> Curve:
    flat = itertools.chain.from_iterable(record.points)
    points = np.fromiter(flat, dtype=np.float64, count=2 * len(record.points)).reshape(-1, 2)
    return Curve(points, record.closed, record.name)


def _require_version(data: bytes, path: str | Path) -> None:
    """Refuse what is no Ninepoint file or a newer one, before its details are looked at."""
    try:
        header = _HEADER_DECODER.decode(data)
    except msgspec.ValidationError:
        header = _Header()
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise _damage(error, data, path) from error
    if header.format != FORMAT or header.version is None or header.version < 1:
        raise FileError(path, "it is not a Ninepoint drawing.")
    if header.version > VERSION:
        raise FileError(
            path,
            f"it was written by a newer Ninepoint (format {header.version});"
            " update Ninepoint to open it.",
        )


def _require_checksum(record: _FileRecord, data: bytes, path: str | Path) -> None:
    if isinstance(record.checksum, UnsetType):
        return
    content = data.replace(b"\r\n", b"\n")
    line = ' "checksum": ' + msgspec.json.encode(record.checksum).decode() + ",\n"
    digest = hashlib.sha256(content.replace(line.encode(), b"", 1)).hexdigest()
    if line != _CHECKSUM_LINE.format(digest):
        raise FileError(
            path,
            "its contents do not match its checksum: it is damaged, or it was changed by"
            ' another program. To open it unchecked, delete the line that begins with "checksum".',
        )


def _damage(error: Exception, data: bytes, path: str | Path) -> FileError:
    """Fault of a text that is not JSON, or not of our form, with its line if it has one."""
    message = str(error)
    if isinstance(error, msgspec.ValidationError):
        fault, _, place = message.partition(" - at `$")
        where = f" at {place.rstrip('`').lstrip('.')}" if place else ""
        return FileError(path, f"it does not have the form of a drawing{where}: {fault}.")
    if isinstance(error, RecursionError):
        return FileError(path, "it is not a Ninepoint drawing.")
    if "truncated" in message:
        return FileError(path, "the file is cut off here.", data.count(b"\n") + 1)
    if isinstance(error, UnicodeDecodeError):
        return FileError(path, "it is not UTF-8 text.")
    if (found := re.search(r"\(byte (\d+)\)", message)) is None:
        return FileError(path, f"it is damaged ({message[:_SHOWN]}).")
    line = data.count(b"\n", 0, int(found[1])) + 1
    fault = message.removeprefix("JSON is malformed: ").removesuffix(found[0]).strip()
    return FileError(path, f"it is damaged, or not a Ninepoint drawing ({fault}).", line)


def load(path: str | Path) -> Document:
    """Read a document from its file.

    Raises
    ------
    FileError
        If there is no such file, it has more than `core.atomic.MAX_BYTES` bytes, or `decode`
        refuses it.
    """
    return decode(atomic.read(path), path)


def save(document: Document, path: str | Path) -> None:
    """Write a document to its file; afterwards the file is whole and reads back as the document.

    Raises
    ------
    FileError
        If it cannot be written. The file is then what it was before.
    """
    try:
        data = encode(document)
    except NinepointError as error:
        raise FileError(path, str(error)) from error
    if len(data) > atomic.MAX_BYTES:
        raise FileError(path, "the drawing is too large to be opened again; shorten its names.")
    if not _are_same(decode(data, path), document):
        raise FileError(path, "the drawing does not read back as it is; nothing was written.")
    atomic.write(path, data)


def _are_same(one: Document, other: Document) -> bool:
    """Whether two documents are equal in every bit that a file keeps."""
    same = one.parameters == other.parameters and one.profiles == other.profiles
    return same and _keys(one.curves) == _keys(other.curves)


def _keys(curves: Sequence[Curve]) -> list[tuple[bytes, bool, str]]:
    return [(curve.points.tobytes(), curve.closed, _writable(curve.name)) for curve in curves]
