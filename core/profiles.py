"""Export profiles: what a file is to be, named by who receives it.

A profile is a frozen value. Its JSON form is for the settings and for documents: one object with
the fields of `Profile`; a field that is left out has its default, one that is not known is refused,
so that a profile of a newer Ninepoint is not applied in part.
"""

from __future__ import annotations

import math
import re
from typing import Final

import msgspec

from core.errors import NinepointError

DEFAULT_TOLERANCE_MM: Final = 0.01
"""Tolerance of an export, a tenth of what a laser or a printer resolves."""

MIN_TOLERANCE_MM: Final = 1e-6
"""Finest tolerance; below it the floats of large drawings end."""

MAX_TOLERANCE_MM: Final = 100.0
"""Coarsest tolerance."""

MAX_WIDTH_MM: Final = 100.0
"""Broadest line."""

MAX_KERF_MM: Final = 100.0
"""Largest offset."""

MIN_DPI: Final = 1.0
MAX_DPI: Final = 10_000.0

MAX_NAME: Final = 100
"""Largest number of characters of a name, a title, or of the words of use."""

UNITS_MM: Final = {"mm": 1.0, "in": 25.4}
"""Millimetres of the units that a file can have."""

_OUTLINES: Final = ("arcs", "polyline", "spline", "cubics")

_POINTS: Final = ("control points", "limit points")

ENTITIES: Final[dict[str, tuple[str, ...]]] = {
    "dxf": ("arcs", "polyline", "spline", *_POINTS),
    "svg": ("cubics", "polyline"),
    "pdf": ("cubics", "polyline"),
    "png": ("cubics", "polyline"),
    "csv": _POINTS,
    "tsv": _POINTS,
    "json": _POINTS,
}
"""Formats, which are also the suffixes of their files, and what each of them can hold."""

VERSIONS: Final = ("R2000", "R12")
"""Versions of DXF; other formats have none."""

LAYERS: Final = ("one", "by curve")
"""All contours on one layer, or each on its own."""

ORIGINS: Final = ("drawing", "corner")
"""The origin of the drawing stays, or it moves to the lower left corner of what is written."""


