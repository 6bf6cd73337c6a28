import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QHBoxLayout, QWidget

from app.guard import guarded
from app.opening import ready_document
from app.plots import LEVEL, WIDEST, BasisPlot, StepPlot
from app.session import Session
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.basis import BasicLimitFunction
from core.chords import COARSE_LEVEL
from core.errors import NoLimitError
from core.family import PRESETS, Parameters


@pytest.fixture
def session():
    return Session(ready_document())


@pytest.fixture(params=[BasisPlot, StepPlot])
def plot(request, qtbot, session):
    plot = request.param(session)
    qtbot.addWidget(plot)
    plot.resize(400, 180)
    plot.show()
    return plot


@pytest.fixture
def basis(qtbot, session):
    plot = BasisPlot(session)
    qtbot.addWidget(plot)
    return plot


@pytest.fixture
def step(qtbot, session):
    plot = StepPlot(session)
    qtbot.addWidget(plot)
    return plot


def choose(session, parameters):
    session.edit(session.document.with_parameters(parameters), "Set")


@pytest.mark.parametrize("name", PRESETS)
def test_the_basis_plot_shows_phi_over_its_support(basis, session, name):
    choose(session, Parameters(1, 1, 1))
    choose(session, PRESETS[name])
    phi = BasicLimitFunction(PRESETS[name].mask)
    t, values = basis.curve.t, basis.curve.values
    assert np.array_equal(values, phi.values(LEVEL))
    assert np.array_equal(t, phi.parameters(LEVEL))
    assert basis.support.getRegion() == tuple(map(float, phi.support))


@pytest.mark.parametrize(
    ("name", "support"),
    [
        ("Calm", "\N{MINUS SIGN}13/2 \u2026 13/2"),
        ("Tight", "\N{MINUS SIGN}17/2 \u2026 17/2"),
    ],
)
def test_the_support_is_named(basis, session, name, support):
    choose(session, Parameters(1, 1, 1))
    choose(session, PRESETS[name])
    assert basis.sentence.endswith("support " + support)


@pytest.mark.parametrize(
    ("name", "sentence", "marks"),
    [
        ("Lagrange", "overshoot 11.7770863 % \u00b7 undershoot 11.7770863 %", 2),
        ("Calm", "overshoot 0.0309781 % \u00b7 undershoot 0.0309781 %", 2),
        ("Lean", "overshoot none seen above 2e-10 \u00b7 undershoot 6.1262567 %", 1),
        ("B-spline", "overshoot none, proven \u00b7 undershoot none, proven", 0),
    ],
)
def test_the_step_plot_says_how_far_it_overshoots(step, session, name, sentence, marks):
    choose(session, Parameters(1, 1, 1))
    choose(session, PRESETS[name])
    assert step.sentence == sentence
    assert len(step.curve.marks) == marks


@pytest.mark.parametrize(
    "parameters",
    [Parameters(100, -100, 100), Parameters(10, 0, 0), Parameters(1, 0, -1, "mirrored")],
)
def test_a_divergent_scheme_is_drawn_at_a_finite_level(basis, step, session, parameters):
    choose(session, parameters)
    for plot in (basis, step):
        t, values = plot.curve.t, plot.curve.values
        assert len(t) <= 17 * 2**COARSE_LEVEL + 3
        assert np.abs(values).max() <= WIDEST
    assert step.sentence == "overshoot and undershoot: no bound proven"
    assert len(step.curve.marks) == 0


def test_the_step_runs_from_one_to_zero(step):
    t, values = step.curve.t, step.curve.values
    assert values[0] == 1
    assert values[-1] == 0
    assert (np.diff(t) > 0).all()


def test_the_curve_fits_the_range_below_the_words(plot, session):
    for parameters in [*PRESETS.values(), Parameters(1, 1, 1), Parameters(2, -2, 2)]:
        choose(session, parameters)
        values = plot.curve.values
        _, (low, high) = plot.getPlotItem().viewRange()
        assert low < values.min()
        assert values.max() < high


def test_presets_share_one_range(plot, session):
    ranges = set()
    for name in ("Calm", "Tight", "Lean", "B-spline"):
        choose(session, PRESETS[name])
        ranges.add(str(plot.getPlotItem().viewRange()))
    assert len(ranges) == 1


def test_a_scheme_without_a_limit_clears_the_plot_and_says_so(plot, session, monkeypatch):
    def refuse(self, level, order=0):
        raise NoLimitError("There is no limit.")

    monkeypatch.setattr(BasicLimitFunction, "values", refuse)
    choose(session, Parameters("3/7", 0, 0))
    t = plot.curve.t
    assert t is None or len(t) == 0
    assert plot.sentence == "There is no limit."
    assert not plot.curve.isVisible()
    monkeypatch.undo()
    choose(session, PRESETS["Tight"])
    assert plot.curve.isVisible()


