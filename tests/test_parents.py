"""The parents, derived from their definitions, against the tables that the paper prints."""

from fractions import Fraction

from core.family import displacement
from core.mask import Mask, Stencil
from core.parents import bspline, lagrange
from oracles import reproduces

PRINTED_A = Stencil(-3, tuple(
    Fraction(*pair) for pair in (
        (273, 65536), (-1287, 32768), (15015, 65536), (15015, 16384),
        (-9009, 65536), (1001, 32768), (-231, 65536),
    )
))  # fmt: skip
PRINTED_B = Stencil(-3, tuple(
    Fraction(*pair) for pair in (
        (13, 4096), (143, 2048), (1287, 4096), (429, 1024), (715, 4096), (39, 2048), (1, 4096),
    )
))  # fmt: skip
PRINTED_C = tuple(
    Fraction(*pair) for pair in (
        (-247, 65536), (377, 32768), (-20449, 65536), (8151, 16384),
        (-5577, 65536), (-3575, 32768), (65, 65536),
    )
)  # fmt: skip


def mirror(stencil):
    return Stencil(-stencil.offsets[-1], stencil.weights[::-1])


def test_lagrange_equals_the_printed_table_and_the_odd_rule_is_its_mirror_image():
    assert lagrange().even == PRINTED_A
    assert lagrange().odd == mirror(PRINTED_A)


def test_bspline_equals_the_printed_table_and_the_odd_rule_is_its_mirror_image():
    assert bspline().even == PRINTED_B
    assert bspline().odd == mirror(PRINTED_B)


def test_lagrange_reproduces_degree_6_and_no_more():
    assert reproduces(lagrange(), 6)
    assert not reproduces(lagrange(), 7)


def test_bspline_symbol_is_a_power_of_one_plus_z():
    multiplicity, rest = bspline().factored()
    assert multiplicity == 13
    assert rest == Mask(-6, (Fraction(1, 4096),))


def test_the_printed_displacement_weights_stand_in_reverse_order():
    """Erratum: the paper's ``c_j`` is ``a_{-j} - b_{-j}``, though it defines V as Q - R.

    Taken at its word the printed list would give a scheme that no longer contains R.
    """
    weights = dict(displacement().even.items())
    assert tuple(weights[j] for j in range(-3, 4)) == PRINTED_C[::-1]
    assert tuple(weights[j] for j in range(-3, 4)) != PRINTED_C
    at_its_word = Mask.from_stencils(Stencil(-3, PRINTED_C), mirror(Stencil(-3, PRINTED_C)))
    assert lagrange() - displacement() == bspline()
    assert lagrange() - at_its_word != bspline()
    assert (lagrange() - at_its_word).factored()[0] == 3
