"""What is seen of a curve: runs of few vertices, within a tolerance of the exact curve.

Notes
-----
The pyramid is descended from its top: nodes out of the rectangle are dropped, those that are
straight within the tolerance become chords, two and four of them at a time where that suffices.
Where a single span is too bent, its window of control points says by the same bound
``c_l max |D2p|`` (`core.chords`) at which dyadic level l its chords are straight enough; above
level 3 its eight parts are looked at apart, each with the control points that three refinements
give it, so that only those in the rectangle are followed, at any zoom.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.affine import IDENTITY, Affine
from core.basis import BasicLimitFunction
from core.blocks import FAN, bends_of, boxes_of, from_segments
from core.chords import cell_constant, chord_constant
from core.limit import LimitCurve
from core.mask import Mask
from core.parts import STEP, refinements
from core.pyramid import CurvePyramid, Pyramid, contained, meets
from core.runs import PARTS, Chords, Runs

BUDGET: Final = 4000
"""Number of chords that a view takes on, about, before its tolerance gives way."""

_ROUNDS: Final = 12
"""Rounds of refinement, 36 levels: beyond, rounding is larger than any part of a span."""


def view(
    pyramid: Pyramid,
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
    tolerance: float,
    origin: NDArray[np.float64] | None = None,
    budget: int = BUDGET,
    placed: Affine = IDENTITY,
) -> Runs:
    """Vertices of the parts of a curve that may meet a rectangle.

    Parameters
    ----------
    pyramid
        A curve, or a polygon, with its levels of detail.
    lower, upper
        Corners of the rectangle, shape (2,).
    tolerance
        Largest admitted distance between curve and chords, > 0, in the unit of the points.
    origin
        What is subtracted from the vertices, shape (2,). At high zoom an origin within the
        rectangle keeps the digits that matter, however far the drawing lies from (0, 0).
    budget
        Number of chords that is not exceeded by much: then nodes are taken as they are.
    placed
        Where the curve lies that is seen: limit curves follow affine maps exactly, so one that
        moves as a whole needs no other levels of detail. Rectangle, tolerance, origin and result
        are those of the image. A rectangle that is turned takes up to twice the vertices.

    Returns
    -------
    Runs
        All of the curve that lies in the rectangle, and a little beyond it. Of a scheme that is not
        proven to converge a finite level is seen, and no deviation is known: it is infinite.
    """
    shift = np.zeros(2) if origin is None else np.asarray(origin, dtype=np.float64)
    if placed is not IDENTITY:
        back = placed.inverse
        own = back(shift)
        low, high = back.box(np.asarray(lower), np.asarray(upper))
        runs = view(pyramid, low, high, tolerance / placed.stretch, own, budget)
        # The origin's way there and back leaves a rounding.
        vertices = Affine(placed.matrix, placed(own) - shift)(runs.vertices)
        return runs._replace(vertices=vertices, deviation=runs.deviation * placed.stretch)
    limits = np.concatenate([upper, -np.asarray(lower)])
    found = Chords(shift, budget, pyramid.places)
    if isinstance(pyramid, CurvePyramid) and pyramid.finest is not None:
        found.deviation = np.inf
    spans, bounds = _descend(pyramid, limits, tolerance, found)
    if isinstance(pyramid, CurvePyramid) and len(spans):
        if pyramid.finest is None:
            _subdivide(pyramid.curve, spans, bounds, limits, tolerance, shift, found)
        else:
            _tabulate(pyramid.curve, spans, pyramid.finest, shift, found)
    return found.joined()


def _descend(
    pyramid: Pyramid, limits: NDArray[np.float64], tolerance: float, found: Chords
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Collect chords over whole spans; return the spans that need finer ones, and their bounds."""
    total = pyramid.spans
    level = pyramid.depth - 1
    # At the top there is no parent whose parts could be joined, but eight nodes make one.
    nodes = pyramid.nodes(level)
    nodes = nodes[meets(pyramid.boxes(level, nodes), limits)]
    deviations = pyramid.deviations(level, nodes) + pyramid.slack(level, nodes)
    straight = deviations <= tolerance
    size: int = FAN ** (level + 1)
    found.add_parts(np.minimum(size * (nodes[straight] + np.arange(2)[:, None]), total))
    found.deviation = max(found.deviation, float(deviations[straight].max(initial=0.0)))
    nodes = nodes[~straight]
    while len(nodes):
        children = FAN * nodes + np.arange(FAN)[:, None]
        size //= FAN
        parts = _below(pyramid, level, nodes, children)
        seen = meets(parts.boxes, limits) & (size * children < total)
        deviations = parts.deviations + parts.slack
        wanted = seen & (deviations > tolerance)
        within = contained(parts.boxes, limits)
        bent = found.affordable(wanted, within, deviations, int(np.count_nonzero(seen)))
        taken = seen & ~bent
        found.deviation = max(found.deviation, float(deviations[taken].max(initial=0.0)))
        _join(found, children, taken, parts, tolerance, size, total)
        nodes = children.T[bent.T]
        if not level:
            return nodes, deviations.T[bent.T]
        level -= 1
    return nodes, np.zeros(0)


class _Parts(NamedTuple):
    """What is known of the eight parts of some nodes; the nodes lie along the last axis.

    Attributes
    ----------
    knots
        Where the polygon is cut, or for single spans the curve itself, shape (2, 9, m).
    deviations, slack
        As in `core.pyramid.Pyramid`, shape (8, m).
    boxes
        Shape (4, 8, m).
    """

    knots: NDArray[np.float64]
    deviations: NDArray[np.float64]
    slack: NDArray[np.float64]
    boxes: NDArray[np.float64]


