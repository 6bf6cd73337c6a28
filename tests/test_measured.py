"""Chords whose deviation is measured at samples."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chords import KINDS, bounds, deviation, polygon, some_places
from core.errors import NinepointError
from core.family import PRESETS
from core.limit import LimitCurve
from core.measured import Measuring
from core.shape import curvatures, tangents
from effort import costly
from oracles import convergent_members

SHAPE = [(10, 10), (60, -8), (110, 10), (118, 45), (80, 40), (60, 70), (40, 40), (2, 45)]


@costly
@given(
    convergent_members(),
    KINDS,
    st.integers(3, 40),
    st.integers(0, 10**6),
    st.booleans(),
    st.sampled_from([3.0, 0.3, 0.03]),
    st.booleans(),
)
def test_the_curve_keeps_within_the_bound_of_any_chord(
    parameters, kind, count, seed, closed, tolerance, every
):
    curve = LimitCurve(polygon(kind, seed, count), parameters.mask, closed)
    try:
        measuring = Measuring(curve, tolerance)
    except NinepointError:  # too rough
        return
    for part in measuring.parts():
        stretch = measuring.stretch(part)
        assert stretch.floor <= tolerance
        places = some_places(stretch, seed)
        found = bounds(stretch, places, 0.0 if every else tolerance)
        for chord, bound in zip(pairwise(places), found, strict=True):
            assert deviation(stretch, *chord) <= max(bound, stretch.floor)


@pytest.mark.parametrize("name", PRESETS)
def test_the_density_is_that_of_the_curvature(name):
    curve = LimitCurve(SHAPE, PRESETS[name].mask, True)
    measuring = Measuring(curve, 0.1)
    stretch = measuring.stretch(*measuring.parts())
    speed = np.hypot(*tangents(curve, 11).T)
    needed = np.sqrt(np.abs(curvatures(curve, 11)) / (8 * 0.1)) * speed / 2**11
    assert stretch.density().sums[-1] == pytest.approx(needed.sum(), rel=0.05)


def test_a_dot_asks_for_nothing():
    measuring = Measuring(LimitCurve([(5, 5)] * 7, PRESETS["Calm"].mask, True), 0.01)
    stretch = measuring.stretch(*measuring.parts())
    assert stretch.density().sums[-1] == 0
    places = stretch.fixed()
    assert len(places) == 2
    assert bounds(stretch, places) <= 1e-12
