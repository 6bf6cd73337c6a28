"""Ratios within one run: candidates take turns, so that noise meets all of them alike."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from statistics import median
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest

Rows = list[tuple[str, str, str]]
ROWS = pytest.StashKey[Rows]()

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


@pytest.fixture
def comparison(request: pytest.FixtureRequest) -> Comparison:
    return Comparison(request.config.stash.setdefault(ROWS, []))


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    rows = config.stash.get(ROWS, [])
    if not rows:
        return
    terminalreporter.section("speed, one core")
    wide = [max(len(row[k]) for row in [*rows, ("", "", "budget")]) for k in range(3)]
    for quantity, value, budget in [("", "", "budget"), *rows]:
        terminalreporter.write_line(
            f"{quantity:<{wide[0]}}  {value:>{wide[1]}}  {budget:>{wide[2]}}"
        )
    kernel = os.environ.get("OPENBLAS_CORETYPE", "the processor's own")
    terminalreporter.write_line(f"NumPy {np.__version__}, OpenBLAS kernels: {kernel}")
