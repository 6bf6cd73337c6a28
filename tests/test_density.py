"""Sharing out chords by a density, against its integral."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.density import Density


def densities(seed, steps, finer):
    shares = np.random.default_rng(seed).uniform(0, 0.3, steps)
    shares[steps // 3 : steps // 2] = 0
    return Density(shares, finer)


@given(st.integers(0, 10**6), st.integers(8, 200), st.integers(0, 8))
def test_cuts_share_a_section_out_evenly(seed, steps, finer):
    density = densities(seed, steps, finer)
    fixed = np.array([0, steps // 4 << finer, steps << finer])
    cuts = density.cuts(fixed, 1)
    assert set(fixed) <= set(cuts)
    assert (np.diff(cuts) > 0).all()
    passed = np.interp(cuts, density.places, density.sums)
    for begin, end in pairwise(fixed):
        inside = passed[(cuts >= begin) & (cuts <= end)]
        chords = max(np.ceil(inside[-1] - inside[0]), 1)
        # Each cut lies on the place that is next to where it should.
        even = np.linspace(inside[0], inside[-1], int(chords) + 1)
        off = np.abs(inside[:, None] - even).min(axis=1)
        assert off.max() <= density.shares.max() / 2 ** (finer + 1) + 1e-9
        assert len(inside) <= chords + 1


@given(st.integers(0, 10**6), st.integers(1, 5))
def test_as_few_chords_as_are_told_are_there_at_least(seed, fewest):
    faint = Density(densities(seed, 40, 6).shares / 100, 6)
    assert len(faint.cuts(np.array([0, 40 << 6]), fewest)) == fewest + 1


def test_a_chord_that_misses_by_so_much_gets_as_many_more():
    density = Density(np.full(64, 0.25), 3)
    cuts = np.arange(0, (64 << 3) + 1, 4 << 3)
    wanted = np.where(np.arange(16) < 8, 1.2, 0.8)
    found = density.corrected(cuts, wanted)
    np.testing.assert_allclose(found.shares[:32], 0.3)
    np.testing.assert_allclose(found.shares[32:], 0.2)
    np.testing.assert_allclose(density.corrected(cuts, 100 * wanted).shares, 0.375)
