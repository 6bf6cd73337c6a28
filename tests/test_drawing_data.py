import threading

import numpy as np
import pytest
from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication, QImage

from app import drawing_data
from app.drawing_data import MOST_SHARED, OWN, PNG, SVG, TEXT, DrawingData
from core import store
from core.document import Curve, Document
from core.family import PRESETS
from core.formats.embedded import embedded
from drawings import letter_f


@pytest.fixture
def data(qtbot):
    return DrawingData(letter_f().with_parameters(PRESETS["Tight"]))


@pytest.fixture(autouse=True)
def empty_clipboard(qtbot):
    yield
    QGuiApplication.clipboard().clear()  # Qt must not ask for forms when Python is gone


def same(one, other):
    return one.parameters == other.parameters and all(
        (a.points == b.points).all() and (a.closed, a.name) == (b.closed, b.name)
        for a, b in zip(one.curves, other.curves, strict=True)
    )


def test_it_offers_the_drawing_svg_text_and_a_picture(data):
    assert data.formats() == [OWN, SVG, TEXT, PNG]
    assert all(map(data.hasFormat, data.formats()))
    assert not data.hasFormat("text/html")
    assert same(store.decode(data.data(OWN).data(), "a"), data.document)
    assert data.text().startswith("<?xml")
    assert data.text().encode() == data.data(SVG).data()
    image = QImage.fromData(data.data(PNG).data())
    assert image.width() > 300
    assert image.pixelColor(0, 0).name() == "#ffffff"


def test_the_svg_alone_brings_the_drawing_back(data):
    assert same(embedded(data.data(SVG).data()), data.document)


def test_it_goes_through_the_clipboard(data):
    board = QGuiApplication.clipboard()
    board.setMimeData(data)
    assert board.mimeData() is data
    assert board.text() == data.text()


def test_nothing_is_made_before_somebody_asks_and_then_once(qtbot, monkeypatch):
    made = []
    monkeypatch.setattr(drawing_data, "svg_text", lambda document: made.append(1) or b"<svg/>")
    data = DrawingData(letter_f())
    assert made == []
    assert data.data(SVG).data() == b"<svg/>"
    assert data.text() == "<svg/>"
    assert made == [1]


def test_two_threads_make_a_form_once(qtbot, monkeypatch):
    made, gate = [], threading.Event()

    def slow(document):
        made.append(1)
        gate.wait(10)
        return b"<svg/>"

    monkeypatch.setattr(drawing_data, "svg_text", slow)
    data = DrawingData(letter_f())
    worker = threading.Thread(target=data.make_all)
    worker.start()
    threading.Timer(0.01, gate.set).start()
    assert data.make(SVG) == b"<svg/>"
    worker.join()
    assert made == [1]


def test_long_drawings_are_for_ninepoint_alone(qtbot):
    data = DrawingData(Document((Curve(np.zeros((MOST_SHARED + 1, 2))),)))
    assert data.formats() == [OWN]
    assert not data.is_shared
    assert not data.hasText()


def test_what_cannot_be_drawn_has_no_picture(qtbot):
    data = DrawingData(Document((Curve([(1, 2)]),)))
    assert data.make(SVG) == b""
    assert data.make(PNG) == b""
    assert data.make("text/html") == b""
    assert data.make(OWN)


def test_what_was_made_can_be_kept_without_python(data):
    data.make_all()
    kept = data.kept()
    assert type(kept) is QMimeData
    assert set(kept.formats()) == {OWN, SVG, TEXT, PNG}
    assert kept.text() == data.text()


@pytest.mark.parametrize("size", [0.01, 5.0, 1e5])
def test_a_picture_has_a_sensible_size(qtbot, size):
    image = QImage.fromData(drawing_data.png_bytes(Document((Curve(np.eye(2) * size),))))
    assert 0 < max(image.width(), image.height()) <= 4100
