import itertools

import pytest
from comparison import Comparison, Machine, Row, share, table


@pytest.mark.parametrize(
    ("value", "budget", "expected"),
    [
        ("1.50 copies, 0.72 ns a point", "6", 0.25),
        ("16 times faster", "8", 0.5),
        ("1.00 ms, p99 4.00 ms", "2 ms, 5 ms", 0.8),
        ("640 vertices, 0.45 ms", "2,000, 0.5 ms", 0.9),
        ("9.0 us", "15 us", 0.6),
        ("300 us", "1 ms", 0.3),
        ("116 MB", "120 MB", 116 / 120),
        ("2.42", "2.2", 1.1),
        ("2.42", "", None),
    ],
)
def test_share_of_a_budget(value, budget, expected):
    assert share(value, budget) == (expected if expected is None else pytest.approx(expected))


def test_the_table_marks_what_is_beyond_its_budget():
    lines = table(
        [
            Row("start", "2.42", "2.2", 1e-3),
            Row("memory", "116 MB", "120 MB", 1e-3),
            Row("size", "3", "", 2e-3),
        ]
    )
    marks = [line.split()[-2:] for line in lines[2:]]
    assert marks == [["!", "1.0"], ["0.97", "1.0"], ["3", "0.5"]]


def test_rounds_in_which_the_machine_was_slow_are_repeated():
    paces = itertools.cycle([1.0] * 4 + [2.0] * 6)
    machine = Machine()
    machine.pace = lambda: next(paces)
    machine.fastest = 1.0
    seen = []

    def measured():
        # As slow as the machine was when it was last looked at.
        seen.append(next(paces))
        return seen[-1]

    found = Comparison([], machine).medians({"way": measured}, 40)
    assert set(seen) == {1.0, 2.0}
    assert found == {"way": 1.0}


def test_where_the_machine_never_is_calm_all_rounds_count():
    machine = Machine()
    machine.pace = lambda: 2.0
    machine.fastest = 1.0
    numbers = itertools.count()
    found = Comparison([], machine).medians({"way": lambda: next(numbers)}, 10)
    assert found == {"way": 10 * 4 / 2 - 0.5}
