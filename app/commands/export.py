"""`ninepoint export`: the curves of files for other programs."""

from __future__ import annotations

import os
import sys
import unicodedata
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from app.commands.choices import Choices, choices, profile_options
from app.commands.manual import FileOf, Manual
from app.commands.reading import FILES_READ, READABLE, Reading, read_unit, reading, taking
from app.commands.scheme import closing, scheme_options
from app.entrance import USER_ERROR
from core.errors import FileError, NinepointError

if TYPE_CHECKING:
    from app.commands.batch import Outcome
    from core.profiles import Profile

_PAIR: Final = 2
"""Number of words without --out: IN and OUT."""

_EXAMPLES: Final = (
    "export wing.ninepoint wing.dxf",
    "export naca2412.dat wing.svg --tolerance 0.001",
    "export *.ninepoint --profile laser --kerf 0.1 --out cut",
    "export a.svg b.dxf --fit 0.05 --to pdf --out prints --mkdir",
    "export points.csv shape.svg --alpha 1/4 --beta -1/2 --gamma 1/4 --closed",
)


@click.command(
    "export",
    cls=Manual,
    short_help="Write curves for other programs.",
    usages=("[OPTIONS] IN OUT", "[OPTIONS] IN... --out FOLDER"),
    examples=_EXAMPLES,
    files=(
        *FILES_READ,
        ("OUT", "Ends in .dxf, .svg, .pdf, .png, .csv, .tsv or .json."),
        ("FILE.json", "A profile, as `ninepoint profiles NAME` prints one."),
    ),
)
@click.argument("words", metavar="IN OUT", nargs=-1, type=FileOf(*READABLE))
@click.option(
    "--out",
    metavar="FOLDER",
    type=click.Path(path_type=Path, file_okay=False),
    help="Write a file for each IN into a folder, under IN's name.",
)
@click.option("--mkdir", is_flag=True, help="Make the folder of --out if it is not there.")
@click.option("--force", is_flag=True, help="Replace files that exist already.")
@click.option(
    "--jobs",
    metavar="N",
    type=click.IntRange(1, 256),
    help="Number of processes with --out; by default that of the cores, or fewer for few files.",
)
@profile_options
@taking
@read_unit("--read-unit")
@scheme_options
@closing
@click.pass_context
def export(
    ctx: click.Context,
    /,
    words: tuple[Path, ...],
    out: Path | None,
    mkdir: bool,
    force: bool,
    jobs: int | None,
    profile: str | None,
    to: str | None,
    closed: bool | None,
    vertices: bool,
    fit: str | None,
    read_unit: str | None,
    **options: Any,
) -> int:
    """Write the curves of IN for other programs, at true size.

    The suffix of OUT, --to or --profile says what is written: DXF with arcs for lasers and CNC by
    default, SVG with Bézier curves, PDF, PNG, or tables of exact points. Each file is written
    whole or not at all, after it was read back and compared; one that exists is left as it is,
    unless --force is given, and IN itself is never written over.

    With --out any number of files is written, several at a time. One that cannot be does not stop
    the others. Parameters of the scheme that are not given are those of the drawing, or Calm
    (0, -1/2, 0) for other files. Points are closed if the last one repeats the first.
    """
    names = ("alpha", "beta", "gamma", "neighbours")
    scheme = {name: options.pop(name) for name in names}
    how = reading(closed, scheme, vertices, fit, read_unit)
    sources = _expanded(words)
    if out is None:
        if mkdir or jobs is not None:
            raise click.UsageError("--mkdir and --jobs go with --out FOLDER.")
        return _one(ctx, sources, choices(profile, to, **options), how, force)
    if not sources:
        raise click.UsageError("Missing argument 'IN'.")
    return _many(sources, out, mkdir, jobs, choices(profile, to, **options), how, force)


def _one(
    ctx: click.Context, words: Sequence[Path], chosen: Choices, how: Reading, force: bool
) -> int:
    """Write one file under a name of its own."""
    from app.commands.batch import Job, written

    if len(words) != _PAIR:
        missing = ("IN", "OUT")[len(words)] if len(words) < _PAIR else ""
        if missing:
            raise click.UsageError(f"Missing argument '{missing}'.", ctx)
        raise click.UsageError("More than two files need a folder to go to: --out FOLDER.", ctx)
    source, target = words
    if target.is_dir() and not target.suffix:
        raise click.UsageError(f"{target} is a folder; to write into it, say --out {target}.", ctx)
    own = _own_profiles(source) if chosen.is_own else ()
    suffix = target.suffix.lower().removeprefix(".")
    profile = _for_suffix(chosen, target, suffix, own)
    _spare_sources([source], [target])
    result = written(Job(source, target, how, profile, force))
    click.echo(f"{target}: {result.summary}")
    for note in result.notes:
        click.echo(f"ninepoint: {note}", err=True)
    return 0


