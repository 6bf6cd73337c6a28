"""How the commands read a file: any that can be, with what is said about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import click

from app.commands.scheme import chosen
from core.errors import FileError, NinepointError

if TYPE_CHECKING:
    from core.document import Document
    from core.formats.sketch import Sketch

Command = TypeVar("Command", bound=Callable[..., Any])

READABLE: Final = (".ninepoint", ".csv", ".tsv", ".txt", ".dat", ".json", ".svg", ".svgz", ".dxf")
"""Suffixes that a shell offers for files to read."""

FILES_READ: Final = (
    (".ninepoint", "Drawings."),
    (".csv .tsv .txt .dat .json", "Control points, in mm; also airfoils."),
    (
        ".svg .svgz .dxf",
        (
            "Drawings of any program: their vertices, or with --fit fitted curves. An unchanged SVG"
            " of Ninepoint gives the drawing that it was made of."
        ),
    ),
)
"""What is read, for the help."""


@dataclass(frozen=True)
class Reading:
    """How files are read; a value that other processes can be given.

    Attributes
    ----------
    closed
        Close or open all curves; None leaves that to the file.
    scheme
        Options that change the scheme, by name.
    vertices
        Take the vertices of SVG and DXF in any case, even of our own.
    fit_mm
        Tolerance of curves that are fitted to SVG and DXF; None takes the vertices.
    unit
        Unit of the numbers in the file, whatever it says.
    """

    closed: bool | None = None
    scheme: dict[str, str | None] = field(default_factory=dict)
    vertices: bool = False
    fit_mm: float | None = None
    unit: str | None = None

    def document(self, path: Path) -> tuple[Document, tuple[str, ...]]:
        """Drawing in a file, and sentences on how it was taken.

        Raises
        ------
        NinepointError
            If it cannot be read so.
        """
        from core.formats import OPENED
        from core.formats.foreign import SUFFIXES, read_sketch

        suffix = path.suffix.lower()
        if suffix in SUFFIXES:
            return self.taken(read_sketch(path))
        if suffix not in OPENED:
            known = [*OPENED, *SUFFIXES]
            ending = f"files that end in {path.suffix!r}" if suffix else "files without an ending"
            raise FileError(
                path,
                f"{ending} cannot be opened; the endings {', '.join(known[:-1])} and"
                f" {known[-1]} can.",
            )
        return self._opened(path), ()

    def taken(self, sketch: Sketch) -> tuple[Document, tuple[str, ...]]:
        """The same of a sketch that was read."""
        from core.family import PRESETS
        from core.formats.foreign import polygons

        if self.unit is not None:
            sketch = sketch.in_unit(self.unit)
        notes = list(sketch.notes)
        own = sketch.document
        if own is not None and not self.vertices and self.fit_mm is None:
            return self._changed(own), tuple(notes)
        if not sketch.is_unit_known:
            width, height = (sketch.high - sketch.low).tolist()
            notes.append(
                f"it does not say its unit: taken in {sketch.unit}, it is {width:.2f} x"
                f" {height:.2f} mm."
            )
        parameters = chosen(PRESETS["Calm"], **self.scheme)
        if self.fit_mm is None:
            return self._closed(polygons(sketch, parameters)), tuple(notes)
        from core.formats.fitted import fitted

        document, deviation = fitted(sketch, parameters, self.fit_mm)
        count = sum(curve.count for curve in document.curves)
        notes.append(f"{count:,} control points keep within {deviation:.2g} mm of it.")
        return self._closed(document), tuple(notes)

    def _opened(self, path: Path) -> Document:
        from core.formats import open_document
        from core.formats.sketch import UNITS_MM
        from core.store import SUFFIX

        document = open_document(path, self.closed)
        if self.unit is not None:
            if path.suffix.lower() == SUFFIX:
                raise FileError(path, "a drawing is in mm; a unit can be given of other files.")
            factor = UNITS_MM[self.unit]
            curves = (replace(curve, points=curve.points * factor) for curve in document.curves)
            document = replace(document, curves=tuple(curves))
        return self._changed(document)

    def _changed(self, document: Document) -> Document:
        parameters = chosen(document.parameters, **self.scheme)
        return self._closed(document.with_parameters(parameters))

    def _closed(self, document: Document) -> Document:
        if self.closed is None:
            return document
        curves = tuple(replace(curve, closed=self.closed) for curve in document.curves)
        return replace(document, curves=curves)


def taking(command: Command) -> Command:
    """Add the options `vertices` and `fit`, of which one can be given."""
    command = click.option(
        "--fit",
        metavar="MM",
        help="Fit curves of few points to SVG and DXF, no further than this from them.",
    )(command)
    return click.option(
        "--vertices",
        is_flag=True,
        help="Take the vertices of SVG and DXF as control points; this is the default, but for"
        " files of Ninepoint.",
    )(command)


def read_unit(name: str) -> Callable[[Command], Command]:
    """Option of the unit of files that are read, under a name of the command's."""
    return click.option(
        name,
        "read_unit",
        type=click.Choice(["mm", "cm", "m", "in", "ft", "pt", "px", "µm"]),
        help="Unit of the numbers in IN; by default what the file says, else mm.",
    )


def reading(
    closed: bool | None,
    scheme: dict[str, str | None],
    vertices: bool,
    fit: str | None,
    unit: str | None,
) -> Reading:
    """Reading that options ask for.

    Raises
    ------
    NinepointError
        If they do not go together, or a number is none.
    """
    from core.family import exact

    if vertices and fit is not None:
        raise click.UsageError("Choose one of --vertices and --fit.")
    fit_mm = None if fit is None else float(exact(fit, "--fit"))
    if fit_mm is not None and not fit_mm > 0:
        raise NinepointError(f"--fit must be greater than 0 mm, not {fit}.")
    return Reading(closed, scheme, vertices, fit_mm, unit)
