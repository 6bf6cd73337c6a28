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

from core.flatten import polyline
from core.limit import LimitCurve
from core.touching import TouchingFit, cross, dot, touching, unit

_STRAIGHT: Final = 1e-10
"""Bulge below which an arc is a line; it turns by four times as much, in radians."""

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
    pieces = touching(curve, tolerance, _Biarcs) if tolerance > 0 else None
    if pieces is None:
        flat = polyline(curve, tolerance)
        return Arcs(flat.points, np.zeros(len(flat.points)), flat.closed, False, flat.deviation)
    joints = np.stack([pieces.joints.real, pieces.joints.imag], axis=1)
    points = np.stack([joints, pieces.rows[:, :2]], axis=1).reshape(-1, 2)
    # Lines, and biarcs of two lines, have no vertex between.
    kept = ~np.isnan(points[:, 0])
    points, bulges = points[kept], np.nan_to_num(pieces.rows[:, 2:]).ravel()[kept]
    if not curve.closed:
        points = np.concatenate([points, curve.control_points[-1:]])
        bulges = np.concatenate([bulges, [0.0]])
    # Arcs of no length are left where coincident control points stop the curve.
    differs = (points != np.roll(points, -1, axis=0)).any(axis=1)
    if not curve.closed or not differs.any():
        differs[-1] = True
    return Arcs(points[differs], bulges[differs], curve.closed, pieces.smooth, pieces.deviation)


class _Biarcs(TouchingFit):
    """The fit of biarcs.

    Its rows are: joint x, joint y, bulge before it, bulge after it; the joint is nan where one line
    does for both arcs.
    """

    columns = 4

    def smooth(
        self,
        start: NDArray[np.complex128],
        way: NDArray[np.complex128],
        tangents: tuple[NDArray[np.complex128], NDArray[np.complex128]],
        seen: NDArray[np.complex128],
        whole: bool,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `TouchingFit`. Both arcs turn by less than a half circle."""
        before, after = tangents
        square = np.abs(way) ** 2
        along = dot(before + after, way)
        root = along + np.sqrt(along**2 + np.abs(before - after) ** 2 * square)
        exists = (square > 0) & (root > 0)
        length = np.divide(square, root, out=np.zeros_like(root), where=exists)
        joint = (way + length * (before - after)) / 2
        common = unit(way - length * (before + after))
        chords, cosines, sines = [], [], []
        for chord, tangent in ((joint, before), (way - joint, common)):
            direction = unit(chord)
            chords.append(np.abs(chord))
            cosines.append(dot(tangent, direction))
            sines.append(cross(tangent, direction))
        exists &= np.minimum(*chords) > _STRAIGHT * np.abs(way)
        exists &= np.minimum(cosines[0], cosines[1]) > _HALF_CIRCLE
        curvatures = [
            np.divide(2 * sine, chord, out=np.zeros_like(chord), where=chord > 0)
            for chord, sine in zip(chords, sines, strict=True)
        ]
        bulges = np.stack(
            [s / (1 + np.maximum(c, _HALF_CIRCLE)) for s, c in zip(sines, cosines, strict=True)],
            axis=1,
        )
        straight = np.abs(bulges) < _STRAIGHT
        bulges[straight] = 0.0
        off = seen - joint[:, None]
        ahead = dot(common[:, None], off)
        errors, length_at = _arc_errors(seen, before, curvatures[0], after=False, whole=whole)
        other, other_length = _arc_errors(
            seen - way[:, None], after, curvatures[1], after=True, whole=whole
        )
        second = ahead > 0
        errors[second] = other[second]
        if whole:
            lengths = []
            for sine, cosine, curvature, chord in zip(
                sines, cosines, curvatures, chords, strict=True
            ):
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
            # Lines in place of arcs of no bulge to speak of are off by their sagittas, and one line
            # in place of two by what they turn.
            between += 4 * _STRAIGHT * np.maximum(*chords)
            largest = errors.max(axis=1) + between
        else:
            largest = errors.max(axis=1)
        largest[~exists] = np.inf
        joint[straight.all(axis=1)] = np.nan
        joint = joint + start
        rows = np.stack([joint.real, joint.imag, bulges[:, 0], bulges[:, 1]], axis=1)
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
