"""From the start of the process to the first paint, against an empty window.

Run with ``python3 tests tests/benchmarks``; the table comes at the end. Each start is a process of
its own; those of the two windows alternate.
"""

from __future__ import annotations

from statistics import median

from comparison import Comparison, Starts

WINDOWS = ("bare", "ninepoint")
ROUNDS = 15


def test_first_paint(comparison: Comparison, starts: Starts) -> None:
    candidates = {what: lambda what=what: starts(what, "painted").seconds for what in WINDOWS}
    comparison.medians(candidates, 1)  # compiles the modules
    found = comparison.rounds(candidates, ROUNDS)
    bare, ours = (median(times[what] for times in found) for what in WINDOWS)
    ratio = median(times["ninepoint"] / times["bare"] for times in found)
    comparison.row("first paint of an empty QWidget", f"{bare * 1e3:.0f} ms")
    comparison.row("first paint of Ninepoint", f"{ours * 1e3:.0f} ms")
    comparison.row("first paint, in empty windows", f"{ratio:.2f}", "2.2")
