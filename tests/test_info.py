"""`ninepoint info`: what is in a file, in words and in JSON."""

import json

import msgspec
import pytest

from app import cli
from core import store
from core.family import Parameters
from core.formats import export, profile_for, survey
from core.profiles import named
from drawings import letter_f


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    own = msgspec.structs.replace(named("laser"), name="mine")
    store.save(letter_f().with_profile(own), tmp_path / "letter.ninepoint")
    export(letter_f(), tmp_path / "letter.svg", profile_for("a.svg"))
    export(letter_f(), tmp_path / "letter.dxf", named("cad"))
    (tmp_path / "empty.csv").write_text("")
    return tmp_path


@pytest.fixture
def run(capsys):
    def run(*args):
        with pytest.raises(SystemExit) as caught:
            cli.main(["info", *args])
        said = capsys.readouterr()
        return caught.value.code, said.out, said.err

    return run


def test_a_drawing_is_told_in_words(folder, run):
    status, output, errors = run("letter.ninepoint")
    assert (status, errors) == (0, "")
    report = survey(letter_f(), named("laser"))
    assert output.splitlines() == [
        "letter.ninepoint:",
        f"  size       {report.width_mm:.2f} x {report.height_mm:.2f} mm",
        "  curves     2, 1 of them closed",
        "  points     14",
        f"  arcs       {report.entities}",
        "  unit       mm",
        "  scheme     (0, -1/2, 0), Calm",
        "  smooth     C^3, proven",
        "  profiles   mine",
    ]


def test_json_says_the_same_and_more(folder, run):
    status, output, errors = run("letter.ninepoint", "--json")
    found = json.loads(output)
    assert (status, errors) == (0, "")
    assert found["curves"] == [
        {"name": "Letter F", "closed": True, "points": 10},
        {"name": "Stroke", "closed": False, "points": 4},
    ]
    assert found["scheme"]["class"] == 3
    assert found["profiles"] == ["mine"]
    assert found["size_mm"] == pytest.approx([50, 50], abs=8)


def test_a_foreign_file_tells_layers_unit_and_entities(folder, run):
    status, output, _ = run("letter.dxf", "--json")
    found = json.loads(output)
    assert status == 0
    assert found["layers"] == ["LETTER_F", "STROKE"]
    assert (found["unit"], found["unit_is_known"], found["scheme"]) == ("mm", True, None)
    assert [curve["closed"] for curve in found["curves"]] == [True, False]
    assert found["entities"]["cubics"] > 10
    doubled = json.loads(run("letter.dxf", "--json", "--unit", "in")[1])
    assert doubled["size_mm"][0] == pytest.approx(25.4 * found["size_mm"][0])
    assert "drawing" not in found


def test_our_own_svg_tells_of_the_drawing_in_it(folder, run):
    assert "It holds the drawing of Ninepoint that it was made of:\n  size " in run("letter.svg")[1]
    found = json.loads(run("letter.svg", "--json")[1])
    assert found["drawing"]["points"] == 14


def test_an_unknown_unit_and_a_divergent_scheme_are_said(folder, run):
    (folder / "px.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L10 10"/></svg>'
    )
    assert "  unit       px (the file does not say)\n" in run("px.svg")[1]
    wild = letter_f().with_parameters(Parameters("100", "0", "100", "mirrored"))
    store.save(wild, folder / "wild.ninepoint")
    status, output, _ = run("wild.ninepoint")
    assert status == 0
    assert "  smooth     nothing is proven\n" in output
    assert "  note       " in output


@pytest.mark.parametrize("name", ["empty.csv", "gone.svg", "note.odg"])
def test_errors_are_a_sentence_and_with_json_they_are_json(folder, run, name):
    status, output, errors = run(name)
    assert (status, output) == (2, "")
    assert errors.startswith(f"ninepoint: {name}: ")
    status, output, errors = run(name, "--json")
    assert (status, errors) == (2, "")
    assert json.loads(output)["error"].startswith(f"{name}: ")
