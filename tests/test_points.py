import codecs

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import atomic
from core.document import MAX_COORDINATE_MM, MAX_POINTS
from core.errors import FileError
from core.formats import points

SQUARE = [[0, 0], [10, 0], [10, 5], [0, 5]]


@pytest.fixture
def read(tmp_path):
    """Read a text as a file of some name, as the one curve that it is."""

    def read(text, name="points.csv", closed=None):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        (curve,) = points.read(path, closed).curves
        return curve

    return read


@pytest.fixture
def refusal(read):
    def refusal(text, name="points.csv"):
        with pytest.raises(FileError) as caught:
            read(text, name)
        assert str(caught.value).startswith(name)
        return str(caught.value).removeprefix(name)

    return refusal


@pytest.mark.parametrize(
    "text",
    [
        "1.5,2\n-3,4e1\n",
        "1.5, 2\n-3, 4e1",
        "1.5 ,2\r\n-3 , 4e1\r\n",
        "1.5;2\n-3;4e1\n",
        "1,5;2,0\n-3;4e1\n",
        "1,5; 2\n-3; 40,0\n",
        "1.5\t2\n-3\t4e1\n",
        "1,5\t2\n-3\t40\n",
        "1.5 2\n-3 4e1\n",
        "   1.5      2.0\n  -3.0     40\n",
        "1,5 2\n-3 40,0\n",
        "1.5  \t 2\n-3\t40\n",
        '"1.5","2"\n"-3","40"\n',
        "x,y\n1.5,2\n-3,40\n",
        "x [mm];y [mm]\n1,5;2\n-3;40\n",
        "A title, of words\nx,y\n\n1.5,2\n-3,40\n",
        "# a remark 1,2\n1.5,2 # here\n\n-3,40\n#\n",
        "1.5,2,\n-3,40,\n",
        "1.5;2;;\n-3;40;;\n",
        "\ufeff1.5,2\n-3,40\n",
        "1.5,2\r-3,40\r",
        "+1.5,2.\n-3,.4e2\n",
        codecs.BOM_UTF16_LE + "x\ty\n1.5\t2\n-3\t40\n".encode("utf-16-le"),
        codecs.BOM_UTF16_BE + "1.5\t2\n-3\t40\n".encode("utf-16-be"),
        b"G\xf6ttingen\n1.5 2\n-3 40\n",
    ],
)
def test_two_columns_are_read_however_they_are_written(read, text):
    assert read(text).points.tolist() == [[1.5, 2.0], [-3.0, 40.0]]


