import msgspec
import pytest

from app.export_shelf import NAMELESS, Offer, Place, Shelf, titled
from app.session import Session
from app.settings import Settings
from core.document import Curve, Document
from core.errors import NinepointError
from core.profiles import MAX_NAME, PROFILES, named

THIN = titled(named("svg"), "Thin lines")


@pytest.fixture
def session():
    return Session(Document((Curve([(0, 0), (10, 0), (5, 8)]),)))


@pytest.fixture
def shelf(session):
    return Shelf(session, Settings())


def keys(shelf):
    return [offer.key for offer in shelf.offers]


def test_at_first_there_is_what_is_built_in_the_laser_first(shelf):
    assert keys(shelf) == [f"built-in/{name}" for name in PROFILES]
    assert keys(shelf)[0] == "built-in/laser"


def test_profiles_are_kept_in_the_settings_and_replaced_by_name(shelf, session):
    shelf.keep(THIN, Place.OWN)
    offer = shelf.keep(THIN.within(0.5), Place.OWN)
    assert shelf.offers[-1] == offer == Offer(Place.OWN, THIN.within(0.5))
    assert keys(shelf).count("own/thin-lines") == 1
    assert not session.is_modified
    shelf.delete(offer)
    assert keys(shelf) == [f"built-in/{name}" for name in PROFILES]


def test_a_profile_in_the_drawing_is_one_step_of_undo(shelf, session):
    before = session.document
    offer = shelf.keep(THIN, Place.DRAWING)
    assert session.document.profiles == (THIN,)
    assert session.document.curves is before.curves
    assert session.undo_name == "Save profile Thin lines"
    shelf.delete(offer)
    assert session.document.profiles == ()
    session.undo()
    assert keys(shelf)[-1] == "drawing/thin-lines"
    session.undo()
    assert session.document is before


def test_what_is_built_in_cannot_be_deleted(shelf):
    shelf.delete(shelf.offers[0])
    assert keys(shelf)[0] == "built-in/laser"


def test_the_same_name_in_two_places_is_two_profiles(shelf):
    for place in (Place.OWN, Place.DRAWING):
        shelf.keep(THIN, place)
    assert keys(shelf)[-2:] == ["own/thin-lines", "drawing/thin-lines"]


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("Thin lines", "thin-lines"),
        ("  Laser \u00d72,  0.1 mm ", "laser-2-0-1-mm"),
        ("D\u00fcnn \u00c9t\u00e9", "dunn-ete"),
        ("\u540d\u524d", NAMELESS),
        ("x" * MAX_NAME, "x" * MAX_NAME),
        ("\u00c5" * MAX_NAME, "a" * MAX_NAME),
    ],
)
def test_a_title_gives_a_name_for_the_command_line(title, name):
    profile = titled(named("laser"), title)
    assert profile.name == name
    assert profile.title == " ".join(title.split())
    rest = {"name": "laser", "title": "Laser / CNC", "use": named("laser").use}
    assert msgspec.structs.replace(profile, **rest) == named("laser")


@pytest.mark.parametrize("title", ["", "   ", "x" * (MAX_NAME + 1), "a\x07b"])
def test_a_title_that_cannot_be_is_refused(title):
    with pytest.raises(NinepointError, match=r"title|Title"):
        titled(named("laser"), title)