def _below(
    pyramid: Pyramid, level: int, nodes: NDArray[np.intp], children: NDArray[np.intp]
) -> _Parts:
    """Parts of some nodes of a level: nodes of the level below, or spans."""
    if level:
        shape, flat = children.shape, children.ravel()
        return _Parts(
            pyramid.blocks.knots(level, nodes),
            pyramid.deviations(level - 1, flat).reshape(shape),
            pyramid.slack(level - 1, flat).reshape(shape),
            pyramid.boxes(level - 1, flat).reshape(4, *shape),
        )
    ends, margins = pyramid.spans_of(nodes)
    starts, stops = ends[:, :-1], ends[:, 1:]
    boxes = np.empty((4, *starts.shape[1:]))
    np.subtract(np.minimum(starts, stops), margins, out=boxes[:2])
    np.subtract(-np.maximum(starts, stops), margins, out=boxes[2:])
    deviations = np.hypot(margins[0], margins[1])
    return _Parts(ends, deviations, np.zeros_like(deviations), boxes)


def _join(
    found: Chords,
    children: NDArray[np.intp],
    taken: NDArray[np.bool_],
    parts: _Parts,
    tolerance: float,
    size: int,
    total: int,
) -> None:
    """Add chords over children (8, m), over four or two at once where they keep the tolerance."""
    left, firsts, afters = taken, [], []
    for step in (4, 2):
        groups = left.reshape(FAN // step, step, -1)
        good = groups.all(axis=1)
        if not good.any():
            continue
        starts = parts.knots[:, :-1:step]
        inner = parts.knots[:, :-1].reshape(2, *groups.shape)[:, :, 1:] - starts[:, :, None]
        ways = parts.knots[:, step::step] - starts
        bounds = from_segments(inner, ways[:, :, None]).max(axis=1)
        for share in (parts.deviations, parts.slack):
            bounds += share.reshape(groups.shape).max(axis=1)
        good &= bounds <= tolerance
        found.deviation = max(found.deviation, float(bounds[good].max(initial=0.0)))
        first = children[::step][good]
        firsts.append(first)
        afters.append(first + step)
        left = (groups & ~good[:, None]).reshape(left.shape)
    first = children[left]
    times = np.concatenate([*firsts, first, *afters, first + 1]).reshape(2, -1)
    found.add_parts(np.minimum(size * times, total))


def _subdivide(
    curve: LimitCurve,
    spans: NDArray[np.intp],
    bounds: NDArray[np.float64],
    limits: NDArray[np.float64],
    tolerance: float,
    shift: NDArray[np.float64],
    found: Chords,
) -> None:
    """Collect chords of spans that are too bent for one, at the levels that they need."""
    mask = curve.mask
    basis = BasicLimitFunction(mask)
    to_parts, to_next = refinements(mask)
    coordinates = curve.endless_points.T
    windows = coordinates[:, spans[:, None] + np.arange(len(to_parts))] - shift[:, None, None]
    times, length = spans.astype(np.float64), 1.0
    limits = limits - np.concatenate([shift, -shift])
    constant: Callable[[Mask, int], float] = chord_constant
    table: Callable[[int], NDArray[np.float64]] = basis.span_table
    within = np.zeros(len(spans), dtype=bool)
    for _ in range(_ROUNDS):
        constants = np.array([constant(mask, level) for level in range(STEP + 1)])
        shrinking = np.minimum.accumulate(constants / constants[0])
        levels = (bounds[:, None] * shrinking > tolerance).sum(axis=1)
        wanted = levels > STEP
        levels = np.minimum(levels, STEP)
        bent = found.affordable(wanted, within, bounds, int((1 << levels).sum()))
        windows_left, times_left, bounds_left = windows[:, ~bent], times[~bent], bounds[~bent]
        levels = found.thinned(levels[~bent])
        for level in range(STEP + 1):
            chosen = levels == level
            if chosen.any():
                points = windows_left[:, chosen] @ table(level)
                found.add_curve(times_left[chosen], length, points)
                largest = float(bounds_left[chosen].max()) * float(shrinking[level])
                found.deviation = max(found.deviation, largest)
        if not bent.any():
            return
        windows = (windows[:, bent] @ to_parts).reshape(2, -1, len(to_next))
        length /= PARTS
        times = (times[bent, None] + length * np.arange(PARTS)).ravel()
        to_parts, table, constant = to_next, basis.cell_table, cell_constant
        margins = cell_constant(mask) * bends_of(windows).max(axis=2)
        bounds = np.hypot(margins[0], margins[1])
        ends = windows @ table(0)
        boxes = boxes_of(ends) - np.concatenate([margins, margins])
        seen = meets(boxes, limits)
        straight = seen & (bounds <= tolerance)
        found.add_curve(times[straight], length, ends[:, straight])
        found.deviation = max(found.deviation, float(bounds[straight].max(initial=0.0)))
        bent = seen & ~straight
        windows, times, bounds = windows[:, bent], times[bent], bounds[bent]
        within = contained(boxes[:, bent], limits)


def _tabulate(
    curve: LimitCurve,
    spans: NDArray[np.intp],
    level: int,
    shift: NDArray[np.float64],
    found: Chords,
) -> None:
    """Collect chords of spans at a finite level, of a curve of which no more is proven."""
    level = int(found.thinned(np.full(len(spans), level)).max())
    points = curve.span_points(spans, level).transpose(2, 0, 1) - shift[:, None, None]
    found.add_curve(spans.astype(np.float64), 1.0, points)
