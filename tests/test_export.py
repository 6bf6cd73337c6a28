"""`ninepoint export`: its options, and many files at once."""

import json
from dataclasses import replace
from pathlib import Path

import click
import ezdxf
import msgspec
import numpy as np
import pytest

from app import cli
from app.commands import export as module
from core import store
from core.document import Document
from core.formats import open_document
from core.formats.foreign import read_sketch
from core.profiles import PROFILES, encode, named
from drawings import letter_f

LETTER = Document(letter_f().curves[:1])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with three drawings and a point file, which is the present one."""
    monkeypatch.chdir(tmp_path)
    for name in ("a", "b", "翼 ü"):
        store.save(LETTER, tmp_path / f"{name}.ninepoint")
    (tmp_path / "square.csv").write_text("0,0\n30,0\n30,20\n0,20\n0,0\n")
    (tmp_path / "out").mkdir()
    return tmp_path


@pytest.fixture
def run(capsys):
    def run(*args):
        with pytest.raises(SystemExit) as caught:
            cli.main(["export", *map(str, args)])
        said = capsys.readouterr()
        assert "Traceback" not in said.out + said.err
        return caught.value.code, said.out, said.err

    return run


def files(folder):
    return sorted(path.name for path in Path(folder).iterdir())


def width(path):
    sketch = read_sketch(path)
    return float((sketch.high - sketch.low)[0])


def test_each_file_gets_a_line_and_all_a_summary(folder, run):
    status, output, errors = run("a.ninepoint", "翼 ü.ninepoint", "--to", "dxf", "--out", "out")
    assert (status, errors) == (0, "")
    first, second, last = output.splitlines()
    size = np.ptp(LETTER.curves[0].limit(LETTER.parameters).points(8), axis=0)
    for line, name in ((first, "a.dxf"), (second, "翼 ü.dxf")):
        place, told = line.split(": ")
        assert place == str(Path("out") / name)
        wide, _, high, unit = told.split(", closed, ")[0].split()
        # Arcs may reach beyond the curve, on either side, as far as the tolerance admits.
        assert [float(wide), float(high)] == pytest.approx(size, abs=0.025)
        assert unit == "mm"
    assert last == "2 files: 2 written."
    assert files("out") == ["a.dxf", "翼 ü.dxf"]


def test_one_bad_file_does_not_stop_the_others(folder, run):
    Path("bad.csv").write_text("1,2\nnan,3\n")
    Path("dot.csv").write_text("1,2\n")
    status, output, errors = run(
        "bad.csv", "a.ninepoint", "dot.csv", "gone.csv", "b.ninepoint", "x.odg",
        "--to", "svg", "--out", "out",
    )  # fmt: skip
    assert status == 2
    assert output.splitlines()[-1] == "6 files: 2 written, 4 not written."
    assert [line.split(": ")[:2] for line in errors.splitlines()] == [
        ["ninepoint", "bad.csv, line 2"],
        ["ninepoint", "dot.csv"],
        ["ninepoint", "gone.csv"],
        ["ninepoint", "x.odg"],
    ]
    assert files("out") == ["a.svg", "b.svg"]


def test_existing_files_are_left_alone_but_by_force(folder, run):
    Path("out/a.svg").write_text("old")
    status, output, errors = run("a.ninepoint", "b.ninepoint", "--to", "svg", "--out", "out")
    assert status == 2
    assert errors == "ninepoint: a.svg: it exists already; --force replaces it.\n"
    assert output.splitlines()[-1] == "2 files: 1 written, 1 not written."
    assert Path("out/a.svg").read_text() == "old"
    assert run("a.ninepoint", "--to", "svg", "--out", "out", "--force")[0] == 0
    assert Path("out/a.svg").read_text() != "old"


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["a.ninepoint", "a.ninepoint"], "would both become a.svg; export them into two folders."),
        (["a.ninepoint", "A.csv"], "a.ninepoint and A.csv would both become A.svg"),
        (["e\u0301.csv", "\u00e9.csv"], "would both become"),
        (["a.ninepoint", "out/b.svg"], "would be written over out/b.svg; choose another folder."),
        (["out/b.svg", "--force"], "IN and OUT are the same file."),
        ([], "Missing argument 'IN'."),
    ],
)
def test_names_that_clash_are_refused_before_anything_is_written(folder, run, args, sentence):
    Path("out/b.svg").write_text("source")
    status, output, errors = run(*args, "--to", "svg", "--out", "out")
    assert (status, output) == (2, "")
    assert sentence in errors
    assert files("out") == ["b.svg"]
    assert Path("out/b.svg").read_text() == "source"


def test_the_folder_is_made_on_request_only(folder, run):
    args = ("a.ninepoint", "--profile", "cad", "--out", "new/er")
    status, output, errors = run(*args)
    assert (status, output) == (2, "")
    assert errors == "ninepoint: er: there is no such folder; --mkdir makes it.\n"
    assert not Path("new").exists()
    assert run(*args, "--mkdir")[0] == 0
    assert files("new/er") == ["a.dxf"]
    status, _, errors = run("a.ninepoint", "--to", "svg", "--out", "square.csv")
    assert (status, "square.csv" in errors) == (2, True)


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["a.ninepoint", "--out", "out"], "Say what to write: --profile NAME or --to FORMAT."),
        (["a.ninepoint", "b.svg", "--mkdir"], "--mkdir and --jobs go with --out FOLDER."),
        (["a.ninepoint", "b.svg", "--jobs", "2"], "--mkdir and --jobs go with --out FOLDER."),
        (["a.ninepoint", "b.svg", "--jobs", "0", "--out", "out"], "Invalid value for '--jobs'"),
        (["a.ninepoint", "b.svg", "--to", "dxf"], "b.svg: it does not end in .dxf, which --to"),
        (["a.ninepoint", "b.svg", "--profile", "laser"], "The profile laser cannot be written as"),
        (["a.ninepoint", "b.dxf", "--profile", "lazer"], "There is no profile 'lazer'; there are"),
        (["a.ninepoint", "b.dxf", "--profile", "no.json"], "no.json: there is no such file."),
        (["a.ninepoint", "b.dxf", "--profile", "bad.json"], "bad.json: This is not an export"),
        (["a.ninepoint", "b.dxf", "--kerf", "wide"], "--kerf must be a number"),
        (["a.ninepoint", "b.dxf", "--kerf", "101"], "The kerf must lie between"),
        (["a.ninepoint", "b.dxf", "--kerf", "-40"], "With a kerf of -40 mm nothing is left"),
        (["a.ninepoint", "b.dxf", "--unit", "cm"], "Invalid value for '--unit'"),
        (["a.ninepoint", "b.dxf", "--colour", "blue"], "A colour is written like #1e90ff"),
        (["a.ninepoint", "b.dxf", "--layers", "two"], "Invalid value for '--layers'"),
        (["a.ninepoint", "b.dxf", "--origin", "top"], "Invalid value for '--origin'"),
        (["a.ninepoint", "b.dxf", "--read-unit", "in"], "a.ninepoint: a drawing is in mm"),
        (["a.ninepoint", "b.dxf", "--fit", "0"], "--fit must be greater than 0 mm, not 0."),
        (["a.ninepoint", "b.dxf", "--fit", "1", "--vertices"], "Choose one of --vertices and"),
    ],
)
def test_what_cannot_be_is_a_sentence(folder, run, args, sentence):
    Path("bad.json").write_text('{"name": 1}')
    status, output, errors = run(*args)
    assert (status, output) == (2, "")
    assert errors.startswith(f"ninepoint: {sentence}")
    assert not Path("b.dxf").exists()
    assert not Path("b.svg").exists()


def test_options_change_the_profile(folder, run):
    options = ("--unit", "in", "--colour", "#ff0000", "--layers", "by-curve", "--origin", "corner")
    assert run("a.ninepoint", "a.dxf", "--profile", "cad", *options)[0] == 0
    drawing = ezdxf.readfile("a.dxf")
    (entity,) = drawing.modelspace()
    assert drawing.units == 1
    assert drawing.layers.get("LETTER_F").color == 1
    assert entity.dxftype() == "SPLINE"
    assert np.allclose(drawing.header["$EXTMIN"], 0, atol=1e-6)
    plain = width_of("a.ninepoint", run)
    assert width_of("a.ninepoint", run, "--kerf", "0.5") == pytest.approx(plain + 1, abs=0.02)


def width_of(source, run, *options):
    assert run(source, "w.dxf", "--force", *options)[0] == 0
    return width("w.dxf")


def test_a_profile_of_ones_own_comes_from_a_file(folder, run):
    own = msgspec.structs.replace(named("laser-r12"), name="mine", tolerance_mm=0.5, unit="in")
    Path("mine.json").write_bytes(encode(own))
    status, output, errors = run("a.ninepoint", "a.dxf", "--profile", "mine.json")
    assert status == 0
    assert "DXF R12 states no unit: tell the program that it is in." in errors
    coarse = int(output.split(" vertices")[0].split()[-1])
    status, output, _ = run("a.ninepoint", "b.dxf", "--profile", "mine.json", "--tolerance", "0.01")
    assert int(output.split(" vertices")[0].split()[-1]) > 3 * coarse


def test_a_profile_can_be_one_that_the_drawing_holds(folder, run):
    own = msgspec.structs.replace(named("svg-polyline"), name="mine")
    store.save(LETTER.with_profile(own), "own.ninepoint")
    assert "vertices" in run("own.ninepoint", "a.svg", "--profile", "mine")[1]
    status, output, errors = run(
        "own.ninepoint", "a.ninepoint", "square.csv", "--profile", "mine", "--out", "out"
    )
    assert status == 2
    assert output.splitlines()[-1] == "3 files: 1 written, 2 not written."
    assert errors.startswith("ninepoint: a.ninepoint: There is no profile 'mine'; there are laser,")
    assert files("out") == ["own.svg"]
    status, output, errors = run("a.ninepoint", "--profile", "mine", "--out", "out")
    assert (status, output) == (2, "")


@pytest.mark.parametrize("form", ["svg", "dxf", "pdf", "png", "csv", "tsv", "json"])
def test_all_formats_are_written_without_a_screen(folder, run, form, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    status, _, errors = run("a.ninepoint", "--to", form, "--out", "out")
    assert (status, errors) == (0, "")
    start = {"svg": b"<?xml", "dxf": b"  0\n", "pdf": b"%PDF", "png": b"\x89PNG", "json": b"{"}
    assert Path(f"out/a.{form}").read_bytes().startswith(start.get(form, b"t"))


@pytest.mark.parametrize("name", PROFILES)
def test_every_profile_has_a_name_on_the_command_line(folder, run, name):
    assert run("a.ninepoint", "--profile", name, "--out", "out")[0] == 0
    assert files("out") == [f"a{PROFILES[name].suffix}"]


def test_a_table_may_have_another_format_than_its_profile(folder, run):
    assert run("a.ninepoint", "a.json", "--profile", "points", "--tolerance", "1")[0] == 0
    assert json.loads(Path("a.json").read_text())["unit"] == "mm"


def test_foreign_drawings_are_taken_by_vertices_or_fitted(folder, run):
    Path("f.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="50mm" viewBox="0 0 50 50">'
        '<path d="M0 0C10 0 20 5 30 5C40 5 45 20 45 30L0 30Z"/></svg>'
    )
    assert run("f.svg", "v.dxf")[0] == 0
    status, _, errors = run("f.svg", "fit.dxf", "--fit", "0.05")
    assert status == 0
    assert "control points keep within 0.0" in errors
    assert width("fit.dxf") == pytest.approx(45, abs=0.12)
    assert width("v.dxf") != pytest.approx(45, abs=1)
    assert run("f.svg", "inch.dxf", "--read-unit", "in", "--fit", "1")[0] == 0
    assert width("inch.dxf") == pytest.approx(45 * 25.4, abs=2.1)


def test_our_own_svg_is_the_drawing_again_unless_vertices_are_asked_for(folder, run):
    assert run("a.ninepoint", "a.svg")[0] == 0
    assert run("a.ninepoint", "direct.dxf")[0] == 0
    assert run("a.svg", "again.dxf")[0] == 0
    assert Path("again.dxf").read_bytes() == Path("direct.dxf").read_bytes()
    assert run("a.svg", "v.dxf", "--vertices")[0] == 0
    assert Path("v.dxf").read_bytes() != Path("direct.dxf").read_bytes()


def test_patterns_are_read_where_the_shell_leaves_them(folder, run):
    assert run("*.ninepoint", "--to", "svg", "--out", "out")[0] == 0
    assert files("out") == ["a.svg", "b.svg", "翼 ü.svg"]
    odd = Path("[x]*.csv")
    odd.write_text("0,0\n1,1\n0,1\n")
    assert run(odd, "odd.svg")[0] == 0
    status, _, errors = run("no*.csv", "--to", "svg", "--out", "out")
    assert (status, "no*.csv: " in errors) == (2, True)


def test_notes_name_the_file_they_belong_to(folder, run):
    dot = LETTER.curves[0].without(range(1, 10))
    store.save(LETTER.with_curve_added(dot), "dot.ninepoint")
    status, _, errors = run("dot.ninepoint", "a.ninepoint", "--to", "svg", "--out", "out")
    assert status == 0
    assert errors == (
        "ninepoint: dot.ninepoint: 1 of the curves had no extent and are left out.\n"
    )


def test_a_bar_is_shown_on_a_terminal_only(folder, run, monkeypatch, capsys):
    lengths = []
    real = click.progressbar

    def noted(*args, **fields):
        lengths.append(fields["length"])
        return real(*args, **fields)

    monkeypatch.setattr(module.click, "progressbar", noted)
    args = ("a.ninepoint", "b.ninepoint", "--to", "svg", "--out", "out", "--force")
    assert run(*args)[0] == 0
    assert lengths == []
    monkeypatch.setattr(module.sys.stderr, "isatty", lambda: True, raising=False)
    status, output, _ = run(*args)
    assert (status, lengths) == (0, [2])
    assert [line.split(":")[0] for line in output.splitlines()] == [
        str(Path("out/a.svg")),
        str(Path("out/b.svg")),
        "2 files",
    ]


def test_closing_applies_to_every_kind_of_file(folder, run):
    assert run("a.ninepoint", "a.svg")[0] == 0
    for source in ("a.ninepoint", "square.csv", "a.svg"):
        status, output, _ = run(source, "o.dxf", "--open", "--force")
        assert (status, " open, " in output) == (0, True)


def test_a_scheme_changes_curves_and_not_points(folder, run):
    assert run("a.ninepoint", "tight.svg", "--alpha", "1/4", "--gamma", "1/4")[0] == 0
    carried = read_sketch("tight.svg").document
    expected = open_document("a.ninepoint")
    parameters = replace(expected.parameters, alpha="1/4", gamma="1/4")
    assert carried.parameters == parameters
    np.testing.assert_array_equal(carried.curves[0].points, expected.curves[0].points)
