"""Exports of all examples, as all profiles, opened by programs that we did not write.

Outside the default suite: ``python3 tests tests/acceptance -s`` prints the table, as does
``python3 tests/acceptance``, which also installs the programs when asked to.
"""

import pytest

import by_inkscape
import table
from app.assets import example_paths
from core import store
from core.formats import export, open_document
from core.formats.foreign import read_sketch
from core.profiles import DEFAULT_TOLERANCE_MM, PROFILES, named

PIXELS_MM = {"resvg": 0.05, "librsvg": 0.05, "Poppler": 0.05, "ImageMagick": 25.4 / 300}
"""How exactly the ink of renderers is seen, a pixel at most."""

COARSE_MM = 0.03
"""How far the chords are off that LibreCAD and GDAL draw for splines, 8 to a piece."""

COARSE = {("cad", "LibreCAD"), ("cad", "GDAL")}

SLACK_MM = 1e-3
"""Rounding and chords of what programs tell."""


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    print()
    lines = table.lines(tmp_path_factory.mktemp("exports"), print)
    print(f"\n{table.markdown(lines)}")
    return lines


@pytest.fixture(scope="module")
def held(found):
    """The rows of drawings and profiles that a program is known to take."""
    return [line for line in found if line.is_drawing_for and line.is_profile_for]


def test_every_profile_and_every_program_is_there(found):
    assert {line.profile for line in found} == {*PROFILES}
    assert len({line.program for line in found}) == len(table.PROGRAMS)


def test_programs_show_what_they_take(held):
    assert [table.told(line) for line in held if line.row is None] == []


def test_boxes_are_right(held):
    for line in held:
        limit = PIXELS_MM.get(line.program, 0) + DEFAULT_TOLERANCE_MM + SLACK_MM
        assert line.row.box_mm <= limit, table.told(line)


def test_contours_are_there_and_closed(held):
    for line in held:
        assert line.row.is_whole, table.told(line)


def test_what_is_shown_keeps_to_the_exact_curves(held):
    for line in held:
        limit = DEFAULT_TOLERANCE_MM
        if (line.profile, line.program) in COARSE:
            limit = COARSE_MM
        # Numbers may be cut off instead of rounded, in both coordinates.
        limit += PIXELS_MM.get(line.program, 3 * line.row.finest_mm) + SLACK_MM
        assert line.row.deviation_mm <= limit, table.told(line)


@pytest.mark.parametrize("path", example_paths(), ids=lambda path: path.stem)
def test_what_inkscape_saves_still_is_the_document(path, tmp_path):
    document = open_document(path)
    written = tmp_path / f"{path.stem}.svg"
    export(document, written, named("svg"))
    again = read_sketch(by_inkscape.resaved(written, tmp_path)).document
    assert store.encode(again) == store.encode(document)
