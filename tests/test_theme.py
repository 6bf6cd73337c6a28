import os
import subprocess
import sys

import pytest
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QRadioButton,
    QStyle,
    QStyleOptionButton,
    QWidget,
)

from app.style import DARK, LIGHT, contrast, palette_of
from app.theme import Look, blended, styled_application, window_palette

Role = QPalette.ColorRole
TEXT_CONTRAST = 4.5  # WCAG 2.1, 1.4.3
MARK_CONTRAST = 3.0  # WCAG 2.1, 1.4.11


@pytest.mark.parametrize("colours", [LIGHT, DARK])
@pytest.mark.parametrize(
    ("ink", "ground"),
    [
        (Role.WindowText, Role.Window),
        (Role.Text, Role.Base),
        (Role.Text, Role.AlternateBase),
        (Role.ButtonText, Role.Button),
        (Role.PlaceholderText, Role.Window),
        (Role.HighlightedText, Role.Highlight),
        (Role.ToolTipText, Role.ToolTipBase),
    ],
)
def test_words_can_be_read(colours, ink, ground):
    palette = window_palette(colours)
    assert contrast(palette.color(ink).name(), palette.color(ground).name()) >= TEXT_CONTRAST


@pytest.mark.parametrize("colours", [LIGHT, DARK])
def test_a_disabled_word_is_fainter_than_the_others(colours):
    palette = window_palette(colours)
    window = palette.color(Role.Window).name()
    normal = palette.color(QPalette.ColorGroup.Active, Role.WindowText).name()
    faded = palette.color(QPalette.ColorGroup.Disabled, Role.WindowText).name()
    assert contrast(faded, window) < contrast(normal, window) / 2


@pytest.mark.parametrize(("theme", "colours"), [("light", LIGHT), ("dark", DARK)])
def test_a_theme_reaches_every_widget(qtbot, theme, colours):
    look = Look(QApplication.instance(), theme)
    widget = QWidget()
    qtbot.addWidget(widget)
    assert palette_of(widget) is colours
    look.deleteLater()


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("kind", [QCheckBox, QRadioButton])
def test_a_mark_that_is_off_can_be_seen(qtbot, theme, kind):
    styled_application("ninepoint")
    look = Look(QApplication.instance(), theme)
    button = kind("Words")
    qtbot.addWidget(button)
    button.ensurePolished()
    option = QStyleOptionButton()
    button.initStyleOption(option)
    part = QStyle.SubElement.SE_CheckBoxIndicator
    mark = button.style().subElementRect(part, option, button)
    picture = button.grab(mark).toImage()
    ground = QApplication.palette().color(Role.Window).name()
    seen = [
        contrast(picture.pixelColor(x, y).name(), ground)
        for x in range(picture.width())
        for y in range(picture.height())
    ]
    # The rim is some 40 pixels long; a disc that is hardly darker than the window does not count.
    assert sum(ratio >= MARK_CONTRAST for ratio in seen) >= 20
    look.deleteLater()


def test_the_style_is_the_same_on_every_system(qtbot):
    application = QApplication.instance()
    application.setStyle("Windows")
    assert styled_application("ninepoint") is application
    assert application.style().name() == "fusion"
    code = (
        "from app.theme import styled_application;"
        "application = styled_application('ninepoint');"
        "print(application.style().name(), application.arguments())"
    )
    # A style that the user's environment names must not win either.
    environment = {**os.environ, "QT_STYLE_OVERRIDE": "windows"}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout == "fusion ['ninepoint']\n"


PAINT = """
from pathlib import Path
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPixmap
from app.theme import styled_application

application = styled_application("ninepoint")
picture = QPixmap(400, 400)
picture.fill(Qt.GlobalColor.white)
path = QPainterPath()
path.addEllipse(QPointF(200, 200), 190, 190)
with QPainter(picture) as painter:
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillPath(path, QColor(0, 0, 0, 99))  # what is seen through is what Qt shares out
tasks = Path("/proc/self/task")  # where there is none, nothing can be seen
print([name for task in tasks.glob("*/comm") if "pooled" in (name := task.read_text())])
"""


def test_no_thread_of_qt_helps_to_paint(qtbot):
    """Such help is for large pictures; handing a line over takes longer than drawing it."""
    alone = {name: value for name, value in os.environ.items() if "THREADPOOL" not in name}
    done = subprocess.run(
        [sys.executable, "-c", PAINT], env=alone, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"


def test_an_unknown_theme_is_refused(qtbot):
    with pytest.raises(ValueError, match="theme"):
        Look(QApplication.instance(), "sepia")


def test_blending_lies_between():
    black, white = QColor("#000000"), QColor("#ffffff")
    assert blended(black, white, 1).name() == "#000000"
    assert blended(black, white, 0).name() == "#ffffff"
    assert blended(black, white, 0.5).lightness() == pytest.approx(127, abs=1)
