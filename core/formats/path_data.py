"""Path data of SVG as outlines: all commands, absolute and relative.

A fault ends the drawing, not the reading: what stands before it is drawn, as SVG says. Quadratic
curves become cubics exactly; arcs become cubics within a tolerance (`core.formats.ellipses`).
"""

from __future__ import annotations

import math
from array import array
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.formats import ellipses
from core.formats.budget import Budget
from core.formats.outlines import Outline, straight
from core.formats.path_tokens import ARITIES, runs

_ARC_STEPS: Final = 4
"""Cubics that take as long as the centre of an arc."""

_LONG: Final = 16
"""Number of equal segments from which on NumPy draws them faster than Python."""


class Drawn(NamedTuple):
    """Outlines of a shape, and whether its data have no fault.

    The outlines are raw: they may have cubics that are a point, and those that are said to be
    closed may lack the line from the end to the start (`core.formats.outlines.outline` tidies).
    """

    outlines: list[Outline]
    is_whole: bool


def outlines(text: str, tolerance: float, budget: Budget) -> Drawn:
    """Outlines of the ``d`` attribute of a path, raw.

    Parameters
    ----------
    text
        The attribute.
    tolerance
        Admitted deviation of arcs, positive, in the path's own unit.
    budget
        What pays for the cubics.

    Raises
    ------
    BudgetError
        If there are too many segments.

    Notes
    -----
    Coordinates are summed in the order of the file, as all programs do. They may be infinite or
    nan where the file's numbers are, or overflow: the caller looks at the final ones.
    """
    found, is_whole = runs(text)
    pen = _Pen(tolerance, budget)
    for letter, numbers in found:
        if not pen.draw(letter, numbers):
            is_whole = False
            break
    return Drawn(pen.finished(), is_whole)


class _Pen:
    """What has been drawn, and where the pen is."""

    def __init__(self, tolerance: float, budget: Budget) -> None:
        self._tolerance = tolerance
        self._budget = budget
        self._x = self._y = self._start_x = self._start_y = 0.0
        # The control point that S or T reflects; the pen's place if the last command was another.
        self._cubic = self._quadratic = (0.0, 0.0)
        self._rows = array("d")  # eight numbers a cubic
        self._blocks: list[NDArray[np.float64]] = []
        self._deviation = 0.0
        self._is_moved = False
        self._found: list[Outline] = []

    def draw(self, letter: str, numbers: list[float] | NDArray[np.float64]) -> bool:
        """Draw the segments of a command; False at a fault, what stands before it being drawn."""
        kind = letter.upper()
        is_relative = letter != kind
        if not self._is_moved and kind != "M":
            return False
        if kind == "Z":
            self._close()
            return len(numbers) == 0
        arity = ARITIES[kind]
        count = len(numbers) // arity
        if count == 0:
            return False
        is_whole = len(numbers) == count * arity
        self._budget.draw(count)
        if kind == "M":
            self._move(is_relative, float(numbers[0]), float(numbers[1]))
            numbers, kind, count = numbers[2:], "L", count - 1
        if kind in "LC" and count >= _LONG:
            block = np.asarray(numbers[: count * arity], dtype=np.float64)
            self._draw_block(kind, is_relative, block.reshape(count, -1, 2))
            return is_whole
        draw = getattr(self, f"_draw_{kind.lower()}")
        values = numbers if isinstance(numbers, list) else numbers.tolist()
        x = y = 0.0
        for low in range(0, count * arity, arity):
            if is_relative:
                x, y = self._x, self._y
            if not draw(x, y, *values[low : low + arity]):
                return False
        return is_whole

    def finished(self) -> list[Outline]:
        """All subpaths that have a segment."""
        self._end(False)
        return self._found

    def _move(self, is_relative: bool, x: float, y: float) -> None:
        self._end(False)
        if is_relative:
            x, y = self._x + x, self._y + y
        self._x, self._y = self._start_x, self._start_y = x, y
        self._cubic = self._quadratic = (x, y)
        self._is_moved = True

    def _close(self) -> None:
        self._end(True)
        self._x, self._y = self._start_x, self._start_y
        self._cubic = self._quadratic = (self._x, self._y)

    def _end(self, closed: bool) -> None:
        """End a subpath."""
        self._flush()
        if self._blocks:
            self._budget.begin()
            one = self._blocks[0] if len(self._blocks) == 1 else np.concatenate(self._blocks)
            self._found.append(Outline(one, closed, self._deviation))
            self._blocks = []
            self._deviation = 0.0

    def _flush(self) -> None:
        if self._rows:
            self._blocks.append(np.array(self._rows).reshape(-1, 4, 2))
            self._rows = array("d")

    def _draw_block(self, kind: str, is_relative: bool, points: NDArray[np.float64]) -> None:
        """Many lines or cubics at once; ``points`` has their control points but the first."""
        here = np.array([[self._x, self._y]])
        if is_relative:  # cumsum adds one after the other, as the pen does
            ends = np.cumsum(np.concatenate([here, points[:, -1]]), axis=0)
            points = points + ends[:-1, None]
            points[:, -1] = ends[1:]
        starts = np.concatenate([here, points[:-1, -1]])
        if kind == "L":
            block = straight(starts, points[:, 0])
        else:
            block = np.concatenate([starts[:, None], points], axis=1)
        self._flush()
        self._blocks.append(block)
        self._x, self._y = block[-1, 3].tolist()
        self._quadratic = self._cubic = (self._x, self._y)
        if kind == "C":
            p, q = block[-1, 2].tolist()
            self._cubic = (p, q)

    def _line_to(self, x: float, y: float) -> bool:
        a, b = self._x, self._y
        self._rows.extend(
            (a, b, (2 * a + x) / 3, (2 * b + y) / 3, (a + 2 * x) / 3, (b + 2 * y) / 3, x, y)
        )
        self._x, self._y = x, y
        self._cubic = self._quadratic = (x, y)
        return True

    def _draw_l(self, a: float, b: float, x: float, y: float) -> bool:
        return self._line_to(a + x, b + y)

    def _draw_h(self, a: float, b: float, x: float) -> bool:  # noqa: ARG002 - as its likes
        return self._line_to(a + x, self._y)

    def _draw_v(self, a: float, b: float, y: float) -> bool:  # noqa: ARG002
        return self._line_to(self._x, b + y)

    def _cubic_to(self, p: float, q: float, r: float, s: float, x: float, y: float) -> bool:
        self._rows.extend((self._x, self._y, p, q, r, s, x, y))
        self._x, self._y = x, y
        self._quadratic, self._cubic = (x, y), (r, s)
        return True

    def _draw_c(
        self, a: float, b: float, p: float, q: float, r: float, s: float, x: float, y: float
    ) -> bool:
        return self._cubic_to(a + p, b + q, a + r, b + s, a + x, b + y)

    def _draw_s(self, a: float, b: float, r: float, s: float, x: float, y: float) -> bool:
        p, q = 2 * self._x - self._cubic[0], 2 * self._y - self._cubic[1]
        return self._cubic_to(p, q, a + r, b + s, a + x, b + y)

    def _quadratic_to(self, p: float, q: float, x: float, y: float) -> bool:
        a, b = self._x, self._y
        self._rows.extend(
            (a, b, (a + 2 * p) / 3, (b + 2 * q) / 3, (2 * p + x) / 3, (2 * q + y) / 3, x, y)
        )
        self._x, self._y = x, y
        self._cubic, self._quadratic = (x, y), (p, q)
        return True

    def _draw_q(self, a: float, b: float, p: float, q: float, x: float, y: float) -> bool:
        return self._quadratic_to(a + p, b + q, a + x, b + y)

    def _draw_t(self, a: float, b: float, x: float, y: float) -> bool:
        p, q = 2 * self._x - self._quadratic[0], 2 * self._y - self._quadratic[1]
        return self._quadratic_to(p, q, a + x, b + y)

    def _draw_a(
        self, a: float, b: float, rx: float, ry: float, rotation: float,
        large: float, sweep: float, x: float, y: float,
    ) -> bool:  # fmt: skip
        if large not in (0, 1) or sweep not in (0, 1):
            return False
        ends = (self._x, self._y, a + x, b + y)
        found = _arc(*ends, abs(rx), abs(ry), rotation, large == sweep, sweep == 1)
        if found is None:  # a half axis is 0, or the ends are one point
            return self._line_to(a + x, b + y)
        centre, first, second, start, turn = found
        longest = max(math.hypot(*first), math.hypot(*second))
        count = ellipses.piece_count(longest, turn, self._tolerance)
        self._budget.draw(count + _ARC_STEPS)
        numbers = ellipses.arc(centre, first, second, start, turn, count)
        # The ends are those of the file, whose numbers the centre was computed from.
        moved = math.hypot(numbers[0] - ends[0], numbers[1] - ends[1])
        moved += math.hypot(numbers[-2] - ends[2], numbers[-1] - ends[3])
        numbers[:2], numbers[-2:] = ends[:2], ends[2:]
        deviation = longest * ellipses.unit_deviation(turn / count) + moved
        self._deviation = max(self._deviation, deviation)
        self._rows.extend(numbers)
        self._x, self._y = ends[2:]
        self._cubic = self._quadratic = ends[2:]
        return True


