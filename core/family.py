"""The three-parameter family: from (alpha, beta, gamma) to the mask (theory, section 4)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from typing import Final, Literal, get_args

from core.errors import ParameterError
from core.mask import ONE, Mask
from core.parents import bspline, lagrange

Neighbours = Literal["translated", "mirrored"]
"""Which neighbours the odd rule combines: the same as the even rule, or their mirror image."""

Scalar = int | float | Fraction | str
"""What is taken for a number: 1, 0.25, Fraction(1, 4), "1/4", "25.4/2"."""

MAX_PARAMETER: Final = 100
"""Largest admitted size of a parameter; useful members lie within 2, convergent ones within 3."""

MAX_DENOMINATOR: Final = 10**30
"""Largest admitted denominator: every float from 1e-13 up has its digits, and exact work ends."""

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?", re.ASCII)
_MAX_DIGITS: Final = 80

_KEPT: Final = 128
"""Number of masks that are made once only."""


def exact(value: Scalar, name: str = "value") -> Fraction:
    """Read a number exactly.

    Parameters
    ----------
    value
        A number, or its text: ``"0.25"``, ``"1/4"``, ``"25.4/2"``, ``"-1e-3"``. A float stands
        for the decimal number that Python prints for it, so 0.1 is 1/10.
    name
        What the number is, for the message.

    Raises
    ------
    ParameterError
        If the value is no number, is not finite, or has a numerator or denominator out of reach.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | Fraction | str):
        raise ParameterError(f"{name} must be a number or text such as 1/4, not {value!r}.")
    if isinstance(value, int | Fraction):
        number = Fraction(value)
    else:
        if isinstance(value, float) and not math.isfinite(value):
            raise ParameterError(f"{name} must be finite, not {value}.")
        number = _parsed(repr(float(value)) if isinstance(value, float) else value, name)
    if number.denominator > MAX_DENOMINATOR:
        raise ParameterError(f"{name} has too fine a fraction; use at most 30 decimals.")
    return number


def _parsed(text: str, name: str) -> Fraction:
    """Exact value of a decimal number or of a quotient of two."""
    cleaned = text.strip().replace("\N{MINUS SIGN}", "-")
    parts = [part.strip() for part in cleaned.split("/")]
    readable = len(cleaned) <= _MAX_DIGITS and len(parts) <= 2
    if not readable or not all(_NUMBER.fullmatch(part) for part in parts):
        shown = text if len(text) <= _MAX_DIGITS else text[:_MAX_DIGITS] + "..."
        raise ParameterError(f"{name} must be a number such as 0.25 or 1/4, not {shown!r}.")
    if len(parts) == 1:
        return Fraction(parts[0])
    divisor = Fraction(parts[1])
    if divisor == 0:
        raise ParameterError(f"{name} divides by zero: {text!r}.")
    return Fraction(parts[0]) / divisor


@cache
def displacement() -> Mask:
    """Mask of the displacement vectors ``V = Q - R`` (theory, section 3).

    Notes
    -----
    The paper prints the seven weights of this rule in reverse order (an erratum): its ``c_{-3}``
    is ``a_3 - b_3``. The definition decides.
    """
    return lagrange() - bspline()


@cache
def _displacements() -> tuple[Mask, Mask, Mask]:
    """Displacement of the own neighbour, the left and the right one."""
    v = displacement()
    return v, v.shifted(2), v.shifted(-2)


