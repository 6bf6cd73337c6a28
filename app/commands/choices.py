"""The options that shape a profile, and the profile that they amount to."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import click

from app.commands.manual import ProfileWord
from core.errors import FileError, NinepointError

if TYPE_CHECKING:
    from core.profiles import Profile

Command = TypeVar("Command", bound=Callable[..., Any])

FORMATS: Final = ("svg", "dxf", "pdf", "png", "csv", "tsv", "json")
"""Formats that can be written."""

_BY_QT: Final = ("pdf", "png")
"""Formats whose encoders are not core's."""

_OPTIONS: Final = (
    click.option(
        "--profile",
        type=ProfileWord(),
        metavar="NAME|FILE",
        help="What the files are to be: a name that `ninepoint profiles` lists, one of IN's own, or"
        " a .json file. By default the suffix, or --to, decides.",
    ),
    click.option("--to", type=click.Choice(FORMATS), help="Format of the files."),
    click.option(
        "--tolerance",
        metavar="MM",
        help="Largest distance between the exact curve and what is written, in mm: that of the"
        " profile, 0.01 in those built in.",
    ),
    click.option(
        "--kerf",
        metavar="MM",
        help="Offset by the radius of a tool: to the outside of what closed curves enclose, or if"
        " negative to the inside. Holes are told by the curve around them.",
    ),
    click.option("--unit", type=click.Choice(["mm", "in"]), help="Unit of the files."),
    click.option(
        "--layers",
        type=click.Choice(["one", "by-curve"]),
        help="All curves on one layer, or each on its own.",
    ),
    click.option(
        "--origin",
        type=click.Choice(["drawing", "corner"]),
        help="Keep the drawing's origin, or move it to the lower left corner.",
    ),
    click.option("--colour", metavar="#RRGGBB", help="Colour of the lines, such as #0000ff."),
)


def profile_options(command: Command) -> Command:
    """Add the options of a profile, each None where not given."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


@dataclass(frozen=True)
class Choices:
    """What the options of a profile say.

    Attributes
    ----------
    profile
        A name, or a .json file; None for the one of the format.
    format
        The format; None for that of the profile.
    fields
        Fields of the profile that are changed.
    """

    profile: str | None
    format: str | None
    fields: dict[str, Any]

    @property
    def is_own(self) -> bool:
        """Whether each drawing has to be asked for its own profile of this name."""
        from core.profiles import PROFILES

        return self.profile is not None and not self._is_file and self.profile not in PROFILES

    @property
    def _is_file(self) -> bool:
        name = self.profile or ""
        return Path(name).suffix.lower() == ".json" or "/" in name or "\\" in name

    def chosen(self, own: Sequence[Profile] = ()) -> Profile:
        """The profile.

        Parameters
        ----------
        own
            Profiles of the drawing; those built in come first.

        Raises
        ------
        NinepointError
            If there is none of the name, or it cannot be changed so.
        """
        import msgspec

        from core.formats import profile_for

        if self.format is not None:
            make_writable(self.format)
        if self.profile is None:
            if self.format is None:
                raise click.UsageError("Say what to write: --profile NAME or --to FORMAT.")
            found = profile_for(f"drawing.{self.format}")
        else:
            found = self._named(own)
        fields = dict(self.fields)
        if self.format not in (None, found.format):
            fields |= {"format": self.format, "version": "R2000" if self.format == "dxf" else ""}
        try:
            found = msgspec.structs.replace(found, **fields)
        except NinepointError as error:
            if "format" not in fields:
                raise
            raise NinepointError(
                f"The profile {found.name} cannot be written as {self.format}: {error}"
            ) from error
        make_writable(found.format)
        return found

    def _named(self, own: Sequence[Profile]) -> Profile:
        from core import atomic, profiles

        name = self.profile or ""
        if self._is_file:
            path = Path(name)
            try:
                return profiles.decode(atomic.read(path))
            except FileError:
                raise
            except NinepointError as error:
                raise FileError(path, str(error)) from error
        if name in profiles.PROFILES:
            return profiles.PROFILES[name]
        for profile in own:
            if profile.name == name:
                return profile
        holds = ", ".join(profile.name for profile in own)
        raise NinepointError(
            f"There is no profile {name!r}; there are {', '.join(profiles.PROFILES)}"
            + (f", and in the drawing {holds}." if holds else ".")
        )


def choices(profile: str | None, to: str | None, **options: str | None) -> Choices:
    """Choices that options ask for.

    Raises
    ------
    NinepointError
        If a number is none.
    """
    from core.family import exact

    fields: dict[str, Any] = {}
    for name, field in (("tolerance", "tolerance_mm"), ("kerf", "kerf_mm")):
        text = options[name]
        if text is not None:
            fields[field] = float(exact(text, f"--{name}"))
    for name in ("unit", "layers", "origin", "colour"):
        text = options[name]
        if text is not None:
            fields[name] = text.replace("-", " ")
    return Choices(profile, to, fields)


def make_writable(form: str) -> None:
    """Have Qt's encoders where a format needs them; they need no screen."""
    if form in _BY_QT:
        from app.pages import register_encoders

        register_encoders()
