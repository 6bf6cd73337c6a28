import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.formats.sketch import UNITS_MM, Sketch, Trace

cubics = st.lists(
    st.tuples(*8 * [st.one_of(st.integers(-9, 9), st.floats(-9, 9))]), min_size=1, max_size=4
)


@given(cubics)
def test_the_box_is_that_of_the_curves_themselves(rows):
    controls = np.array(rows, dtype=float).reshape(-1, 4, 2)
    t = np.linspace(0, 1, 2001)[:, None, None]
    p, q, r, s = (controls[:, index] for index in range(4))
    points = (1 - t) ** 3 * p + 3 * t * (1 - t) ** 2 * q + 3 * t**2 * (1 - t) * r + t**3 * s
    low, high = Trace(controls, False).box
    assert (low <= points.min(axis=(0, 1)) + 1e-12).all()
    assert (high >= points.max(axis=(0, 1)) - 1e-12).all()
    assert low == pytest.approx(points.min(axis=(0, 1)), abs=1e-4)
    assert high == pytest.approx(points.max(axis=(0, 1)), abs=1e-4)


def line(*numbers):
    a, b = np.array(numbers, dtype=float).reshape(2, 2)
    return Trace(np.array([[a, (2 * a + b) / 3, (a + 2 * b) / 3, b]]), False, deviation=0.5)


def test_the_box_of_a_sketch_is_around_all_traces():
    sketch = Sketch((line(0, 1, 5, 2), line(-3, 0, 1, 9)), "mm", True)
    assert (sketch.low.tolist(), sketch.high.tolist()) == ([-3, 0], [5, 9])


@pytest.mark.parametrize("unit", UNITS_MM)
def test_another_unit_changes_sizes_and_bounds(unit):
    sketch = Sketch((line(1, 2, 3, 4),), "cm", False).in_unit(unit)
    factor = UNITS_MM[unit] / 10
    assert (sketch.unit, sketch.is_unit_known) == (unit, True)
    assert sketch.high == pytest.approx(np.array([3, 4]) * factor)
    assert sketch.traces[0].deviation == pytest.approx(0.5 * factor)


def test_an_unknown_unit_is_refused():
    with pytest.raises(NinepointError, match="no unit 'ell'"):
        Sketch((line(1, 2, 3, 4),), "cm", False).in_unit("ell")


def test_nodes_are_the_ends_of_cubics():
    controls = np.concatenate([line(0, 0, 4, 0).controls, line(4, 0, 0, 3).controls])
    assert Trace(controls, False).nodes.tolist() == [[0, 0], [4, 0], [0, 3]]
    assert Trace(controls, True).nodes.tolist() == [[0, 0], [4, 0]]
