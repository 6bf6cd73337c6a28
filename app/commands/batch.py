"""Many files at once: a process for each core, one bad file stops no other, Ctrl+C stops all.

Processes are started afresh ("spawn"), the same way on every system. They do not hear Ctrl+C, which
the terminal sends to all: the first process does, and ends the others; they leave what they write
as it was. They end too when the first process is gone.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NoReturn

from app.commands.choices import make_writable
from app.commands.reading import Reading
from core.errors import FileError, NinepointError
from core.profiles import Profile

FILES_A_PROCESS: Final = 8
"""Files from which on another process is worth its start of some 0.3 s."""

_busy = False
"""Whether this process, one of several, is about to write."""


@dataclass(frozen=True)
class Job:
    """One file to be written.

    Attributes
    ----------
    source, target
        The files.
    reading, profile
        How the source is read, and what is made of it.
    replace
        Whether an existing target may be replaced.
    """

    source: Path
    target: Path
    reading: Reading
    profile: Profile
    replace: bool


@dataclass(frozen=True)
class Outcome:
    """What became of a job.

    Attributes
    ----------
    summary
        What was written, in a line; "" if nothing was.
    notes
        Sentences on what is not as one might expect.
    error
        Why nothing was written, or "".
    """

    summary: str = ""
    notes: tuple[str, ...] = ()
    error: str = ""


def written(job: Job) -> Outcome:
    """Do a job.

    Raises
    ------
    NinepointError
        If the source cannot be read, or the target not be written.
    """
    from core import formats

    if not job.replace and os.path.lexists(job.target):
        raise FileError(job.target, "it exists already; --force replaces it.")
    document, notes = job.reading.document(job.source)
    make_writable(job.profile.format)
    report = formats.export(document, job.target, job.profile)
    left_out = len(document.curves) - report.contours
    if left_out > 0 and not job.profile.kerf_mm:
        notes += (f"{left_out} of the curves had no extent and are left out.",)
    return Outcome(report.summary, (*report.notes, *notes))


def outcome(job: Job) -> Outcome:
    """Do a job, whatever happens."""
    try:
        return written(job)
    except NinepointError as error:
        return Outcome(error=told(job.source, error))
    except MemoryError:
        return Outcome(error=f"{job.source.name}: there is not enough memory for this.")
    except ImportError as error:
        return Outcome(
            error=f"{job.source.name}: a library is missing ({error}); export one file by itself"
            " to have it installed."
        )
    except OSError as error:
        return Outcome(error=f"{error.filename or job.source.name}: {error.strerror}.")
    except Exception as error:  # one bad file stops no other
        return Outcome(
            error=f"{job.source.name}: this is a fault of the program, please report it:"
            f" {type(error).__name__}: {error}"
        )


def told(source: Path, error: NinepointError) -> str:
    """Sentence of an error that names a file."""
    return str(error) if isinstance(error, FileError) else f"{source.name}: {error}"


def outcomes(jobs: Sequence[Job], processes: int) -> Iterator[Outcome]:
    """Do jobs, in as many processes; what becomes of them comes in their order.

    A process that is ended from outside, as for want of memory, takes others with it; the jobs
    that are left are then done in one process, so that only the one that ends it is lost.
    """
    if processes == 1:
        yield from map(outcome, jobs)
        return
    done: dict[int, Outcome] = {}
    first = 0
    while first < len(jobs):
        waiting = [index for index in range(first, len(jobs)) if index not in done]
        with _pool(min(processes, len(waiting)) or 1) as pool:
            futures = dict(
                zip(waiting, [pool.submit(_worked, jobs[index]) for index in waiting], strict=True)
            )
            # The processes have it from us that they do not hear Ctrl+C.
            signal.signal(signal.SIGINT, signal.default_int_handler)
            try:
                while first < len(jobs):
                    if first not in done:
                        done[first] = futures[first].result()
                    yield done.pop(first)
                    first += 1
            except BrokenProcessPool:
                for index, future in futures.items():
                    if index > first and future.done() and future.exception() is None:
                        done[index] = future.result()
                if processes == 1:
                    done[first] = Outcome(
                        error=f"{jobs[first].source.name}: its process was ended from outside,"
                        " perhaps for want of memory."
                    )
                processes = 1


def suitable(files: int) -> int:
    """Number of processes for some files, if nothing else is asked for."""
    return max(min(os.cpu_count() or 1, files // FILES_A_PROCESS), 1)


@contextmanager
def _pool(processes: int) -> Iterator[ProcessPoolExecutor]:
    """Processes that are all gone afterwards."""
    others = set(multiprocessing.active_children())
    hearing = signal.signal(signal.SIGINT, signal.SIG_IGN)
    pool = ProcessPoolExecutor(
        processes, mp_context=multiprocessing.get_context("spawn"), initializer=_prepare
    )
    is_whole = False
    try:
        yield pool
        is_whole = True
    finally:
        if not is_whole:
            for process in set(multiprocessing.active_children()) - others:
                process.terminate()
        pool.shutdown(cancel_futures=True)
        signal.signal(signal.SIGINT, hearing)


def _prepare() -> None:
    """Make a process one that the first process alone stops, and that ends with it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _stop)
    threading.Thread(target=_end_with_first, daemon=True).start()


def _end_with_first() -> None:
    first = multiprocessing.parent_process()
    if first is not None:
        first.join()
        os.kill(os.getpid(), signal.SIGTERM)


def _stop(*_: object) -> NoReturn:
    if _busy:
        sys.exit()  # through all that cleans up behind itself
    os._exit(0)


def _worked(job: Job) -> Outcome:
    """Do a job in a process of several."""
    global _busy
    _busy = True
    try:
        return outcome(job)
    except SystemExit:
        os._exit(0)
    finally:
        _busy = False
