"""Contours as Qt draws them: all at once, in parts that are short enough to be stopped between."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QByteArray, QDataStream
from PySide6.QtGui import QPainterPath

from core.arcs import Arcs
from core.beziers import Beziers
from core.flatten import Polyline
from core.formats.boxes import Shape
from core.splines import Spline

LONG: Final = 500
"""Pieces of a path up to which it is drawn in one go: a few milliseconds, in which no other thread
of Python's runs."""

_ELEMENT: Final = np.dtype([("kind", ">i4"), ("place", ">f8", 2)])
"""An element of a path as Qt's streams hold it."""

_MOVE, _LINE, _CURVE, _HANDLE = range(4)
"""Qt's kinds of elements; a cubic is one of kind curve and two handles."""

_WINDING: Final = 1
"""Qt's number of the rule by which a path is filled."""


def pieces_of(shape: Shape) -> NDArray[np.float64]:
    """The entities of a shape: cubics (n, 4, 2), or the lines of a polyline (n, 2, 2).

    An arc is two cubics; they leave it by less than 1/2,000 of its radius.
    """
    if isinstance(shape, Beziers):
        return shape.controls
    if isinstance(shape, Spline):
        return shape.beziers
    points = shape.points
    ends = np.roll(points, -1, axis=0)
    if not shape.closed:
        points, ends = points[:-1], ends[:-1]
    if isinstance(shape, Polyline):
        return np.stack([points, ends], axis=1)
    return _arc_cubics(points, ends, shape.bulges[: len(points)])


def joints_of(shape: Shape) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the entities of a shape begin, and for an open one the last one ends.

    Returns
    -------
    places, directions
        Shapes (k, 2); the directions of the shape there are of length 1, or 0 where there is none.
    """
    pieces = pieces_of(shape)
    if isinstance(shape, Arcs):
        starts, ends = pieces[::2], pieces[-1:]
    else:
        starts, ends = pieces, pieces[-1:]
    places, ways = starts[:, 0], _ways(starts)
    if not shape.closed:
        places = np.concatenate([places, ends[:, -1]])
        ways = np.concatenate([ways, -_ways(ends[:, ::-1])])
    return places, ways


def painter_paths(
    shape: Shape, corner: NDArray[np.float64], scale: float
) -> Iterator[QPainterPath]:
    """Qt's paths of a shape, y down.

    Parameters
    ----------
    shape
        What to draw.
    corner
        Its upper left corner, which becomes the origin.
    scale
        By how much it becomes larger.

    Yields
    ------
    QPainterPath
        The shape, closed if it is; one of more than `LONG` pieces in open parts. Each of these
        begins with the last piece of the one before, so that they join as the pieces in them do.
    """
    pieces = (pieces_of(shape) - corner) * (scale, -scale)
    if len(pieces) <= LONG:
        yield _path(pieces, shape.closed)
        return
    before = pieces[-1:] if shape.closed else pieces[:0]
    for part in np.array_split(pieces, -(-len(pieces) // LONG)):
        yield _path(np.concatenate([before, part]), False)
        before = part[-1:]


def _path(pieces: NDArray[np.float64], closed: bool) -> QPainterPath:
    """Path of pieces that join; through a stream, as each call of Qt's costs a microsecond."""
    count, size = pieces.shape[0], pieces.shape[1] - 1
    elements = np.zeros(1 + count * size, dtype=_ELEMENT)
    elements["kind"] = _LINE if size == 1 else _HANDLE
    if size > 1:
        elements["kind"][1::size] = _CURVE
    elements["kind"][0] = _MOVE
    elements["place"][0] = pieces[0, 0]
    elements["place"][1:] = pieces[:, 1:].reshape(-1, 2)
    data = b"".join(
        [
            np.array([len(elements)], ">i4").tobytes(),
            elements.tobytes(),
            np.array([0, _WINDING], ">i4").tobytes(),
        ]
    )
    path = QPainterPath()
    stream = QDataStream(QByteArray(data))
    stream >> path
    if closed:
        path.closeSubpath()
    return path


def _arc_cubics(
    start: NDArray[np.float64], end: NDArray[np.float64], bulge: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Two cubics for each arc; those of a line are its halves.

    An arc of the bulge b leaves its chord's middle by b/2 chords, to the right when it turns to
    the left. Each half has the bulge ``c = tan(atan(b) / 2)``, so it turns by 4 atan c, and a cubic
    that touches it at both ends has handles of ``4/3 c R``, which is (1 + c^2)/3 of its chord; they
    are turned against the chord by 2 atan c.
    """
    b = bulge[:, None]
    middle = (start + end) / 2 + b / 2 * _right(end - start)
    c = b / (1 + np.sqrt(1 + b * b))
    halves = []
    for first, last in ((start, middle), (middle, end)):
        chord = last - first
        along, aside = (1 - c * c) / 3 * chord, 2 * c / 3 * _right(chord)
        halves.append(np.stack([first, first + along + aside, last - along + aside, last], axis=1))
    return np.stack(halves, axis=1).reshape(-1, 4, 2)


def _right(ways: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([ways[:, 1], -ways[:, 0]], axis=1)


def _ways(pieces: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions in which pieces set out, of length 1 or 0."""
    steps = pieces[:, 1:] - pieces[:, :1]
    found = steps[:, -1]
    for k in reversed(range(steps.shape[1])):  # the first of the steps that leads anywhere
        leads = np.any(steps[:, k] != 0, axis=1, keepdims=True)
        found = np.where(leads, steps[:, k], found)
    lengths = np.hypot(*found.T)[:, None]
    return np.asarray(np.divide(found, lengths, out=np.zeros_like(found), where=lengths > 0))
