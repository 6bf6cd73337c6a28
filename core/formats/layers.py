"""Names of layers that every program takes: ASCII, short, and each once."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from typing import Final

ALL: Final = "CURVES"
"""Layer of all contours, if they share one."""

MAX_LENGTH: Final = 31
"""Longest name that DXF R12 admits."""

_RESERVED: Final = {"", "0", "DEFPOINTS"}
"""No name; the layer that adapts to its block; and the one that is never plotted."""


def layer_names(names: Sequence[str] | None, count: int) -> list[str]:
    """Layers of some contours.

    Parameters
    ----------
    names
        What the layers should be called, any text; None for one layer for all.
    count
        Number of contours, the length of the names.

    Returns
    -------
    list of str
        Capital letters, digits, hyphens and underscores, at most `MAX_LENGTH`; one for each
        contour, different for different contours unless they share one.
    """
    if names is None:
        return [ALL] * count
    taken: set[str] = set()
    nexts: dict[str, int] = {}
    found = []
    for name in names:
        base = _ascii(name)
        chosen = base
        while chosen in taken:
            # Counting goes on where the last contour of this name left it.
            nexts[base] = nexts.get(base, 1) + 1
            ending = f"_{nexts[base]}"
            chosen = base[: MAX_LENGTH - len(ending)] + ending
        taken.add(chosen)
        found.append(chosen)
    return found


def _ascii(name: str) -> str:
    """Nearest name of admitted letters: accents go, other signs become underscores."""
    plain = unicodedata.normalize("NFKD", name).upper()
    plain = "".join(letter for letter in plain if not unicodedata.combining(letter))
    words = re.sub("[^A-Z0-9-]+", "_", plain).strip("_")[:MAX_LENGTH]
    return f"CURVE_{words}".rstrip("_") if words in _RESERVED else words
