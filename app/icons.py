"""Line icons, drawn in the colour of the text around them, sharp at every screen density."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer

from app.assets import icon_path

SIZES_PX = (16, 20, 24)
"""Logical sizes at which icons are shown: menus, the tool bar, the tool bar of large styles."""

RATIOS = (1.0, 2.0, 3.0)
"""Device pixel ratios for which a picture is kept; Qt scales the next larger one for others."""

PLACEHOLDER_COLOUR = "currentColor"
"""What the drawings write where the colour of the text belongs."""


def tinted(name: str, palette: QPalette) -> QIcon:
    """Icon ``name`` in the colours of a palette: normal, disabled and switched on.

    An icon is a picture of one colour, so it is made anew when the palette changes.
    """
    drawing = icon_path(name).read_text(encoding="utf-8")
    role = QPalette.ColorRole.ButtonText
    normal = palette.color(QPalette.ColorGroup.Active, role)
    disabled = palette.color(QPalette.ColorGroup.Disabled, role)
    icon = QIcon()
    for mode, colour in ((QIcon.Mode.Normal, normal), (QIcon.Mode.Disabled, disabled)):
        renderer = QSvgRenderer(_coloured(drawing, colour))
        for size in SIZES_PX:
            for ratio in RATIOS:
                icon.addPixmap(_picture(renderer, size, ratio), mode)
    return icon


def program_icon() -> QIcon:
    """The program's own icon, which keeps its colours."""
    renderer = QSvgRenderer(str(icon_path("ninepoint")))
    icon = QIcon()
    for size in (16, 32, 48, 64, 128, 256):
        icon.addPixmap(_picture(renderer, size, 1.0))
    return icon


def _coloured(drawing: str, colour: QColor) -> QByteArray:
    return QByteArray(drawing.replace(PLACEHOLDER_COLOUR, colour.name()).encode())


def _picture(renderer: QSvgRenderer, size: int, ratio: float) -> QPixmap:
    picture = QPixmap(QSize(size, size) * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        renderer.render(painter, QRectF(0, 0, size, size))
    return picture
