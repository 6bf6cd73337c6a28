"""Loose lines, arcs and open polylines whose ends meet, joined into contours.

Many programs write a contour as hundreds of single lines. Ends within a tolerance of each other
are one node; where exactly two ends meet in a node they are joined, so where three or more meet
the contours stay apart, and nothing is guessed. A gap is closed by moving the later end to the
earlier one, which moves no point of the curve further than the gap; the deviation says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.formats.outlines import moved_end, reverse
from core.formats.sketch import Trace

GAP_SHARE: Final = 1e-5
"""Widest gap between ends that meet, as a share of the larger side of the drawing."""

GAP_MM: Final = 0.01
"""Widest such gap at all: the default tolerance of an export."""

_LEAST_LOOP: Final = 3


def joined(traces: Sequence[Trace]) -> tuple[Trace, ...]:
    """Traces with open ones of a layer joined where their ends meet.

    A joined trace stands where one of its parts stood and has the direction of the first one.
    Fewer than three pieces are never made a loop: two of them are one line drawn twice.
    """
    loose = [index for index, trace in enumerate(traces) if not trace.closed]
    if not loose:
        return tuple(traces)
    # End 2 i is the start of the i-th loose trace, end 2 i + 1 its end.
    ends = np.array([traces[i].controls[[0, -1], [0, 3]] for i in loose]).reshape(-1, 2)
    low = np.min([trace.controls.min(axis=(0, 1)) for trace in traces], axis=0)
    high = np.max([trace.controls.max(axis=(0, 1)) for trace in traces], axis=0)
    gap = min(GAP_SHARE * float((high - low).max()), GAP_MM)
    partners = _partners(ends, [traces[i].layer for i in loose], gap)
    chains = _chains(partners)
    made: dict[int, Trace] = {}
    for chain in chains:
        members = [(loose[end >> 1], bool(end & 1)) for end in chain]
        parts = [traces[i] for i, _ in members]
        is_loop = partners[chain[-1] ^ 1] == chain[0]
        if is_loop and sum(len(part.controls) for part in parts) < _LEAST_LOOP:
            made.update({i: traces[i] for i, _ in members})
        elif len(members) > 1 or is_loop:
            made[members[0][0]] = _linked(parts, [flip for _, flip in members], is_loop)
        else:
            made[members[0][0]] = parts[0]
    kept = []
    for index, trace in enumerate(traces):
        if trace.closed:
            kept.append(trace)
        elif index in made:
            kept.append(made[index])
    return tuple(kept)


def _partners(ends: NDArray[np.float64], layers: list[str], gap: float) -> list[int]:
    """For each end the one other end at its node, or -1."""
    size = max(gap, float(np.abs(ends).max()) * 1e-15, 1e-300)
    cells = np.floor(ends / size).tolist()
    nodes: list[list[int]] = []
    grid: dict[tuple[float, float, str], list[int]] = {}
    places = ends.tolist()
    for end, ((column, row), (x, y)) in enumerate(zip(cells, places, strict=True)):
        layer = layers[end >> 1]
        found = -1
        for near in (
            (column + i, row + j, layer) for i in (0.0, -1.0, 1.0) for j in (0.0, -1.0, 1.0)
        ):
            for node in grid.get(near, ()):
                p, q = places[nodes[node][0]]
                if abs(p - x) <= gap and abs(q - y) <= gap:
                    found = node
                    break
            if found >= 0:
                break
        if found < 0:
            found = len(nodes)
            nodes.append([])
            grid.setdefault((column, row, layer), []).append(found)
        nodes[found].append(end)
    partners = [-1] * len(places)
    for members in nodes:
        if len(members) == 2:
            one, other = members
            partners[one], partners[other] = other, one
    return partners


def _chains(partners: list[int]) -> list[list[int]]:
    """Chains as the ends that their members are entered by, odd where one runs backwards.

    First the open ones, from their free ends, then the loops.
    """
    done = [False] * (len(partners) // 2)
    chains = []
    for only_free in (True, False):
        for start, partner in enumerate(partners):
            if done[start >> 1] or (only_free and partner >= 0):
                continue
            chain = []
            end = start
            while end >= 0 and not done[end >> 1]:
                done[end >> 1] = True
                chain.append(end)
                end = partners[end ^ 1]
            # In the direction that the member which comes first in the file has.
            first = min(chain, key=lambda entered: entered >> 1)
            if first & 1:
                chain = [entered ^ 1 for entered in reversed(chain)]
                first ^= 1
            if not only_free:
                place = chain.index(first)
                chain = chain[place:] + chain[:place]
            chains.append(chain)
    return chains


def _linked(parts: list[Trace], flipped: list[bool], is_loop: bool) -> Trace:
    """Parts one behind the other."""
    blocks = [
        reverse(part.controls) if flip else part.controls
        for part, flip in zip(parts, flipped, strict=True)
    ]
    counts = np.cumsum([len(block) for block in blocks])
    controls = np.concatenate(blocks)
    widest = 0.0
    for place in counts[:-1].tolist():
        widest = max(widest, _close_gap(controls, place - 1, place))
    if is_loop:
        widest = max(widest, _close_gap(controls, len(controls) - 1, 0))
    first = min(parts, key=lambda part: not part.name)
    deviation = max(part.deviation for part in parts) + 2 * widest
    return replace(
        parts[0], controls=controls, closed=is_loop, name=first.name, deviation=deviation
    )


def _close_gap(controls: NDArray[np.float64], before: int, after: int) -> float:
    """Move the end of a cubic to the start of another one, in place; the width of the gap."""
    target = controls[after, 0].copy()
    gap = target - controls[before, 3]
    controls[before] = moved_end(controls[before], gap)
    controls[before, 3] = target
    return float(np.hypot(*gap))
