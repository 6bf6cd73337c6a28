"""How lines of a foreign drawing become curves, as it is remembered."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from app.fields import shown_number, typed_number
from core.errors import ParameterError

FIRST_TOLERANCE: Final = Fraction(1, 100)
"""In mm: finer than laser cutters and printers place their tool."""


@dataclass(frozen=True)
class Way:
    """The choice in the import dialog.

    Attributes
    ----------
    is_fit
        Whether curves are fitted; else the vertices become control points.
    tolerance
        Of the fit, in mm, > 0.
    """

    is_fit: bool = True
    tolerance: Fraction = FIRST_TOLERANCE

    @property
    def text(self) -> str:
        """The way as it is remembered: "fit 0.01"."""
        return f"{'fit' if self.is_fit else 'vertices'} {shown_number(self.tolerance)}"

    @classmethod
    def read(cls, text: str) -> Way:
        """The way that a text says; the first one if it is nonsense."""
        kind, _, number = text.partition(" ")
        try:
            tolerance = typed_number(number, "tolerance")
        except ParameterError:
            return cls()
        if kind not in ("fit", "vertices") or tolerance <= 0:
            return cls()
        return cls(kind == "fit", tolerance)
