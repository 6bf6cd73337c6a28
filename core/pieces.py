"""Cutting a row of samples into few pieces, each of which a simple curve fits.

Notes
-----
From each cut the longest piece that fits is sought, by growing its length and closing in on it; no
other choice needs fewer pieces, as long as a part of a piece that fits, fits (which is nearly so).
All lanes, equal parts of a long row, go ahead in step, so that NumPy has work for many pieces at
once. While searching, a piece is looked at in `_GLANCES` places; in the end each is looked at in
all of its samples, and halved if it does not fit.
"""

from __future__ import annotations

from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

_GLANCES: Final = 40
"""Steps in which a piece is looked at while searching: ten for each wave of a cubic's error."""

_GLANCE_SHARE: Final = 0.99
"""Share of the admitted error that a search keeps to, because it does not see all samples."""

_GROWTH: Final = 1.5
"""Factor by which a piece grows while it fits."""

_RESOLUTION: Final = 64
"""A search ends when the length is known to one part in so many."""

_TOGETHER: Final = 16
"""Lengths that are tried at once, in all lanes together: so few take little longer than one."""

_LANE: Final = 2**11
"""Steps of a lane at first."""

_PIECES_A_LANE: Final = 32
"""Pieces that a lane should have at least; each lane may cost one piece more than needed."""

_CHUNK: Final = 2**17
"""Number of samples looked at in one go."""


class Fit(Protocol):
    """How a piece of the row is fitted."""

    def solve(
        self, first: NDArray[np.intp], last: NDArray[np.intp], places: NDArray[np.intp], whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Fit pieces.

        Parameters
        ----------
        first, last
            Samples at which the pieces begin and end, shape (k,).
        places
            Samples to look at, shape (k, m), ascending from ``first`` to ``last``.
        whole
            Whether these are all samples, so that the error can be proven.

        Returns
        -------
        errors, rows
            Deviation from the polygon of the samples, shape (k,), proven if ``whole``; a piece of
            one step must fit. What describes each fit, shape (k, r).
        """


def fitted(
    steps: int, fit: Fit, admitted: float, longest: int
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """Cut samples ``0 .. steps`` into few pieces that fit.

    Parameters
    ----------
    steps
        Number of steps between samples, at least 1.
    fit
        The fit.
    admitted
        Largest error, > 0.
    longest
        Largest number of steps of a piece, at least 1.

    Returns
    -------
    cuts, errors, rows
        Samples between pieces, with both ends, shape (n + 1,), and for each piece what `Fit.solve`
        gives.
    """
    lanes = steps // _LANE + 1
    while True:
        cuts = _searched(steps, fit, admitted * _GLANCE_SHARE, longest, lanes)
        wanted = max(len(cuts) // _PIECES_A_LANE, 1)
        if wanted >= lanes:
            break
        lanes = wanted
    errors, rows = _looked_at(fit, cuts[:-1], cuts[1:])
    while True:
        wide = np.flatnonzero((errors > admitted) & (np.diff(cuts) > 1))
        if not len(wide):
            return cuts, errors, rows
        middle = (cuts[wide] + cuts[wide + 1]) // 2
        left = _looked_at(fit, cuts[wide], middle)
        right = _looked_at(fit, middle, cuts[wide + 1])
        errors[wide], rows[wide] = left
        errors = np.insert(errors, wide + 1, right[0])
        rows = np.insert(rows, wide + 1, right[1], axis=0)
        cuts = np.insert(cuts, wide + 1, middle)


def _searched(steps: int, fit: Fit, admitted: float, longest: int, lanes: int) -> NDArray[np.intp]:
    """Cuts by the longest pieces that seem to fit, in each lane from its start."""
    ends = np.linspace(0, steps, lanes + 1).astype(np.intp)
    place, stop = ends[:-1].copy(), ends[1:]
    length = np.maximum((stop - place) // 8, 1)
    found = [place.copy()]
    active = np.arange(lanes)
    while len(active):
        room = np.minimum(stop[active] - place[active], longest)
        length[active] = _longest(fit, admitted, place[active], room, length[active])
        place[active] += length[active]
        found.append(place[active].copy())
        active = active[place[active] < stop[active]]
    return np.unique(np.concatenate(found))


def _longest(
    fit: Fit,
    admitted: float,
    first: NDArray[np.intp],
    room: NDArray[np.intp],
    guess: NDArray[np.intp],
) -> NDArray[np.intp]:
    """Length of the longest piece from each ``first`` that fits, at least 1, at most ``room``."""
    fits, fails = np.where(room == 1, 1, 0), room + 1
    tries = max(_TOGETHER // len(first), 1)
    open_ = np.flatnonzero(room > 1)
    powers = _GROWTH ** np.arange(-(tries // 2), tries - tries // 2)
    trial = (guess[open_, None] * powers).astype(np.intp)
    while len(open_):
        most = room[open_, None]
        trial = np.minimum(np.maximum(trial, 1), most)
        begin = np.repeat(first[open_], tries)
        size = trial.ravel()
        places = begin[:, None] + size[:, None] * np.arange(_GLANCES + 1) // _GLANCES
        errors, _ = fit.solve(begin, begin + size, places, whole=False)
        good = (errors <= admitted).reshape(trial.shape)
        # The longest that fits counts, even if a shorter one does not.
        low = np.maximum(np.where(good, trial, 0).max(axis=1), fits[open_])
        is_too_long = ~good & (trial > low[:, None])
        high = np.minimum(np.where(is_too_long, trial, most + 1).min(axis=1), fails[open_])
        fits[open_], fails[open_] = low, high
        is_growing = (high > room[open_]) & (low < room[open_])
        going = is_growing | (high - low > np.maximum(low // _RESOLUTION, 1))
        open_, low, high = open_[going], low[going, None], high[going, None]
        order = np.arange(1, tries + 1)
        grown = np.maximum((low * _GROWTH**order).astype(np.intp), low + order)
        between = low + (high - low) * order // (tries + 1)
        trial = np.where(is_growing[going, None], grown, between)
    return np.maximum(fits, 1)


def _looked_at(
    fit: Fit, first: NDArray[np.intp], last: NDArray[np.intp]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """What `Fit.solve` finds with all samples; pieces of about the same length go together."""
    errors = np.empty(len(first))
    rows: NDArray[np.float64] | None = None
    classes = np.ceil(np.log2(last - first)).astype(np.intp)
    for size in np.flatnonzero(np.bincount(classes)):
        members = np.flatnonzero(classes == size)
        width = 2 ** int(size) + 1
        for chunk in np.array_split(members, -(-len(members) * width // _CHUNK)):
            places = np.minimum(first[chunk, None] + np.arange(width), last[chunk, None])
            errors[chunk], found = fit.solve(first[chunk], last[chunk], places, whole=True)
            if rows is None:
                rows = np.empty((len(first), found.shape[1]))
            rows[chunk] = found
    assert rows is not None
    return errors, rows
