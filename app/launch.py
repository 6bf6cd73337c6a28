"""The start of the program: application, look and window, shown or drawn into a picture."""

from __future__ import annotations

import gc
import sys
from pathlib import Path
from typing import Final

from PySide6.QtCore import (
    QMessageLogContext,
    QSettings,
    QTimer,
    QtMsgType,
    qFormatLogMessage,
    qInstallMessageHandler,
)

from app.failures import Failures
from app.icons import program_icon
from app.settings import Settings
from app.theme import Look, styled_application
from app.window import DEFAULT_SIZE, MainWindow
from core.document import Document
from core.errors import FileError

SEARCHES: Final = (20_000, 20, 100)
"""New objects after which Python looks for garbage among the young, and how many times it does
that before it looks among the older ones, and the oldest."""

IDLE_MESSAGE: Final = "This plugin does not support propagateSizeHints()"
"""What Qt says of each window on a screen that is not there; it means nothing to the user."""


def run(
    path: Path | None = None,
    screenshot: Path | None = None,
    size: tuple[int, int] | None = None,
    theme: str = "system",
) -> int:
    """Show the window until it is closed, or draw it into a picture.

    Parameters
    ----------
    path
        File to open; else the window opens on a ready shape.
    screenshot
        Where to write a picture of the window (PNG) instead of waiting for the user. Settings are
        neither read nor written then.
    size
        Size of the window in logical pixels; the last one, or 1280 x 800, by default.
    theme
        "system", "light" or "dark".

    Returns
    -------
    int
        Exit status, 0 if all went well.

    Raises
    ------
    NinepointError
        If a picture was asked for and the file cannot be read or the picture not be written;
        without ``screenshot`` the user is told in the window instead.
    """
    application = styled_application(sys.argv[0])
    application.setOrganizationName("Ninepoint")
    application.setApplicationName("Ninepoint")
    application.setDesktopFileName("ninepoint")
    look = Look(application, theme)
    window = MainWindow(settings=Settings(None if screenshot else QSettings()))
    window.painted.connect(_search_what_comes)
    window.painted.connect(lambda: application.setWindowIcon(program_icon()))
    hook = sys.excepthook
    Failures(window).install()
    before = qInstallMessageHandler(_tell)
    try:
        if screenshot is not None:
            return _draw(window, path, screenshot, size or DEFAULT_SIZE)
        window.restore()
        if size is not None:
            window.resize(*size)
        window.show()
        if path is not None:
            window.files.open_path(path)  # before the first paint, but its errors have a parent
        return application.exec()
    finally:
        sys.excepthook = hook
        qInstallMessageHandler(before)
        window.stop()
        look.deleteLater()
        window.deleteLater()


def _draw(window: MainWindow, path: Path | None, picture: Path, size: tuple[int, int]) -> int:
    """Write a picture of the complete window; errors are raised, there is nobody to be asked."""
    from PySide6.QtCore import QEventLoop  # windows that are shown do not wait for it

    if path is not None:
        window.files.show_document(_unasked(path), path)
    loop = QEventLoop()
    window.completed.connect(loop.quit)
    window.resize(*size)
    window.show()
    loop.exec()
    if not window.analysis.is_at_rest:
        window.analysis.rested.connect(loop.quit)
        loop.exec()
    window.canvas.measure.look()
    window.grab()  # what the plots lay out in their first paint is in its place in the second
    QTimer.singleShot(0, loop, loop.quit)
    loop.exec()
    written = window.grab().save(str(picture), "PNG")
    window.hide()
    if not written:
        raise FileError(picture, "the picture cannot be written there.")
    return 0


def _unasked(path: Path) -> Document:
    """Drawing in a file; curves are fitted to the lines of another program's."""
    from core.formats import open_document
    from core.formats.fitted import fitted
    from core.formats.foreign import SUFFIXES, read_sketch

    if path.suffix.lower() not in SUFFIXES:
        return open_document(path)
    sketch = read_sketch(path)
    return fitted(sketch)[0] if sketch.document is None else sketch.document


def _search_what_comes() -> None:
    """Let Python look for garbage again, but not among what lives as long as the program.

    That spares the hand, which a search through all would stop for some 20 ms now and then. Among
    thousands of curves each frame makes more than Python expects of a program; what is garbage
    there goes without a search, so that it may come rarely.
    """
    if not gc.isenabled():
        gc.freeze()
        gc.set_threshold(*SEARCHES)
        gc.enable()


def _tell(kind: QtMsgType, context: QMessageLogContext, message: str) -> None:
    """Write a message of Qt's as Qt does, but for `IDLE_MESSAGE`."""
    if message != IDLE_MESSAGE and sys.stderr is not None:
        sys.stderr.write(qFormatLogMessage(kind, context, message) + "\n")
