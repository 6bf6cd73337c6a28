import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.analysis import Finding
from app.report_panel import ReportPanel, arranged
from app.style import DARK, LIGHT
from app.theme import window_palette
from core.family import PRESETS, Parameters
from core.report import report
from core.wording import as_latex, as_text, sections

LONG = Parameters("1/3", "-2/5", "-1/7")


def finding(parameters):
    found = report(parameters)
    return Finding(parameters, found.smoothness, found)


@pytest.fixture
def panel(qtbot):
    panel = ReportPanel()
    qtbot.addWidget(panel)
    panel.resize(300, 420)
    panel.show()
    qtbot.waitExposed(panel)
    return panel


def test_reading_is_announced(qtbot, panel):
    with qtbot.waitSignal(panel.read, check_params_cb=lambda read: not read):
        panel.hide()
    with qtbot.waitSignal(panel.read, check_params_cb=lambda read: read):
        panel.show()


def test_nothing_can_be_copied_before_the_first_report(panel):
    assert not panel.copy_text.isEnabled()
    assert not panel.copy_latex.isEnabled()
    assert "comes in a moment" in panel.page.toPlainText()


def test_the_report_is_arranged_and_no_number_is_lost(panel):
    panel.show_finding(finding(PRESETS["Calm"]))
    words = panel.page.toPlainText().replace("\N{NO-BREAK SPACE}", " ")
    for part in (
        "Scheme (0, \N{MINUS SIGN}1/2, 0), translated neighbours",
        "C\u00b3 proven, not C\u2074",
        f"the symbol has the factor (1+z){PRESETS['Calm'].mask.factored()[0]}",
        "support of \u03c6: t = \N{MINUS SIGN}13/2 \u2026 13/2, width 13",
        "overshoot 0.0309781 %; undershoot 0.0309781 %",
        "+ 35607/131072 pi\N{MINUS SIGN}1",
    ):
        assert part in words
    markup = panel.page.toHtml()
    assert markup.count("<h3") == as_text(panel.report).count("\n\n") + 1


def test_a_sum_breaks_between_its_terms_only(panel):
    panel.show_finding(finding(LONG))
    block = panel.page.document().begin()
    rows = 0
    while block.isValid():
        layout, text = block.layout(), block.text()
        for number in range(1, layout.lineCount()):
            if "\N{NO-BREAK SPACE}p" in text:
                rows += 1
                assert text[layout.lineAt(number).textStart()] in "+\N{MINUS SIGN}"
        block = block.next()
    assert rows > 20
    assert panel.page.horizontalScrollBar().maximum() == 0


@pytest.mark.parametrize(("button", "write"), [("copy_text", as_text), ("copy_latex", as_latex)])
def test_it_is_copied(qtbot, panel, button, write):
    found = finding(PRESETS["Lean"])
    panel.show_finding(found)
    with qtbot.waitSignal(panel.told) as told:
        QTest.keyClick(getattr(panel, button), Qt.Key.Key_Space)
    assert QGuiApplication.clipboard().text() == write(found.report)
    assert told.args[0].startswith("Copied the report as ")


def test_the_last_report_stays_while_there_is_no_other(panel):
    found = finding(PRESETS["Lean"])
    panel.show_finding(found)
    panel.show_finding(Finding(PRESETS["Calm"], found.smoothness))
    assert panel.report is found.report


def test_what_is_read_stays_in_sight(panel):
    panel.show_finding(finding(PRESETS["Lean"]))
    bar = panel.page.verticalScrollBar()
    bar.setValue(200)
    panel.show_finding(finding(LONG))
    assert bar.value() == 200


def test_words_can_be_selected_by_keyboard(panel):
    panel.show_finding(finding(PRESETS["Calm"]))
    QTest.keyClick(panel.page, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClick(panel.page, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert "proven" in QGuiApplication.clipboard().text()


@pytest.mark.parametrize("colours", [DARK, LIGHT])
def test_another_colour_scheme_reaches_the_page(panel, colours):
    QApplication.setPalette(window_palette(DARK if colours is LIGHT else LIGHT))
    panel.show_finding(finding(PRESETS["Calm"]))
    QApplication.setPalette(window_palette(colours))
    QApplication.processEvents()
    assert colours.muted_text in panel.page.toHtml()


@pytest.mark.parametrize("parameters", [Parameters(100, -100, 100), Parameters(0, 0, "99/7")])
def test_a_divergent_scheme_has_a_report(parameters):
    markup = arranged(sections(report(parameters)), LIGHT.muted_text)
    assert "does not converge, proven" in markup
    assert "nan" not in markup


@pytest.mark.parametrize(
    ("line", "markup"),
    [
        ("P_0 = 1 p_0", "<sub>0</sub>"),
        ("zeta_1^[2](-3)", "\u03b6<sub>1</sub><sup>[2]</sup>(\u22123)"),
        ("norm = -5/8 < 0", "norm = \u22125/8 &lt; 0"),
        ("the sub-scheme (alpha, beta, alpha)", "the sub-scheme (\u03b1, \u03b2, \u03b1)"),
        ("maximal product B_01", "maximal product B<sub>01</sub>"),
        ("none seen above 9e-10", "none seen above 9e-10"),
    ],
)
def test_letters_of_formulas(line, markup):
    assert markup in arranged([("Rules", [line])], LIGHT.muted_text)
