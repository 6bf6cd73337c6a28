"""Set up the checkout's own environment and go on in it: `python3 app` and `python3 tests`.

Only the standard library, and nothing that an old Python 3 cannot parse, because this runs before
anything is installed and has to say so when a Python is too old. Modules that a start with nothing
to do can spare are imported where they are used. Whatever goes wrong is told in a sentence.
"""

import os
import sys

OLDEST_PYTHON = (3, 11)  # requires-python of pyproject.toml; a test compares the two
ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))

# What Qt loads from a Linux system besides its own wheel, and Debian's package for each.
QT_LIBRARIES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libfontconfig.so.1": "libfontconfig1",
    "libglib-2.0.so.0": "libglib2.0-0",  # provided by libglib2.0-0t64 in releases since 2024
    "libxkbcommon.so.0": "libxkbcommon0",
}
XCB = "cursor0 icccm4 image0 keysyms1 randr0 render-util0 shape0 sync1 util1 xfixes0 xkb1"
X11_LIBRARIES = {  # besides, for a window on an X11 screen
    "libX11-xcb.so.1": "libx11-xcb1",
    "libxcb.so.1": "libxcb1",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
}
X11_LIBRARIES.update({f"libxcb-{x[:-1]}.so.{x[-1]}": f"libxcb-{x}" for x in XCB.split()})

ADVICE = (
    "Add --screenshot FILE.png to draw the window into a picture instead, "
    "or set QT_QPA_PLATFORM=offscreen to run without a screen."
)


def enter(script: str, extra: str = "") -> None:
    """Go on in the checkout's environment, set up first if it is missing or out of date.

    Returns only when this process already runs there. Otherwise the same command starts anew
    inside, and its exit status is the one that the user gets.

    Parameters
    ----------
    script
        The folder of the checkout that was started: "app" or "tests".
    extra
        The extra of pyproject.toml that is needed besides the program's own dependencies.
    """
    refuse_old_python(sys.version_info[:3])
    environment = Environment(ROOT)
    try:
        if not environment.is_ready(extra):
            environment.set_up(extra)
        elif os.path.realpath(sys.prefix) == environment.folder:
            return
        go_on([environment.python, os.path.join(ROOT, script), *sys.argv[1:]])
    except KeyboardInterrupt:
        say("Stopped. A set-up that was under way begins again at the next start.")
        sys.exit(130)
    except OSError as error:
        sys.exit(
            f"Ninepoint cannot be set up in the folder {ROOT}: {error}\n"
            "The checkout has to be in a folder that you can write to."
        )


def refuse_old_python(version: "tuple[int, ...]") -> None:
    """End with a sentence if this Python is too old for Ninepoint."""
    if version < OLDEST_PYTHON:
        oldest, this = (".".join(map(str, numbers)) for numbers in (OLDEST_PYTHON, version))
        sys.exit(f"Ninepoint needs Python {oldest} or newer; {sys.executable} is Python {this}.")


def go_on(command: "list[str]") -> None:
    """Become the command; where no process can do that, run it and end with its exit status."""
    if sys.platform == "win32":  # execv would hand the console back before the command has ended
        import subprocess

        sys.exit(subprocess.call(command))
    os.execv(command[0], command)


