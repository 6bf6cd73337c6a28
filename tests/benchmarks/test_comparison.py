import pytest
from comparison import Row, share, table


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
