import math
import re

import numpy as np
import pytest
import svgpathtools
from hypothesis import assume, given
from hypothesis import strategies as st

from core.formats import path_data, path_tokens
from core.formats.budget import Budget, BudgetError
from core.formats.outlines import outline

TOLERANCE = 1e-4


def drawn(text, tolerance=TOLERANCE):
    """Tidy outlines of path data, and whether the data are whole."""
    found = path_data.outlines(text, tolerance, Budget())
    tidied = [outline(*one) for one in found.outlines]
    return [one for one in tidied if one is not None], found.is_whole


def nodes(text):
    """Nodes of the one outline of path data without a fault."""
    (one,), is_whole = drawn(text)
    assert is_whole
    return [one.controls[0, 0].tolist(), *one.controls[:, 3].tolist()]


def points_on(controls, count=33):
    """Points at equal parameters of cubics, shape (n * count, 2)."""
    t = np.linspace(0, 1, count)[:, None]
    a, b, c, d = (controls[:, i, None] for i in range(4))
    return (
        a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    ).reshape(-1, 2)


@pytest.mark.parametrize(
    "text",
    [
        "M1 2L5 2L5 6",
        "M1,2 5,2 5,6",
        "M1 2 L 5 2 5 6",
        "m1 2l4 0l0 4",
        "m1 2 4 0 0 4",
        "M1 2H5V6",
        "m1 2h4v4",
        "\n\tM\r\n1e0,+2.0L5.,.2e1L50e-1 6",
        "M1 2h1 1 1 1v4",
    ],
)
def test_lines_are_drawn_however_they_are_written(text):
    corners = nodes(text)
    assert corners[0] == [1, 2]
    assert [5, 2] in corners
    assert corners[-1] == [5, 6]


def test_numbers_may_touch_where_nothing_is_ambiguous():
    assert nodes("M.5.25-1-2.5") == [[0.5, 0.25], [-1, -2.5]]
    assert nodes("M1e1.5-1e-1+2") == [[10, 0.5], [-0.1, 2]]


def test_flags_of_arcs_need_no_separator():
    (loose,), _ = drawn("M0 0a 5,5 0 0,1 10,10 5 5 0 1 0 3 3")
    (tight,), is_whole = drawn("M0 0a5 5 0 0110 10 5 5 0 103 3")
    assert is_whole
    assert tight.controls.tobytes() == loose.controls.tobytes()


def test_a_close_returns_the_pen_to_the_start_of_its_subpath():
    (square, line), is_whole = drawn("M1 1h2v2h-2zl5 5")
    assert is_whole
    assert square.closed
    assert len(square.controls) == 4
    assert not line.closed
    assert line.controls[0, [0, 3]].tolist() == [[1, 1], [6, 6]]


def test_a_path_that_comes_back_to_its_start_is_closed():
    (whole,), _ = drawn("M0 0L4 0L4 3L0 0")
    assert whole.closed
    assert len(whole.controls) == 3


def test_rounding_between_the_ends_is_closed_and_counted():
    text = "M0 0" + "l0.1 0" * 10 + "l0 1l-1 0l0 -1"
    (whole,), _ = drawn(text)
    assert whole.closed
    assert 0 < whole.deviation < 1e-14
    assert whole.controls[-1, 3].tobytes() == whole.controls[0, 0].tobytes()


@pytest.mark.parametrize(
    ("text", "last"),
    [
        ("M0 0L1 2 x 3 3", [1, 2]),
        ("M0 0L1 2 3", [1, 2]),
        ("M0 0L1 2L3", [1, 2]),
        ("M0 0 1 2,,3 4", [1, 2]),
        ("M0 0L1 2A5 5 0 2 1 9 9L3 3", [1, 2]),
        ("M0 0C1 1 2 2 1 2 7 7", [1, 2]),
        ("M0 0L1 2,L5 5", [1, 2]),
        ("M0 0L1 2#", [1, 2]),
        ("M0 0L1 2L", [1, 2]),
        ("M0 0L1 2 \u0661 5", [1, 2]),
    ],
)
def test_a_fault_ends_the_drawing_and_what_stands_before_is_kept(text, last):
    (one,), is_whole = drawn(text)
    assert not is_whole
    assert one.controls[-1, 3].tolist() == last


