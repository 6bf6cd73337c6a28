"""The scheme panel: preset, the three parameters, the choice of neighbours, what is proven."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Final, NamedTuple

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QRadioButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.badge import Badge
from app.fields import NumberField, shown_number
from app.guard import guarded
from app.session import Session
from app.track import Track
from core.document import Document
from core.family import PRESETS, Neighbours, Parameters, default_box

STEPS_PER_UNIT: Final = 200
"""Positions of a slider per unit: steps of 0.005, which are exact and short in decimals."""

BURST_MS: Final = 600
"""Arrow presses that follow each other within this time are one step of undo."""

CUSTOM: Final = "Custom"
"""What the preset menu shows for parameters without a name."""

PRESET_TIPS: Final[dict[str, str]] = {
    "Lagrange": "Keeps closest to the polygon, and rings: 12\u00a0% overshoot. C\u00b2.",
    "Calm": "Halfway: smooth, with hardly any overshoot (0.03\u00a0%). C\N{SUPERSCRIPT THREE}.",
    "Tight": "Pulled tight around bends, rings a little (5\u00a0%). C\N{SUPERSCRIPT FOUR}.",
    "Lean": "Leans along the direction of the polygon. C\N{SUPERSCRIPT THREE}.",
    "B-spline": "Smoothest of all, cuts corners, never overshoots. C\u00b9\u00b9.",
}
"""What each preset does to a curve."""

NEIGHBOUR_TIPS: Final[dict[Neighbours, str]] = {
    "translated": "Both rules combine the same neighbours. When \u03b1 and \u03b3 differ, the "
    "curve leans to one side and keeps its smoothness.",
    "mirrored": "The odd rule swaps \u03b1 and \u03b3. A symmetric polygon gives a symmetric "
    "curve, but when \u03b1 and \u03b3 differ it is at most C\N{SUPERSCRIPT TWO}.",
}
"""What each choice of neighbours does; they agree when alpha = gamma."""


class Weight(NamedTuple):
    """One of the three parameters, as the panel presents it."""

    name: str
    symbol: str
    tip: str


WEIGHTS: Final = (
    Weight(
        "alpha",
        "\u03b1",
        "Alpha: weight of the left neighbour's displacement. Equal to gamma it tightens the"
        " curve; different from gamma it leans it.",
    ),
    Weight(
        "beta",
        "\u03b2",
        "Beta: weight of the own displacement. From 0 (close to the polygon) to \N{MINUS SIGN}1"
        " (very smooth).",
    ),
    Weight(
        "gamma",
        "\u03b3",
        "Gamma: weight of the right neighbour's displacement. Equal to alpha it tightens the"
        " curve; different from alpha it leans it.",
    ),
)


class SchemePanel(QWidget):
    """Preset menu, three sliders with number fields, the neighbours' switch, and the badge.

    What the session changes is shown and never comes back as an edit; a drag, or a burst of arrow
    keys, is one step of undo.

    Parameters
    ----------
    session
        The document.

    Signals
    -------
    refused(sentence)
        A number was refused.
    """

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._showing = False
        # A ground of its own, though it is the window's: what changes on it is then painted without
        # the dock and the window behind it.
        self.setAutoFillBackground(True)
        self._burst = QTimer(self)
        self._burst.setSingleShot(True)
        self._burst.setInterval(BURST_MS)
        self._burst.timeout.connect(session.commit)
        self.preset = QComboBox()
        self.description = QLabel()
        self.tracks: dict[str, Track] = {}
        self.fields: dict[str, NumberField] = {}
        self.neighbours: dict[str, QRadioButton] = {}
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 10, 12, 12)
        layout.setSpacing(10)
        self._add_presets(layout)
        self._add_weights(layout)
        self._add_neighbours(layout)
        self.badge = Badge()
        layout.addWidget(self.badge)
        layout.addStretch()
        session.changed.connect(self._on_changed)
        self._show(session.document.parameters)

    def _add_presets(self, layout: QVBoxLayout) -> None:
        self.preset.setAccessibleName("Preset")
        for name in PRESETS:
            self.preset.addItem(name)
            self.preset.setItemData(
                self.preset.count() - 1, PRESET_TIPS[name], Qt.ItemDataRole.ToolTipRole
            )
        self.preset.activated.connect(self._choose_preset)
        row = QHBoxLayout()
        row.setSpacing(10)
        label = QLabel("&Preset")
        label.setBuddy(self.preset)
        row.addWidget(label)
        row.addWidget(self.preset, 1)
        layout.addLayout(row)
        self.description.setWordWrap(True)
        self.description.setForegroundRole(self.description.palette().ColorRole.PlaceholderText)
        # Room for two lines at all times: the sliders below must not jump under the hand.
        self.description.setMinimumHeight(2 * self.description.fontMetrics().lineSpacing())
        self.description.setAlignment(Qt.AlignmentFlag.AlignTop)
        layout.addWidget(self.description)

    def _add_weights(self, layout: QVBoxLayout) -> None:
        grid = QGridLayout()
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(8)
        grid.setColumnStretch(1, 1)
        for row, weight in enumerate(WEIGHTS):
            label = ResetLabel(weight.symbol)
            track = Track()
            field = NumberField(weight.name, partial(_check, weight.name))
            tip = weight.tip + " Double click resets."
            label.setToolTip(tip)
            track.setToolTip(tip)
            track.setAccessibleName(weight.name)
            track.setAccessibleDescription(weight.tip)
            track.setPageStep(STEPS_PER_UNIT // 20)
            field.set_explanation(f"{weight.name}: a number such as 0.25 or 1/4")
            field.setFixedWidth(field.fontMetrics().horizontalAdvance("\N{MINUS SIGN}0.0000") + 18)
            label.setBuddy(field)
            self._connect(weight.name, label, track, field)
            self.tracks[weight.name] = track
            self.fields[weight.name] = field
            grid.addWidget(label, row, 0)
            grid.addWidget(track, row, 1)
            grid.addWidget(field, row, 2)
        layout.addLayout(grid)

    def _connect(self, name: str, label: ResetLabel, track: Track, field: NumberField) -> None:
        track.taken.connect(lambda: self._session.begin(self._set_name(name)))
        track.left.connect(self._session.commit)
        track.dropped.connect(self._session.cancel)
        track.reset.connect(lambda: self.reset(name))
        track.blurred.connect(self.settle)
        track.valueChanged.connect(lambda value: self._slide(name, value))
        label.doubled.connect(lambda: self.reset(name))
        field.entered.connect(lambda number: self._edit(name, number))
        field.refused.connect(self.refused)

    def _add_neighbours(self, layout: QVBoxLayout) -> None:
        label = QLabel("Neighbours")
        row = QHBoxLayout()
        row.setSpacing(14)
        row.addWidget(label)
        group = QButtonGroup(self)
        for key, tip in NEIGHBOUR_TIPS.items():
            button = QRadioButton(key.capitalize())
            button.setAccessibleName(f"Neighbours {key}")
            button.setToolTip(tip)
            button.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
            button.clicked.connect(lambda _checked, key=key: self.choose_neighbours(key))
            group.addButton(button)
            row.addWidget(button)
            self.neighbours[key] = button
        row.addStretch()
        layout.addLayout(row)

    def choose_preset(self, name: str) -> None:
        """Take over a preset's four values; one step of undo."""
        self.settle()
        document = self._session.document
        if document.parameters != PRESETS[name]:
            self._session.edit(document.with_parameters(PRESETS[name]), f"Preset {name}")

    def choose_neighbours(self, key: str) -> None:
        """Go over to the translated or the mirrored rule; one step of undo."""
        self.settle()
        document = self._session.document
        old = document.parameters
        if key != old.neighbours:
            new = Parameters(old.alpha, old.beta, old.gamma, key)
            self._session.edit(document.with_parameters(new), f"Neighbours {key}")

    def reset(self, name: str) -> None:
        """Bring one parameter back to its mark."""
        self.settle()
        self._edit(name, default(name))

    def settle(self) -> None:
        """Close a burst of arrow keys, so that what follows is a step of its own."""
        if self._burst.isActive():
            self._burst.stop()
            self._session.commit()

    def _choose_preset(self, index: int) -> None:
        name = self.preset.itemText(index)
        if name in PRESETS:
            self.choose_preset(name)

    def _set_name(self, name: str) -> str:
        value: Fraction = getattr(self._session.document.parameters, name)
        return f"Set {name} {shown_number(value)}"

    def _slide(self, name: str, steps: int) -> None:
        """A track was moved by the user: within a drag, or by a key or the wheel."""
        if self._showing:
            return
        held = self.tracks[name].is_held
        begins = not held and not self._burst.isActive()
        if begins or not self._session.in_gesture:
            self._session.begin(self._set_name(name))
        if not held:
            self._burst.start()
        self._change(name, Fraction(steps, STEPS_PER_UNIT), self._session.adjust)

    def _edit(self, name: str, value: Fraction) -> None:
        self._change(name, value, self._session.edit)

    def _change(
        self, name: str, value: Fraction, take: Callable[[Document, str], None]
    ) -> None:
        document = self._session.document
        old = document.parameters
        values = {"alpha": old.alpha, "beta": old.beta, "gamma": old.gamma, name: value}
        new = Parameters(**values, neighbours=old.neighbours)
        if new != old:
            take(document.with_parameters(new), f"Set {name} {shown_number(value)}")

    def _on_changed(self, old: Document, new: Document) -> None:
        if old.parameters is not new.parameters:
            self._show(new.parameters)

    def _show(self, parameters: Parameters) -> None:
        self._showing = True
        try:
            box = default_box(parameters.neighbours)
            for weight in WEIGHTS:
                value: Fraction = getattr(parameters, weight.name)
                track = self.tracks[weight.name]
                # All members within these ranges converge, and the rest can still be typed.
                track.setRange(*(round(end * STEPS_PER_UNIT) for end in box[weight.name]))
                track.show_value(
                    round(value * STEPS_PER_UNIT), round(default(weight.name) * STEPS_PER_UNIT)
                )
                self.fields[weight.name].set_number(value)
            self.neighbours[parameters.neighbours].setChecked(True)
            self._show_preset(parameters.name)
        finally:
            self._showing = False

    def _show_preset(self, name: str | None) -> None:
        custom = self.preset.findText(CUSTOM)
        if name is None and custom < 0:
            self.preset.addItem(CUSTOM)
        elif name is not None and custom >= 0:
            self.preset.removeItem(custom)
        self.preset.setCurrentText(CUSTOM if name is None else name)
        tip = "Your own mixture of the weights below." if name is None else PRESET_TIPS[name]
        if tip != self.description.text():
            self.description.setText(tip)
            self.preset.setToolTip(tip)


class ResetLabel(QLabel):
    """A label whose double click is heard.

    Signals
    -------
    doubled()
        It was double-clicked.
    """

    doubled = Signal()

    @guarded
    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Tell of the double click."""
        self.doubled.emit()
        event.accept()


def _check(name: str, number: Fraction) -> None:
    """Refuse a number that is no admitted parameter, with the sentence of `Parameters`."""
    Parameters(**{name: number})  # type: ignore[arg-type]


def default(name: str) -> Fraction:
    """Value that a double click resets to, and that the mark shows: that of Calm."""
    value: Fraction = getattr(PRESETS["Calm"], name)
    return value
