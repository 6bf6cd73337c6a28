"""A canvas on a screen that is not there, and a mouse that sends it real events."""

import numpy as np
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from app.canvas import Canvas
from app.session import Session
from core.document import Curve, Document

LEFT = Qt.MouseButton.LeftButton
MIDDLE = Qt.MouseButton.MiddleButton
RIGHT = Qt.MouseButton.RightButton
NO_BUTTON = Qt.MouseButton.NoButton
NO_KEY = Qt.KeyboardModifier.NoModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier

BOAT = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]
"""A closed polygon, in mm."""


def by(x, y):
    """A way on the screen or in the drawing."""
    return np.array([x, y], dtype=float)


def boat(closed=True):
    return Document((Curve(BOAT, closed),))


def shown(qtbot, document, size=(900, 600)):
    """A canvas that shows a document, fitted."""
    canvas = Canvas(Session(document))
    qtbot.addWidget(canvas)
    canvas.resize(*size)
    with qtbot.waitExposed(canvas):
        canvas.show()
    canvas.setFocus()
    QApplication.processEvents()
    return canvas


class Mouse:
    """A mouse over a canvas; places are in pixels, or of things in the drawing."""

    def __init__(self, canvas):
        self.canvas = canvas
        self.held = NO_BUTTON
        self.place = np.zeros(2)

    def pixels(self, place_mm):
        return self.canvas.camera.to_pixels(place_mm)

    def point(self, index, curve=0):
        """Pixels of a control point."""
        return self.pixels(self.canvas.session.document.curves[curve].points[index])

    def on_curve(self, t, curve=0):
        """Pixels of a place on the limit curve."""
        document = self.canvas.session.document
        return self.pixels(document.curves[curve].limit(document.parameters).at(t))

    def _send(self, kind, place, button, keys):
        self.place = np.asarray(place, dtype=float)
        at = QPointF(*self.place)
        event = QMouseEvent(kind, at, self.canvas.mapToGlobal(at), button, self.held, keys)
        QApplication.sendEvent(self.canvas, event)

    def press(self, place, button=LEFT, keys=NO_KEY):
        self.held = button
        self._send(QEvent.Type.MouseButtonPress, place, button, keys)

    def move(self, place, keys=NO_KEY):
        self._send(QEvent.Type.MouseMove, place, NO_BUTTON, keys)

    def release(self, place=None, button=LEFT, keys=NO_KEY):
        self.held = NO_BUTTON
        place = self.place if place is None else place
        self._send(QEvent.Type.MouseButtonRelease, place, button, keys)

    def click(self, place, button=LEFT, keys=NO_KEY):
        self.move(place, keys)
        self.press(place, button, keys)
        self.release(place, button, keys)

    def press_again(self, place):
        """Qt's double click, which stands for the second press."""
        self.held = LEFT
        self._send(QEvent.Type.MouseButtonDblClick, place, LEFT, NO_KEY)

    def double_click(self, place):
        self.click(place)
        self.press_again(place)
        self.release(place)

    def drag(self, start, *stops, keys=NO_KEY, button=LEFT):
        """Press, follow the stops, and release at the last."""
        self.move(start)
        self.press(start, button, keys)
        for stop in stops:
            self.move(stop, keys)
        self.release(stops[-1], button, keys)
