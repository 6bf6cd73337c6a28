"""The table of what was measured, at the end of the run."""

from __future__ import annotations

import os
import platform
from pathlib import Path

import numpy as np
import PySide6
import pytest
from comparison import Comparison, Machine, Rows, Starts, table

ROWS = pytest.StashKey[Rows]()


@pytest.fixture(scope="session")
def machine() -> Machine:
    return Machine()


@pytest.fixture(autouse=True)
def settled(machine: Machine) -> None:
    """No measurement begins while the machine is slow."""
    machine.settle()


@pytest.fixture
def comparison(request: pytest.FixtureRequest, machine: Machine) -> Comparison:
    return Comparison(request.config.stash.setdefault(ROWS, []), machine)


@pytest.fixture(scope="session")
def starts(tmp_path_factory: pytest.TempPathFactory) -> Starts:
    return Starts(tmp_path_factory.mktemp("starts"))


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    rows = config.stash.get(ROWS, [])
    if not rows:
        return
    terminalreporter.section("speed and memory")
    for line in table(rows):
        terminalreporter.write_line(line)
    kernel = os.environ.get("OPENBLAS_CORETYPE", "the processor's own")
    terminalreporter.write_line(
        f"{processor()}, {os.cpu_count()} cores, {platform.system()}; Python "
        f"{platform.python_version()}, Qt {PySide6.__version__}, NumPy {np.__version__} on one"
        f" core, OpenBLAS kernels: {kernel}; pace 1.0: {min(row.pace for row in rows) * 1e3:.2f} ms"
        " for 3,000 numbers turned into text"
    )


def processor() -> str:
    """Name of the processor, as far as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
