import re
from threading import Event

import pytest

from app import analysis as analysis_module
from app.analysis import Analysis, Finding, exponent_words
from app.opening import ready_document
from app.session import Session
from core.continuity import Effort, smoothness
from core.family import PRESETS, Parameters
from core.hoelder import QUICK_WIDTH, HoelderInterval
from core.polytope import never

DIVERGENT = Parameters(10, 0, 0)
HARD = Parameters("1/4", "-6/5", "-1/40")


@pytest.fixture
def analysis(qtbot):
    analysis = Analysis(Session(ready_document()))
    yield analysis
    analysis.stop()


def choose(analysis, parameters):
    session = analysis._session
    session.edit(session.document.with_parameters(parameters), "Set")


def at_rest(qtbot, analysis):
    qtbot.waitUntil(lambda: analysis.is_at_rest and analysis.finding is not None)
    return analysis.finding


def test_nothing_is_computed_before_the_start(analysis):
    choose(analysis, PRESETS["Tight"])
    assert analysis.is_at_rest
    assert analysis.finding is None


def test_a_rough_finding_comes_first_and_is_narrowed_at_rest(qtbot, analysis):
    findings = []
    analysis.changed.connect(findings.append)
    analysis.start()
    with qtbot.waitSignal(analysis.rested):
        pass
    rough, sharp = findings
    assert rough.statement == sharp.statement == "C\u00b3 proven, not C\u2074"
    assert re.fullmatch("H\u00f6lder 3.77[0-9]\u20133.828", rough.exponent)
    assert sharp.exponent == "H\u00f6lder 3.82747\u2026"
    assert sharp.report is None


def test_while_parameters_change_the_newest_ends_up_known(qtbot, analysis):
    analysis.start()
    for steps in range(1, 40):
        choose(analysis, Parameters(f"{steps}/200", "-1/2", 0))
    assert at_rest(qtbot, analysis).parameters is analysis._session.document.parameters


def test_a_change_is_glanced_at_on_the_spot(qtbot, analysis):
    analysis.start()
    at_rest(qtbot, analysis)
    choose(analysis, PRESETS["Tight"])
    found = analysis.finding
    assert found.parameters is analysis._session.document.parameters
    assert found.statement == "C\u2074 proven, not C\u2075"
    assert not analysis.is_at_rest


def test_what_a_glance_leaves_wide_is_looked_at_again_before_the_hand_rests(qtbot, analysis):
    findings = []
    analysis.changed.connect(findings.append)
    analysis.start()
    choose(analysis, HARD)
    at_rest(qtbot, analysis)
    widths = [f.smoothness.exponent.width for f in findings if f.parameters == HARD]
    assert widths[0] > 2 * QUICK_WIDTH
    assert widths[1] <= QUICK_WIDTH + 1e-8
    assert widths[2] < 1e-3
    assert len(widths) == 3


def test_a_look_that_comes_late_is_not_shown(qtbot, analysis, monkeypatch):
    gate, begun = Event(), Event()

    def slow(mask, effort=Effort.QUICK, cancelled=never):
        if effort is Effort.QUICK:
            begun.set()
            assert gate.wait(10)
        return smoothness(mask, effort, cancelled)

    monkeypatch.setattr(analysis_module, "smoothness", slow)
    analysis.start()
    choose(analysis, HARD)
    qtbot.waitUntil(begun.is_set)
    choose(analysis, PRESETS["Tight"])
    findings = []
    analysis.changed.connect(findings.append)
    gate.set()
    at_rest(qtbot, analysis)
    assert {finding.parameters for finding in findings} == {PRESETS["Tight"]}


def test_a_change_cancels_the_narrowing(qtbot, analysis, monkeypatch):
    begun, cancellations = Event(), []

    def endless(mask, effort=Effort.QUICK, cancelled=None):
        if effort is Effort.FULL and not cancellations:
            begun.set()
            while not cancelled():
                pass
            cancellations.append(mask)
        return smoothness(mask)

    monkeypatch.setattr(analysis_module, "smoothness", endless)
    analysis.start()
    qtbot.waitUntil(begun.is_set)
    choose(analysis, PRESETS["Tight"])
    found = at_rest(qtbot, analysis)
    assert cancellations == [PRESETS["Calm"].mask]
    assert found.parameters == PRESETS["Tight"]


def test_the_report_is_made_only_while_somebody_reads_it(qtbot, analysis):
    analysis.start()
    assert at_rest(qtbot, analysis).report is None
    analysis.want_report(True)
    found = at_rest(qtbot, analysis)
    assert found.report.parameters == PRESETS["Calm"]
    assert found.smoothness is found.report.smoothness
    choose(analysis, PRESETS["Lean"])
    assert at_rest(qtbot, analysis).report.parameters == PRESETS["Lean"]
    analysis.want_report(False)
    choose(analysis, PRESETS["Tight"])
    assert at_rest(qtbot, analysis).report is None


def test_a_failing_search_ends_in_rest_too(qtbot, analysis, monkeypatch):
    reported = []
    monkeypatch.setattr("sys.excepthook", lambda kind, error, trace: reported.append(kind))

    def failing(mask, effort=Effort.QUICK, cancelled=never):
        return smoothness(mask, effort) if effort is Effort.GLANCE else 1 / 0

    monkeypatch.setattr(analysis_module, "smoothness", failing)
    with qtbot.waitSignal(analysis.rested):
        analysis.start()
    assert set(reported) == {ZeroDivisionError}
    assert analysis.is_at_rest


@pytest.mark.parametrize(
    ("parameters", "statement", "notice"),
    [
        (PRESETS["Calm"], "C\u00b3 proven, not C\u2074", ""),
        (PRESETS["B-spline"], "C\u00b9\u00b9 proven, not C\u00b9\u00b2", ""),
        (
            DIVERGENT,
            "does not converge, proven",
            "This scheme does not converge, proven: drawn at a finite level.",
        ),
        (
            Parameters(100, -100, 100),
            "does not converge, proven",
            "This scheme does not converge, proven: drawn at a finite level.",
        ),
    ],
)
def test_a_finding_in_words(parameters, statement, notice):
    finding = Finding(parameters, smoothness(parameters.mask))
    assert finding.statement == statement
    assert finding.notice == notice
    assert finding.is_convergent is not bool(notice)


@pytest.mark.parametrize(
    ("lower", "upper", "words"),
    [
        (3.7799, 3.8275, "3.779\u20133.828"),
        (3.827475309, 3.827475324, "3.82747\u2026"),
        (2.9999999, 3.0, "2.999\u20133.000"),
        (12.0, 12.0, "12"),
        (0.5003, 0.5009, "0.500\u2026"),
        (-0.0125, 0.0311, "\N{MINUS SIGN}0.013\u20130.032"),
    ],
)
def test_an_exponent_is_never_rounded_inwards(lower, upper, words):
    assert exponent_words(HoelderInterval(lower, upper, "0")) == words
