"""The colours keep their contrasts in both schemes."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QWidget

from app.style import DARK, LIGHT, SIZES, Palette, color, contrast, palette_of

LINES = (
    "axis",
    "polygon",
    "point",
    "point_selected",
    "curve",
    "curve_active",
    "hover",
    "rubber_band",
    "ghost",
    "influence",
    "accent",
)
TEXTS = ("text", "muted_text", "warning")
PLOT_LINES = ("plot_curve",)
PLOT_TEXTS = ("plot_annotation", "text", "muted_text")

both = pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])


@both
@pytest.mark.parametrize("name", LINES)
def test_lines_and_handles_stand_out_from_the_canvas(palette: Palette, name: str) -> None:
    assert contrast(getattr(palette, name), palette.background) >= 3.0


@both
@pytest.mark.parametrize("name", TEXTS)
def test_text_is_readable_on_the_canvas(palette: Palette, name: str) -> None:
    assert contrast(getattr(palette, name), palette.background) >= 4.5


@both
def test_ruler_text_is_readable_on_the_ruler(palette: Palette) -> None:
    assert contrast(palette.ruler_text, palette.ruler_background) >= 4.5


@both
def test_plots_are_readable(palette: Palette) -> None:
    for name in PLOT_LINES:
        assert contrast(getattr(palette, name), palette.plot_background) >= 3.0
        assert contrast(getattr(palette, name), palette.plot_fill) >= 3.0
    for name in PLOT_TEXTS:
        assert contrast(getattr(palette, name), palette.plot_background) >= 4.5


@both
def test_the_grid_stays_behind_the_drawing(palette: Palette) -> None:
    major = contrast(palette.grid_major, palette.background)
    assert contrast(palette.grid, palette.background) < major < 2.0


@both
def test_the_active_curve_stands_out_from_the_others(palette: Palette) -> None:
    active = contrast(palette.curve_active, palette.background)
    assert active > 1.5 * contrast(palette.curve, palette.background)


@both
def test_opposites_differ_by_more_than_red_against_green(palette: Palette) -> None:
    # Red-green blindness leaves the blue-yellow axis: blue minus the mean of red and green.
    def blueness(value: str) -> float:
        c = QColor(value)
        return c.blueF() - (c.redF() + c.greenF()) / 2

    assert blueness(palette.point) > 0.2
    assert blueness(palette.influence) < -0.2
    assert blueness(palette.warning) < -0.2


@both
def test_every_entry_is_an_opaque_colour(palette: Palette) -> None:
    for name, value in palette._asdict().items():
        assert re.fullmatch(r"#[0-9a-f]{6}", value), name


def test_contrast_of_black_and_white_is_21() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#777777") == pytest.approx(1.0)


def test_palette_of_a_scheme() -> None:
    assert palette_of(Qt.ColorScheme.Dark) is DARK
    assert palette_of(Qt.ColorScheme.Light) is LIGHT
    assert palette_of(Qt.ColorScheme.Unknown) is LIGHT


def test_palette_of_a_widget(qtbot: object) -> None:
    widget = QWidget()
    qtbot.addWidget(widget)  # type: ignore[attr-defined]
    colours = QPalette()
    colours.setColor(QPalette.ColorRole.Window, QColor("#202020"))
    colours.setColor(QPalette.ColorRole.WindowText, QColor("#f0f0f0"))
    widget.setPalette(colours)
    assert palette_of(widget) is DARK
    colours.setColor(QPalette.ColorRole.Window, QColor("#ffffff"))
    colours.setColor(QPalette.ColorRole.WindowText, QColor("#000000"))
    widget.setPalette(colours)
    assert palette_of(widget) is LIGHT


def test_color_carries_its_opacity() -> None:
    assert color(LIGHT.accent).alpha() == 255
    assert color(LIGHT.accent, 0.5).alphaF() == pytest.approx(0.5, abs=0.01)


def test_points_are_easy_to_hit() -> None:
    assert SIZES.hit_point >= 10.0
    assert SIZES.drag_start <= 3.0
