"""Every colour, pen width and size that the program draws with; one frozen table per scheme.

Lines and handles stand out from their background by a contrast of at least 3:1 (WCAG 2.1, 1.4.11),
text by at least 4.5:1 (1.4.3); the quiet tints (grid, fills) may be fainter, because nothing
depends on seeing them. Opposites are told apart as blue and orange, never as red and green alone.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget


class Palette(NamedTuple):
    """Colours of one scheme, each ``"#rrggbb"``: what Qt, pyqtgraph and SVG all read.

    Attributes
    ----------
    background
        The canvas.
    grid, grid_major, axis
        Lines of the background grid, of its labelled steps, and the two lines through the origin.
    ruler_background, ruler_line, ruler_text
        The rulers along the canvas.
    polygon, point, point_fill, point_selected
        The control polygon; the rim and the inside of a control point; a selected control point.
    curve, curve_active
        Limit curves, and the one that new points go to.
    hover
        What the mouse would take: a control point's ring, the place on the curve.
    rubber_band
        The selection rectangle.
    ghost
        The shape before the drag.
    influence
        How far the moved points reach along the curve.
    plot_background, plot_grid, plot_curve, plot_fill, plot_annotation
        The analysis plots.
    text, muted_text
        Words on the canvas and the plots.
    accent, warning
        The colour of the program; what needs attention (always with words or a mark).
    """

    background: str
    grid: str
    grid_major: str
    axis: str
    ruler_background: str
    ruler_line: str
    ruler_text: str
    polygon: str
    point: str
    point_fill: str
    point_selected: str
    curve: str
    curve_active: str
    hover: str
    rubber_band: str
    ghost: str
    influence: str
    plot_background: str
    plot_grid: str
    plot_curve: str
    plot_fill: str
    plot_annotation: str
    text: str
    muted_text: str
    accent: str
    warning: str


LIGHT: Final = Palette(
    background="#fbfbfc",
    grid="#f0f1f4",
    grid_major="#e2e5ea",
    axis="#88909e",
    ruler_background="#f3f4f6",
    ruler_line="#c9ced6",
    ruler_text="#5b6472",
    polygon="#8490a2",
    point="#2f6fe0",
    point_fill="#ffffff",
    point_selected="#1d5bd0",
    curve="#747d8b",
    curve_active="#161a21",
    hover="#0a7fd9",
    rubber_band="#2f6fe0",
    ghost="#888f9c",
    influence="#d2690a",
    plot_background="#fbfbfc",
    plot_grid="#e2e5ea",
    plot_curve="#1d5bd0",
    plot_fill="#dbe6fb",
    plot_annotation="#b04f00",
    text="#1b2028",
    muted_text="#5b6472",
    accent="#2f6fe0",
    warning="#a84300",
)
"""Ink on paper: a near-white ground, a near-black curve, blue handles."""

DARK: Final = Palette(
    background="#1c1e22",
    grid="#24272c",
    grid_major="#2f333a",
    axis="#6f7887",
    ruler_background="#22252a",
    ruler_line="#3d424b",
    ruler_text="#9aa3b1",
    polygon="#778294",
    point="#6ea4ff",
    point_fill="#1c1e22",
    point_selected="#8ab6ff",
    curve="#8e97a5",
    curve_active="#f2f4f8",
    hover="#5cc0ff",
    rubber_band="#6ea4ff",
    ghost="#727b89",
    influence="#f0923a",
    plot_background="#1c1e22",
    plot_grid="#2f333a",
    plot_curve="#7fb0ff",
    plot_fill="#26365a",
    plot_annotation="#f5a75c",
    text="#eceff4",
    muted_text="#9aa3b1",
    accent="#6ea4ff",
    warning="#ffb066",
)
"""The same in the dark: a deep grey ground, a near-white curve, light blue handles."""


class Sizes:
    """Lengths in logical pixels; the same in both schemes.

    Attributes
    ----------
    curve_width, calm_width, polygon_width
        Pens of the active limit curve, of the others, and of the control polygon.
    point_radius, selected_radius, dot_radius, rim_width
        A control point, a selected one, a point in a crowd, and the rim of a point.
    crowd_spacing
        Below this mean distance between neighbours, points are drawn as dots.
    ribbon_width
        Half width of the ribbon of influence where the curve follows the hand in full.
    ruler
        Breadth of the rulers.
    label_spacing, minor_spacing
        Least distance between labelled ticks of a ruler, and between any two.
    fit_margin
        Free border around a drawing that is fitted.
    hit_point, hit_curve, hit_edge
        How far from a control point, from the curve, and from an edge of the polygon a click
        still takes it.
    drag_start
        A press becomes a drag when the mouse is this far away.
    """

    curve_width: Final = 2.0
    calm_width: Final = 1.5
    polygon_width: Final = 1.0
    point_radius: Final = 3.5
    selected_radius: Final = 4.5
    dot_radius: Final = 1.5
    rim_width: Final = 1.5
    crowd_spacing: Final = 9.0
    ribbon_width: Final = 9.0
    ruler: Final = 24
    label_spacing: Final = 80.0
    minor_spacing: Final = 9.0
    fit_margin: Final = 56.0
    hit_point: Final = 10.0
    hit_curve: Final = 6.0
    hit_edge: Final = 6.0
    drag_start: Final = 3.0


SIZES: Final = Sizes()
"""The sizes that the program uses."""


def palette_of(source: QWidget | Qt.ColorScheme) -> Palette:
    """Palette of a colour scheme, or of the scheme that a widget is shown in.

    A widget counts as dark when its window colour is darker than its text, which holds for every
    style and platform theme, known to Qt's colour scheme or not.
    """
    if isinstance(source, QWidget):
        colours = source.palette()
        window, text = colours.window().color(), colours.windowText().color()
        return DARK if window.lightness() < text.lightness() else LIGHT
    return DARK if source == Qt.ColorScheme.Dark else LIGHT


def color(value: str, opacity: float = 1.0) -> QColor:
    """Qt's colour of a palette entry, with an opacity from 0 to 1."""
    result = QColor(value)
    result.setAlphaF(opacity)
    return result


def contrast(first: str, second: str) -> float:
    """Contrast ratio of two colours, 1 to 21 (WCAG 2.1, relative luminance)."""
    light, dark = sorted((_luminance(first), _luminance(second)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(value: str) -> float:
    """Relative luminance of an sRGB colour (WCAG 2.1, definition)."""
    channels = (int(value[i : i + 2], 16) / 255 for i in (1, 3, 5))
    red, green, blue = (
        c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
