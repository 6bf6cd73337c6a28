"""Curves on their way to other programs: one object for the clipboard and for drag and drop.

It offers the drawing itself, without loss, and SVG (as such, and as text), and a picture. Nothing
of it is made before somebody asks, or the window has time: copying costs nothing.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Final

from PySide6.QtCore import QByteArray, QMetaType, QMimeData

from app.guard import guarded
from core import store
from core.document import Document
from core.errors import NinepointError

OWN: Final = "application/x-ninepoint+json"
"""Type of our own file format."""

SVG: Final = "image/svg+xml"
TEXT: Final = "text/plain"
PNG: Final = "image/png"

MOST_SHARED: Final = 20_000
"""Control points up to which other programs are offered SVG and a picture: a second of work."""

TITLE: Final = "Ninepoint"
"""Title inside SVG and PNG."""

DPI: Final = 300.0
"""Resolution of a picture that is no larger than `LONGEST_PX` so."""

LONGEST_PX: Final = 2000.0
"""Longest side of a picture: sharp on a page, and quickly made."""

LINE_PX: Final = 3.0
"""Width of the lines in a picture."""

MM_PER_INCH: Final = 25.4
LEAST_SIDE_MM: Final = 1.0


class DrawingData(QMimeData):
    """The curves of a document, in the forms that other programs ask for.

    It must not outlive Python: before the program ends, `kept` takes its place on the clipboard.

    Parameters
    ----------
    document
        What is copied.
    """

    def __init__(self, document: Document) -> None:
        super().__init__()
        self.document = document
        self._makers: dict[str, Callable[[Document], bytes]] = {OWN: store.encode}
        if sum(curve.count for curve in document.curves) <= MOST_SHARED:
            self._makers |= {SVG: svg_text, TEXT: svg_text, PNG: png_bytes}
        self._made: dict[str, bytes] = {}
        self._lock = threading.Lock()

    @property
    def is_shared(self) -> bool:
        """Whether other programs are offered forms that they know."""
        return SVG in self._makers

    def make(self, kind: str) -> bytes:
        """One of its forms, made once; empty if the drawing has none.

        It may be called in any thread: a second caller waits for the first.
        """
        maker = self._makers.get(kind)
        if maker is None:
            return b""
        with self._lock:
            if kind not in self._made:
                if kind == TEXT and SVG in self._made:
                    self._made[TEXT] = self._made[SVG]
                else:
                    try:
                        self._made[kind] = maker(self.document)
                    except NinepointError:  # nothing to be seen, no limit, out of bounds
                        self._made[kind] = b""
        return self._made[kind]

    def make_all(self) -> None:
        """Make all forms, before anybody asks."""
        for kind in self._makers:
            self.make(kind)

    def kept(self) -> QMimeData:
        """Copy of what was made, which needs no Python: it outlives the program's end."""
        data = QMimeData()
        for kind, value in self._made.items():
            if value:
                data.setData(kind, QByteArray(value))
        return data

    @guarded
    def formats(self) -> list[str]:
        """Names of the forms."""
        return list(self._makers)

    @guarded
    def hasFormat(self, kind: str) -> bool:
        """Whether there is such a form."""
        return kind in self._makers

    @guarded
    def retrieveData(self, kind: str, wanted: QMetaType | QMetaType.Type) -> Any:
        """Answer a program that asks for a form."""
        value = self.make(kind)
        if not value:
            return None
        return value.decode() if kind == TEXT else QByteArray(value)


def svg_text(document: Document) -> bytes:
    """The drawing as SVG, with itself inside."""
    from core.formats import PROFILES, Contours, svg

    return svg.encode(Contours.of(document, PROFILES["svg"]), TITLE)


def png_bytes(document: Document) -> bytes:
    """A picture of the drawing on white, at true size unless that is very large."""
    import msgspec

    from app.pages import encode_png
    from core.formats import PROFILES, Contours
    from core.profiles import MAX_WIDTH_MM, MIN_DPI

    contours = Contours.of(document, PROFILES["png"])
    longest = max(*contours.size_mm, LEAST_SIDE_MM) / MM_PER_INCH
    dpi = max(min(DPI, LONGEST_PX / longest), MIN_DPI)
    width = min(LINE_PX * MM_PER_INCH / dpi, MAX_WIDTH_MM)
    profile = msgspec.structs.replace(
        PROFILES["png"], dpi=dpi, width_mm=width, transparent=False
    )
    return encode_png(Contours.of(document, profile), TITLE)
