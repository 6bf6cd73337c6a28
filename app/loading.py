"""Libraries loaded without what nobody asks them for, so that the window is there sooner."""

from __future__ import annotations

import builtins
import sys
from types import ModuleType
from typing import Final

DOCUMENTATION: Final = ("numpy._core._add_newdocs", "numpy._core._add_newdocs_scalars")
"""NumPy's modules that write the docstrings of what it has in C."""


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


def load_numpy() -> None:
    """Load NumPy as ``python -OO`` has it: what it has in C comes without docstrings.

    They are written one by one, by Python code, which is a seventh of the time that NumPy takes to
    load: 51 of 374 million instructions. In a window nobody reads them. A NumPy whose modules are
    called otherwise is loaded as a whole.

    To be called before anything else imports NumPy; later it does nothing.
    """
    if "numpy" in sys.modules:
        return
    sys.modules.update((name, ModuleType(name)) for name in DOCUMENTATION)
    try:
        import numpy  # noqa: F401, ICN001
    finally:
        for name in DOCUMENTATION:
            del sys.modules[name]
