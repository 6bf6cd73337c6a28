"""The canvas: the sheet in the hand of a designer, who edits it with mouse and keys."""

from __future__ import annotations

from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import (
    QFocusEvent,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from app.edits import counted, without_points
from app.gestures import Pointer
from app.guard import guarded
from app.hand import Hand
from app.measure import Measure
from app.nudging import Nudging
from app.paced import Paced
from app.point_set import PointSet
from app.scene import Overlay
from app.session import Selection, Session
from app.sheet import NO_LIMIT_HINT, Sheet, place_px
from app.tools import ToolName

NOTCH: Final = 120
"""Qt's measure of one notch of a mouse wheel."""

NOTCH_FACTOR: Final = 1.2
"""Zoom of one notch."""

FOLLOW_MS: Final = 40
"""Least time between two texts that follow the mouse, and two marks on the rulers: to write and
paint them takes as long as a tenth of a frame, and nobody reads faster."""

PINCH_LEAST: Final = 0.1
"""Least factor of one step of a pinch."""

_CTRL: Final = Qt.KeyboardModifier.ControlModifier
_SHIFT: Final = Qt.KeyboardModifier.ShiftModifier


class Canvas(Sheet):
    """Shows the document of a session and edits it by hand.

    Parameters
    ----------
    session
        What is shown and edited.
    parent
        The widget that holds it.

    Signals
    -------
    hint_changed(str)
        What mouse and keys do now.
    cursor_moved(object)
        The mouse in the drawing, ``(x_mm, y_mm)``, or None when it has left.
    zoom_changed(float)
        The scale in logical pixels per millimetre (of `Sheet`).
    tool_changed(str)
        Another tool is in the hand: "select", "pen" or "hand".

    Attributes
    ----------
    measure
        Tells how large the drawing is.
    """

    hint_changed = Signal(str)
    cursor_moved = Signal(object)
    tool_changed = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(session, parent)
        self._hand = Hand(self, Nudging(session, self))
        self.measure = Measure(session, lambda: self.scene.curves, self)
        self._hint = self._message = ""
        self._shape = self.cursor().shape()
        self._news = Paced(self._tell_place, FOLLOW_MS, self)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setAccessibleName("Canvas")
        self.setAccessibleDescription(
            "Drawing of the curves. Tab and Shift+Tab walk the control points, arrow keys move"
            " them, Ctrl+Tab leaves. The table of points shows the same as numbers."
        )

    @property
    def overlay(self) -> Overlay:
        """What the hand adds to the picture."""
        return self._hand.overlay

    @property
    def tool(self) -> ToolName:
        """Name of the tool in the hand."""
        return self._hand.name

    @property
    def hint(self) -> str:
        """What mouse and keys do now."""
        return self._message or (self._hand.hint if self._scene.has_limit else NO_LIMIT_HINT)

    def set_tool(self, name: str) -> None:
        """Take a tool into the hand: "select", "pen" or "hand"; what is begun is finished.

        Raises
        ------
        ValueError
            If there is no tool of this name.
        """
        if self._hand.take(name):
            self.tool_changed.emit(self.tool)
            self._after_input()

    def report(self, message: str) -> None:
        """Tell the user why something was not done, until the next press or key."""
        self._message = message
        self._tell()

    def select_all(self) -> None:
        """Select all control points."""
        curves = self.session.document.curves
        points = PointSet({index: np.arange(curve.count) for index, curve in enumerate(curves)})
        self.session.select(Selection(points, self.session.selection.curve))

    def reveal_selection(self) -> None:
        """Show the whole drawing, if some of the selected points are out of view."""
        low, high = self.camera.rectangle_mm()
        curves = self.session.document.curves
        for index, points in self.session.selection.points.by_curve.items():
            places = curves[index].places(points)
            if not ((places >= low) & (places <= high)).all():
                self.fit_all()
                return

    def delete_selection(self) -> None:
        """Delete the selected points; a curve that has none left goes with them."""
        selection = self.session.selection
        if not selection.points or self._hand.is_busy:
            return
        self._hand.settle()
        document = without_points(self.session.document, selection.points)
        self.session.select(Selection(curve=selection.curve))
        self.session.edit(document, counted("Delete", len(selection.points)))

    def nudge(self, dx: float, dy: float) -> None:
        """Move the selected points by some millimetres; a burst is one step of undo."""
        self._hand.nudge(dx, dy)

    def document_replaced(self) -> None:
        """Let go of everything, and show the other document."""
        self._hand.drop()
        super().document_replaced()

    @guarded
    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._message = ""
        self._hand.press(event.button(), _pointer(event))
        self._after_input()

    @guarded
    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self._hand.double_click(event.button(), _pointer(event))
        self._after_input()

    @guarded
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._hand.move(event.buttons(), _pointer(event))
        self._show_hand()
        self._news.offer(event.position())

    @guarded
    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._hand.release(event.button(), _pointer(event))
        self._after_input()

    @guarded
    def wheelEvent(self, event: QWheelEvent) -> None:
        device = event.device()
        is_pad = device is not None and device.type() == device.DeviceType.TouchPad
        turn = event.angleDelta()
        if is_pad and not event.modifiers() & _CTRL:
            way = event.pixelDelta() if not event.pixelDelta().isNull() else turn / 2
            self.look(self.camera.moved(way.x(), way.y()))
        elif event.modifiers() & _SHIFT:
            self.look(self.camera.moved((turn.y() or turn.x()) / 2, 0.0))
        else:
            factor = NOTCH_FACTOR ** (turn.y() / NOTCH)
            self.look(self.camera.zoomed(factor, place_px(event.position())))
        self._after_input()

    @guarded
    def keyPressEvent(self, event: QKeyEvent) -> None:
        self._message = ""
        if event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab) and event.modifiers() & _CTRL:
            super().focusNextPrevChild(event.key() == Qt.Key.Key_Tab)
        elif not self._hand.key_press(event.key(), event.modifiers(), event.isAutoRepeat()):
            event.ignore()
        self._after_input()

    @guarded
    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if not self._hand.key_release(event.key(), event.isAutoRepeat()):
            event.ignore()
        self._after_input()

    @guarded
    def focusNextPrevChild(self, forwards: bool) -> bool:
        # Tab walks the control points, and comes as a key; on an empty canvas it goes on.
        if any(curve.count for curve in self.session.document.curves):
            return False
        return super().focusNextPrevChild(forwards)

    @guarded
    def event(self, event: QEvent) -> bool:
        if isinstance(event, QNativeGestureEvent):
            if event.gestureType() == Qt.NativeGestureType.ZoomNativeGesture:
                factor = max(1.0 + event.value(), PINCH_LEAST)
                self.look(self.camera.zoomed(factor, place_px(event.position())))
            return True
        return super().event(event)

    @guarded
    def focusInEvent(self, event: QFocusEvent) -> None:
        self.refresh()

    @guarded
    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._hand.blur()
        self.refresh()
        self._after_input()

    @guarded
    def hideEvent(self, event: QHideEvent) -> None:
        self._hand.settle()

    @guarded
    def leaveEvent(self, event: QEvent) -> None:
        self._hand.leave()
        self._news.settle(None)
        self._show_hand()

    def _draw(self) -> None:
        super()._draw()
        if not self._hand.is_busy:  # else the hint has been told, and hangs on the hand alone
            self._tell()

    def _tell(self) -> None:
        """Announce the hint if it is another one."""
        hint = self.hint
        if hint != self._hint:
            self._hint = hint
            self.hint_changed.emit(hint)

    def _after_input(self) -> None:
        """Show what an event has changed in the hand, and say what can be done now."""
        self._show_hand()
        self._tell()

    def _show_hand(self) -> None:
        if not self._is_stale and not self.overlay.resembles(self._shown_overlay):
            self.refresh()
        shape = self._hand.tool.cursor
        if shape is not self._shape:
            self._shape = shape
            self.setCursor(shape)

    def _tell_place(self, position: QPointF | None) -> None:
        """Tell and mark where the mouse is, and give the hint, which may tell how far it moved."""
        self.mark_mouse(position)
        if position is None:
            self.cursor_moved.emit(None)
        else:
            x, y = self.camera.to_mm(place_px(position)).tolist()
            self.cursor_moved.emit((x, y))
        self._tell()


def _pointer(event: QMouseEvent) -> Pointer:
    return Pointer(place_px(event.position()), bool(event.modifiers() & _SHIFT))
