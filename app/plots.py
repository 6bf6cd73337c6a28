"""The analysis plots: basic limit function and step response.

This module imports pyqtgraph, which takes longer to load than the rest of the program together;
the window imports it after its first paint.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QBrush, QFont, QPen, QWheelEvent
from PySide6.QtWidgets import QGraphicsItem, QWidget

from app.guard import guarded
from app.session import Session
from app.style import Palette, color, palette_of
from app.trace import Trace
from core.basis import BasicLimitFunction
from core.chords import COARSE_LEVEL, grows
from core.continuity import certificate
from core.document import Document
from core.errors import NoLimitError
from core.family import Parameters
from core.gibbs import Gibbs, StepResponse, step_gibbs
from core.mask import Mask
from core.wording import percentage

LEVEL: Final = 5
"""Dyadic level of the drawn functions: 32 points per span, some 10 pixels each at most."""

HALF_WIDTH: Final = 9.5
"""The plots show t from -9.5 to 9.5: the widest support, 17, with a margin."""

BASIS_RANGE: Final = (-0.25, 1.3)
"""What is seen of phi at least; every preset fits, so that their heights can be compared."""

STEP_RANGE: Final = (-0.25, 1.35)
"""The same for the step response, with room for the words above it."""

RANGE_STEP: Final = 0.25
"""Beyond that, the range grows in such steps, so that it does not tremble under the sliders."""

BOTTOM_MARGIN: Final = 0.06
"""Room below the curve for the mark at its lowest point."""

TOP_MARGIN: Final = 0.22
"""Room above the curve for the words."""

COARSE_RANGE: Final = 3.0
"""Ranges above this are labelled in steps of 2 instead of 1/2, so that labels never touch."""

NOTE_SHARE: Final = 0.7
"""Breadth, as a share of the plot's, in which a sentence that explains is broken into lines."""

NOTE_OPACITY: Final = 0.8
"""Of the ground behind the words where a wild function runs through them."""

WIDEST: Final = 4.0
"""Largest value that the range grows to; a function that runs away is cut off there."""

LEAST_PEAK: Final = 1e-6
"""Overshoot below this is not marked: it could not be seen."""

CURVE_PX: Final = 1.5
"""Width of the plotted line."""


