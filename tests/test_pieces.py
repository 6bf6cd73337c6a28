"""The search for long pieces, with a fit whose best answer is known."""

import numpy as np
import pytest

from core.pieces import fitted


class Lengths:
    """A piece fits while the sum of the weights of its steps is at most 1."""

    def __init__(self, weights):
        self.sums = np.concatenate([[0.0], np.cumsum(weights)])
        self.looked_at_whole = 0

    def solve(self, first, last, places, whole):
        assert (places[:, 0] == first).all()
        assert (places[:, -1] == last).all()
        steps = np.diff(places, axis=1)
        assert (steps >= 0).all()
        if whole:
            assert steps.max(initial=0) <= 1
            self.looked_at_whole += len(first)
        errors = self.sums[last] - self.sums[first]
        return errors, np.stack([first, last], axis=1).astype(float)


@pytest.mark.parametrize("steps", [1, 2, 3, 100, 5000, 200_000])
@pytest.mark.parametrize("each", [0.9, 0.02, 1e-7])
def test_nearly_as_few_pieces_as_can_be(steps, each):
    rng = np.random.default_rng(steps)
    weights = each * rng.uniform(0.5, 1, steps)
    cuts, errors, rows = fitted(steps, Lengths(weights), 1.0, steps)
    assert cuts[0] == 0
    assert cuts[-1] == steps
    assert (np.diff(cuts) > 0).all()
    assert errors.max() <= 1
    np.testing.assert_array_equal(rows, np.stack([cuts[:-1], cuts[1:]], axis=1))
    greedy, sum_ = 1, 0.0
    for weight in weights:
        if sum_ + weight > 1:
            greedy, sum_ = greedy + 1, 0.0
        sum_ += weight
    assert len(errors) <= 1.06 * greedy + 1


def test_no_piece_is_longer_than_allowed():
    cuts, _, _ = fitted(100, Lengths(np.zeros(100)), 1.0, 34)
    assert np.diff(cuts).max() <= 34
    assert len(cuts) == 4


def test_steps_that_cannot_fit_stand_alone():
    weights = np.full(300, 0.01)
    weights[[50, 51, 200]] = 3
    cuts, errors, _ = fitted(300, Lengths(weights), 1.0, 300)
    alone = np.flatnonzero(errors > 1)
    assert cuts[alone].tolist() == [50, 51, 200]
    assert cuts[alone + 1].tolist() == [51, 52, 201]


def test_the_longest_piece_counts_even_if_a_shorter_one_does_not_fit():
    class Gapped(Lengths):
        def solve(self, first, last, places, whole):
            errors, rows = super().solve(first, last, places, whole)
            return np.where((last - first) // 10 == 3, 2.0, errors), rows

    cuts, _, _ = fitted(100, Gapped(np.full(100, 0.009)), 1.0, 100)
    assert cuts.tolist() == [0, 100]


def test_what_a_glance_misses_is_halved_until_it_fits():
    class Blind(Lengths):
        def solve(self, first, last, places, whole):
            errors, rows = super().solve(first, last, places, whole)
            return (errors if whole else errors / 3), rows

    fit = Blind(np.full(1000, 0.01))
    cuts, errors, rows = fitted(1000, fit, 1.0, 1000)
    assert errors.max() <= 1
    np.testing.assert_array_equal(rows, np.stack([cuts[:-1], cuts[1:]], axis=1))
    np.testing.assert_allclose(errors, np.diff(fit.sums[cuts]))
