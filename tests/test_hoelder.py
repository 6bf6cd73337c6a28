"""Hölder exponents as proven intervals."""

from itertools import pairwise, product
from math import inf, log2

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import hoelder, radius
from core.continuity import derived, iterated_norm
from core.family import PRESETS, Parameters, default_box
from core.hoelder import (
    branch_and_bound,
    converge_throughout,
    exact_interval,
    quick_interval,
)
from core.radius import transition_matrices
from effort import costly
from oracles import convergent_members
from reference import ROWS


def word_bound(mask, word):
    """Upper bound of the exponent from one product, by its definition."""
    multiplicity, matrices = transition_matrices(mask)
    product = np.eye(matrices.shape[1])
    for digit in word:
        product = matrices[digit] @ product
    size = np.abs(np.linalg.eigvals(product)).max() ** (1 / len(word))
    return multiplicity - 1 - log2(size) if size else inf  # as of the B-spline's second matrix


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_reference_intervals_overlap_and_are_narrowed(row):
    low, high = row.hoelder
    quick, exact = quick_interval(row.parameters.mask), exact_interval(row.parameters.mask)
    for found in (quick, exact):
        assert found.lower <= high + 5.1e-4
        assert found.upper >= low - 5.1e-4
    assert quick.width <= 0.05
    assert exact.width <= 1e-3
    assert quick.lower <= exact.lower <= exact.upper <= quick.upper


@pytest.mark.parametrize("name", PRESETS)
def test_presets_are_known_up_to_rounding(name):
    assert exact_interval(PRESETS[name].mask).width < 1e-7


@pytest.mark.parametrize("width", [0.049, 0.01, 0.002])
def test_a_long_maximal_product_is_not_overlooked(width):
    """The best product of this member has seven factors, beyond those that are tried at once."""
    mask = Parameters("48/1000", "-767/1000", "251/1000").mask
    bound = word_bound(mask, [1, 0, 1, 1, 1, 1, 1])
    assert bound < min(word_bound(mask, word) for word in ([0], [1], [0, 1], [0, 1, 1]))
    found = branch_and_bound(mask, width, 100_000)
    assert found.lower <= bound <= found.upper + 1e-9


@pytest.mark.parametrize("max_nodes", [100, 1_000, 10_000])
def test_the_lower_end_holds_even_if_the_best_product_is_never_tried(monkeypatch, max_nodes):
    """Pruned are only products that cannot matter, however poor the lower bound of rho is."""
    monkeypatch.setattr(radius, "WORD_LENGTH", 1)
    monkeypatch.setattr(hoelder, "_TRIED_WORDS", 0)
    mask = Parameters("186/1000", "-480/1000", "680/1000", "mirrored").mask
    radius.radius_of.cache_clear()
    found = branch_and_bound(mask, 0.1, max_nodes)
    radius.radius_of.cache_clear()
    bound = word_bound(mask, [0, 0, 1, 1])
    assert bound < word_bound(mask, [0]) - 0.03
    assert found.lower <= bound


@pytest.mark.parametrize(
    "parameters",
    [
        Parameters("137/1000", "-763/1000", "143/1000"),  # the leading eigenvalue is complex
        Parameters("-283/1000", "-777/1000", "-242/1000"),  # the best product has six factors
        Parameters("88/1000", "-74/1000", "77/1000", "mirrored"),  # and its eigenvalue is double
    ],
    ids=str,
)
def test_awkward_members_are_narrowed_to_a_thousandth_when_the_hand_rests(parameters):
    assert exact_interval(parameters.mask).width <= 1e-3


def test_the_exponent_of_the_bspline_is_its_degree():
    found = exact_interval(PRESETS["B-spline"].mask)
    assert found.lower == found.upper == 12


@costly
@given(convergent_members(), st.integers(1, 5), st.integers(0, 31))
def test_no_product_contradicts_the_lower_end(parameters, length, code):
    """Each product bounds the exponent from above: the proven lower end lies below all of them."""
    word = [code >> k & 1 for k in range(length)]
    assert quick_interval(parameters.mask).lower <= word_bound(parameters.mask, word) + 1e-9


@costly
@given(convergent_members(["translated"]), st.integers(1, 5))
def test_no_norm_contradicts_the_upper_end(parameters, iterations):
    """Each exact norm bounds the exponent from below: ``m - 1 - log2(norm^(1/L))``."""
    multiplicity = parameters.mask.factored()[0]
    norm = iterated_norm(derived(parameters.mask, multiplicity - 1), iterations)
    bound = multiplicity - 1 - log2(norm) / iterations
    assert quick_interval(parameters.mask).upper >= bound - 1e-9


@costly
@given(convergent_members())
def test_intervals_shrink_with_the_budget(parameters):
    intervals = [branch_and_bound(parameters.mask, 0.01, n) for n in (10, 100, 1000)]
    for wide, narrow in pairwise(intervals):
        assert wide.lower <= narrow.lower + 1e-12
        assert narrow.upper <= wide.upper + 1e-12
        assert narrow.lower <= narrow.upper


@costly
@given(convergent_members(["translated"]))
def test_the_exact_interval_lies_within_the_quick_one(parameters):
    quick, exact = quick_interval(parameters.mask), exact_interval(parameters.mask)
    assert quick.lower <= exact.lower <= exact.upper <= quick.upper + 1e-12


def test_a_cancelled_search_states_what_it_has():
    mask = PRESETS["Lean"].mask
    assert exact_interval(mask, cancelled=lambda: True) == quick_interval(mask)


def corners(box, neighbours):
    ends = product(box["alpha"], box["beta"], box["gamma"])
    return [Parameters(*corner, neighbours).mask for corner in ends]


@pytest.mark.parametrize("neighbours", ["translated", "mirrored"])
def test_the_whole_box_of_the_sliders_is_proven_convergent(neighbours):
    assert converge_throughout(corners(default_box(neighbours), neighbours))


def test_the_whole_unit_cube_is_proven_convergent_when_translated():
    unit = dict.fromkeys(("alpha", "beta", "gamma"), (-1, 1))
    assert converge_throughout(corners(unit, "translated"))


def test_a_box_with_a_divergent_member_is_not_proven():
    wide = dict.fromkeys(("alpha", "beta", "gamma"), (-1, 1))
    assert quick_interval(Parameters(1, 0, -1, "mirrored").mask).upper < 0
    assert not converge_throughout(corners(wide, "mirrored"))


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("neighbours", ["translated", "mirrored"])
def test_every_preset_lies_in_the_box_of_the_sliders(name, neighbours):
    for parameter, (low, high) in default_box(neighbours).items():
        assert low <= getattr(PRESETS[name], parameter) <= high


def test_most_of_the_sliders_boxes_are_narrowed_within_a_frames_budget():
    rng = np.random.default_rng(4)
    widths = []
    for neighbours in ["translated", "mirrored"] * 100:
        values = [
            round(rng.uniform(float(low), float(high)), 3)
            for low, high in default_box(neighbours).values()
        ]
        widths.append(quick_interval(Parameters(*values, neighbours).mask).width)
    assert np.mean(np.array(widths) <= 0.05) >= 0.9


def test_the_transition_matrices_are_those_of_the_definition():
    multiplicity, matrices = transition_matrices(PRESETS["Calm"].mask)
    b = derived(PRESETS["Calm"].mask, multiplicity - 1)
    for e, i, j in np.ndindex(matrices.shape):
        assert matrices[e, i, j] == float(b[b.start + 2 * i - j + e])
