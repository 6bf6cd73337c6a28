"""Overrides that Qt calls must not raise: an exception there can end the program (measured)."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def guarded(method: Callable[P, R]) -> Callable[P, R | Any]:
    """Make an override of a Qt virtual function report its exceptions instead of raising them.

    An exception that leaves paintEvent, closeEvent and their like may crash the interpreter
    without ever reaching ``sys.excepthook``. The wrapper hands it to that hook, where the program
    shows it and the tests fail on it, and returns None. A test checks that every override of the
    application wears this decorator.
    """

    @functools.wraps(method)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> R | Any:
        try:
            return method(*args, **kwargs)
        except Exception:
            sys.excepthook(*sys.exc_info())
            return None

    wrapper.is_guarded = True  # type: ignore[attr-defined]
    return wrapper
