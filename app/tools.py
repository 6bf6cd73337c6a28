"""What a tool is: a small state machine with named states that turns mouse and keys into gestures.

Nothing is drawn here and no pixel is touched: a tool says what it adds to the picture (`overlay`),
which cursor it wants, and what the keys do now (`hint`).
"""

from __future__ import annotations

from enum import Enum
from typing import Final, Literal

import numpy as np
from PySide6.QtCore import Qt

from app.gestures import Gesture, Pan, Pointer, Stage
from app.scene import NOTHING, Overlay
from app.style import SIZES

ToolName = Literal["select", "pen", "hand"]
"""Names of the tools."""

DOT: Final = " \N{MIDDLE DOT} "
"""Separates the parts of a hint."""


class State(Enum):
    """Where a tool is in its gesture."""

    IDLE = "no button is pressed"
    PRESSED = "the button is down, and the mouse has not yet moved"
    DRAGGING = "a gesture follows the mouse"
    DRAWING = "a curve is begun and waits for its next point"


class Tool:
    """A tool in the hand.

    Parameters
    ----------
    stage
        The canvas.
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self.state = State.IDLE

    @property
    def overlay(self) -> Overlay:
        """What the tool adds to the picture."""
        return NOTHING

    @property
    def cursor(self) -> Qt.CursorShape:
        """Shape of the mouse cursor."""
        return Qt.CursorShape.ArrowCursor

    def hint(self, shift: bool) -> str:
        """Tell what can be done now, with the present modifiers."""
        raise NotImplementedError

    def press(self, pointer: Pointer) -> None:
        """Take the left button's going down."""

    def move(self, pointer: Pointer) -> None:
        """Follow the mouse, with or without the button."""

    def release(self, pointer: Pointer) -> None:
        """Take the left button's going up; the mouse may have moved since the last move."""

    def double_click(self, pointer: Pointer) -> None:
        """Take the left button's going down again, soon after a click."""

    def leave(self) -> None:
        """Take note that the mouse has left the canvas."""

    def settle(self) -> None:
        """Bring to an end what is under way, keeping it: the focus goes elsewhere."""

    def key(self, key: int) -> bool:
        """Take a key; False if the tool has no use for it now."""
        return False

    def put_down(self) -> None:
        """Finish what is begun: another tool is taken."""
        self.settle()

    def drop(self) -> None:
        """Forget what is under way: the document has been replaced."""
        self.state = State.IDLE


class DragTool(Tool):
    """A tool whose drags are gestures."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._pressed: Pointer | None = None
        self._gesture: Gesture | None = None

    @property
    def overlay(self) -> Overlay:
        return NOTHING if self._gesture is None else self._gesture.overlay

    def _begin(self, pressed: Pointer) -> Gesture:
        """Return the gesture that a drag from there is."""
        raise NotImplementedError

    def _click(self, pointer: Pointer) -> None:
        """Take a press and a release at one place."""

    def press(self, pointer: Pointer) -> None:
        self._pressed = pointer
        self.state = State.PRESSED

    def move(self, pointer: Pointer) -> None:
        if self.state is State.PRESSED and self._pressed is not None:
            if _distance(pointer, self._pressed) < SIZES.drag_start:
                return
            self._gesture = self._begin(self._pressed)
            self.state = State.DRAGGING
        if self._gesture is not None:
            if self._gesture.is_alive:
                self._gesture.move(pointer)
            else:
                self.drop()

    def release(self, pointer: Pointer) -> None:
        # The release has a place of its own, later than the last move's.
        self.move(pointer)
        clicked = self.state is State.PRESSED
        self.settle()
        if clicked:
            self._click(pointer)

    def settle(self) -> None:
        gesture = self._gesture
        self.drop()
        if gesture is not None and gesture.is_alive:
            gesture.finish()

    def key(self, key: int) -> bool:
        if key == Qt.Key.Key_Escape and self.state is not State.IDLE:
            gesture = self._gesture
            self.drop()
            if gesture is not None and gesture.is_alive:
                gesture.cancel()
            return True
        return False

    def drop(self) -> None:
        super().drop()
        self._gesture = self._pressed = None


class HandTool(DragTool):
    """A drag pushes the paper."""

    @property
    def cursor(self) -> Qt.CursorShape:
        pressed = self.state is not State.IDLE
        return Qt.CursorShape.ClosedHandCursor if pressed else Qt.CursorShape.OpenHandCursor

    def hint(self, shift: bool) -> str:
        if self._gesture is not None:
            return self._gesture.hint(shift)
        return f"Drag moves the view{DOT}the wheel zooms at the mouse"

    def press(self, pointer: Pointer) -> None:
        super().press(pointer)
        self._gesture = self._begin(pointer)
        self.state = State.DRAGGING

    def _begin(self, pressed: Pointer) -> Gesture:
        return Pan(self._stage, pressed)


def _distance(first: Pointer, second: Pointer) -> float:
    return float(np.hypot(*(first.pos_px - second.pos_px)))
