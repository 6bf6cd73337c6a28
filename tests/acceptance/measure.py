"""How far what a program shows is from the exact curves."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from core.formats import prepare
from core.formats.svg import page
from independent import farthest
from seen import PAGE

EXACT_POINTS = 1 << 16
"""Exact points of a drawing, at least."""


@dataclass
class Row:
    """One file in one program.

    Attributes
    ----------
    box_mm
        Largest error of a side of the box.
    contours, closed
        As seen, None if the program has no such idea.
    is_whole
        Whether those are the numbers of the drawing.
    kinds
        Kinds of entities and how many there are.
    deviation_mm
        Distance between what is seen and the exact curves, the larger of both ways.
    finest_mm
        What the program's own numbers or pixels leave open.
    """

    box_mm: float
    contours: int | None
    closed: int | None
    is_whole: bool
    kinds: dict
    deviation_mm: float
    finest_mm: float


def measured(document, profile, seen):
    """Compare what is seen with the document."""
    exact = exact_lines(document)
    seen_lines = seen.lines
    corners = seen.corners
    points = np.concatenate(exact)
    box = np.stack([points.min(axis=0), points.max(axis=0)])
    if seen.frame == PAGE:
        content = prepare(document, profile)
        origin = (page(content)[0] - content.shift) * profile.unit_mm
        seen_lines = [line + origin for line in seen_lines]
        corners = corners + origin
    if seen.stroke:
        if (corners[0] < box[0] - seen.finest).any():  # the page does not cut the lines
            edges = np.concatenate([inked(line, seen.stroke / 2) for line in exact])
            box = np.stack([edges.min(axis=0), edges.max(axis=0)])
        # Pixels of a line are within half of its width, and of the pixel's diagonal.
        slack = seen.stroke / 2 + np.sqrt(2) * seen.finest
        dots = np.concatenate(seen_lines)
        there = cKDTree(points).query(dots)[0].max() - slack
        back = cKDTree(dots).query(points)[0].max() - np.sqrt(2) * seen.finest
    else:
        if seen.kinds.keys() == {"Point"}:
            seen_lines = [
                np.concatenate([line, line[:1]]) if curve.is_loop else line
                for line, curve in zip(seen_lines, document.curves, strict=True)
            ]
        there = farthest(np.concatenate(seen_lines), exact)
        back = farthest(points, seen_lines)
    loops = [curve.is_loop for curve in document.curves]
    is_whole = seen.contours in (None, len(loops)) and seen.closed in (None, sum(loops))
    return Row(
        float(np.abs(corners - box).max()),
        seen.contours,
        seen.closed,
        is_whole,
        dict(seen.kinds),
        max(float(there), float(back), 0.0),
        seen.finest,
    )


def exact_lines(document):
    """Dense exact points of the curves; a closed one ends where it starts."""
    limits = [curve.limit(document.parameters) for curve in document.curves]
    level = 0
    while sum(limit.spans for limit in limits) << level < EXACT_POINTS:
        level += 1
    found = []
    for limit in limits:
        points = limit.points(level)
        found.append(np.concatenate([points, points[:1]]) if limit.closed else points)
    return found


def inked(line, half):
    """Both edges of a line with a width, whose ends are flat."""
    ways = np.gradient(line, axis=0)
    across = np.stack([-ways[:, 1], ways[:, 0]], axis=1) / np.hypot(*ways.T)[:, None]
    return np.concatenate([line + half * across, line - half * across])