class Environment:
    """The folder .venv of a checkout; its stamp, written last, says what it was finished for."""

    def __init__(self, root: str) -> None:
        self.root = root
        self.project = os.path.join(root, "pyproject.toml")
        self.folder = os.path.realpath(os.path.join(root, ".venv"))
        inside = ("Scripts", "python.exe") if sys.platform == "win32" else ("bin", "python")
        self.python = os.path.join(self.folder, *inside)
        self.stamp = os.path.join(self.folder, "ninepoint-stamp")
        # What no environment outlives: another Python, or a move (its scripts hold their path).
        self.place = "Python {}.{} in {}".format(*sys.version_info[:2], ascii(self.folder))

    def is_ready(self, extra: str) -> bool:
        """Tell whether the environment is finished, whole and up to date."""
        place, installed, project = self.read_stamp()
        wanted = project == read(self.project) and extra in ("", installed)
        return wanted and self.is_usable(place)

    def is_usable(self, place: str) -> bool:
        """Tell whether it can be added to; a system upgrade leaves a link that leads nowhere."""
        parts = (self.python, os.path.join(self.folder, "pyvenv.cfg"))
        return place == self.place and all(map(os.path.exists, parts))

    def read_stamp(self) -> "tuple[str, str, str]":
        """Return the place, the extra and the pyproject.toml of the last finished set-up."""
        try:
            place, extra, project = read(self.stamp).split("\n", 2)
        except (OSError, ValueError):
            return "", "", ""
        return place, extra, project

    def write_stamp(self, extra: str, project: str) -> None:
        """Declare the set-up finished."""
        with open(self.stamp, "w", encoding="utf-8") as stamp:
            stamp.write(f"{self.place}\n{extra}\n{project}")

    def set_up(self, extra: str) -> None:
        """Make the environment, or bring it up to date, while no other start does the same."""
        os.makedirs(self.folder, exist_ok=True)
        with open(os.path.join(self.folder, "lock"), "a") as lock:
            wait_for(lock.fileno())
            if self.is_ready(extra):  # another start has done it meanwhile
                return
            if extra or not can_make_environments():
                require_packages(missing_packages(setting_up=True))  # all of them in one go
            place, old_extra, old_project = self.read_stamp()
            usable, project = self.is_usable(place), read(self.project)
            if place:
                os.remove(self.stamp)  # killed from here on, the next start begins from nothing
            if usable:
                say(f"Bringing {self.folder} up to date ...")
            else:
                say(f"Setting up Ninepoint in {self.folder} (once, about a minute) ...")
            failure = "" if usable else self.make()
            extra = extra or (old_extra if usable else "")
            failure = failure or self.install(extra)
            if not failure:
                self.write_stamp(extra, project)
            elif usable:  # pip gives up before it changes anything, so the old state still stands
                self.write_stamp(old_extra, old_project)
        if failure:
            sys.exit(f"Ninepoint's set-up failed; it needs a network connection.\n\n{failure}")

    def make(self) -> str:
        """Make a new environment in place of whatever is there; return what went wrong."""
        import shutil

        for entry in list(os.scandir(self.folder)):
            if entry.is_dir(follow_symlinks=False):
                shutil.rmtree(entry.path)
            elif entry.name != "lock":
                os.remove(entry.path)
        base = getattr(sys, "_base_executable", sys.executable)  # ours may just have been removed
        return run([base, "-m", "venv", self.folder], self.root)

    def install(self, extra: str) -> str:
        """Install the checkout as it stands, with what it needs; return what went wrong."""
        pip = [self.python, "-m", "pip", "--disable-pip-version-check", "--no-input", "install"]
        what = f".[{extra}]" if extra else "."
        return run([*pip, "--editable", what], self.root, PIP_USER="0")  # "1" fails in any venv


def read(path: str) -> str:
    """Return the text of a file."""
    with open(path, encoding="utf-8") as file:
        return file.read()


def wait_for(lock: int) -> None:
    """Wait until no other start holds the lock; the system frees it when its holder dies."""
    import time

    os.set_inheritable(lock, True)  # a pip that outlives its parent is a holder, too
    if take(lock):
        return
    say("Another start is setting up Ninepoint; waiting for it ...")
    while not take(lock):
        time.sleep(0.2)


