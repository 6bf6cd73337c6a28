"""What a slider move asks of the mathematics, and the exact report.

Run with ``python3 tests tests/benchmarks``. Each round takes another member, so that no cache
answers; the figures are for one core.
"""

from fractions import Fraction
from itertools import count

import numpy as np
import pytest

from core.atlas import Plane, Quantity, parameter_map
from core.basis import BasicLimitFunction
from core.continuity import smoothness
from core.family import PRESETS, Parameters
from core.gibbs import step_gibbs
from core.report import report

numbers = count(1)


def neighbour(parameters):
    """A member so near that it behaves alike, and different in each call."""
    shift = Fraction(next(numbers), 10**7)
    return Parameters(
        parameters.alpha, parameters.beta + shift, parameters.gamma, parameters.neighbours
    )


@pytest.mark.parametrize("name", PRESETS)
def test_slider_move(benchmark, name):
    """Mask, tables, class, Hölder interval and Gibbs intervals: all that a slider move needs."""

    def analysed(parameters):
        mask = parameters.mask
        BasicLimitFunction(mask).table(6)
        return smoothness(mask), step_gibbs(mask)

    found, _ = benchmark.pedantic(
        analysed, setup=lambda: ((neighbour(PRESETS[name]),), {}), rounds=40, warmup_rounds=3
    )
    assert found.exponent.width <= 0.05


@pytest.mark.parametrize("name", PRESETS)
def test_exact_report(benchmark, name):
    found = benchmark.pedantic(
        report, setup=lambda: ((neighbour(PRESETS[name]),), {}), rounds=5, warmup_rounds=1
    )
    assert found.smoothness.order is not None


def test_class_map_of_101_by_101(benchmark):
    def whole():
        blocks = parameter_map(Plane.symmetric(), Quantity.CLASS, 101)
        return np.concatenate([values for _, values in blocks])

    assert benchmark.pedantic(whole, rounds=3, warmup_rounds=1).shape == (101, 101)
