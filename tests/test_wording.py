"""The report in words: it says what is proven, and no more."""

import pytest

from core.cells import Interval
from core.continuity import Convergence
from core.family import PRESETS, Parameters
from core.report import report
from core.wording import as_latex, as_text, class_statement, percentage


def test_a_report_names_class_exponent_overshoot_and_rules():
    text = as_text(report(PRESETS["Calm"]))
    for part in (
        "Scheme (0, -1/2, 0), translated neighbours",
        "C³ proven, not C⁴",
        "exact 7023/8192",
        "Hölder exponent between 3.827475 and 3.827476",
        "overshoot 0.030978",
        "zeta_0^[1](-3) = -215/131072 < 0",
        "P_1 = 6153/8192 p_0 + 4147/16384 p_1 - 39/4096 p_2 + 87/16384 p_3",
    ):
        assert part in text


def test_no_gibbs_effect_is_claimed_only_where_it_is_proven():
    assert "no Gibbs effect, proven" in as_text(report(PRESETS["B-spline"]))
    lean = as_text(report(PRESETS["Lean"]))
    assert "no Gibbs effect" not in lean
    assert "overshoot none seen above" in lean


def test_divergence_is_said_plainly():
    text = as_text(report(Parameters(10, 0, 0)))
    assert "does not converge, proven" in text
    assert "there is no limit" in text
    assert "nan" not in text
    assert "inf" not in text


@pytest.mark.parametrize(
    ("order", "not_class", "convergence", "statement"),
    [
        (3, 4, Convergence.PROVEN, "C³ proven, not C⁴"),
        (11, 12, Convergence.PROVEN, "C¹¹ proven, not C¹²"),
        (2, 4, Convergence.PROVEN, "C² proven"),
        (None, 0, Convergence.DISPROVEN, "does not converge, proven"),
        (None, 1, Convergence.UNDECIDED, "convergence undecided"),
    ],
)
def test_classes_are_stated_from_both_sides(order, not_class, convergence, statement):
    assert class_statement(order, not_class, convergence) == statement


@pytest.mark.parametrize(
    ("interval", "words"),
    [
        (Interval(0.0, 0.0), "none, proven"),
        (Interval(0.0, 9e-10), "none seen above 9e-10"),
        (Interval(0.1, 0.1 + 1e-9), "10.0000000 %"),
        (Interval(0.1, float("inf")), "at least 10 %, no bound proven"),
    ],
)
def test_excesses_are_stated_as_far_as_proven(interval, words):
    assert percentage(interval) == words


@pytest.mark.parametrize("name", PRESETS)
def test_latex_is_balanced_and_free_of_floats_where_fractions_are_short(name):
    latex = as_latex(report(PRESETS[name]))
    assert latex.count("{") == latex.count("}")
    assert latex.startswith("\\begin{align*}")
    assert latex.rstrip().endswith("\\end{align*}")
    if name == "Calm":
        assert "\\tfrac{35607}{131072}" in latex
