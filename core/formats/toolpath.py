"""The ways of a tool along closed curves: their polylines, offset by the tool's radius."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from core.document import Curve
from core.errors import NinepointError
from core.flatten import Polyline, polyline
from core.formats.boxes import Shape
from core.formats.kerf import Offset, offset
from core.limit import LimitCurve

_SHARE: Final = 1 / 2
"""Share of the tolerance for the polylines, of which the offset is made."""

_NAMED: Final = 3
"""Curves that a note names; others are counted."""


def toolpaths(
    curves: Sequence[Curve], limits: Sequence[LimitCurve], kerf_mm: float, tolerance: float
) -> tuple[list[tuple[Curve, Shape]], list[str]]:
    """Offset curves by the radius of a tool.

    Parameters
    ----------
    curves
        The curves, each with two points at different places.
    limits
        Their limit curves.
    kerf_mm
        The offset, not 0: > 0 to the outside of what the curves enclose together (even-odd), < 0 to
        its inside.
    tolerance
        Largest deviation, in mm, in the sense of `core.formats.kerf`.

    Returns
    -------
    paths
        Closed polylines, each with the curve that it follows, or follows most. Their deviation is
        from the exact offset of the curves.
    notes
        Sentences on what became of the curves, and where the tool does not fit.

    Raises
    ------
    NinepointError
        If a curve is open, or `core.formats.kerf.offset` or `core.flatten.polyline` refuses.
    """
    for curve, limit in zip(curves, limits, strict=True):
        if not limit.closed:
            raise NinepointError(
                f"{curve.name!r} is open, and a kerf needs closed curves, which have an inside."
                " Close it, or set the kerf to 0."
            )
    lines = [polyline(limit, _SHARE * tolerance) for limit in limits]
    deviation = max(line.deviation for line in lines)
    found = offset([line.points for line in lines], kerf_mm, tolerance - deviation)
    paths: list[tuple[Curve, Shape]] = [
        (curves[ring.sources[0]], Polyline(ring.points, True, deviation + found.deviation))
        for ring in found.rings
    ]
    return paths, _notes([curve.name for curve in curves], found)


def _notes(names: list[str], found: Offset) -> list[str]:
    notes = []
    if found.gone:
        verb = "is" if len(found.gone) == 1 else "are"
        gone = _listed([names[index] for index in found.gone])
        notes.append(f"{gone} {verb} gone: the tool does not fit.")
    for first, second in found.crossing[:_NAMED]:
        notes.append(
            f"{names[first]!r} and {names[second]!r} cross: what both enclose is not part of the"
            " piece."
        )
    if len(found.crossing) > _NAMED:
        notes.append(f"{len(found.crossing) - _NAMED:,} more pairs of curves cross.")
    joined = [ring.sources for ring in found.rings if len(ring.sources) > 1]
    for sources in [sources for sources in joined if not _cross(sources, found)][:_NAMED]:
        whole = _listed([names[index] for index in sorted(sources)])
        notes.append(f"{whole} become one contour: the tool does not fit between them.")
    if count := len(found.rounded):
        places = "1 place" if count == 1 else f"{count:,} places"
        x, y = found.rounded[0].tolist()
        such = "" if count == 1 else "one of them "
        notes.append(
            f"The tool does not fit into {places}, {such}near ({x:.4g}, {y:.4g}) mm: a corner is"
            " rounded there, or a slot stays closed."
        )
    return notes


def _cross(sources: tuple[int, ...], found: Offset) -> bool:
    """Whether some of these polygons cross, which is told already."""
    return any(a in sources and b in sources for a, b in found.crossing)


def _listed(names: list[str]) -> str:
    """Names in a sentence, the first few of them."""
    words = [repr(name) for name in names[:_NAMED]]
    if len(names) > _NAMED:
        words.append(f"{len(names) - _NAMED:,} more")
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
