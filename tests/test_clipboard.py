import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QUrl
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from answers import Answers
from app.canvas import Canvas
from app.clipboard import NOTHING, Clipboard, can_be_pasted, is_points, is_svg
from app.drawing_data import OWN, SVG, DrawingData
from app.files import Files
from app.importing import Importer
from app.opening import ready_document
from app.point_set import PointSet
from app.session import Selection, Session
from app.settings import Settings
from core import atomic, store
from core.document import Curve, Document
from core.family import PRESETS
from core.formats import PROFILES, Contours, svg
from drawings import letter_f

SQUARE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
    '<path d="M10 10 H50 V50 H10 Z"/></svg>'
)


@pytest.fixture
def told():
    return []


@pytest.fixture
def clipboard(qtbot, told):
    top = QWidget()
    qtbot.addWidget(top)
    document = ready_document().with_curve_added(Curve(np.eye(2) * 9, False, "Slot"))
    session = Session(document, top)
    canvas = Canvas(session)
    field = QLineEdit()
    layout = QVBoxLayout(top)
    layout.addWidget(canvas)
    layout.addWidget(field)
    top.resize(600, 500)
    settings, answers = Settings(), Answers()
    files = Files(session, settings, answers, top)
    importer = Importer(session, files, settings, answers, top)
    clipboard = Clipboard(session, canvas, importer, top)
    clipboard.told.connect(told.append)
    clipboard.session, clipboard.canvas, clipboard.importer = session, canvas, importer
    clipboard.top, clipboard.field = top, field
    top.show()
    top.activateWindow()
    qtbot.waitExposed(top)
    canvas.setFocus()
    QGuiApplication.clipboard().clear()
    yield clipboard
    clipboard.stop()
    importer.stop()


def select(clipboard, members, curve=0):
    clipboard.session.select(Selection(PointSet(members), curve))


def put(text=None, **forms):
    data = QMimeData()
    if text is not None:
        data.setText(text)
    for kind, value in forms.items():
        data.setData({"own": OWN, "svg": SVG}[kind], value)
    QGuiApplication.clipboard().setMimeData(data)


def done(qtbot, clipboard):
    qtbot.waitUntil(lambda: not clipboard.importer.is_busy)


def curves(clipboard):
    return clipboard.session.document.curves


def test_a_copy_is_pasted_beside_in_one_step_and_selected(clipboard, told):
    select(clipboard, {0: range(8)})
    clipboard.copy()
    assert told == ["Copied 1 curve."]
    clipboard.paste()
    first, _, pasted = curves(clipboard)
    assert (pasted.name, pasted.closed) == ("Curve 2", True)
    way = pasted.points - first.points
    assert np.allclose(way, way[0])
    assert way[0, 0] == -way[0, 1] >= 14 * clipboard.canvas.camera.pixel_mm
    assert clipboard.session.selection.points == PointSet({2: range(8)})
    assert clipboard.session.undo_name == "Paste curve"
    clipboard.paste()
    assert np.allclose(curves(clipboard)[3].points - first.points, 2 * way)
    clipboard.session.undo()
    clipboard.session.undo()
    assert clipboard.session.undo_name is None


def test_without_a_selection_all_is_copied(clipboard, told):
    clipboard.copy()
    assert told == ["Copied 2 curves."]
    assert isinstance(QGuiApplication.clipboard().mimeData(), DrawingData)


def test_some_points_are_copied_as_an_open_curve(clipboard):
    select(clipboard, {0: [7, 0, 1]})
    clipboard.copy()
    clipboard.session.replace(Document(), None)
    clipboard.paste()
    (part,) = curves(clipboard)
    assert part.points.tolist() == ready_document().curves[0].points[[7, 0, 1]].tolist()
    assert not part.closed


