"""The rulers along the sheet, and the marks on them that follow the mouse."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QFont, QPainter, QPalette, QPixmap
from PySide6.QtWidgets import QLabel, QWidget

from app.camera import Camera
from app.grid import Step, paint_frame, paint_ruler
from app.style import SIZES, Palette, color


class Rulers:
    """Two strips in front of the sheet, along its upper and its left edge, each with a mark.

    They are widgets that Qt paints by itself. Marks painted by the sheet would make what it has to
    paint, for each move of the mouse, reach from both rulers to the drawing.

    Parameters
    ----------
    sheet
        The widget that they lie on.
    """

    def __init__(self, sheet: QWidget) -> None:
        self._strips = QLabel(sheet), QLabel(sheet)
        self._marks: list[QWidget] = []  # made when the mouse comes, after the first paint
        self._colours = QPalette()
        for strip in self._strips:
            strip.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            strip.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)

    def show_view(
        self,
        camera: Camera,
        palette: Palette,
        ratio: float,
        font: QFont,
        step: Step,
        has_focus: bool,
    ) -> None:
        """Draw the rulers of a view.

        Parameters
        ----------
        camera, palette, step
            As in `app.grid.paint_ruler`.
        ratio
            Device pixels per logical pixel.
        font
            Font of the sheet.
        has_focus
            Whether the frame of what has the focus runs over them.
        """
        breadth = SIZES.ruler
        places = (
            QRect(0, 0, camera.width, breadth), QRect(0, breadth, breadth, camera.height - breadth)
        )  # fmt: skip
        accent = color(palette.accent)
        self._colours.setColor(QPalette.ColorRole.Window, accent)
        for mark in self._marks:
            mark.setPalette(self._colours)
        for axis, (strip, place) in enumerate(zip(self._strips, places, strict=True)):
            picture = QPixmap(round(place.width() * ratio), round(place.height() * ratio))
            picture.setDevicePixelRatio(ratio)
            with QPainter(picture) as painter:
                painter.translate(-place.x(), -place.y())
                painter.setFont(font)
                paint_ruler(painter, camera, palette, step, axis)
                if has_focus:
                    paint_frame(painter, (camera.width, camera.height), accent)
            strip.setGeometry(place)
            strip.setPixmap(picture)

    def mark(self, position: QPointF | None) -> None:
        """Mark a place of the sheet, or none."""
        breadth = SIZES.ruler
        if not self._marks:
            if position is None:
                return
            self._marks = [self._new_mark(strip) for strip in self._strips]
        for axis, mark in enumerate(self._marks):
            place = -1 if position is None else int((position.x(), position.y())[axis])
            if place < breadth:
                mark.hide()
            else:
                if axis == 0:
                    mark.setGeometry(place, 0, 1, breadth)
                else:
                    mark.setGeometry(0, place - breadth, breadth, 1)
                mark.show()

    def _new_mark(self, strip: QWidget) -> QWidget:
        mark = QWidget(strip)
        mark.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        mark.setAutoFillBackground(True)
        mark.setPalette(self._colours)
        return mark
