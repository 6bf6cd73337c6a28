import json

import numpy as np
import pytest
from hypothesis import given

from core.document import MAX_POINTS, Curve, Document
from core.errors import FileError
from core.formats import open_document, read_json
from core.formats.tables import Tables, encode
from core.profiles import Profile
from drawings import documents, letter_f


def control_points(unit="mm"):
    return Profile(name="p", title="P", format="json", entity="control points", unit=unit)


def refusal(text, name="points.json"):
    with pytest.raises(FileError) as caught:
        read_json.decode(text.encode() if isinstance(text, str) else text, name)
    return str(caught.value).removeprefix(name)


def same(one, other):
    return len(one.curves) == len(other.curves) and all(
        (a.points == b.points).all() and (a.closed, a.name) == (b.closed, b.name)
        for a, b in zip(one.curves, other.curves, strict=True)
    )


@given(documents)
def test_control_points_come_back_as_the_same_floats(document):
    text = encode(Tables.of(document, control_points()), "title")
    back = read_json.decode(text, "points.json")
    for one, other in zip(document.curves, back.curves, strict=True):
        assert (one.points == other.points).all()
        assert one.is_loop == other.is_loop  # two points are written as what they are drawn as
        assert one.name == other.name


def test_the_unit_of_the_file_is_honoured():
    document = letter_f()
    back = read_json.decode(encode(Tables.of(document, control_points("in")), "F"), "f.json")
    for one, other in zip(document.curves, back.curves, strict=True):
        assert np.allclose(one.points, other.points, rtol=1e-14)


def test_a_file_is_opened_by_its_ending(tmp_path):
    path = tmp_path / "F.JSON"
    path.write_bytes(encode(Tables.of(letter_f(), control_points()), "F"))
    assert same(open_document(path), letter_f())
    assert all(curve.closed for curve in open_document(path, closed=True).curves)


@pytest.mark.parametrize(
    ("rows", "closed", "count"),
    [([[0, 0], [9, 0], [9, 9]], False, 3), ([[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]], True, 4)],
)
def test_a_list_of_points_is_one_curve(rows, closed, count):
    (curve,) = read_json.decode(json.dumps(rows).encode(), "box.json").curves
    assert (curve.closed, curve.count, curve.name) == (closed, count, "box")


def test_what_other_programs_add_is_passed_over():
    text = '{"curves": [{"rows": [[1, 2]], "colour": "red"}], "version": 7}'
    (curve,) = read_json.decode(text.encode(), "a.json").curves
    assert curve.points.tolist() == [[1, 2]]
    assert (curve.name, curve.closed) == ("Curve 1", False)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ": the file is empty."),
        ("\n \n", ": the file is empty."),
        ("[]", ": there are no points in it."),
        ('{"curves": []}', ": there are no points in it."),
        ('{"curves": [{"rows": []}]}', ": there are no points in it."),
        ('{"title": "x"}', "does not have the form of points"),
        ('"text"', "does not have the form of points"),
        ("17", "does not have the form of points"),
        ('[[1, 2], [3, "x"]]', "at [1][1]"),
        ("[[1, 2], [3]]", "does not have the form of points"),
        ("[[1, 2], [3, null]]", "does not have the form of points"),
        ('{"curves": [{"rows": [[1, 2],\n[3, 4]', ", line 2: the file is cut off here."),
        ('[[1, 2],\n[3; 4]]', ", line 2: it is damaged, or no JSON"),
        ("[[1, 2], [3, NaN]]", "it is damaged, or no JSON"),
        ('[[1, 2], [3, 2e9]]', "at most 1e+09 mm"),
        ('{"curves": [{"rows": [[1, 2]]}], "unit": "ell"}', "there is no unit 'ell'"),
        ('{"curves": [{"rows": [[1, 2]]}], "columns": ["t", "x", "y"]}', "the columns t, x, y"),
        ('{"format": "ninepoint", "curves": []}', "let its name end in .ninepoint"),
        (b'[[1, 2], ["\xff", 3]]', "does not have the form"),
        ("[" * 5000 + "]" * 5000, "points"),
    ],
)  # fmt: skip
def test_what_is_no_table_of_control_points_is_refused_in_a_sentence(text, words):
    sentence = refusal(text)
    assert words in sentence
    assert sentence.endswith(".")


def test_a_table_of_exact_points_is_no_polygon():
    limit = Profile(name="p", title="P", format="json", entity="limit points", tolerance_mm=1.0)
    text = encode(Tables.of(letter_f(), limit), "F")
    assert "only control points" in refusal(text)


def test_points_without_end_are_counted_before_they_are_read():
    assert f"more than {MAX_POINTS:,} points" in refusal(b"[" * 3_000_000)


def test_every_truncation_is_refused_or_read_whole():
    document = Document((Curve(np.eye(2), False, "A"), Curve(np.eye(2) + 1, True, "B")))
    text = encode(Tables.of(document, control_points()), "t")
    for length in range(len(text) - 2):
        assert refusal(text[:length]).endswith(".")
