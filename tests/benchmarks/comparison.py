"""Ways to do one thing, compared within one run: they take turns, so noise meets all alike."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import timeit
from collections.abc import Callable, Mapping
from pathlib import Path
from statistics import median
from time import perf_counter, sleep, time
from typing import NamedTuple


class Row(NamedTuple):
    """A line of the table: what is measured, its figure, its budget, and the machine's pace."""

    quantity: str
    value: str
    budget: str
    pace: float


Rows = list[Row]

SECONDS = 0.5
"""Time that a comparison takes, about, unless its candidates are slow."""

TURN = 1e-3
"""Time that a candidate takes in a round, at least, by being repeated."""

FEWEST_ROUNDS = 5

BLOCKS = 20
"""Parts of a comparison at whose starts and ends the machine's pace is looked at."""

TRIES = 4
"""Times as many rounds as are wanted that are run at most to find calm ones."""

PATIENCE = 240.0
"""Seconds that a run waits, at most and in all, for the machine to be as fast as it can be."""

CALM = 1.15
"""Share of the fastest pace up to which the machine is as fast as it can be."""

UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}

MIB = 2**20

_LOOP = """
held = {}
for i in range(3000):
    held[i % 97] = str(i)
"""

_AMOUNT = re.compile(r"(?<![\w.])(\d[\d,.]*)\s*(times faster|\w*)")


class Comparison:
    """Times of several ways to do a thing, and the table at the end of the run."""

    def __init__(self, rows: Rows, machine: Machine) -> None:
        self._rows, self._machine = rows, machine

    def seconds(self, candidates: Mapping[str, Callable[[], object]]) -> dict[str, float]:
        """Median time of each candidate, in seconds; each is warmed up by one call."""
        once = {}
        for name, run in candidates.items():
            run()
            start = perf_counter()
            run()
            once[name] = perf_counter() - start
        # Short ones are repeated within a round: a clock has its grain, and the first call finds
        # caches that others have filled, which takes it three times as long.
        repeats = {name: max(1, round(TURN / max(time, 1e-7))) for name, time in once.items()}
        turn = sum(once[name] * repeats[name] for name in candidates)

        def timed(name: str, run: Callable[[], object]) -> float:
            start = perf_counter()
            for _ in range(repeats[name]):
                run()
            return (perf_counter() - start) / repeats[name]

        rounds = max(FEWEST_ROUNDS, round(SECONDS / turn))
        return self.medians(
            {name: lambda name=name, run=run: timed(name, run) for name, run in candidates.items()},
            rounds,
        )

    def medians(
        self, candidates: Mapping[str, Callable[[], float]], rounds: int
    ) -> dict[str, float]:
        """Median of what each candidate returns, over some `rounds`."""
        kept = self.rounds(candidates, rounds)
        return {name: median(found[name] for found in kept) for name in candidates}

    def rounds(
        self, candidates: Mapping[str, Callable[[], float]], rounds: int
    ) -> list[dict[str, float]]:
        """What each candidate returns, round by round.

        Rounds in which the machine was slow are repeated, up to `TRIES` times as many in all; if
        it never was as fast as it can be, all rounds count. Those of one round come one after the
        other: their quotient says more than that of two medians, where the pace changes.
        """
        calm: list[dict[str, float]] = []
        slow: list[dict[str, float]] = []
        blocks = min(rounds, BLOCKS)
        size = -(-rounds // blocks)
        for _ in range(TRIES * blocks):
            was_calm = self._machine.is_calm()
            found = [{name: run() for name, run in candidates.items()} for _ in range(size)]
            (calm if was_calm and self._machine.is_calm() else slow).extend(found)
            if len(calm) >= rounds:
                break
        return calm if len(calm) >= min(rounds, FEWEST_ROUNDS) else calm + slow

    def row(self, quantity: str, value: str, budget: str = "") -> None:
        """Put a line into the table."""
        self._rows.append(Row(quantity, value, budget, self._machine.pace()))


class Machine:
    """How fast the machine is just now: virtual ones run at times at half of their speed.

    A figure in milliseconds says nothing then, so that whoever measures waits for better times.

    Attributes
    ----------
    fastest
        Seconds that a loop took at best that is always the same.
    """

    def __init__(self) -> None:
        self.fastest = float("inf")
        self._patience = PATIENCE

    def pace(self) -> float:
        """Seconds that the loop takes now."""
        now = min(timeit.repeat(_LOOP, number=1, repeat=5))
        self.fastest = min(self.fastest, now)
        return now

    def is_calm(self) -> bool:
        """Whether the machine is as fast as it was at any time, about."""
        return self.pace() <= CALM * self.fastest

    def settle(self) -> None:
        """Wait until the machine is as fast as it was, as long as the run's patience lasts."""
        begin = perf_counter()
        while not self.is_calm() and self._patience > 0:
            sleep(0.2)
            self._patience -= perf_counter() - begin
            begin = perf_counter()


class Start(NamedTuple):
    """A window that was opened: seconds until then, and resident MB, then and at their most."""

    seconds: float
    memory: float
    peak: float


class Starts:
    """Opens windows in processes of their own; see `started`.

    Parameters
    ----------
    folder
        For settings and compiled modules. Those of the user shall neither help nor suffer, and
        whether modules are compiled already shall not depend on what ran before.
    """

    def __init__(self, folder: Path) -> None:
        self._environment = {
            **os.environ,
            "NINEPOINT_SETTINGS": str(folder),
            "PYTHONPYCACHEPREFIX": str(folder / "compiled"),
        }
        self._environment.pop("PYTHONDONTWRITEBYTECODE", None)

    def __call__(self, *words: str) -> Start:
        """Open a window, with the words that `started` takes."""
        command = [sys.executable, str(Path(__file__).with_name("started.py")), *words]
        begin = time()
        done = subprocess.run(
            command, env=self._environment, stdout=subprocess.PIPE, text=True, check=True
        )
        painted, memory, peak = map(float, done.stdout.split())
        return Start(painted - begin, memory / MIB, peak / MIB)


def share(value: str, budget: str) -> float | None:
    """How much of its budget a figure takes: it holds up to 1. None without a budget.

    Both are lists with commas between; the worst counts. "640 vertices, 0.4 ms" takes 0.8 of
    "2,000, 0.5 ms", and "16 times faster" takes 0.5 of "8".
    """
    shares = []
    for figure, limit in zip(value.split(", "), budget.split(", "), strict=False):
        found, allowed = _AMOUNT.search(figure), _AMOUNT.search(limit)
        if found and allowed:
            size, most = (
                float(amount[1].rstrip(".,").replace(",", "")) * UNITS.get(amount[2], 1.0)
                for amount in (found, allowed)
            )
            shares.append(most / size if found[2] == "times faster" else size / most)
    return max(shares, default=None)


def table(rows: Rows) -> list[str]:
    """Lines of the table; a figure beyond its budget has an exclamation mark.

    The last column is the pace: 1.0 where the machine was as fast as it ever was in this run.
    """
    cells = [("what", "figure", "budget", "share of it", "pace")]
    fastest = min(row.pace for row in rows)
    for quantity, value, budget, seconds in rows:
        part = share(value, budget)
        mark = "" if part is None else f"{part:.2f} {'!' if part > 1 else ' '}"
        cells.append((quantity, value, budget, mark, f"{fastest / seconds:.1f}"))
    wide = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = [
        "  ".join([line[0].ljust(wide[0]), *map(str.rjust, line[1:], wide[1:])]) for line in cells
    ]
    return [lines[0], "-" * max(map(len, lines)), *lines[1:]]
