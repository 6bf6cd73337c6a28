"""`ninepoint convert`: anything that can be read becomes a drawing."""

from pathlib import Path

import numpy as np
import pytest

from app import cli
from core import store
from core.document import Document
from core.family import PRESETS, Parameters
from core.formats import export, open_document, profile_for
from core.formats.foreign import read_sketch
from drawings import letter_f

SQUARE = "0,0\n30,0\n30,20\n0,20\n0,0\n"
PATH = (
    '<svg xmlns="http://www.w3.org/2000/svg" {page} viewBox="0 0 50 50">'
    '<path d="M0 0C10 0 20 5 30 5C40 5 45 20 45 30L0 30Z"/></svg>'
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    store.save(Document(letter_f().curves[:1]), tmp_path / "letter.ninepoint")
    (tmp_path / "square.csv").write_text(SQUARE)
    (tmp_path / "mm.svg").write_text(PATH.format(page='width="50mm" height="50mm"'))
    (tmp_path / "px.svg").write_text(PATH.format(page=""))
    return tmp_path


@pytest.fixture
def run(capsys):
    def run(*args):
        with pytest.raises(SystemExit) as caught:
            cli.main(["convert", *map(str, args)])
        said = capsys.readouterr()
        return caught.value.code, said.out, said.err

    return run


def box(path):
    points = np.concatenate([curve.points for curve in open_document(path).curves])
    return np.ptp(points, axis=0).tolist()


def test_points_become_a_drawing(folder, run):
    assert run("square.csv", "a.ninepoint") == (
        0,
        "a.ninepoint: 1 curve, 4 control points, polygons of 30.00 x 20.00 mm\n",
        "",
    )
    document = open_document("a.ninepoint")
    assert document.parameters == PRESETS["Calm"]
    assert document.curves[0].closed
    assert run("square.csv", "b.ninepoint", "--unit", "in", "--open")[0] == 0
    assert box("b.ninepoint") == pytest.approx([30 * 25.4, 20 * 25.4])
    assert not open_document("b.ninepoint").curves[0].closed


def test_vertices_or_a_fit_of_a_foreign_drawing(folder, run):
    status, output, errors = run("mm.svg", "v.ninepoint", "--vertices")
    assert (status, errors) == (0, "")
    assert "1 curve, 4 control points" in output
    assert run("mm.svg", "same.ninepoint")[0] == 0
    assert Path("same.ninepoint").read_bytes() == Path("v.ninepoint").read_bytes()
    status, _, errors = run("mm.svg", "f.ninepoint", "--fit", "0.1", "--beta", "-1/4")
    assert status == 0
    assert "control points keep within 0." in errors
    document = open_document("f.ninepoint")
    assert document.parameters == Parameters("0", "-1/4", "0")
    curve = document.curves[0].limit(document.parameters)
    foreign = read_sketch("mm.svg")
    assert np.ptp(curve.points(6), axis=0) == pytest.approx(foreign.high - foreign.low, abs=0.2)


def test_a_unit_that_is_not_said_is_told_with_the_size(folder, run):
    status, _, errors = run("px.svg", "a.ninepoint")
    assert status == 0
    assert "it does not say its unit: taken in px, it is 11.91 x 7.94 mm." in errors
    assert run("px.svg", "b.ninepoint", "--unit", "mm")[2] == ""
    assert box("b.ninepoint") == pytest.approx([45, 30])


def test_our_own_svg_comes_back_bit_for_bit(folder, run):
    export(open_document("letter.ninepoint"), "letter.svg", profile_for("letter.svg"))
    assert run("letter.svg", "again.ninepoint")[0] == 0
    assert Path("again.ninepoint").read_bytes() == Path("letter.ninepoint").read_bytes()


def test_a_drawing_gets_another_scheme(folder, run):
    assert run("letter.ninepoint", "a.ninepoint", "--neighbours", "mirrored")[0] == 0
    found, before = open_document("a.ninepoint"), open_document("letter.ninepoint")
    assert found.parameters.neighbours == "mirrored"
    np.testing.assert_array_equal(found.curves[0].points, before.curves[0].points)


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["square.csv", "a.dxf"], "OUT must end in .ninepoint; other formats are exported."),
        (["letter.ninepoint", "letter.ninepoint", "--force"], "IN and OUT are the same file."),
        (["square.csv", "letter.ninepoint"], "letter.ninepoint: it exists already; --force repla"),
        (["gone.svg", "a.ninepoint"], "gone.svg: there is no such file."),
        (["note.odg", "a.ninepoint"], "note.odg: files that end in '.odg' cannot be opened; the"),
        (["note", "a.ninepoint"], "note: files without an ending cannot be opened; the endings"),
        (["letter.ninepoint", "a.ninepoint", "--unit", "in"], "letter.ninepoint: a drawing is in"),
        (["mm.svg", "a.ninepoint", "--fit", "x"], "--fit must be a number"),
        (["mm.svg", "a.ninepoint", "--unit", "mile"], "Invalid value for '--unit'"),
        (["mm.svg", "a.ninepoint", "--vertices", "--fit", "1"], "Choose one of --vertices and"),
        (["mm.svg", "no/a.ninepoint"], "a.ninepoint: its folder does not exist."),
        (["mm.svg"], "Missing argument 'OUT'."),
    ],
)
def test_what_cannot_be_converted_is_a_sentence(folder, run, args, sentence):
    before = Path("letter.ninepoint").read_bytes()
    status, output, errors = run(*args)
    assert (status, output) == (2, "")
    assert errors.startswith(f"ninepoint: {sentence}")
    assert not Path("a.ninepoint").exists()
    assert Path("letter.ninepoint").read_bytes() == before


def test_force_replaces(folder, run):
    assert run("square.csv", "letter.ninepoint", "--force")[0] == 0
    assert open_document("letter.ninepoint").curves[0].count == 4
