import errno
import fcntl
import os
import stat
from pathlib import Path

import pytest

from core import atomic
from core.errors import FileError

OLD = b"the old contents\n"
NEW = b"the new contents, somewhat longer\n"


@pytest.fixture
def old_file(tmp_path):
    path = tmp_path / "drawing.ninepoint"
    path.write_bytes(OLD)
    return path


def names(folder):
    return sorted(entry.name for entry in folder.iterdir())


def failing(number, after=0, real=None):
    """A function that raises a system error from its call number ``after`` on."""
    calls = []

    def fail(*args, **kwargs):
        calls.append(args)
        if len(calls) > after:
            raise OSError(number, os.strerror(number))
        return real(*args, **kwargs)

    return fail


def test_a_new_file_holds_the_data_and_has_the_mode_of_any_new_file(tmp_path):
    path, other = tmp_path / "new.svg", tmp_path / "other"
    atomic.write(path, NEW)
    other.touch()
    assert path.read_bytes() == NEW
    assert path.stat().st_mode == other.stat().st_mode
    assert names(tmp_path) == ["new.svg", "other"]


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o755])
def test_the_mode_of_the_old_file_is_kept(old_file, mode):
    old_file.chmod(mode)
    atomic.write(old_file, NEW)
    assert old_file.read_bytes() == NEW
    assert stat.S_IMODE(old_file.stat().st_mode) == mode


def test_links_are_followed_and_stay_links(tmp_path, old_file):
    (tmp_path / "elsewhere").mkdir()
    link = tmp_path / "elsewhere" / "link.ninepoint"
    link.symlink_to("../drawing.ninepoint")
    atomic.write(link, NEW)
    assert link.is_symlink()
    assert old_file.read_bytes() == NEW
    assert names(tmp_path / "elsewhere") == ["link.ninepoint"]


def test_a_link_to_a_file_that_does_not_exist_yet_makes_that_file(tmp_path):
    link = tmp_path / "link.svg"
    link.symlink_to("real.svg")
    atomic.write(link, NEW)
    assert link.is_symlink()
    assert (tmp_path / "real.svg").read_bytes() == NEW


def test_a_circle_of_links_is_refused(tmp_path):
    link = tmp_path / "link.svg"
    link.symlink_to("link.svg")
    with pytest.raises(FileError, match="circle"):
        atomic.write(link, NEW)
    with pytest.raises(FileError, match="circle"):
        atomic.read(link)


@pytest.mark.parametrize("name", ["Flügel 翼.svg", "with space.svg", "x" * 251 + ".svg", "-n.svg"])
def test_any_name_that_the_system_admits_is_written(tmp_path, name):
    if len(name.encode()) <= 255:
        atomic.write(tmp_path / name, NEW)
        assert atomic.read(tmp_path / name) == NEW


def test_a_name_that_is_too_long_is_refused(tmp_path):
    with pytest.raises(FileError, match="its name is too long"):
        atomic.write(tmp_path / ("x" * 300), NEW)


def test_a_missing_folder_is_named_as_the_reason(tmp_path):
    with pytest.raises(FileError, match="its folder does not exist"):
        atomic.write(tmp_path / "missing" / "a.svg", NEW)


def test_a_file_in_the_place_of_a_folder_is_named_as_the_reason(old_file):
    with pytest.raises(FileError, match="a part of its path is a file"):
        atomic.write(old_file / "a.svg", NEW)


def test_a_folder_and_a_pipe_are_neither_read_nor_replaced(tmp_path):
    pipe = tmp_path / "pipe.svg"
    os.mkfifo(pipe)
    for path, reason in ((tmp_path, "it is a folder"), (pipe, "it is not a regular file")):
        with pytest.raises(FileError, match=reason):
            atomic.read(path)
        with pytest.raises(FileError, match=reason):
            atomic.write(path, NEW)
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_write_protected_file_is_not_replaced(old_file, monkeypatch):
    # Renaming over it would succeed; root may write everything, so the answer is given here.
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(FileError, match="write-protected"):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD


