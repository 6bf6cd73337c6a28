"""Level of detail: the chords keep the tolerance, with few of them, and nothing seen is missed."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.detail import (
    FINEST_DETAIL,
    amplification,
    chord_profile,
    detailed,
    span_levels,
    spans_within,
)
from core.family import PRESETS, Parameters
from core.limit import LimitCurve

MEMBERS = [*PRESETS.values(), Parameters("1/10", -1, "-1/10", "mirrored")]
NAMES = [*PRESETS, "mirrored"]
members = pytest.mark.parametrize("member", MEMBERS, ids=NAMES)
both_ends = pytest.mark.parametrize("closed", [True, False], ids=["closed", "open"])

DENSE = 8
"""Level that stands for the curve itself; its own chords are off by less than 1e-5 here."""


def shape(count: int = 24, noise: float = 8.0) -> NDArray[np.float64]:
    rng = np.random.default_rng(7)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    circle = 100 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return circle + rng.normal(0, noise, (count, 2))


def deviation(curve: LimitCurve, levels: NDArray[np.intp]) -> float:
    """Largest distance of the curve at t from the chord at the same t: a slow oracle."""
    t, points = detailed(curve, levels)
    if curve.closed:
        t, points = np.append(t, curve.spans), np.vstack([points, points[:1]])
    fine = curve.parameters(DENSE)
    chords = np.stack([np.interp(fine, t, points[:, k]) for k in (0, 1)], axis=-1)
    return float(np.hypot(*(curve.points(DENSE) - chords).T).max())


@members
@both_ends
@pytest.mark.parametrize("tolerance", [3.0, 0.3, 0.03])
def test_the_chords_keep_the_tolerance(
    member: Parameters, closed: bool, tolerance: float
) -> None:
    curve = LimitCurve(shape(), member.mask, closed)
    levels = span_levels(curve, tolerance, budget=10**6)
    assert deviation(curve, levels) <= tolerance


@given(
    alpha=st.integers(-5, 5), beta=st.integers(-20, 2), gamma=st.integers(-5, 5),
    seed=st.integers(0, 99),
)
@settings(max_examples=25, deadline=None)
def test_the_bound_holds_within_the_useful_range(
    alpha: int, beta: int, gamma: int, seed: int
) -> None:
    member = Parameters(Fraction(alpha, 20), Fraction(beta, 20), Fraction(gamma, 20))
    points = np.random.default_rng(seed).uniform(-50, 50, (12, 2))
    curve = LimitCurve(points, member.mask, True)
    levels = span_levels(curve, 0.2, budget=10**6)
    # The profile is sampled; between the samples an error may be larger by a few percent.
    assert deviation(curve, np.minimum(levels, DENSE - 1)) <= 0.2 * 1.05


def test_a_sharp_point_is_not_paid_for_by_the_whole_curve() -> None:
    points = 3 * shape(1000, noise=0.0)
    points[500] += (40, 30)
    curve = LimitCurve(points, PRESETS["Calm"].mask, True)
    levels = span_levels(curve, 0.25, budget=10**6)
    assert levels.max() >= 3
    assert (1 << levels).sum() < 1100


def test_the_budget_holds() -> None:
    curve = LimitCurve(shape(200) * 1000, PRESETS["Calm"].mask, True)
    assert (1 << span_levels(curve, 0.001, budget=10**9)).sum() > 3000
    assert (1 << span_levels(curve, 0.001, budget=3000)).sum() <= 3000
    assert (span_levels(curve, 0.001, budget=10) == 0).all()


def test_the_budget_is_spent_on_what_is_seen() -> None:
    curve = LimitCurve(shape(200, noise=0.0) * 1000, PRESETS["Calm"].mask, True)
    place = curve.at(40.5)
    view = place - 10.0, place + 10.0
    levels = span_levels(curve, 0.001, 4000, view)
    assert levels[40] == span_levels(curve, 0.001, 10**9)[40]
    assert (levels == 0).sum() > 150
    assert (1 << levels).sum() <= 4000


@members
@both_ends
def test_detailed_points_lie_on_the_curve(member: Parameters, closed: bool) -> None:
    curve = LimitCurve(shape(9), member.mask, closed)
    levels = np.arange(curve.spans) % 4
    t, points = detailed(curve, levels)
    assert (np.diff(t) > 0).all()
    exact = np.array([curve.at(value) for value in t])
    np.testing.assert_allclose(points, exact, atol=1e-10)
    assert len(t) == (1 << levels).sum() + (not closed)


@pytest.mark.parametrize("count", [0, 1, 2, 3])
@both_ends
def test_few_points(count: int, closed: bool) -> None:
    closed = closed and count >= 3
    curve = LimitCurve(shape(9)[:count], PRESETS["Lean"].mask, closed)
    levels = span_levels(curve, 0.1, budget=1000)
    t, points = detailed(curve, levels)
    assert len(levels) == curve.spans
    assert len(t) == len(points) >= count
    assert spans_within(curve, np.full(2, -1e3), np.full(2, 1e3)).all()


@members
@both_ends
def test_a_span_that_is_left_out_is_not_in_view(member: Parameters, closed: bool) -> None:
    curve = LimitCurve(shape(), member.mask, closed)
    points = curve.span_points(slice(None), 6)
    rng = np.random.default_rng(1)
    left_out = 0
    for _ in range(40):
        lower = rng.uniform(-150, 100, 2)
        upper = lower + rng.uniform(1, 80, 2)
        seen = ((points >= lower) & (points <= upper)).all(axis=2).any(axis=1)
        admitted = spans_within(curve, lower, upper)
        assert not (seen & ~admitted).any()
        left_out += int((~admitted).sum())
    assert left_out > 0


def test_profile_of_the_b_spline_is_that_of_a_parabola() -> None:
    # A curve with the second difference 1 everywhere is t^2 / 2, whose chords miss it by 1/8 at
    # most, and by a quarter of that on each further level.
    profile = chord_profile(PRESETS["B-spline"].mask).sum(axis=1)
    assert len(profile) == FINEST_DETAIL + 1
    assert profile[0] == pytest.approx(1 / 8, rel=1e-3)
    np.testing.assert_array_less(profile[1:] / profile[:-1], 0.31)


def test_amplification_is_1_for_positive_weights_and_more_for_others() -> None:
    assert amplification(PRESETS["B-spline"].mask) == pytest.approx(1.0)
    assert amplification(PRESETS["Lagrange"].mask) > 1.05


def test_a_scheme_without_a_limit_stays_finite() -> None:
    curve = LimitCurve(shape(8), Parameters(100, 100, 100).mask, True)
    levels = span_levels(curve, 0.25, budget=4000)
    points = detailed(curve, levels)[1]
    assert (1 << levels).sum() <= 4000
    assert np.isfinite(points).all()
