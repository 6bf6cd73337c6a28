"""The table: every built-in profile, all example drawings, every program that opens the format."""

from dataclasses import dataclass

import by_freecad
import by_gdal
import by_inkscape
import by_librecad
import by_mupdf
import by_openscad
from app.assets import example_paths
from app.pages import register_encoders
from by_renderers import RENDERERS
from core.formats import export, open_document
from core.profiles import PROFILES
from measure import Row, measured

PROGRAMS = (
    by_freecad, by_inkscape, by_librecad, by_openscad, by_gdal, by_mupdf, *RENDERERS,
)  # fmt: skip

FOR_OPENSCAD = "dxf-polyline"
"""What OpenSCAD needs: it takes arcs for straight lines, knows neither splines nor R12, and fills
all of an SVG's contours."""


@dataclass
class Line:
    """The row of one drawing, as one profile, in one program.

    Attributes
    ----------
    row
        None if the program shows nothing.
    is_drawing_for, is_profile_for
        Whether the program has what the drawing and the profile hold, as far as it is known.
    """

    profile: str
    program: str
    version: str
    drawing: str
    row: Row | None
    is_drawing_for: bool
    is_profile_for: bool


def lines(folder, tell=lambda words: None):
    """Export all examples with all profiles, and let all programs look."""
    register_encoders()
    documents = {path.stem: open_document(path) for path in example_paths()}
    found = []
    for program in PROGRAMS:
        jobs = [
            (profile, name, folder / f"{name}-{profile.name}{profile.suffix}")
            for profile in PROFILES.values() if profile.format in program.FORMATS
            for name in documents
        ]  # fmt: skip
        for profile, name, path in jobs:
            if not path.exists():
                export(documents[name], path, profile)
        seen, version = program.look([path for _, _, path in jobs], folder)
        for (profile, name, _), one in zip(jobs, seen, strict=True):
            document = documents[name]
            row = None if one is None else measured(document, profile, one)
            line = Line(
                profile.name,
                program.TITLE,
                version,
                name,
                row,
                program is not by_openscad or all(c.is_loop for c in document.curves),
                program is not by_openscad or profile.name == FOR_OPENSCAD,
            )
            tell(told(line))
            found.append(line)
    order = list(PROFILES)
    return sorted(found, key=lambda line: order.index(line.profile))


def told(line):
    """One line of the long table."""
    head = f"{line.profile:13} {line.program:12} {line.drawing:8}"
    row = line.row
    if row is None:
        return f"{head} nothing"
    contours = "-" if row.contours is None else f"{row.contours:2} contours"
    closed = "-" if row.closed is None else f"{row.closed:2} closed"
    kinds = " ".join(f"{count} {kind}" for kind, count in row.kinds.items())
    return (
        f"{head} box {row.box_mm:8.4f} mm  {contours} {closed:9}"
        f" {'right' if row.is_whole else 'WRONG':5}  off {row.deviation_mm:8.4f} mm"
        f" (+- {row.finest_mm:.4f})  {kinds}"
    )


def summary(found):
    """Worst of the drawings for each profile and program, as rows of words."""
    rows = []
    for key in dict.fromkeys((line.profile, line.program) for line in found):
        group = [line for line in found if (line.profile, line.program) == key]
        mine = [line for line in group if line.is_drawing_for]
        there = [line.row for line in mine if line.row is not None]
        star = "" if group[0].is_profile_for else " *"
        head = (key[0], f"{key[1]} {group[0].version}{star}")
        if not there:
            rows.append((*head, "nothing", "", "", ""))
            continue
        closed = "-"
        if there[0].contours is not None:
            right = sum(row.is_whole for row in there)
            closed = "all right" if right == len(mine) else f"right in {right} of {len(mine)}"
        kinds = ", ".join(dict.fromkeys(kind for row in there for kind in row.kinds))
        rows.append(
            (
                *head,
                f"{max(row.box_mm for row in there):.4f}",
                closed,
                kinds or "lines",
                f"{max(row.deviation_mm for row in there):.4f}",
            )
        )
    return rows


HEAD = ("profile", "program", "box off by, mm", "contours, closed", "seen as", "off the curve, mm")


NOTES = """
Boxes are as the programs state or draw them; renderers are as exact as their pixels, of 0.02 to
0.04 mm, those of the PNG being 0.085 mm. In splines LibreCAD and GDAL draw some 8 chords for each
piece, which is what they are off by. GDAL was told to draw arcs in steps of 0.1 degrees: with its
default of 4 degrees it is up to 0.18 mm off. LibreCAD is measured on a centred print of a copy that
names a larger sheet, so its box tells sizes, not places. resvg paints our page on a larger one, as
it cuts pages to whole pixels of 96 dpi.

\\* OpenSCAD takes arcs for straight lines, reads neither splines nor R12, and fills what lies
inside another contour of an SVG; `dxf-polyline` is for it. It knows no open curves, so the vase
does not count there.
"""


def markdown(found):
    """The summary as a table of Markdown, with what there is to say of it."""
    rows = [HEAD, tuple("---" for _ in HEAD), *summary(found)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows) + NOTES
