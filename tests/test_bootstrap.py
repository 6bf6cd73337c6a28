"""Set-up and start, without a network and without pip: the steps are recorded, not run."""

import ast
import ctypes
import os
import shutil
import socket
import subprocess
import sys
import venv
from pathlib import Path

import pytest

from app import bootstrap
from app.bootstrap import Environment

ROOT = Path(__file__).resolve().parent.parent
linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux libraries")


class Steps(list):
    """Stands for `bootstrap.run`: names the steps, makes what they would, fails on demand."""

    failing = ""
    killed = False

    def __call__(self, command, folder, **variables):
        step = "venv" if "venv" in command else " ".join(command[command.index("install") :])
        self.append(step)
        if step == "venv":
            python = Path(Environment(folder).python)
            python.parent.mkdir()
            python.touch()
            (python.parent.parent / "pyvenv.cfg").touch()
        elif self.killed:
            raise KeyboardInterrupt
        return self.failing if step != "venv" else ""


@pytest.fixture
def steps(monkeypatch):
    steps = Steps()
    monkeypatch.setattr(bootstrap, "run", steps)
    monkeypatch.setattr(bootstrap, "missing_packages", lambda setting_up: [])
    return steps


@pytest.fixture
def checkout(tmp_path):
    root = tmp_path / "my drawings ünï"
    root.mkdir()
    (root / "pyproject.toml").write_text("[project]\nname = 'ninepoint'\n")
    return root


@pytest.fixture
def started(monkeypatch, checkout):
    """The commands that `enter` would have become, started in the checkout."""
    commands = []
    monkeypatch.setattr(bootstrap, "ROOT", str(checkout))
    monkeypatch.setattr(bootstrap, "go_on", commands.append)
    return commands


def change(checkout):
    with (checkout / "pyproject.toml").open("a") as project:
        project.write("dependencies = []\n")


def test_a_new_checkout_is_set_up_and_a_second_start_has_nothing_to_do(checkout, steps, capsys):
    environment = Environment(str(checkout))
    assert not environment.is_ready("")
    environment.set_up("")
    assert environment.is_ready("")
    assert steps == ["venv", "install --editable ."]
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.splitlines() == [
        f"Setting up Ninepoint in {environment.folder} (once, about a minute) ..."
    ]
    environment.set_up("")
    assert len(steps) == 2


def test_the_tests_add_to_the_program_and_the_program_leaves_them(checkout, steps):
    environment = Environment(str(checkout))
    environment.set_up("")
    assert not environment.is_ready("test")
    environment.set_up("test")
    assert environment.is_ready("test")
    assert environment.is_ready("")
    assert steps[2:] == ["install --editable .[test]"]
    change(checkout)
    environment.set_up("")
    assert environment.is_ready("test")


def test_a_changed_project_is_installed_again(checkout, steps):
    environment = Environment(str(checkout))
    environment.set_up("test")
    change(checkout)
    assert not environment.is_ready("test")
    environment.set_up("test")
    assert environment.is_ready("test")
    assert steps[2:] == ["install --editable .[test]"]


@pytest.mark.parametrize("already_there", [False, True])
def test_killed_half_way_starts_over(checkout, steps, already_there):
    environment = Environment(str(checkout))
    if already_there:
        environment.set_up("")
        change(checkout)
    steps.killed = True
    with pytest.raises(KeyboardInterrupt):
        environment.set_up("")
    assert not environment.is_ready("")
    steps.killed = False
    leftover = Path(environment.folder, "lib", "half a package")
    leftover.mkdir(parents=True)
    steps.clear()
    environment.set_up("")
    assert steps == ["venv", "install --editable ."]
    assert not leftover.exists()
    assert environment.is_ready("")


def test_a_failed_set_up_says_why_and_starts_over(checkout, steps):
    environment = Environment(str(checkout))
    steps.failing = "    ERROR: No matching distribution found"
    with pytest.raises(SystemExit, match=r"network connection.\n\n    ERROR: No matching"):
        environment.set_up("")
    assert not environment.is_ready("")
    steps.failing = ""
    environment.set_up("")
    assert steps[2:] == ["venv", "install --editable ."]


def test_a_failed_update_leaves_what_was_there(checkout, steps):
    environment = Environment(str(checkout))
    environment.set_up("test")
    before = (checkout / "pyproject.toml").read_text()
    change(checkout)
    steps.failing = "no network"
    with pytest.raises(SystemExit):
        environment.set_up("test")
    assert not environment.is_ready("test")
    (checkout / "pyproject.toml").write_text(before)
    assert environment.is_ready("test")


