"""The pen: each click adds a point to a new curve."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt

from app.edits import with_new_curve
from app.gestures import Pointer, Stage, one_axis
from app.scene import Overlay
from app.session import Selection
from app.style import SIZES
from app.tools import DOT, State, Tool
from core.document import MAX_COORDINATE_MM, Curve
from core.errors import NinepointError


class PenTool(Tool):
    """Each click adds a point to a new curve; it enters the document when it is finished."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._points_mm: list[NDArray[np.float64]] = []
        self._cursor_mm: NDArray[np.float64] | None = None
        self._closes = False
        self._holds = False
        self._preview: Curve | None = None

    @property
    def overlay(self) -> Overlay:
        return Overlay(preview=self._preview)

    @property
    def cursor(self) -> Qt.CursorShape:
        return Qt.CursorShape.PointingHandCursor if self._closes else Qt.CursorShape.CrossCursor

    def hint(self, shift: bool) -> str:
        if self.state is State.IDLE:
            return f"Click places the first point of a new curve{DOT}V goes back to selecting"
        if self._closes:
            return "Click closes the curve"
        keeps = "Keeping one axis" if shift else "Shift keeps an axis"
        return (
            f"Click adds a point{DOT}click the first one to close{DOT}Enter ends"
            f"{DOT}{keeps}{DOT}Backspace takes back{DOT}Esc drops"
        )

    def press(self, pointer: Pointer) -> None:
        if self._meets_first(pointer):
            self._finish(closed=True)
            return
        self._points_mm.append(self._place(pointer))
        self._holds = True
        self.state = State.DRAWING
        self._follow(pointer)

    def move(self, pointer: Pointer) -> None:
        if self.state is not State.DRAWING:
            return
        if self._holds:
            del self._points_mm[-1]
            self._points_mm.append(self._place(pointer))
        self._follow(pointer)

    def release(self, pointer: Pointer) -> None:
        self.move(pointer)
        self._holds = False

    def double_click(self, pointer: Pointer) -> None:
        # The first click of the two has placed the last point. Two fast clicks apart from each
        # other do not come here: Qt calls them two clicks.
        if self.state is State.DRAWING:
            self._finish(closed=False)
        else:
            self.press(pointer)

    def leave(self) -> None:
        self._cursor_mm = None
        self._draw_preview()

    def settle(self) -> None:
        self._holds = False

    def put_down(self) -> None:
        self._finish(closed=False)

    def key(self, key: int) -> bool:
        if self.state is not State.DRAWING:
            return False
        if key == Qt.Key.Key_Escape:
            self.drop()
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._finish(closed=False)
        elif key == Qt.Key.Key_Backspace:
            self._points_mm.pop()
            self._holds = False
            if not self._points_mm:
                self.drop()
            self._draw_preview()
        else:
            return False
        return True

    def _meets_first(self, pointer: Pointer) -> bool:
        """Whether a click here closes the curve: on its first point, with three or more."""
        if len(self._points_mm) < 3 or self._holds:
            return False
        first = self._stage.camera.to_pixels(self._points_mm[0])
        return bool(np.hypot(*(first - pointer.pos_px)) <= SIZES.hit_point)

    def _place(self, pointer: Pointer) -> NDArray[np.float64]:
        place = self._stage.camera.to_mm(pointer.pos_px)
        if pointer.shift and self._points_mm:
            place = self._points_mm[-1] + one_axis(place - self._points_mm[-1])
        return np.clip(place, -MAX_COORDINATE_MM, MAX_COORDINATE_MM)

    def _follow(self, pointer: Pointer) -> None:
        self._closes = self._meets_first(pointer)
        self._cursor_mm = None if self._holds else self._place(pointer)
        self._draw_preview()

    def _draw_preview(self) -> None:
        points = list(self._points_mm)
        if not points:
            self._preview = None
            return
        if self._cursor_mm is not None and not self._closes:
            points.append(self._cursor_mm)
        self._preview = Curve(np.array(points), closed=self._closes)

    def _finish(self, closed: bool) -> None:
        points = self._points_mm
        self.drop()
        if len(points) < 2:
            return
        session = self._stage.session
        try:
            document = with_new_curve(session.document, np.array(points), closed)
        except NinepointError as error:
            self._stage.report(str(error))
            return
        session.commit()
        session.edit(document, "Draw curve")
        session.select(Selection(curve=len(document.curves) - 1))
        self._stage.set_tool("select")

    def drop(self) -> None:
        super().drop()
        self._points_mm = []
        self._cursor_mm = None
        self._closes = self._holds = False
        self._preview = None