_Point = tuple[float, float]


def _arc(
    x0: float, y0: float, x1: float, y1: float,
    rx: float, ry: float, degrees: float, is_right: bool, is_positive: bool,
) -> tuple[_Point, _Point, _Point, float, float] | None:  # fmt: skip
    """Centre, half axes, first angle and turn of an arc; None where it is a line.

    After SVG's implementation notes (B.2.4): in units of the half axes, the ends lie on a unit
    circle at +-(u, v) around the middle of the chord; the centre is that middle turned out by a
    right angle. Half axes that are too short for the chord are stretched evenly (B.2.5).
    """
    if not (0 < rx < math.inf and 0 < ry < math.inf and math.isfinite(degrees)):
        return None
    angle = math.radians(math.fmod(degrees, 360))
    cos, sin = math.cos(angle), math.sin(angle)
    half_x, half_y = (x0 - x1) / 2, (y0 - y1) / 2
    u, v = (cos * half_x + sin * half_y) / rx, (cos * half_y - sin * half_x) / ry
    size = math.hypot(u, v)
    if not 0 < size < math.inf:
        return None
    away = 0.0
    if size > 1:
        rx, ry, u, v = rx * size, ry * size, u / size, v / size
    else:
        away = math.sqrt((1 - size) * (1 + size)) / size
    if is_right:
        away = -away
    centre_u, centre_v = away * v, -away * u
    start = math.atan2(v - centre_v, u - centre_u)
    turn = math.atan2(-v - centre_v, -u - centre_u) - start
    if is_positive and turn < 0:
        turn += 2 * math.pi
    elif not is_positive and turn > 0:
        turn -= 2 * math.pi
    first, second = (rx * cos, rx * sin), (-ry * sin, ry * cos)
    centre = (
        (x0 + x1) / 2 + centre_u * first[0] + centre_v * second[0],
        (y0 + y1) / 2 + centre_u * first[1] + centre_v * second[1],
    )
    if not all(map(math.isfinite, (*centre, *first, *second))):
        return None
    return centre, first, second, start, turn