class AnalysisPlot(pg.PlotWidget):
    """A small plot over t that only shows: no mouse, no menu, no grid, fixed axes.

    Subclasses say what is drawn in `draw` and how it is coloured in `paint_with`.

    Parameters
    ----------
    session
        The document whose parameters are shown.
    name
        What the plot is called to screen readers.
    least
        The range of values that is always seen.
    """

    def __init__(
        self, session: Session, name: str, least: tuple[float, float], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._least = least
        self._range: tuple[float, float] | None = None
        self._is_wild = False
        self.setAccessibleName(name)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        # A scene has its window painted as soon as its own items have settled: of two plots the
        # second would come a picture later. So each says itself when it shows something else.
        self.setViewportUpdateMode(pg.GraphicsView.ViewportUpdateMode.NoViewportUpdate)
        item = self.getPlotItem()
        item.hideButtons()
        item.setMenuEnabled(False)
        item.setMouseEnabled(False, False)
        item.getAxis("bottom").setTicks([[(t, _tick(t)) for t in range(-8, 9, 4)]])
        item.getAxis("left").setWidth(30)
        item.getAxis("bottom").setHeight(22)
        for side in ("bottom", "left"):
            item.getAxis(side).setStyle(tickLength=-4, tickTextOffset=4)
            item.getAxis(side).setCacheMode(QGraphicsItem.CacheMode.DeviceCoordinateCache)
        item.setContentsMargins(2, 6, 8, 2)
        item.setXRange(-HALF_WIDTH, HALF_WIDTH, padding=0)
        self.zero = pg.InfiniteLine(0.0, angle=0)
        self.curve = Trace()
        self.note = pg.TextItem(anchor=(0.5, 0.0))
        self.note.setZValue(10)
        for part in (self.zero, self.curve, self.note):
            item.addItem(part, ignoreBounds=True)
        self._parts: tuple[pg.GraphicsObject, ...] = (self.zero, self.curve)
        self._build(item)
        session.changed.connect(self._on_changed)
        self._colour()
        self.show_parameters(session.document.parameters)

    def _build(self, item: pg.PlotItem) -> None:
        """Add what the plot draws besides the curve."""

    def draw(self, parameters: Parameters) -> str:
        """Put the function into the items; return the words on the plot.

        Raises
        ------
        NoLimitError
            If the scheme has none; the plot is then cleared and says so.
        """
        raise NotImplementedError

    def paint_with(self, colours: Palette, ratio: float) -> None:
        """Colour what `_build` added; ``ratio`` is the number of device pixels in a pixel."""

    @property
    def sentence(self) -> str:
        """The words on the plot."""
        return str(self.note.toPlainText())

    def show_parameters(self, parameters: Parameters) -> None:
        """Draw the function of other parameters, or say why there is none."""
        try:
            sentence = self.draw(parameters)
            found, self._is_wild = True, grows(parameters.mask)
        except NoLimitError as error:
            sentence, found, self._is_wild = str(error), False, False
            self.curve.clear()
        for part in self._parts:
            part.setVisible(found)
        self.setAccessibleDescription(sentence)
        if self.note.textItem.toPlainText() != sentence:
            self.note.setText(sentence)
        width = -1.0 if found else self.width() * NOTE_SHARE
        if width != self.note.textItem.textWidth():
            self.note.setTextWidth(width)
        self._ground_note()
        self._place_note()
        self.viewport().update()

    def _show_curve(
        self,
        t: NDArray[np.float64],
        values: NDArray[np.float64],
        others: NDArray[np.float64] | None = None,
    ) -> None:
        """Put values into the curve, and choose a range that holds the others as well."""
        seen = np.fmax(np.fmin(values, WIDEST), -WIDEST)  # what is no number is nowhere, or high
        self.curve.put(t, seen)
        if others is not None:
            seen = np.concatenate([seen, np.clip(others, -WIDEST, WIDEST)])
        low, high = self._least
        low -= _grown(low + BOTTOM_MARGIN - seen.min())
        high += _grown(seen.max() - (high - TOP_MARGIN))
        if (low, high) == self._range:
            return  # new ticks would have the axes drawn anew
        self._range = (low, high)
        item = self.getPlotItem()
        item.setYRange(low, high, padding=0)
        ticks = (-2, 0, 2, 4) if high - low > COARSE_RANGE else (0, 0.5, 1)
        item.getAxis("left").setTicks([[(v, _tick(v)) for v in ticks if low <= v <= high]])

    def _ground_note(self) -> None:
        """Give the words a ground of their own where a wild function runs through them."""
        ground = color(palette_of(self).plot_background, NOTE_OPACITY if self._is_wild else 0.0)
        self.note.fill = QBrush(ground)

    def _place_note(self) -> None:
        _, (_, top) = self.getPlotItem().viewRange()
        self.note.setPos(QPointF(0.0, top))

    def _on_changed(self, old: Document, new: Document) -> None:
        if old.parameters is not new.parameters:
            self.show_parameters(new.parameters)

    def _colour(self) -> None:
        item = self.getPlotItem()
        if item is None:
            return  # pyqtgraph takes a closed plot apart, but Qt goes on telling it of palettes
        # Widths of pyqtgraph's pens are device pixels.
        colours, ratio = palette_of(self), self.devicePixelRatioF()
        self.setBackground(colours.plot_background)
        font = QFont(self.font())
        font.setPointSizeF(max(font.pointSizeF() - 1, 1.0))
        for side in ("bottom", "left"):
            axis = item.getAxis(side)
            axis.setPen(pg.mkPen(colours.plot_grid, width=ratio))
            axis.setTextPen(pg.mkPen(colours.muted_text))
            axis.setTickFont(font)
        self.zero.setPen(pg.mkPen(colours.axis, width=ratio))
        self.curve.pen = QPen(color(colours.plot_curve), CURVE_PX)
        self.note.setColor(colours.text)
        self._ground_note()
        self.note.setFont(font)
        self.paint_with(colours, ratio)
        self.viewport().update()

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Take over the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "note"):
            self._colour()

    @guarded
    def event(self, event: QEvent) -> bool:
        """Take over the pixels of another screen."""
        if event.type() == QEvent.Type.DevicePixelRatioChange and hasattr(self, "note"):
            self._colour()
        return bool(super().event(event))

    @guarded
    def wheelEvent(self, event: QWheelEvent) -> None:
        """Leave the wheel to whatever scrolls around the plot."""
        event.ignore()


