import pytest

from answers import Answers
from app.dialogs import Answer
from app.files import UNTITLED, Files
from app.opening import ready_document
from app.session import Session
from app.settings import Settings
from core.errors import FileError
from core.family import PRESETS
from core.formats import open_document


@pytest.fixture
def session():
    return Session(ready_document())


@pytest.fixture
def answers():
    return Answers()


@pytest.fixture
def settings():
    return Settings()


@pytest.fixture
def files(qtbot, session, settings, answers):
    return Files(session, settings, answers)


def change(session, name="Tight"):
    session.edit(session.document.with_parameters(PRESETS[name]), f"Preset {name}")


def same(first, second):
    return first.parameters == second.parameters and all(
        (a.points == b.points).all() and (a.closed, a.name) == (b.closed, b.name)
        for a, b in zip(first.curves, second.curves, strict=True)
    )


def test_save_asks_for_a_name_once(files, session, answers, tmp_path):
    answers.path = tmp_path / "wing.ninepoint"
    change(session)
    assert files.save()
    assert answers.suggested[-1].name == UNTITLED + ".ninepoint"
    assert files.title == "wing.ninepoint"
    assert not session.is_modified
    change(session, "Lean")
    answers.path = None
    assert files.save()
    assert len(answers.suggested) == 1
    assert same(open_document(tmp_path / "wing.ninepoint"), session.document)


def test_a_name_without_suffix_gets_it(files, session, answers, tmp_path):
    answers.path = tmp_path / "wing.v2"
    assert files.save()
    assert session.path == tmp_path / "wing.v2.ninepoint"
    assert session.path.is_file()


def test_save_as_leaves_the_old_file(files, session, answers, tmp_path):
    answers.path = tmp_path / "a.ninepoint"
    files.save()
    before = answers.path.read_bytes()
    change(session)
    answers.path = tmp_path / "b.ninepoint"
    assert files.save_as()
    assert (tmp_path / "a.ninepoint").read_bytes() == before
    assert session.path == tmp_path / "b.ninepoint"
    assert files.recent[:2] == [tmp_path / "b.ninepoint", tmp_path / "a.ninepoint"]


def test_a_cancelled_save_changes_nothing(files, session):
    change(session)
    assert not files.save()
    assert session.is_modified
    assert session.path is None


def test_a_save_that_fails_says_so_and_stays_unsaved(files, session, answers, tmp_path):
    change(session)
    answers.path = tmp_path / "no" / "such" / "folder" / "wing.ninepoint"
    assert not files.save()
    assert answers.shown
    assert "wing.ninepoint" in answers.shown[0][1]
    assert session.is_modified
    assert session.path is None


@pytest.mark.parametrize("answer", list(Answer))
@pytest.mark.parametrize("leave", ["new", "open"])
def test_unsaved_changes_are_asked_about(files, session, answers, tmp_path, answer, leave):
    answers.path = tmp_path / "wing.ninepoint"
    files.save()
    change(session)
    changed = session.document
    answers.answer = answer
    if leave == "new":
        files.new()
        left = not session.document.curves
    else:
        other = tmp_path / "points.csv"
        other.write_text("0,0\n1,0\n1,1\n")
        left = files.open_path(other)
    assert answers.asked == ["wing.ninepoint"]
    assert left is (answer is not Answer.CANCEL)
    if answer is Answer.CANCEL:
        assert session.document is changed
    on_disk = open_document(tmp_path / "wing.ninepoint")
    assert same(on_disk, changed) is (answer is Answer.SAVE)


def test_nothing_is_asked_when_nothing_changed(files, session, answers):
    files.new()
    assert answers.asked == []
    assert session.document.curves == ()
    assert files.title == UNTITLED


def test_a_save_that_fails_keeps_the_drawing_open(files, session, answers, tmp_path):
    change(session)
    changed = session.document
    answers.answer = Answer.SAVE
    answers.path = tmp_path / "no folder" / "wing.ninepoint"
    files.new()
    assert session.document is changed


