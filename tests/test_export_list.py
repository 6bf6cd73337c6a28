import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.export_list import HEADINGS, ProfileList, described
from app.export_shelf import Offer, Place, titled
from core.profiles import PROFILES, named

BUILT_IN = [Offer(Place.BUILT_IN, profile) for profile in PROFILES.values()]
OWN = Offer(Place.OWN, titled(named("laser").within(0.05), "Workshop"))
DRAWN = Offer(Place.DRAWING, titled(named("points"), "Print shop"))


@pytest.fixture
def listed(qtbot):
    listed = ProfileList()
    qtbot.addWidget(listed)
    listed.show_offers([*BUILT_IN, OWN, DRAWN], OWN.key)
    listed.show()
    return listed


def texts(listed):
    return [listed.item(k).text() for k in range(listed.count())]


def test_profiles_stand_under_headings(listed):
    titles = [offer.profile.title for offer in BUILT_IN]
    assert texts(listed) == [
        *titles, HEADINGS[Place.OWN], "Workshop", HEADINGS[Place.DRAWING], "Print shop",
    ]  # fmt: skip
    assert listed.offer == OWN


def test_what_is_not_there_falls_back_to_the_first(listed):
    listed.show_offers(BUILT_IN, "own/gone")
    assert listed.offer == BUILT_IN[0]
    assert HEADINGS[Place.OWN] not in texts(listed)


def test_arrows_pass_over_headings(qtbot, listed):
    listed.setFocus()
    with qtbot.waitSignal(listed.chosen) as chosen:
        QTest.keyClick(listed, Qt.Key.Key_Down)
    assert chosen.args == [DRAWN]
    QTest.keyClick(listed, Qt.Key.Key_Up)
    QTest.keyClick(listed, Qt.Key.Key_Up)
    assert listed.offer == BUILT_IN[-1]


def test_letters_find_a_profile(listed):
    listed.setFocus()
    QTest.keyClicks(listed, "ink")
    assert listed.offer.profile.name == "svg"


def test_listing_tells_nothing(listed):
    chosen = []
    listed.chosen.connect(chosen.append)
    listed.show_offers([*BUILT_IN, OWN], BUILT_IN[3].key)
    assert chosen == []


def test_each_profile_says_what_it_is():
    assert described(BUILT_IN[0]) == named("laser").use
    assert described(OWN) == "DXF R2000, arcs, 0.05 mm"
    assert described(DRAWN) == "CSV, limit points, 0.01 mm"
