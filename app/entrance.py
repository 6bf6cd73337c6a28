"""The way into the window, and out of the program: what each end means, in a sentence.

It needs no command line: a start without words has nothing to parse, and click takes 10 ms.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from io import TextIOWrapper
from typing import TYPE_CHECKING, Final, NoReturn

from core.errors import NinepointError

if TYPE_CHECKING:
    from pathlib import Path

NAME: Final = "ninepoint"
"""What the program is called on the command line."""

USER_ERROR: Final = 2
"""Exit status if the user can mend it: a file, an option, a full disk."""

OUR_ERROR: Final = 1
"""Exit status if the program is at fault."""

INTERRUPTED: Final = 130
"""Exit status after Ctrl+C, as of shells."""


def main() -> NoReturn:
    """Open the window on a ready shape, and end the process.

    Raises
    ------
    SystemExit
        Always; see `status_of`.
    ImportError
        If Qt lacks libraries of the system; `app.__main__` installs them or says which.
    """
    speak_plainly()
    sys.exit(status_of(open_window, tell_words))


def open_window(
    path: Path | None = None,
    screenshot: Path | None = None,
    size: tuple[int, int] | None = None,
    theme: str = "system",
) -> int:
    """Make sure of a screen, load Qt, and do what `app.launch.run` does."""
    if screenshot is None:
        from app.bootstrap import require_display

        require_display()
    else:
        # The same picture with and without a screen, and no window that flashes up.
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    # Nothing that a start makes is garbage, and the search for some takes 15 ms before the first
    # paint; `run` begins it after that.
    gc.disable()
    try:
        from app.loading import load_numpy, load_qt

        load_qt()
        load_numpy()
        from app.launch import run

        return run(path, screenshot, size, theme)
    finally:
        gc.enable()


def status_of(call: Callable[[], int], tell: Callable[[str], None]) -> int:
    """Exit status of a call: its own, `USER_ERROR`, `OUR_ERROR` or `INTERRUPTED`.

    Parameters
    ----------
    call
        What the program does.
    tell
        Takes the sentence about what went wrong; there is never a traceback.
    """
    try:
        return call()
    except KeyboardInterrupt:
        tell("stopped.")
        return INTERRUPTED
    except NinepointError as error:
        tell(str(error))
        return USER_ERROR
    except MemoryError:
        tell("there is not enough memory for this.")
        return USER_ERROR
    except OSError as error:
        if error.filename is None:  # the answer finds no reader, or no room: say no more there
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        tell(f"{error.filename or 'output'}: {error.strerror or type(error).__name__}.")
        return USER_ERROR
    except ImportError:
        raise
    except Exception as error:  # the last resort of a program that shows no traceback
        tell(f"this is a fault of the program, please report it: {type(error).__name__}: {error}")
        return OUR_ERROR


def speak_plainly() -> None:
    """Let what cannot be encoded, such as in names of files, be written all the same."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def tell_words(sentence: str) -> None:
    """Write a sentence to the error stream, if there is one."""
    if sys.stderr is not None:
        sys.stderr.write(f"{NAME}: {sentence}\n")
        sys.stderr.flush()
