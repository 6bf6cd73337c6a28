"""Whether contours keep their distance from the curves that they were offset from.

Nothing is taken from the way to the contours: distances from the exact curves, evaluated densely,
and which points the contours enclose. With kerf k and deviation d, see `core.formats.kerf`:

- each point of a contour is between k - d and k + d away from the curves;
- no point nearer to a curve than k - d is on the far side of a contour; and a point beyond k + d
  from all curves is enclosed by the contours just where it is enclosed by the curves (even-odd),
  so that no contour is missing, or one too many.

Both are looked at in `_PLACES` places, spread evenly. The second one says nothing of the near side
where the kerf itself is no larger than the deviation.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.chords import chord_constant
from core.formats.readback import MOST_POINTS
from core.limit import LimitCurve

_FINEST_LEVEL: Final = 10
"""Level at which curves are evaluated at most."""

_PLACES: Final = 512
"""Places that are looked at, on the contours and beside the curves."""

_BLOCK: Final = 32
"""Segments whose box is looked at before they are."""

_CLEAR: Final = 1.5
"""Deviations that a point keeps off the kerf, to be plainly on one side of it."""


def dense(limit: LimitCurve, most: int = MOST_POINTS) -> tuple[NDArray[np.float64], float]:
    """Exact points of a curve as a polygon, and how far the curve leaves it.

    Parameters
    ----------
    limit
        The curve.
    most
        Number of points up to which it is refined.

    Returns
    -------
    points
        Shape (n, 2); the first is repeated at the end when closed.
    slack
        Bound of the distance.
    """
    level = 0
    while level < _FINEST_LEVEL and limit.spans << level + 1 <= most:
        level += 1
    points = limit.points(level)
    if limit.closed:
        points = np.concatenate([points, points[:1]])
    bends = np.hypot(*np.diff(limit.endless_points, n=2, axis=0).T).max(initial=0.0)
    return points, chord_constant(limit.mask, level) * float(bends)


def keeps_distance(
    limits: Sequence[LimitCurve],
    lines: Sequence[NDArray[np.float64]],
    kerf: float,
    deviation: float,
) -> bool:
    """Whether closed contours are the offset of closed curves.

    Parameters
    ----------
    limits
        The curves.
    lines
        Closed polygons, the first point repeated.
    kerf
        The offset; > 0 to the outside.
    deviation
        What the distances may be off by.
    """
    most = max(MOST_POINTS // len(limits), 1)
    around = [dense(limit, most) for limit in limits]
    slack = max(slack for _, slack in around)
    starts, ways = _segments([points for points, _ in around])
    outline, steps = _segments(lines)
    reach, margin = abs(kerf), deviation + slack
    middles = _spread(outline + steps / 2)
    for places in (_spread(outline), middles):
        away = distances(places, starts, ways, reach + margin)
        # The middle of a chord lies within an arc; that is in the deviation.
        if not (np.abs(away - reach) <= margin).all():
            return False
    seen = _spread(starts)
    turns = np.arange(len(seen))
    side = np.stack([np.cos(turns), np.sin(turns)], axis=1)  # whole radians: all directions
    near = reach - _CLEAR * margin
    if near > 0 and (enclosed(seen + near * side, outline, steps) != (kerf > 0)).any():
        return False
    far = seen + (reach + _CLEAR * margin) * side
    far = far[distances(far, starts, ways, reach + margin) > reach + margin]
    within = enclosed(far, starts, ways)
    return bool((enclosed(far, outline, steps) == within).all())


def distances(
    places: NDArray[np.float64],
    starts: NDArray[np.float64],
    ways: NDArray[np.float64],
    reach: float,
) -> NDArray[np.float64]:
    """Distance of each place (m, 2) from the nearest segment; infinite beyond ``reach``."""
    count = -(-len(starts) // _BLOCK)
    spare = count * _BLOCK - len(starts)
    starts = np.concatenate([starts, np.repeat(starts[-1:], spare, axis=0)])
    ways = np.concatenate([ways, np.repeat(ways[-1:], spare, axis=0)])
    ends = (starts + ways).reshape(count, _BLOCK, 2)
    begins = starts.reshape(count, _BLOCK, 2)
    low = np.minimum(begins, ends).min(axis=1)
    high = np.maximum(begins, ends).max(axis=1)
    found = np.full(len(places), np.inf)
    for index, place in enumerate(places):
        off = np.maximum(np.maximum(low - place, place - high), 0)
        blocks = np.flatnonzero((off**2).sum(axis=1) <= reach**2)
        if not len(blocks):
            continue
        rows = (blocks[:, None] * _BLOCK + np.arange(_BLOCK)).ravel()
        way, start = ways[rows], place - starts[rows]
        square = (way**2).sum(axis=1)
        share = np.divide(
            (start * way).sum(axis=1), square, out=np.zeros(len(rows)), where=square > 0
        )
        away = np.hypot(*(start - np.clip(share, 0, 1)[:, None] * way).T).min()
        found[index] = away if away <= reach else np.inf
    return found


def enclosed(
    places: NDArray[np.float64], starts: NDArray[np.float64], ways: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Whether each place (m, 2) lies within an odd number of closed polygons."""
    found = np.zeros(len(places), dtype=np.bool_)
    ends = starts + ways
    for index, (x, y) in enumerate(places.tolist()):
        crossed = np.flatnonzero((starts[:, 1] > y) != (ends[:, 1] > y))
        share = (y - starts[crossed, 1]) / ways[crossed, 1]
        found[index] = np.count_nonzero(starts[crossed, 0] + share * ways[crossed, 0] > x) % 2
    return found


def _segments(
    lines: Sequence[NDArray[np.float64]],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Starts and ways of all segments of polygons whose first point is repeated."""
    starts = np.concatenate([line[:-1] for line in lines])
    return starts, np.concatenate([np.diff(line, axis=0) for line in lines])


def _spread(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Some of the points, spread evenly."""
    return points[np.unique(np.linspace(0, len(points) - 1, _PLACES).astype(np.intp))]
