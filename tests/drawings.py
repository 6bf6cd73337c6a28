"""Drawings that the tests of several formats write."""

import numpy as np
from hypothesis import strategies as st

from core.document import Curve, Document
from core.family import PRESETS

# An F: none of its reflections and rotations is itself. Doubled corners keep the curve close.
F_POINTS = [
    (0, 0), (8, 0), (8, 20), (24, 20), (24, 28), (8, 28), (8, 42), (30, 42), (30, 50), (0, 50),
]  # fmt: skip


def letter_f(shift=(100.0, -30.0)):
    """An F, 30 x 50 mm, away from the origin, and an open stroke beside it."""
    stroke = Curve(np.array([(40, 0), (45, 10), (40, 30), (50, 50)]) + shift, False, "Stroke")
    return Document((Curve(np.array(F_POINTS) + shift, True, "Letter F"), stroke))


coordinates = st.integers(-2000, 2000).map(lambda quarters: quarters / 4)
documents = st.builds(
    Document,
    st.lists(
        st.builds(
            Curve,
            st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=9, unique=True),
            st.booleans(),
        ),
        min_size=1,
        max_size=2,
    ),
    st.sampled_from(list(PRESETS.values())),
)
tolerances = st.sampled_from([0.02, 0.1, 1.0])


def extents(document, level=7):
    """Smallest and largest x and y of dense points of the exact curves."""
    points = np.concatenate(
        [curve.limit(document.parameters).points(level) for curve in document.curves]
    )
    return points.min(axis=0), points.max(axis=0)
