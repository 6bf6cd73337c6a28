"""The command line: `ninepoint [FILE]` opens the window, `ninepoint export` needs no screen.

Qt, and what reads and writes files, is imported inside the commands: help and refusals are quick,
and an export neither needs a screen nor Qt's libraries.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final, NoReturn

import click
from click.shell_completion import CompletionItem

from app.commands.analyse import analyse
from app.commands.completion import completion
from app.commands.convert import convert
from app.commands.export import export
from app.commands.info import info
from app.commands.manual import STATUS, FileOf, files_of
from app.commands.profiles import profiles
from app.commands.reading import READABLE, Reading
from app.commands.sample import sample
from app.entrance import NAME, USER_ERROR, open_window, speak_plainly, status_of, tell_words

_WINDOW: Final = "window"
"""Name of the command that a call without a command means."""

_SIDES_PX: Final = range(200, 10_001)
"""Admitted width and height of the window."""

_EXAMPLES: Final = """\
\b
Examples:
  ninepoint                            start with a ready shape
  ninepoint wing.ninepoint             open a drawing
  ninepoint --screenshot wing.png wing.ninepoint
  ninepoint export wing.ninepoint wing.dxf
  ninepoint export *.ninepoint --profile laser --out cut
  ninepoint convert logo.svg logo.ninepoint --fit 0.05
  ninepoint info wing.ninepoint
  ninepoint analyse --alpha 1/4 --beta -1/2 --gamma 1/4
"""

_ANSWERS_IN_JSON: Final = ("analyse", "info")
"""Commands whose errors are JSON too, with --json."""


class _Commands(click.Group):
    """The commands; a call that names none of them is one of the window's."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        own = (*self.commands, "--version", *ctx.help_option_names)
        # A shell that completes the first word asks without one.
        if not (args and args[0] in own) and not (ctx.resilient_parsing and not args):
            args = [_WINDOW, *args]
        return super().parse_args(ctx, args)

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        window = self.commands[_WINDOW]
        if incomplete.startswith("-"):
            return window.shell_complete(click.Context(window, parent=ctx), incomplete)
        return super().shell_complete(ctx, incomplete) or files_of(incomplete, READABLE)

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        formatter.write_usage(NAME, "[OPTIONS] [FILE]")
        formatter.write_usage(NAME, "COMMAND [OPTIONS] ...", prefix=" " * len("Usage: "))

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        self.format_commands(ctx, formatter)
        options = [*self.commands[_WINDOW].params, *self.get_params(ctx)]
        records = (option.get_help_record(ctx) for option in options if option.name != "files")
        with formatter.section("Options"):
            formatter.write_dl(list(dict.fromkeys(filter(None, records))))
        with formatter.section("Exit status"):
            formatter.write_dl(STATUS)


