"""Basic shapes of SVG as outlines, in the user units of their element."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np

from core.formats import ellipses, path_data, path_tokens
from core.formats.budget import Budget
from core.formats.outlines import Outline, polyline
from core.formats.path_data import Drawn
from core.formats.svg_values import length

SHAPES: Final = frozenset({"path", "line", "polyline", "polygon", "rect", "circle", "ellipse"})
"""Elements that are drawn."""


class Viewport(NamedTuple):
    """Size of the nearest view, in user units, which percentages refer to."""

    width: float
    height: float

    @property
    def diagonal(self) -> float:
        """What percentages of radii refer to."""
        return math.hypot(self.width, self.height) / math.sqrt(2)


def drawn(
    tag: str,
    attributes: Mapping[str, str],
    viewport: Viewport,
    tolerance: float,
    budget: Budget,
) -> Drawn:
    """Outlines of an element.

    Parameters
    ----------
    tag
        One of `SHAPES`.
    attributes
        Its attributes.
    viewport
        For percentages.
    tolerance
        Admitted deviation of arcs, positive, in user units.
    budget
        What pays for the cubics.

    Raises
    ------
    BudgetError
        If there are too many segments.
    """
    if tag == "path":
        return path_data.outlines(attributes.get("d", ""), tolerance, budget)
    if tag in ("polyline", "polygon"):
        return _poly(attributes.get("points", ""), tag == "polygon", budget)
    get = _Lengths(attributes, viewport)
    if tag == "line":
        budget.draw(1)
        ends = [[get.across("x1"), get.down("y1")], [get.across("x2"), get.down("y2")]]
        return _whole(polyline(np.array(ends), False))
    if tag == "rect":
        return _whole(_rect(get, tolerance, budget))
    x, y = get.across("cx"), get.down("cy")
    if tag == "circle":
        radius = get.along("r") or 0.0
        return _whole(_ellipse(x, y, radius, radius, tolerance, budget))
    rx, ry = get.radii()
    return _whole(_ellipse(x, y, rx, ry, tolerance, budget))


class _Lengths(NamedTuple):
    """Lengths of an element; what is absent or faulty is 0, as SVG has it."""

    attributes: Mapping[str, str]
    viewport: Viewport

    def across(self, name: str) -> float:
        found = length(self.attributes.get(name))
        return found.px(self.viewport.width) if found else 0.0

    def down(self, name: str) -> float:
        found = length(self.attributes.get(name))
        return found.px(self.viewport.height) if found else 0.0

    def along(self, name: str, whole: float | None = None) -> float | None:
        """Radius; None if it is absent, negative or ``auto``."""
        found = length(self.attributes.get(name))
        if found is None or found.number < 0:
            return None
        return found.px(self.viewport.diagonal if whole is None else whole)

    def radii(self) -> tuple[float, float]:
        """Half axes rx and ry; one that is not given is as long as the other."""
        rx = self.along("rx", self.viewport.width)
        ry = self.along("ry", self.viewport.height)
        return (
            rx if rx is not None else ry or 0.0,
            ry if ry is not None else rx or 0.0,
        )


def _whole(found: Outline | None) -> Drawn:
    return Drawn([found] if found else [], True)


def _poly(text: str, closed: bool, budget: Budget) -> Drawn:
    """Corners up to the first fault; an odd number at the end is one."""
    if not text.strip():
        return Drawn([], True)
    found, is_whole = path_tokens.runs("M" + text)
    numbers = next(found).numbers
    count = len(numbers) // 2
    budget.draw(count + 1)
    points = np.array(numbers[: 2 * count]).reshape(-1, 2)
    is_whole = is_whole and next(found, None) is None and len(numbers) == 2 * count
    return Drawn(_whole(polyline(points, closed)).outlines, is_whole)


def _ellipse(
    x: float, y: float, rx: float, ry: float, tolerance: float, budget: Budget
) -> Outline | None:
    """From the rightmost point, first down the page (angles grow that way), as SVG 2 has it."""
    if rx <= 0 or ry <= 0:
        return None
    longest, turn = max(rx, ry), 2 * math.pi
    # A multiple of four, so that the outermost points are nodes.
    count = -(-ellipses.piece_count(longest, turn, tolerance) // 4) * 4
    budget.draw(count)
    numbers = ellipses.arc((x, y), (rx, 0.0), (0.0, ry), 0.0, turn, count)
    moved = math.hypot(numbers[-2] - numbers[0], numbers[-1] - numbers[1])
    numbers[-2:] = numbers[:2]
    deviation = longest * ellipses.unit_deviation(turn / count) + moved
    return Outline(np.array(numbers).reshape(-1, 4, 2), True, deviation)


def _rect(get: _Lengths, tolerance: float, budget: Budget) -> Outline | None:
    x, y = get.across("x"), get.down("y")
    width, height = get.across("width"), get.down("height")
    if width <= 0 or height <= 0:
        return None
    rx, ry = get.radii()
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    right, bottom = x + width, y + height
    if rx <= 0 or ry <= 0:
        budget.draw(4)
        return polyline(np.array([[x, y], [right, y], [right, bottom], [x, bottom]]), True)
    # From the upper left to the right, down, left and up; a corner starts from a node.
    turn = math.pi / 2
    longest = max(rx, ry)
    count = ellipses.piece_count(longest, turn, tolerance)
    budget.draw(4 * count + 4)
    corners = (
        (right - rx, y + ry, right - rx, y, right, y + ry),
        (right - rx, bottom - ry, right, bottom - ry, right - rx, bottom),
        (x + rx, bottom - ry, x + rx, bottom, x, bottom - ry),
        (x + rx, y + ry, x, y + ry, x + rx, y),
    )
    numbers: list[float] = []
    moved = 0.0
    a, b = x + rx, y
    for quarter, (cx, cy, p, q, r, s) in enumerate(corners, 3):
        numbers += (a, b, (2 * a + p) / 3, (2 * b + q) / 3, (a + 2 * p) / 3, (b + 2 * q) / 3, p, q)
        arc = ellipses.arc((cx, cy), (rx, 0.0), (0.0, ry), quarter * turn, turn, count)
        gap = math.hypot(arc[0] - p, arc[1] - q) + math.hypot(arc[-2] - r, arc[-1] - s)
        moved = max(moved, gap)
        arc[:2], arc[-2:] = (p, q), (r, s)
        numbers += arc
        a, b = r, s
    deviation = longest * ellipses.unit_deviation(turn / count) + moved
    return Outline(np.array(numbers).reshape(-1, 4, 2), True, deviation)
