"""`ninepoint profiles`: what files can be, by who receives them."""

from __future__ import annotations

from typing import Final

import click

from app.commands.manual import Manual, ProfileWord

_EXAMPLES: Final = (
    "profiles",
    "profiles laser > mine.json",
    "export wing.ninepoint wing.dxf --profile mine.json",
)


@click.command(
    "profiles",
    cls=Manual,
    short_help="List the export profiles.",
    usages=("[NAME]",),
    examples=_EXAMPLES,
)
@click.argument("name", metavar="[NAME]", required=False, type=ProfileWord())
def profiles(name: str | None) -> None:
    """List the export profiles, or print one as JSON to make an own one of it.

    A profile says what a file is to be: its format, what curves become in it, unit, tolerance,
    colour, layers, origin, kerf. An own one is such a file, given to --profile.
    """
    import msgspec

    from core.profiles import PROFILES, encode, named

    if name is not None:
        text = msgspec.json.format(encode(named(name)), indent=2)
        click.echo(text.decode())
        return
    width = max(map(len, PROFILES))
    for profile in PROFILES.values():
        click.echo(f"{profile.name:{width}}  .{profile.format:4}  {profile.title}: {profile.use}")
