"""From curve to file: polylines, arcs and cubics of large and small curves, with their proof.

Run with ``python3 tests tests/benchmarks``. The polyline uses all cores, the others one.
"""

from __future__ import annotations

import numpy as np
import pytest
from comparison import Comparison
from pytest_benchmark.fixture import BenchmarkFixture

from core import LimitCurve
from core.arcs import arcs
from core.beziers import beziers
from core.family import PRESETS
from core.flatten import polyline

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


def coast(count: int) -> LimitCurve:
    """A closed curve with a rough edge: control points some 6 mm apart, each moved by 2 mm."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = count * (1 + 0.1 * np.sin(9 * angle))
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    points += np.random.default_rng(0).normal(size=points.shape) * 2
    return LimitCurve(points, PRESETS["Calm"].mask, True)


def test_polyline_of_a_million_vertices(comparison: Comparison) -> None:
    curve = coast(100_000)
    found = polyline(curve, 0.0031)
    assert len(found.points) > 1_000_000
    assert found.deviation <= 0.0031
    other = found.points.copy()
    times = comparison.seconds(
        {"polyline": lambda: polyline(curve, 0.0031), "copy": other.copy}
    )
    seconds = times["polyline"] * 1e6 / len(found.points)
    comparison.row("polyline of a million vertices, proven", f"{seconds:.2f} s", "0.3 s")
    copies = times["polyline"] / times["copy"]
    comparison.row("the same, in memory copies of its vertices", f"{copies:.0f} copies")


@pytest.mark.parametrize(
    ("name", "budget"), [("Calm", "185, 63, 24"), ("Tight", "172, 52, 17")]
)
def test_how_few_are_needed(comparison: Comparison, name: str, budget: str) -> None:
    """The budget is nine tenths of what cutting uniformly in t takes."""
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    flat, bent, cubics = polyline(curve, 0.01), arcs(curve, 0.01), beziers(curve, 0.01)
    counts = f"{len(flat.points)}, {len(bent.points)}, {len(cubics.controls)}"
    comparison.row(f"vertices, arcs, cubics of a shape at 0.01 mm, {name}", counts, budget)


def test_arcs_of_a_long_curve(benchmark: BenchmarkFixture) -> None:
    found = benchmark.pedantic(arcs, (coast(20_000), 0.01), rounds=2, warmup_rounds=1)
    assert len(found.points) > 60_000


def test_cubics_of_a_long_curve(benchmark: BenchmarkFixture) -> None:
    found = benchmark.pedantic(beziers, (coast(10_000), 0.01), rounds=2, warmup_rounds=1)
    assert len(found.controls) > 7_500


@pytest.mark.parametrize("kind", [polyline, arcs, beziers])
def test_small_drawing(benchmark: BenchmarkFixture, kind) -> None:
    curve = LimitCurve(SHAPE, PRESETS["Calm"].mask, True)
    assert benchmark(kind, curve, 0.01).deviation <= 0.01
