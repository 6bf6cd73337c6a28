"""The errors that Ninepoint raises on purpose; each message is a sentence for the user."""

from __future__ import annotations

from pathlib import Path


class NinepointError(ValueError):
    """A request that cannot be fulfilled, said in one sentence that a user can act on."""


class ParameterError(NinepointError):
    """A scheme parameter that is no number, not finite, or outside the admitted range."""


class NoLimitError(NinepointError):
    """The scheme has no unique limit function: 1 is not a simple eigenvalue of its matrix."""


class SmoothnessError(NinepointError):
    """A derivative was asked for that the scheme is not proven to have."""


class FileError(NinepointError):
    """A file that cannot be read or written as asked.

    Parameters
    ----------
    path
        The file, as the user named it.
    reason
        What is wrong and what to do, without the file's name.
    line
        The line (from 1) where it is wrong, if the fault has a place.
    """

    def __init__(self, path: str | Path, reason: str, line: int | None = None) -> None:
        self.path = Path(path)
        self.reason = reason
        self.line = line
        place = "" if line is None else f", line {line}"
        super().__init__(f"{self.path.name or self.path}{place}: {reason}")