def test_cut_copies_and_deletes_in_one_step(clipboard, told):
    select(clipboard, {1: [0, 1]}, 1)
    clipboard.cut()
    assert [curve.name for curve in curves(clipboard)] == ["Curve 1"]
    assert clipboard.session.undo_name == "Cut curve"
    clipboard.paste()
    assert np.array_equal(curves(clipboard)[1].points, np.eye(2) * 9)  # nothing is covered
    select(clipboard, {0: [2, 3, 4]})
    clipboard.cut()
    assert clipboard.session.undo_name == "Cut 3 points"
    assert curves(clipboard)[0].count == 5


def test_a_cut_without_a_selection_says_so(clipboard, told):
    before = clipboard.session.document
    clipboard.cut()
    assert told == ["Nothing is selected that could be cut."]
    assert clipboard.session.document is before


def test_duplicate_leaves_the_clipboard_alone(clipboard, told):
    put("something")
    select(clipboard, {1: [0, 1]}, 1)
    clipboard.duplicate()
    assert curves(clipboard)[2].name == "Slot 2"
    assert clipboard.session.undo_name == "Duplicate curve"
    assert told == ["Duplicated 1 curve."]
    assert QGuiApplication.clipboard().text() == "something"


def test_an_empty_drawing_has_nothing_to_copy(clipboard, told):
    clipboard.session.replace(Document(), None)
    clipboard.copy()
    clipboard.duplicate()
    assert told[0] == "There is nothing to copy: the drawing has no points."
    assert clipboard.session.undo_name is None


def test_our_own_text_of_another_window_is_pasted_without_loss(qtbot, clipboard):
    document = letter_f().with_parameters(PRESETS["Tight"])
    put(own=store.encode(document))
    clipboard.session.replace(Document(), None)
    clipboard.paste()
    done(qtbot, clipboard)
    pasted = clipboard.session.document
    assert pasted.parameters == PRESETS["Tight"]
    for one, other in zip(pasted.curves, document.curves, strict=True):
        assert (one.points == other.points).all()
        assert (one.name, one.closed) == (other.name, other.closed)


@pytest.mark.parametrize("as_text", [True, False])
def test_our_own_svg_is_pasted_without_a_question(qtbot, clipboard, as_text):
    text = svg.encode(Contours.of(letter_f(), PROFILES["svg"]), "F")
    put(text.decode()) if as_text else put(svg=text)
    clipboard.paste()
    done(qtbot, clipboard)
    assert [curve.name for curve in curves(clipboard)[2:]] == ["Letter F", "Stroke"]
    assert (curves(clipboard)[2].points == letter_f().curves[0].points).all()
    assert clipboard.session.undo_name == "Paste 2 curves"


@pytest.mark.parametrize("as_text", [True, False])
def test_foreign_svg_is_asked_about(qtbot, clipboard, as_text):
    put(SQUARE) if as_text else put(svg=SQUARE.encode())
    clipboard.paste()
    importer = clipboard.importer
    qtbot.waitUntil(lambda: importer.dialog is not None and importer.dialog.found is not None)
    assert importer.dialog.windowTitle().startswith("Paste SVG")
    importer.dialog.accept()
    done(qtbot, clipboard)
    assert len(curves(clipboard)) == 3
    assert clipboard.session.undo_name == "Paste curve"


@pytest.mark.parametrize(
    ("text", "points"),
    [
        ("1\t2\n3\t4\n5\t7\n", [(1, 2), (3, 4), (5, 7)]),
        ("x;y\n1,5;2\n3;4,5\n", [(1.5, 2), (3, 4.5)]),
        ("1, 2\n3, 4", [(1, 2), (3, 4)]),
        ("  1.5 -2e1 \r\n 3 4\r\n", [(1.5, -20), (3, 4)]),
        ("1,5\t2,5\n3,0\t4,0\n", [(1.5, 2.5), (3, 4)]),
    ],
)
def test_two_columns_of_numbers_become_a_curve(qtbot, clipboard, text, points):
    put(text)
    clipboard.paste()
    done(qtbot, clipboard)
    curve = curves(clipboard)[2]
    assert curve.points.tolist() == [list(map(float, point)) for point in points]
    assert curve.name == "Curve 2"
    assert clipboard.session.undo_name == "Paste curve"


