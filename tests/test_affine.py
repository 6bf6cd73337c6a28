"""Affine maps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.affine import IDENTITY, Affine

NUMBERS = st.floats(-10, 10)


@st.composite
def maps(draw):
    turn, stretch = draw(st.floats(0, 7)), draw(st.floats(0.1, 10))
    cos, sin = stretch * np.cos(turn), np.sin(turn)
    offset = np.array([draw(NUMBERS), draw(NUMBERS)])
    return Affine(np.array([[cos, -sin], [stretch * sin, np.cos(turn)]]), offset)


POINTS = np.random.default_rng(1).normal(size=(30, 2))


@given(maps(), maps())
def test_after_is_one_map_and_then_the_other(one, other):
    np.testing.assert_allclose(one.after(other)(POINTS), one(other(POINTS)), atol=1e-9)


@given(maps())
def test_the_inverse_leads_back(there):
    np.testing.assert_allclose(there.inverse(there(POINTS)), POINTS, atol=1e-9)


@given(maps())
def test_no_distance_grows_by_more_than_the_stretch(there):
    before, after = np.diff(POINTS, axis=0), np.diff(there(POINTS), axis=0)
    ratios = np.hypot(*after.T) / np.hypot(*before.T)
    assert ratios.max() <= there.stretch * (1 + 1e-12)


@given(maps())
def test_the_box_holds_the_image(there):
    lower, upper = there.box(POINTS.min(axis=0), POINTS.max(axis=0))
    image = there(POINTS)
    assert (image >= lower - 1e-12).all()
    assert (image <= upper + 1e-12).all()


def test_a_shift_is_exact():
    there = Affine.shift((0.1, -0.3))
    assert there.is_shift
    assert there.stretch == 1
    np.testing.assert_array_equal(there(POINTS), POINTS + np.array([0.1, -0.3]))
    np.testing.assert_array_equal(there.inverse.offset, (-0.1, 0.3))
    np.testing.assert_array_equal(IDENTITY(POINTS), POINTS)
    assert not Affine(np.diag([1.0, -1.0]), np.zeros(2)).is_shift


def test_a_rectangle_turned_by_an_eighth_has_a_box_twice_as_large():
    turn = np.sqrt(0.5) * np.array([[1.0, -1.0], [1.0, 1.0]])
    lower, upper = Affine(turn, np.zeros(2)).box(np.zeros(2), np.ones(2))
    assert np.prod(upper - lower) == pytest.approx(2)
