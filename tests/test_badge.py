import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QSizePolicy, QVBoxLayout, QWidget

from app.analysis import Finding
from app.badge import UNKNOWN, Badge
from app.guard import guarded
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.continuity import Certificate, Smoothness, smoothness
from core.family import PRESETS, Parameters
from core.hoelder import HoelderInterval


def mark_of(badge):
    """The colour in the lower left part of the mark, whatever it is."""
    image = badge.grab().toImage()
    rows = [y for y in range(badge.height()) if image.pixel(4, y) != image.pixel(4, 0)]
    return image.pixelColor(4, rows[-2]).name()


@pytest.fixture
def badge(qtbot):
    badge = Badge()
    qtbot.addWidget(badge)
    badge.resize(280, 44)
    badge.show()
    return badge


def found(parameters):
    return Finding(parameters, smoothness(parameters.mask))


UNDECIDED = Finding(
    Parameters(2, 0, 0),
    Smoothness(Certificate(None, None, None), HoelderInterval(-0.01, 0.02, "0"), 1),
)


def test_before_the_first_finding_nothing_is_claimed(badge):
    assert badge.sentence == UNKNOWN


def test_what_is_proven_is_told(badge):
    badge.show_finding(found(PRESETS["Calm"]))
    assert badge.statement == "C\u00b3 proven, not C\u2074"
    assert badge.detail == found(PRESETS["Calm"]).exponent
    assert badge.sentence == "C\u00b3 proven, not C\u2074 \u00b7 " + badge.detail
    assert badge.sentence in badge.toolTip()
    assert not badge.warns


@pytest.mark.parametrize(
    ("finding", "words"),
    [
        (found(Parameters(10, 0, 0)), "Does not converge, proven"),
        (found(Parameters(1, 0, -1, "mirrored")), "Does not converge, proven"),
        (UNDECIDED, "Convergence undecided"),
    ],
)
@pytest.mark.parametrize("colours", [LIGHT, DARK])
def test_a_warning_is_words_a_mark_and_a_colour(badge, finding, words, colours):
    QApplication.setPalette(window_palette(colours))
    QApplication.processEvents()
    badge.show_finding(finding)
    assert badge.statement == words
    assert badge.detail == "Drawn at a finite level"
    assert badge.warns
    assert badge.ink.name() == colours.warning
    badge.show_finding(found(PRESETS["Tight"]))
    assert not badge.warns
    assert badge.ink.name() == colours.text


def test_another_colour_scheme_reaches_the_warning(badge):
    badge.show_finding(found(Parameters(10, 0, 0)))
    for colours in (DARK, LIGHT):
        QApplication.setPalette(window_palette(colours))
        QApplication.processEvents()
        assert badge.ink.name() == colours.warning
        assert mark_of(badge) == colours.warning


def test_long_words_do_not_widen_the_panel(badge):
    before = badge.minimumSizeHint()
    badge.show_finding(found(PRESETS["Calm"]))
    assert badge.minimumSizeHint() == before
    assert badge.sizePolicy().horizontalPolicy() is QSizePolicy.Policy.Ignored


def test_words_that_do_not_fit_are_cut_with_dots_and_stay_in_the_tip(badge):
    """The last column that has ink lies within the badge, and differs from that of a wide one."""
    badge.show_finding(found(PRESETS["Calm"]))
    badge.resize(90, 44)
    image = badge.grab().toImage()
    ground = image.pixel(89, 0)
    assert all(image.pixel(89, y) == ground for y in range(44))
    assert "not C\u2074" in badge.toolTip()


def test_other_words_leave_the_layout_of_the_window_alone(qtbot):
    """Labels would have all panels laid out anew, half a millisecond a move of a slider."""
    panel = QWidget()
    qtbot.addWidget(panel)
    badge = Badge()
    QVBoxLayout(panel).addWidget(badge)
    panel.show()
    QApplication.processEvents()
    asked = []

    class Heard(QObject):
        @guarded
        def eventFilter(self, watched, event):  # noqa: N802
            if event.type() == QEvent.Type.LayoutRequest:
                asked.append(watched)
            return False

    heard = Heard()
    panel.installEventFilter(heard)
    badge.show_finding(found(PRESETS["Tight"]))
    QApplication.processEvents()
    assert badge.statement == found(PRESETS["Tight"]).statement
    assert not asked