def test_values_that_run_away_stay_drawable(plot, session):
    choose(session, Parameters(90, -80, 70))
    values = plot.curve.values
    assert np.isfinite(values).all()
    plot.grab()


def test_the_mouse_moves_nothing(plot):
    before = plot.getPlotItem().viewRange()
    QTest.mousePress(plot.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 80))
    QTest.mouseMove(plot.viewport(), QPoint(220, 120))
    QTest.mouseRelease(plot.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(220, 120))
    event = QWheelEvent(
        QPointF(150, 80), plot.mapToGlobal(QPointF(150, 80)), QPoint(), QPoint(0, 240),
        Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase,
        False,
    )  # fmt: skip
    QApplication.sendEvent(plot.viewport(), event)
    assert plot.getPlotItem().viewRange() == before


def test_other_edits_do_not_redraw(plot, session, monkeypatch):
    monkeypatch.setattr(type(plot), "draw", lambda self, parameters: pytest.fail("drawn"))
    curve = session.document.curves[0]
    session.edit(session.document.with_curve(0, curve.moved(0, (1.0, 2.0))), "Move point")


@pytest.mark.parametrize("colours", [DARK, LIGHT])
def test_another_colour_scheme_colours_anew(plot, colours):
    plot.setPalette(window_palette(DARK if colours is LIGHT else LIGHT))
    plot.setPalette(window_palette(colours))
    assert plot.curve.pen.color().name() == colours.plot_curve
    assert plot.backgroundBrush().color().name() == colours.plot_background


def test_the_words_are_there_for_screen_readers(plot):
    assert plot.accessibleName()
    assert plot.accessibleDescription() == plot.sentence


def test_the_derivative_is_shown_on_demand(basis, session):
    assert len(basis.slope.t) == 0
    basis.show_slope(True)
    t, slope = basis.slope.t, basis.slope.values
    phi = BasicLimitFunction(PRESETS["Calm"].mask)
    assert np.array_equal(slope, phi.values(LEVEL, 1))
    differences = np.diff(phi.values(LEVEL)) / np.diff(t)
    assert np.abs(differences - (slope[1:] + slope[:-1]) / 2).max() < 1e-2
    _, (low, high) = basis.getPlotItem().viewRange()
    assert low < slope.min() < slope.max() < high
    assert "\u03c6\u2032(t)" in basis.sentence
    choose(session, Parameters(1, 0, -1, "mirrored"))
    assert len(basis.slope.t) == 0
    assert "\u03c6\u2032 not proven" in basis.sentence
    basis.show_slope(False)
    assert "\u2032" not in basis.sentence


def test_a_closed_plot_bears_a_change_of_colours(plot, monkeypatch):
    monkeypatch.setattr(plot, "getPlotItem", lambda: None)  # as pyqtgraph's close leaves it
    QApplication.setPalette(window_palette(DARK))
    QApplication.setPalette(window_palette(LIGHT))
    QApplication.processEvents()


def test_both_plots_come_in_one_picture(qtbot, session):
    """Else a window that shows both is painted, and handed to the display, twice for each move."""
    window = QWidget()
    qtbot.addWidget(window)
    layout = QHBoxLayout(window)
    plots = [BasisPlot(session), StepPlot(session)]
    for shown in plots:
        layout.addWidget(shown)
    window.resize(800, 200)
    with qtbot.waitExposed(window):
        window.show()
    QApplication.processEvents()
    seen = []

    class Heard(QObject):
        @guarded
        def eventFilter(self, watched, event):  # noqa: N802
            if event.type() in (QEvent.Type.UpdateRequest, QEvent.Type.Paint):
                seen.append("window" if watched is window else "plot")
            return False

    heard = Heard()
    for watched in (window, *(shown.viewport() for shown in plots)):
        watched.installEventFilter(heard)
    choose(session, PRESETS["Tight"])
    QApplication.processEvents()
    assert seen.count("plot") == 2
    assert "window" not in seen[seen.index("plot") + 1 :]


def test_what_is_shown_after_a_resize_is_what_a_full_repaint_shows(plot):
    """The plot says itself when it is to be painted; its axes must not lag behind."""
    QApplication.processEvents()
    for size in ((520, 240), (300, 150)):
        plot.resize(*size)
        QApplication.processEvents()
        shown = plot.screen().grabWindow(plot.winId()).toImage()
        plot.viewport().repaint()
        again = plot.screen().grabWindow(plot.winId()).toImage()
        assert not shown.isNull()
        assert shown == again
