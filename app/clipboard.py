"""Cut, copy, paste and duplicate: curves to and from other programs, and within the drawing."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QMimeData, QObject, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from app.adding import add_curves
from app.canvas import Canvas
from app.drawing_data import OWN, SVG, DrawingData
from app.edits import centred, chosen, counted, uncovered, without_points
from app.importing import Importer, Job
from app.session import Selection, Session
from app.worker import Task, Worker
from core import atomic
from core.document import Curve, Document
from core.errors import NinepointError

if TYPE_CHECKING:
    from core.formats.sketch import Sketch
    from core.polytope import Cancelled

STEP_PX: Final = 14.0
"""How far a copy steps aside at least, each way: its points then lie free of the others'."""

NICE: Final = (1.0, 2.0, 5.0, 10.0)
"""Steps in mm are one of these times a power of ten."""

SOURCE: Final = Path("The clipboard")
"""What stands in messages in the place of a file's name."""

NUMBERS_IN: Final = 20
"""Lines of a text within which there must be one with two numbers, if it is to be points."""

_NUMBER: Final = r"[-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?"
_TWO_NUMBERS: Final = re.compile(rf"\s*\"?{_NUMBER}\"?(?:\s*[;\t,]\s*|\s+)\"?{_NUMBER}")

NOTHING: Final = (
    "There is nothing to paste: curves, SVG, and two columns of numbers can be pasted."
)