def take(lock: int) -> bool:
    """Take the lock if it is free; on a file system without locks it always is."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(lock, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return not isinstance(error, (BlockingIOError, PermissionError))
    return True


def run(command: "list[str]", folder: str, **variables: str) -> str:
    """Run a step quietly in a folder; return nothing, or the last words of a step that failed."""
    import re
    import shlex
    import subprocess

    done = subprocess.run(
        command,
        cwd=folder,
        env=dict(os.environ, **variables),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        close_fds=False,  # hands on the lock
    )
    if done.returncode == 0:
        return ""
    lines = [line.strip() for line in done.stdout.decode("utf-8", "replace").splitlines()]
    telling = [line for line in lines if re.match(r"(E|WARNING|\w*error):", line, re.IGNORECASE)]
    words = "".join(f"    {line[:300]}\n" for line in (telling or [*filter(None, lines)])[-3:])
    return f"{words}\nThe step that failed: {shlex.join(command)}"


def can_make_environments() -> bool:
    """Tell whether this Python is whole; that of Debian comes in parts."""
    from importlib.util import find_spec

    return bool(find_spec("venv") and find_spec("ensurepip"))


def missing_packages(setting_up: bool = False) -> "list[str]":
    """Return Debian's packages of what this Linux system lacks for Qt, and for the set-up."""
    if not sys.platform.startswith("linux"):
        return []
    import ctypes

    missing = []
    if setting_up and not can_make_environments():
        missing.append("python{}.{}-venv".format(*sys.version_info[:2]))
    for name, package in dict(QT_LIBRARIES, **(X11_LIBRARIES if screen() == "X11" else {})).items():
        try:
            ctypes.CDLL(name)
        except OSError:
            missing.append(package)
    return missing


def require_packages(packages: "list[str]") -> None:
    """Install Debian packages if this is root; else end with the command that does."""
    import shutil

    names = " ".join(packages)
    if not packages:
        return
    if shutil.which("apt-get") is None:
        sys.exit(
            f"Ninepoint needs libraries that Debian has in the packages {names}. "
            "Install what this system calls them, and start again."
        )
    if os.geteuid() != 0:
        sys.exit(
            "Ninepoint needs packages of the system that are not installed. Install them with\n\n"
            f"    sudo apt-get install {names}\n\nand start again."
        )
    say(f"Installing with apt-get: {names}")
    run(["apt-get", "update"], "/")  # if it fails, the lists may be good enough all the same
    patiently = ["-o", "DPkg::Lock::Timeout=300", "--yes", "--no-install-recommends"]
    install = ["apt-get", "install", *patiently, *packages]
    failure = run(install, "/", DEBIAN_FRONTEND="noninteractive")
    if failure:
        sys.exit(f"Ninepoint could not install packages that it needs.\n\n{failure}")


def require_display() -> None:
    """End with a sentence where Qt would abort: if there is no screen to open a window on.

    To be called before Qt is imported, and only when a window is to be seen.
    """
    shown, display = screen(), os.environ.get("DISPLAY")
    if not shown:
        sys.exit(
            "Ninepoint finds no screen to open a window on: neither DISPLAY nor WAYLAND_DISPLAY "
            f"names one.\n{ADVICE}"
        )
    if shown == "X11":
        require_packages(missing_packages())
        if not x11_answers():
            sys.exit(
                f"Ninepoint cannot open a window on the screen {display}, which DISPLAY names: "
                f"nothing answers there, or it does not let this user in.\n{ADVICE}"
            )


def screen() -> str:
    """Name what a window would be shown on: "X11", "other", or "" for nothing at all."""
    chosen = os.environ.get("QT_QPA_PLATFORM", "")
    if chosen not in ("", "xcb") or not sys.platform.startswith("linux"):
        return "other"
    if not chosen and wayland_answers():
        return "other"
    return "X11" if os.environ.get("DISPLAY") else ""


def wayland_answers() -> bool:
    """Tell whether a Wayland compositor can be reached."""
    import socket

    folder, name = (os.environ.get(key, "") for key in ("XDG_RUNTIME_DIR", "WAYLAND_DISPLAY"))
    with socket.socket(socket.AF_UNIX) as compositor:
        return name != "" and compositor.connect_ex(os.path.join(folder, name)) == 0


def x11_answers() -> bool:
    """Tell whether the X server that DISPLAY names can be reached and lets this user in."""
    import ctypes

    xcb = ctypes.CDLL("libxcb.so.1")
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(None, None))
    refused = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return not refused


def say(sentence: str) -> None:
    """Tell the user what is being done."""
    sys.stderr.write(f"{sentence}\n")
    sys.stderr.flush()