@pytest.mark.parametrize("separator", [",", ", ", ";", "\t", " ", "   "])
@given(
    rows=st.lists(
        st.tuples(*2 * [st.floats(-MAX_COORDINATE_MM, MAX_COORDINATE_MM)]), min_size=1, max_size=9
    )
)
def test_all_numbers_come_back_bit_by_bit(tmp_path_factory, separator, rows):
    path = tmp_path_factory.mktemp("points") / "points.txt"
    path.write_text("\n".join(f"{x!r}{separator}{y!r}" for x, y in rows))
    (curve,) = points.read(path, closed=False).curves
    assert curve.points.tobytes() == np.array(rows).tobytes()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", ": the file is empty."),
        (" \n\t\r\n", ": the file is empty."),
        ("# only remarks\n\n", ": there are no points in it."),
        ("x,y\n", ", line 1: there are no points in it: no line with two numbers, x and y."),
        ("<svg>\n" * 50, ", line 1: there are no points in it: no line with two numbers, x and y."),
        ("1\n2\n3\n", ", line 1: there is only one column; x and y are needed."),
        ("x\n1,\n2\n", ", line 3: there is only one column; x and y are needed."),
        ("1,2\n\n3\n", ", line 3: there is only one column; x and y are needed."),
        ("1,2,3\n4,5,6\n", ", line 1: there are 3 columns; only x and y can be read."),
        ("1 2\n4 5 6\n", ", line 2: there are 3 columns; only x and y can be read."),
        ("1,2\n3,four\n", ", line 2: y is not a number: 'four'."),
        ("1,2\nx,y\n", ", line 2: x is not a number: 'x'."),
        ("1,2\n3,\n", ", line 2: y is missing."),
        ("1;2\n;4\n", ", line 2: x is missing."),
        ("1,2\n3," + "z" * 90, ", line 2: y is not a number: '" + "z" * 40 + "...'."),
        ("1,2\n1_000,2\n", ", line 2: x is not a number: '1_000'."),
        ("1,2\n0x10,2\n", ", line 2: x is not a number: '0x10'."),
        ("1,2\nnan,3\n", ", line 2: x is nan, not a finite number."),
        ("NaN NaN\n1 2\n", ", line 1: x is nan, not a finite number."),
        ("1,2\n3,inf\n", ", line 2: y is inf, not a finite number."),
        ("1,2\n-Infinity,3\n", ", line 2: x is -inf, not a finite number."),
        ("1,2\n3,1e999\n", ", line 2: y is inf, not a finite number."),
        ("1,2\n1e300,3\n", ", line 2: x is 1e+300; at most 1e+09 mm are admitted."),
        ("1,2\n3,-1000000001\n", ", line 2: y is -1e+09; at most 1e+09 mm are admitted."),
        ("O.5,4\n1,2\n", ", line 1: x is not a number: 'O.5'."),
        ("title\n0.5\n1,2\n", ", line 2: there is only one column; x and y are needed."),
        ("1.5;2\n3,5;4\n", ", line 2: decimal points and decimal commas are mixed."),
        ("1 2\n3,5 4\n1,234.5 6\n", ", line 3: x is not a number: '1,234.5'."),
        (b"1 2\n3 \xf6\n", ", line 2: y is not a number but bytes that are no UTF-8 text."),
        (b"\x89PNG\r\n\x1a\n\0\0\0\r", ", line 3: it is not a text file, or not in UTF-8."),
        ("x y\n1 2\n".encode("utf-16-le"), ", line 1: it is not a text file, or not in UTF-8."),
        ("1,2\n" + "3," * 6000, ", line 2: this line is too long for a point."),
    ],
)
def test_a_fault_is_told_with_its_line(refusal, text, message):
    assert refusal(text) == message


def test_ten_million_lines_are_refused_before_they_are_read(refusal, monkeypatch):
    text = b"1,2\n" * 10_000_000
    monkeypatch.setattr(points, "_lines", None)
    assert refusal(text) == ": it has more than 2,000,000 lines; thin it out."


def test_more_points_than_a_document_holds_are_refused(refusal, monkeypatch):
    assert points.MAX_LINES > MAX_POINTS
    monkeypatch.setattr(points, "MAX_POINTS", 3)
    assert refusal("x,y\n1,2\n3,4\n5,6\n7,8\n") == ": it has more than 3 points; thin it out."


def test_a_large_file_is_refused_by_its_size(refusal, monkeypatch):
    monkeypatch.setattr(atomic.read, "__defaults__", (1_000_000,))
    assert refusal("1,2\n" * 500_000) == ": it has 2 MB; at most 1 MB are read."


def test_a_repeated_first_point_closes_the_curve_and_is_dropped(read):
    curve = read("0,0\n10,0\n10,5\n0,5\n0,0\n")
    assert curve.closed
    assert curve.points.tolist() == SQUARE


def test_a_repetition_up_to_rounding_counts_as_one(read):
    angles = np.linspace(0, 2 * np.pi, 13)
    rows = np.column_stack([50 * np.cos(angles), 50 * np.sin(angles)])
    assert rows[0].tolist() != rows[-1].tolist()
    curve = read("\n".join(f"{x!r},{y!r}" for x, y in rows.tolist()))
    assert curve.closed
    assert len(curve.points) == 12


def test_points_that_do_not_come_back_make_an_open_curve(read):
    curve = read("0,0\n10,0\n10,5\n0,5\n")
    assert not curve.closed
    assert curve.points.tolist() == SQUARE


@pytest.mark.parametrize("text", ["0,0\n", "0,0\n0,0\n", "0,0\n1,1\n0,0\n", "0,0\n1,1\n2,0\n"])
def test_a_few_points_are_open_and_all_kept(read, text):
    curve = read(text)
    assert not curve.closed
    assert len(curve.points) == text.count("\n")


