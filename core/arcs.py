"""The limit curve as circular arcs with common tangents, with the proven deviation.

Notes
-----
Two points of the curve and its exact tangents there, A, T and B, S, are joined by two arcs that
touch: the biarc with tangents of one length d at both ends. Its joint is
``J = (A + B + d (T - S)) / 2``, the common tangent there ``B - A - d (T + S)``, and d is the
positive solution of ``2 (1 - T S) d^2 + 2 (T + S)(B - A) d = |B - A|^2`` (Bolton, CAD 7, 1975).

Proof of the deviation. Each sample p_k is given a point q_k of the biarc, at the length s_k along
it: the nearest one of the first arc, if p_k lies before the normal at J, else of the second. A step
of the polygon of the samples is compared with the part of the biarc between its two points, at
equal shares of both. Their chords are no further apart than their ends, ``|p_k - q_k|``, and the
part of the biarc leaves its chord by at most ``k (s_k+1 - s_k)^2 / 8``, k the larger curvature: an
arc length parametrization has the second derivative k at most, across J too. The curve in turn
keeps to the polygon by `core.samples`, at equal shares as well. So the sum of the three bounds the
distance of curve and biarc as moving points (Fréchet), hence the Hausdorff distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.continuity import smoothness
from core.flatten import FEWEST_CLOSED, polyline
from core.limit import LimitCurve
from core.pieces import fitted
from core.samples import Samples, Sampling

_BOUND_SHARE: Final = 1 / 32
"""Share of the tolerance that the bound between the samples should take."""

_STRAIGHT: Final = 1e-10
"""Bulge below which an arc is a line; it turns by four times as much, in radians."""

_NO_SPACE: Final = 1 / 16
"""Share of the tolerance within which a curve may turn back and be replaced by a line."""

_HALF_CIRCLE: Final = 0.1
"""Smallest cosine of the half angle of an arc: arcs turn by less than 170 degrees."""


@dataclass(frozen=True, eq=False)
class Arcs:
    """A chain of circular arcs and lines, as a DXF LWPOLYLINE holds it.

    Attributes
    ----------
    points
        Vertices, shape (n, 2), in the direction of t; the first is not repeated when closed.
    bulges
        Shape (n,): the tangent of a quarter of the angle by which the arc from each vertex to the
        next turns, positive to the left; 0 is a line. The last one of an open chain is 0.
    closed
        Whether the last vertex is joined to the first.
    smooth
        Whether neighbours have a common tangent everywhere; else there may be corners.
    deviation
        Proven bound of the Hausdorff distance between the chain and the exact curve, in the unit
        of the points.
    """

    points: NDArray[np.float64]
    bulges: NDArray[np.float64]
    closed: bool
    smooth: bool
    deviation: float


def arcs(curve: LimitCurve, tolerance: float) -> Arcs:
    """Arcs that touch each other, within ``tolerance`` of the curve.

    Every second vertex lies on the curve and has its exact tangent. Where the curve stands still,
    so that it has no tangent, or turns back within a small part of the tolerance, lines take over;
    a scheme that is not proven C^1 gives lines only.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.

    Returns
    -------
    Arcs
        Pieces start at t = 0 and are as long as they can be, each from where the last one ends.

    Raises
    ------
    NinepointError
        As `core.flatten.polyline`.
    """
    order = smoothness(curve.mask).order
    if not tolerance > 0 or curve.spans == 0 or order is None or order < 1:
        return _lines(curve, tolerance)
    sampling = Sampling(curve, tolerance, _BOUND_SHARE)
    if 2 * sampling.largest_bound >= tolerance / 2:
        return _lines(curve, tolerance)
    points: list[NDArray[np.float64]] = []
    bulges: list[NDArray[np.float64]] = []
    deviation, smooth = 0.0, True
    for samples in sampling.blocks(slopes=True):
        steps = len(samples.x) - 1
        longest = -(-steps // FEWEST_CLOSED) if curve.closed and not points else steps
        fit = _Biarcs(samples, tolerance, float(np.abs(curve.control_points).max()))
        cuts, errors, rows = fitted(steps, fit, tolerance - samples.bound, longest)
        vertices = np.stack([samples.x, samples.y], axis=1)[cuts[:-1]]
        block = np.stack([vertices, rows[:, :2]], axis=1).reshape(-1, 2)
        # Lines, and biarcs of two lines, have no joint.
        kept = ~np.isnan(block[:, 0])
        points.append(block[kept])
        bulges.append(rows[:, 2:4].ravel()[kept])
        deviation = max(deviation, float(errors.max()) + samples.bound)
        smooth = smooth and bool(rows[:, 4].all())
    return _chain(curve, np.concatenate(points), np.concatenate(bulges), smooth, deviation)


def _lines(curve: LimitCurve, tolerance: float) -> Arcs:
    """The polyline, as arcs without bulges."""
    flat = polyline(curve, tolerance)
    return Arcs(flat.points, np.zeros(len(flat.points)), flat.closed, False, flat.deviation)


def _chain(
    curve: LimitCurve,
    points: NDArray[np.float64],
    bulges: NDArray[np.float64],
    smooth: bool,
    deviation: float,
) -> Arcs:
    """The arcs without those of no length, where coincident control points stop the curve."""
    if not curve.closed:
        points = np.concatenate([points, curve.control_points[-1:]])
        bulges = np.concatenate([bulges, [0.0]])
    differs = (points != np.roll(points, -1, axis=0)).any(axis=1)
    if not curve.closed or not differs.any():
        differs[-1] = True
    return Arcs(points[differs], bulges[differs], curve.closed, smooth, deviation)


class _Biarcs:
    """The fit of biarcs to samples.

    Its rows are: joint x, joint y, bulge before it, bulge after it, and whether the tangents at
    the ends are kept; the joint is nan where there is one line only.
    """

    def __init__(self, samples: Samples, tolerance: float, size: float) -> None:
        self._place = samples.x + 1j * samples.y
        slope = samples.slope_x + 1j * samples.slope_y
        speed = np.abs(slope)
        # A derivative is a sum of some 17 products of points and weights: this is its rounding.
        self._directed = speed > 64 * np.finfo(float).eps * size
        self._tangent = np.divide(slope, speed, out=np.ones_like(slope), where=self._directed)
        self._unseen = samples.bound
        self._no_space = _NO_SPACE * tolerance

    def solve(
        self, first: NDArray[np.intp], last: NDArray[np.intp], places: NDArray[np.intp], whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `core.pieces.Fit`."""
        start = self._place[first]
        way = self._place[last] - start
        before, after = self._tangent[first], self._tangent[last]
        seen = self._place[places] - start[:, None]
        errors, rows = _biarc(way, before, after, seen, whole)
        if not whole:
            # What the steps between the samples will add is about what it is for the curve.
            errors += self._unseen
        rows[:, 0] += start.real
        rows[:, 1] += start.imag
        # Without tangents, and where the curve turns back in no space, a line has to do.
        lined = ~(self._directed[first] & self._directed[last])
        lined |= np.isinf(errors) & (np.abs(seen).max(axis=1) <= self._no_space)
        lined |= (last - first == 1) & (errors > self._unseen)
        if lined.any():
            errors[lined] = segment_distance(seen[lined], way[lined])
            rows[lined] = (np.nan, np.nan, 0.0, np.nan, 0.0)
        return errors, rows


