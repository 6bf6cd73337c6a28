"""The options that name a member of the family, shared by several commands."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from core.errors import ParameterError

if TYPE_CHECKING:
    from core.family import Parameters

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option("--alpha", metavar="NUMBER", help="First parameter, such as 0.25 or 1/4."),
    click.option("--beta", metavar="NUMBER", help="Second parameter."),
    click.option("--gamma", metavar="NUMBER", help="Third parameter."),
    click.option(
        "--neighbours",
        type=click.Choice(["translated", "mirrored"]),
        help="Which neighbours the odd rule combines.",
    ),
)

closing = click.option(
    "--closed/--open",
    default=None,
    help="Close or open all curves; by default the file decides.",
)
"""Option `closed`: True, False, or None where the file decides."""


def scheme_options(command: Command) -> Command:
    """Add the options `alpha`, `beta`, `gamma` and `neighbours`, each None where not given."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def chosen(present: Parameters, **options: str | None) -> Parameters:
    """Parameters with those changed that were given as options.

    Raises
    ------
    ParameterError
        If an option is no admitted number; the sentence names the option.
    """
    from core.family import Parameters

    names = ("alpha", "beta", "gamma", "neighbours")
    values: dict[str, Any] = {name: getattr(present, name) for name in names}
    values.update({name: text for name, text in options.items() if text is not None})
    try:
        return Parameters(**values)
    except ParameterError as error:
        raise ParameterError(f"--{error}") from error  # the message begins with the name
