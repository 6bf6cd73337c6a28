"""`ninepoint analyse`: words, LaTeX, and JSON that stays JSON whatever goes wrong."""

import json

import pytest

from app.cli import main
from core.family import Parameters
from core.report import as_json, report


@pytest.fixture
def run(capsys):
    def call(*args):
        with pytest.raises(SystemExit) as ended:
            main(["analyse", *args])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


def test_json_is_the_report_and_nothing_else(run):
    status, out, err = run("--alpha", "1/4", "--beta", "-1/2", "--gamma", "1/4", "--json")
    assert (status, err) == (0, "")
    expected = as_json(report(Parameters("1/4", "-1/2", "1/4")))
    assert json.loads(out) == json.loads(json.dumps(expected))


def test_words_are_the_default_and_parameters_default_to_zero(run):
    status, out, _ = run("--neighbours", "mirrored")
    assert status == 0
    assert out.startswith("Scheme (0, 0, 0), mirrored neighbours\n  the preset Lagrange\n")


def test_latex_is_for_a_paper(run):
    status, out, _ = run("--beta", "-1", "--latex")
    assert status == 0
    assert out.startswith("\\begin{align*}")


@pytest.mark.parametrize(
    ("args", "part"),
    [
        (("--beta", "x"), "--beta must be a number"),
        (("--beta", "nan"), "--beta must be a number"),
        (("--alpha", "101"), "--alpha must lie between -100 and 100"),
        (("--alpha", "1/" + "7" * 40), "too fine a fraction"),
        (("--alpha", "9" * 200), "--alpha must be a number"),
        (("--neighbours", "both"), "'both' is not one of"),
        (("--delta", "1"), "--delta"),
        (("--latex",), "one of --json and --latex"),
        (("surplus",), "surplus"),
    ],
)
def test_errors_are_a_sentence_and_with_json_they_are_json(run, args, part):
    status, out, err = run(*args, "--json")
    assert status == 2
    assert part in json.loads(out)["error"]
    assert err == ""
    if args != ("--latex",):
        status, out, err = run(*args)
        assert (status, out) == (2, "")
        assert err.startswith("ninepoint: ")
        assert part in err


def test_divergent_members_are_reported_without_an_error(run):
    status, out, _ = run("--alpha", "100", "--json")
    assert status == 0
    assert json.loads(out)["continuity"]["class"] is None
