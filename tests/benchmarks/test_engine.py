"""Evaluation, dragging and tables, as ratios within one run.

Run with ``python3 tests tests/benchmarks``; the table comes at the end.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import count

import numpy as np
import pytest
from comparison import Comparison
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from core.basis import BasicLimitFunction
from core.ends import extended
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.live import LiveCurve
from core.mask import Mask
from core.refine import subdivide

SIZES = [(20, 6), (200, 6), (2000, 6), (100_000, 5), (1_000_000, 3)]
COPIES = {(200, 6): "6", (100_000, 5): "1.5", (1_000_000, 3): "4"}
LENGTHS = [20, 200, 2000, 20_000, 200_000, 1_000_000]


def polygon(number: int) -> NDArray[np.float64]:
    return np.random.default_rng(1).normal(size=(number, 2))


def cascade(points: NDArray[np.float64], mask: Mask, levels: int) -> NDArray[np.float64]:
    """Level by level, each rule one numpy.convolve; the ends grow short as they may."""
    rules = [np.array(mask.stencil(parity).weights, dtype=float)[::-1] for parity in (0, 1)]
    size = max(len(rule) for rule in rules)
    rules = [np.pad(rule, (0, size - len(rule))) for rule in rules]
    fine = extended(points, mask, closed=True).T
    for _ in range(levels):
        finer = np.empty((2, 2 * (fine.shape[1] - size + 1)))
        for row, into in zip(fine, finer, strict=True):
            for parity, rule in enumerate(rules):
                into[parity::2] = np.convolve(row, rule, "valid")
        fine = finer
    return fine


@pytest.mark.parametrize("name", ["Calm", "Tight"])
@pytest.mark.parametrize(("number", "level"), SIZES)
def test_evaluation(comparison: Comparison, name: str, number: int, level: int) -> None:
    """One point of output in nanoseconds, and in copies of the output."""
    curve = LimitCurve(polygon(number), PRESETS[name].mask, True)
    output = curve.points(level).T.copy()
    found = comparison.seconds({"curve": lambda: curve.points(level), "copy": output.copy})
    copies = found["curve"] / found["copy"]
    each = found["curve"] / output.shape[1] * 1e9
    comparison.row(
        f"points of {name}, n = {number:,}, level {level}",
        f"{copies:.1f} copies, {each:.2f} ns a point",
        COPIES.get((number, level), ""),
    )


def test_evaluation_against_other_ways(comparison: Comparison) -> None:
    number, level = 200, 6
    points, mask = polygon(number), PRESETS["Calm"].mask
    curve = LimitCurve(points, mask, True)
    t = curve.parameters(level)
    splines = {
        degree: BSpline(
            np.arange(number + 2 * degree + 1.0) - degree,
            np.resize(points, (number + degree, 2)),
            degree,
        )
        for degree in (3, 12)
    }
    found = comparison.seconds(
        {
            "curve": lambda: curve.points(level),
            "numpy.convolve, level by level": lambda: cascade(points, mask, level),
            "weights one by one, level by level": lambda: subdivide(points, mask, True, level),
            "scipy BSpline, degree 3": lambda: splines[3](t),
            "scipy BSpline, degree 12": lambda: splines[12](t),
        }
    )
    budgets = {"numpy.convolve, level by level": "8", "scipy BSpline, degree 12": "100"}
    for way in list(found)[1:]:
        comparison.row(
            f"against {way}, n = {number}, level {level}",
            f"{found[way] / found['curve']:.0f} times faster",
            budgets.get(way, ""),
        )
    np.testing.assert_allclose(cascade(points, mask, 0).shape[1], number, atol=20)


def test_moving_one_point(comparison: Comparison) -> None:
    """Write the point, name the spans, evaluate them at 16 points a span."""

    def dragged(live: LiveCurve, index: int) -> None:
        for spans in live.move(index, (0.5, 0.25)):
            live.span_points(slice(spans.start, spans.stop), 4)

    curves = {n: LiveCurve(polygon(n), PRESETS["Tight"].mask, True) for n in LENGTHS}
    found = comparison.seconds(
        {
            f"{n:,}": lambda live=live: dragged(live, len(live.control_points) // 2)
            for n, live in curves.items()
        }
    )
    for n, seconds in found.items():
        comparison.row(f"curve update, one point of {n}", f"{seconds * 1e6:.1f} us", "15 us")
    ratio = found["1,000,000"] / found["200"]
    comparison.row("curve update, t(1,000,000) / t(200)", f"{ratio:.2f}", "2")


@pytest.mark.parametrize("name", ["Tight", "Lean"])
def test_moving_the_end_of_an_open_curve(comparison: Comparison, name: str) -> None:
    live = LiveCurve(polygon(1_000_000), PRESETS[name].mask, False)
    found = comparison.seconds({"end": lambda: live.move(0, (0.5, 0.25))})
    comparison.row(f"move the end of an open curve, {name}", f"{found['end'] * 1e6:.1f} us")


def test_tables_while_parameters_move(comparison: Comparison) -> None:
    numbers = count(1)
    calm = PRESETS["Calm"]

    def tables() -> None:
        shift = Fraction(next(numbers), 10**7)
        basis = BasicLimitFunction(Parameters(calm.alpha, calm.beta + shift, calm.gamma).mask)
        basis.table(6)

    found = comparison.seconds({"new": tables})
    comparison.row("mask and tables of a new member", f"{found['new'] * 1e3:.2f} ms", "1 ms")
