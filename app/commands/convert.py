"""`ninepoint convert`: any file that can be read, as a drawing."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

import click

from app.commands.manual import FileOf, Manual
from app.commands.reading import FILES_READ, READABLE, read_unit, reading, taking
from app.commands.scheme import closing, scheme_options
from core.errors import FileError

_EXAMPLES: Final = (
    "convert logo.svg logo.ninepoint --fit 0.05",
    "convert old.dxf old.ninepoint --vertices --unit in",
    "convert naca2412.dat wing.ninepoint --beta -1/2 --open",
)


@click.command(
    "convert",
    cls=Manual,
    short_help="Make a drawing of any file.",
    examples=_EXAMPLES,
    files=(*FILES_READ, ("OUT", "Ends in .ninepoint.")),
)
@click.argument("source", metavar="IN", type=FileOf(*READABLE))
@click.argument("target", metavar="OUT", type=FileOf(".ninepoint"))
@click.option("--force", is_flag=True, help="Replace OUT if it exists already.")
@taking
@read_unit("--unit")
@scheme_options
@closing
def convert(
    source: Path,
    target: Path,
    force: bool,
    vertices: bool,
    fit: str | None,
    read_unit: str | None,
    closed: bool | None,
    alpha: str | None,
    beta: str | None,
    gamma: str | None,
    neighbours: str | None,
) -> None:
    """Make a drawing of IN: of points, of SVG and DXF, or of a drawing with another scheme.

    The lines of SVG and DXF become control polygons by their vertices, which smooth curves then
    follow from afar; or with --fit, curves of few control points that keep to the lines, by a
    proven bound. The size is told, so that a wrong unit shows: --unit sets it right.
    """
    from core import store

    scheme = {"alpha": alpha, "beta": beta, "gamma": gamma, "neighbours": neighbours}
    how = reading(closed, scheme, vertices, fit, read_unit)
    if target.suffix.lower() != store.SUFFIX:
        raise click.UsageError(f"OUT must end in {store.SUFFIX}; other formats are exported.")
    if source.exists() and target.exists() and source.samefile(target):
        raise click.UsageError("IN and OUT are the same file.")
    if not force and os.path.lexists(target):
        raise FileError(target, "it exists already; --force replaces it.")
    document, notes = how.document(source)
    store.save(document, target)
    counts = [curve.count for curve in document.curves]
    curves = "1 curve" if len(counts) == 1 else f"{len(counts):,} curves"
    corners = [corner for curve in document.curves if curve.count for corner in curve.box]
    size = ""
    if corners:
        width = max(x for x, _ in corners) - min(x for x, _ in corners)
        height = max(y for _, y in corners) - min(y for _, y in corners)
        size = f", polygons of {width:.2f} x {height:.2f} mm"
    click.echo(f"{target}: {curves}, {sum(counts):,} control points{size}")
    for note in notes:
        click.echo(f"ninepoint: {note}", err=True)
