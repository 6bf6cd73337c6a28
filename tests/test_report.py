"""The report: complete, consistent, valid JSON for every member."""

import json
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given

from core.continuity import Convergence
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.report import as_json, report
from core.shape import tangents
from effort import costly
from oracles import members
from reference import ROWS

KEYS = {
    "parameters", "mask", "support", "one_plus_z_multiplicity", "generation_degree",
    "reproduction_degree", "continuity", "hoelder", "gibbs", "limit_stencil", "endpoint_rules",
}  # fmt: skip


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_rows(row):
    data = as_json(report(row.parameters))
    assert set(data) == KEYS
    assert data["one_plus_z_multiplicity"] == row.multiplicity
    assert data["reproduction_degree"] == row.reproduction
    assert data["continuity"]["class"] == row.certificate[0]
    assert data["continuity"]["iterations"] == row.certificate[1]
    assert data["continuity"]["norm"] == pytest.approx(row.norm, abs=5.1e-5)
    assert data["continuity"]["not_class"] > row.certificate[0]
    assert data["hoelder"]["lower"] >= row.hoelder[0] - 5.1e-4
    assert data["hoelder"]["upper"] <= row.hoelder[1] + 5.1e-4
    low, high = data["gibbs"]["overshoot"]
    assert low - 5.1e-7 <= row.overshoot <= high + 5.1e-7


@costly
@given(members())
def test_every_member_gives_valid_json_with_exact_fractions(parameters):
    data = json.loads(json.dumps(as_json(report(parameters)), allow_nan=False))
    p = data["parameters"]
    again = Parameters(p["alpha"], p["beta"], p["gamma"], p["neighbours"])
    assert again == parameters
    coefficients = [Fraction(c) for c in data["mask"]["coefficients"]]
    assert tuple(coefficients) == parameters.mask.coefficients
    assert data["mask"]["start"] == parameters.mask.start
    low, high = map(Fraction, data["support"])
    assert high - low == len(coefficients) - 1
    if data["limit_stencil"]:
        assert sum(map(Fraction, data["limit_stencil"]["weights"])) == 1
    for row in data["endpoint_rules"]:
        assert sum(map(Fraction, row)) == 1


@pytest.mark.parametrize("name", PRESETS)
def test_the_stencils_give_points_and_tangents_of_the_curve(name):
    found = report(PRESETS[name])
    points = np.random.default_rng(1).normal(size=(30, 2))
    curve = LimitCurve(points, PRESETS[name].mask, True)
    for stencil, expected in (
        (found.limit_stencil, curve.points(0)[15]),
        (found.tangent_stencil, tangents(curve, 0)[15]),
    ):
        value = sum(float(w) * points[15 + j] for j, w in stencil.items())
        np.testing.assert_allclose(value, expected, atol=1e-12)


def test_the_first_violation_is_told():
    gibbs = as_json(report(PRESETS["Calm"]))["gibbs"]
    assert gibbs["zeta_nonnegative_up_to"] == 0
    assert gibbs["first_violation"]["value"] == "-215/131072"
    gibbs = as_json(report(PRESETS["B-spline"]))["gibbs"]
    assert gibbs["zeta_nonnegative_up_to"] == 6
    assert gibbs["first_violation"] is None


@pytest.mark.parametrize("size", [10, 100])
def test_divergent_members_are_reported_as_such(size):
    found = report(Parameters(size, 0, 0))
    assert found.smoothness.convergence is Convergence.DISPROVEN
    data = as_json(found)
    assert data["continuity"] == {"class": None, "iterations": None, "norm": None, "not_class": 0}
    assert data["limit_stencil"] is None
    assert data["gibbs"]["overshoot"][1] is None


def test_both_sides_of_the_class_meet_for_the_presets():
    for name, order in (("Lagrange", 2), ("Calm", 3), ("Tight", 4), ("Lean", 3), ("B-spline", 11)):
        smooth = report(PRESETS[name]).smoothness
        assert (smooth.order, smooth.not_class) == (order, order + 1)


def test_an_exponent_above_n_proves_the_class_n_where_the_theorem_does_not():
    smooth = report(Parameters("-1/3", "-1/3", "-1/3")).smoothness
    assert smooth.certificate.order == 2
    assert smooth.exponent.lower > 3
    assert smooth.order == 3


@pytest.mark.parametrize(
    ("parameters", "place"),
    [
        (PRESETS["Lean"], "the preset Lean"),
        (Parameters(0, "1/7", 0), "one-parameter"),
        (Parameters("1/7", 0, "1/7"), "two-parameter"),
        (Parameters("1/7", 0, 0), "full family"),
    ],
    ids=str,
)
def test_the_place_in_the_family_is_named(parameters, place):
    assert place in report(parameters).place_in_family