@pytest.mark.parametrize(
    ("forms", "words"),
    [
        ({}, NOTHING),
        ({"text": "Dear reader"}, NOTHING),
        ({"text": ""}, NOTHING),
        ({"text": "1 2\n3 x\n"}, "The clipboard, line 2: y is not a number"),
        ({"text": "1 2\n3 4 5\n"}, "The clipboard, line 2: there are 3 columns"),
        ({"text": "<svg><path d='"}, "The clipboard"),
        ({"text": "<svg xmlns='http://www.w3.org/2000/svg'/>"}, "The clipboard"),
        ({"svg": b"\xff\xfe"}, "The clipboard"),
        ({"own": b'{"format": "ninepo'}, "The clipboard"),
        ({"own": b"[1, 2]"}, "The clipboard: it is not a Ninepoint drawing."),
    ],
)
def test_nonsense_is_told_and_changes_nothing(qtbot, clipboard, told, forms, words):
    before = clipboard.session.document
    put(**forms)
    clipboard.paste()
    done(qtbot, clipboard)
    (sentence,) = told
    assert sentence.startswith(words)
    assert sentence.endswith(".")
    assert clipboard.session.document is before
    assert clipboard.importer.dialog is None


def test_too_much_is_refused_before_it_is_read(qtbot, clipboard, told, monkeypatch):
    monkeypatch.setattr(atomic, "MAX_BYTES", 1_000)
    put("1 2\n" * 1_000)
    clipboard.paste()
    done(qtbot, clipboard)
    assert told == ["The clipboard holds 0 MB; at most 0 MB are read."]


def test_copied_files_are_imported(qtbot, clipboard, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("0,0\n10,0\n10,10\n")
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    QGuiApplication.clipboard().setMimeData(data)
    clipboard.paste()
    done(qtbot, clipboard)
    assert curves(clipboard)[2].name == "points"


def test_a_place_is_where_the_middle_goes(clipboard):
    clipboard.paste_data(DrawingData(letter_f()), np.array([500.0, -200.0]))
    placed = curves(clipboard)[2:]
    low = np.min([curve.points.min(axis=0) for curve in placed], axis=0)
    high = np.max([curve.points.max(axis=0) for curve in placed], axis=0)
    assert np.allclose((low + high) / 2, (500, -200))
    seen_low, seen_high = clipboard.canvas.camera.rectangle_mm()
    assert (low > seen_low).all()
    assert (high < seen_high).all()


def test_a_number_field_cuts_and_pastes_its_own_text(clipboard):
    before = clipboard.session.document
    clipboard.field.setText("0.25")
    clipboard.field.setFocus()
    clipboard.field.selectAll()
    clipboard.copy()
    assert QGuiApplication.clipboard().text() == "0.25"
    clipboard.cut()
    assert clipboard.field.text() == ""
    clipboard.paste()
    assert clipboard.field.text() == "0.25"
    assert clipboard.session.document is before


def test_what_was_copied_outlives_the_window(qtbot, clipboard):
    clipboard.copy()
    qtbot.waitUntil(lambda: not clipboard._making.is_busy)
    clipboard.stop()
    data = QGuiApplication.clipboard().mimeData()
    assert type(data) is QMimeData
    assert store.decode(data.data(OWN).data(), "a").curves[1].name == "Slot"
    assert data.text().startswith("<?xml")


def test_what_a_text_is():
    assert is_svg("\ufeff \n<?xml version='1.0'?><svg/>")
    assert not is_svg("<p>1 2</p>")
    assert is_points("Title\n1 2\n")
    assert is_points('"1,5";"2,5"')
    assert not is_points("call 112 now")
    assert not is_points("3\n4\n5\n")


def test_what_can_be_pasted(qtbot):
    data = QMimeData()
    assert not can_be_pasted(data)
    data.setText("hello")
    assert not can_be_pasted(data)
    data.setText("1 2\n3 4")
    assert can_be_pasted(data)
    assert can_be_pasted(DrawingData(letter_f()))