class Clipboard(QObject):
    """The verbs of the Edit menu that move curves.

    What has the focus and cuts, copies or pastes by itself, such as a number field or the table of
    points, is asked to do so instead.

    Parameters
    ----------
    session
        The drawing.
    canvas
        Its scale says how far a copy steps aside.
    importer
        Reads what is pasted, in the background, and asks about lines of other programs.

    Signals
    -------
    told(sentence)
        What was done, or why not, for the status bar.
    """

    told = Signal(str)

    def __init__(
        self, session: Session, canvas: Canvas, importer: Importer, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._canvas = canvas
        self._importer = importer
        self._making = Worker(self)

    def cut(self) -> None:
        """Copy the selected points, and delete them."""
        if _done_by_focus("cut"):
            return
        points = self._session.selection.points
        if not points:
            self.told.emit("Nothing is selected that could be cut.")
            return
        self._session.commit()
        document = self._session.document
        self._put(chosen(document, points))
        curves = points.by_curve
        whole = all(len(members) == document.curves[i].count for i, members in curves.items())
        name = counted("Cut", len(curves), "curve") if whole else counted("Cut", len(points))
        self._session.select(Selection(curve=self._session.selection.curve))
        self._session.edit(without_points(document, points), name)

    def copy(self) -> None:
        """Copy what is selected (`app.edits.chosen`)."""
        if _done_by_focus("copy"):
            return
        self._session.commit()
        document = chosen(self._session.document, self._session.selection.points)
        if not any(curve.count for curve in document.curves):
            self.told.emit("There is nothing to copy: the drawing has no points.")
            return
        data = self._put(document)
        count = sum(bool(curve.count) for curve in document.curves)
        words = "1 curve" if count == 1 else f"{count:,} curves"
        only = "" if data.is_shared else ", for Ninepoint alone: export what is so large"
        self.told.emit(f"Copied {words}{only}.")

    def duplicate(self) -> None:
        """Add what is selected again, a step aside."""
        self._session.commit()
        document = chosen(self._session.document, self._session.selection.points)
        self._add(document, "Duplicate")

    def paste(self) -> None:
        """Add what is on the clipboard."""
        if not _done_by_focus("paste"):
            self.paste_data(QGuiApplication.clipboard().mimeData())

    def paste_data(self, data: QMimeData, place_mm: NDArray[np.float64] | None = None) -> None:
        """Add what somebody offers: with its middle at a place, or where it is.

        Curves that would cover others step aside. Nonsense is told, and changes nothing.
        """
        paths = local_paths(data)
        if isinstance(data, DrawingData):
            self._add(data.document, "Paste", place_mm)
        elif data.hasFormat(OWN):
            self._read(partial(_own, bytes(data.data(OWN).data())), "drawing", place_mm)
        elif paths:
            self._importer.add(paths)
        elif data.hasFormat(SVG):
            self._read(partial(_svg, bytes(data.data(SVG).data())), "SVG", place_mm)
        elif data.hasText() and (text := data.text()).strip():
            data_bytes = text.encode("utf-8", "replace")
            if is_svg(text):
                self._read(partial(_svg, data_bytes), "SVG", place_mm)
            elif is_points(text):
                self._read(partial(_points, data_bytes), "points", place_mm)
            else:
                self.told.emit(NOTHING)
        else:
            self.told.emit(NOTHING)

    def stop(self) -> None:
        """End all work; what was copied stays, as far as it was made."""
        self._making.stop()
        board = QGuiApplication.clipboard()
        data = board.mimeData()
        if isinstance(data, DrawingData):
            board.setMimeData(data.kept())

    def _put(self, document: Document) -> DrawingData:
        """Offer curves to all programs."""
        data = DrawingData(document)
        QGuiApplication.clipboard().setMimeData(data)
        self._making.ask(_making(data))
        return data

    def _read(
        self,
        decode: Callable[[], Sketch | Document],
        kind: str,
        place_mm: NDArray[np.float64] | None,
    ) -> None:
        self._importer.take(
            Job(
                f"{kind} from elsewhere",
                "Paste",
                decode,
                lambda: self._session.document.parameters,
                lambda document: self._add(document, "Paste", place_mm),
                lambda error: self.told.emit(str(error)),
            )
        )

    def _add(
        self, document: Document, verb: str, place_mm: NDArray[np.float64] | None = None
    ) -> None:
        curves = [curve for curve in document.curves if curve.count]
        try:
            placed = tuple(curves) if place_mm is None else centred(curves, place_mm)
            placed = uncovered(self._session.document, placed, self._step_mm())
            count = add_curves(self._session, replace(document, curves=placed), verb)
        except NinepointError as error:
            self.told.emit(str(error))
            return
        self._canvas.reveal_selection()
        words = "1 curve" if count == 1 else f"{count:,} curves"
        self.told.emit(f"{verb}d {words}.")

    def _step_mm(self) -> float:
        """A round number of mm that is `STEP_PX` or some more on the screen."""
        least = STEP_PX * self._canvas.camera.pixel_mm
        power = 10.0 ** np.floor(np.log10(least))
        return float(next(nice for nice in NICE if nice * power >= least * (1 - 1e-9)) * power)


def local_paths(data: QMimeData) -> list[Path]:
    """Files that somebody offers."""
    return [Path(url.toLocalFile()) for url in data.urls() if url.isLocalFile()]


def is_svg(text: str) -> bool:
    """Whether a text begins as SVG does."""
    return text.lstrip("\ufeff \t\r\n").startswith("<") and "<svg" in text[:10_000]


def is_points(text: str) -> bool:
    """Whether two numbers stand in one of a text's first lines."""
    return any(map(_TWO_NUMBERS.match, text[:10_000].splitlines()[:NUMBERS_IN]))


def can_be_pasted(data: QMimeData) -> bool:
    """Whether `Clipboard.paste_data` would try; said without reading much."""
    if data.hasFormat(OWN) or data.hasFormat(SVG) or local_paths(data):
        return True
    return data.hasText() and (is_svg(text := data.text()) or is_points(text))


def _done_by_focus(verb: str) -> bool:
    """Have the widget that has the focus do it, if it can."""
    act: Any = getattr(QApplication.focusWidget(), verb, None)
    if act is None:
        return False
    act()
    return True


def _own(data: bytes) -> Document:
    from core import store

    return store.decode(_within_budget(data), SOURCE)


def _svg(data: bytes) -> Sketch:
    from core.formats import read_svg
    from core.formats.embedded import embedded

    sketch = read_svg.decode(_within_budget(data), SOURCE)
    return replace(sketch, document=embedded(data, SOURCE.name))


def _points(data: bytes) -> Document:
    from core.formats import points

    document = points.decode(_within_budget(data), SOURCE)
    curves = tuple(Curve(curve.points, curve.closed, "Curve 1") for curve in document.curves)
    return replace(document, curves=curves)


def _within_budget(data: bytes) -> bytes:
    if len(data) > atomic.MAX_BYTES:
        raise NinepointError(
            f"{SOURCE} holds {len(data) / 1e6:,.0f} MB; at most {atomic.MAX_BYTES / 1e6:,.0f} MB"
            " are read."
        )
    return data


def _making(data: DrawingData) -> Task:
    """Task that makes what other programs may ask for."""

    def task(_cancelled: Cancelled, _send: Callable[[Any], None]) -> None:
        data.make_all()

    return task
