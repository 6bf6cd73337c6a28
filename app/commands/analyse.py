"""`ninepoint analyse`: everything that is proven of a member of the family."""

from __future__ import annotations

import json
from typing import Final

import click

from app.commands.manual import Manual
from app.commands.scheme import chosen, scheme_options

_EXAMPLES: Final = (
    "analyse --beta -1/2",
    "analyse --alpha 1/4 --beta -1/2 --gamma 1/4 --json",
    "analyse --alpha 3/10 --beta -3/5 --gamma -1/5 --neighbours mirrored",
)


@click.command("analyse", cls=Manual, short_help="Report what is proven.", examples=_EXAMPLES)
@scheme_options
@click.option("--json", "as_json", is_flag=True, help="Answer in JSON, errors too.")
@click.option("--latex", "as_latex", is_flag=True, help="Answer in LaTeX, for a paper.")
def analyse(
    alpha: str | None,
    beta: str | None,
    gamma: str | None,
    neighbours: str | None,
    as_json: bool,
    as_latex: bool,
) -> None:
    """Report what is proven of the scheme (ALPHA, BETA, GAMMA).

    Mask and rules as fractions, support, degrees of polynomials, continuity class from both sides,
    Hoelder exponent, overshoot, limit and tangent at a control point, rules at the ends.
    Parameters that are not given are 0.
    """
    from core import report as whole
    from core import wording
    from core.family import Parameters
    from core.report import as_json as plain

    if as_json and as_latex:
        raise click.UsageError("Choose one of --json and --latex.")
    found = whole(
        chosen(Parameters(), alpha=alpha, beta=beta, gamma=gamma, neighbours=neighbours)
    )
    if as_json:
        click.echo(json.dumps(plain(found), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        click.echo(wording.as_latex(found) if as_latex else wording.as_text(found), nl=False)