@pytest.mark.parametrize("text", ["L1 1", "1 1", "Z", "x", "M", "M1"])
def test_data_that_begin_wrongly_draw_nothing(text):
    assert drawn(text) == ([], False)


@pytest.mark.parametrize("text", ["", "  ", "M1 1", "M1 1Z", "M1 1 1 1", "M1 1M2 2"])
def test_data_without_a_length_draw_nothing_and_have_no_fault(text):
    assert drawn(text) == ([], True)


def test_quadratic_curves_become_cubics_exactly():
    (one,), _ = drawn("M0 0Q3 6 6 0T12 0")
    theirs = svgpathtools.parse_path("M0 0Q3 6 6 0T12 0")
    for cubic, quadratic in zip(one.controls, theirs, strict=True):
        t = np.linspace(0, 1, 9)
        assert np.allclose(points_on(cubic[None], 9) @ [1, 1j], quadratic.points(t), atol=1e-14)


def numbers_of(values):
    return st.lists(
        st.integers(-200, 200).map(lambda n: n / 8), min_size=values, max_size=values
    )


commands = st.one_of(
    *(
        st.tuples(st.sampled_from([name, name.lower()]), numbers_of(count))
        for name, count in [("L", 2), ("H", 1), ("V", 1), ("C", 6), ("S", 4), ("Q", 4), ("T", 2)]
    ),
    st.tuples(
        st.sampled_from("Aa"),
        st.tuples(
            st.integers(1, 60), st.integers(1, 60), st.integers(-180, 180),
            st.integers(0, 1), st.integers(0, 1), st.integers(-90, 90), st.integers(-90, 90),
        ).map(list),
    ),
    st.just(("Z", [])),
)  # fmt: skip


def plainly(segments):
    return "M 0 0 " + " ".join(
        f"{letter} {' '.join(str(value) for value in values)}" for letter, values in segments
    )


def tightly(segments):
    """The same data with letters left out, zeros left out and as few separators as possible."""
    text, before = "M0 0", "M"
    for letter, values in segments:
        if letter != before or letter == "Z":
            text += letter
        before = letter
        for place, value in enumerate(values):
            word = f"{value:g}"
            word = word.replace("0.", ".", 1) if abs(value) < 1 and value else word
            if letter in "Aa" and place in (3, 4):
                text += ("" if place == 4 else " ") + word
                continue
            touches = word[0] != "-" and (text[-1].isdigit() or text[-1] == ".")
            last = re.split("[ ,-]", text)[-1]
            starts_with_point = word[0] == "." and "." in last
            after_flag = letter in "Aa" and place == 5
            text += word if after_flag or not touches or starts_with_point else "," + word
    return text


@given(st.lists(commands, max_size=12))
def test_tight_data_are_those_written_plainly(segments):
    plain, is_whole = drawn(plainly(segments))
    assert is_whole
    tight, is_whole = drawn(tightly(segments))
    assert is_whole
    assert [one.controls.tobytes() for one in tight] == [one.controls.tobytes() for one in plain]


@given(st.lists(commands.filter(lambda segment: segment[0] != "Z"), min_size=1, max_size=8))
def test_svgpathtools_draws_the_same(segments):
    text = plainly(segments)
    found, _ = drawn(text)
    ours = np.concatenate([one.controls for one in found]) if found else np.zeros((0, 4, 2))
    try:
        theirs = svgpathtools.parse_path(text)
    except AssertionError:  # it refuses arcs without a chord
        assume(False)
    t = np.linspace(0, 1, 400)
    parts = [np.array([segment.point(u) for u in t]) for segment in theirs if segment.length()]
    assume(parts)
    curve = np.concatenate(parts)
    mine = points_on(ours, 60) @ [1, 1j]
    reach = np.abs(curve[:, None] - mine[None]).min(axis=1)
    steps = max(np.abs(np.diff(part)).max(initial=0) for part in parts)
    spacing = np.abs(np.diff(points_on(ours, 60).reshape(len(ours), 60, 2), axis=1)).max()
    assert reach.max() <= spacing + TOLERANCE
    assert np.abs(mine[:, None] - curve[None]).min(axis=1).max() <= steps + TOLERANCE


