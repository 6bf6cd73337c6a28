"""What an export would write, found in the background: sizes, counts, proven deviation, faults."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import msgspec
from PySide6.QtCore import QObject, Signal

from app.export_picture import Look, Picture, drawn
from app.pages import picture_size
from app.worker import Task, Worker
from core.document import Document
from core.errors import NinepointError
from core.formats import ExportReport, prepare, report_on
from core.formats.contours import Contours
from core.formats.tables import Tables
from core.polytope import Cancelled
from core.profiles import Profile

NO_MEMORY: Final = "There is not enough memory for this; choose a larger tolerance."
"""What is said where the machine, not the profile, is the limit."""


@dataclass(frozen=True, eq=False)
class Survey:
    """What is known of an export before it is written.

    Attributes
    ----------
    document, profile
        What was asked.
    words
        One line: size, number of contours and entities, proven deviation; or why it cannot be.
    notes
        Sentences on what is not as one might expect.
    is_possible
        Whether it can be written.
    content, original
        What is written; and without the kerf, if there is one.
    """

    document: Document
    profile: Profile
    words: str
    notes: tuple[str, ...] = ()
    is_possible: bool = True
    content: Contours | Tables | None = None
    original: Contours | Tables | None = None

    @classmethod
    def of(cls, document: Document, profile: Profile) -> Survey:
        """Make what the file would hold; never raises a NinepointError."""
        try:
            content = prepare(document, profile)
            original = None
            if profile.kerf_mm and isinstance(content, Contours):
                original = prepare(document, msgspec.structs.replace(profile, kerf_mm=0.0))
            report = report_on(content)
            words = described(report)
            if isinstance(content, Contours) and profile.format == "png":
                width, height = picture_size(content)
                words += f", {width:,} \u00d7 {height:,} pixels"
        except NinepointError as error:
            return cls(document, profile, str(error), is_possible=False)
        except MemoryError:
            return cls(document, profile, NO_MEMORY, is_possible=False)
        return cls(document, profile, words, report.notes, True, content, original)


class Surveyor(QObject):
    """Makes surveys and their pictures, the newest that was asked for; a frame never waits.

    Signals
    -------
    found(survey)
        A `Survey` is there.
    pictured(picture)
        Its `Picture` too; None where there is nothing to draw.
    """

    found = Signal(object)
    pictured = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._worker = Worker(self)
        self._last: Survey | None = None
        self._worker.sent.connect(self._take)
        self._worker.done.connect(self.pictured)

    @property
    def is_busy(self) -> bool:
        """Whether something that was asked for is still to come."""
        return self._worker.is_busy

    def ask(self, document: Document, profile: Profile, look: Look) -> None:
        """Have a drawing surveyed; what was asked before is dropped."""
        self._worker.cancel()
        last = self._last
        if last is not None and (last.document is not document or last.profile != profile):
            last = None
        self._worker.ask(_task(document, profile, look, last))

    def stop(self) -> None:
        """End all work; returns when nothing runs any more."""
        self._worker.stop()

    def _take(self, survey: Survey) -> None:
        self._last = survey
        self.found.emit(survey)


def _task(document: Document, profile: Profile, look: Look, known: Survey | None) -> Task:
    """Task that sends the survey and gives the picture; a known survey is not made again."""

    def task(cancelled: Cancelled, send: Callable[[Any], None]) -> Picture | None:
        survey = Survey.of(document, profile) if known is None else known
        send(survey)
        if survey.content is None or cancelled():
            return None
        return drawn(survey.content, survey.original, look, cancelled)

    return task


def described(report: ExportReport) -> str:
    """Words of a report, in the window's letters: "105.60 \u00d7 62.00 mm, closed, ..."."""
    # Unbreakable spaces keep the bound together in a narrow window.
    bound = report.summary.replace("deviation <= ", "deviation\u00a0\u2264\u00a0")
    words = bound.replace(" x ", "\u00a0\u00d7\u00a0", 1)
    return words.removesuffix(" mm") + "\u00a0mm" * words.endswith(" mm")
