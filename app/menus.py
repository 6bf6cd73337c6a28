"""The menu bar, filled from the table of actions; recent files and examples are looked up."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu

from app.actions import COMMANDS, CONTEXT_MENU, MENUS
from app.assets import example_paths

if TYPE_CHECKING:
    from app.window import MainWindow


def fill_menu_bar(window: MainWindow) -> None:
    """Make the menus of a window."""
    menus = {title: window.menuBar().addMenu(title) for title in MENUS}
    for command in COMMANDS:
        menu = menus[command.menu]
        if command.section and not menu.isEmpty():
            menu.addSeparator()
        if command.key == "reset layout":
            _add_panels(window, menu)
        menu.addAction(window.commands[command.key])
        if command.key == "open":
            _add_lists(window, menu)


def open_context_menu(window: MainWindow, position: QPoint) -> None:
    """Open the menu of the canvas at a place on it."""
    menu = QMenu(window)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    for key in CONTEXT_MENU:
        if key:
            menu.addAction(window.commands[key])
        else:
            menu.addSeparator()
    menu.popup(window.canvas.mapToGlobal(position))


def _add_panels(window: MainWindow, menu: QMenu) -> None:
    menu.addSeparator()
    for dock in window.docks.all:
        action = dock.toggleViewAction()
        action.setStatusTip(f"Show or hide the panel {dock.windowTitle()}")
        menu.addAction(action)
    menu.addAction(window.tool_bar.toggleViewAction())
    menu.addSeparator()


def _add_lists(window: MainWindow, menu: QMenu) -> None:
    recent = menu.addMenu("Open &recent")
    recent.aboutToShow.connect(lambda: _list_recent(window, recent))
    window.files.recent_changed.connect(lambda: recent.setEnabled(bool(window.files.recent)))
    recent.setEnabled(bool(window.files.recent))
    examples = menu.addMenu("Open e&xample")
    for path in example_paths():
        action = examples.addAction(path.stem.replace("-", " ").replace("_", " ").capitalize())
        action.setStatusTip(f"Open the example {path.stem}")
        action.triggered.connect(lambda _checked, path=path: window.files.open_example(path))
    examples.setEnabled(not examples.isEmpty())


def _list_recent(window: MainWindow, menu: QMenu) -> None:
    menu.clear()
    for number, path in enumerate(window.files.recent, start=1):
        # The digit can be typed; an "&" in a name is no mark.
        name = path.name.replace("&", "&&")
        action = menu.addAction(f"&{number} {name}" if number < 10 else name)
        action.setStatusTip(str(path))
        action.setToolTip(str(path))
        action.triggered.connect(lambda _checked, path=path: window.files.open_path(path))
    menu.addSeparator()
    clear = menu.addAction("&Clear list")
    clear.triggered.connect(window.files.clear_recent)
