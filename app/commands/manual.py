"""A command whose help is its manual, and words on the command line that shells complete."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import click
from click.shell_completion import CompletionItem

STATUS: Final = (
    ("0", "Everything was done."),
    ("2", "Something was not: a file, an option, a full disk. A sentence says what."),
    ("1", "The program is at fault; please report what it says."),
    ("130", "Stopped by Ctrl+C; no file is half-written."),
)
"""What the exit statuses of all commands mean."""

_PLAIN: Final = frozenset("._-+/~@%,:=")
"""Signs of names, besides letters and digits, that shells take as they are."""


class Manual(click.Command):
    """A command that tells its forms, examples, files and exit status in its help.

    Parameters
    ----------
    usages
        What follows the name of the program and of the command, for each form that it has.
    examples
        Calls, without the name of the program.
    files
        Pairs of a kind of file and what it is for.
    """

    def __init__(
        self,
        *args: Any,
        usages: Sequence[str] = (),
        examples: Sequence[str] = (),
        files: Sequence[tuple[str, str]] = (),
        **fields: Any,
    ) -> None:
        super().__init__(*args, **fields)
        self._usages = usages
        self._examples = examples
        self._files = files

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write every form, one below the other."""
        prefix = "Usage: "
        for usage in self._usages or (" ".join(self.collect_usage_pieces(ctx)),):
            formatter.write_usage(ctx.command_path, usage, prefix=prefix)
            prefix = " " * len(prefix)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what comes after the options."""
        if self._files:
            with formatter.section("Files"):
                formatter.write_dl(self._files)
        with formatter.section("Exit status"):
            formatter.write_dl(STATUS)
        if self._examples:
            with formatter.section("Examples"):
                program = ctx.command_path.split()[0]
                for example in self._examples:
                    formatter.write(f"{'':>{formatter.current_indent}}{program} {example}\n")


class FileOf(click.Path):
    """A file, completed by its suffixes.

    Parameters
    ----------
    *suffixes
        Suffixes, with the dot, of the files that a shell offers.
    """

    def __init__(self, *suffixes: str) -> None:
        super().__init__(path_type=Path)
        self._suffixes = suffixes

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Files of these suffixes; the shell's own list where folders or odd names are about."""
        return files_of(incomplete, self._suffixes)


class ProfileWord(click.types.StringParamType):
    """Name of a profile, or a file that holds one."""

    name = "profile"

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Built-in names with their titles, else files."""
        from core.profiles import PROFILES

        found = [
            CompletionItem(name, help=profile.title)
            for name, profile in PROFILES.items()
            if name.startswith(incomplete)
        ]
        return found or files_of(incomplete, (".json",))


def files_of(incomplete: str, suffixes: Sequence[str]) -> list[CompletionItem]:
    """Completions of a name of a file.

    Shells add a blank after what they are offered, and break names at blanks; so where there is a
    folder to go on into, or a name that has more than plain signs, they complete by themselves.
    """
    by_shell = [CompletionItem(incomplete, type="file")]
    folder, _, start = incomplete.rpartition("/")
    try:
        there = [*Path(f"{folder}/" if "/" in incomplete else ".").iterdir()]
        matching = sorted(path for path in there if path.name.startswith(start))
        if not start:
            matching = [path for path in matching if not path.name.startswith(".")]
        if any(path.is_dir() for path in matching):
            return by_shell
    except OSError:
        return by_shell
    names = [path.name for path in matching if path.suffix.lower() in suffixes]
    if not all(sign.isalnum() or sign in _PLAIN for name in names for sign in name):
        return by_shell
    prefix = incomplete[: len(incomplete) - len(start)]
    return [CompletionItem(prefix + name) for name in names] or by_shell
