"""Ways to do one thing, compared within one run: they take turns, so noise meets all alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from statistics import median
from time import perf_counter

Rows = list[tuple[str, str, str]]
"""Quantity, value and budget of each line of the table."""

SECONDS = 0.5
"""Time that a comparison takes, about, unless its candidates are slow."""

FEWEST_ROUNDS = 5


class Comparison:
    """Times of several ways to do a thing, and the table at the end of the run."""

    def __init__(self, rows: Rows) -> None:
        self._rows = rows

    def seconds(self, candidates: Mapping[str, Callable[[], object]]) -> dict[str, float]:
        """Median time of each candidate, in seconds; each is warmed up by one call."""
        once = {}
        for name, run in candidates.items():
            run()
            start = perf_counter()
            run()
            once[name] = perf_counter() - start
        # Short ones are repeated within a round, because a clock has its grain.
        repeats = {name: max(1, round(1e-4 / max(time, 1e-7))) for name, time in once.items()}
        turn = sum(once[name] * repeats[name] for name in candidates)
        times: dict[str, list[float]] = {name: [] for name in candidates}
        for _ in range(max(FEWEST_ROUNDS, round(SECONDS / turn))):
            for name, run in candidates.items():
                start = perf_counter()
                for _ in range(repeats[name]):
                    run()
                times[name].append((perf_counter() - start) / repeats[name])
        return {name: median(values) for name, values in times.items()}

    def row(self, quantity: str, value: str, budget: str = "") -> None:
        """Put a line into the table."""
        self._rows.append((quantity, value, budget))
