"""The table of what was measured, at the end of the run."""

from __future__ import annotations

import os

import numpy as np
import pytest
from comparison import Comparison, Rows

ROWS = pytest.StashKey[Rows]()


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
