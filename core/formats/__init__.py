"""Files that can be opened and exported: the one place where a name's suffix is looked at."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import msgspec

from core import atomic, store
from core.document import Document
from core.errors import FileError
from core.formats import dxf, pdf, points, read_json, svg, tables
from core.formats.contours import Contours
from core.formats.tables import Tables
from core.formats.verify import verify
from core.profiles import (
    DEFAULT_TOLERANCE_MM,
    ENTITIES,
    MAX_TOLERANCE_MM,
    MIN_TOLERANCE_MM,
    PROFILES,
    Profile,
    check_tolerance,
    named,
)

__all__ = [
    "DEFAULT_TOLERANCE_MM",
    "EXPORTED",
    "MAX_TOLERANCE_MM",
    "MIN_TOLERANCE_MM",
    "OPENED",
    "PROFILES",
    "Contours",
    "Encoder",
    "ExportReport",
    "Profile",
    "Tables",
    "check_tolerance",
    "export",
    "named",
    "open_document",
    "prepare",
    "profile_for",
    "register",
    "report_on",
    "survey",
]

OPENED: Final = (store.SUFFIX, *points.SUFFIXES, read_json.SUFFIX)
"""Suffixes of the files that `open_document` reads."""

Encoder = Callable[[Contours, str], bytes]
"""What makes a file of contours and a title."""

_TABLES: Final = ("csv", "tsv", "json")

_ENCODERS: Final[dict[str, Encoder]] = {
    "svg": svg.encode,
    "dxf": dxf.encode,
    "pdf": pdf.encode,
}
"""Encoders of the formats of contours; `register` adds those that need a screen's library."""

_OWN: Final = (*_ENCODERS, *_TABLES)

EXPORTED: Final = tuple("." + name for name in _OWN)
"""Suffixes of the files that can be written without anything being registered."""

_FOR_SUFFIX: Final = {".dxf": "laser", ".svg": "svg", ".pdf": "pdf", ".png": "png"}
"""Names of the profiles that a suffix alone stands for."""

_NOUNS: Final = {
    "arcs": "arc",
    "polyline": "vertex",
    "spline": "spline piece",
    "cubics": "cubic",
    "control points": "control point",
    "limit points": "point",
}

_PLURALS: Final = {"vertex": "vertices"}


@dataclass(frozen=True)
class ExportReport:
    """What an exported file holds.

    Attributes
    ----------
    path
        The file.
    profile
        What it was asked to be.
    width_mm, height_mm
        Exact extents of all contours, arcs and cubics included.
    contours, closed_contours
        Number of contours, and how many of them are closed.
    entities
        Number of arcs, of Bézier curves, of pieces of splines, of vertices of polylines, or of
        points of a table.
    deviation
        Proven bound, in mm, of the distance between the exact curves and the contours in the
        file, the rounding of its numbers included; 0 for control points.
    notes
        Sentences on what is not as one might expect.
    """

    path: Path
    profile: Profile
    width_mm: float
    height_mm: float
    contours: int
    closed_contours: int
    entities: int
    deviation: float
    notes: tuple[str, ...] = ()

    @property
    def summary(self) -> str:
        """One line: "105.60 x 62.00 mm, closed, 52 arcs, deviation <= 0.0098 mm"."""
        if self.contours == 1:
            kind = "closed" if self.closed_contours else "open"
        elif self.closed_contours in (0, self.contours):
            kind = f"{self.contours} {'closed' if self.closed_contours else 'open'} contours"
        else:
            kind = f"{self.contours} contours, {self.closed_contours} of them closed"
        noun = _NOUNS[self.profile.entity]
        if self.entities != 1:
            noun = _PLURALS.get(noun, noun + "s")
        found = f"{self.width_mm:.2f} x {self.height_mm:.2f} mm, {kind}, {self.entities:,} {noun}"
        if self.profile.entity == "control points":
            return found
        return f"{found}, deviation <= {_rounded_up(self.deviation)} mm"


def _rounded_up(value: float) -> str:
    """Two significant digits of a bound, rounded so that it stays one."""
    if value <= 0:
        return "0"
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / unit * (1 - 1e-12)) * unit:.2g}"


