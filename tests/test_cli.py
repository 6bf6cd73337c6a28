import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import ezdxf
import pytest

from app import cli
from core import store
from core.family import Parameters
from core.formats import export, open_document, profile_for
from drawings import letter_f

ROOT = Path(__file__).resolve().parent.parent
SQUARE = "0,0\n30,0\n30,20\n0,20\n0,0\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a drawing and a point file, which is the present one."""
    monkeypatch.chdir(tmp_path)
    store.save(letter_f(), tmp_path / "letter.ninepoint")
    (tmp_path / "square.csv").write_text(SQUARE)
    return tmp_path


@pytest.fixture
def run(capsys):
    """Run the command line in this process: status, output, errors."""

    def run(*args):
        with pytest.raises(SystemExit) as caught:
            cli.main([str(arg) for arg in args])
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        return caught.value.code, captured.out, captured.err

    return run


@pytest.fixture
def window(monkeypatch):
    """What the window was called with, instead of a window."""
    calls = []
    stand_in = ModuleType("app.launch")
    stand_in.run = lambda *args: calls.append(args) or 0
    monkeypatch.setitem(sys.modules, "app.launch", stand_in)
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    return calls


def test_export_says_what_it_wrote(folder, run):
    status, output, errors = run("export", "square.csv", "square.dxf")
    report = export(open_document("square.csv"), "other.dxf", profile_for("other.dxf"))
    assert (status, errors) == (0, "")
    assert output == f"square.dxf: {report.summary}\n"
    assert Path("square.dxf").read_bytes() == Path("other.dxf").read_bytes()


@pytest.mark.parametrize("suffix", [".svg", ".dxf"])
def test_options_change_the_scheme_the_tolerance_and_the_ends(folder, run, suffix):
    options = ["--alpha", "1/4", "--beta", "-1/2", "--gamma=-0.1", "--neighbours", "mirrored"]
    status, _, _ = run(
        "export", "square.csv", f"a{suffix}", *options, "--tolerance", "1/50", "--open"
    )
    document = open_document("square.csv", closed=False)
    document = document.with_parameters(Parameters("1/4", "-1/2", "-1/10", "mirrored"))
    report = export(document, f"b{suffix}", profile_for(f"b{suffix}").within(0.02))
    assert status == 0
    assert report.closed_contours == 0
    assert Path(f"a{suffix}").read_bytes().replace(b"<title>a<", b"<title>b<") == (
        Path(f"b{suffix}").read_bytes()
    )


def test_parameters_that_are_not_given_are_those_of_the_drawing(folder, run):
    store.save(letter_f().with_parameters(Parameters("1/4", "-1/2", "1/4")), "tight.ninepoint")
    for name, options in (("as_is", []), ("beta", ["--beta", "-3/4"])):
        run("export", "tight.ninepoint", f"{name}.dxf", *options)
    expected = letter_f().with_parameters(Parameters("1/4", "-3/4", "1/4"))
    export(expected, "expected.dxf", profile_for("expected.dxf"))
    assert Path("beta.dxf").read_bytes() == Path("expected.dxf").read_bytes()
    assert Path("beta.dxf").read_bytes() != Path("as_is.dxf").read_bytes()


def test_closing_and_opening_apply_to_drawings_too(folder, run):
    for option, closed in (("--closed", True), ("--open", False)):
        assert run("export", "letter.ninepoint", "a.dxf", option, "--force")[0] == 0
        assert {e.closed for e in ezdxf.readfile("a.dxf").modelspace()} == {closed}


def test_an_existing_file_is_replaced_by_force_and_the_source_never(folder, run):
    Path("link.svg").symlink_to("square.csv")
    assert run("export", "square.csv", "a.svg")[0] == 0
    before = Path("a.svg").read_bytes()
    again = ("export", "square.csv", "a.svg", "--tolerance", "0.1")
    assert run(*again) == (2, "", "ninepoint: a.svg: it exists already; --force replaces it.\n")
    assert Path("a.svg").read_bytes() == before
    assert run(*again, "--force")[0] == 0
    assert Path("a.svg").read_bytes() != before
    status, output, errors = run("export", "square.csv", "link.svg", "--force")
    assert (status, output) == (2, "")
    assert "IN and OUT are the same file" in errors
    assert Path("square.csv").read_text() == SQUARE


def test_curves_that_are_left_out_are_told(folder, run):
    document = letter_f()
    dot = document.curves[0].without(range(1, 10))
    store.save(document.with_curve_added(dot), "dot.ninepoint")
    status, _, errors = run("export", "dot.ninepoint", "a.svg")
    assert status == 0
    assert errors == "ninepoint: 1 of the curves had no extent and are left out.\n"


