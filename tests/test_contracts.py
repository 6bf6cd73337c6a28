"""The rules that tools can check: who imports whom, types, style, and what is written twice."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from app import bootstrap

ROOT = Path(__file__).resolve().parent.parent
SCRIPTS = Path(sys.executable).parent  # the tools of the interpreter that runs the tests


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(["lint-imports", "--no-logo"], id="imports"),
        pytest.param(["ruff", "check", "--no-fix", "."], id="style"),
        pytest.param(["mypy"], id="types"),
    ],
)
def test_tool_finds_nothing(command):
    tool = shutil.which(command[0], path=SCRIPTS)
    assert tool, f"{command[0]} is not installed beside {sys.executable}"
    done = subprocess.run([tool, *command[1:]], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)} says:\n{done.stdout}{done.stderr}"


def test_bootstrap_refuses_what_the_project_refuses():
    with (ROOT / "pyproject.toml").open("rb") as file:
        required = tomllib.load(file)["project"]["requires-python"]
    assert required == ">=" + ".".join(map(str, bootstrap.OLDEST_PYTHON))
