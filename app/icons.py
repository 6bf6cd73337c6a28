"""Line icons, drawn in the colour of the text around them, sharp at every screen density."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Final

from PySide6.QtGui import QColor, QIcon, QPalette, QPixmap

from app.assets import icon_path

BAR_PX: Final = 20
"""Logical size of icons in the tool bar."""

SIZES_PX: Final = (16, BAR_PX)
"""All logical sizes at which icons are shown: in menus, and in the tool bar."""

PLACEHOLDER_COLOUR = "currentColor"
"""What the drawings write where the colour of the text belongs."""


MODES: Final = {
    QIcon.Mode.Normal: QPalette.ColorGroup.Active,
    QIcon.Mode.Disabled: QPalette.ColorGroup.Disabled,
}
"""Colours of the two modes in which icons are shown."""


def tinted(
    name: str,
    palette: QPalette,
    ratio: float,
    sizes_px: Sequence[int] = SIZES_PX,
    modes: Collection[QIcon.Mode] = tuple(MODES),
) -> QIcon:
    """Icon ``name`` in the colours of a palette.

    An icon is a picture of one colour and one density, so it is made anew when the palette changes
    or the window goes to another screen.

    Parameters
    ----------
    name
        Name of the drawing.
    palette
        Whose text the icon goes with.
    ratio
        Number of device pixels in a pixel.
    sizes_px
        Logical sizes that it is drawn in; Qt stretches it to others.
    modes
        Whether it is drawn normal, disabled or both; Qt makes the other one up.
    """
    drawing = icon_path(name).read_text(encoding="utf-8")
    icon = QIcon()
    for mode in modes:
        coloured = _coloured(drawing, palette.color(MODES[mode], QPalette.ColorRole.ButtonText))
        for size in sizes_px:
            icon.addPixmap(_picture(coloured, size, ratio), mode)
    return icon


def program_icon() -> QIcon:
    """The program's own icon, which keeps its colours; Qt draws it in the sizes that are shown."""
    return QIcon(str(icon_path("ninepoint")))


def _coloured(drawing: str, colour: QColor) -> str:
    return drawing.replace(PLACEHOLDER_COLOUR, colour.name())


def _picture(drawing: str, size: int, ratio: float) -> QPixmap:
    # Qt reads SVG as it reads any picture; its module for SVG takes 15 ms of the start to load, and
    # the classes that tell it how large it shall be 2 ms. The drawing tells it itself.
    side = round(size * ratio)
    sized = drawing.replace("<svg ", f'<svg width="{side}" height="{side}" ', 1)
    picture = QPixmap()
    picture.loadFromData(sized.encode(), "SVG")
    picture.setDevicePixelRatio(ratio)
    return picture