def test_points_become_a_drawing_without_a_file(files, session, answers, tmp_path):
    points = tmp_path / "naca 2412.dat"
    points.write_text("NACA 2412\n1 0\n0.5 0.1\n0 0\n0.5 -0.05\n")
    before = points.read_bytes()
    assert files.open_path(points)
    assert session.path is None
    assert files.title == "naca 2412"
    assert len(session.document.curves[0].points) == 4
    change(session)
    files.save()
    assert answers.suggested[-1].name == "naca 2412.ninepoint"
    assert points.read_bytes() == before


@pytest.mark.parametrize("name", ["wing.svg", "WING.DXF", "wing.svgz"])
def test_a_drawing_of_another_program_is_handed_on(qtbot, files, session, answers, tmp_path, name):
    path = tmp_path / name
    path.write_text("anything")
    before = session.document
    with qtbot.waitSignal(files.foreign) as handed:
        assert not files.open_path(path)
    assert handed.args == [path]
    assert session.document is before
    assert (answers.shown, files.recent) == ([], [])


def test_before_a_foreign_file_is_read_unsaved_changes_are_asked_about(
    files, session, answers, tmp_path
):
    handed = []
    files.foreign.connect(handed.append)
    change(session)
    answers.answer = Answer.CANCEL
    assert not files.open_path(tmp_path / "wing.svg")
    assert answers.asked == [UNTITLED]
    assert handed == []


def test_opening_again_comes_back_exactly_there(qtbot, files, session, answers, tmp_path):
    change(session, "Lean")
    answers.path = tmp_path / "wing.ninepoint"
    files.save()
    saved = session.document
    files.new()
    with qtbot.waitSignals([files.opened, files.told]):
        files.open()
    assert same(session.document, saved)
    assert session.path == answers.path
    assert not session.is_modified
    assert session.undo_name is None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("broken.ninepoint", '{"format": "ninepo'),
        ("empty.csv", ""),
        ("words.csv", "not, numbers\nat, all\n"),
        ("drawing.psd", "8BPS"),
        ("newer.ninepoint", '{"format": "ninepoint", "version": 999}'),
    ],
)
def test_a_bad_file_is_refused_in_a_sentence(files, session, answers, tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text)
    change(session)
    before, answers.answer = session.document, Answer.DISCARD
    assert not files.open_path(path)
    title, sentence = answers.shown[0]
    assert title == "Cannot open"
    assert sentence.startswith(name)
    assert session.document is before
    assert session.is_modified
    assert files.recent == []


def test_a_recent_file_that_is_gone_leaves_the_list(qtbot, files, answers, tmp_path):
    answers.path = tmp_path / "wing.ninepoint"
    files.save()
    assert files.recent == [answers.path]
    answers.path.unlink()
    with qtbot.waitSignal(files.recent_changed):
        assert not files.open_path(answers.path)
    assert files.recent == []
    assert "no longer there" in answers.shown[0][1]


def test_recent_files_can_be_forgotten(qtbot, files, answers, tmp_path):
    answers.path = tmp_path / "wing.ninepoint"
    files.save()
    with qtbot.waitSignal(files.recent_changed):
        files.clear_recent()
    assert files.recent == []


def test_an_example_is_a_copy(files, session, answers, tmp_path):
    answers.path = tmp_path / "vase.ninepoint"
    files.save()
    files.clear_recent()
    assert files.open_example(answers.path)
    assert session.path is None
    assert files.title == "vase"
    assert files.recent == []


def test_the_drawing_on_disk_is_what_the_hand_had_left(files, session, answers, tmp_path):
    answers.path = tmp_path / "wing.ninepoint"
    session.begin("Set beta")
    change(session)
    assert files.save()
    assert not session.in_gesture
    assert not session.is_modified


def test_the_error_names_the_line(files, answers, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("0,0\n1,1\n2,x\n")
    files.open_path(path)
    assert "line 3" in answers.shown[0][1]
    assert isinstance(FileError(path, "reason", 3), ValueError)
