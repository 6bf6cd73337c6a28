"""`ninepoint completion`: what makes a shell complete the commands, options and files."""

from __future__ import annotations

from typing import Final

import click

from app.commands.manual import Manual
from app.entrance import NAME

VARIABLE: Final = f"_{NAME.upper()}_COMPLETE"
"""Environment variable by which a shell asks for completions; click's name for it."""

_PLACES: Final = {
    "bash": "~/.local/share/bash-completion/completions/ninepoint",
    "zsh": '"${fpath[1]}/_ninepoint"',
    "fish": "~/.config/fish/completions/ninepoint.fish",
}
"""Where the shells look for such a script."""


@click.command(
    "completion",
    cls=Manual,
    short_help="Print a script for a shell to complete words.",
    examples=[f"completion {shell} > {place}" for shell, place in _PLACES.items()],
)
@click.argument("shell", metavar="SHELL", type=click.Choice(list(_PLACES)))
@click.pass_context
def completion(ctx: click.Context, shell: str) -> None:
    """Print a script that completes commands, options, profiles and files: bash, zsh or fish.

    Write it to where the shell looks for it, as in the examples, and start a new shell.
    """
    from click.shell_completion import ShellComplete, get_completion_class

    kind = get_completion_class(shell)
    if kind is None:
        raise click.UsageError(f"There is no completion for {shell}.")
    made = kind(ctx.find_root().command, {}, NAME, VARIABLE)
    # That of bash would first start a bash to ask for its version.
    script = ShellComplete.source(made)
    lines = script.strip().splitlines()
    place = f"# To be kept in {_PLACES[shell]}"
    # zsh reads the first line for the name of the command.
    first = 1 if lines[0].startswith("#compdef") else 0
    click.echo("\n".join([*lines[:first], place, *lines[first:]]))
