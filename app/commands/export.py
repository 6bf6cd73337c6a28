"""`ninepoint export`: the curves of a file for other programs."""

from __future__ import annotations

from pathlib import Path

import click

from app.commands.scheme import chosen, closing, scheme_options

_EXAMPLES = """\
\b
Examples:
  ninepoint export wing.ninepoint wing.dxf
  ninepoint export naca2412.dat wing.svg --tolerance 0.001
  ninepoint export points.csv shape.svg --alpha 1/4 --beta -1/2 --gamma 1/4 --closed
"""


@click.command("export", epilog=_EXAMPLES)
@click.argument("source", metavar="IN", type=click.Path(path_type=Path))
@click.argument("target", metavar="OUT", type=click.Path(path_type=Path))
@click.option(
    "--tolerance",
    metavar="MM",
    default="0.01",
    show_default=True,
    help="Largest distance between the exact curve and what is written, in mm.",
)
@scheme_options
@closing
def export(
    source: Path,
    target: Path,
    tolerance: str,
    alpha: str | None,
    beta: str | None,
    gamma: str | None,
    neighbours: str | None,
    closed: bool | None,
) -> None:
    """Write the curves of IN into OUT for other programs, at true size.

    IN is a .ninepoint drawing, or points in two columns (.csv, .tsv, .txt, .dat), in mm. OUT
    ends in .dxf (arcs, R2000), .svg (cubics), or in .csv, .tsv or .json (exact points, tangents
    and curvature), which chooses the format; an existing OUT is replaced, whole or not at all,
    after the new one was read back and compared. Parameters that are not given are those of the
    drawing, or Calm (0, -1/2, 0) for points. Points are closed if the last one repeats the first.
    """
    from core import formats
    from core.family import exact

    tolerance_mm = float(exact(tolerance, "--tolerance"))
    document = formats.open_document(source, closed)
    document = document.with_parameters(
        chosen(document.parameters, alpha=alpha, beta=beta, gamma=gamma, neighbours=neighbours)
    )
    if target.exists() and target.samefile(source):
        raise click.UsageError("IN and OUT are the same file.")
    report = formats.export(document, target, formats.profile_for(target).within(tolerance_mm))
    click.echo(f"{target}: {report.summary}")
    for note in report.notes:
        click.echo(f"ninepoint: {note}", err=True)
    left_out = len(document.curves) - report.contours
    if left_out:
        click.echo(f"ninepoint: {left_out} of the curves had no extent and are left out.", err=True)
