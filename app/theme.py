"""The program's look: Fusion, coloured from the table in `app.style`, light or dark."""

from __future__ import annotations

import os
from typing import Final, Literal, get_args

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from app.style import DARK, LIGHT, Palette, palette_of

Theme = Literal["system", "light", "dark"]
"""What a user can ask for; "system" follows the desktop, also when it changes."""

SCHEMES: Final[dict[str, Qt.ColorScheme]] = {
    "system": Qt.ColorScheme.Unknown,
    "light": Qt.ColorScheme.Light,
    "dark": Qt.ColorScheme.Dark,
}

STYLE: Final = "Fusion"
"""Qt's name of the style."""

SELECTED_SHARE: Final = 0.22
"""How much accent there is in the ground of a selected row."""

DISABLED_SHARE: Final = 0.45
"""How much of the text's colour a disabled word keeps; the rest is its background's."""

WINDOW_SHARE: Final = {LIGHT: 0.04, DARK: 0.10}
"""How far the window stands off from the fields and the canvas in it, towards the text's colour."""

STRIPE_SHARE: Final = 0.035
"""The same for every second row of a table."""

BUTTON_SHARE: Final = {LIGHT: 0.0, DARK: 0.17}
"""The same for buttons: as bright as paper in the light, raised in the dark."""


MARK_SHARE: Final = {LIGHT: 0.5, DARK: 0.9}
"""The same for the rims of ticks and round marks, which Fusion draws half as bright as this."""

MARKED: Final = ("QRadioButton", "QCheckBox")
"""Widgets with such marks."""


def styled_application(name: str) -> QApplication:
    """The application in the style Fusion.

    It looks the same on every system, and draws all of itself from the palette.

    Parameters
    ----------
    name
        How the program was called.
    """
    present = QApplication.instance()
    if isinstance(present, QApplication):
        present.setStyle(STYLE)
        return present
    # Read at the first paint. Where a colour is seen through, Qt hands each 64 pieces of rows to a
    # pool of threads and waits for them, which for a line takes longer than to fill it: with ghost
    # and ribbon, a curve of 20 points follows the hand a third faster without.
    os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")
    # Asked for in words of the command line, because setStyle() returns the style, and to make a
    # Python class for that takes as long as ten panels: 9 ms before the first paint.
    return QApplication([name, "-style", STYLE])


_ROLE = QPalette.ColorRole


class Look(QObject):
    """Keeps the application's palette in step with the colour scheme.

    Parameters
    ----------
    application
        The application.
    theme
        The colour scheme asked for.
    """

    def __init__(self, application: QApplication, theme: str = "system") -> None:
        if theme not in get_args(Theme):
            raise ValueError(f"theme must be one of {get_args(Theme)}, not {theme!r}")
        super().__init__(application)
        self._application = application
        self._theme = theme
        hints = application.styleHints()
        hints.setColorScheme(SCHEMES[theme])
        hints.colorSchemeChanged.connect(self._colour)
        self._colour()

    def _colour(self) -> None:
        scheme = SCHEMES[self._theme]
        if scheme == Qt.ColorScheme.Unknown:
            scheme = self._application.styleHints().colorScheme()
        colours = palette_of(scheme)
        palette = window_palette(colours)
        self._application.setPalette(palette)
        # Fusion takes the rims from the window's colour: in the dark they would not be seen.
        text, window = palette.color(_ROLE.WindowText), palette.color(_ROLE.Window)
        palette.setColor(_ROLE.Window, blended(text, window, MARK_SHARE[colours]))
        for name in MARKED:
            self._application.setPalette(palette, name)  # type: ignore[arg-type]  # no bytes


def window_palette(colours: Palette) -> QPalette:
    """Qt palette of menus, docks, buttons and fields, derived from the canvas's colours."""
    roles = QPalette.ColorRole
    text, accent = QColor(colours.text), QColor(colours.accent)
    base = QColor(colours.background)
    window = blended(text, base, WINDOW_SHARE[colours])
    button = blended(text, base, BUTTON_SHARE[colours])
    faded = blended(text, window, DISABLED_SHARE)
    palette = QPalette(button, window)
    for role, colour in (
        (roles.Window, window),
        (roles.WindowText, text),
        (roles.Base, base),
        (roles.AlternateBase, blended(text, base, STRIPE_SHARE)),
        (roles.Text, text),
        (roles.PlaceholderText, QColor(colours.muted_text)),
        (roles.Button, button),
        (roles.ButtonText, text),
        (roles.BrightText, QColor(colours.warning)),
        (roles.ToolTipBase, base),
        (roles.ToolTipText, text),
        (roles.Highlight, accent),
        (roles.HighlightedText, base),
        (roles.Accent, accent),
        (roles.Link, accent),
        (roles.LinkVisited, accent),
    ):
        palette.setColor(role, colour)
    disabled = QPalette.ColorGroup.Disabled
    for role in (roles.WindowText, roles.Text, roles.ButtonText, roles.PlaceholderText):
        palette.setColor(disabled, role, faded)
    palette.setColor(disabled, roles.Highlight, faded)
    return palette


def soften(view: QWidget) -> None:
    """Give a list or table a quiet mark of selection: the canvas beside it has the loud ones.

    To be called again when the palette changes.
    """
    application = QApplication.palette(view)
    base = application.color(QPalette.ColorRole.Base)
    accent = application.color(QPalette.ColorRole.Accent)
    quiet = QPalette()
    quiet.setColor(QPalette.ColorRole.Highlight, blended(accent, base, SELECTED_SHARE))
    text = application.color(QPalette.ColorRole.Text)
    quiet.setColor(QPalette.ColorRole.HighlightedText, text)
    view.setPalette(quiet)


def blended(first: QColor, second: QColor, share: float) -> QColor:
    """The colour between two, with ``share`` (0 to 1) of the first."""
    rest = 1 - share
    return QColor.fromRgbF(
        first.redF() * share + second.redF() * rest,
        first.greenF() * share + second.greenF() * rest,
        first.blueF() * share + second.blueF() * rest,
    )