def _for_suffix(chosen: Choices, target: Path, suffix: str, own: Sequence[Profile]) -> Profile:
    """The profile, in the format that the name of the file says."""
    from app.commands.choices import FORMATS, make_writable
    from core.formats import profile_for

    if suffix in FORMATS:
        make_writable(suffix)
    else:
        profile_for(target)  # which tells the suffixes that there are
    if chosen.format not in (None, suffix):
        raise FileError(target, f"it does not end in .{chosen.format}, which --to asks for.")
    return Choices(chosen.profile, suffix, chosen.fields).chosen(own)


def _many(
    sources: Sequence[Path],
    folder: Path,
    mkdir: bool,
    processes: int | None,
    chosen: Choices,
    how: Reading,
    force: bool,
) -> int:
    """Write a file for each source into a folder."""
    from app.commands.batch import Job, Outcome, outcomes, suitable, told

    profiles: list[Profile | NinepointError] = [_profile(chosen, source) for source in sources]
    if all(isinstance(profile, NinepointError) for profile in profiles):
        raise profiles[0]  # type: ignore[misc]
    targets = [
        folder / (source.stem + ("" if isinstance(profile, NinepointError) else profile.suffix))
        for source, profile in zip(sources, profiles, strict=True)
    ]
    _spare_sources(sources, targets)
    _require_folder(folder, mkdir)
    jobs = [
        Job(source, target, how, profile, force)
        for source, target, profile in zip(sources, targets, profiles, strict=True)
        if not isinstance(profile, NinepointError)
    ]
    done = outcomes(jobs, min(processes or suitable(len(jobs)), len(jobs)))
    results = (
        Outcome(error=told(source, profile))
        if isinstance(profile, NinepointError)
        else next(done)
        for source, profile in zip(sources, profiles, strict=True)
    )
    return _tell_all(sources, targets, results)


def _profile(chosen: Choices, source: Path) -> Profile | NinepointError:
    """Profile for a source, or why there is none; those of drawings are looked up in them."""
    if not chosen.is_own:
        return chosen.chosen()
    try:
        return chosen.chosen(_own_profiles(source))
    except NinepointError as error:
        return error


def _own_profiles(source: Path) -> Sequence[Profile]:
    from core import store

    return store.load(source).profiles if source.suffix.lower() == store.SUFFIX else ()


def _spare_sources(sources: Sequence[Path], targets: Sequence[Path]) -> None:
    """Refuse targets that are sources, and two of the same name; nothing is written then."""
    known: dict[tuple[int, int], Path] = {}
    for source in sources:
        if (mark := _mark(source)) is not None:
            known[mark] = source
    first: dict[str, Path] = {}
    for source, target in zip(sources, targets, strict=True):
        mark = _mark(target)
        if mark in known:
            if len(sources) == 1:
                raise click.UsageError("IN and OUT are the same file.")
            raise click.UsageError(
                f"{target} would be written over {known[mark]}; choose another folder."
            )
        # Some disks take names for the same that differ in capitals, or in how accents are made.
        name = unicodedata.normalize("NFC", str(target)).casefold()
        if name in first:
            raise click.UsageError(
                f"{first[name]} and {source} would both become {target.name}; export them into"
                " two folders."
            )
        first[name] = source


def _mark(path: Path) -> tuple[int, int] | None:
    """What tells files apart, whatever their names; None if there is none."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_dev, status.st_ino


def _require_folder(folder: Path, make: bool) -> None:
    if folder.is_dir():
        return
    if folder.exists():
        raise FileError(folder, "it is a file, not a folder.")
    if not make:
        raise FileError(folder, "there is no such folder; --mkdir makes it.")
    folder.mkdir(parents=True)


def _expanded(words: Sequence[Path]) -> list[Path]:
    """Files of patterns such as *.csv, which the shells of Windows leave to the program."""
    found: list[Path] = []
    for word in words:
        is_pattern = bool(set(word.name) & set("*?")) and not os.path.lexists(word)
        names = sorted(word.parent.glob(word.name)) if is_pattern else []
        found += names or [word]
    return found


def _tell_all(
    sources: Sequence[Path], targets: Sequence[Path], results: Iterator[Outcome]
) -> int:
    """Tell what became of each file: as it comes, or on a terminal below a bar at the end."""
    failed = 0
    if sys.stderr is not None and sys.stderr.isatty():
        with click.progressbar(results, length=len(sources), file=sys.stderr) as bar:
            results = iter(list(bar))
    for source, target, result in zip(sources, targets, results, strict=True):
        if result.error:
            failed += 1
            click.echo(f"ninepoint: {result.error}", err=True)
            continue
        click.echo(f"{target}: {result.summary}")
        for note in result.notes:
            click.echo(f"ninepoint: {source.name}: {note}", err=True)
    total = "1 file" if len(sources) == 1 else f"{len(sources):,} files"
    ending = f", {failed:,} not written" if failed else ""
    click.echo(f"{total}: {len(sources) - failed:,} written{ending}.")
    return USER_ERROR if failed else 0
