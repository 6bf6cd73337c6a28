"""Many files in several processes: all of them done, in order, and stopped together."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from app.commands import batch
from app.commands.batch import Job, Outcome, outcomes, suitable
from app.commands.reading import Reading
from core import store
from core.document import Document
from core.profiles import named
from drawings import letter_f

ROOT = Path(__file__).resolve().parent.parent
WAIT_S = 30


@pytest.fixture
def job(tmp_path):
    """A job for a name."""
    store.save(Document(letter_f().curves[:1]), tmp_path / "a.ninepoint")

    def job(name, source="a.ninepoint"):
        return Job(tmp_path / source, tmp_path / name, Reading(), named("svg"), replace=False)

    return job


def test_two_processes_do_what_one_does_in_the_same_order(job, tmp_path):
    jobs = [job("0.svg"), job("1.svg", "gone.csv"), job("2.svg"), job("3.svg")]
    found = list(outcomes(jobs, 2))
    assert [bool(outcome.error) for outcome in found] == [False, True, False, False]
    assert found[1].error == "gone.csv: there is no such file."
    written = [tmp_path / f"{k}.svg" for k in (0, 2, 3)]
    alone = job("alone.svg")
    assert list(outcomes([alone], 1)) == [found[0]]
    body = [path.read_bytes().split(b"</title>", 1)[1] for path in [*written, alone.target]]
    assert len(set(body)) == 1
    assert not list(tmp_path.glob(".ninepoint-*"))


@pytest.mark.parametrize(
    ("fault", "sentence"),
    [
        (MemoryError(), "a.ninepoint: there is not enough memory for this."),
        (PermissionError(13, "Permission denied", "secret"), "secret: Permission denied."),
        (ImportError("libEGL.so.1"), "a.ninepoint: a library is missing (libEGL.so.1)"),
        (KeyError("lost"), "a.ninepoint: this is a fault of the program, please report it: KeyE"),
    ],
)
def test_no_fault_ends_the_others(job, monkeypatch, fault, sentence):
    def fail(job):
        raise fault

    monkeypatch.setattr(batch, "written", fail)
    (found,) = outcomes([job("a.svg")], 1)
    assert found.error.startswith(sentence)


def die(job):
    """Stands for a job whose process the system ends, as for want of memory."""
    if "bad" in job.target.name:
        os.kill(os.getpid(), signal.SIGKILL)
    return Outcome(job.target.name)


def test_a_process_that_is_ended_costs_its_own_file_only(job, monkeypatch):
    monkeypatch.setattr(batch, "_worked", die)
    names = ["0.svg", "bad.svg", "2.svg", "3.svg", "bad too.svg"]
    found = list(outcomes([job(name) for name in names], 2))
    assert [outcome.summary for outcome in found] == ["0.svg", "", "2.svg", "3.svg", ""]
    for outcome in (found[1], found[4]):
        assert outcome.error == (
            "a.ninepoint: its process was ended from outside, perhaps for want of memory."
        )


def test_processes_are_as_many_as_are_worth_it(monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 4)
    assert [suitable(files) for files in (0, 1, 15, 16, 100)] == [1, 1, 1, 2, 4]
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert suitable(100) == 1


@pytest.fixture
def running(tmp_path):
    """An export of many files that has written the first of them."""
    for k in range(400):
        (tmp_path / f"{k:03}.csv").write_text("0,0\n30,0\n30,20\n0,20\n0,0\n")
    (tmp_path / "out").mkdir()
    words = ["*.csv", "--profile", "laser", "--tolerance", "1e-5", "--out", "out", "--jobs", "2"]
    process = subprocess.Popen(
        [sys.executable, "-m", "app", "export", *words],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        text=True,
    )
    process.stdout.readline()
    yield process
    process.kill()
    process.wait()


def test_ctrl_c_stops_all_and_leaves_nothing_half_written(running, tmp_path):
    os.killpg(running.pid, signal.SIGINT)  # as a terminal does: all processes get it
    # This reads until all processes have ended, as all of them hold the streams.
    output, errors = running.communicate(timeout=WAIT_S)
    assert running.returncode == 130
    assert errors.strip() == "ninepoint: stopped."
    assert "400 files" not in output
    written = list((tmp_path / "out").iterdir())
    assert 0 < len(written) < 400
    assert all(path.read_bytes().endswith(b"  0\nEOF\n") for path in written)


def test_no_process_is_left_behind_by_one_that_is_killed(running, tmp_path):
    running.kill()
    running.communicate(timeout=WAIT_S)
    written = list((tmp_path / "out").iterdir())
    assert 0 < len(written) < 400
    assert all(path.read_bytes().endswith(b"  0\nEOF\n") for path in written)
