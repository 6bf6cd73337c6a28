"""`ninepoint sample`: exact values at dyadic parameters, as CSV."""

import csv
import io

import numpy as np
import pytest

from app.cli import main
from core.document import Curve, Document
from core.family import PRESETS, Parameters
from core.limit import LimitCurve
from core.shape import curvatures, tangents
from core.store import save

POINTS = [(0, 0), (30, -5), (40, 20), (20, 35), (-5, 20)]


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("\n".join(f"{x},{y}" for x, y in POINTS))
    return path


@pytest.fixture
def run(capsys):
    def call(*args):
        with pytest.raises(SystemExit) as ended:
            main(["sample", *map(str, args)])
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return call


def table(text):
    rows = list(csv.reader(io.StringIO(text)))
    return rows[0], [[float(x) if x else None for x in row] for row in rows[1:]]


@pytest.mark.parametrize("closed", [True, False])
def test_the_values_are_those_of_the_curve_bit_for_bit(run, source, closed):
    way = "--closed" if closed else "--open"
    status, out, err = run(source, "--level", 3, "--alpha", "1/4", "--gamma", "1/4", way)
    assert (status, err) == (0, "")
    head, rows = table(out)
    assert head == ["t", "x", "y", "dx", "dy", "curvature"]
    curve = LimitCurve(POINTS, Parameters("1/4", "-1/2", "1/4").mask, closed)
    expected = np.column_stack(
        [curve.parameters(3), curve.points(3), tangents(curve, 3), curvatures(curve, 3)]
    )
    np.testing.assert_array_equal(np.array(rows), expected)


def test_columns_stay_empty_where_nothing_is_proven(run, source):
    rough = ("--alpha", "3/10", "--beta", "-3/5", "--gamma", "-1/5", "--neighbours", "mirrored")
    status, out, err = run(source, *rough, "--closed")
    assert status == 0
    assert "the curvature stays empty: C^2 is not proven" in err
    _, rows = table(out)
    assert all(row[3] is not None and row[5] is None for row in rows)
    status, out, err = run(source, "--alpha", "10")
    assert "tangents and curvature stay empty" in err
    assert all(row[3] is None for row in table(out)[1])


def test_several_curves_are_told_apart_by_a_last_column(run, tmp_path):
    path = tmp_path / "two.ninepoint"
    save(Document((Curve(POINTS), Curve(POINTS[:3], False)), PRESETS["Calm"]), path)
    _, out, _ = run(path, "--level", 1)
    head, rows = table(out)
    assert head[-1] == "curve"
    assert [row[-1] for row in rows] == [1] * 10 + [2] * 5


def test_a_file_is_written_whole_and_its_size_told(run, source, tmp_path):
    target = tmp_path / "out.csv"
    status, out, _ = run(source, "--level", 2, "--csv", target, "--closed")
    assert status == 0
    assert "20 points" in out
    assert len(target.read_text().splitlines()) == 21


@pytest.mark.parametrize(
    ("args", "part"),
    [
        (("--level", "21"), "21 is not in the range"),
        (("--level", "20", "--closed"), "at most 5,000,000"),
        (("--beta", "?"), "--beta must be a number"),
    ],
)
def test_what_cannot_be_sampled_is_refused_in_a_sentence(run, source, args, part):
    status, out, err = run(source, *args)
    assert (status, out) == (2, "")
    assert part in err


def test_the_source_is_never_written_over(run, source):
    before = source.read_bytes()
    status, _, err = run(source, "--csv", source)
    assert status == 2
    assert "same file" in err
    assert source.read_bytes() == before


def test_an_existing_file_is_replaced_by_force_only(run, source, tmp_path):
    target = tmp_path / "out.csv"
    target.write_text("old")
    status, _, err = run(source, "--csv", target)
    assert (status, err) == (2, "ninepoint: out.csv: it exists already; --force replaces it.\n")
    assert target.read_text() == "old"
    assert run(source, "--csv", target, "--force")[0] == 0
    assert target.read_text() != "old"
