"""The report panel: all that is known of the scheme, in words and formulas, to read and to copy."""

from __future__ import annotations

import html
import re
from typing import Final

from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QGuiApplication, QHideEvent, QShowEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QPushButton,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from app.analysis import Finding
from app.guard import guarded
from app.style import palette_of
from core.report import Report
from core.wording import as_latex, as_text, sections

WAITING: Final = "<p>The report comes in a moment.</p>"
"""What is read before the first report."""

NBSP: Final = "\N{NO-BREAK SPACE}"

_SYMBOLS: Final = (
    (re.compile(r"zeta_(\d+)\^\[(\d+)\]"), "\u03b6<sub>\\1</sub><sup>[\\2]</sup>"),
    (re.compile(r"\b([paPB])_(i?[+-]?\d+|i)(?![\d\w])"), "\\1<sub>\\2</sub>"),
    (re.compile(r"\^(\d+)"), "<sup>\\1</sup>"),
    (re.compile(r"\bphi\b"), "\u03c6"),
    (re.compile(r"\balpha\b"), "\u03b1"),
    (re.compile(r"\bbeta\b"), "\u03b2"),
    (re.compile(r" \.\. "), " \u2026 "),
    (re.compile(r"(\d)\.\.\."), "\\1\u2026"),
    (re.compile(r"(?<!\w)-(?=[\d ])|(?<=[i(>])-(?=\d)"), "\N{MINUS SIGN}"),
)
"""How the plain letters of a report become those of a formula."""

_TERM: Final = re.compile(r"([+\N{MINUS SIGN}]) (\S+) (p<sub>)")
"""A term of a sum: its sign, its weight and its point stay on one line."""

_FORMULA: Final = re.compile(
    r"^(mask .*?|even rule|odd rule|C'?\(i\)|P<sub>\d+</sub>)\s*[:=]\s+(.*)$"
)
"""A row that is a formula: what it defines, and the rest, which is set in even digits."""


class ReportPanel(QWidget):
    """The report, and buttons that copy it.

    Signals
    -------
    read(bool)
        The panel is seen, and wants reports; or is not seen any more.
    told(sentence)
        What was copied, for the status bar.
    """

    read = Signal(bool)
    told = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.report: Report | None = None
        self.page = QTextBrowser()
        self.page.setAccessibleName("Report on the scheme")
        self.page.setFrameShape(QFrame.Shape.NoFrame)
        self.page.document().setDocumentMargin(12)
        self.page.setHtml(WAITING)
        self.copy_text = QPushButton("Copy as &text")
        self.copy_latex = QPushButton("Copy as &LaTeX")
        self.copy_text.setToolTip("Copy the report as plain text")
        self.copy_latex.setToolTip("Copy the formulas as LaTeX, for a paper")
        self.copy_text.clicked.connect(lambda: self._copy("text"))
        self.copy_latex.clicked.connect(lambda: self._copy("LaTeX"))
        buttons = QHBoxLayout()
        buttons.setContentsMargins(12, 8, 12, 10)
        for button in (self.copy_text, self.copy_latex):
            button.setEnabled(False)
            buttons.addWidget(button)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.page)
        layout.addLayout(buttons)
        self.setFocusProxy(self.page)

    def show_finding(self, finding: Finding) -> None:
        """Show the report of a finding; without one the last report stays."""
        if finding.report is None or finding.report is self.report:
            return
        self.report = finding.report
        for button in (self.copy_text, self.copy_latex):
            button.setEnabled(True)
        self._write()

    def _write(self) -> None:
        if self.report is None:
            return
        bar = self.page.verticalScrollBar()
        place = bar.value()
        self.page.setHtml(arranged(sections(self.report), palette_of(self).muted_text))
        bar.setValue(place)  # what was being read stays in sight

    def _copy(self, form: str) -> None:
        if self.report is not None:
            words = as_text(self.report) if form == "text" else as_latex(self.report)
            QGuiApplication.clipboard().setText(words)
            self.told.emit(f"Copied the report as {form}.")

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "copy_latex"):
            self._write()

    @guarded
    def showEvent(self, event: QShowEvent) -> None:
        """Ask for reports."""
        super().showEvent(event)
        self.read.emit(True)

    @guarded
    def hideEvent(self, event: QHideEvent) -> None:
        """Nobody reads any more."""
        super().hideEvent(event)
        self.read.emit(False)


def arranged(sections: list[tuple[str, list[str]]], muted: str) -> str:
    """A report as rich text: headings, formulas, long sums that break between terms.

    Parameters
    ----------
    sections
        Titles and rows, as of `core.wording.sections`.
    muted
        Colour of what a formula defines, ``"#rrggbb"``.
    """
    parts = []
    for title, rows in sections:
        parts.append(f"<h3 style='margin: 14px 0 4px 0'>{_formula(title)}</h3>")
        parts += [_paragraph(_formula(row), muted) for row in rows]
    return "".join(parts)


def _paragraph(words: str, muted: str) -> str:
    """One row: what a formula defines above the formula, or a sentence."""
    row = _FORMULA.match(words)
    if row is None:
        return f"<p style='margin: 2px 0'>{words}</p>"
    return (
        f"<p style='margin: 6px 0 0 0; color: {muted}'>{row[1]}</p>"
        f"<p style='margin: 0 0 0 12px'><tt>{row[2]}</tt></p>"
    )


def _formula(line: str) -> str:
    words = html.escape(line, quote=False)
    for pattern, letters in _SYMBOLS:
        words = pattern.sub(letters, words)
    return _TERM.sub(f"\\1{NBSP}\\2{NBSP}\\3", words)
