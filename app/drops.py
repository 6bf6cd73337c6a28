"""Drag and drop onto the window: files, curves, SVG, numbers; and words on what will happen."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QMimeData, QObject, QPoint, Qt, QTimer
from PySide6.QtGui import QDropEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QWidget

from app.guard import guarded
from app.style import color, palette_of

if TYPE_CHECKING:
    from app.window import MainWindow

OWN_SUFFIX: Final = ".ninepoint"

PADDING_PX: Final = 14
ROUNDING_PX: Final = 6.0
RIM_PX: Final = 2.0
LONGEST_NAME: Final = 40
"""Characters of a file's name that are shown."""


class DropHint(QLabel):
    """Words over the canvas that say what a drop will do."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._over = parent
        self.setAccessibleName("What will be dropped")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setMargin(PADDING_PX)
        self.hide()

    def say(self, words: str) -> None:
        """Show words in the middle of the parent; none hides them."""
        self.setVisible(bool(words))
        if words:
            self.setText(words)
            self.adjustSize()
            self.move(self._over.rect().center() - self.rect().center())
            self.raise_()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the words on a ground with a rim in the colour of the program."""
        palette = palette_of(self)
        frame = self.rect().toRectF().adjusted(RIM_PX / 2, RIM_PX / 2, -RIM_PX / 2, -RIM_PX / 2)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(color(palette.accent), RIM_PX))
            painter.setBrush(color(palette.background))
            painter.drawRoundedRect(frame, ROUNDING_PX, ROUNDING_PX)
        super().paintEvent(event)


class Drops(QObject):
    """Takes what is dragged over a window and dropped there.

    Parameters
    ----------
    window
        The window. Its `files`, `importer`, `clipboard` and `canvas` do the work.
    """

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.hint = DropHint(window.canvas)

    def enter(self, event: QDropEvent) -> None:
        """Say what a drop would do, and take it if that is anything."""
        self.hint.say(self.promise(event.mimeData()))
        self.move(event)

    def move(self, event: QDropEvent) -> None:
        """Take a drop at this place, too, if any."""
        if self.hint.text() and not self.hint.isHidden():
            event.setDropAction(Qt.DropAction.CopyAction)
            event.accept()

    def leave(self) -> None:
        """Say nothing any more."""
        self.hint.say("")

    def drop(self, event: QDropEvent) -> None:
        """Open, import or paste what is dropped."""
        self.hint.say("")
        data = event.mimeData()
        if not self.promise(data):
            return
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        paths = _paths(data)
        place = self._place(event.position().toPoint())
        # A question must not be asked while the other program waits for the drop to end; what it
        # offers is gone then.
        kept = _kept(data)
        if paths:
            QTimer.singleShot(0, self, lambda: self._take(paths))
        else:
            QTimer.singleShot(0, self, lambda: self._window.clipboard.paste_data(kept, place))

    def promise(self, data: QMimeData) -> str:
        """What a drop would do; "" if nothing can be done with it."""
        # The readers come with it, which a start does not need.
        from app.clipboard import can_be_pasted

        if not can_be_pasted(data):
            return ""
        paths = _paths(data)
        if not paths:
            return f"Drop to add the {'curves' if _is_drawn(data) else 'points'} here"
        opened, added = self._shares(paths)
        rest = f"the curves of {_named(added)}" if added else ""
        if opened is None:
            return f"Drop to add {rest}"
        return f"Drop to open {_named([opened])}" + (f" and add {rest}" if rest else "")

    def _shares(self, paths: list[Path]) -> tuple[Path | None, list[Path]]:
        """The file that is opened, if one is, and those whose curves are added."""
        session = self._window.session
        is_untouched = session.path is None and session.undo_name is None
        is_empty = not any(curve.count for curve in session.document.curves)
        is_own = len(paths) == 1 and paths[0].suffix.lower() == OWN_SUFFIX
        if (is_untouched and not session.is_modified) or is_empty or is_own:
            return paths[0], paths[1:]
        return None, paths

    def _take(self, paths: list[Path]) -> None:
        opened, added = self._shares(paths)
        if opened is not None:
            self._window.files.open_path(opened)
        self._window.importer.add(added)

    def _place(self, position: QPoint) -> NDArray[np.float64] | None:
        """Place in the drawing, or None beside the canvas."""
        canvas = self._window.canvas
        at = canvas.mapFrom(self._window, position)
        if not canvas.rect().contains(at):
            return None
        return canvas.camera.to_mm((at.x(), at.y()))


def _paths(data: QMimeData) -> list[Path]:
    """Files that are offered; who drags curves means these."""
    from app.clipboard import local_paths
    from app.drawing_data import OWN

    return [] if data.hasFormat(OWN) else local_paths(data)


def _is_drawn(data: QMimeData) -> bool:
    """Whether curves rather than numbers are offered."""
    from app.clipboard import is_svg
    from app.drawing_data import OWN, SVG

    return data.hasFormat(OWN) or data.hasFormat(SVG) or is_svg(data.text())


def _kept(data: QMimeData) -> QMimeData:
    """What is offered, for later: it itself if it is ours, else a copy."""
    from app.drawing_data import DrawingData

    if isinstance(data, DrawingData):
        return data
    copy = QMimeData()
    for kind in data.formats():
        copy.setData(kind, data.data(kind))
    return copy


def _named(paths: list[Path]) -> str:
    if len(paths) > 1:
        return f"{len(paths)} files"
    name = paths[0].name
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 3]}..."


