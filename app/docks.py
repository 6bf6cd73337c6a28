"""The panels around the canvas: where they stand at first, and what comes later.

The lists and the plots come after the first paint, onto their own empty ground; report and map,
hidden at first, when they are first seen.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QFrame, QSplitter, QVBoxLayout, QWidget

if TYPE_CHECKING:
    from app.plots import BasisPlot, StepPlot
    from app.session import Session
    from app.window import MainWindow

SIDE_PX: Final = 300
"""Breadth of the panels on the right: sliders fine enough to set hundredths."""

PLOTS_PX: Final = 200
"""Height of the plots: the curve stays the largest thing in the window."""

SCHEME_PX: Final = 282
"""Height of the scheme panel: all of it, with some air."""

LISTS_PX: Final = 464
"""Height of the lists: what is left of the right side at 1280 x 800."""

CURVES_PX: Final = 92
"""Height of the list of curves: four rows; the points take the rest."""

Area = Qt.DockWidgetArea


class Docks:
    """The docks of a window.

    Parameters
    ----------
    window
        The window that they belong to. Its `scheme` is there already; its `curves`, `points`,
        `report` and `map` are asked for when they are needed.
    """

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self.scheme = self._dock("Scheme", window.scheme)
        self.lists = self._dock("Curves and points", _waiting())
        self._makers: dict[QDockWidget, Callable[[], QWidget]] = {
            self.lists: lambda: _stacked(window.curves, window.points)
        }
        self.report = self._late_dock("Report", lambda: window.report)
        self.map = self._late_dock("Map", lambda: window.map)
        self.basis = self._dock("Basis function", _waiting())
        self.step = self._dock("Step response", _waiting())
        self.basis_plot: BasisPlot | None = None
        self.step_plot: StepPlot | None = None
        window.setDockNestingEnabled(True)
        window.setCorner(Qt.Corner.BottomRightCorner, Area.RightDockWidgetArea)
        window.setCorner(Qt.Corner.BottomLeftCorner, Area.BottomDockWidgetArea)
        window.addDockWidget(Area.RightDockWidgetArea, self.scheme)
        window.addDockWidget(Area.RightDockWidgetArea, self.lists)
        for dock in (self.report, self.map):
            window.tabifyDockWidget(self.lists, dock)
            dock.hide()
        window.addDockWidget(Area.BottomDockWidgetArea, self.basis)
        window.splitDockWidget(self.basis, self.step, Qt.Orientation.Horizontal)

    @property
    def all(self) -> tuple[QDockWidget, ...]:
        """The docks, in the order of the View menu."""
        return (self.scheme, self.lists, self.report, self.map, self.basis, self.step)

    def size(self) -> None:
        """Give the docks their first sizes; to be called once the window has its own."""
        window = self._window
        window.resizeDocks([self.scheme], [SIDE_PX], Qt.Orientation.Horizontal)
        window.resizeDocks(
            [self.scheme, self.lists], [SCHEME_PX, LISTS_PX], Qt.Orientation.Vertical
        )
        window.resizeDocks([self.basis], [PLOTS_PX], Qt.Orientation.Vertical)
        half = max((window.width() - SIDE_PX) // 2, 1)
        window.resizeDocks([self.basis, self.step], [half, half], Qt.Orientation.Horizontal)

    def open(self, dock: QDockWidget) -> None:
        """Show a dock, before others that share its place."""
        self._fill(dock)
        dock.show()
        dock.raise_()

    def fill_lists(self) -> None:
        """Put the lists where they belong; takes 10 ms."""
        self._fill(self.lists)

    def plot(self, session: Session) -> None:
        """Load pyqtgraph and put the plots where they belong; takes a third of a second."""
        from app.plots import BasisPlot, StepPlot

        self.basis_plot, self.step_plot = BasisPlot(session), StepPlot(session)
        for dock, plot in ((self.basis, self.basis_plot), (self.step, self.step_plot)):
            _replace(dock, _framed(plot))

    def _dock(self, title: str, content: QWidget) -> QDockWidget:
        dock = QDockWidget(title, self._window)
        dock.setObjectName(title)
        dock.setAccessibleName(title)
        dock.setWidget(content)
        return dock

    def _late_dock(self, title: str, make: Callable[[], QWidget]) -> QDockWidget:
        """Return a dock whose content is made when it is first seen."""
        dock = self._dock(title, _waiting())
        self._makers[dock] = make
        dock.visibilityChanged.connect(lambda seen: self._fill(dock) if seen else None)
        return dock

    def _fill(self, dock: QDockWidget) -> None:
        make = self._makers.pop(dock, None)
        if make is not None:
            _replace(dock, make())


def _stacked(curves: QWidget, points: QWidget) -> QSplitter:
    """The list of curves above the table of their points."""
    splitter = QSplitter(Qt.Orientation.Vertical)
    splitter.addWidget(curves)
    splitter.addWidget(points)
    splitter.setChildrenCollapsible(False)
    splitter.setStretchFactor(1, 1)
    splitter.setSizes([CURVES_PX, LISTS_PX - CURVES_PX])
    return splitter


def _replace(dock: QDockWidget, content: QWidget) -> None:
    before = dock.widget()
    dock.setWidget(content)
    before.deleteLater()


def _waiting() -> QWidget:
    """What stands in a list's or a plot's place until it is made: its ground, as high as it."""
    ground = QFrame()
    ground.setAutoFillBackground(True)
    ground.setBackgroundRole(ground.palette().ColorRole.Base)
    return _framed(ground)


def _framed(content: QWidget) -> QWidget:
    content.setMinimumSize(160, 90)
    frame = QWidget()
    layout = QVBoxLayout(frame)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.addWidget(content)
    return frame
