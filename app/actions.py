"""The one table of everything that a user can do; menus, tool bar and the sheet of keys follow.

A row says how an action is called, which keys it has, which icon, what it tells, and what it
calls. Nothing else in the program defines a shortcut.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Final, NamedTuple

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QIcon, QKeySequence

from app.icons import BAR_PX, MODES, SIZES_PX, tinted
from app.sliders import NEIGHBOUR_TIPS, PRESET_TIPS
from core.family import PRESETS

if TYPE_CHECKING:
    from app.window import MainWindow

StandardKey = QKeySequence.StandardKey
Keys = tuple[QKeySequence.StandardKey | str, ...]


class Reach(Enum):
    """Where the keys of an action work."""

    WINDOW = "anywhere in the window"
    CANVAS = "while the canvas has the focus"


class Command(NamedTuple):
    """One row of the table.

    Attributes
    ----------
    key
        Short name by which the program refers to the action.
    menu
        Title of the menu that it is in.
    text
        Words in the menu; "&" marks the letter that Alt calls, "..." at the end says that a
        question follows.
    call
        What it does to a window.
    keys
        Standard keys of the system, or texts such as "Ctrl+E"; the first is shown.
    tip
        One line for the tooltip and the status bar.
    icon
        Name of the icon, or "".
    reach
        Where its keys work; plain letters only on the canvas, so that they can be typed elsewhere.
    state
        For an action that is on or off: what it shows now.
    group
        Actions of one group exclude each other.
    section
        Begins a new section of its menu.
    """

    key: str
    menu: str
    text: str
    call: Callable[[MainWindow], object]
    keys: Keys = ()
    tip: str = ""
    icon: str = ""
    reach: Reach = Reach.WINDOW
    state: Callable[[MainWindow], bool] | None = None
    group: str = ""
    section: bool = False

    @property
    def words(self) -> str:
        """The text without marks: for tooltips and the sheet of keys."""
        return self.text.replace("&", "").removesuffix("...")

    @property
    def sequences(self) -> list[QKeySequence]:
        """All keys, as this system has them; the standard ones may be several or none."""
        found: list[QKeySequence] = []
        for key in self.keys:
            bound = [QKeySequence(key)] if isinstance(key, str) else QKeySequence.keyBindings(key)
            found.extend(sequence for sequence in bound if sequence not in found)
        return found


def _preset(name: str) -> Command:
    return Command(
        f"preset {name}",
        "&Scheme",
        "L&ean" if name == "Lean" else f"&{name}",  # L is Lagrange's
        lambda window: window.scheme.choose_preset(name),
        tip=PRESET_TIPS[name],
        state=lambda window: window.session.document.parameters.name == name,
        group="preset",
    )


def _neighbours(key: str, tip: str, section: bool) -> Command:
    return Command(
        f"neighbours {key}",
        "&Scheme",
        "Neighbours t&ranslated" if key == "translated" else f"Neighbours &{key}",  # T is Tight's
        lambda window: window.scheme.choose_neighbours(key),
        tip=tip,
        state=lambda window: window.session.document.parameters.neighbours == key,
        group="neighbours",
        section=section,
    )


def _tool(key: str, letter: str, tip: str, section: bool = False) -> Command:
    return Command(
        key,
        "&Edit",
        "S&elect tool" if key == "select" else f"{key.capitalize()} tool",
        lambda window: window.canvas.set_tool(key),
        (letter,),
        tip,
        icon=key,
        reach=Reach.CANVAS,
        state=lambda window: window.canvas.tool == key,
        group="tool",
        section=section,
    )


# fmt: off
COMMANDS: Final = (
    Command(
        "new", "&File", "&New", lambda w: w.files.new(), (StandardKey.New,),
        "Begin an empty drawing", "new",
    ),
    Command(
        "open", "&File", "&Open...", lambda w: w.files.open(), (StandardKey.Open,),
        "Open a drawing, SVG, DXF, or points from a CSV, TSV, JSON or airfoil file", "open",
    ),
    Command(
        "import", "&File", "&Import...", lambda w: w.importer.ask(), ("Ctrl+I",),
        "Add the curves of a file to the drawing: SVG, DXF, points, or a drawing", "import",
    ),
    Command(
        "save", "&File", "&Save", lambda w: w.files.save(), (StandardKey.Save,),
        "Save the drawing", "save", section=True,
    ),
    Command(
        "save as", "&File", "Save &As...", lambda w: w.files.save_as(),
        (StandardKey.SaveAs, "Ctrl+Shift+S"), "Save the drawing under another name",
    ),
    Command(
        "export", "&File", "&Export...", lambda w: w.exporter.ask(), ("Ctrl+Shift+E",),
        "Write the curves for a machine or another program", "export", section=True,
    ),
    Command(
        "export again", "&File", "Export a&gain", lambda w: w.exporter.repeat(), ("Ctrl+E",),
        "Repeat the last export: same file, same profile",
    ),
    Command(
        "quit", "&File", "&Quit", lambda w: w.close(), (StandardKey.Quit, "Ctrl+Q"),
        "Close Ninepoint", section=True,
    ),
    Command(
        "undo", "&Edit", "&Undo", lambda w: w.undo(), (StandardKey.Undo, "Ctrl+Z"),
        "Take the last step back", "undo",
    ),
    Command(
        "redo", "&Edit", "&Redo", lambda w: w.redo(),
        (StandardKey.Redo, "Ctrl+Shift+Z", "Ctrl+Y"), "Bring the last undone step back", "redo",
    ),
    Command(
        "cut", "&Edit", "Cu&t", lambda w: w.clipboard.cut(), (StandardKey.Cut, "Ctrl+X"),
        "Copy what is selected, and delete it", "cut", section=True,
    ),
    Command(
        "copy", "&Edit", "&Copy", lambda w: w.clipboard.copy(), (StandardKey.Copy, "Ctrl+C"),
        "Copy the curves that are selected; of one selected in part, its points as an open curve;"
        " without a selection, all", "copy",
    ),
    Command(
        "paste", "&Edit", "&Paste", lambda w: w.clipboard.paste(), (StandardKey.Paste, "Ctrl+V"),
        "Add what was copied: curves, SVG, or two columns of numbers", "paste",
    ),
    Command(
        "duplicate", "&Edit", "Dup&licate", lambda w: w.clipboard.duplicate(), ("Ctrl+D",),
        "Add what is selected again, a step aside", "duplicate",
    ),
    Command(
        "select all", "&Edit", "Select &all", lambda w: w.canvas.select_all(),
        (StandardKey.SelectAll,), "Select all control points", section=True,
    ),
    Command(
        "delete", "&Edit", "&Delete", lambda w: w.canvas.delete_selection(),
        (StandardKey.Delete,), "Delete the selected control points", "delete",
    ),
    _tool("select", "V", "Select and move points", section=True),
    _tool("pen", "P", "Add points, or begin a curve"),
    _tool("hand", "H", "Move the view"),
    Command(
        "closed", "&Curve", "&Closed", lambda w: w.toggle_closed(), ("Ctrl+Shift+C",),
        "Close or open the current curve", "closed",
        state=lambda w: w.current_curve is not None and w.current_curve.closed,
    ),
    Command(
        "reverse", "&Curve", "&Reverse direction", lambda w: w.reverse_curve(), (),
        "Run through the points of the current curve backwards: a lean changes sides", "reverse",
    ),
    Command(
        "delete curve", "&Curve", "&Delete curve", lambda w: w.delete_curve(), (),
        "Delete the current curve with all of its points", section=True,
    ),
    *(_preset(name) for name in PRESETS),
    *(_neighbours(key, tip, key == "translated") for key, tip in NEIGHBOUR_TIPS.items()),
    Command(
        "report", "&Scheme", "Re&port on this scheme", lambda w: w.show_report(), ("Ctrl+R",),
        "Show all that is known of the scheme, in words and formulas", section=True,
    ),
    Command(
        "map", "&Scheme", "Map &of parameters", lambda w: w.show_map(), ("Ctrl+M",),
        "Show class, H\u00f6lder exponent or overshoot over a plane of parameters",
    ),
    Command(
        "zoom in", "&View", "Zoom &in", lambda w: w.canvas.zoom_by(ZOOM_STEP),
        (StandardKey.ZoomIn, "Ctrl++", "Ctrl+="), "Show less, larger", "zoom-in",
    ),
    Command(
        "zoom out", "&View", "Zoom &out", lambda w: w.canvas.zoom_by(1 / ZOOM_STEP),
        (StandardKey.ZoomOut, "Ctrl+-"), "Show more, smaller", "zoom-out",
    ),
    Command(
        "real size", "&View", "&Real size", lambda w: w.canvas.zoom_real_size(), ("1",),
        "Show a millimetre as a millimetre", reach=Reach.CANVAS,
    ),
    Command(
        "fit selection", "&View", "Fit &selection", lambda w: w.canvas.fit_selection(), ("3",),
        "Show the selected points as large as they fit", "fit-selection", Reach.CANVAS,
    ),
    Command(
        "fit", "&View", "&Fit all", lambda w: w.canvas.fit_all(), ("5",),
        "Show the whole drawing as large as it fits", "fit", Reach.CANVAS,
    ),
    Command(
        "polygon", "&View", "Control &polygon", lambda w: w.toggle_polygon(), (),
        "Show or hide control polygon and points",
        state=lambda w: w.canvas.show_polygon, section=True,
    ),
    Command(
        "grid", "&View", "&Grid", lambda w: w.toggle_grid(), (),
        "Show or hide the grid", state=lambda w: w.canvas.show_grid,
    ),
    Command(
        "slope", "&View", "&Derivative of the basis function", lambda w: w.toggle_slope(), (),
        "Plot the first derivative too, where it is proven to exist",
        state=lambda w: w.shows_slope,
    ),
    Command(
        "reset layout", "&View", "Reset &layout", lambda w: w.reset_layout(), (),
        "Put all panels back to where they were at first",
    ),
    Command(
        "keys", "&Help", "&Keys", lambda w: w.show_keys(), ("F1", "?"),
        "Show what the keys and the mouse do", "keys",
    ),
    Command(
        "about", "&Help", "&About Ninepoint", lambda w: w.show_about(), (),
        "Version, licence and source", section=True,
    ),
)
# fmt: on
"""Every action; a menu lists its own in this order."""

ZOOM_STEP: Final = 1.25
"""Factor of one zoom step: three of them double the picture, nearly."""

CONTEXT_MENU: Final = (
    "cut", "copy", "paste", "duplicate", "",
    "closed", "reverse", "", "select all", "delete", "", "fit selection", "fit",
)  # fmt: skip
"""Keys of the actions in the menu of the canvas."""

MENUS: Final = ("&File", "&Edit", "&Curve", "&Scheme", "&View", "&Help")
"""The menu bar, from left to right."""

TOOL_BAR: Final = ("select", "pen", "hand", "", "closed", "", "undo", "redo", "", "fit")
"""Keys of the actions in the tool bar; an empty one is a line between groups."""


class Actions:
    """The actions of a window, made from the table.

    Parameters
    ----------
    window
        The window that they act on; its `canvas` owns the keys that work only there.

    Attributes
    ----------
    ratio
        Device pixels per logical pixel that the icons are drawn for.
    """

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self.ratio = 1.0
        self._groups: dict[str, QActionGroup] = {}
        self._made = {command.key: self._make(command) for command in COMMANDS}
        self.refresh()
        # Menus are shut for now, and their icons would take 5 ms; the others' other mode, 4 ms.
        self.tint(TOOL_BAR, (BAR_PX,), as_shown=True)

    def __getitem__(self, key: str) -> QAction:
        return self._made[key]

    def _make(self, command: Command) -> QAction:
        window = self._window
        action = QAction(command.text, window)
        action.setObjectName(command.key)
        action.setStatusTip(command.tip)
        sequences = command.sequences
        action.setShortcuts(sequences)
        keys = f" ({native(sequences[0])})" if sequences else ""
        action.setToolTip(f"{command.words}{keys}\n{command.tip}")
        if command.reach is Reach.CANVAS:
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
            window.canvas.addAction(action)
        else:
            window.addAction(action)
        if command.state is not None:
            action.setCheckable(True)
        if command.group:
            if command.group not in self._groups:
                group = QActionGroup(window)
                # Nothing of the group may be on: parameters without a preset's name.
                group.setExclusionPolicy(QActionGroup.ExclusionPolicy.ExclusiveOptional)
                self._groups[command.group] = group
            self._groups[command.group].addAction(action)
        action.triggered.connect(lambda: self._run(command))
        return action

    def _run(self, command: Command) -> None:
        command.call(self._window)
        if command.state is not None:
            self.refresh()  # Qt has toggled the mark; the truth may be another one

    def refresh(self) -> None:
        """Show what is on, what is possible, and the names of what undo and redo would do."""
        window = self._window
        for command in COMMANDS:
            if command.state is not None:
                self._made[command.key].setChecked(command.state(window))
        session = window.session
        for key, name in (("undo", session.undo_name), ("redo", session.redo_name)):
            action, word = self._made[key], key.capitalize()
            action.setEnabled(name is not None)
            action.setText(f"&{word} {name or ''}".rstrip())
            action.setToolTip(f"{word} {name or ''}".rstrip() + f" ({native(action.shortcut())})")
        has_curve = window.current_curve is not None
        for key in ("closed", "reverse", "delete curve"):
            self._made[key].setEnabled(has_curve)
        has_points = any(curve.count for curve in session.document.curves)
        for key in ("copy", "duplicate"):
            self._made[key].setEnabled(has_points)
        for key in ("cut", "delete", "fit selection"):
            self._made[key].setEnabled(bool(session.selection.points))

    def tint(
        self,
        keys: Collection[str] | None = None,
        sizes_px: Sequence[int] = SIZES_PX,
        as_shown: bool = False,
    ) -> None:
        """Draw icons in the colours of the window's palette, for the pixels of its screen.

        Parameters
        ----------
        keys
            Those of the actions; all by default.
        sizes_px
            Their logical sizes; all by default.
        as_shown
            Whether each is drawn only as it is now, normal or disabled.
        """
        palette, self.ratio = self._window.palette(), self._window.devicePixelRatioF()
        for command in COMMANDS:
            if command.icon and (keys is None or command.key in keys):
                action = self._made[command.key]
                now = QIcon.Mode.Normal if action.isEnabled() else QIcon.Mode.Disabled
                modes = (now,) if as_shown else tuple(MODES)
                action.setIcon(tinted(command.icon, palette, self.ratio, sizes_px, modes))


def native(sequence: QKeySequence) -> str:
    """Keys as this system writes them."""
    return sequence.toString(QKeySequence.SequenceFormat.NativeText)
