"""An outline as a file was read back, and whether points keep near it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError

MOST_POINTS: Final = 2**17
"""Points that a comparison looks at, or divides an outline into, beyond those that it has."""

_TINY: Final = 1e-12
"""Angle below which an arc is its chord."""

_LEAST: Final = 4
"""Parts of each piece, at least."""


@dataclass(frozen=True, eq=False)
class Readback:
    """One contour of a file.

    Attributes
    ----------
    line
        Points on the contour in its order, shape (n, 2), in the unit of the file, y up; the first
        is repeated at the end when closed.
    slack
        Bound of how far the contour leaves the polygon of these points.
    closed
        Whether the file says that it is closed, or it ends in the very point where it starts.
    count
        Number of pieces: lines, arcs, cubics, or parts of a spline.
    layer
        Name of its layer.
    """

    line: NDArray[np.float64]
    slack: float
    closed: bool
    count: int
    layer: str


def numbers_in(words: str, count: int) -> NDArray[np.float64]:
    """Numbers between white space, of which there have to be ``count``.

    Raises
    ------
    NinepointError
        If there are others, or something is no number.
    """
    with warnings.catch_warnings():
        # What is no number ends NumPy's reading with a warning, later with an error.
        warnings.simplefilter("error")
        try:
            values = np.fromstring(words, sep=" ")
        except (DeprecationWarning, ValueError):
            values = np.zeros(0)
    if len(values) != count or not np.isfinite(values).all():
        raise NinepointError("it has damaged numbers")
    return values


def arcs_read(
    points: NDArray[np.float64], bulges: NDArray[np.float64], closed: bool, layer: str, fine: float
) -> Readback:
    """Readback of arcs as a file has them, divided so that parts leave their chords by ``fine``."""
    start, end = points[:-1], points[1:]
    bulge = bulges[:-1]
    if closed:
        start, end, bulge = points, np.roll(points, -1, axis=0), bulges
    count = len(start)
    if not bulge.any():
        line = np.concatenate([start, end[-1:]])
        return Readback(line, 0.0, closed, count, layer)
    # A part of an arc that turns by a leaves its chord by r (1 - cos(a/2)) <= r a^2 / 8,
    turn = 4 * np.arctan(np.abs(bulge))
    chord = np.hypot(*(end - start).T)
    # and r is half of the chord over sin(a/2).
    height = chord / 8 * turn * (turn / 2 / np.sin(np.maximum(turn / 2, _TINY)))
    parts = _parts(height, fine)
    slack = float((height / parts**2).max())
    piece, share = _places(parts)
    # On the circle through both ends the angles at which they are seen share out the turn.
    angle = 2 * np.arctan(bulge)[piece]
    z = np.divide(
        np.sin(angle * share) * np.exp(-1j * angle * (1 - share)),
        np.sin(angle),
        out=share.astype(np.complex128),
        where=np.abs(angle) > _TINY,
    )
    from_ = start[piece, 0] + 1j * start[piece, 1]
    to = end[piece, 0] + 1j * end[piece, 1]
    place = from_ + (to - from_) * z
    line = np.concatenate([np.stack([place.real, place.imag], axis=1), end[-1:]])
    return Readback(line, slack, closed, count, layer)


def cubics_read(
    controls: NDArray[np.float64], closed: bool, layer: str, fine: float
) -> Readback:
    """Readback of Bézier curves, shape (n, 4, 2), divided so."""
    bends = 6 * np.abs(controls[:, :2] - 2 * controls[:, 1:3] + controls[:, 2:])
    bend = np.hypot(bends[..., 0], bends[..., 1]).max(axis=1)
    parts = _parts(bend / 8, fine)
    slack = float((bend / 8 / parts**2).max())
    piece, share = _places(parts)
    u = share[:, None]
    zero, one, two, three = (controls[piece, k] for k in range(4))
    v = 1 - u
    line = v**3 * zero + 3 * u * v * v * one + 3 * u * u * v * two + u**3 * three
    line = np.concatenate([line, controls[-1:, 3]])
    return Readback(line, slack, closed, len(controls), layer)


def keep_near(
    points: NDArray[np.float64], line: NDArray[np.float64], reach: float
) -> bool:
    """Whether each of some points is within ``reach`` of a polygon.

    The polygon is cut into parts that are sorted into square cells, so that a point has to look at
    few of them: the time is about that of sorting.
    """
    steps = np.hypot(*np.diff(line, axis=0).T)
    longest = max(reach, float(steps.sum()) / MOST_POINTS)
    if not longest > 0:
        return bool((points == line[0]).all())
    parts = np.maximum(np.ceil(steps / longest), 1).astype(np.intp)
    piece, share = _places(parts)
    way = np.diff(line, axis=0)
    starts = line[piece] + share[:, None] * way[piece]
    ways = way[piece] / parts[piece][:, None]
    # A part within reach starts within two lengths, hence in one of nine cells.
    low = np.minimum(points.min(axis=0), line.min(axis=0))
    cell = 2 * longest
    columns = int((max(points[:, 0].max(), line[:, 0].max()) - low[0]) / cell) + 3
    at = ((starts - low) // cell).astype(np.int64) + 1
    keys = at[:, 1] * columns + at[:, 0]
    order = np.argsort(keys, kind="stable")
    keys, starts, ways = keys[order], starts[order], ways[order]
    seen = ((points - low) // cell).astype(np.int64) + 1
    centre = seen[:, 1] * columns + seen[:, 0]
    open_ = np.arange(len(points))
    for row in (0, -1, 1):
        first = np.searchsorted(keys, centre[open_] + row * columns - 1, side="left")
        last = np.searchsorted(keys, centre[open_] + row * columns + 1, side="right")
        # From the middle of the candidates outwards: it is the likeliest.
        while len(open_):
            has = first < last
            middle = np.where(has, first, 0)
            far = _distance(points[open_], starts[middle], ways[middle]) > reach
            wanting = far | ~has
            more = wanting & has
            if not more.any():
                open_ = open_[wanting]
                break
            # Those without candidates wait for the next row of cells.
            open_, first, last = open_[wanting], first[wanting] + 1, last[wanting]
        if not len(open_):
            return True
    return False


def _distance(
    points: NDArray[np.float64], starts: NDArray[np.float64], ways: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distance of each point from its own segment."""
    off = points - starts
    square = (ways**2).sum(axis=1)
    share = np.divide(
        (off * ways).sum(axis=1), square, out=np.zeros(len(points)), where=square > 0
    )
    rest = off - np.clip(share, 0, 1)[:, None] * ways
    return np.asarray(np.hypot(*rest.T))


def _parts(heights: NDArray[np.float64], fine: float) -> NDArray[np.intp]:
    """Number of parts of each piece, of which one leaves its chord by ``height``."""
    parts = np.ceil(np.sqrt(heights / fine)) if fine > 0 else np.full(len(heights), np.inf)
    most = max(MOST_POINTS // len(heights), _LEAST)
    return np.clip(parts, 1, most).astype(np.intp)


def _places(parts: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Piece of each part, and where in its piece it begins, from 0 to 1."""
    piece = np.repeat(np.arange(len(parts)), parts)
    begin = np.cumsum(parts) - parts
    number = np.arange(len(piece)) - begin[piece]
    return piece, number / parts[piece]
