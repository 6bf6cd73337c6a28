"""Vertices of a few spans, without levels of detail: where there are few, that is faster."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.chords import chord_constant, second_difference_norm
from core.limit import LimitCurve
from core.pyramid import running_max

FINEST: Final = 6
"""Dyadic level beyond which a span has to be cut to what is seen of it."""


def span_vertices(
    limit: LimitCurve, spans: range, tolerance: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Places t and points of consecutive spans, each as fine as it needs, seen or not.

    Parameters
    ----------
    limit
        A curve whose chords have a proven bound (`core.chords.chord_constant`).
    spans
        The spans, at least one.
    tolerance
        Largest admitted distance between curve and chords, in the unit of the points.

    Returns
    -------
    t, points
        Shapes (k,) and (k, 2), both ends included; None if a span needs a level beyond `FINEST`.
    """
    mask = limit.mask
    reads = mask.end - mask.start + 1
    windows = limit.endless_points[spans.start : spans.stop + reads - 1]
    steps = windows[1:] - windows[:-1]
    bends = np.hypot(*(steps[1:] - steps[:-1]).T)
    bounds = chord_constant(mask) * running_max(bends, reads - 2)
    shrinking = [second_difference_norm(mask, level) for level in range(1, FINEST + 1)]
    if bounds.max() * shrinking[-1] > tolerance:
        return None
    levels = (bounds[:, None] * [1.0, *shrinking] > tolerance).sum(axis=1)
    sizes = 1 << levels
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    t, points = np.empty(offsets[-1] + 1), np.empty((offsets[-1] + 1, 2))
    for level in range(int(levels.max()) + 1):
        chosen = np.flatnonzero(levels == level)
        if not len(chosen):
            continue
        place = np.arange((1 << level) + 1)
        into = offsets[chosen][:, None] + place
        t[into] = spans.start + chosen[:, None] + place / (1 << level)
        points[into] = limit.span_points(spans.start + chosen, level)
    return t, points