def main(args: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and end the process.

    Parameters
    ----------
    args
        The arguments, those of the process by default.

    Raises
    ------
    SystemExit
        Always: with status 0, `USER_ERROR`, `OUR_ERROR` or `INTERRUPTED`. What went wrong is a
        sentence on the error stream, never a traceback.
    ImportError
        If Qt lacks libraries of the system; `app.__main__` installs them or says which.
    """
    speak_plainly()
    words = list(sys.argv[1:] if args is None else args)
    in_json = words and words[0] in _ANSWERS_IN_JSON and "--json" in words
    tell = _tell_json if in_json else tell_words
    sys.exit(status_of(lambda: _run(words, tell), tell))


def _run(words: list[str], tell: Callable[[str], None]) -> int:
    try:
        result = _commands.main(words, prog_name=NAME, standalone_mode=False)
    except click.UsageError as error:
        command = error.ctx.info_name if error.ctx else None
        place = f"{NAME} {command}" if command in _commands.commands else NAME
        help_of = place.removesuffix(f" {_WINDOW}")
        tell(f"{error.format_message()} ({help_of} --help shows what is possible.)")
        return USER_ERROR
    except click.Abort as stopped:
        raise KeyboardInterrupt from stopped
    return result if isinstance(result, int) else 0


def _tell_json(sentence: str) -> None:
    """Who asked for JSON gets JSON, whatever went wrong."""
    click.echo(json.dumps({"error": sentence}, ensure_ascii=False))


def _show_version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        from importlib.metadata import PackageNotFoundError, version

        try:
            number = version(NAME)
        except PackageNotFoundError:  # a checkout that was not installed
            number = "(not installed)"
        click.echo(f"{NAME} {number}")
        ctx.exit()


def _show_help(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        click.echo((ctx.parent or ctx).get_help())
        ctx.exit()


def _size(text: str | None) -> tuple[int, int] | None:
    """Read a size such as "1280x800"."""
    if text is None:
        return None
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text, re.ASCII | re.IGNORECASE)
    if not found or not all(int(side) in _SIDES_PX for side in found.groups()):
        raise click.BadParameter(
            f"{text!r} is not a size such as 1280x800, with sides of {_SIDES_PX[0]} to"
            f" {_SIDES_PX[-1]} pixels."
        )
    return int(found[1]), int(found[2])


@click.group(cls=_Commands, epilog=_EXAMPLES)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the version and exit.",
)
def _commands() -> None:
    """Draw curves with the three-parameter 9-point subdivision scheme.

    FILE is a .ninepoint drawing, points in two columns (.csv, .tsv, .txt, .dat, .json), or a
    drawing of another program (.svg, .dxf).
    """


@_commands.command(_WINDOW, hidden=True, add_help_option=False)
@click.argument("files", metavar="[FILE]", nargs=-1, type=FileOf(*READABLE))
@click.option(
    "--screenshot",
    metavar="PNG",
    type=click.Path(path_type=Path),
    help="Draw the window into a picture and end; no screen is needed.",
)
@click.option(
    "--size",
    metavar="WxH",
    callback=lambda _, __, value: _size(value),
    help="Size of the window in pixels, such as 1280x800.",
)
@click.option(
    "--theme",
    type=click.Choice(["system", "light", "dark"]),
    default="system",
    help="Colours of the window; those of the system by default.",
)
@click.option(
    "--help",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_help,
    help="Show this message and exit.",
)
def _open_window(
    files: tuple[Path, ...],
    screenshot: Path | None,
    size: tuple[int, int] | None,
    theme: str,
) -> int:
    path = _only_file(files)
    if path is not None:
        _require_readable(path)  # a bad file is refused here, before there is a window
    if screenshot is not None and screenshot.suffix.lower() != ".png":
        raise click.UsageError(f"The picture is a PNG file; {screenshot} must end in .png.")
    return open_window(path, screenshot, size, theme)


def _require_readable(path: Path) -> None:
    """Refuse a bad file; a drawing of another program is only looked at when the user sees it."""
    from core import atomic
    from core.formats import open_document
    from core.formats.foreign import SUFFIXES

    if path.suffix.lower() in SUFFIXES:
        atomic.read(path)
    else:
        open_document(path)


def _check(path: Path) -> None:
    """Refuse a bad file here, before there is a window."""
    from core.formats.foreign import SUFFIXES, read_sketch

    if path.suffix.lower() in SUFFIXES:
        read_sketch(path)
    else:
        Reading().document(path)


def _only_file(files: tuple[Path, ...]) -> Path | None:
    """Return the file to open, or say what is wrong with the words that were given for it."""
    if not files:
        return None
    first = files[0]
    if not first.suffix and not first.exists():  # a mistyped command rather than a file
        raise click.UsageError(f"There is no file and no command {str(first)!r}.")
    if len(files) > 1:
        raise click.UsageError("Only one FILE can be opened.")
    return first


for _command in (export, convert, info, profiles, analyse, sample, completion):
    _commands.add_command(_command)
