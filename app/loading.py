"""Qt, loaded without the hook by which it reads the source of every module that comes after."""

from __future__ import annotations

import builtins


def load_qt() -> None:
    """Load Qt, and leave Python's import as it was.

    PySide6 puts a function of its own in the place of ``__import__``, for the sake of ``from
    __feature__ import ...``, which nothing here says. It searches the whole source of each module
    that is imported from then on for the word PySide6, and Python keeps all that it has read:
    30 ms of the first paint, as much again while the plots are loaded, and 13 MB.

    To be called before anything else imports Qt.
    """
    plain = builtins.__import__
    try:
        import PySide6.QtCore  # noqa: F401
    finally:
        builtins.__import__ = plain
