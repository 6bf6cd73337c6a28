"""What the program remembers between two starts, and where a window may stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QByteArray, QPoint, QRect, QSettings, QSize

from core.errors import NinepointError

if TYPE_CHECKING:
    from core.profiles import Profile

MAX_RECENT: Final = 10
"""Number of recent files that are kept: as many as fit a menu without searching."""

MIN_VISIBLE_PX: Final = 48
"""What must show of a window, each way, to take hold of it and move it."""

STATE_VERSION: Final = 2
"""Raised when docks or tool bars are renamed, so that an old arrangement is not restored."""


class Settings:
    """Remembered values; each has a sensible default, and nonsense in the store counts as absent.

    Parameters
    ----------
    store
        Where the values live, or None to remember them only while the program runs
        (screenshots and tests).
    """

    def __init__(self, store: QSettings | None = None) -> None:
        self._store = store
        self._memory: dict[str, object] = {}

    @property
    def recent(self) -> list[Path]:
        """Files opened or saved, the latest first."""
        return [Path(line) for line in self._text("files/recent").split("\n") if line]

    def add_recent(self, path: Path) -> None:
        """Put a file at the top of the recent ones."""
        path = path.absolute()
        others = [other for other in self.recent if other != path]
        self._set_recent([path, *others])

    def remove_recent(self, path: Path) -> None:
        """Take a file off the list."""
        self._set_recent([other for other in self.recent if other != path])

    def clear_recent(self) -> None:
        """Forget the recent files."""
        self._set_recent([])

    def _set_recent(self, paths: Sequence[Path]) -> None:
        self._write("files/recent", "\n".join(str(path) for path in paths[:MAX_RECENT]))

    @property
    def folder(self) -> Path:
        """Folder where files were last opened or saved; at first the user's documents."""
        return self._folder("files/folder")

    @folder.setter
    def folder(self, folder: Path) -> None:
        self._write("files/folder", str(folder.absolute()))

    @property
    def export_folder(self) -> Path:
        """Folder of the last export."""
        return self._folder("export/folder")

    @export_folder.setter
    def export_folder(self, folder: Path) -> None:
        self._write("export/folder", str(folder.absolute()))

    @property
    def export_choice(self) -> str:
        """Key of the profile of the last export, as `app.export_shelf.Offer` has it."""
        return self._text("export/profile")

    @export_choice.setter
    def export_choice(self, key: str) -> None:
        self._write("export/profile", key)

    @property
    def export_profiles(self) -> tuple[Profile, ...]:
        """The user's own export profiles, with different names; damaged ones count as absent."""
        found = [decoded(line) for line in self._text("export/own").split("\n")]
        by_name = {profile.name: profile for profile in found if profile is not None}
        return tuple(by_name.values())

    @export_profiles.setter
    def export_profiles(self, profiles: Sequence[Profile]) -> None:
        self._write("export/own", "\n".join(encoded(profile) for profile in profiles))

    @property
    def export_changes(self) -> dict[str, Profile]:
        """What profiles were changed to, without being saved, at their last export; by keys."""
        lines = (line.partition(" ") for line in self._text("export/changes").split("\n"))
        found = {key: decoded(text) for key, _, text in lines}
        return {key: profile for key, profile in found.items() if profile is not None}

    @export_changes.setter
    def export_changes(self, changes: Mapping[str, Profile]) -> None:
        lines = [f"{key} {encoded(profile)}" for key, profile in changes.items()]
        self._write("export/changes", "\n".join(lines))

    @property
    def window_rect(self) -> QRect | None:
        """Place of the window when it was last closed, or None."""
        value = self._read("window/rect")
        return value if isinstance(value, QRect) and value.isValid() else None

    @window_rect.setter
    def window_rect(self, rect: QRect) -> None:
        self._write("window/rect", rect)

    @property
    def maximised(self) -> bool:
        """Whether the window filled the screen."""
        return self._text("window/maximised") == "yes"

    @maximised.setter
    def maximised(self, filled: bool) -> None:
        self._write("window/maximised", "yes" if filled else "no")

    @property
    def arrangement(self) -> QByteArray:
        """Docks and tool bars as `QMainWindow.saveState` wrote them; empty at first."""
        value = self._read("window/arrangement")
        return value if isinstance(value, QByteArray) else QByteArray()

    @arrangement.setter
    def arrangement(self, state: QByteArray) -> None:
        self._write("window/arrangement", state)

    @property
    def import_way(self) -> str:
        """How lines of another program became curves the last time, see `app.import_way`."""
        return self._text("import/way")

    @import_way.setter
    def import_way(self, text: str) -> None:
        self._write("import/way", text)

    def _folder(self, key: str) -> Path:
        kept = self._text(key)
        if kept and Path(kept).is_dir():
            return Path(kept)
        from PySide6.QtCore import QStandardPaths  # the first paint does not wait for it

        place = QStandardPaths.StandardLocation.DocumentsLocation
        documents = Path(QStandardPaths.writableLocation(place))
        return documents if documents.is_dir() else Path.home()

    def _text(self, key: str, default: str = "") -> str:
        value = self._read(key)
        return value if isinstance(value, str) and value else default

    def _read(self, key: str) -> object:
        if self._store is not None:
            return self._store.value(key)
        return self._memory.get(key)

    def _write(self, key: str, value: object) -> None:
        if self._store is not None:
            self._store.setValue(key, value)
        else:
            self._memory[key] = value


def encoded(profile: Profile) -> str:
    """Text of an export profile, in one line."""
    from core.profiles import encode

    return encode(profile).decode()


def decoded(text: str) -> Profile | None:
    """Export profile of a text, or None if that is damaged or of a newer program."""
    from core.profiles import decode  # with what it needs, a tenth of the start

    try:
        return decode(text)
    except NinepointError:
        return None


def on_screen(rect: QRect, screens: Sequence[QRect]) -> QRect:
    """A window's rectangle, moved and shrunk so that it can be seen and taken hold of.

    Parameters
    ----------
    rect
        Where the window was.
    screens
        The free areas of the screens that exist now, the main one first; at least one.

    Returns
    -------
    QRect
        ``rect`` itself if its title can be reached on some screen, else the nearest place on the
        main screen.
    """
    title = QRect(rect.topLeft(), QSize(rect.width(), MIN_VISIBLE_PX))
    for screen in screens:
        seen = title.intersected(screen)
        if seen.width() >= MIN_VISIBLE_PX and seen.height() == MIN_VISIBLE_PX:
            return rect
    main = screens[0]
    size = rect.size().boundedTo(main.size())
    left = min(max(rect.left(), main.left()), main.left() + main.width() - size.width())
    top = min(max(rect.top(), main.top()), main.top() + main.height() - size.height())
    return QRect(QPoint(left, top), size)
