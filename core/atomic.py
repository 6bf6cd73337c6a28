"""Files read whole or refused, written whole or not at all (the border to the disk).

A file is replaced by writing a temporary one beside it, reading that back, and renaming it over
the old one: whatever fails, whenever the process is killed, the name leads to the old bytes or
to the new ones. Temporaries that a killed process left behind are removed by the next write into
the same folder.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from core.errors import FileError

try:
    import fcntl
except ImportError:  # Windows, where a file that somebody has open cannot be deleted anyway
    fcntl = None  # type: ignore[assignment]

MAX_BYTES: Final = 100_000_000
"""Largest file that is read: a million points with all their digits take 60 MB."""

_PREFIX: Final = ".ninepoint-"
_SUFFIX: Final = ".tmp"

_REASONS: Final = {
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "your share of the disk is used up",
    errno.EFBIG: "it is larger than the disk admits",
    errno.EACCES: "you have no permission to {verb} it there",
    errno.EPERM: "you have no permission to {verb} it there",
    errno.EROFS: "the disk is read-only",
    errno.EIO: "the disk reports a fault",
    errno.ENAMETOOLONG: "its name is too long",
    errno.EISDIR: "it is a folder, not a file",
    errno.ENOTDIR: "a part of its path is a file, not a folder",
    errno.ELOOP: "its links lead round in a circle",
    errno.EMFILE: "too many files are open",
    errno.ENFILE: "too many files are open",
}


def read(path: str | Path, limit: int = MAX_BYTES) -> bytes:
    """Contents of a regular file.

    Parameters
    ----------
    path
        The file.
    limit
        Largest size in bytes; a larger file is refused before any of it is read.

    Raises
    ------
    FileError
        If there is no such file, it is no regular file (a folder, a pipe, a device), it is too
        large, or the system refuses to read it.
    """
    path = Path(path)
    try:
        status = path.stat()
        if stat.S_ISDIR(status.st_mode):
            raise FileError(path, "it is a folder, not a file.")
        if not stat.S_ISREG(status.st_mode):
            raise FileError(path, "it is not a regular file.")
        if status.st_size > limit:
            raise FileError(
                path,
                f"it has {status.st_size / 1e6:,.0f} MB; at most {limit / 1e6:,.0f} MB are read.",
            )
        with path.open("rb") as file:
            # One byte more than admitted shows a file that grew meanwhile.
            data = file.read(limit + 1)
    except OSError as error:
        raise FileError(path, _sentence(error, "read")) from error
    if len(data) > limit:
        raise FileError(path, f"it has more than {limit / 1e6:,.0f} MB.")
    return data


def write(path: str | Path, data: bytes) -> None:
    """Make ``data`` the contents of a file, or leave everything as it was.

    Links are followed, and the mode of an existing file is kept. The data are read back before
    they take the old file's place.

    Raises
    ------
    FileError
        If the file cannot be written. The old file, if there is one, has not been touched.

    Notes
    -----
    The folder is synchronised after the renaming, so that it survives a power cut. Where the
    system cannot do that, the name may lead to the old file again after such a cut, whole.
    """
    path = Path(path)
    try:
        _replace(path, _followed(path), data)
    except OSError as error:
        raise FileError(path, _sentence(error, "write")) from error


def _followed(path: Path) -> Path:
    """File that a name leads to, whether it exists or not."""
    try:
        return path.resolve()
    except RuntimeError as error:  # what Python below 3.13 says of a circle of links
        raise OSError(errno.ELOOP, str(error)) from error


def _replace(path: Path, target: Path, data: bytes) -> None:
    folder = target.parent
    mode = _mode_of(path, target)
    _remove_strays(folder)
    temporary, file = _new_temporary(folder)
    try:
        with _still_locked(file):
            try:
                if mode is not None:
                    temporary.chmod(mode)
                _write_all(file, data)
                os.fsync(file)
            finally:
                os.close(file)
            with temporary.open("rb") as written:
                if written.read(len(data) + 1) != data:
                    raise OSError(errno.EIO, "read back differently")
            temporary.replace(target)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink()
        raise
    _synchronise(folder)


def _mode_of(path: Path, target: Path) -> int | None:
    """Mode of the file to be replaced, None if there is none yet.

    Renaming over a file needs no permission on that file, so its own write protection is
    respected here; and what is not a file (/dev/null, a pipe) must not be replaced by one.
    """
    try:
        status = target.stat()
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(status.st_mode):
        raise FileError(path, "it is a folder, not a file.")
    if not stat.S_ISREG(status.st_mode):
        raise FileError(path, "it is not a regular file; choose another name.")
    if not os.access(target, os.W_OK):
        raise FileError(path, "it is write-protected; choose another name.")
    return stat.S_IMODE(status.st_mode)


def _new_temporary(folder: Path) -> tuple[Path, int]:
    """Create a temporary file with a lock that ends with this process; its path and descriptor.

    Its mode is that of any new file (0o666 less the umask).
    """
    flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_BINARY", 0)
    while True:
        temporary = folder / (_PREFIX + os.urandom(8).hex() + _SUFFIX)
        file = os.open(temporary, flags, 0o666)
        # Another process may take it for a stray until it is locked.
        if _locked(file) and temporary.exists():
            return temporary, file
        os.close(file)
        with contextlib.suppress(OSError):
            temporary.unlink()


def _locked(file: int) -> bool:
    """Try to lock a file; False if another process holds the lock.

    True also where the disk knows no locks: then nobody removes strays there (`_remove_stray`).
    """
    if fcntl is None:
        return True
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


@contextlib.contextmanager
def _still_locked(file: int) -> Iterator[None]:
    """Keep the lock of a file beyond its being closed.

    Closing tells of faults, so it comes before the renaming; but from then on until the renaming,
    another process would take the file for a stray. Where there are no locks nothing can be held:
    a file that is open cannot be renamed there.
    """
    if fcntl is None:
        yield
        return
    try:
        held = os.dup(file)
    except OSError:
        os.close(file)
        raise
    try:
        yield
    finally:
        with contextlib.suppress(OSError):  # the first one told what there was to tell
            os.close(held)


def _remove_stray(path: Path) -> None:
    """Remove a temporary file if the process that wrote it is gone: its lock is gone then.

    The lock is held until the file is removed. Else a process that has just made it could lock it
    in between, and lose it.

    Raises
    ------
    OSError
        If the file is locked, or cannot be removed.
    """
    if fcntl is None:
        path.unlink()
        return
    file = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        path.unlink()
    finally:
        os.close(file)


def _remove_strays(folder: Path) -> None:
    """Remove temporaries of killed processes; none of it matters for the write itself."""
    with contextlib.suppress(OSError):
        for path in folder.glob(f"{_PREFIX}*{_SUFFIX}"):
            with contextlib.suppress(OSError):
                _remove_stray(path)


def _write_all(file: int, data: bytes) -> None:
    """Write all of the data; a full disk may take a part and report no error for it."""
    rest = memoryview(data)
    while rest:
        count = os.write(file, rest)
        if count <= 0:
            raise OSError(errno.ENOSPC, "nothing written")
        rest = rest[count:]
    if os.fstat(file).st_size != len(data):
        raise OSError(errno.EIO, "written short")


def _synchronise(folder: Path) -> None:
    """Make the renaming durable, where the system can; the file is whole in any case."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | getattr(os, "O_DIRECTORY", 0))
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _sentence(error: OSError, verb: str) -> str:
    """Meaning of a system error for the user."""
    if error.errno == errno.ENOENT:
        # Whoever writes a file makes it, so what is missing can only be the folder.
        return "there is no such file." if verb == "read" else "its folder does not exist."
    known = _REASONS.get(error.errno or 0)
    reason = known or f"the system refuses ({error.strerror or type(error).__name__})"
    return reason.format(verb=verb) + "."
