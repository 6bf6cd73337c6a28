"""How far a curve leaves the chords of the parts of its spans."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.bends import ChordBounds, _refinement
from core.chords import chord_constant
from core.family import PRESETS
from core.limit import LimitCurve
from core.refine import subdivide
from core.windows import running_max
from oracles import convergent_members


def away(curve, level, fine=3):
    """Largest distance from the chords of the parts of each span, by dense samples."""
    points = curve.span_points(slice(None), level + fine)
    knots = points[:, :: 2**fine, None]
    share = (np.arange(2**fine) / 2**fine)[:, None]
    chords = knots[:, :-1] * (1 - share) + knots[:, 1:] * share
    off = points[:, :-1] - chords.reshape(len(points), -1, 2)
    return np.hypot(*off.transpose(2, 0, 1)).max(axis=1)


@given(
    convergent_members(), st.integers(2, 30), st.integers(0, 10**6), st.booleans(),
    st.integers(0, 6),
)  # fmt: skip
def test_no_span_leaves_its_chords_further_than_its_bound(member, count, seed, closed, level):
    points = np.random.default_rng(seed).uniform(0, 30, size=(count, 2))
    curve = LimitCurve(points, member.mask, closed)
    assert (away(curve, level) <= ChordBounds(curve).at(level) + 1e-12).all()


@pytest.mark.parametrize(("name", "typical"), [("Calm", 1.1), ("B-spline", 1.2), ("Tight", 1.5)])
def test_bounds_are_sharp_where_a_curve_bends_unevenly(name, typical):
    walk = np.cumsum(np.random.default_rng(3).normal(size=(200, 2)), axis=0)
    curve = LimitCurve(walk, PRESETS[name].mask, True)
    ratio = np.median(ChordBounds(curve).at(5) / away(curve, 5))
    assert 1 <= ratio <= typical
    # All control points that a span reads say much more.
    bends = np.hypot(*np.diff(curve.endless_points, n=2, axis=0).T)
    reads = curve.mask.end - curve.mask.start - 1
    coarse = chord_constant(curve.mask, 5) * running_max(bends, reads)[: curve.spans]
    assert np.median(coarse / away(curve, 5)) > 1.5 * typical


def test_long_curves_are_looked_at_in_parts_of_equal_right():
    points = np.random.default_rng(0).normal(size=(20_000, 2))
    whole = ChordBounds(LimitCurve(points, PRESETS["Lean"].mask, False)).at(4)
    part = ChordBounds(LimitCurve(points[9000:9100], PRESETS["Lean"].mask, False)).at(4)
    np.testing.assert_allclose(whole[9020:9080], part[20:80], rtol=1e-9)


@pytest.mark.parametrize("name", PRESETS)
def test_the_refinement_of_second_differences_is_that_of_the_polygon(name):
    mask = PRESETS[name].mask
    points = np.random.default_rng(1).normal(size=(60, 2))
    bends = np.diff(points, n=2, axis=0)
    size = mask.end - mask.start - 1
    found = np.stack([bends[k : k + size].T @ _refinement(mask) for k in range(len(bends) - size)])
    fine = np.diff(subdivide(points, mask, True, 3), n=2, axis=0)
    # Rows of neighbouring spans overlap; each is a section of the refined polygon's.
    first = found[:, :, 0]
    starts = [int(np.hypot(*(fine - row).T).argmin()) for row in first]
    assert set(np.diff(starts)) == {8}
    for start, row in zip(starts, found, strict=True):
        np.testing.assert_allclose(row.T, fine[start : start + row.shape[1]], atol=1e-12)