@pytest.mark.parametrize("damage", ["python", "pyvenv.cfg", "ninepoint-stamp", "place"])
def test_a_broken_environment_is_made_anew(checkout, steps, damage, monkeypatch):
    environment = Environment(str(checkout))
    environment.set_up("")
    if damage == "python":  # as after an upgrade of the system: a link that leads nowhere
        Path(environment.python).unlink()
        Path(environment.python).symlink_to(checkout / "gone")
    elif damage == "place":  # as made by another Python, or before the checkout was moved
        environment.place = "Python 3.99 in another place"
    else:
        Path(environment.folder, damage).unlink()
    assert not environment.is_ready("")
    environment.set_up("")
    assert environment.is_ready("")
    assert steps[2:] == ["venv", "install --editable ."]


def test_a_start_waits_for_another_one(checkout, steps, monkeypatch, capsys):
    environment = Environment(str(checkout))
    folder = Path(environment.folder)
    folder.mkdir()
    with (folder / "lock").open("w") as other:
        assert bootstrap.take(other.fileno())
        monkeypatch.setattr("time.sleep", lambda seconds: other.close())
        environment.set_up("")
    assert "Another start is setting up Ninepoint" in capsys.readouterr().err
    assert steps == ["venv", "install --editable ."]


def test_a_start_ends_up_inside(checkout, steps, started, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["app", "a file", "--flag"])
    bootstrap.enter("app")
    environment = Environment(str(checkout))
    assert started == [[environment.python, str(checkout / "app"), "a file", "--flag"]]
    monkeypatch.setattr(sys, "prefix", environment.folder)
    bootstrap.enter("app")
    assert len(started) == 1


def test_a_folder_that_cannot_be_written_is_named(checkout, steps, started):
    (checkout / ".venv").touch()  # root may write anywhere, but not below a file
    with pytest.raises(SystemExit) as end:
        bootstrap.enter("app")
    assert f"cannot be set up in the folder {checkout}" in end.value.code
    assert started == steps == []


def test_interrupted_says_what_follows(checkout, steps, started, capsys):
    steps.killed = True
    with pytest.raises(SystemExit) as end:
        bootstrap.enter("app")
    assert end.value.code == 130
    assert "begins again at the next start" in capsys.readouterr().err


def test_an_old_python_is_refused():
    bootstrap.refuse_old_python((3, 11, 0))
    with pytest.raises(SystemExit) as end:
        bootstrap.refuse_old_python((3, 9, 2))
    sentence = f"Ninepoint needs Python 3.11 or newer; {sys.executable} is Python 3.9.2."
    assert end.value.code == sentence


@pytest.mark.parametrize(
    "name", ["app/__init__.py", "app/__main__.py", "app/bootstrap.py", "tests/__main__.py"]
)
def test_what_refuses_an_old_python_can_be_read_by_it(name):
    tree = ast.parse((ROOT / name).read_text("utf-8"), feature_version=(3, 6))
    imported = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert "__future__" not in imported  # 3.6 knows no annotations there


def test_a_step_that_fails_is_told_in_its_last_words(tmp_path):
    noise = "print('Collecting numpy'); print('ERROR: no network'); print('note: bye'); exit(1)"
    words = bootstrap.run([sys.executable, "-c", noise], str(tmp_path))
    assert words.startswith("    ERROR: no network\n\nThe step that failed: ")
    assert bootstrap.run([sys.executable, "-c", "print('fine')"], str(tmp_path)) == ""


@pytest.fixture
def lacking(monkeypatch):
    """Pretend that the system has none of Qt's libraries, nor Python's venv."""

    def refuse(name):
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(ctypes, "CDLL", refuse)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    for variable in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(variable, raising=False)


@linux
def test_packages_are_asked_for_by_need(lacking, monkeypatch):
    qt = list(bootstrap.QT_LIBRARIES.values())
    assert bootstrap.missing_packages() == qt
    python = "python{}.{}-venv".format(*sys.version_info[:2])
    assert bootstrap.missing_packages(setting_up=True) == [python, *qt]
    monkeypatch.setenv("DISPLAY", ":0")
    assert {"libxcb-cursor0", "libxcb-icccm4"} < set(bootstrap.missing_packages())
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    assert bootstrap.missing_packages() == qt


