"""The hand: which tool it holds, and which one an event goes to."""

from __future__ import annotations

from typing import Final, get_args

import numpy as np
from PySide6.QtCore import Qt

from app.gestures import Pointer, Stage
from app.nudging import Nudging
from app.pen_tool import PenTool
from app.point_set import PointSet
from app.scene import Overlay
from app.select_tool import SelectTool
from app.session import Selection
from app.tools import HandTool, State, Tool, ToolName

NUDGE_MM: Final = 1.0
"""Step of an arrow key; Shift makes it ten times, Alt a tenth."""

_ARROWS: Final = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}

_SHIFT: Final = Qt.KeyboardModifier.ShiftModifier
_ALT: Final = Qt.KeyboardModifier.AltModifier


class Hand:
    """Holds a tool, and the hand tool besides: with the middle button, or while Space is held.

    Parameters
    ----------
    stage
        The canvas.
    nudging
        What arrow keys do.
    """

    def __init__(self, stage: Stage, nudging: Nudging) -> None:
        self._stage = stage
        self._nudging = nudging
        self._select = SelectTool(stage)
        self._panning = HandTool(stage)
        self._tools: dict[ToolName, Tool] = {
            "select": self._select,
            "pen": PenTool(stage),
            "hand": self._panning,
        }
        self._name: ToolName = "select"
        self._busy: tuple[Tool, Qt.MouseButton] | None = None
        self._space = False
        self._pointer: Pointer | None = None
        self._shift = False

    @property
    def name(self) -> ToolName:
        """The tool that was chosen."""
        return self._name

    @property
    def tool(self) -> Tool:
        """The tool that the next press goes to, or that is at work."""
        if self._busy is not None:
            return self._busy[0]
        return self._panning if self._space else self._tools[self._name]

    @property
    def is_busy(self) -> bool:
        """Whether a button is down and a tool is at work."""
        return self._busy is not None

    @property
    def overlay(self) -> Overlay:
        """What the chosen tool adds to the picture."""
        return self._tools[self._name].overlay

    @property
    def hint(self) -> str:
        """What mouse and keys do now."""
        return self.tool.hint(self._shift)

    def take(self, name: str) -> bool:
        """Choose a tool and finish what the other one had begun; False if it is held already.

        Raises
        ------
        ValueError
            If there is no tool of this name.
        """
        for tool_name in get_args(ToolName):
            if name == tool_name:
                break
        else:
            raise ValueError(f"there is no tool {name!r}")
        if name == self._name:
            return False
        old, self._name = self._tools[self._name], tool_name
        old.put_down()
        return True

    def press(self, button: Qt.MouseButton, pointer: Pointer) -> None:
        """Take a button's going down; while another one is at work it has no meaning."""
        self._note(pointer)
        if self._busy is not None:
            return
        self._nudging.settle()
        if button == Qt.MouseButton.LeftButton:
            self._busy = self.tool, button
            self.tool.press(pointer)
        elif button == Qt.MouseButton.MiddleButton:
            self._busy = self._panning, button
            self._panning.press(pointer)
        elif button == Qt.MouseButton.RightButton and self._name == "select":
            self._select.select_under(pointer)

    def double_click(self, button: Qt.MouseButton, pointer: Pointer) -> None:
        """Take a button's going down again, soon after a click."""
        if button != Qt.MouseButton.LeftButton or self._busy is not None:
            self.press(button, pointer)
            return
        self._note(pointer)
        self._nudging.settle()
        self._busy = self.tool, button
        self.tool.double_click(pointer)

    def move(self, buttons: Qt.MouseButton, pointer: Pointer) -> None:
        """Follow the mouse."""
        self._note(pointer)
        if self._busy is not None and not buttons & self._busy[1]:
            # The release went elsewhere: what was done is kept.
            self.settle()
        self.tool.move(pointer)

    def release(self, button: Qt.MouseButton, pointer: Pointer) -> None:
        """Take a button's going up."""
        self._note(pointer)
        if self._busy is not None and button == self._busy[1]:
            tool, self._busy = self._busy[0], None
            tool.release(pointer)

    def leave(self) -> None:
        """Take note that the mouse has left the canvas."""
        self._pointer = None
        self.tool.leave()

    def settle(self) -> None:
        """Keep what is under way and let go: the focus goes elsewhere."""
        self._space = False
        self._nudging.settle()
        busy, self._busy = self._busy, None
        if busy is not None:
            busy[0].settle()

    def blur(self) -> None:
        """Settle, and forget the keys that are held: their release goes elsewhere."""
        self.settle()
        self._shift = False
        if self._pointer is not None:
            self._pointer = Pointer(self._pointer.pos_px, False)

    def drop(self) -> None:
        """Forget what is under way: the document has been replaced."""
        self._busy = None
        for tool in self._tools.values():
            tool.drop()

    def key_press(self, key: int, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Take a key; False if it has no meaning here."""
        if key == Qt.Key.Key_Shift:
            self._follow_shift(True)
            return False
        if key == Qt.Key.Key_Space:
            if not repeated:
                self._space = True
            return True
        if key in _ARROWS:
            return self._nudge(Qt.Key(key), modifiers)
        if key in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            self._walk(-1 if key == Qt.Key.Key_Backtab or modifiers & _SHIFT else 1)
            return True
        if key == Qt.Key.Key_Escape:
            self._nudging.settle()
        taken = self.tool.key(key)
        if taken and self._busy is not None and self._busy[0].state is State.IDLE:
            self._busy = None
        return taken

    def key_release(self, key: int, repeated: bool) -> bool:
        """Take the end of a key; False if it has no meaning here."""
        if key == Qt.Key.Key_Shift:
            self._follow_shift(False)
        if key == Qt.Key.Key_Space and not repeated:
            self._space = False
            return True
        return False

    def _note(self, pointer: Pointer) -> None:
        self._pointer, self._shift = pointer, pointer.shift

    def _follow_shift(self, shift: bool) -> None:
        """Shift acts at once, without waiting for the mouse."""
        self._shift = shift
        if self._pointer is not None:
            self._pointer = Pointer(self._pointer.pos_px, shift)
            self.tool.move(self._pointer)

    def _nudge(self, key: Qt.Key, modifiers: Qt.KeyboardModifier) -> bool:
        if not self._stage.session.selection.points:
            return False
        step = NUDGE_MM * (10 if modifiers & _SHIFT else 1) * (0.1 if modifiers & _ALT else 1)
        right, up = _ARROWS[key]
        self.nudge(right * step, up * step)
        return True

    def nudge(self, dx_mm: float, dy_mm: float) -> None:
        """Move the selected points; nothing happens while a tool is at work."""
        if self._busy is None:
            self._nudging.nudge(dx_mm, dy_mm)

    def _walk(self, way: int) -> None:
        """Select the next or the previous control point; after a curve's last the next curve's."""
        session = self._stage.session
        curves = session.document.curves
        # Where each curve begins when all points are counted in one row.
        starts = np.cumsum([0, *(curve.count for curve in curves)])
        if not starts[-1] or self._busy is not None:
            return
        self._nudging.settle()
        selection = session.selection
        own = selection.points.of_curve(selection.curve)
        if len(own):
            place = starts[selection.curve] + (own[-1] if way > 0 else own[0]) + way
        else:
            after = selection.curve + (way < 0)
            place = starts[after] - (way < 0)
        place %= starts[-1]
        curve = int(np.searchsorted(starts, place, "right")) - 1
        session.select(Selection(PointSet({curve: [place - starts[curve]]}), curve))
