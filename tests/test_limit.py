"""The limit curve: exact points, against fractions, polynomials and subdivision."""

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.basis import BasicLimitFunction
from core.family import PRESETS, Parameters
from core.limit import MAX_LEVEL, LimitCurve
from core.refine import subdivide
from oracles import convergent_members

EPS = np.finfo(float).eps
SEEDS = st.integers(0, 10**6)


def polygon(n, seed=1):
    return np.random.default_rng(seed).normal(size=(n, 2)) * 10


@pytest.mark.parametrize("level", [0, 1, 4])
@pytest.mark.parametrize("n", [1, 2, 3, 10, 10_000])
def test_shapes_are_those_of_the_definition(n, level):
    points, mask = polygon(n), PRESETS["Calm"].mask
    closed, opened = LimitCurve(points, mask, True), LimitCurve(points, mask, False)
    assert closed.points(level).shape == (n * 2**level, 2)
    assert opened.points(level).shape == ((n - 1) * 2**level + 1, 2)
    assert len(closed.parameters(level)) == n * 2**level
    assert len(opened.parameters(level)) == (n - 1) * 2**level + 1


@pytest.mark.parametrize("closed", [True, False])
def test_no_points_give_no_curve(closed):
    curve = LimitCurve(np.empty((0, 2)), PRESETS["Calm"].mask, closed)
    assert curve.points(3).shape == (0, 2)
    assert len(curve.parameters(3)) == 0


@given(convergent_members(), st.integers(0, 5))
def test_one_point_is_a_dot_and_two_points_are_a_segment(parameters, level):
    dot = LimitCurve([[3.0, 4.0]], parameters.mask, True).points(level)
    np.testing.assert_allclose(dot, np.broadcast_to([3.0, 4.0], dot.shape), rtol=1e-13)
    segment = LimitCurve([[0.0, 0.0], [2.0, 4.0]], parameters.mask, False).points(level)
    share = np.arange(2**level + 1) / 2**level
    np.testing.assert_allclose(segment, np.outer(share, [2.0, 4.0]), atol=1e-12)
    folded = LimitCurve([[0.0, 0.0], [2.0, 4.0]], parameters.mask, True).points(level)
    np.testing.assert_allclose(folded[:, 1], 2 * folded[:, 0], atol=1e-12)


