"""A few points move: only the spans that follow them are drawn anew, the rest stays as it was.

Notes
-----
What stays was drawn within half of the tolerance. Where a new span begins, the chord of an old one
is cut: the curve keeps within half of the tolerance of the old chord, and the old chord, between
the cut and its end, within the same of the new one, whose ends are places on the curve.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.drawn import SPLICED_FROM, TOLERANCE_PX, Drawn, seen_mm
from app.figure import differing
from app.spans import span_vertices
from core.ranges import around, within
from core.runs import Runs

MOST_SPANS: Final = 256
"""Number of spans up to which those that changed are drawn one by one."""

MOST_RANGES: Final = 8
"""Number of stretches of them; beyond, all is drawn from the levels of detail."""


def spliced(base: Drawn, ratio: float) -> Drawn | None:
    """Drawn curve for the one that the figure of ``base`` stands for now.

    Parameters
    ----------
    base
        A curve drawn from its levels of detail, by the same view.
    ratio
        Device pixels per logical pixel.

    Returns
    -------
    Drawn or None
        None if too much has changed.
    """
    figure, camera = base.figure, base.camera
    limit, curve = figure.limit, figure.curve
    if limit is None or not figure.is_proven or limit.spans < SPLICED_FROM:
        return None
    if base.scheme is not figure.parameters or base.curve.placed is not curve.placed:
        return None
    changed = differing(base.curve, curve)
    if changed is None or len(changed) > MOST_SPANS:
        return None
    touched = figure.touched(changed)
    count = sum(len(spans) for spans in touched)
    if count > min(MOST_SPANS, limit.spans // 4) or len(touched) > MOST_RANGES:
        return None
    placed = figure.placed
    tolerance = TOLERANCE_PX / ratio * camera.pixel_mm / placed.stretch
    outline, polygon = base.outline, base.polygon
    for spans in touched:
        found = span_vertices(limit, spans, tolerance)
        if found is None:
            return None
        outline = inserted(outline, found[0], camera.to_pixels(placed(found[1])))
    edges_at = around(changed, 1, 1)
    for edges in within(edges_at, limit.spans, limit.closed):
        indices = np.arange(edges.start, edges.stop + 1)
        corners = camera.to_pixels(curve.places(indices % curve.count))
        polygon = inserted(polygon, indices.astype(np.float64), corners)
    shown = base.shown
    if shown is not None:
        low, high = seen_mm(camera)
        places = curve.places(changed)
        inside = ((places >= low) & (places <= high)).all(axis=1)
        shown = np.union1d(np.setdiff1d(shown, changed), changed[inside])
    return replace(
        base, curve=curve, outline=outline, polygon=polygon, shown=shown, base=base
    )


def inserted(runs: Runs, t: NDArray[np.float64], vertices: NDArray[np.float64]) -> Runs:
    """Runs with other vertices from ``t[0]`` to ``t[-1]``; chords that lead there are cut."""
    first = int(np.searchsorted(runs.parameters, t[0], "left"))
    after = int(np.searchsorted(runs.parameters, t[-1], "right"))
    starts, more = runs.starts, len(t) - (after - first)
    before, behind = starts[starts < first], starts[starts > after] + more
    # A run that a chord leads out of goes on in the new vertices, and those in the next run.
    own = np.array([first] if first in starts else [], dtype=np.intp)
    next_run = np.array([after + more] if after in starts else [], dtype=np.intp)
    return Runs(
        np.concatenate([runs.vertices[:first], vertices, runs.vertices[after:]]),
        np.concatenate([runs.parameters[:first], t, runs.parameters[after:]]),
        np.concatenate([before, own, next_run, behind]),
        runs.deviation,
    )