class Profile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a file is to be; checked when it is made.

    Parameters
    ----------
    name
        Name on the command line: small letters, digits and hyphens.
    title
        Name in the dialog.
    use
        Who receives the file, in a few words.
    format
        One of `ENTITIES`.
    entity
        What the curves become: "arcs" that touch, a "polyline", a C^2 "spline", "cubics" that
        touch, or a table of "control points" or of exact "limit points".
    version
        One of `VERSIONS` for DXF, "" for others. R12 knows no splines.
    unit
        Unit of the numbers in the file, one of `UNITS_MM`.
    tolerance_mm
        Largest distance between an exact curve and what is written for it.
    colour
        "#rrggbb"; a DXF file has the nearest of its 255 colours, black being its black or white.
    width_mm
        Width of the lines in SVG, PDF and PNG.
    layers
        One of `LAYERS`.
    origin
        One of `ORIGINS`, for DXF and tables. The page of SVG and PDF is the drawing's box; that of
        PNG has half a line's width more on each side.
    kerf_mm
        Offset of the contours by the radius of a tool: > 0 to the outside of what a closed curve
        encloses, < 0 to its inside, 0 for none.
    dpi
        Resolution of PNG, in pixels an inch.
    transparent
        Whether the background of PNG is transparent, else it is white.

    Raises
    ------
    NinepointError
        If a field has a value that it cannot have, or two do not go together.
    """

    name: str
    title: str
    use: str = ""
    format: str
    entity: str
    version: str = ""
    unit: str = "mm"
    tolerance_mm: float = DEFAULT_TOLERANCE_MM
    colour: str = "#000000"
    width_mm: float = 0.1
    layers: str = "one"
    origin: str = "drawing"
    kerf_mm: float = 0.0
    dpi: float = 300.0
    transparent: bool = False

    def __post_init__(self) -> None:
        self._check_words()
        check_tolerance(self.tolerance_mm)
        if not 0 < self.width_mm <= MAX_WIDTH_MM:
            raise NinepointError(
                f"The line width must be greater than 0 and at most {MAX_WIDTH_MM:g} mm,"
                f" not {self.width_mm:g}."
            )
        # A comparison with nan is false, so these catch nan as well.
        if not -MAX_KERF_MM <= self.kerf_mm <= MAX_KERF_MM:
            raise NinepointError(
                f"The kerf must lie between {-MAX_KERF_MM:g} and {MAX_KERF_MM:g} mm,"
                f" not {self.kerf_mm:g}."
            )
        if not MIN_DPI <= self.dpi <= MAX_DPI:
            raise NinepointError(
                f"The resolution must lie between {MIN_DPI:g} and {MAX_DPI:g} dpi,"
                f" not {self.dpi:g}."
            )
        if re.fullmatch("#[0-9a-fA-F]{6}", self.colour) is None:
            raise NinepointError(f"A colour is written like #1e90ff, not {self.colour!r}.")
        _require("format", self.format, tuple(ENTITIES))
        _require("unit", self.unit, tuple(UNITS_MM))
        _require("layers", self.layers, LAYERS)
        _require("origin", self.origin, ORIGINS)
        _require(f"content of {self.format.upper()}", self.entity, ENTITIES[self.format])
        if self.format == "dxf":
            _require("version of DXF", self.version, VERSIONS)
            if self.version == "R12" and self.entity == "spline":
                raise NinepointError("DXF R12 has no splines; choose R2000, arcs, or a polyline.")
        elif self.version:
            raise NinepointError(f"{self.format.upper()} has no versions to choose from.")

    def _check_words(self) -> None:
        if re.fullmatch("[a-z0-9]+(-[a-z0-9]+)*", self.name) is None or len(self.name) > MAX_NAME:
            raise NinepointError(
                "The name of a profile has small letters, digits and single hyphens,"
                f" like laser-r12; not {self.name[:MAX_NAME]!r}."
            )
        for words in (self.title, self.use):
            if len(words) > MAX_NAME or not (words.isprintable() or not words):
                raise NinepointError(
                    f"Title and use of a profile are one line of up to {MAX_NAME} characters."
                )
        if not self.title.strip():
            raise NinepointError("A profile needs a title.")

    @property
    def suffix(self) -> str:
        """Suffix of its files, with the dot."""
        return "." + self.format

    @property
    def unit_mm(self) -> float:
        """Millimetres of its unit."""
        return UNITS_MM[self.unit]

    @property
    def is_table(self) -> bool:
        """Whether it holds points instead of contours."""
        return self.entity in _POINTS

    def within(self, tolerance_mm: float) -> Profile:
        """Profile with another tolerance; see `check_tolerance`."""
        return msgspec.structs.replace(self, tolerance_mm=tolerance_mm)


def check_tolerance(tolerance_mm: float) -> None:
    """Refuse a tolerance that is not admitted.

    Raises
    ------
    NinepointError
        Unless it lies between `MIN_TOLERANCE_MM` and `MAX_TOLERANCE_MM`.
    """
    if not MIN_TOLERANCE_MM <= tolerance_mm <= MAX_TOLERANCE_MM:
        raise NinepointError(
            f"The tolerance must lie between {MIN_TOLERANCE_MM:g} and {MAX_TOLERANCE_MM:g} mm,"
            f" not {tolerance_mm:g}."
        )


def decimals(tolerance: float, guard: int) -> int:
    """Number of decimals that hold a tolerance, in the unit of a file, and ``guard`` more."""
    return max(math.ceil(-math.log10(tolerance)), 0) + guard


def encode(profile: Profile) -> bytes:
    """JSON text of a profile, UTF-8, with sorted fields; the same for equal profiles."""
    return msgspec.json.encode(profile, order="sorted")


def decode(data: bytes | str) -> Profile:
    """Profile of a JSON text.

    Raises
    ------
    NinepointError
        If the text is damaged, has a field that is not known, or a value that is not admitted.
    """
    try:
        return _DECODER.decode(data)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        # The sentence of a NinepointError, which it also is then, says it best.
        cause = error.__cause__
        if isinstance(cause, NinepointError):
            raise NinepointError(str(cause)) from error
        reason = str(error).rstrip(".")
        raise NinepointError(f"This is not an export profile: {reason}.") from error


def _require(what: str, value: str, admitted: tuple[str, ...]) -> None:
    if value not in admitted:
        raise NinepointError(
            f"The {what} must be one of: {', '.join(admitted)}; not {value[:MAX_NAME]!r}."
        )


_DECODER: Final = msgspec.json.Decoder(Profile)

_BUILT_IN: Final = (
    Profile(
        name="laser",
        title="Laser / CNC",
        use="machines and CAM: DXF, true arcs",
        format="dxf",
        entity="arcs",
        version="R2000",
    ),
    Profile(
        name="laser-r12",
        title="Old laser controller",
        use="machines that know no arcs: DXF R12, straight lines",
        format="dxf",
        entity="polyline",
        version="R12",
    ),
    Profile(
        name="dxf-polyline",
        title="DXF, straight lines",
        use="OpenSCAD, and programs that take arcs for lines: DXF R2000",
        format="dxf",
        entity="polyline",
        version="R2000",
    ),
    Profile(
        name="cad",
        title="CAD",
        use="FreeCAD, LibreCAD, Fusion: DXF, one smooth spline a curve",
        format="dxf",
        entity="spline",
        version="R2000",
        layers="by curve",
    ),
    Profile(
        name="svg",
        title="Inkscape / illustration",
        use="drawing programs: SVG, Bézier curves; Ninepoint opens it again",
        format="svg",
        entity="cubics",
        layers="by curve",
        origin="corner",
    ),
    Profile(
        name="svg-polyline",
        title="SVG, straight lines",
        use="programs that know no Bézier curves",
        format="svg",
        entity="polyline",
        origin="corner",
    ),
    Profile(
        name="svg-blue",
        title="Laser cutting service",
        use="services like Ponoko: SVG, blue lines of 0.01 mm",
        format="svg",
        entity="cubics",
        colour="#0000ff",
        width_mm=0.01,
        origin="corner",
    ),
    Profile(
        name="points",
        title="Points",
        use="tables and programs of your own: CSV, exact limit points",
        format="csv",
        entity="limit points",
    ),
    Profile(
        name="pdf",
        title="PDF",
        use="printing at true size",
        format="pdf",
        entity="cubics",
        origin="corner",
    ),
    Profile(
        name="png",
        title="PNG",
        use="pictures for texts and pages",
        format="png",
        entity="cubics",
        width_mm=0.35,
        origin="corner",
        transparent=True,
    ),
)

PROFILES: Final[dict[str, Profile]] = {profile.name: profile for profile in _BUILT_IN}
"""The built-in profiles by name."""


def named(name: str) -> Profile:
    """Built-in profile of a name.

    Raises
    ------
    NinepointError
        If there is none; the sentence tells those that there are.
    """
    if name not in PROFILES:
        raise NinepointError(f"There is no profile {name!r}; there are {', '.join(PROFILES)}.")
    return PROFILES[name]
