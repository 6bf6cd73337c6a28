"""Degrees generated and reproduced."""

import numpy as np
import pytest
from hypothesis import given

from core.family import PRESETS
from core.limit import LimitCurve
from core.reproduction import generation_degree, reproduction_degree
from oracles import members, reproduces
from reference import ROWS


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_degrees(row):
    assert reproduction_degree(row.parameters.mask) == row.reproduction
    assert generation_degree(row.parameters.mask) == row.multiplicity - 1


@given(members())
def test_the_degree_reproduced_is_the_largest_that_is(parameters):
    degree = reproduction_degree(parameters.mask)
    assert reproduces(parameters.mask, degree)
    assert not reproduces(parameters.mask, degree + 1)
    assert degree <= generation_degree(parameters.mask)


def test_the_bspline_generates_what_it_does_not_reproduce():
    """Its limit of quadratic data is a quadratic, with the same leading coefficient, shifted up."""
    t = np.arange(40.0)
    curve = LimitCurve(np.column_stack([t, t**2]), PRESETS["B-spline"].mask, False)
    inside = slice(8 * 8, -8 * 8)
    rest = curve.points(3)[inside, 1] - curve.parameters(3)[inside] ** 2
    np.testing.assert_allclose(rest, rest[0], atol=1e-9)
    assert rest[0] > 1