class BasisPlot(AnalysisPlot):
    """The basic limit function: how far, and how strongly, one control point acts."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(session, "Basic limit function", BASIS_RANGE, parent)

    def _build(self, item: pg.PlotItem) -> None:
        self._with_slope = False
        self.support = pg.LinearRegionItem(movable=False)
        self.support.setZValue(-10)
        self.slope = Trace()
        for part in (self.support, self.slope):
            item.addItem(part, ignoreBounds=True)
        self._parts = (*self._parts, self.support, self.slope)

    def show_slope(self, shown: bool) -> None:
        """Show the first derivative too, where it is proven to exist, or not."""
        self._with_slope = shown
        self.show_parameters(self._session.document.parameters)

    def draw(self, parameters: Parameters) -> str:
        """Plot phi(t), its support shaded; the words name the support."""
        phi, level = BasicLimitFunction(parameters.mask), _level(parameters.mask)
        t, slope, names = phi.parameters(level), None, "\u03c6(t)"
        if self._with_slope:
            order = certificate(parameters.mask).order
            if order is not None and order >= 1:
                slope, names = phi.values(level, 1), "\u03c6(t), dashed \u03c6\u2032(t)"
            else:
                names = "\u03c6(t), \u03c6\u2032 not proven"
        self._show_curve(t, phi.values(level), slope)
        if slope is None:
            self.slope.clear()
        else:
            self.slope.put(t, slope)
        left, right = phi.support
        self.support.setRegion((float(left), float(right)))
        return f"{names} \u00b7 support {_tick(left)} \u2026 {_tick(right)}"

    def paint_with(self, colours: Palette, ratio: float) -> None:
        """Shade the support; the derivative differs by its dashes, not by colour alone."""
        self.support.setBrush(pg.mkBrush(colours.plot_fill))
        self.slope.pen = QPen(color(colours.plot_annotation), CURVE_PX, Qt.PenStyle.DashLine)
        for line in self.support.lines:
            line.setPen(pg.mkPen(colours.plot_curve, width=ratio, style=Qt.PenStyle.DashLine))


class StepPlot(AnalysisPlot):
    """The step response: what the scheme makes of a jump, overshoot and undershoot marked."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(session, "Step response", STEP_RANGE, parent)

    def _build(self, item: pg.PlotItem) -> None:
        self.one = pg.InfiniteLine(1.0, angle=0)
        self.one.setZValue(-1)
        item.addItem(self.one, ignoreBounds=True)
        self._parts = (*self._parts, self.one)

    def draw(self, parameters: Parameters) -> str:
        """Plot S(t), from 1 before its support to 0 behind it, with its proven extremes."""
        mask = parameters.mask
        level = _level(mask)
        t = BasicLimitFunction(mask).parameters(level)
        values = StepResponse(mask).values(level)
        outside_t = np.concatenate([[-HALF_WIDTH - 1], t, [HALF_WIDTH + 1]])
        outside = np.concatenate([[1.0], values, [0.0]])
        self._show_curve(outside_t, outside)
        gibbs = step_gibbs(mask)
        peaks = []
        if LEAST_PEAK < gibbs.overshoot.upper < np.inf:
            peaks.append((t[values.argmax()], min(values.max(), WIDEST)))
        if LEAST_PEAK < gibbs.undershoot.upper < np.inf:
            peaks.append((t[values.argmin()], max(values.min(), -WIDEST)))
        self.curve.marks = np.reshape(peaks, (-1, 2))
        return described(gibbs)

    def paint_with(self, colours: Palette, ratio: float) -> None:
        """Colour the level of the data and the marks at the peaks."""
        self.one.setPen(pg.mkPen(colours.axis, width=ratio))
        self.curve.mark_pen = QPen(color(colours.plot_annotation), CURVE_PX)
        self.curve.mark_brush = QBrush(color(colours.plot_background))


def _grown(excess: float) -> float:
    """By how much the range grows for a curve that exceeds it: whole steps."""
    return max(float(np.ceil(excess / RANGE_STEP)), 0.0) * RANGE_STEP


def _tick(value: object) -> str:
    return str(value).replace("-", "\N{MINUS SIGN}")


def described(gibbs: Gibbs) -> str:
    """Overshoot and undershoot of a step response in words, in as many digits as are proven."""
    if np.isinf(gibbs.overshoot.upper) and np.isinf(gibbs.undershoot.upper):
        return "overshoot and undershoot: no bound proven"
    over, under = percentage(gibbs.overshoot), percentage(gibbs.undershoot)
    return f"overshoot {over} \u00b7 undershoot {under}"


def _level(mask: Mask) -> int:
    """Dyadic level at which a function is drawn: a coarse one where finer ones only grow."""
    return COARSE_LEVEL if grows(mask) else LEVEL
