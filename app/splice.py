"""A few points move: only the spans that follow them are drawn anew, the rest stays as it was.

Notes
-----
What stays was drawn within half of the tolerance. Where a new span begins, the chord of an old one
is cut: the curve keeps within half of the tolerance of the old chord, and the old chord, between
the cut and its end, within the same of the new one, whose ends are places on the curve.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawn import SPLICED_FROM, TOLERANCE_PX, Drawn, seen_mm
from app.figure import differing
from app.polyline import snapped
from app.spans import SpanVertices
from core.document import Curve
from core.ranges import around, within
from core.runs import Runs

MOST_SPANS: Final = 256
"""Number of spans up to which those that changed are drawn one by one."""

MOST_RANGES: Final = 8
"""Number of stretches of them; beyond, all is drawn from the levels of detail."""


class Splice:
    """What stays of a drawn curve while some of its points move, and what is put in.

    Parameters
    ----------
    base
        A curve drawn from its levels of detail.
    changed
        The points, rising.
    touched
        Spans that read them.
    """

    def __init__(
        self, base: Drawn, changed: NDArray[np.intp], touched: tuple[range, ...]
    ) -> None:
        self.base, self.changed = base, changed
        count, closed = base.curve.count, base.curve.is_loop
        self._spans = [SpanVertices(spans) for spans in touched]
        edges = within(around(changed, 1, 1), count if closed else count - 1, closed)
        corners = [np.arange(edge.start, edge.stop + 1) for edge in edges]
        self._corners = [indices % count for indices in corners]
        self._corner_times = [indices.astype(np.float64) for indices in corners]
        self._outline, self._polygon = Inset(base.outline), Inset(base.polygon)
        self._shown: tuple[bytes, NDArray[np.intp]] | None = None

    @classmethod
    def of(cls, before: Drawn) -> Splice | None:
        """The splice for the curve that the figure of ``before`` stands for now.

        None if too much has changed; or if ``before`` is a splice of other points, which nothing
        can be put into, because the chords that it cut would be cut again.
        """
        splice = before.splice
        base = before if splice is None else splice.base
        figure = base.figure
        limit, curve = figure.limit, figure.curve
        if limit is None or not figure.is_proven or limit.spans < SPLICED_FROM:
            return None
        if base.scheme is not figure.parameters or base.curve.placed is not curve.placed:
            return None
        changed = differing(base.curve, curve)
        if changed is None or len(changed) > MOST_SPANS:
            return None
        if splice is not None:
            known = splice.changed
            return splice if changed is known or np.array_equal(changed, known) else None
        touched = figure.touched(changed)
        count = sum(len(spans) for spans in touched)
        if count > min(MOST_SPANS, limit.spans // 4) or len(touched) > MOST_RANGES:
            return None
        return cls(base, changed, touched)

    def drawn(self) -> Drawn | None:
        """The curve that the figure stands for now; None if a part of it is too fine for this."""
        base, figure = self.base, self.base.figure
        limit, curve, placed, camera = figure.limit, figure.curve, figure.placed, base.camera
        if limit is None:
            return None
        tolerance = TOLERANCE_PX / base.ratio * camera.pixel_mm / placed.stretch
        bent = []
        for spans in self._spans:
            found = spans.of(limit, tolerance)
            if found is None:
                return None
            places = camera.to_pixels(placed(found[1]))
            bent.append((found[0], snapped(places, base.ratio)))
        straight = [
            (t, camera.to_pixels(curve.places(indices)))
            for t, indices in zip(self._corner_times, self._corners, strict=True)
        ]
        shown = None if base.shown is None else self._shown_of(base.shown, curve)
        return Drawn(
            curve, base.scheme, figure, camera, base.ratio, self._outline.filled(bent),
            self._polygon.filled(straight), shown, base.strides, splice=self,
        )  # fmt: skip

    def _shown_of(self, shown: NDArray[np.intp], curve: Curve) -> NDArray[np.intp]:
        """Control points that are shown of a curve, by those of the base."""
        low, high = seen_mm(self.base.camera)
        places = curve.places(self.changed)
        inside = ((places >= low) & (places <= high)).all(axis=1)
        sign = inside.tobytes()
        if self._shown is None or self._shown[0] != sign:
            others = np.setdiff1d(shown, self.changed)
            self._shown = sign, np.union1d(others, self.changed[inside])
        return self._shown[1]


class _Cut(NamedTuple):
    """Where new vertices go: in place of those from ``first`` to before ``after``."""

    first: int
    after: int
    parameters: NDArray[np.float64]
    starts: NDArray[np.intp]


class Inset:
    """Runs in which stretches of vertices are put; chords that lead there are cut.

    Parameters
    ----------
    runs
        What is kept but for them.
    """

    def __init__(self, runs: Runs) -> None:
        self._runs = runs
        self._times: list[NDArray[np.float64]] = []
        self._cuts: list[_Cut] = []

    def filled(self, parts: list[tuple[NDArray[np.float64], NDArray[np.float64]]]) -> Runs:
        """The runs with other vertices from ``t[0]`` to ``t[-1]`` of each part ``(t, vertices)``.

        If t are the arrays of the call before, those of the result are so, too.
        """
        runs, times = self._runs, [t for t, _ in parts]
        if len(times) != len(self._times) or any(
            t is not known for t, known in zip(times, self._times, strict=True)
        ):
            self._times, self._cuts = times, []
            parameters, starts = runs.parameters, runs.starts
            for t in times:
                self._cuts.append(_cut(parameters, starts, t))
                _, _, parameters, starts = self._cuts[-1]
        vertices = runs.vertices
        for cut, (_, inner) in zip(self._cuts, parts, strict=True):
            vertices = np.concatenate([vertices[: cut.first], inner, vertices[cut.after :]])
        if not self._cuts:
            return runs
        last = self._cuts[-1]
        return Runs(vertices, last.parameters, last.starts, runs.deviation)


def _cut(
    parameters: NDArray[np.float64], starts: NDArray[np.intp], t: NDArray[np.float64]
) -> _Cut:
    first = int(np.searchsorted(parameters, t[0], "left"))
    after = int(np.searchsorted(parameters, t[-1], "right"))
    more = len(t) - (after - first)
    before, behind = starts[starts < first], starts[starts > after] + more
    # A run that a chord leads out of goes on in the new vertices, and those in the next run.
    own = np.array([first] if first in starts else [], dtype=np.intp)
    next_run = np.array([after + more] if after in starts else [], dtype=np.intp)
    return _Cut(
        first,
        after,
        np.concatenate([parameters[:first], t, parameters[after:]]),
        np.concatenate([before, own, next_run, behind]),
    )
