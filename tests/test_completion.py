"""Completion by shells: the scripts, and what they are answered."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from app import cli
from app.commands.manual import files_of
from core.profiles import PROFILES

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("wing.ninepoint", "wing.odg", "web.svg", ".hidden.svg"):
        (tmp_path / name).touch()
    return tmp_path


@pytest.fixture
def complete(capsys, monkeypatch):
    """What bash is offered for the last word of a line."""

    def complete(line):
        words = line.split(" ")
        monkeypatch.setenv("_NINEPOINT_COMPLETE", "bash_complete")
        monkeypatch.setenv("COMP_WORDS", line)
        monkeypatch.setenv("COMP_CWORD", str(len(words) - 1))
        with pytest.raises(SystemExit) as caught:
            cli.main([])
        assert caught.value.code == 0
        return capsys.readouterr().out.split()

    return complete


def test_commands_options_profiles_and_files_are_offered(folder, complete):
    assert complete("ninepoint ex") == ["plain,export"]
    assert complete("ninepoint --s") == ["plain,--screenshot", "plain,--size"]
    assert complete("ninepoint wi") == ["plain,wing.ninepoint"]
    assert complete("ninepoint we") == ["plain,web.svg"]
    assert complete("ninepoint export w") == ["plain,web.svg", "plain,wing.ninepoint"]
    assert complete("ninepoint export --ke") == ["plain,--kerf"]
    offered = complete("ninepoint export --profile ")
    assert offered == [f"plain,{name}" for name in PROFILES]
    assert complete("ninepoint export --to p") == ["plain,pdf", "plain,png"]
    assert complete("ninepoint completion z") == ["plain,zsh"]


def test_shells_list_files_themselves_where_a_name_would_break(folder):
    (folder / "with blank.csv").touch()
    (folder / "sub").mkdir()
    (folder / "sub" / "x.csv").touch()

    def kinds(incomplete):
        return [(item.type, item.value) for item in files_of(incomplete, (".csv", ".svg"))]

    assert kinds("web") == [("plain", "web.svg")]
    assert kinds("with") == [("file", "with")]
    assert kinds("s") == [("file", "s")]
    assert kinds("") == [("file", "")]
    assert kinds("sub/") == [("plain", "sub/x.csv")]
    assert kinds("gone/") == [("file", "gone/")]
    assert kinds("none") == [("file", "none")]
    assert kinds(".hid") == [("plain", ".hidden.svg")]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_scripts_say_where_they_belong(shell, capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main(["completion", shell])
    script = capsys.readouterr().out
    assert caught.value.code == 0
    assert "# To be kept in " in script
    assert f"_NINEPOINT_COMPLETE={shell}_complete" in script
    program = shutil.which(shell)
    if program is not None:
        done = subprocess.run([program, "-n"], input=script, text=True, capture_output=True)
        assert (done.returncode, done.stderr) == (0, "")


def test_the_program_answers_a_shell_instead_of_opening_a_window(folder):
    done = subprocess.run(
        [sys.executable, "-m", "app"],
        env=os.environ
        | {"PYTHONPATH": str(ROOT), "_NINEPOINT_COMPLETE": "bash_complete"}
        | {"COMP_WORDS": "ninepoint conv", "COMP_CWORD": "1"},
        capture_output=True,
        check=False,
        text=True,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "plain,convert\n", "")


def test_unknown_shells_are_refused(capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main(["completion", "tcsh"])
    assert caught.value.code == 2
    assert "'tcsh' is not one of" in capsys.readouterr().err


@pytest.mark.parametrize(
    "command", ["export", "convert", "info", "profiles", "analyse", "sample", "completion"]
)
def test_every_command_has_a_manual(command, capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main([command, "--help"])
    manual = capsys.readouterr().out
    assert caught.value.code == 0
    for heading in ("Usage: ninepoint ", "Options:", "Exit status:", "Examples:"):
        assert heading in manual
    assert f"  ninepoint {command}" in manual
    assert max(map(len, manual.splitlines())) <= 100


def test_profiles_are_listed_and_one_is_a_start_for_ones_own(tmp_path, capsys):
    with pytest.raises(SystemExit):
        cli.main(["profiles"])
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(PROFILES)
    with pytest.raises(SystemExit):
        cli.main(["profiles", "laser"])
    own = tmp_path / "own.json"
    own.write_text(capsys.readouterr().out)
    (tmp_path / "a.csv").write_text("0,0\n30,0\n30,20\n0,0\n")
    words = ["export", str(tmp_path / "a.csv"), str(tmp_path / "a.dxf"), "--profile", str(own)]
    with pytest.raises(SystemExit) as caught:
        cli.main(words)
    assert caught.value.code == 0
    with pytest.raises(SystemExit) as caught:
        cli.main(["profiles", "lazer"])
    assert caught.value.code == 2
    assert "There is no profile 'lazer'" in capsys.readouterr().err
