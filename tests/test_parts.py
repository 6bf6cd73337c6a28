"""The eight parts of a span or a cell draw the same piece of the curve."""

import numpy as np
from hypothesis import given

from core.basis import BasicLimitFunction
from core.parts import refinements
from oracles import convergent_members


@given(convergent_members())
def test_the_parts_of_a_window_draw_the_same_curve(member):
    from_span, from_cell = refinements(member.mask)
    basis = BasicLimitFunction(member.mask)
    width = len(from_cell)
    window = np.random.default_rng(1).normal(size=width + 1)
    parts = (window @ from_span).reshape(8, width)
    expected = window @ basis.span_table(5)
    drawn = (parts @ basis.cell_table(2))[:, :-1].ravel()
    np.testing.assert_allclose(drawn, expected[:-1], atol=1e-12)
    parts = (window[:-1] @ from_cell).reshape(8, width)
    expected = window[:-1] @ basis.cell_table(5)
    drawn = (parts @ basis.cell_table(2))[:, :-1].ravel()
    np.testing.assert_allclose(drawn, expected[:-1], atol=1e-12)
