import pytest
from PySide6.QtGui import QPalette

from app.export_picture import drawn
from app.export_preview import ExportPreview
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.formats import prepare
from core.profiles import named
from drawings import letter_f


@pytest.fixture
def preview(qtbot):
    preview = ExportPreview()
    qtbot.addWidget(preview)
    preview.setPalette(window_palette(LIGHT))
    preview.resize(400, 300)
    preview.show()
    qtbot.waitExposed(preview)
    return preview


def picture(preview):
    return drawn(prepare(letter_f(), named("svg")), None, preview.look)


def test_a_picture_is_asked_for_in_the_size_that_is_seen(qtbot, preview):
    with qtbot.waitSignal(preview.outdated):
        preview.resize(500, 200)
    look = preview.look
    assert (look.width, look.height, look.palette) == (500, 200, LIGHT)


def test_another_colour_scheme_asks_too(qtbot, preview):
    with qtbot.waitSignal(preview.outdated):
        preview.setPalette(window_palette(DARK))
    assert preview.look.palette is DARK
    assert preview.palette().color(QPalette.ColorRole.Window).lightness() < 100


def test_the_picture_is_shown_with_its_size_around_it(preview):
    shown = picture(preview)
    preview.show_picture(shown)
    image = preview.grab().toImage()
    middle = shown.frame.center()
    assert image.pixelColor(int(middle.x()), int(middle.y())).name() == "#ffffff"
    below = [
        image.pixelColor(x, y).lightness()
        for x in range(int(middle.x()) - 20, int(middle.x()) + 20)
        for y in range(int(shown.frame.bottom()) + 10, 298)
    ]
    assert min(below) < 150
    assert preview.accessibleDescription() == f"{shown.width} wide, {shown.height} high"
    assert shown.height == "50.00 mm"


def test_without_a_new_picture_the_last_one_stays(preview):
    shown = picture(preview)
    preview.show_picture(shown)
    preview.show_picture(None)
    assert preview.picture is shown
    preview.resize(600, 450)
    assert preview.picture is shown
    assert not preview.grab().isNull()