BAD_FILES = {
    "missing.csv": (None, "missing.csv: there is no such file."),
    "empty.csv": (b"", "empty.csv: the file is empty."),
    "empty.ninepoint": (b"", "empty.ninepoint: the file is empty."),
    "nan.csv": (b"1,2\nnan,3\n", "nan.csv, line 2: x is nan, not a finite number."),
    "huge.txt": (b"1 2\n1e300 3\n", "huge.txt, line 2: x is 1e+300; at most 1e+09 mm are"),
    "text.tsv": (b"1\t2\n3\tfour\n", "text.tsv, line 2: y is not a number: 'four'."),
    "one.dat": (b"1\n2\n", "one.dat, line 1: there is only one column; x and y are needed."),
    "long.csv": (b"1,2\n" * 2_000_001, "long.csv: it has more than 2,000,000 lines"),
    "foreign.ninepoint": (b"{}", "foreign.ninepoint: it is not a Ninepoint drawing."),
    "binary.ninepoint": (b"\x89PNG\r\n\0", "binary.ninepoint, line 1: it is damaged"),
    "cut.ninepoint": (b'{\n "curves": [', "cut.ninepoint, line 2: the file is cut off here."),
    "new.ninepoint": (
        b'{"format": "ninepoint", "version": 9}',
        "new.ninepoint: it was written by a newer Ninepoint (format 9)",
    ),
    "drawing.odg": (b"PK", "drawing.odg: files that end in '.odg' cannot be opened"),
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_a_bad_file_is_one_sentence_and_status_2(folder, run, window, name):
    contents, sentence = BAD_FILES[name]
    if contents is not None:
        Path(name).write_bytes(contents)
    Path("old.svg").write_text("old")
    for args in (("export", name, "old.svg", "--force"), (name,), (name, "--screenshot", "a.png")):
        status, output, errors = run(*args)
        assert (status, output) == (2, "")
        assert errors.startswith(f"ninepoint: {sentence}")
        assert errors.count("\n") == 1
    assert Path("old.svg").read_text() == "old"
    assert window == []


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--alpha", "much"], "--alpha must be a number such as 0.25 or 1/4, not 'much'."),
        (["--beta", "1/0"], "--beta divides by zero"),
        (["--gamma", "101"], "--gamma must lie between -100 and 100, not 101."),
        (["--gamma", "-1e9"], "--gamma must lie between -100 and 100, not -1e9."),
        (["--alpha", "nan"], "--alpha must be a number"),
        (["--beta", ""], "--beta must be a number"),
        (["--tolerance", "fine"], "--tolerance must be a number"),
        (["--tolerance", "0"], "The tolerance must lie between"),
        (["--tolerance", "-1"], "The tolerance must lie between"),
        (["--neighbours", "sideways"], "Invalid value for '--neighbours'"),
        (["--alpha"], "Option '--alpha' requires an argument."),
        (["--delta", "1"], "No such option"),
        (["more"], "More than two files need a folder to go to: --out FOLDER."),
        (["--alpha", "100", "--gamma", "100"], "No deviation can be proven"),
    ],
)
def test_a_bad_option_is_named_with_status_2(folder, run, options, sentence):
    status, output, errors = run("export", "square.csv", "a.svg", *options)
    assert (status, output) == (2, "")
    assert errors.startswith(f"ninepoint: {sentence}")
    assert not Path("a.svg").exists()


@pytest.mark.parametrize(
    ("target", "sentence"),
    [
        ("a.gif", "a.gif: files that end in '.gif' cannot be exported; the endings .svg, .dxf, "),
        ("a", "a: files without an ending cannot be exported"),
        ("missing/a.svg", "a.svg: its folder does not exist."),
        ("square.csv/a.svg", "a.svg: a part of its path is a file, not a folder."),
        ("folder.svg", "folder.svg: it exists already; --force replaces it."),
        ("folder", "folder is a folder; to write into it, say --out folder."),
        ("x" * 300 + ".svg", "x" * 300 + ".svg: "),
    ],
)
def test_a_bad_target_is_one_sentence_and_status_2(folder, run, target, sentence):
    Path("folder.svg").mkdir()
    Path("folder").mkdir()
    status, output, errors = run("export", "square.csv", target)
    assert (status, output) == (2, "")
    assert errors.startswith(f"ninepoint: {sentence}")


def test_without_a_command_the_window_opens(folder, run, window):
    run()
    run("letter.ninepoint")
    run("--theme", "dark", "letter.ninepoint", "--size", "900x600")
    run("--", "square.csv")
    assert window == [
        (None, None, None, "system"),
        (Path("letter.ninepoint"), None, None, "system"),
        (Path("letter.ninepoint"), None, (900, 600), "dark"),
        (Path("square.csv"), None, None, "system"),
    ]


