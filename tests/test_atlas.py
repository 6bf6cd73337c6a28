"""Parameter maps against the single members."""

from fractions import Fraction

import numpy as np
import pytest

from core.atlas import BLOCK_ROWS, Plane, Quantity, parameter_map, smoothest_beta
from core.continuity import certificate
from core.family import PRESETS, Parameters
from core.gibbs import StepResponse
from core.hoelder import quick_interval

PLANES = {
    "alpha = gamma": Plane.symmetric(),
    "alpha, beta": Plane.of_axes("alpha", "beta", Parameters(0, 0, "1/10")),
    "sum -1": Plane.of_sum(-1),
    "mirrored": Plane.of_axes("alpha", "gamma", Parameters(0, "-1/2", 0, "mirrored"), "1/4"),
}
SIZE = 21


def whole(plane, quantity, size=SIZE):
    return np.concatenate([values for _, values in parameter_map(plane, quantity, size)])


@pytest.mark.parametrize("name", PLANES)
def test_the_class_map_claims_no_more_than_the_certificate_and_rarely_less(name):
    plane = PLANES[name]
    us, vs = plane.places(SIZE)
    values = whole(plane, Quantity.CLASS)
    places = [(i, j) for i in range(0, SIZE, 2) for j in range(SIZE)]
    exact = [certificate(plane.member(us[j], vs[i]).mask).order for i, j in places]
    exact = np.array([-1 if order is None else order for order in exact])
    shown = np.array([values[i, j] for i, j in places])
    assert (shown <= exact).all()
    assert np.mean(shown == exact) >= 0.75


@pytest.mark.parametrize("name", PLANES)
def test_the_hoelder_map_is_a_lower_bound(name):
    plane = PLANES[name]
    us, vs = plane.places(SIZE)
    values = whole(plane, Quantity.HOELDER)
    for i in range(0, SIZE, 5):
        for j in range(0, SIZE, 5):
            assert values[i, j] <= quick_interval(plane.member(us[j], vs[i]).mask).upper + 1e-9


@pytest.mark.parametrize("name", PLANES)
def test_the_overshoot_map_is_that_of_the_step_response(name):
    plane = PLANES[name]
    us, vs = plane.places(SIZE)
    values = whole(plane, Quantity.OVERSHOOT)
    for i in range(0, SIZE, 5):
        for j in range(0, SIZE, 5):
            sampled = StepResponse(plane.member(us[j], vs[i]).mask).values(4).max() - 1
            assert values[i, j] == pytest.approx(max(sampled, 0), abs=1e-9)


def test_blocks_cover_all_rows_in_order_and_can_be_left():
    rows = [rows for rows, _ in parameter_map(Plane.symmetric(), Quantity.OVERSHOOT, SIZE)]
    assert [r.start for r in rows] == list(range(0, SIZE, BLOCK_ROWS))
    assert rows[-1].stop == SIZE
    first = next(parameter_map(Plane.symmetric(), Quantity.CLASS, 1001))
    assert first[1].shape == (BLOCK_ROWS, 1001)


def test_the_bspline_stands_out_of_its_plane():
    values = whole(Plane.symmetric(), Quantity.CLASS)
    assert values.max() == 11
    assert values[0, SIZE // 2] == 11


def test_planes_hold_exact_members():
    assert Plane.symmetric().member(Fraction(1, 4), Fraction(-1, 2)) == PRESETS["Tight"]
    member = Plane.of_sum(-1).member(Fraction(1, 3), Fraction(1, 7))
    assert member.alpha + member.beta + member.gamma == -1
    member = Plane.of_axes("beta", "gamma", PRESETS["Lean"]).member(Fraction(0), Fraction(1))
    assert (member.alpha, member.beta, member.gamma) == (Fraction(3, 10), 0, 1)


def test_the_ridge_is_a_maximum_among_its_neighbours():
    beta, exponent = smoothest_beta("1/10")
    for other in (beta - 0.02, beta + 0.02):
        assert quick_interval(Parameters("1/10", other, "1/10").mask).upper <= exponent + 1e-6


def test_the_ridge_at_zero_is_the_bspline():
    beta, exponent = smoothest_beta(0)
    assert beta == pytest.approx(-1)
    assert exponent == 12
