"""Budgets of foreign files: what a reader spends before it gives up, counted in work, not seconds.

A small file can ask for endless work: an element that is used a thousand times by each of a
thousand others, a block that contains itself. Whoever expands such things pays for each step here
first. The limits are such that all of them together take less than ten seconds and 1 GB.
"""

from __future__ import annotations

from typing import Final

from core.errors import NinepointError

MAX_ELEMENTS: Final = 100_000
"""Largest number of elements or entities that are visited, those of repetitions included."""

MAX_SEGMENTS: Final = 2_500_000
"""Largest number of cubics in a sketch; a cubic takes 64 bytes."""

MAX_CONTOURS: Final = 100_000
"""Largest number of contours."""

MAX_NOTED: Final = 5
"""Number of kinds of things left out that a note names."""


class BudgetError(NinepointError):
    """A file asks for more work than a reader is willing to do."""


class Budget:
    """What is left to be spent on one file."""

    def __init__(self) -> None:
        self._elements = MAX_ELEMENTS
        self._segments = MAX_SEGMENTS
        self._contours = MAX_CONTOURS

    def visit(self, count: int = 1) -> None:
        """Pay for visits of elements.

        Raises
        ------
        BudgetError
            If there have been more than `MAX_ELEMENTS`.
        """
        self._elements -= count
        if self._elements < 0:
            raise BudgetError(
                f"it has more than {MAX_ELEMENTS:,} elements, repetitions included; save a part of"
                " it as a file of its own."
            )

    def draw(self, count: int) -> None:
        """Pay for cubics, before they are made.

        Raises
        ------
        BudgetError
            If there have been more than `MAX_SEGMENTS`.
        """
        self._segments -= count
        if self._segments < 0:
            raise BudgetError(
                f"it has more than {MAX_SEGMENTS:,} lines and curves, repetitions included; thin"
                " it out or save a part of it."
            )

    def begin(self) -> None:
        """Pay for a contour.

        Raises
        ------
        BudgetError
            If there are more than `MAX_CONTOURS`.
        """
        self._contours -= 1
        if self._contours < 0:
            raise BudgetError(
                f"it has more than {MAX_CONTOURS:,} contours; save a part of it as a file of its"
                " own."
            )


def listed(counts: dict[str, int]) -> str:
    """``2 texts, 1 image``: the most frequent things, in falling order of their numbers."""
    order = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    shown = ", ".join(f"{number:,} {thing}" for thing, number in order[:MAX_NOTED])
    rest = sum(number for _, number in order[MAX_NOTED:])
    return shown + (f" and {rest:,} others" if rest else "")