@dataclass(frozen=True, init=False)
class Parameters:
    """One member of the family: three exact parameters and the choice of neighbours.

    Parameters
    ----------
    alpha, beta, gamma
        Weights of the left, own and right displacement vector; numbers or text such as ``"3/10"``,
        at most 100 in size.
    neighbours
        ``"translated"`` (default): both rules combine the same neighbours; smooth, and a
        symmetric polygon leans when alpha and gamma differ. ``"mirrored"``: the odd rule swaps
        alpha and gamma; symmetric, but at most C^2 when they differ.

    Raises
    ------
    ParameterError
        If a parameter is no number or too large, or the neighbours' name is unknown.
    """

    alpha: Fraction
    beta: Fraction
    gamma: Fraction
    neighbours: Neighbours

    def __init__(
        self,
        alpha: Scalar = 0,
        beta: Scalar = 0,
        gamma: Scalar = 0,
        neighbours: str = "translated",
    ) -> None:
        for name, value in (("alpha", alpha), ("beta", beta), ("gamma", gamma)):
            number = exact(value, name)
            if abs(number) > MAX_PARAMETER:
                raise ParameterError(
                    f"{name} must lie between -{MAX_PARAMETER} and {MAX_PARAMETER}, not {value}."
                )
            object.__setattr__(self, name, number)
        if neighbours not in get_args(Neighbours):
            raise ParameterError(
                f"neighbours must be 'translated' or 'mirrored', not {neighbours!r}."
            )
        object.__setattr__(self, "neighbours", neighbours)

    @cached_property
    def mask(self) -> Mask:
        """Exact mask ``q + (alpha z^2 + beta + gamma z^-2) v`` (theory, section 4).

        Mirrored: ``q + [beta + (alpha+gamma) s] v + (alpha-gamma) d v(-z)`` with
        ``s, d = (z^2 +- z^-2) / 2``. Both are affine in the parameters, and agree when
        alpha = gamma.
        """
        return _mask(self.alpha, self.beta, self.gamma, self.neighbours)

    @property
    def reversed(self) -> Parameters:
        """The member that draws the same curve when the polygon is run through backwards."""
        if self.neighbours == "mirrored":
            return self
        return Parameters(self.gamma, self.beta, self.alpha, self.neighbours)

    @cached_property
    def name(self) -> str | None:
        """Name of the preset that this member is, or None."""
        for name, preset in PRESETS.items():
            if preset.mask == self.mask:
                return name
        return None


@lru_cache(maxsize=_KEPT)
def _mask(alpha: Fraction, beta: Fraction, gamma: Fraction, neighbours: Neighbours) -> Mask:
    """Mask of a member; the same object for the same member, which what is kept of it is found by.

    An equal one would be found too, after all of its fractions have been compared.
    """
    v, left, right = _displacements()
    if neighbours == "translated":
        return Mask.combined((ONE, lagrange()), (alpha, left), (beta, v), (gamma, right))
    mean, lean = (alpha + gamma) / 2, (alpha - gamma) / 2
    return Mask.combined(
        (ONE, lagrange()),
        (beta, v),
        (mean, left),
        (mean, right),
        (lean, left.alternated()),
        (-lean, right.alternated()),
    )


def default_box(neighbours: Neighbours) -> dict[str, tuple[Fraction, Fraction]]:
    """Range of each parameter in which a designer looks for curves, by its name.

    All members of these boxes converge: `core.hoelder.converge_throughout` proves it of each box
    as a whole, and a test runs that proof. Mirrored members with different neighbours are rough,
    which is why their box is narrower.
    """
    side = Fraction(1, 2) if neighbours == "translated" else Fraction(3, 10)
    return {
        "alpha": (-side, side),
        "beta": (Fraction(-5, 4), Fraction(1, 4)),
        "gamma": (-side, side),
    }


def one_parameter(beta: Scalar) -> Parameters:
    """One-parameter sub-scheme (0, beta, 0): the blend of Q and R, 7-point and symmetric."""
    return Parameters(0, beta, 0)


def two_parameter(alpha: Scalar, beta: Scalar) -> Parameters:
    """Two-parameter sub-scheme (alpha, beta, alpha): 9-point and symmetric."""
    return Parameters(alpha, beta, alpha)


PRESETS: Final[dict[str, Parameters]] = {
    "Lagrange": Parameters(0, 0, 0),
    "Calm": Parameters(0, "-1/2", 0),
    "Tight": Parameters("1/4", "-1/2", "1/4"),
    "Lean": Parameters("3/10", "-3/5", "-1/5"),
    "B-spline": Parameters(0, -1, 0),
}
"""Named members, from the one that follows the polygon closest to the smoothest."""
