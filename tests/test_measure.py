"""The size of a drawing, from its levels of detail, told when the hand rests."""

import math

import numpy as np
import pytest

from app.canvas import Canvas
from app.measure import DELAY_MS, TOLERANCE_MM, Size, size_of
from app.opening import ready_document
from app.session import Session
from core.affine import Affine
from core.document import Curve, Document
from core.extent import extent
from core.family import PRESETS, Parameters
from core.formats import export, named


@pytest.fixture
def canvas_of(qtbot):
    def make(document):
        canvas = Canvas(Session(document))
        qtbot.addWidget(canvas)
        canvas.resize(600, 400)
        return canvas

    return make


def flower(count, radius=50.0, centre=0.0):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    around = (radius + 5 * np.sin(9 * angle))[:, None]
    return Curve(centre + around * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def expected(document):
    points = np.concatenate(
        [curve.limit(document.parameters).points(10) for curve in document.curves]
    )
    return points.max(axis=0) - points.min(axis=0)


def test_the_size_is_that_of_the_curve_and_not_of_the_polygon(canvas_of, tmp_path):
    report = export(ready_document(), tmp_path / "shape.svg", named("svg").within(1e-4))
    size = size_of(canvas_of(ready_document()).scene.curves)
    assert (size.width, size.height) == pytest.approx(
        (report.width_mm, report.height_mm), abs=2 * TOLERANCE_MM
    )
    assert size.is_sharp


@pytest.mark.parametrize("turned", [False, True])
def test_the_size_holds_all_curves(canvas_of, turned):
    turn = Affine(np.array([[0.6, -0.8], [0.8, 0.6]]), np.array([3.0, 4.0]))
    curves = [flower(30), flower(2000, 20.0, (70.0, -30.0)), flower(9, 3.0), flower(1000, 4.0, 80)]
    curves.append(Curve(np.array([[200.0, 3.0]])))
    document = Document(tuple(curve.carried(turn) if turned else curve for curve in curves))
    size = size_of(canvas_of(document).scene.curves)
    assert (size.width, size.height) == pytest.approx(expected(document), abs=0.01)


def test_of_many_curves_only_those_at_the_rim_are_searched(canvas_of, monkeypatch):
    curves = [flower(30, 3.0, (x, y)) for x in range(0, 100, 10) for y in range(0, 100, 10)]
    document = Document((flower(40, 200.0), *curves))
    searched = []
    monkeypatch.setattr(
        "core.extent.extent", lambda *args: (searched.append(args), extent(*args))[1]
    )
    size = size_of(canvas_of(document).scene.curves)
    assert len(searched) == 1
    assert (size.width, size.height) == pytest.approx(expected(document), abs=0.01)


@pytest.mark.parametrize("document", [Document(), Document((Curve(np.zeros((0, 2))),))])
def test_nothing_has_no_size(canvas_of, document):
    assert size_of(canvas_of(document).scene.curves) is None


def test_a_dot_has_the_size_zero(canvas_of):
    document = Document((Curve(np.array([[3.0, 4.0]])),))
    assert size_of(canvas_of(document).scene.curves) == Size(0.0, 0.0, 0.0)


def test_a_scheme_that_is_not_proven_to_converge_has_no_proven_size(canvas_of):
    document = ready_document().with_parameters(Parameters(50, 0, 0))
    size = size_of(canvas_of(document).scene.curves)
    assert not size.is_proven
    assert size.deviation == math.inf


def test_the_size_follows_when_the_hand_rests(qtbot, canvas_of):
    canvas = canvas_of(ready_document())
    told = []
    canvas.measure.changed.connect(told.append)
    canvas.measure.start()
    qtbot.waitUntil(lambda: len(told) == 1)
    session = canvas.session
    for name in ("Tight", "B-spline", "Lagrange"):
        session.edit(session.document.with_parameters(PRESETS[name]), name)
    assert len(told) == 1
    qtbot.waitUntil(lambda: len(told) == 2)
    assert told[1] != told[0]
    assert (told[1].width, told[1].height) == pytest.approx(expected(session.document), abs=0.01)


def test_nothing_is_measured_before_it_is_begun(qtbot, canvas_of):
    """The first paint of the program may come later than the hand rests."""
    canvas = canvas_of(ready_document())
    told = []
    canvas.measure.changed.connect(told.append)
    canvas.session.edit(canvas.session.document.with_parameters(PRESETS["Tight"]), "Tight")
    qtbot.wait(2 * DELAY_MS)
    assert not told
    canvas.measure.start()
    qtbot.waitUntil(lambda: len(told) == 1)
