"""The export dialog: who receives the file, what it will be, and what comes of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QAction, QIcon, QPalette
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.dialogs import Dialogs
from app.export_fields import ProfileFields
from app.export_list import ProfileList, described
from app.export_preview import ExportPreview
from app.export_shelf import Offer, Place, Shelf, titled
from app.export_survey import Survey, Surveyor
from app.guard import guarded
from app.settings import Settings
from app.style import palette_of
from core.document import Document
from core.errors import NinepointError
from core.profiles import Profile

SIZE_PX: Final = (820, 640)
"""Size of the dialog, in logical pixels."""

LIST_PX: Final = 200
"""Width of the list of profiles."""

TITLE_PX: Final = 260
"""Widest title of a profile above the preview; the list has the others too."""

STALE_MS: Final = 150
"""After this time without a new result the old one is marked as old."""

TOLD_LINES: Final = 3
"""Lines that there is always room for: the sentence and the notes."""

MOST_NOTES: Final = 2
"""Number of notes that are told; the others are counted."""


class ExportDialog(QDialog):
    """Profiles, their fields, a preview, and the sentence of the report.

    It stays until the file is written or the user gives up; who writes tells it by `set_busy`,
    `tell_fault` and `accept`.

    Parameters
    ----------
    read
        Gives the document to export.
    shelf
        The profiles.
    settings
        Remember the profile and its fields of the last export.
    dialogs
        Asks for the title of a profile.

    Signals
    -------
    wanted(profile)
        The user wants the file; a `Profile`.
    """

    wanted = Signal(object)

    def __init__(
        self,
        read: Callable[[], Document],
        shelf: Shelf,
        settings: Settings,
        dialogs: Dialogs,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Export")
        self._read, self._shelf, self._settings, self._dialogs = read, shelf, settings, dialogs
        self._changes = dict(settings.export_changes)
        self._survey: Survey | None = None
        self._is_busy = False
        self._failure = ""
        self.list = ProfileList()
        self.title, self.use = QLabel(), QLabel()
        self.preview = ExportPreview()
        self.sentence, self.notes = QLabel(), QLabel()
        self.list.show_offers(shelf.offers, settings.export_choice)
        self.fields = ProfileFields(self._present(self.list.offer))
        self.keep = QPushButton("&Save profile")
        self.delete = QPushButton("&Delete profile")
        self.reset = QPushButton("&Reset")
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.export = self.buttons.addButton("&Export...", QDialogButtonBox.ButtonRole.AcceptRole)
        self.buttons.button(QDialogButtonBox.StandardButton.Cancel).setIcon(QIcon())
        self._surveyor = Surveyor(self)
        self._stale = QTimer(self)
        self._stale.setSingleShot(True)
        self._stale.setInterval(STALE_MS)
        self._prepare()
        self._lay_out()
        self.export.setDefault(True)  # after the layout, which makes a button of its own choice so
        self._connect()
        self._show_offer()
        self.list.setFocus()

    def _prepare(self) -> None:
        font = self.title.font()
        font.setBold(True)
        self.title.setFont(font)
        for label in (self.use, self.notes):
            label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        self.sentence.setAccessibleName("What will be written")
        self.notes.setAccessibleName("Notes")
        for label in (self.use, self.sentence, self.notes):
            label.setWordWrap(True)
            label.setAlignment(Qt.AlignmentFlag.AlignTop)
            label.setTextFormat(Qt.TextFormat.PlainText)
        menu = QMenu(self.keep)
        self.for_all = QAction("For &all drawings...", menu)
        self.for_this = QAction("In &this drawing...", menu)
        self.for_all.setToolTip("Keep the profile among yours")
        self.for_this.setToolTip("Keep the profile in the drawing; whoever opens it has it")
        menu.addActions([self.for_all, self.for_this])
        menu.setToolTipsVisible(True)
        self.keep.setMenu(menu)
        self.keep.setToolTip("Keep these fields under a name of your own")
        self.delete.setToolTip("Forget the chosen profile; those that are built in stay")
        self.reset.setToolTip("Bring the fields back to what the profile says")
        for button in (self.keep, self.delete, self.reset):
            button.setAutoDefault(False)

    def _lay_out(self) -> None:
        label = QLabel("&For")
        label.setBuddy(self.list)
        left = QVBoxLayout()
        left.setSpacing(8)
        self.list.setFixedWidth(LIST_PX)
        for part in (label, self.list, self.keep, self.delete):
            left.addWidget(part)
        head = QHBoxLayout()
        head.setSpacing(10)
        head.addWidget(self.title)
        head.addWidget(self.use, 1)
        right = QVBoxLayout()
        right.setSpacing(10)
        right.addLayout(head)
        right.addWidget(self.preview, 1)
        right.addWidget(self._told())
        right.addWidget(self.fields)
        columns = QHBoxLayout()
        columns.setSpacing(16)
        columns.addLayout(left)
        columns.addLayout(right, 1)
        below = QHBoxLayout()
        below.addSpacing(LIST_PX + columns.spacing())
        below.addWidget(self.reset)
        below.addStretch()
        below.addWidget(self.buttons)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(18, 14, 18, 14)
        layout.setSpacing(14)
        layout.addLayout(columns, 1)
        layout.addLayout(below)
        self.resize(*SIZE_PX)

    def _told(self) -> QWidget:
        """Sentence and notes, with room for what may come: the fields below must not jump."""
        part = QWidget()
        part.setMinimumHeight(TOLD_LINES * part.fontMetrics().lineSpacing())
        told = QVBoxLayout(part)
        told.setContentsMargins(0, 0, 0, 0)
        told.setSpacing(2)
        told.addWidget(self.sentence)
        told.addWidget(self.notes)
        told.addStretch()
        return part

    def _connect(self) -> None:
        self.list.chosen.connect(self._show_offer)
        self.fields.changed.connect(self._take_change)
        self.fields.refused.connect(self._show_state)
        self.preview.outdated.connect(self._look)
        self._surveyor.found.connect(self._take_survey)
        self._surveyor.pictured.connect(self.preview.show_picture)
        self._stale.timeout.connect(self._show_state)
        self.for_all.triggered.connect(lambda: self._keep(Place.OWN))
        self.for_this.triggered.connect(lambda: self._keep(Place.DRAWING))
        self.delete.clicked.connect(self._delete)
        self.reset.clicked.connect(self._reset)
        self.buttons.accepted.connect(self._want)
        self.buttons.rejected.connect(self.reject)
        self.finished.connect(self._surveyor.stop)

    @property
    def profile(self) -> Profile:
        """The profile with its fields as they are."""
        return self.fields.profile

    @property
    def fault(self) -> str:
        """Why the fields cannot be exported with; empty if that is not known."""
        survey = self._survey
        if self.fields.fault:
            return self.fields.fault
        return survey.words if survey and not survey.is_possible and self._is_current else ""

    @property
    def is_at_rest(self) -> bool:
        """Whether nothing more is to come about the present fields."""
        return not self._surveyor.is_busy

    def tell_fault(self, sentence: str) -> None:
        """Say why something could not be written, until something is changed."""
        self._failure = sentence
        self.set_busy(False)

    def set_busy(self, busy: bool) -> None:
        """Show that the file is being written."""
        self._is_busy = busy
        self.buttons.button(QDialogButtonBox.StandardButton.Cancel).setEnabled(not busy)
        self._show_state()
        if busy:
            self.sentence.setText("Writing\u2026")

    def remember(self) -> None:
        """Keep the profile and its fields for the next time."""
        self._settings.export_choice = self.list.offer.key
        kept = {offer.key: offer.profile for offer in self._shelf.offers}
        changes = {**self._changes, self.list.offer.key: self.profile}
        self._settings.export_changes = {
            key: profile for key, profile in changes.items() if kept.get(key, profile) != profile
        }

    def _present(self, offer: Offer) -> Profile:
        """A profile as it was changed last, if it was."""
        changed = self._changes.get(offer.key)
        return offer.profile if changed is None else changed

    @property
    def _is_current(self) -> bool:
        """Whether the last survey is of what the fields say."""
        survey = self._survey
        return (
            survey is not None
            and survey.profile == self.profile
            and survey.document is self._read()
        )

    def _show_offer(self) -> None:
        """Show the profile that is chosen in the list."""
        offer = self.list.offer
        self._failure = ""
        self.fields.show_profile(self._present(offer))
        self.use.setText(described(offer))
        self.delete.setEnabled(offer.place is not Place.BUILT_IN)
        self._look()
        self._show_state()

    def _take_change(self, profile: Profile) -> None:
        self._failure = ""
        self._changes[self.list.offer.key] = profile
        self._look()
        self._show_state()

    def _look(self) -> None:
        """Have the fields surveyed, and the picture drawn."""
        self._surveyor.ask(self._read(), self.profile, self.preview.look)
        self._stale.start()

    def _take_survey(self, survey: Survey) -> None:
        self._survey = survey
        self._show_state()

    def _show_state(self) -> None:
        """Show the sentence, what is changed, and what can be done."""
        offer = self.list.offer
        is_changed = self.profile != offer.profile or bool(self.fields.fault)
        title, metrics = offer.profile.title, self.title.fontMetrics()
        elided = metrics.elidedText(title, Qt.TextElideMode.ElideRight, TITLE_PX)
        self.title.setText(elided + (", changed" if is_changed else ""))
        self.title.setToolTip(title if elided != title else "")
        self.reset.setEnabled(is_changed)
        self.export.setEnabled(not self._is_busy and not self.fault)
        self.keep.setEnabled(not self.fields.fault)
        fault = self.fields.fault
        if fault:
            self._say(fault[0].upper() + fault[1:], is_fault=True)  # it began with a field's name
        elif self._failure:
            self._say(self._failure, is_fault=True)
        elif self._stale.isActive() and not self._is_current:
            return  # a moment in which the new result may still come
        elif self._survey is None:
            self._say("Measuring\u2026", is_old=True)
        else:
            survey = self._survey
            is_old = not self._is_current
            self._say(survey.words, is_fault=not survey.is_possible and not is_old, is_old=is_old)
            self.notes.setText(_few(survey.notes))

    def _say(self, words: str, is_fault: bool = False, is_old: bool = False) -> None:
        """One sentence below the preview: faults stand out, what is old stands back."""
        colours = palette_of(self)
        colour = colours.warning if is_fault else colours.muted_text if is_old else colours.text
        palette = self.sentence.palette()
        palette.setColor(QPalette.ColorRole.WindowText, colour)
        self.sentence.setPalette(palette)
        self.sentence.setText(words)
        if is_fault:
            self.notes.clear()

    def _keep(self, place: Place) -> None:
        """Save the fields as a profile under a title that is asked for."""
        offer = self.list.offer
        suggestion = offer.profile.title if offer.place is place else ""
        title = self._dialogs.words("Save profile", "Title of the profile", suggestion)
        if title is None:
            return
        try:
            profile = titled(self.profile, title)
        except NinepointError as error:
            self.tell_fault(str(error))
            return
        kept = self._shelf.keep(profile, place)
        self._changes.pop(kept.key, None)
        if kept.key != offer.key:
            self._changes.pop(offer.key, None)
        self._show_offers(kept.key)

    def _delete(self) -> None:
        offer = self.list.offer
        self._shelf.delete(offer)
        self._changes.pop(offer.key, None)
        self._show_offers("")

    def _show_offers(self, key: str) -> None:
        self.list.show_offers(self._shelf.offers, key)
        self._show_offer()
        self.list.setFocus()

    def _reset(self) -> None:
        self._changes.pop(self.list.offer.key, None)
        self._show_offer()

    def _want(self) -> None:
        if not self.fault and not self._is_busy:
            self._failure = ""
            self.wanted.emit(self.profile)

    @guarded
    def reject(self) -> None:
        """Close without a file, unless one is being written."""
        if not self._is_busy:
            super().reject()


def _few(notes: tuple[str, ...]) -> str:
    """The first notes, and how many there are besides."""
    if len(notes) <= MOST_NOTES:
        return "\n".join(notes)
    more = len(notes) - MOST_NOTES + 1
    return "\n".join([*notes[: MOST_NOTES - 1], f"And {more} more notes of this kind."])
