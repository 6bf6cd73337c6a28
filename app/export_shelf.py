"""The export profiles that there are: built in, the user's own, and those of the drawing."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from enum import Enum
from typing import Final

import msgspec

from app.session import Session
from app.settings import Settings
from core.profiles import MAX_NAME, PROFILES, Profile

NAMELESS: Final = "profile"
"""Name of a profile whose title has no letter that a name can have."""


class Place(Enum):
    """Where a profile is kept."""

    BUILT_IN = "built-in"
    OWN = "own"
    DRAWING = "drawing"


@dataclass(frozen=True)
class Offer:
    """A profile that can be chosen.

    Attributes
    ----------
    place
        Where it is kept.
    profile
        The profile.
    """

    place: Place
    profile: Profile

    @property
    def key(self) -> str:
        """What the settings remember it by: the place and the name, like "own/thin-lines"."""
        return f"{self.place.value}/{self.profile.name}"


class Shelf:
    """Reads and keeps export profiles.

    Parameters
    ----------
    session
        Its document has profiles of its own.
    settings
        Keep those of the user.
    """

    def __init__(self, session: Session, settings: Settings) -> None:
        self._session = session
        self._settings = settings

    @property
    def offers(self) -> list[Offer]:
        """All profiles: those that are built in, the user's, the drawing's."""
        return [
            *(Offer(Place.BUILT_IN, profile) for profile in PROFILES.values()),
            *(Offer(Place.OWN, profile) for profile in self._settings.export_profiles),
            *(Offer(Place.DRAWING, profile) for profile in self._session.document.profiles),
        ]

    def keep(self, profile: Profile, place: Place) -> Offer:
        """Save a profile among the user's own, or in the drawing; one of its name is replaced.

        In the drawing it is one step of undo, and saved with the drawing.
        """
        if place is Place.DRAWING:
            document = self._session.document.with_profile(profile)
            self._session.edit(document, f"Save profile {profile.title}")
        else:
            others = [p for p in self._settings.export_profiles if p.name != profile.name]
            self._settings.export_profiles = (*others, profile)
        return Offer(place, profile)

    def delete(self, offer: Offer) -> None:
        """Forget a profile that is not built in."""
        name = offer.profile.name
        if offer.place is Place.DRAWING:
            document = self._session.document.without_profile(name)
            self._session.edit(document, f"Delete profile {offer.profile.title}")
        elif offer.place is Place.OWN:
            kept = [p for p in self._settings.export_profiles if p.name != name]
            self._settings.export_profiles = tuple(kept)


def titled(profile: Profile, title: str) -> Profile:
    """A profile under a title of the user's, and the name that follows from it.

    Raises
    ------
    NinepointError
        If the title is empty, too long, or of several lines.
    """
    words = " ".join(title.split())
    plain = unicodedata.normalize("NFKD", words.lower())
    name = re.sub("[^a-z0-9]+", "-", "".join(c for c in plain if not unicodedata.combining(c)))
    name = name.strip("-")[:MAX_NAME].strip("-") or NAMELESS
    return msgspec.structs.replace(profile, name=name, title=words, use="")
