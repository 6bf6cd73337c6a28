"""Pieces with the exact tangents of the curve at their ends, which hence touch each other.

Points and vectors are complex numbers here.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from core.continuity import smoothness
from core.flatten import FEWEST_CLOSED
from core.limit import LimitCurve
from core.pieces import fitted
from core.samples import Samples, Sampling

_BOUND_SHARE: Final = 1 / 64
"""Share of the tolerance that the bound between the samples should take."""

_ROUGHEST_SHARE: Final = 1 / 4
"""Share that it may take at most; beyond, the curve is too rough for anything but lines."""

_BLOCK: Final = 2**19
"""Number of samples held at a time: thousands of pieces, which are sought together."""

_NO_SPACE: Final = 1 / 16
"""Share of the tolerance within which a curve may turn back and be replaced by a line."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """A curve cut into pieces.

    Attributes
    ----------
    joints
        Points of the curve where pieces begin, shape (n,); the end of an open curve is not there.
    rows
        What the fit says of each piece, shape (n, r); nan where a line has to do.
    smooth
        Whether neighbours have a common tangent everywhere.
    deviation
        Proven bound of the distance between the pieces and the curve.
    """

    joints: NDArray[np.complex128]
    rows: NDArray[np.float64]
    smooth: bool
    deviation: float


class TouchingFit(ABC):
    """A `core.pieces.Fit` that keeps the tangents of the curve, or gives way to a line.

    Parameters
    ----------
    samples
        Points and derivatives.
    tolerance
        Admitted deviation.
    size
        Largest coordinate of the control points.
    """

    columns: ClassVar[int]
    """Length of the rows of a smooth piece; one more tells whether it is one."""

    def __init__(self, samples: Samples, tolerance: float, size: float) -> None:
        self.place = samples.x + 1j * samples.y
        slope = samples.slope_x + 1j * samples.slope_y
        speed = np.abs(slope)
        # A derivative is a sum of some 17 products of points and weights: this is its rounding.
        self._directed = speed > 64 * np.finfo(float).eps * size
        self._tangent = np.divide(slope, speed, out=np.ones_like(slope), where=self._directed)
        self._between = samples.bound
        self._no_space = _NO_SPACE * tolerance

    @abstractmethod
    def smooth(
        self,
        start: NDArray[np.complex128],
        way: NDArray[np.complex128],
        tangents: tuple[NDArray[np.complex128], NDArray[np.complex128]],
        seen: NDArray[np.complex128],
        whole: bool,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Fit smooth pieces.

        Parameters
        ----------
        start
            Where they begin, shape (k,).
        way
            From there to their ends, shape (k,).
        tangents
            Unit tangents at both ends, each of shape (k,).
        seen
            Points to be fitted, from ``start``; shape (k, m).
        whole
            As in `core.pieces.Fit`.

        Returns
        -------
        errors, rows
            As in `core.pieces.Fit`; infinite where there is no such piece.
        """

    def solve(
        self, first: NDArray[np.intp], last: NDArray[np.intp], places: NDArray[np.intp], whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `core.pieces.Fit`.

        The rows are nan where a line has to do; their last column is 1 for smooth pieces, else 0.
        """
        start = self.place[first]
        way = self.place[last] - start
        seen = self.place[places] - start[:, None]
        tangents = self._tangent[first], self._tangent[last]
        errors, found = self.smooth(start, way, tangents, seen, whole)
        rows = np.ones((len(first), self.columns + 1))
        rows[:, :-1] = found
        if not whole:
            # What the steps between the samples will add is about what it is for the curve.
            errors += self._between
        # Without tangents, and where the curve turns back in no space, a line has to do.
        lined = ~(self._directed[first] & self._directed[last])
        lined |= np.isinf(errors) & (np.abs(seen).max(axis=1) <= self._no_space)
        lined |= (last - first == 1) & (errors > self._between)
        if lined.any():
            errors[lined] = segment_distance(seen[lined], way[lined])
            rows[lined, :-1] = np.nan
            rows[lined, -1] = 0.0
        return errors, rows


def touching(curve: LimitCurve, tolerance: float, kind: type[TouchingFit]) -> Pieces | None:
    """Cut a curve into pieces of a kind, or None where only lines are safe.

    Parameters
    ----------
    curve
        The limit curve.
    tolerance
        Largest admitted deviation, > 0, in the unit of the control points.
    kind
        The fit.

    Returns
    -------
    Pieces or None
        None without spans, for a scheme that is not proven C^1, and where the bound between the
        samples does not come down far enough.

    Raises
    ------
    NinepointError
        As `core.samples.Sampling`.
    """
    order = smoothness(curve.mask).order
    if curve.spans == 0 or order is None or order < 1:
        return None
    sampling = Sampling(curve, tolerance, _BOUND_SHARE)
    if sampling.largest_bound > _ROUGHEST_SHARE * tolerance:
        return None
    size = float(np.abs(curve.control_points).max())
    joints: list[NDArray[np.complex128]] = []
    rows: list[NDArray[np.float64]] = []
    deviation = 0.0
    # One after the other: threads that search in short arrays wait for each other.
    for part in sampling.parts(_BLOCK):
        samples = sampling.block(*part, slopes=True)
        steps = len(samples.x) - 1
        longest = -(-steps // FEWEST_CLOSED) if curve.closed and not joints else steps
        fit = kind(samples, tolerance, size)
        cuts, errors, found = fitted(steps, fit, tolerance - samples.bound, longest)
        joints.append(fit.place[cuts[:-1]])
        rows.append(found)
        deviation = max(deviation, float(errors.max()) + samples.bound)
    whole = np.concatenate(rows)
    return Pieces(np.concatenate(joints), whole[:, :-1], bool(whole[:, -1].all()), deviation)


def segment_distance(
    seen: NDArray[np.complex128], way: NDArray[np.complex128]
) -> NDArray[np.float64]:
    """Largest distance of points, shape (k, m), from the segments from 0 to ``way``, shape (k,)."""
    square = np.abs(way) ** 2
    share = np.divide(
        dot(seen, way[:, None]),
        square[:, None],
        out=np.zeros(seen.shape),
        where=square[:, None] > 0,
    )
    away: NDArray[np.float64] = np.abs(seen - np.clip(share, 0, 1) * way[:, None])
    return np.asarray(away.max(axis=1))


def dot(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Scalar products."""
    return np.asarray(a.real * b.real + a.imag * b.imag)


def cross(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Cross products: positive where b lies to the left of a."""
    return np.asarray(a.real * b.imag - a.imag * b.real)


def unit(vectors: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """The vectors divided by their lengths; 0 stays."""
    lengths = np.abs(vectors)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)
