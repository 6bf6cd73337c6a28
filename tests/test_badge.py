import pytest
from PySide6.QtWidgets import QApplication

from app.analysis import Finding
from app.badge import UNKNOWN, Badge
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.continuity import Certificate, Smoothness, smoothness
from core.family import PRESETS, Parameters
from core.hoelder import HoelderInterval


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
    assert badge.statement.text() == "C\u00b3 proven, not C\u2074"
    assert badge.detail.text() == found(PRESETS["Calm"]).exponent
    assert badge.sentence == "C\u00b3 proven, not C\u2074 \u00b7 " + badge.detail.text()
    assert badge.sentence in badge.toolTip()
    assert not badge.mark.warns


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
    assert badge.statement.text() == words
    assert badge.detail.text() == "Drawn at a finite level"
    assert badge.mark.warns
    assert badge.statement.palette().windowText().color().name() == colours.warning
    badge.show_finding(found(PRESETS["Tight"]))
    assert not badge.mark.warns
    assert badge.statement.palette().windowText().color().name() == colours.text


def test_another_colour_scheme_reaches_the_warning(badge):
    badge.show_finding(found(Parameters(10, 0, 0)))
    for colours in (DARK, LIGHT):
        QApplication.setPalette(window_palette(colours))
        QApplication.processEvents()
        assert badge.statement.palette().windowText().color().name() == colours.warning
        middle = badge.mark.grab().toImage().pixelColor(8, 4)
        assert middle.name() == colours.warning


def test_long_words_do_not_widen_the_panel(badge):
    before = badge.minimumSizeHint().width()
    badge.statement.setText("word " * 50)
    assert badge.minimumSizeHint().width() == before
