"""How close together control points stand: as handles, as dots, or not to be shown at all."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.style import SIZES

CROWD: Final = 500
"""Number of control points in view beyond which they are drawn as dots."""

MOST_HANDLES: Final = 2000
"""Number of control points in view beyond which they are not shown: they would be a blot."""

LEAST_SPACING_PX: Final = 4.0
"""Mean distance of neighbours below which control points are not shown: their dots would meet."""


def spacing(points: NDArray[np.float64]) -> float:
    """Mean distance of neighbours, of which there must be two, shape (k, 2)."""
    ways = points[1:] - points[:-1]
    ways *= ways
    lengths = np.sqrt(ways[:, 0] + ways[:, 1])
    return float(np.add.reduce(lengths)) / len(lengths)


def is_crowd(points_px: NDArray[np.float64]) -> bool:
    """Whether control points are so many, or so close, that handles would hide the drawing."""
    if len(points_px) < 3:
        return False
    return len(points_px) > CROWD or spacing(points_px) < SIZES.crowd_spacing
