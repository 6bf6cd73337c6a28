"""Height, depth and lobes of the basic limit function."""

import numpy as np
import pytest
from hypothesis import given

from core.basis import BasicLimitFunction
from core.cells import WIDTH
from core.family import PRESETS
from core.profile import profile
from oracles import bspline_value, convergent_members


@given(convergent_members(["translated"]))
def test_samples_lie_between_depth_and_height(parameters):
    found = profile(parameters.mask)
    values = BasicLimitFunction(parameters.mask).values(6)
    assert values.max() <= found.height.upper
    assert -values.min() <= found.depth.upper + 1e-12
    assert found.height.upper - found.height.lower <= WIDTH
    # A sample of level 6 is at most a chord error of some 1e-3 away.
    assert found.height.lower <= values.max() + 1e-2
    assert found.integral == 1


@given(convergent_members(["translated"]))
def test_phi_is_negative_inside_its_lobes_and_nowhere_else(parameters):
    phi = BasicLimitFunction(parameters.mask)
    t, values = phi.parameters(5), phi.values(5)
    inside = np.zeros(len(t), dtype=bool)
    for left, right in profile(parameters.mask).negative_lobes:
        assert left < right
        inside |= (left < t) & (t < right)
    assert (values[inside] < 0).all()
    assert (values[~inside] > -1e-11).all()


def test_the_bspline_is_a_hill_without_lobes():
    found = profile(PRESETS["B-spline"].mask)
    assert found.negative_lobes == ()
    assert found.depth.upper == 0
    assert found.height.lower == pytest.approx(float(bspline_value(12, 13 / 2)), abs=2 * WIDTH)


def test_lagrange_has_lobes_on_both_sides_of_its_hill():
    lobes = profile(PRESETS["Lagrange"].mask).negative_lobes
    assert len(lobes) >= 2
    # The sampled signs are symmetric about t = 0.
    for (a, b), (c, d) in zip(lobes, lobes[::-1], strict=True):
        assert (a, b) == pytest.approx((-d, -c))
