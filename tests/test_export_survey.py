import msgspec
import numpy as np
import pytest

from app.export_picture import Look
from app.export_survey import NO_MEMORY, Survey, Surveyor, described
from core.document import Curve, Document
from core.errors import NinepointError
from core.formats import export, survey
from core.profiles import named
from drawings import letter_f

SQUARE = Document((Curve([(0, 0), (40, 0), (40, 30), (0, 30)]),))
LOOK = Look(300, 200, 1.0)


@pytest.fixture
def surveyor(qtbot):
    surveyor = Surveyor()
    yield surveyor
    surveyor.stop()


@pytest.mark.parametrize("name", ["laser", "svg", "points", "pdf"])
def test_a_survey_says_what_the_core_says(name):
    found = Survey.of(SQUARE, named(name))
    assert found.is_possible
    assert found.words == described(survey(SQUARE, named(name)))
    assert found.content.profile == named(name)
    assert found.original is None


def test_it_is_what_the_file_then_holds(tmp_path):
    found = Survey.of(letter_f(), named("svg"))
    report = export(letter_f(), tmp_path / "f.svg", named("svg"))
    assert found.words == described(report)


def test_words_keep_numbers_and_units_together():
    found = Survey.of(letter_f(), named("svg"))
    words = found.words
    wide, tall = (f"{size:.2f}" for size in np.subtract(*found.content.box[::-1]))
    count = sum(len(contour.shape.controls) for contour in found.content.contours)
    start = f"{wide}\u00a0\u00d7\u00a0{tall} mm, 2 contours, 1 of them closed, {count} cubics"
    assert words.startswith(start)
    assert words.endswith("deviation\u00a0\u2264\u00a00.01\u00a0mm")
    table = msgspec.structs.replace(named("points"), entity="control points")
    size = "40.00\u00a0\u00d7\u00a030.00 mm"
    assert Survey.of(SQUARE, table).words == f"{size}, closed, 4 control points"


def test_a_picture_tells_its_pixels_and_is_refused_if_too_large():
    assert "dpi" not in Survey.of(SQUARE, named("png")).words
    assert Survey.of(SQUARE, named("png")).words.endswith(" pixels")
    fine = msgspec.structs.replace(named("png"), dpi=10_000.0)
    found = Survey.of(SQUARE, fine)
    assert not found.is_possible
    assert "choose at most" in found.words


def test_notes_are_those_of_the_report():
    found = Survey.of(SQUARE, named("laser-r12"))
    assert found.notes == survey(SQUARE, named("laser-r12")).notes
    assert "states no unit" in found.notes[0]


def test_with_a_kerf_the_outline_without_it_is_kept():
    found = Survey.of(SQUARE, msgspec.structs.replace(named("laser-r12"), kerf_mm=1.0))
    assert found.original.profile == named("laser-r12")
    bare = found.original.size_mm
    assert found.content.size_mm == pytest.approx((bare[0] + 2, bare[1] + 2), abs=0.05)


def test_what_cannot_be_written_is_a_sentence():
    found = Survey.of(Document(), named("laser"))
    assert not found.is_possible
    assert found.words.startswith("There is nothing to export")
    assert found.content is None


def test_a_full_memory_is_a_sentence(monkeypatch):
    def full(document, profile):
        raise MemoryError

    monkeypatch.setattr("app.export_survey.prepare", full)
    assert Survey.of(SQUARE, named("laser")).words == NO_MEMORY


def test_the_window_does_not_wait(qtbot, surveyor):
    found, pictures = [], []
    surveyor.found.connect(found.append)
    surveyor.pictured.connect(pictures.append)
    with qtbot.waitSignal(surveyor.pictured):
        surveyor.ask(SQUARE, named("svg"), LOOK)
        assert found == []
        assert surveyor.is_busy
    assert found[0].document is SQUARE
    assert pictures[0].image.width() == 300
    assert not surveyor.is_busy


def test_of_many_questions_the_last_is_answered(qtbot, surveyor):
    found = []
    surveyor.found.connect(found.append)
    for tolerance in (0.1, 0.2, 0.3, 0.4, 0.5):
        surveyor.ask(SQUARE, named("svg").within(tolerance), LOOK)
    qtbot.waitUntil(lambda: not surveyor.is_busy)
    assert found[-1].profile.tolerance_mm == 0.5
    assert len(found) == 1


def test_another_size_draws_the_known_survey_again(qtbot, surveyor, monkeypatch):
    with qtbot.waitSignal(surveyor.pictured):
        surveyor.ask(SQUARE, named("svg"), LOOK)

    def never(document, profile):
        raise NinepointError("made again")

    monkeypatch.setattr("app.export_survey.prepare", never)
    found = []
    surveyor.found.connect(found.append)
    with qtbot.waitSignal(surveyor.pictured) as pictured:
        surveyor.ask(SQUARE, named("svg"), Look(500, 200, 1.0))
    assert found[-1].is_possible
    assert pictured.args[0].image.width() == 500


def test_without_content_there_is_no_picture(qtbot, surveyor):
    with qtbot.waitSignal(surveyor.pictured) as pictured:
        surveyor.ask(Document(), named("svg"), LOOK)
    assert pictured.args == [None]
