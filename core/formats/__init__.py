"""Files that can be opened and exported: the one place where a name's suffix is looked at."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Protocol

from core import atomic, store
from core.document import Document
from core.errors import FileError, NinepointError
from core.formats import dxf, points, svg
from core.formats.contours import Contours

DEFAULT_TOLERANCE_MM: Final = 0.01
"""Tolerance of an export, a tenth of what a laser or a printer resolves."""

MIN_TOLERANCE_MM: Final = 1e-6
"""Finest tolerance; below it the floats of large drawings end."""

MAX_TOLERANCE_MM: Final = 100.0
"""Coarsest tolerance."""

OPENED: Final = (store.SUFFIX, *points.SUFFIXES)
"""Suffixes of the files that `open_document` reads."""


class _Writer(Protocol):
    """What the module of a format offers."""

    GUARD_DIGITS: int

    def encode(self, contours: Contours, title: str) -> bytes: ...


_WRITERS: Final[dict[str, _Writer]] = {".svg": svg, ".dxf": dxf}

EXPORTED: Final = tuple(_WRITERS)
"""Suffixes of the files that `export` writes."""


@dataclass(frozen=True)
class ExportReport:
    """What an exported file holds.

    Attributes
    ----------
    path
        The file.
    width_mm, height_mm
        Extents of all contours.
    contours, closed_contours
        Number of contours, and how many of them are closed.
    vertices
        Number of vertices.
    deviation
        Proven bound, in mm, of the distance between the exact curves and the contours in the
        file, the rounding of the coordinates included.
    """

    path: Path
    width_mm: float
    height_mm: float
    contours: int
    closed_contours: int
    vertices: int
    deviation: float

    @property
    def summary(self) -> str:
        """One line: "200.00 x 24.02 mm, closed, 312 vertices, deviation <= 0.0098 mm"."""
        if self.contours == 1:
            kind = "closed" if self.closed_contours else "open"
        elif self.closed_contours in (0, self.contours):
            kind = f"{self.contours} {'closed' if self.closed_contours else 'open'} contours"
        else:
            kind = f"{self.contours} contours, {self.closed_contours} of them closed"
        return (
            f"{self.width_mm:.2f} x {self.height_mm:.2f} mm, {kind}, {self.vertices:,} vertices,"
            f" deviation <= {_rounded_up(self.deviation)} mm"
        )


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
    if suffix != store.SUFFIX:
        raise _unknown(path, "opened", OPENED)
    document = store.load(path)
    if closed is None:
        return document
    curves = tuple(replace(curve, closed=closed) for curve in document.curves)
    return replace(document, curves=curves)


def survey(
    document: Document, path: str | Path, tolerance_mm: float = DEFAULT_TOLERANCE_MM
) -> ExportReport:
    """Tell what `export` with the same arguments would write, without writing it.

    Parameters and errors are those of `export`.
    """
    path = Path(path)
    return _report(path, _contours(document, path, tolerance_mm))


def export(
    document: Document, path: str | Path, tolerance_mm: float = DEFAULT_TOLERANCE_MM
) -> ExportReport:
    """Write the curves of a document into a file for other programs.

    Parameters
    ----------
    document
        The drawing.
    path
        The file; its suffix, one of `EXPORTED` in any case of letters, chooses the format. An
        existing file is replaced, whole or not at all.
    tolerance_mm
        Largest distance between an exact curve and its contour in the file, from
        `MIN_TOLERANCE_MM` to `MAX_TOLERANCE_MM`.

    Raises
    ------
    FileError
        If the suffix is not known or the file cannot be written.
    NinepointError
        If the tolerance is not admitted, or the drawing cannot be written with it.
    """
    path = Path(path)
    contours = _contours(document, path, tolerance_mm)
    atomic.write(path, _writer(path).encode(contours, path.stem))
    return _report(path, contours)


def _writer(path: Path) -> _Writer:
    writer = _WRITERS.get(path.suffix.lower())
    if writer is None:
        raise _unknown(path, "exported", EXPORTED)
    return writer


def _contours(document: Document, path: Path, tolerance_mm: float) -> Contours:
    writer = _writer(path)
    if not MIN_TOLERANCE_MM <= tolerance_mm <= MAX_TOLERANCE_MM:
        raise NinepointError(
            f"The tolerance must lie between {MIN_TOLERANCE_MM:g} and {MAX_TOLERANCE_MM:g} mm,"
            f" not {tolerance_mm:g}."
        )
    return Contours.of(document, tolerance_mm, writer.GUARD_DIGITS)


def _report(path: Path, contours: Contours) -> ExportReport:
    width, height = (contours.high - contours.low).tolist()
    return ExportReport(
        path,
        width,
        height,
        len(contours.polylines),
        contours.closed,
        contours.vertices,
        contours.deviation_mm,
    )


def _unknown(path: Path, verb: str, suffixes: tuple[str, ...]) -> FileError:
    known = f"{', '.join(suffixes[:-1])} and {suffixes[-1]}"
    ending = f"files that end in {path.suffix!r}" if path.suffix else "files without an ending"
    return FileError(path, f"{ending} cannot be {verb}; the endings {known} can.")
