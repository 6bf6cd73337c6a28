"""Where two pictures differ: a few rectangles, outside of which they are the same in every bit.

Notes
-----
Theorem: let pictures be painted thing by thing in the order of their keys. Outside the union of the
boxes that `app.ink.Ink.unlike` tells of the things of one key, and of the boxes of those that only
one of the two has, both pictures are the same.

Proof. At a pixel outside, a thing of both leaves the same ink in either, and a thing of only one
leaves none. What is left is the same ink in the same order, on the same ground. ∎
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from PySide6.QtCore import QRect
from PySide6.QtGui import QRegion

from app.ink import Ink
from app.pixel_box import Box, united

Key = tuple[int, int]
"""Layer, and place within the layer: pictures are painted in rising order."""

MOST_RECTANGLES: Final = 12
"""Number of rectangles of a region beyond which they are taken together; Qt pays for each."""

MOST_APART: Final = 4 * MOST_RECTANGLES
"""Number of boxes apart from each other beyond which all are taken together at once: each that
comes is compared with all that are there."""

MOST_CHANGES: Final = 64
"""Number of things that differ beyond which they are taken as a whole: another scheme draws all of
a thousand curves anew, and no one needs to know where they differ."""

WASTE_PX2: Final = 16_000.0
"""Area that two boxes may have more together than apart; as much is painted as fast as a rectangle
is dealt with, and within a single one Qt need not look whether a place is in the region."""

WASTE: Final = 1.25
"""Share of their area that two boxes may have together."""


def dirt(before: Mapping[Key, Ink], now: Mapping[Key, Ink]) -> list[Box]:
    """A few boxes outside of which two pictures are the same.

    Parameters
    ----------
    before, now
        The things of each picture by their keys, in rising order.
    """
    lone = [ink.box for key, ink in now.items() if key not in before]
    lone += [ink.box for key, ink in before.items() if key not in now]
    changed = [
        (known, ink) for key, ink in now.items() if (known := before.get(key, ink)) is not ink
    ]
    if len(changed) > MOST_CHANGES:
        return _united([*lone, *(ink.box for pair in changed for ink in pair)])
    return merged([*lone, *(box for known, ink in changed for box in known.unlike(ink))])


def merged(boxes: list[Box]) -> list[Box]:
    """At most `MOST_RECTANGLES` boxes that hold all; those that overlap or are near go together."""
    around = _united(boxes)
    # Mostly they are all about one place.
    if not around or _area(around[0]) <= WASTE * max(map(_area, boxes)) + WASTE_PX2:
        return around
    found: list[Box] = []
    for box in boxes:
        if box[0] > box[2]:
            continue  # nothing is in it
        rest = []
        for other in found:
            both = _both(box, other)
            if _area(both) <= WASTE * (_area(box) + _area(other)) + WASTE_PX2:
                box = both
            else:
                rest.append(other)
        found = [*rest, box]
        if len(found) > MOST_APART:
            return _united(boxes)
    return found if len(found) <= MOST_RECTANGLES else _united(found)


def _united(boxes: list[Box]) -> list[Box]:
    """The box around all, if anything is in them."""
    if not boxes:
        return []
    around = united(boxes)
    return [around] if around[0] <= around[2] else []


def region_of(boxes: list[Box], within: QRect) -> QRegion:
    """Whole pixels of a rectangle that some boxes touch."""
    left, top, right, bottom = within.left(), within.top(), within.right(), within.bottom()
    region = QRegion()
    for box in boxes:
        # A box may be far larger than what whole numbers of Qt can hold.
        x, y = max(int(max(box[0], left - 1)), left), max(int(max(box[1], top - 1)), top)
        after_x, after_y = int(min(box[2], right)) + 1, int(min(box[3], bottom)) + 1
        if x < after_x and y < after_y:
            region += QRect(x, y, after_x - x, after_y - y)
    return region


def _both(one: Box, two: Box) -> Box:
    return (
        min(one[0], two[0]), min(one[1], two[1]), max(one[2], two[2]), max(one[3], two[3])
    )  # fmt: skip


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1]) if box[0] <= box[2] else 0.0
