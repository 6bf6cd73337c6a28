"""Subdivision by the definition, against exact fractions and against the limit."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.family import PRESETS
from core.refine import refine, subdivide
from oracles import convergent_members, refined, refined_closed

SIZES = st.integers(3, 12)
SEEDS = st.integers(0, 10**6)


def polygon(seed, n):
    return np.random.default_rng(seed).integers(-50, 50, size=(n, 2)).astype(float)


@given(convergent_members(), SIZES, SEEDS)
def test_a_closed_refinement_follows_the_definition(parameters, n, seed):
    points = polygon(seed, n)
    column = [Fraction(int(x)) for x in points[:, 0]]
    new = refine(points, parameters.mask, closed=True)
    exact = refined_closed(column, parameters.mask)
    np.testing.assert_allclose(new[:, 0], [float(x) for x in exact], atol=1e-12)


@given(convergent_members(), SIZES, SEEDS, st.integers(1, 3))
def test_an_open_subdivision_refines_the_polygon_with_its_odd_reflections(
    parameters, n, seed, levels
):
    if not parameters.mask.is_symmetric:
        parameters = PRESETS["Tight"]
    points = polygon(seed, n)
    wide = np.pad(points, ((20, 20), (0, 0)), mode="reflect", reflect_type="odd")
    data = {j - 20: Fraction(int(x)) for j, x in enumerate(wide[:, 0])}
    for _ in range(levels):
        data = refined(data, parameters.mask)
    inside = [
        float(data[m])
        for m in sorted(data)
        if 0 < Fraction(2 * m + 1, 2 ** (levels + 1)) - Fraction(1, 2) < n - 1
    ]
    new = subdivide(points, parameters.mask, False, levels)
    assert new.shape == ((n - 1) * 2**levels + 2, 2)
    np.testing.assert_allclose(new[1:-1, 0], inside, atol=1e-10)
    np.testing.assert_array_equal(new[[0, -1]], points[[0, -1]])


@given(SIZES, SEEDS)
def test_refining_twice_is_subdividing_by_two_levels_when_closed(n, seed):
    mask = PRESETS["Lean"].mask
    points = polygon(seed, n)
    twice = refine(refine(points, mask, True), mask, True)
    np.testing.assert_allclose(subdivide(points, mask, True, 2), twice, atol=1e-12)


@given(SIZES, SEEDS)
def test_eliminating_the_phantom_points_gives_the_same_end_rules_at_every_level(n, seed):
    """Theory, section 7: refined polygons of symmetric members are odd about their ends again."""
    mask = PRESETS["Calm"].mask
    points = polygon(seed, n)
    wide = np.pad(points, ((20, 20), (0, 0)), mode="reflect", reflect_type="odd")
    data = {j - 20: Fraction(int(x)) for j, x in enumerate(wide[:, 0])}
    new = refined(data, mask)
    for m in range(1, 12):
        # P_m lies at (2m - 1)/4; its mirror image about t = 0 is P_{1-m}.
        assert new[m] + new[1 - m] == 2 * data[0]


@given(convergent_members(), SIZES, SEEDS, st.integers(1, 11))
def test_shifting_the_start_of_a_closed_polygon_only_shifts_the_result(parameters, n, seed, shift):
    points = polygon(seed, n)
    new = refine(points, parameters.mask, True)
    shifted = refine(np.roll(points, -shift, axis=0), parameters.mask, True)
    np.testing.assert_allclose(shifted, np.roll(new, -2 * shift, axis=0), atol=1e-12)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("n", [0, 1])
def test_fewer_than_two_points_stay_as_they_are(n, closed):
    points = np.full((n, 2), 7.0)
    new = subdivide(points, PRESETS["Calm"].mask, closed, 3)
    np.testing.assert_allclose(new, 7.0, rtol=1e-13)
    assert len(new) == (8 * n if closed else n)


def test_level_zero_is_the_polygon_itself():
    points = polygon(1, 5)
    np.testing.assert_array_equal(subdivide(points, PRESETS["Calm"].mask, True, 0), points)