def test_the_status_of_the_window_is_that_of_the_program(run, window, monkeypatch):
    monkeypatch.setattr(sys.modules["app.launch"], "run", lambda *args: 3)
    assert run()[0] == 3


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["exprot", "a.csv", "b.svg"], "There is no file and no command 'exprot'."),
        (["letter.ninepoint", "square.csv"], "Only one FILE can be opened."),
        (["--size", "3x3"], "Invalid value for '--size'"),
        (["--size", "1280"], "Invalid value for '--size'"),
        (["--theme", "pink"], "Invalid value for '--theme'"),
        (["--screenshot", "a.jpg"], "The picture is a PNG file; a.jpg must end in .png."),
        (["--colour"], "No such option"),
        (["export"], "Missing argument 'IN'."),
        (["export", "square.csv"], "Missing argument 'OUT'."),
    ],
)
def test_a_call_that_makes_no_sense_is_one_sentence_with_a_way_on(
    folder, run, window, args, sentence
):
    status, output, errors = run(*args)
    assert (status, output, window) == (2, "", [])
    assert errors.startswith(f"ninepoint: {sentence}")
    assert "--help" in errors


@pytest.mark.parametrize(
    ("fault", "status", "sentence"),
    [
        (KeyboardInterrupt(), 130, "stopped."),
        (MemoryError(), 2, "there is not enough memory for this."),
        (PermissionError(13, "Permission denied", "secret"), 2, "secret: Permission denied."),
        (KeyError("lost"), 1, "this is a fault of the program, please report it: KeyError"),
    ],
)
def test_no_fault_shows_a_traceback(run, window, monkeypatch, fault, status, sentence):
    def fail(*args):
        raise fault

    monkeypatch.setattr(sys.modules["app.launch"], "run", fail)
    code, output, errors = run()
    assert (code, output) == (status, "")
    assert errors.splitlines()[-1].startswith(f"ninepoint: {sentence}")


def test_missing_libraries_of_qt_are_left_to_the_entry_point(window, monkeypatch):
    def fail(*args):
        raise ImportError("libEGL.so.1")

    monkeypatch.setattr(sys.modules["app.launch"], "run", fail)
    with pytest.raises(ImportError, match="libEGL"):
        cli.main([])


def test_help_shows_every_option_and_examples(run):
    status, output, _ = run("--help")
    assert status == 0
    for word in ("FILE", "--screenshot", "--size", "--theme", "--version", "export", "Examples:"):
        assert word in output
    assert run("--size", "900x600", "--help")[1] == output
    status, output, _ = run("export", "--help")
    assert status == 0
    for word in ("IN OUT", "--tolerance", "--alpha", "--gamma", "--closed", "whole or not at all"):
        assert word in output


def test_version_is_printed(run):
    status, output, _ = run("--version")
    assert status == 0
    assert output.startswith("ninepoint ")


def program(*args, **variables):
    """Run the program in a process of its own, without a screen."""
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    environment = {key: value for key, value in os.environ.items() if key not in hidden}
    return subprocess.run(
        [sys.executable, *args],
        env=environment | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"} | variables,
        capture_output=True,
        check=False,
    )


def test_an_export_imports_nothing_of_the_screen(folder):
    script = (
        "import sys\n"
        "from app.cli import main\n"
        "try:\n"
        "    main(['export', 'letter.ninepoint', 'a.dxf'])\n"
        "finally:\n"
        "    loaded = {name.partition('.')[0] for name in sys.modules}\n"
        "    assert not loaded & {'PySide6', 'shiboken6', 'pyqtgraph'}, loaded\n"
    )
    done = program("-c", script)
    assert (done.returncode, done.stderr) == (0, b"")
    assert Path("a.dxf").stat().st_size > 0


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8", "utf-8:strict"])
def test_names_that_the_output_cannot_encode_are_still_told(folder, encoding):
    name = os.fsdecode("翼".encode() + b"\xff.svg")
    done = program("-m", "app", "export", "square.csv", name, PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b".svg: 24.27 x 16.18 mm, closed, 4 cubics, " in done.stdout
    assert Path(name).exists()


def test_output_without_room_is_a_sentence(folder):
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "app", "export", "square.csv", "a.svg"],
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == b"ninepoint: output: No space left on device.\n"


def test_a_screenshot_needs_no_screen(folder):
    done = program("-m", "app", "letter.ninepoint", "--screenshot", "a.png", "--size", "900x600")
    assert done.returncode == 0, done.stderr
    header = Path("a.png").read_bytes()[:24]
    assert header.startswith(b"\x89PNG")
    assert (int.from_bytes(header[16:20]), int.from_bytes(header[20:24])) == (900, 600)


def test_a_window_without_a_screen_is_refused_in_a_sentence(folder):
    done = program("-m", "app", "letter.ninepoint")
    assert done.returncode != 0
    assert b"no screen" in done.stderr
    assert b"Traceback" not in done.stderr


def test_a_drawing_of_another_program_is_left_to_the_window(folder, run, window):
    Path("damaged.svg").write_text("<svg")
    assert run("damaged.svg")[0] == 0
    assert len(window) == 1
    status, _, errors = run("missing.dxf")
    assert status == 2
    assert errors == "ninepoint: missing.dxf: there is no such file.\n"
    assert len(window) == 1
