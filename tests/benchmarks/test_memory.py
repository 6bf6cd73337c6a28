"""Resident memory of the program: with its ready shape, and with a million control points.

Run with ``python3 tests tests/benchmarks``; the table comes at the end. Each figure is that of a
process of its own.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from comparison import Comparison, Starts

from core.document import Curve, Document
from core.store import save

COUNT = 1_000_000
ROUNDS = 3


def test_idle(comparison: Comparison, starts: Starts) -> None:
    found = comparison.medians(
        {
            "of an empty QWidget": lambda: starts("bare", "painted").memory,
            "after the first paint": lambda: starts("ninepoint", "painted").memory,
            "idle": lambda: starts("ninepoint", "settled").memory,
        },
        ROUNDS,
    )
    for what, megabytes in found.items():
        budget = "120 MB" if what == "idle" else ""
        comparison.row(f"resident memory, {what}", f"{megabytes:.0f} MB", budget)


def test_a_million_points(comparison: Comparison, starts: Starts, tmp_path: Path) -> None:
    angle = np.linspace(0, 2 * np.pi, COUNT, endpoint=False)
    radius = 100 + 10 * np.sin(9 * angle)
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    path = tmp_path / "flower.ninepoint"
    save(Document((Curve(points),)), path)
    opened = [starts("ninepoint", "settled", str(path)) for _ in range(ROUNDS)]
    memory, peak = (float(np.median([getattr(o, k) for o in opened])) for k in ("memory", "peak"))
    comparison.row(f"resident memory, {COUNT:,} points", f"{memory:.0f} MB", "350 MB")
    comparison.row(f"the same at its most, while reading {COUNT:,} points", f"{peak:.0f} MB")