@given(convergent_members(), st.integers(3, 7), SEEDS, st.integers(0, 3))
def test_points_equal_the_exact_sums_to_rounding(parameters, n, seed, level):
    points = np.random.default_rng(seed).integers(-100, 100, size=(n, 2)).astype(float)
    phi = BasicLimitFunction(parameters.mask)
    curve = LimitCurve(points, parameters.mask, True).points(level)
    largest = np.abs(points).max()
    for k in range(0, len(curve), max(1, len(curve) // 5)):
        t = Fraction(k, 2**level)
        exact = sum(
            (w * int(points[j % n, 0]) for j, w in phi.limit_stencil(t).items()), Fraction(0)
        )
        # 18 products whose weights sum to less than 2 in size, and the rounding of the table.
        assert abs(curve[k, 0] - float(exact)) <= 64 * EPS * largest


def test_degree_six_polynomials_are_reproduced_by_lagrange():
    t = np.arange(40.0)
    poly = np.polynomial.Polynomial([1, -2, 0.5, 0.1, -0.02, 0.003, -0.0001])
    curve = LimitCurve(np.column_stack([t, poly(t)]), PRESETS["Lagrange"].mask, False)
    inner = slice(8 * 8, -8 * 8)
    np.testing.assert_allclose(
        curve.points(3)[inner, 1], poly(curve.parameters(3))[inner], rtol=1e-11
    )


@given(convergent_members(), st.integers(2, 12), SEEDS, st.booleans())
def test_subdivision_tends_to_the_limit_points(parameters, n, seed, closed):
    """The textbook way as oracle: the mean of the two points next to t is O(2^-level) away."""
    points = polygon(n, seed)
    mask = parameters.mask
    curve = LimitCurve(points, mask, closed)
    level = 9
    fine = subdivide(points, mask, closed, level)
    k = (curve.parameters(3) * 2**level).astype(int)
    if closed:
        k += 2 ** (level - 1)
        near = (fine[k % len(fine)] + fine[(k - 1) % len(fine)]) / 2
    else:
        near = (fine[k] + fine[k + 1]) / 2
        near[0], near[-1] = points[0], points[-1]
    assert np.abs(near - curve.points(3)).max() <= 0.02 * np.abs(points).max()


@given(convergent_members(), st.integers(2, 10), SEEDS, st.booleans())
def test_affine_maps_of_the_polygon_map_the_curve(parameters, n, seed, closed):
    points = polygon(n, seed)
    matrix, offset = np.array([[2.0, -1.0], [0.5, 3.0]]), np.array([7.0, -4.0])
    there = LimitCurve(points @ matrix.T + offset, parameters.mask, closed).points(3)
    here = LimitCurve(points, parameters.mask, closed).points(3)
    np.testing.assert_allclose(there, here @ matrix.T + offset, atol=1e-10)


@given(convergent_members(), st.integers(3, 10), SEEDS, st.integers(1, 9))
def test_shifting_the_start_of_a_closed_polygon_shifts_the_curve(parameters, n, seed, shift):
    points = polygon(n, seed)
    here = LimitCurve(points, parameters.mask, True).points(2)
    there = LimitCurve(np.roll(points, -shift, axis=0), parameters.mask, True).points(2)
    np.testing.assert_allclose(there, np.roll(here, -4 * shift, axis=0), atol=1e-12)


@given(convergent_members(), st.integers(2, 10), SEEDS)
def test_open_curves_begin_and_end_exactly_at_the_end_points(parameters, n, seed):
    points = polygon(n, seed)
    curve = LimitCurve(points, parameters.mask, False).points(2)
    np.testing.assert_array_equal(curve[[0, -1]], points[[0, -1]])


@given(convergent_members(), st.integers(18, 30), st.integers(0, 17), SEEDS)
def test_a_moved_point_changes_the_curve_within_the_support_only(parameters, n, moved, seed):
    points = polygon(n, seed)
    other = points.copy()
    other[moved] += 1.0
    here = LimitCurve(points, parameters.mask, True)
    there = LimitCurve(other, parameters.mask, True)
    t = here.parameters(3)
    distance = np.abs((t - moved + n / 2) % n - n / 2)
    changed = np.abs(there.points(3) - here.points(3)).max(axis=1) > 1e-12
    assert not changed[distance >= 8.5].any()
    assert changed[distance < 1].any()


@given(convergent_members(), st.integers(2, 10), SEEDS, st.booleans(), st.floats(0, 1))
def test_the_curve_at_any_parameter_lies_on_the_curve(parameters, n, seed, closed, share):
    curve = LimitCurve(polygon(n, seed), parameters.mask, closed)
    level = 3
    k = int(share * (len(curve.parameters(level)) - 1))
    np.testing.assert_allclose(curve.at(k / 2**level), curve.points(level)[k], atol=1e-11)
    t = share * curve.spans
    fine = curve.span_points(slice(None), 10).reshape(-1, 2)
    gap = np.abs(np.diff(fine, axis=0)).max()
    assert np.abs(fine - curve.at(t)).max(axis=1).min() <= gap


def test_spans_hold_both_their_ends():
    curve = LimitCurve(polygon(7), PRESETS["Lean"].mask, False)
    spans = curve.span_points(np.array([5, 0]), 2)
    points = curve.points(2)
    np.testing.assert_allclose(spans[0], points[20:25], atol=1e-12)
    np.testing.assert_allclose(spans[1], points[0:5], atol=1e-12)


@pytest.mark.parametrize("points", [[[1.0, float("nan")]], [[1.0, 2.0, 3.0]], [1.0, 2.0]])
def test_points_that_are_none_are_refused(points):
    with pytest.raises(ValueError, match="control points must"):
        LimitCurve(points, PRESETS["Calm"].mask, True)


@pytest.mark.parametrize("level", [-1, MAX_LEVEL + 1])
def test_levels_out_of_range_are_refused(level):
    with pytest.raises(ValueError, match="level"):
        LimitCurve(polygon(3), PRESETS["Calm"].mask, True).points(level)


@pytest.mark.parametrize("t", [-0.1, 2.1])
def test_parameters_beyond_an_open_curve_are_refused(t):
    with pytest.raises(ValueError, match="t must lie"):
        LimitCurve(polygon(3), PRESETS["Calm"].mask, False).at(t)


def test_members_far_outside_still_give_finite_points():
    curve = LimitCurve(polygon(8), Parameters(100, -100, 100).mask, True)
    assert np.isfinite(curve.points(6)).all()


@pytest.mark.parametrize("closed", [True, False])
def test_many_spans_in_chunks_equal_few_at_once(closed):
    curve = LimitCurve(polygon(5000), PRESETS["Lean"].mask, closed)
    spans = curve.span_points(slice(1020, 1030), 5)
    np.testing.assert_allclose(
        curve.points(5)[1020 * 32 : 1030 * 32], spans[:, :-1].reshape(-1, 2), atol=1e-12
    )


def test_points_are_written_once_coordinate_by_coordinate():
    points = LimitCurve(polygon(9), PRESETS["Calm"].mask, False).points(3)
    assert points.strides[0] == points.itemsize
    assert points.base is not None  # a view of the product: not turned round by a copy


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize(
    "spans", [slice(None), slice(0, 3), slice(4, None), slice(2, 5), slice(None, None, -2)]
)
def test_a_slice_of_spans_equals_its_indices(spans, closed):
    curve = LimitCurve(polygon(9), PRESETS["Lean"].mask, closed)
    indices = np.arange(curve.spans)[spans]
    np.testing.assert_array_equal(
        curve.span_points(spans, 2), curve.span_points(indices, 2), strict=True
    )


def test_few_spans_of_a_long_curve_allocate_little():
    curve = LimitCurve(polygon(200_000), PRESETS["Tight"].mask, False)
    curve.span_points(slice(0, 18), 6)
    tracemalloc.start()
    try:
        curve.span_points(slice(99_000, 99_018), 6)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000