def _biarc(
    way: NDArray[np.complex128],
    before: NDArray[np.complex128],
    after: NDArray[np.complex128],
    seen: NDArray[np.complex128],
    whole: bool,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Biarcs from 0 to ``way`` with unit tangents there, and their errors for ``seen``; see `Fit`.

    Points and vectors are complex numbers, shape (k,), and (k, m) for what is seen. The error is
    infinite where there is no biarc of two arcs that turn by less than a half circle.
    """
    square = np.abs(way) ** 2
    along = _dot(before + after, way)
    root = along + np.sqrt(along**2 + np.abs(before - after) ** 2 * square)
    exists = (square > 0) & (root > 0)
    length = np.divide(square, root, out=np.zeros_like(root), where=exists)
    joint = (way + length * (before - after)) / 2
    common = _unit(way - length * (before + after))
    chords, cosines, sines = [], [], []
    for chord, tangent in ((joint, before), (way - joint, common)):
        direction = _unit(chord)
        chords.append(np.abs(chord))
        cosines.append(_dot(tangent, direction))
        sines.append(_cross(tangent, direction))
    exists &= np.minimum(*chords) > _STRAIGHT * np.abs(way)
    exists &= np.minimum(cosines[0], cosines[1]) > _HALF_CIRCLE
    curvatures = [
        np.divide(2 * sine, chord, out=np.zeros_like(chord), where=chord > 0)
        for chord, sine in zip(chords, sines, strict=True)
    ]
    bulges = np.stack(
        [s / (1 + np.maximum(c, _HALF_CIRCLE)) for s, c in zip(sines, cosines, strict=True)], axis=1
    )
    straight = np.abs(bulges) < _STRAIGHT
    bulges[straight] = 0.0
    off = seen - joint[:, None]
    ahead = _dot(common[:, None], off)
    errors, length_at = _arc_errors(seen, before, curvatures[0], after=False, whole=whole)
    other, other_length = _arc_errors(
        seen - way[:, None], after, curvatures[1], after=True, whole=whole
    )
    second = ahead > 0
    errors[second] = other[second]
    if whole:
        lengths = []
        for sine, cosine, curvature, chord in zip(sines, cosines, curvatures, chords, strict=True):
            round_ = np.abs(curvature) * chord > _STRAIGHT
            turn = 2 * np.arctan2(sine, cosine)
            lengths.append(np.divide(turn, curvature, out=chord.copy(), where=round_))
        length_at -= lengths[0][:, None]
        other_length += lengths[1][:, None]
        length_at[second] = other_length[second]
        # Lengths count from the joint now; who is over it on the wrong arc is given the joint.
        over = (length_at > 0) != second
        over &= length_at != 0
        errors[over] = np.abs(off[over])
        length_at[over] = 0.0
        steps = np.abs(np.diff(length_at, axis=1)).max(axis=1)
        bend = np.maximum(np.abs(curvatures[0]), np.abs(curvatures[1]))
        between = bend * steps**2 / 8
        # A line in place of an arc of no bulge to speak of is off by its sagitta.
        between += _STRAIGHT / 2 * np.maximum(*chords)
        largest = errors.max(axis=1) + between
    else:
        largest = errors.max(axis=1)
    largest[~exists] = np.inf
    joint[straight.all(axis=1)] = np.nan
    ones = np.ones(len(way))
    rows = np.stack([joint.real, joint.imag, bulges[:, 0], bulges[:, 1], ones], axis=1)
    return largest, rows


def _arc_errors(
    off: NDArray[np.complex128],
    tangent: NDArray[np.complex128],
    curvature: NDArray[np.float64],
    after: bool,
    whole: bool,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distance of points from an arc that starts at 0, or, ``after``, ends there.

    With a and n along and left of the tangent at 0, and curvature k, a point is off the circle by
    ``|k (a^2 + n^2) - 2 n| / (1 + w)``, ``w^2 = (k a)^2 + (1 - k n)^2``, for lines too. The second
    result is, if ``whole``, the length along the circle from 0, where it is on the arc's side.
    """
    own = off * np.conj(tangent)[:, None]
    a, n, k = own.real, own.imag, curvature[:, None]
    across, along = 1 - k * n, k * a
    width = np.sqrt(along**2 + across**2)
    errors = np.abs(along * a - (1 + across) * n) / (1 + width)
    beyond = a > 0 if after else a < 0
    errors[beyond] = np.abs(off[beyond])
    if not whole:
        return errors, errors
    round_ = np.abs(k) * np.abs(a).max(axis=1, keepdims=True) > _STRAIGHT
    lengths = np.divide(np.arctan2(along, across), k, out=a.copy(), where=round_)
    lengths[beyond] = 0.0
    return errors, lengths


def segment_distance(
    seen: NDArray[np.complex128], way: NDArray[np.complex128]
) -> NDArray[np.float64]:
    """Largest distance of points, shape (k, m), from the segments from 0 to ``way``, shape (k,)."""
    square = np.abs(way) ** 2
    share = np.divide(
        _dot(seen, way[:, None]),
        square[:, None],
        out=np.zeros(seen.shape),
        where=square[:, None] > 0,
    )
    away: NDArray[np.float64] = np.abs(seen - np.clip(share, 0, 1) * way[:, None])
    return np.asarray(away.max(axis=1))


def _dot(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.float64]:
    return np.asarray(a.real * b.real + a.imag * b.imag)


def _cross(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.float64]:
    return np.asarray(a.real * b.imag - a.imag * b.real)


def _unit(vectors: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """The vectors divided by their lengths; 0 stays."""
    lengths = np.abs(vectors)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)