def test_the_caller_may_decide_whether_the_curve_is_closed(read):
    repeated, not_repeated = "0,0\n10,0\n10,5\n0,5\n0,0\n", "0,0\n10,0\n10,5\n0,5\n"
    opened = read(repeated, closed=False)
    assert not opened.closed
    assert opened.points.tolist() == [*SQUARE, [0, 0]]
    for text in (repeated, not_repeated):
        closed = read(text, closed=True)
        assert closed.closed
        assert closed.points.tolist() == SQUARE


SELIG = """\
Wing 12
  1.000000  0.001000
  0.500000  0.080000
  0.000000  0.000000
  0.500000 -0.040000
  1.000000 -0.001000
"""
LEDNICER = """\
Wing 12
       3.       3.

 0.0000000 0.0000000
 0.5000000 0.0800000
 1.0000000 0.0010000

 0.0000000 0.0000000
 0.5000000 -.0400000
 1.0000000 -.0010000
"""


@pytest.mark.parametrize("text", [SELIG, LEDNICER, LEDNICER.replace("\n\n", "\n")])
def test_both_forms_of_airfoils_give_one_closed_polygon_from_the_trailing_edge(read, text):
    curve = read(text, "wing.dat")
    assert curve.name == "Wing 12"
    assert curve.closed
    assert curve.points.tolist() == [
        [1.0, 0.001], [0.5, 0.08], [0.0, 0.0], [0.5, -0.04], [1.0, -0.001]
    ]  # fmt: skip


def test_a_sharp_trailing_edge_is_one_point(read):
    curve = read(SELIG.replace("0.001000", "0.000000"), "wing.dat")
    assert curve.closed
    assert len(curve.points) == 4


def test_sides_with_two_different_noses_keep_both(read):
    text = LEDNICER.replace("0.0000000 0.0000000", "0.0000000 -.0001000", 1)
    assert len(read(text, "wing.dat").points) == 6


def test_announced_points_that_do_not_follow_are_missed(refusal):
    text = LEDNICER.replace("3.       3.", "3.       4.")
    message = ", line 2: the airfoil has 6 points, but 3 + 4 are announced."
    assert refusal(text, "wing.dat") == message


def test_whole_numbers_in_the_first_line_are_a_point_elsewhere(read):
    assert read("5,6\n" + "1,2\n3,4\n" * 5).points[0].tolist() == [5, 6]
    assert read("x y\n7 7\n\n8 9\n\n9 9\n").points[0].tolist() == [7, 7]


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("vase.csv", "a title\n1 2\n3 4\n", "vase"),
        ("e.dat", "EPPLER   E205  AIRFOIL\n1 2\n3 4\n", "EPPLER E205 AIRFOIL"),
        ("E.DAT", "EPPLER\n1 2\n3 4\n", "EPPLER"),
        ("e.dat", "1 2\n3 4\n", "e"),
        ("g.dat", b"G\xf6ttingen 417\n1 2\n3 4\n", "Göttingen 417"),
        ("g.dat", "Göttingen 417\n1 2\n3 4\n", "Göttingen 417"),
    ],
)
def test_the_curve_is_called_after_the_airfoil_or_the_file(read, name, text, expected):
    assert read(text, name).name == expected


def test_a_hundred_thousand_points_are_read_whole(read):
    rows = np.random.default_rng(3).normal(size=(100_000, 2)) * 1000
    curve = read("x,y\n" + "\n".join(f"{x!r},{y!r}" for x, y in rows.tolist()))
    assert curve.points.tobytes() == rows.tobytes()


@given(st.one_of(st.binary(max_size=60), st.text('0123456789,.;\t -+einaf#\n\r"x_', max_size=60)))
def test_any_bytes_are_a_curve_or_a_fault_of_the_file(tmp_path_factory, contents):
    path = tmp_path_factory.getbasetemp() / "any.dat"
    path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
    try:
        (curve,) = points.read(path).curves
    except FileError:
        return
    assert len(curve.points) > 0
