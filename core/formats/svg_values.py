"""Values of SVG attributes: lengths, transforms, view boxes, styles."""

from __future__ import annotations

import math
import re
from typing import Final, NamedTuple

from core.formats import path_tokens
from core.formats.affine import IDENTITY, Matrix

PX_MM: Final = 25.4 / 96
"""Millimetres of SVG's pixel, the unit behind plain numbers."""

UNITS_MM: Final = {
    "": PX_MM,
    "px": PX_MM,
    "mm": 1.0,
    "cm": 10.0,
    "q": 0.25,
    "in": 25.4,
    "pt": 25.4 / 72,
    "pc": 25.4 / 6,
    "em": 16 * PX_MM,
    "rem": 16 * PX_MM,
    "ex": 8 * PX_MM,
    "ch": 8 * PX_MM,
}
"""Millimetres of units; those of type are for the 16 px type that programs start with."""

_LENGTH: Final = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-z]*|%)\s*")
_FUNCTION: Final = re.compile(r"[\s,]*([a-zA-Z]+)\s*\(([^()]*)\)")
_ARITIES: Final = {
    "matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3),
    "skewX": (1,), "skewY": (1,),
}  # fmt: skip
_MAX_FUNCTIONS: Final = 1000
"""Largest number of functions in one transform."""


class Length(NamedTuple):
    """A number and its unit in small letters; "%" is one."""

    number: float
    unit: str

    @property
    def mm(self) -> float:
        """Millimetres; of no percentage."""
        return self.number * UNITS_MM[self.unit]

    def px(self, whole: float) -> float:
        """Pixels; percentages are of ``whole``."""
        if self.unit == "%":
            return self.number / 100 * whole
        return self.number if self.unit in ("", "px") else self.mm / PX_MM


def length(text: str | None) -> Length | None:
    """Length of an attribute; None if it is absent, ``auto`` or no length."""
    match = _LENGTH.fullmatch(text) if text is not None and len(text) < 100 else None
    if match is None:
        return None
    unit = match[2].lower()
    number = float(match[1])
    is_known = unit in UNITS_MM or unit == "%"
    return Length(number, unit) if is_known and math.isfinite(number) else None


def transform(text: str) -> Matrix | None:
    """Matrix of a ``transform`` attribute; None if it is faulty."""
    whole, position, count = IDENTITY, 0, 0
    while match := _FUNCTION.match(text, position):
        position, count = match.end(), count + 1
        numbers = path_tokens.numbers(match[2])
        if numbers is None or count > _MAX_FUNCTIONS:
            return None
        values = list(map(float, numbers))
        if len(values) not in _ARITIES.get(match[1], ()):
            return None
        whole = whole.after(_function(match[1], values))
    return None if text[position:].strip(" \t\r\n,") else whole


def _function(name: str, values: list[float]) -> Matrix:
    if name == "matrix":
        return Matrix(*values)
    if name == "translate":
        return Matrix(1.0, 0.0, 0.0, 1.0, values[0], values[1] if len(values) > 1 else 0.0)
    if name == "scale":
        return Matrix(values[0], 0.0, 0.0, values[-1], 0.0, 0.0)
    turns = values[0] / 90
    if name == "rotate":
        cos, sin = _cos_sin(turns)
        turn = Matrix(cos, sin, -sin, cos, 0.0, 0.0)
        if len(values) == 1:
            return turn
        x, y = values[1:]
        there, back = Matrix(1.0, 0.0, 0.0, 1.0, x, y), Matrix(1.0, 0.0, 0.0, 1.0, -x, -y)
        return there.after(turn).after(back)
    slope = math.tan(math.radians(values[0] % 180)) if math.isfinite(turns) else math.nan
    if name == "skewX":
        return Matrix(1.0, 0.0, slope, 1.0, 0.0, 0.0)
    return Matrix(1.0, slope, 0.0, 1.0, 0.0, 0.0)


def _cos_sin(quarters: float) -> tuple[float, float]:
    """Cosine and sine of an angle in quarter turns, exact for whole ones."""
    if not math.isfinite(quarters):
        return math.nan, math.nan
    if quarters.is_integer():
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
    angle = math.radians(90 * math.fmod(quarters, 4))
    return math.cos(angle), math.sin(angle)


def view_box(text: str | None) -> tuple[float, float, float, float] | None:
    """Left, top, width and height; None if it is absent, faulty, or without an area."""
    numbers = path_tokens.numbers(text) if text else None
    if numbers is None or len(numbers) != 4 or not all(map(math.isfinite, numbers)):
        return None
    x, y, width, height = map(float, numbers)
    return (x, y, width, height) if width > 0 and height > 0 else None


def fitted(
    box: tuple[float, float, float, float], width: float, height: float, aspect: str | None
) -> Matrix:
    """Map of a view box into the rectangle (0, 0, width, height), by ``preserveAspectRatio``."""
    left, top, box_width, box_height = box
    across, down = width / box_width, height / box_height
    words = (aspect or "").replace("defer", " ").split()
    align = words[0] if words else "xMidYMid"
    if align == "none":
        return Matrix(across, 0.0, 0.0, down, -left * across, -top * down)
    factor = max(across, down) if words[1:] == ["slice"] else min(across, down)
    share_x = {"xMin": 0.0, "xMax": 1.0}.get(align[:4], 0.5)
    share_y = {"YMin": 0.0, "YMax": 1.0}.get(align[4:], 0.5)
    x = (width - box_width * factor) * share_x - left * factor
    y = (height - box_height * factor) * share_y - top * factor
    return Matrix(factor, 0.0, 0.0, factor, x, y)


def declarations(style: str) -> dict[str, str]:
    """Properties of a ``style`` attribute, in small letters and without ``!important``."""
    found = {}
    for part in style.split(";"):
        name, colon, value = part.partition(":")
        if colon:
            found[name.strip().lower()] = value.replace("!important", "").strip().lower()
    return found


_RULE: Final = re.compile(r"([^{}]*)\{([^{}]*)\}")
_SELECTOR: Final = re.compile(r"[.#]?[A-Za-z_][\w-]*")


def hiding_rules(sheet: str) -> dict[str, dict[str, str]]:
    """``display`` and ``visibility`` of a style sheet, by simple selectors (tag, .class, #id)."""
    found: dict[str, dict[str, str]] = {}
    plain = re.sub(r"/\*.*?\*/", " ", sheet, flags=re.DOTALL)
    for selectors, body in _RULE.findall(plain):
        given = declarations(body)
        kept = {name: text for name, text in given.items() if name in ("display", "visibility")}
        if not kept:
            continue
        for selector in selectors.split(","):
            if _SELECTOR.fullmatch(selector.strip()):
                found.setdefault(selector.strip(), {}).update(kept)
    return found