FAULTS = {
    "the temporary cannot be made": (os, "open", errno.EACCES, "permission to write"),
    "the disk is read-only": (os, "open", errno.EROFS, "read-only"),
    "too many files": (os, "open", errno.EMFILE, "too many files"),
    "too many files to hold the lock": (os, "dup", errno.EMFILE, "too many files"),
    "the mode cannot be set": (Path, "chmod", errno.EPERM, "permission to write"),
    "the disk is full": (os, "write", errno.ENOSPC, "the disk is full"),
    "the quota is used up": (os, "write", errno.EDQUOT, "your share"),
    "the file is too large": (os, "write", errno.EFBIG, "larger than the disk admits"),
    "writing fails": (os, "write", errno.EIO, "the disk reports a fault"),
    "the size cannot be asked": (os, "fstat", errno.EIO, "the disk reports a fault"),
    "flushing fails": (os, "fsync", errno.EIO, "the disk reports a fault"),
    "flushing finds a full disk": (os, "fsync", errno.ENOSPC, "the disk is full"),
    "closing fails": (os, "close", errno.EIO, "the disk reports a fault"),
    "reading back fails": (Path, "open", errno.EIO, "the disk reports a fault"),
    "renaming is not allowed": (Path, "replace", errno.EACCES, "permission to write"),
    "renaming fails": (Path, "replace", errno.EIO, "the disk reports a fault"),
    "something unheard of": (Path, "replace", errno.EXDEV, "the system refuses"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_at_any_call_leaves_the_old_file_and_no_temporary(old_file, monkeypatch, fault):
    where, call, number, reason = FAULTS[fault]
    with monkeypatch.context() as patched:
        patched.setattr(where, call, failing(number))
        with pytest.raises(FileError, match=reason) as caught:
            atomic.write(old_file, NEW)
    assert "drawing.ninepoint: " in str(caught.value)
    assert old_file.read_bytes() == OLD
    assert names(old_file.parent) == [old_file.name]


def test_a_disk_that_fills_up_half_way_leaves_the_old_file(old_file, monkeypatch):
    real = os.write
    monkeypatch.setattr(
        os, "write", failing(errno.ENOSPC, 1, lambda file, data: real(file, data[:5]))
    )
    with pytest.raises(FileError, match="the disk is full"):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD
    assert names(old_file.parent) == [old_file.name]


def test_a_disk_that_takes_nothing_and_reports_nothing_counts_as_full(old_file, monkeypatch):
    monkeypatch.setattr(os, "write", lambda file, data: 0)
    with pytest.raises(FileError, match="the disk is full"):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD


def test_bytes_taken_but_not_kept_leave_the_old_file(old_file, monkeypatch):
    real = os.write
    monkeypatch.setattr(os, "write", lambda file, data: real(file, data[:-1]) + 1)
    with pytest.raises(FileError, match="the disk reports a fault"):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD
    assert names(old_file.parent) == [old_file.name]


def test_bytes_that_read_back_differently_leave_the_old_file(old_file, monkeypatch):
    real = os.write
    monkeypatch.setattr(os, "write", lambda file, data: real(file, bytes(len(data))))
    with pytest.raises(FileError, match="the disk reports a fault"):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD
    assert names(old_file.parent) == [old_file.name]


def test_short_writes_are_continued(old_file, monkeypatch):
    real = os.write
    monkeypatch.setattr(os, "write", lambda file, data: real(file, data[:1]))
    atomic.write(old_file, NEW)
    assert old_file.read_bytes() == NEW


def test_an_interruption_leaves_the_old_file_and_no_temporary(old_file, monkeypatch):
    def interrupt(file):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        atomic.write(old_file, NEW)
    assert old_file.read_bytes() == OLD
    assert names(old_file.parent) == [old_file.name]


def test_a_folder_that_cannot_be_synchronised_does_not_undo_the_save(old_file, monkeypatch):
    monkeypatch.setattr(os, "fsync", failing(errno.EINVAL, 1, os.fsync))
    atomic.write(old_file, NEW)
    assert old_file.read_bytes() == NEW


def test_temporaries_of_dead_processes_are_removed_and_those_of_living_ones_kept(old_file):
    dead = old_file.with_name(".ninepoint-0123456789abcdef.tmp")
    living = old_file.with_name(".ninepoint-fedcba9876543210.tmp")
    foreign = old_file.with_name(".ninepoint-notes.txt")
    for path in (dead, living, foreign):
        path.write_bytes(b"half")
    with living.open("rb") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        atomic.write(old_file, NEW)
        assert names(old_file.parent) == sorted([living.name, foreign.name, old_file.name])


def test_a_missing_file_is_named_as_the_reason(tmp_path):
    with pytest.raises(FileError, match=r"nothing\.csv: there is no such file\."):
        atomic.read(tmp_path / "nothing.csv")


def test_a_file_without_permission_is_named_as_the_reason(old_file, monkeypatch):
    monkeypatch.setattr(Path, "open", failing(errno.EACCES))
    with pytest.raises(FileError, match="permission to read"):
        atomic.read(old_file)


def test_a_large_file_is_refused_before_it_is_read(tmp_path, monkeypatch):
    path = tmp_path / "large.csv"
    path.touch()
    os.truncate(path, atomic.MAX_BYTES + 1)
    monkeypatch.setattr(Path, "open", failing(errno.EIO))
    with pytest.raises(FileError, match="it has 100 MB; at most 100 MB are read"):
        atomic.read(path)


def test_a_file_that_grows_while_it_is_read_is_refused(old_file, monkeypatch):
    limit = len(OLD)
    assert atomic.read(old_file, limit) == OLD
    real = Path.stat
    status = real(old_file)

    def before_growing(path, **kwargs):
        return status if path == old_file else real(path, **kwargs)

    monkeypatch.setattr(Path, "stat", before_growing)
    old_file.write_bytes(OLD + b"more")
    with pytest.raises(FileError, match="more than"):
        atomic.read(old_file, limit)


def test_a_stray_is_locked_until_it_is_gone(tmp_path, monkeypatch):
    """Else the process that has just made it locks it in between, and loses it."""
    stray = tmp_path / ".ninepoint-0123456789abcdef.tmp"
    stray.write_bytes(OLD)
    locked = []
    real = Path.unlink

    def watched(path, *args, **kwargs):
        if path == stray:
            with stray.open("rb") as file:
                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    locked.append(False)
                except BlockingIOError:
                    locked.append(True)
        return real(path, *args, **kwargs)

    monkeypatch.setattr(Path, "unlink", watched)
    atomic.write(tmp_path / "new.svg", NEW)
    assert locked == [True]
    assert names(tmp_path) == ["new.svg"]


def test_no_neighbour_takes_a_finished_temporary_for_a_stray(old_file, monkeypatch):
    """Several processes write into one folder, and each removes the strays of dead ones."""
    real = Path.replace

    def overtaken(path, target):
        if target.name == old_file.name:
            atomic.write(old_file.parent / "neighbour.svg", OLD)
        return real(path, target)

    monkeypatch.setattr(Path, "replace", overtaken)
    atomic.write(old_file, NEW)
    assert old_file.read_bytes() == NEW
    assert names(old_file.parent) == sorted([old_file.name, "neighbour.svg"])
