"""`ninepoint sample`: exact points, tangents and curvature at dyadic parameters."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

import click

from app.commands.manual import FileOf, Manual
from app.commands.reading import FILES_READ, READABLE, Reading
from app.commands.scheme import closing, scheme_options
from core.errors import FileError, NinepointError

MAX_SAMPLES: Final = 5_000_000
"""Largest number of lines that is written."""

_MAX_LEVEL: Final = 20

_NEEDED_ORDER: Final = 2
"""Class that all columns need: curvature is made of second derivatives."""

_EXAMPLES: Final = (
    "sample wing.ninepoint --level 4",
    "sample points.csv --level 6 --beta -1 --open --csv samples.csv",
)


@click.command(
    "sample",
    cls=Manual,
    short_help="Print exact points.",
    examples=_EXAMPLES,
    files=FILES_READ,
)
@click.argument("source", metavar="IN", type=FileOf(*READABLE))
@click.option(
    "--level",
    type=click.IntRange(0, _MAX_LEVEL),
    default=4,
    show_default=True,
    help="Each span is cut into 2^LEVEL pieces.",
)
@scheme_options
@closing
@click.option(
    "--csv",
    "target",
    metavar="OUT",
    type=click.Path(path_type=Path),
    help="Write into a file instead of the terminal.",
)
@click.option("--force", is_flag=True, help="Replace OUT if it exists already.")
def sample(
    source: Path,
    level: int,
    alpha: str | None,
    beta: str | None,
    gamma: str | None,
    neighbours: str | None,
    closed: bool | None,
    target: Path | None,
    force: bool,
) -> None:
    """Print t, x, y, dx, dy and curvature of the curves of IN at every dyadic t of a level.

    Values are exact up to rounding. dx and dy are derivatives with respect to t, the curvature is
    in 1/mm, positive to the left. Columns stay empty where the scheme is not proven smooth
    enough, and where the curve stands still. With several curves a last column says which one a
    line belongs to.
    """
    from core import atomic
    from core.continuity import smoothness
    from core.formats.tables import LIMIT_COLUMNS, cell, limit_rows

    scheme = {"alpha": alpha, "beta": beta, "gamma": gamma, "neighbours": neighbours}
    document, notes = Reading(closed, scheme).document(source)
    parameters = document.parameters
    limits = [curve.limit(parameters) for curve in document.curves]
    total = sum(limit.spans for limit in limits) * 2**level
    if total > MAX_SAMPLES:
        raise NinepointError(
            f"Level {level} would give {total:,} lines; at most {MAX_SAMPLES:,} are written."
        )
    several = len(limits) > 1
    order = smoothness(parameters.mask).order
    if order is None or order < _NEEDED_ORDER:
        missing = "the curvature stays" if order == 1 else "tangents and curvature stay"
        click.echo(f"ninepoint: {missing} empty: C^{_NEEDED_ORDER} is not proven here.", err=True)
    for note in notes:
        click.echo(f"ninepoint: {note}", err=True)
    lines = [",".join(LIMIT_COLUMNS) + (",curve" if several else "")]
    for number, limit in enumerate(limits, start=1):
        ending = f",{number}" if several else ""
        rows = limit_rows(limit, level).tolist()
        lines += [",".join(map(cell, row)) + ending for row in rows]
    text = "\n".join(lines) + "\n"
    if target is None:
        click.echo(text, nl=False)
        return
    if target.exists() and target.samefile(source):
        raise click.UsageError("IN and OUT are the same file.")
    if not force and os.path.lexists(target):
        raise FileError(target, "it exists already; --force replaces it.")
    atomic.write(target, text.encode())
    click.echo(f"{target}: {len(lines) - 1:,} points")
