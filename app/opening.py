"""What the program opens with: the ready shape of the first minute."""

from __future__ import annotations

from typing import Final

import numpy as np

from core.document import Curve, Document

READY_POINTS_MM: Final = (
    (10.0, 10.0),
    (60.0, -8.0),
    (110.0, 10.0),
    (118.0, 45.0),
    (80.0, 40.0),
    (60.0, 70.0),
    (40.0, 40.0),
    (2.0, 45.0),
)
"""A closed shape with round and tight bends, on which every parameter shows."""


def ready_document() -> Document:
    """The closed shape that a new user finds on the canvas, drawn by Calm."""
    return Document((Curve(np.array(READY_POINTS_MM), closed=True, name="Curve 1"),))
