"""The list of export profiles: built in, the user's own, and those of the drawing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from app.export_shelf import Offer, Place
from app.guard import guarded
from app.theme import soften

HEADINGS: Final = {Place.OWN: "Yours", Place.DRAWING: "In this drawing"}
"""Above the profiles that are not built in."""

ROW_PADDING_PX: Final = 8

HEADING_PADDING_PX: Final = 14


class ProfileList(QListWidget):
    """Profiles to choose from, with headings that cannot be chosen.

    Signals
    -------
    chosen(offer)
        The user went to another profile; an `Offer`.
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._offers: dict[int, Offer] = {}
        self._showing = False
        self.setAccessibleName("Profiles")
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        soften(self)
        self.currentRowChanged.connect(self._tell)

    @property
    def offer(self) -> Offer:
        """The profile that is chosen."""
        return self._offers[self.currentRow()]

    def show_offers(self, offers: Sequence[Offer], key: str) -> None:
        """List profiles and choose one, the first if there is none of that key; emits nothing."""
        self._showing = True
        self.clear()
        self._offers = {}
        place = Place.BUILT_IN
        current = 0
        for offer in offers:
            if offer.place is not place:
                place = offer.place
                self._add(HEADINGS[place], HEADING_PADDING_PX).setFlags(Qt.ItemFlag.NoItemFlags)
            item = self._add(offer.profile.title, ROW_PADDING_PX)
            item.setToolTip(described(offer))
            item.setData(Qt.ItemDataRole.AccessibleDescriptionRole, described(offer))
            row = self.row(item)
            self._offers[row] = offer
            if offer.key == key:
                current = row
        self.setCurrentRow(current)
        self._showing = False

    def _add(self, words: str, padding: int) -> QListWidgetItem:
        item = QListWidgetItem(words, self)
        item.setSizeHint(QSize(0, self.fontMetrics().height() + padding))
        return item

    def _tell(self, row: int) -> None:
        if not self._showing and row in self._offers:
            self.chosen.emit(self._offers[row])

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        """Mark the choice in the colours of another scheme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_offers"):
            soften(self)


def described(offer: Offer) -> str:
    """Who receives the file, or what the user's profile is."""
    profile = offer.profile
    if profile.use:
        return profile.use
    version = f" {profile.version}" if profile.version else ""
    fine = "" if profile.entity == "control points" else f", {profile.tolerance_mm:g} mm"
    return f"{profile.format.upper()}{version}, {profile.entity}{fine}"