def open_document(path: str | Path, closed: bool | None = None) -> Document:
    """Read a drawing or a file of points.

    Parameters
    ----------
    path
        The file; its suffix, in any case of letters, says what it is.
    closed
        Whether all curves are closed; None leaves it to the file.

    Raises
    ------
    FileError
        If the suffix is not one of `OPENED`, or the file cannot be read.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in points.SUFFIXES:
        return points.read(path, closed)
    if suffix not in OPENED:
        raise _unknown(path, "opened", OPENED)
    document = read_json.read(path) if suffix == read_json.SUFFIX else store.load(path)
    if closed is None:
        return document
    curves = tuple(replace(curve, closed=closed) for curve in document.curves)
    return replace(document, curves=curves)


def profile_for(path: str | Path) -> Profile:
    """Profile that a file's suffix alone stands for: laser for .dxf, svg for .svg, and so on.

    Raises
    ------
    FileError
        If no file of such a suffix can be written.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix.removeprefix(".") in _TABLES:
        return msgspec.structs.replace(PROFILES["points"], format=suffix.removeprefix("."))
    if suffix not in _FOR_SUFFIX or suffix.removeprefix(".") not in _ENCODERS:
        raise _unknown(path, "exported", _written())
    return PROFILES[_FOR_SUFFIX[suffix]]


def register(name: str, encoder: Encoder) -> None:
    """Make a format writable whose encoder lives elsewhere: PDF and PNG are Qt's.

    Parameters
    ----------
    name
        The format, a key of `core.profiles.ENTITIES`.
    encoder
        Called with `Contours`, whose profile has everything that was asked for, and the title. It
        may raise NinepointError.
    """
    if name not in ENTITIES:
        raise ValueError(f"there is no format {name!r}")
    _ENCODERS[name] = encoder


def prepare(document: Document, profile: Profile) -> Contours | Tables:
    """What a file of a profile shows: contours for a preview, or the tables of points.

    Raises
    ------
    NinepointError
        If the drawing cannot be written so.
    """
    return Tables.of(document, profile) if profile.is_table else Contours.of(document, profile)


def survey(document: Document, profile: Profile, path: str | Path = "") -> ExportReport:
    """Tell what `export` with the same arguments would write, without writing it.

    Raises
    ------
    NinepointError
        If the drawing cannot be written so.
    """
    return report_on(prepare(document, profile), path)


def export(document: Document, path: str | Path, profile: Profile) -> ExportReport:
    """Write the curves of a document into a file for other programs.

    The file is read back by another reader, and compared, before it takes the old one's place
    (`core.formats.verify`); what encoders do that are registered is theirs.

    Parameters
    ----------
    document
        The drawing.
    path
        The file; its suffix, in any case of letters, is that of the profile. An existing file is
        replaced, whole or not at all.
    profile
        What the file is to be.

    Raises
    ------
    FileError
        If the suffix is another one, the file cannot be written, or it does not read back as the
        drawing.
    NinepointError
        If the drawing cannot be written with this profile.
    """
    path = Path(path)
    if path.suffix.lower() != profile.suffix:
        if path.suffix.lower() not in _written():
            raise _unknown(path, "exported", _written())
        raise FileError(path, f"files of the profile {profile.title} end in {profile.suffix}.")
    content = prepare(document, profile)
    report = report_on(content, path)
    if isinstance(content, Tables) and profile.format in _TABLES:
        data = tables.encode(content, path.stem)
    elif isinstance(content, Tables):
        data = dxf.encode(content, path.stem)
    elif profile.format in _ENCODERS:
        data = _ENCODERS[profile.format](content, path.stem)
    else:
        raise FileError(path, f"{profile.format.upper()} can only be written with the window.")
    if profile.format in _OWN:
        verify(data, content, path)
    atomic.write(path, data)
    return report


def report_on(content: Contours | Tables, path: str | Path = "") -> ExportReport:
    """Tell what a file of what `prepare` gave holds."""
    width, height = content.size_mm
    notes = list(content.notes)
    if content.profile.version == "R12":
        notes.append(f"DXF R12 states no unit: tell the program that it is {content.profile.unit}.")
    if isinstance(content, Contours) and content.profile.format == "svg":
        for contour, count in zip(content.contours, svg.path_counts(content), strict=True):
            if count > 1:
                notes.append(
                    f"{contour.name!r} is cut into {count} open paths that join, as many programs"
                    " refuse longer ones."
                )
    contours = content.contours if isinstance(content, Contours) else content.tables
    return ExportReport(
        Path(path),
        content.profile,
        width,
        height,
        len(contours),
        content.closed,
        content.count,
        content.deviation_mm,
        tuple(notes),
    )


def _written() -> tuple[str, ...]:
    """Suffixes of the files that can be written now."""
    return tuple("." + name for name in dict.fromkeys((*_ENCODERS, *_TABLES)))


def _unknown(path: Path, verb: str, suffixes: tuple[str, ...]) -> FileError:
    known = f"{', '.join(suffixes[:-1])} and {suffixes[-1]}"
    ending = f"files that end in {path.suffix!r}" if path.suffix else "files without an ending"
    return FileError(path, f"{ending} cannot be {verb}; the endings {known} can.")