@linux
def test_a_set_up_asks_for_what_it_needs(checkout, lacking, monkeypatch):
    """The program itself asks for Qt's libraries, when it opens a window: an export needs none."""
    asked = []
    monkeypatch.setattr(bootstrap, "require_packages", asked.append)
    monkeypatch.setattr(bootstrap, "run", Steps())
    Environment(str(checkout)).set_up("")
    Environment(str(checkout)).set_up("test")
    monkeypatch.setattr(bootstrap, "can_make_environments", lambda: True)
    change(checkout)
    Environment(str(checkout)).set_up("")
    python = "python{}.{}-venv".format(*sys.version_info[:2])
    qt = list(bootstrap.QT_LIBRARIES.values())
    assert asked == [[python, *qt], [python, *qt]]


@linux
def test_an_ordinary_user_is_told_the_command(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    monkeypatch.setattr(shutil, "which", lambda name: f"/usr/bin/{name}")
    with pytest.raises(SystemExit) as end:
        bootstrap.require_packages(["python3.11-venv", "libegl1"])
    assert "\n    sudo apt-get install python3.11-venv libegl1\n" in end.value.code


@linux
def test_root_has_the_packages_installed(monkeypatch, capsys):
    commands = []
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(bootstrap, "run", lambda command, *_, **__: commands.append(command))
    bootstrap.require_packages(["libegl1", "libgl1"])
    assert [command[:2] for command in commands] == [["apt-get", "update"], ["apt-get", "install"]]
    assert commands[1][-2:] == ["libegl1", "libgl1"]
    assert capsys.readouterr().err == "Installing with apt-get: libegl1 libgl1\n"
    monkeypatch.setattr(bootstrap, "run", lambda *_, **__: "E: Unable to locate package libegl1")
    with pytest.raises(SystemExit, match="E: Unable to locate"):
        bootstrap.require_packages(["libegl1"])


def test_another_system_is_told_the_names(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(SystemExit, match=r"libegl1 libgl1\. Install what this system calls"):
        bootstrap.require_packages(["libegl1", "libgl1"])


@pytest.fixture
def no_screen(monkeypatch):
    for variable in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(bootstrap, "missing_packages", list)
    return monkeypatch


@linux
def test_no_display_is_told_with_the_way_out(no_screen):
    with pytest.raises(SystemExit) as end:
        bootstrap.require_display()
    assert "neither DISPLAY nor WAYLAND_DISPLAY" in end.value.code
    assert "--screenshot FILE.png" in end.value.code
    assert "QT_QPA_PLATFORM=offscreen" in end.value.code


@linux
@pytest.mark.parametrize("display", [":59321", "nonsense"])
def test_a_display_where_nothing_answers_is_told(no_screen, display):
    no_screen.setenv("DISPLAY", display)
    with pytest.raises(SystemExit, match=f"the screen {display}, which DISPLAY names"):
        bootstrap.require_display()


@linux
def test_a_screen_that_answers_and_an_offscreen_platform_pass(no_screen, tmp_path):
    with socket.socket(socket.AF_UNIX) as compositor:
        compositor.bind(str(tmp_path / "wayland-9"))
        compositor.listen()
        no_screen.setenv("XDG_RUNTIME_DIR", str(tmp_path))
        no_screen.setenv("WAYLAND_DISPLAY", "wayland-9")
        bootstrap.require_display()
    with pytest.raises(SystemExit):  # the compositor has ended
        bootstrap.require_display()
    no_screen.setenv("QT_QPA_PLATFORM", "offscreen")
    bootstrap.require_display()


@pytest.fixture
def ready(checkout):
    """A checkout whose environment is finished: only the programs in it are stand-ins."""
    for folder in ("app", "tests"):
        (checkout / folder).mkdir()
    for name in ("app/__init__.py", "app/__main__.py", "app/bootstrap.py", "tests/__main__.py"):
        shutil.copy(ROOT / name, checkout / name)
    report = "import os, sys\ndef main(*args):\n    print(sys.prefix, os.getcwd(), sys.argv[1:])\n"
    (checkout / "app" / "cli.py").write_text(report + "    sys.exit(7)\n")
    (checkout / "pytest.py").write_text(report + "    return 5\n")
    environment = Environment(str(checkout))
    venv.create(environment.folder, with_pip=False, symlinks=os.name != "nt")
    environment.write_stamp("test", (checkout / "pyproject.toml").read_text())
    return environment


@pytest.mark.parametrize(("folder", "status"), [("app", 7), ("tests", 5)])
def test_both_commands_work_from_anywhere_and_pass_on_the_status(
    ready, checkout, tmp_path, folder, status
):
    command = [sys.executable, "-W", "error", str(checkout / folder), "a file", "-k", "x"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.stderr == ""
    cwd = checkout if folder == "tests" else tmp_path
    assert done.stdout == f"{ready.folder} {cwd} ['a file', '-k', 'x']\n"
    assert done.returncode == status
