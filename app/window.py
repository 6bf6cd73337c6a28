"""The window: canvas, panels, menus and status bar put together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QGuiApplication, QPaintEvent
from PySide6.QtWidgets import QToolBar, QWidget

from app.actions import TOOL_BAR, Actions
from app.canvas import Canvas
from app.dialogs import Dialogs
from app.docks import Docks
from app.files import Files
from app.guard import guarded
from app.landing import Landing
from app.menus import fill_menu_bar, open_context_menu
from app.opening import ready_document
from app.point_set import PointSet
from app.session import Selection, Session
from app.settings import STATE_VERSION, Settings, on_screen
from app.sliders import SchemePanel
from app.status import StatusBar
from core.document import Curve

if TYPE_CHECKING:
    from app.analysis import Analysis, Finding
    from app.clipboard import Clipboard
    from app.drops import Drops
    from app.exporting import Exporter
    from app.importing import Importer
    from app.map_panel import MapPanel
    from app.panels import CurvesPanel, PointsPanel
    from app.report_panel import ReportPanel

DEFAULT_SIZE: Final = (1280, 800)
"""Size of the window at the first start, in logical pixels."""

TOOL_ICON_PX: Final = 20
"""Size of the icons in the tool bar."""


class MainWindow(Landing):
    """Everything that a user sees.

    Parameters
    ----------
    session
        The document.
    settings
        What is remembered between two starts.
    dialogs
        Asks questions; tests answer in its place.

    Signals
    -------
    painted()
        The first paint is done.
    completed()
        All is loaded and shown, the plots too, some time after the first paint.
    """

    painted = Signal()
    completed = Signal()

    session: Session
    settings: Settings
    dialogs: Dialogs
    files: Files
    canvas: Canvas
    scheme: SchemePanel
    commands: Actions
    shows_slope: bool

    def __init__(
        self,
        session: Session | None = None,
        settings: Settings | None = None,
        dialogs: Dialogs | None = None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.session = session or Session(ready_document(), self)
        self.settings = settings or Settings()
        self.dialogs = dialogs or Dialogs(self)
        self._painted = False
        self.shows_slope = False
        self.files = Files(self.session, self.settings, self.dialogs, self)
        self.canvas = Canvas(self.session, self)
        self.scheme = SchemePanel(self.session)
        self._stops: list[Callable[[], None]] = []
        self.setCentralWidget(self.canvas)
        self.docks = Docks(self)
        self.status = StatusBar(self)
        self.setStatusBar(self.status)
        self.commands = Actions(self)
        self.tool_bar = self._make_tool_bar()
        fill_menu_bar(self)
        self._connect()
        self.resize(*DEFAULT_SIZE)
        self.docks.size()
        self._first_arrangement = self.saveState(STATE_VERSION)
        self._show_title()
        self.canvas.setFocus()

    def _make_tool_bar(self) -> QToolBar:
        bar = QToolBar("Tools", self)
        bar.setObjectName("Tools")
        bar.setAccessibleName("Tools")
        bar.setIconSize(QSize(TOOL_ICON_PX, TOOL_ICON_PX))
        for key in TOOL_BAR:
            if key:
                bar.addAction(self.commands[key])
            else:
                bar.addSeparator()
        self.addToolBar(Qt.ToolBarArea.LeftToolBarArea, bar)
        return bar

    def _connect(self) -> None:
        session, canvas, status = self.session, self.canvas, self.status
        session.status_changed.connect(self._show_title)
        session.status_changed.connect(self.commands.refresh)
        session.selection_changed.connect(lambda _old, _new: self.commands.refresh())
        self.files.title_changed.connect(self._show_title)
        self.files.opened.connect(canvas.fit_all)
        canvas.hint_changed.connect(status.show_hint)
        canvas.cursor_moved.connect(status.show_cursor)
        canvas.zoom_changed.connect(status.show_zoom)
        canvas.measure.changed.connect(status.show_size)
        canvas.tool_changed.connect(lambda _tool: self.commands.refresh())
        canvas.customContextMenuRequested.connect(lambda at: open_context_menu(self, at))
        status.proof.clicked.connect(self.commands["report"].trigger)
        self.files.told.connect(status.tell)
        self.files.foreign.connect(lambda path: self.importer.open(path))
        self.scheme.refused.connect(status.tell)

    # What the first paint does not need is made when it is first asked for: 25 ms.

    @cached_property
    def curves(self) -> CurvesPanel:
        """The list of curves."""
        from app.panels import CurvesPanel

        return CurvesPanel(self.session)

    @cached_property
    def points(self) -> PointsPanel:
        """The table of the current curve's points."""
        from app.panels import PointsPanel

        panel = PointsPanel(self.session)
        panel.refused.connect(self.status.tell)
        panel.told.connect(self.status.tell)
        return panel

    @cached_property
    def analysis(self) -> Analysis:
        """What finds out about the scheme."""
        from app.analysis import Analysis

        analysis = Analysis(self.session, self)
        analysis.changed.connect(self._show_finding)
        self._stops.append(analysis.stop)
        return analysis

    @cached_property
    def exporter(self) -> Exporter:
        """What writes files for other programs."""
        from app.exporting import Exporter

        exporter = Exporter(self.session, self.files, self.settings, self.dialogs, self)
        exporter.told.connect(self.status.tell)
        self._stops.append(exporter.stop)
        return exporter

    @cached_property
    def importer(self) -> Importer:
        """What takes in files of other programs."""
        from app.importing import Importer

        importer = Importer(self.session, self.files, self.settings, self.dialogs, self)
        importer.told.connect(self.status.tell)
        importer.added.connect(self.canvas.reveal_selection)
        self._stops.append(importer.stop)
        return importer

    @cached_property
    def clipboard(self) -> Clipboard:
        """What cuts, copies and pastes."""
        from app.clipboard import Clipboard

        clipboard = Clipboard(self.session, self.canvas, self.importer, self)
        clipboard.told.connect(self.status.tell)
        self._stops.append(clipboard.stop)
        return clipboard

    @cached_property
    def report(self) -> ReportPanel:
        """The report on the scheme."""
        from app.report_panel import ReportPanel

        panel = ReportPanel()
        panel.read.connect(self.analysis.want_report)
        panel.told.connect(self.status.tell)
        self.analysis.changed.connect(panel.show_finding)
        return panel

    @cached_property
    def map(self) -> MapPanel:
        """The map of parameters."""
        from app.map_panel import MapPanel

        panel = MapPanel(self.session)
        self._stops.append(panel.stop)
        return panel

    @cached_property
    def drops(self) -> Drops:
        """What takes what is dropped."""
        from app.drops import Drops

        return Drops(self)

    @property
    def current_curve(self) -> Curve | None:
        """The curve that new points go to, if there is any."""
        curves = self.session.document.curves
        return curves[self.session.selection.curve] if curves else None

    def undo(self) -> None:
        """Take the last step back: a drag that is going on, or a whole burst of arrow keys."""
        self.scheme.settle()
        if QGuiApplication.mouseButtons() == Qt.MouseButton.NoButton:
            self.session.commit()  # a burst of keys is complete now, and can be redone
        self.session.undo()

    def redo(self) -> None:
        """Bring the last undone step back."""
        self.scheme.settle()
        self.session.redo()

    def toggle_closed(self) -> None:
        """Close, or open, the curves that are selected: all alike, as the current one goes."""
        current = self.current_curve
        if current is None:
            return
        document, selection = self.session.document, self.session.selection
        chosen = {*selection.points.by_curve, selection.curve}
        curves = tuple(
            replace(curve, closed=not current.closed) if index in chosen else curve
            for index, curve in enumerate(document.curves)
        )
        verb, noun = ("Open" if current.closed else "Close"), f"{len(chosen)} curves"
        name = f"{verb} {'curve' if len(chosen) == 1 else noun}"
        self.session.edit(replace(document, curves=curves), name)

    def reverse_curve(self) -> None:
        """Run through the current curve backwards; the same points stay selected."""
        current = self.current_curve
        if current is None:
            return
        selection, last = self.session.selection, current.count - 1
        turned = replace(current, points=current.points[::-1])
        document = self.session.document.with_curve(selection.curve, turned)
        self.session.edit(document, "Reverse curve")
        points = dict(selection.points.by_curve)
        points[selection.curve] = last - selection.points.of_curve(selection.curve)
        self.session.select(Selection(PointSet(points), selection.curve))

    def delete_curve(self) -> None:
        """Delete the current curve with all of its points."""
        if self.current_curve is not None:
            index = self.session.selection.curve
            self.session.select(Selection(curve=max(index - 1, 0)))
            self.session.edit(self.session.document.without_curves({index}), "Delete curve")

    def toggle_polygon(self) -> None:
        """Show or hide control polygon and points."""
        self.canvas.show_polygon = not self.canvas.show_polygon

    def toggle_grid(self) -> None:
        """Show or hide the grid."""
        self.canvas.show_grid = not self.canvas.show_grid

    def toggle_slope(self) -> None:
        """Show or hide the derivative in the plot of the basis function."""
        self.shows_slope = not self.shows_slope
        if self.docks.basis_plot is not None:
            self.docks.basis_plot.show_slope(self.shows_slope)

    def reset_layout(self) -> None:
        """Put the panels and tool bars back to where they were at first."""
        self.restoreState(self._first_arrangement, STATE_VERSION)
        self.docks.size()

    def show_report(self) -> None:
        """Open the report on the scheme, and read it with the keyboard."""
        self.docks.open(self.docks.report)
        self.report.page.setFocus()

    def show_map(self) -> None:
        """Open the map of parameters."""
        self.docks.open(self.docks.map)
        self.map.chart.setFocus()

    def stop(self) -> None:
        """End all work in the background; no worker outlives the window."""
        for stop in self._stops:
            stop()

    def show_keys(self) -> None:
        """Show the sheet of keys."""
        from app.keysheet import KeySheet  # rarely wanted

        sheet = KeySheet(self)
        sheet.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        sheet.open()

    def show_about(self) -> None:
        """Show name, version and licence."""
        self.dialogs.about()

    def restore(self) -> None:
        """Take the place and the arrangement of the last time, on a screen that exists now."""
        rect = self.settings.window_rect
        if rect is not None:
            screens = [screen.availableGeometry() for screen in QGuiApplication.screens()]
            self.setGeometry(on_screen(rect, screens))
        else:
            self._centre()
        if not self.settings.arrangement.isEmpty():
            self.restoreState(self.settings.arrangement, STATE_VERSION)
        if self.settings.maximised:
            self.setWindowState(self.windowState() | Qt.WindowState.WindowMaximized)

    def _centre(self) -> None:
        """Take the middle of the screen, and no more than there is of it."""
        free = QGuiApplication.primaryScreen().availableGeometry()
        size = QSize(*DEFAULT_SIZE).boundedTo(free.size())
        rest = (free.size() - size) / 2
        self.setGeometry(QRect(free.topLeft() + QPoint(rest.width(), rest.height()), size))

    def _remember(self) -> None:
        self.settings.window_rect = self.normalGeometry()
        self.settings.maximised = self.isMaximized()
        self.settings.arrangement = self.saveState(STATE_VERSION)

    def _show_finding(self, finding: Finding) -> None:
        self.scheme.badge.show_finding(finding)
        self.status.show_finding(finding)
        self.canvas.show_notice(finding.notice)

    def _show_title(self) -> None:
        # Qt replaces "[*]" by the mark of unsaved changes; doubled it is taken as it stands.
        name = self.files.title.replace("[*]", "[*][*]")
        self.setWindowTitle(f"{name}[*] - Ninepoint")
        self.setWindowModified(self.session.is_modified)

    def _complete(self) -> None:
        self.painted.emit()
        self.docks.fill_lists()
        # The keyboard reaches what came late where it stands: after the scheme, not at the end.
        self.setTabOrder([*self.scheme.neighbours.values()][-1], self.curves.list)
        self.setTabOrder(self.curves.list, self.points.table)
        self.commands.tint()
        self.docks.plot(self.session)
        if self.shows_slope and self.docks.basis_plot is not None:
            self.docks.basis_plot.show_slope(True)
        self.analysis.start()
        self.canvas.measure.start()
        QTimer.singleShot(0, self, self.completed.emit)

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        """After the first paint, load what it did not need; on another screen, draw new icons."""
        super().paintEvent(event)
        if not self._painted:
            self._painted = True
            QTimer.singleShot(0, self, self._complete)
        elif self.commands.ratio != self.devicePixelRatioF():
            QTimer.singleShot(0, self, self.commands.tint)

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Draw the icons anew in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "commands"):
            self.commands.tint()

    @guarded
    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about unsaved changes; remember the window's place."""
        event.ignore()  # stands if anything below fails: better open than lost
        if self.files.may_leave():
            self._remember()
            self.stop()
            event.accept()
