"""A control polygon of few points whose limit curve keeps to a given contour, proven.

Notes
-----
What is sought is a polygon and, for each of its spans, a part of the contour. For given parts
`core.matching.settled` finds the points and moves the ends of the parts to where they fit best. The
errors of the spans then say how long their parts should be: an approximation of order q misses by a
constant times length^q, so ``(error / tolerance)^(1/q)`` is the number of spans that a part asks
for. This density is smoothed, since a span reads some 16 points, the contour is shared out anew,
and so on: the number of points grows slowly until the tolerance is reached, and then falls as long
as it is kept. So straight sides get few points and corners many.

This search is a heuristic: that there is no smaller polygon is not claimed. The deviation of what
it returns is proven, see `core.matching`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.chords import chord_constant
from core.errors import NinepointError
from core.limit import LimitCurve
from core.mask import Mask
from core.matching import FREE, HELD, deviations, settled
from core.polytope import Cancelled, never
from core.route import Route
from core.squares import SAMPLES, Squares

MOST: Final = 10_000
"""Number of control points up to which is searched, by default: some seconds of work."""

_ROUTE_SHARE: Final = 1 / 32
"""Share of the tolerance by which the contour may leave the polygon that stands for it."""

_FEWEST_CLOSED: Final = 3
"""Points of a closed polygon, so that it has an area."""

_FIRST: Final = 5
"""Fewest spans to begin with."""

_TURN: Final = np.pi / 3
"""Angle that a span may turn by at the beginning: a spiral has to be seen as one."""

_GROWTH: Final = 1.08
"""Factor by which the number of spans grows at most; slowly, for the parts to find their places."""

_FAST_GROWTH: Final = 1.3
"""The same beyond `_FEW` spans."""

_STEP: Final = 50
"""The number changes by one, and one more in so many, at least, so that the search ends soon."""

_FEW: Final = 300
"""Number of spans up to which there is time to search well."""

_ORDERS: Final = ((40, 8.0), (150, 4.0))
"""Rounds, and the order q that is assumed in them. Corners have the order 1 and smooth parts 7: the
larger number is more careful. Where it does not get to the tolerance, as with curves that are no
smoother than those of the scheme, the smaller one does."""

_SPAN_FACTORS: Final = (0.5, 2.0)
"""Limits of the number of spans that one is replaced by."""

_AIM: Final = 0.9
"""Share of the tolerance that is aimed at while the number grows."""

_SMALLEST_ERROR: Final = 0.01
"""Share of the tolerance below which errors say nothing any more."""

_KERNEL: Final = np.array([1, 2, 3, 4, 3, 2, 1]) / 16
"""Weights that smooth the logarithm of the density over neighbouring spans."""

_HELD_ROUNDS: Final = 4
"""Rounds in which places are held about where they are, after each sharing out."""

_FREE_ROUNDS: Final = 6
"""Rounds in which they are free, if the tolerance is not reached yet. They find the parameters of a
curve of the same scheme, but may also go astray."""

_BETTER: Final = 0.5
"""Share of the error that free places must reach to be taken."""

_SHRINK: Final = (0.75, 0.93)
"""Limits of the factor by which the number of spans falls at once."""

_SHRINK_ORDER: Final = 10.0
"""The order q while it falls."""

_FAILURES: Final = 6
"""Vain attempts after which it falls no more."""

_ROUNDING: Final = 64 * float(np.finfo(float).eps)
"""Rounding of distances between samples and places, in parts of coordinates and lengths."""

_FINEST: Final = 1e-8
"""Smallest tolerance in parts of the length: the steps of least squares end a little below."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A polygon whose limit curve keeps to a contour.

    Attributes
    ----------
    points
        Control points, shape (n, 2). The first and last of an open one are the very ends of the
        contour. A closed one may start anywhere on it.
    closed
        Whether the polygon is closed.
    deviation
        Proven bound of the Hausdorff distance between the limit curve and the exact contour, in
        the unit of the points.
    """

    points: NDArray[np.float64]
    closed: bool
    deviation: float


def fit(
    controls: NDArray[np.float64],
    mask: Mask,
    closed: bool,
    tolerance: float,
    deviation: float = 0.0,
    most: int = MOST,
    cancelled: Cancelled = never,
) -> Fit:
    """Few control points whose limit curve is within ``tolerance`` of a contour.

    Parameters
    ----------
    controls
        The contour: cubic Bézier curves, shape (n, 4, 2), n >= 1; each starts with the very numbers
        that the one before ends with, and when closed the last one ends where the first one
        starts. They may have corners, and some may have no extent.
    mask
        The scheme. Sharp corners cost some ten points each, for it is smooth.
    closed
        Whether the contour, and so the polygon, is closed.
    tolerance
        Largest admitted deviation, > 0, in the unit of the contour.
    deviation
        How far the cubics may be from the exact contour; it counts towards the tolerance.
    most
        Largest number of control points.
    cancelled
        Asked now and then; True ends the search.

    Returns
    -------
    Fit
        A straight open contour gives two points.

    Raises
    ------
    ValueError
        If the controls are not finite, or not of that shape.
    NinepointError
        If the tolerance is not positive, or too small for the contour's own deviation, the rounding
        of its coordinates, its length (1e-8 of it) or ``most`` points; if the contour is a dot; if
        the search was cancelled.
    NoLimitError
        If the scheme has no proven bound between samples (`core.chords`).
    """
    controls = np.asarray(controls, dtype=np.float64)
    if controls.ndim != 3 or controls.shape[1:] != (4, 2) or not len(controls):
        raise ValueError(f"cubics must have the shape (n, 4, 2), n >= 1, not {controls.shape}")
    if not np.isfinite(controls).all():
        raise ValueError("cubics must be finite")
    if not tolerance > 0:
        raise NinepointError(f"The tolerance must be greater than 0, not {tolerance:g}.")
    chord_constant(mask)
    # Distances are differences: numbers about 0 keep their digits.
    low, high = controls.min(axis=(0, 1)), controls.max(axis=(0, 1))
    centre = (low + high) / 2
    size = float(np.abs(controls).max())
    route = Route(controls - centre, closed, max(_ROUTE_SHARE * tolerance, _ROUNDING * size))
    taken = deviation + route.bound + _ROUNDING * (size + route.length)
    if not taken < tolerance:
        raise NinepointError(
            f"This contour is known within {taken:.2g} mm only, so it cannot be fitted within"
            f" {tolerance:g} mm; choose a larger tolerance."
        )
    if tolerance < _FINEST * route.length:
        raise NinepointError(
            f"A contour {route.length:.3g} mm long can be fitted within"
            f" {_FINEST * route.length:.2g} mm at best, not {tolerance:g} mm; choose a larger"
            " tolerance."
        )
    found = _Search(route, mask, tolerance - taken, most, cancelled).found()
    if found.error > tolerance - taken:
        raise NinepointError(
            f"With {most:,} points at most the curve comes within {found.error + taken:.2g} mm of"
            f" this contour, not {tolerance:g} mm; choose a larger tolerance, or take the vertices"
            " of the contour instead."
        )
    points = found.points + centre
    if not closed:
        points[0], points[-1] = controls[0, 0], controls[-1, 3]
    return Fit(points, closed, found.error + taken)


@dataclass(frozen=True, eq=False)
class _Attempt:
    """A polygon, the places of its samples (see `core.matching.settled`), and its errors."""

    points: NDArray[np.float64]
    places: NDArray[np.float64]
    errors: NDArray[np.float64]

    @property
    def error(self) -> float:
        """Largest error of a span."""
        return float(self.errors.max())

    @property
    def spans(self) -> int:
        """Number of spans."""
        return len(self.errors)


class _Search:
    """The search for one contour; ``admitted`` is what is left of the tolerance."""

    def __init__(
        self, route: Route, mask: Mask, admitted: float, most: int, cancelled: Cancelled
    ) -> None:
        self.route, self.mask, self.admitted = route, mask, admitted
        self.cancelled = cancelled
        # As a number of spans.
        self.fewest = _FEWEST_CLOSED if route.closed else 1
        self.most = max(most if route.closed else most - 1, self.fewest)

    def found(self) -> _Attempt:
        """The smallest polygon that is found within what is admitted, else the closest one."""
        if not self.route.closed:
            straight = self.tried(self.first(1))
            if straight.error <= self.admitted:
                return straight
        few = max(_FIRST, int(self.route.turning / _TURN))
        grown = self.grown(self.tried(self.first(min(few, self.most))))
        return self.shrunk(grown) if grown.error <= self.admitted else grown

    def grown(self, attempt: _Attempt) -> _Attempt:
        """More and more points, until the tolerance is reached, or there are too many."""
        best = attempt
        for rounds, order in _ORDERS:
            for _ in range(rounds):
                if attempt.error <= self.admitted:
                    return attempt
                if attempt.spans >= self.most:
                    return best
                wanted = np.exp(self.needs(attempt, _AIM) / order)
                wanted = np.clip(wanted, *_SPAN_FACTORS)
                growth = _GROWTH if attempt.spans < _FEW else _FAST_GROWTH
                spans = min(int(np.ceil(wanted.sum())), int(attempt.spans * growth))
                spans = min(max(spans, attempt.spans + _step(attempt.spans)), self.most)
                attempt = self.tried(_shared(attempt.places, wanted, spans))
                if attempt.error < best.error:
                    best = attempt
        return best

    def shrunk(self, best: _Attempt) -> _Attempt:
        """Fewer and fewer points, as long as the tolerance is kept."""
        attempt, failures = best, 0
        while failures < _FAILURES and best.spans > self.fewest:
            needs = self.needs(attempt, 1.0) / _SHRINK_ORDER
            share = float(np.clip(np.exp(needs).mean(), *_SHRINK)) ** (1 / (1 + failures))
            spans = min(int(best.spans * share), best.spans - _step(best.spans))
            spans = max(spans, self.fewest)
            attempt = self.tried(_shared(attempt.places, np.exp(needs - needs.mean()), spans))
            if attempt.error <= self.admitted:
                best, failures = attempt, 0
            else:
                failures += 1 if attempt.spans < _FEW else _FAILURES // 2
        return best

    def tried(self, places: NDArray[np.float64]) -> _Attempt:
        """The best polygon for given places, which then move."""
        if self.cancelled():
            raise NinepointError("The fit was stopped.")
        route = self.route
        spans = len(places) // SAMPLES
        squares = Squares(spans if route.closed else spans + 1, self.mask, route.closed)
        targets = route.at(places)
        nodes = targets[::SAMPLES][: squares.count]
        points = np.stack([nodes.real, nodes.imag], axis=1)
        points = squares.solved(points, targets[:-1])
        points, places = settled(route, squares, points, places, HELD, _HELD_ROUNDS)
        held = self.measured(squares, points, places)
        if held.error <= self.admitted or spans > _FEW:
            return held
        points, places = settled(route, squares, points, places, FREE, _FREE_ROUNDS)
        free = self.measured(squares, points, places)
        better = free.error <= max(_BETTER * held.error, self.admitted)
        return free if better else held

    def measured(
        self, squares: Squares, points: NDArray[np.float64], places: NDArray[np.float64]
    ) -> _Attempt:
        """The attempt with its errors."""
        x, y = squares.values(points)
        seen = float(np.abs(x + 1j * y - self.route.at(places[:-1])).max())
        curve = LimitCurve(points, self.mask, self.route.closed)
        errors = deviations(self.route, curve, places, max(seen, self.admitted))
        return _Attempt(points, places, errors)

    def first(self, spans: int) -> NDArray[np.float64]:
        """Places to begin with."""
        nodes = self.route.shared(spans)
        return np.interp(np.arange(spans * SAMPLES + 1) / SAMPLES, np.arange(spans + 1), nodes)

    def needs(self, attempt: _Attempt, aim: float) -> NDArray[np.float64]:
        """Logarithms of the errors, in units of what is aimed at, smoothed."""
        errors = np.maximum(attempt.errors, _SMALLEST_ERROR * self.admitted)
        logarithms = np.log(errors / (aim * self.admitted))
        margin = len(_KERNEL) // 2
        mode = "wrap" if self.route.closed else "edge"
        padded = np.pad(logarithms, margin, mode=mode)  # type: ignore[call-overload]
        return np.convolve(padded, _KERNEL, "valid")


def _step(spans: int) -> int:
    """By how much a number of spans changes at least."""
    return 1 + spans // _STEP


def _shared(
    places: NDArray[np.float64], wanted: NDArray[np.float64], spans: int
) -> NDArray[np.float64]:
    """Places of the samples when each span is replaced by as many as wanted, in proportion."""
    sums = np.concatenate([[0.0], np.cumsum(np.repeat(wanted, SAMPLES))])
    steps = np.linspace(0.0, sums[-1], spans * SAMPLES + 1)
    shared = np.interp(steps, sums, places)
    shared[-1] = places[-1]
    return shared