@given(
    radius=st.floats(0.01, 1e6),
    ratio=st.floats(0.01, 1),
    turn=st.floats(0.01, 6.2),
    rotation=st.floats(-400, 400),
    tolerance=st.sampled_from([1e-6, 1e-4, 1e-1]),
)
def test_arcs_keep_to_the_tolerance_and_to_their_bound(radius, ratio, turn, rotation, tolerance):
    other = radius * ratio
    x, y = radius * math.cos(turn), other * math.sin(turn)
    angle = math.radians(rotation)
    cos, sin = math.cos(angle), math.sin(angle)
    ends = [(cos * p - sin * q, sin * p + cos * q) for p, q in ((radius, 0.0), (x, y))]
    text = f"M{ends[0][0]!r} {ends[0][1]!r}A{radius!r} {other!r} {rotation!r} "
    text += f"{int(turn > math.pi)} 1 {ends[1][0]!r} {ends[1][1]!r}"
    found, _ = drawn(text, tolerance)
    rounding = 1e-6 * radius  # where the chord is nearly a diameter, the centre is a square root
    for one in found:
        assert one.deviation <= tolerance * (1 + 1e-9) + 1e-9 * radius
        points = points_on(one.controls)
        u = (points @ [cos, sin]) / radius
        v = (points @ [-sin, cos]) / other
        assert (np.abs(np.hypot(u, v) - 1) * other <= one.deviation + rounding).all()


def test_long_data_are_drawn_as_short_ones_bit_for_bit():
    rng = np.random.default_rng(5)
    numbers = rng.integers(-999, 999, (4000, 2)) / 16
    for letter in "Ll":
        text = "M3 4" + "".join(f"{letter}{x} {y}" for x, y in numbers.tolist())
        (whole,), _ = drawn(text)
        x, y = 3.0, 4.0
        for place, (p, q) in enumerate(numbers.tolist()):
            x, y = (p, q) if letter == "L" else (x + p, y + q)
            if place % 500 == 0:
                assert [x, y] in whole.controls[:, 3].tolist()
        assert whole.controls[-1, 3].tolist() == [x, y]


def test_blocks_and_single_segments_are_split_alike(monkeypatch):
    rng = np.random.default_rng(6)
    text = "M0 0" + "".join(
        f"{letter}{' '.join(map(str, rng.integers(-99, 99, count)))}"
        for letter, count in [("c", 6), ("l", 20), ("C", 120), ("h", 3), ("l", 90), ("s", 8)] * 9
    )
    long, _ = drawn(text)
    monkeypatch.setattr(path_tokens, "_SHORT", 0)
    monkeypatch.setattr(path_tokens, "_TOGETHER", 7)
    monkeypatch.setattr(path_tokens, "_BLOCK", 11)
    monkeypatch.setattr(path_data, "_LONG", 10**9)
    single, is_whole = drawn(text)
    assert is_whole
    assert [one.controls.tobytes() for one in single] == [one.controls.tobytes() for one in long]


def test_overflow_is_kept_as_infinity_for_who_looks_at_coordinates():
    one, is_whole = path_data.outlines("M0 0L1e999 3", TOLERANCE, Budget())
    assert is_whole
    assert np.isinf(one[0].controls).any()


def test_more_segments_than_the_budget_are_refused_before_they_are_made(monkeypatch):
    monkeypatch.setattr("core.formats.budget.MAX_SEGMENTS", 100)
    drawn("M0 0" + "h1" * 99)
    with pytest.raises(BudgetError):
        drawn("M0 0" + "h1" * 101)
    with pytest.raises(BudgetError):
        drawn("M0 0" + "A1e9 1e9 0 0 0 1e9 1e9 1e9 1e9 0 0 0 0 0" * 5)


def test_lists_of_numbers_are_read_by_the_same_grammar():
    assert list(path_tokens.numbers("1,2 3-4.5.5")) == [1, 2, 3, -4.5, 0.5]
    assert path_tokens.numbers("1,2,x") is None
    assert path_tokens.numbers("1L2") is None


def test_more_contours_than_the_budget_are_refused(monkeypatch):
    monkeypatch.setattr("core.formats.budget.MAX_CONTOURS", 9)
    assert len(drawn("M0 0h1" * 9)[0]) == 9
    with pytest.raises(BudgetError):
        drawn("M0 0h1" * 10)
