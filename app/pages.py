"""Exports that are pictures: PNG of contours, and the two formats that the core does not write.

They need no screen: Qt paints into memory, without fonts, also where there is no application.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from core import formats
from core.errors import NinepointError
from core.formats.contours import Contours
from core.formats.svg import page

if TYPE_CHECKING:
    from PySide6.QtGui import QImage

MAX_PIXELS: Final = 100_000_000
"""Largest number of pixels of a PNG: 400 MB while it is drawn."""

MAX_SIDE_PX: Final = 32_000
"""Longest side of a PNG; from 32,767 pixels on Qt does not draw any more."""

MM_PER_INCH: Final = 25.4

_NEARLY: Final = 1e-6
"""Part of a pixel that does not make a picture larger by one."""


def register_encoders() -> None:
    """Make PNG writable by `core.formats.export`; Qt is loaded when one is written."""
    formats.register("png", encode_png)


def picture_size(contours: Contours) -> tuple[int, int]:
    """Width and height of a PNG in pixels: the page, and room for all of its lines.

    Raises
    ------
    NinepointError
        If they are more than `MAX_PIXELS` or `MAX_SIDE_PX`; it tells the resolution that does.
    """
    profile = contours.profile
    inches = (page(contours)[1] * profile.unit_mm + profile.width_mm) / MM_PER_INCH
    width, height = (max(side * profile.dpi - _NEARLY, 1.0) for side in inches.tolist())
    too_large = max(width * height / MAX_PIXELS, (max(width, height) / MAX_SIDE_PX) ** 2)
    if too_large > 1:
        raise NinepointError(
            f"The picture would have {width:,.0f} x {height:,.0f} pixels, more than"
            f" {MAX_PIXELS // 10**6} million or {MAX_SIDE_PX:,} a side; choose at most"
            f" {_rounded_down(profile.dpi / math.sqrt(too_large)):g} dpi."
        )
    return math.ceil(width), math.ceil(height)


def encode_png(contours: Contours, title: str) -> bytes:
    """Bytes of a PNG file with its resolution and title.

    The page is that of SVG, larger by half a line's width on each side, so that no line is cut.

    Parameters
    ----------
    contours
        What to draw.
    title
        Title of the drawing.

    Raises
    ------
    NinepointError
        If there would be too many pixels.
    """
    from PySide6.QtCore import QBuffer
    from PySide6.QtGui import QImage

    image = _picture(contours)
    image.setText("Title", title)
    image.setText("Software", "Ninepoint")
    buffer = QBuffer()
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    if not image.save(buffer, "PNG"):  # type: ignore[call-overload]  # the stubs want bytes
        raise NinepointError("There is not enough memory for the picture; choose fewer dpi.")
    data = bytes(buffer.data().data())
    back = QImage.fromData(data)
    if back.size() != image.size() or back.dotsPerMeterX() != image.dotsPerMeterX():
        raise NinepointError("Read back, the picture is not the drawing. Nothing was written.")
    return data


def _picture(contours: Contours) -> QImage:
    from PySide6.QtCore import Qt
    from PySide6.QtGui import QColor, QImage, QPainter, QPen

    from app.export_paths import painter_paths

    profile = contours.profile
    width, height = picture_size(contours)
    forms = QImage.Format
    form = forms.Format_ARGB32_Premultiplied if profile.transparent else forms.Format_RGB32
    image = QImage(width, height, form)
    if image.isNull():
        raise NinepointError("There is not enough memory for the picture; choose fewer dpi.")
    dots = round(profile.dpi / MM_PER_INCH * 1000)
    image.setDotsPerMeterX(dots)
    image.setDotsPerMeterY(dots)
    image.fill(Qt.GlobalColor.transparent if profile.transparent else Qt.GlobalColor.white)
    scale = profile.dpi / MM_PER_INCH * profile.unit_mm
    origin, size = page(contours)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(QColor(profile.colour), profile.width_mm / profile.unit_mm * scale)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        # What is left of the last pixels lies evenly on both sides.
        painter.translate((width - size[0] * scale) / 2, (height - size[1] * scale) / 2)
        for contour in contours.contours:
            for path in painter_paths(contour.shape, origin, scale):
                painter.drawPath(path)
    return image


def _rounded_down(value: float) -> float:
    """Three significant digits of a number that is not to be exceeded."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return math.floor(value / unit) * unit
