import contextlib
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import atomic, store
from core.document import MAX_COORDINATE_MM, MAX_POINTS, Curve, Document
from core.errors import FileError, NinepointError
from core.family import PRESETS, Parameters
from core.profiles import PROFILES

NAME = "wing.ninepoint"

TEXT = b"""\
{
 "checksum": "sha256:0e8a93b8a1afce0e8cd8b1b4da2e3d2f0dbfbf2ba12ed4d9dbb1dbb06fdbd3b6",
 "curves": [
  {
   "closed": true,
   "name": "Outline",
   "points": [
    [0.0,0.1],
    [60.0,-8.0],
    [1e-7,0.30000000000000004]
   ]
  },
  {
   "closed": false,
   "name": "Empty",
   "points": []
  }
 ],
 "format": "ninepoint",
 "parameters": {
  "alpha": "1/4",
  "beta": "-1/2",
  "gamma": "0",
  "neighbours": "mirrored"
 },
 "version": 1
}
"""

DOCUMENT = Document(
    (
        Curve([[0.0, 0.1], [60.0, -8.0], [1e-7, 0.1 + 0.2]], True, "Outline"),
        Curve([], False, "Empty"),
    ),
    Parameters("1/4", "-1/2", 0, "mirrored"),
)

coordinates = st.floats(-MAX_COORDINATE_MM, MAX_COORDINATE_MM)
curves = st.builds(
    Curve,
    st.lists(st.tuples(coordinates, coordinates), max_size=12),
    st.booleans(),
    st.text(max_size=20),
)
numbers = st.fractions(-100, 100, max_denominator=10**12)
documents = st.builds(
    Document,
    st.lists(curves, max_size=4),
    st.builds(Parameters, numbers, numbers, numbers, st.sampled_from(["translated", "mirrored"])),
)


def unchecked(text):
    """The text without its checksum, as one that was edited by hand."""
    return b"".join(line for line in text.splitlines(True) if b'"checksum"' not in line)


def refusal(data):
    with pytest.raises(FileError) as caught:
        store.decode(data, f"folder/{NAME}")
    assert str(caught.value).startswith(NAME)
    return str(caught.value)


def assert_same(one, other):
    assert one.parameters == other.parameters
    assert len(one.curves) == len(other.curves)
    for left, right in zip(one.curves, other.curves, strict=True):
        assert (left.closed, left.name) == (right.closed, right.name)
        assert left.points.shape == right.points.shape
        assert left.points.tobytes() == right.points.tobytes()


def test_the_text_is_the_documented_one():
    text = store.encode(DOCUMENT)
    assert unchecked(text) == unchecked(TEXT)
    assert re.search(rb'^ "checksum": "sha256:[0-9a-f]{64}",$', text, re.MULTILINE)


@given(documents)
def test_every_document_comes_back_bit_by_bit(document):
    assert_same(store.decode(store.encode(document), NAME), document)


@given(documents)
def test_equal_documents_have_equal_texts(document):
    text = store.encode(document)
    assert store.encode(store.decode(text, NAME)) == text


def test_one_moved_point_changes_its_line_and_the_checksum_only():
    moved = DOCUMENT.with_curve(0, DOCUMENT.curves[0].moved([1], [61.0, -8.0]))
    before, after = (store.encode(d).splitlines() for d in (DOCUMENT, moved))
    changed = [i for i, (a, b) in enumerate(zip(before, after, strict=True)) if a != b]
    assert changed == [1, 8]


def test_extreme_floats_and_signed_zero_come_back():
    points = [[5e-324, -0.0], [1e9, -1e9], [2.2250738585072014e-308, 1 / 3], [1e16 / 1e8, 1e-300]]
    document = Document((Curve(points),))
    assert_same(store.decode(store.encode(document), NAME), document)


def test_the_finest_fractions_come_back():
    document = Document((), Parameters(Fraction(100 * 10**30 - 1, 10**30), -100, 1e-13))
    assert_same(store.decode(store.encode(document), NAME), document)


def test_every_prefix_is_refused():
    text = store.encode(two_kilobytes())
    for end in range(len(text)):
        refusal(text[:end])


def test_every_flipped_bit_is_found():
    text = store.encode(two_kilobytes())
    for place in range(len(text)):
        for bit in range(8):
            flipped = bytearray(text)
            flipped[place] ^= 1 << bit
            with pytest.raises(FileError):
                store.decode(bytes(flipped), NAME)


def two_kilobytes():
    points = np.random.default_rng(2).uniform(-100, 100, (40, 2))
    # Digits beyond the shortest decimal and exponents: a flip there leaves the number as it is.
    points[0] = 0.1 + 0.2, 1e-7
    document = Document((Curve(points, True, "Outline"),))
    assert 1_900 < len(store.encode(document)) < 2_300
    return document


def test_line_ends_of_windows_are_no_damage():
    assert_same(store.decode(store.encode(DOCUMENT).replace(b"\n", b"\r\n"), NAME), DOCUMENT)


def test_a_text_without_checksum_is_opened_as_it_is():
    edited = unchecked(store.encode(DOCUMENT)).replace(b"[60.0,-8.0]", b"[ 61, -8 ]")
    assert store.decode(edited, NAME).curves[0].points[1].tolist() == [61.0, -8.0]


def test_an_edited_text_with_its_checksum_is_refused_with_the_way_out():
    edited = store.encode(DOCUMENT).replace(b"[60.0,", b"[61.0,")
    assert "do not match its checksum" in refusal(edited)
    assert "delete the line" in refusal(edited)


@pytest.mark.parametrize("data", [b"", b" \n\t\r\n"])
def test_an_empty_file_is_called_empty(data):
    assert refusal(data) == f"{NAME}: the file is empty."


@pytest.mark.parametrize(
    "data",
    [
        b"{}",
        b"[]",
        b"null",
        b"3",
        b'{"format": "svg", "version": 1}',
        b'{"format": 3}',
        b'{"format": "ninepoint", "version": "1"}',
        b'{"format": "ninepoint", "version": 0}',
        b'{"format": "ninepoint"}',
        b"[" * 200_000,
        b'{"a":' * 200_000,
    ],
)
def test_foreign_json_is_called_foreign(data):
    assert refusal(data) == f"{NAME}: it is not a Ninepoint drawing."


@pytest.mark.parametrize(
    "data",
    [
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        b"%PDF-1.7\n%\xe2\xe3",
        b"<svg/>",
        b"\xff\xfe{\0",
        bytes(range(256)),
    ],
)
def test_files_of_other_kinds_are_refused_with_the_line(data):
    assert refusal(data).startswith(f"{NAME}, line 1: it is damaged, or not a Ninepoint drawing")


def test_export_profiles_are_kept_and_others_stay_readable_for_older_programs():
    thin = msgspec.structs.replace(PROFILES["laser"], name="thin", tolerance_mm=0.002)
    held = DOCUMENT.with_profile(PROFILES["svg"]).with_profile(thin)
    data = store.encode(held)
    assert b'"version": 2' in data
    back = store.decode(data, NAME)
    assert back.profiles == (PROFILES["svg"], thin)
    assert store.encode(back) == data
    assert b'"version": 1' in store.encode(DOCUMENT)
    assert store.encode(back.without_profile("thin").without_profile("svg")) == store.encode(
        DOCUMENT
    )


def test_a_profile_that_cannot_be_is_refused():
    data = store.encode(DOCUMENT.with_profile(PROFILES["svg"]))
    unsigned = re.sub(rb' "checksum": "[^"]*",\n', b"", data)
    for fault in (b'"format":"doc"', b'"colours":"svg"'):
        assert "profiles" in refusal(unsigned.replace(b'"format":"svg"', fault))


def test_a_newer_version_asks_for_an_update():
    newer = store.encode(DOCUMENT).replace(b'"version": 1', b'"version": 3, "layers": []')
    assert refusal(newer) == (
        f"{NAME}: it was written by a newer Ninepoint (format 3); update Ninepoint to open it."
    )


def test_a_cut_file_names_the_line_of_the_cut():
    text = store.encode(DOCUMENT)
    assert refusal(text[: text.index(b"-8.0")]) == f"{NAME}, line 9: the file is cut off here."


def test_a_wrong_character_names_its_line():
    assert refusal(TEXT.replace(b"60.0", b"6O.0")).startswith(f"{NAME}, line 9: it is damaged")


@pytest.mark.parametrize("word", [b"NaN", b"Infinity", b"-Infinity", b"nan"])
def test_words_that_are_no_json_numbers_are_refused(word):
    assert f"{NAME}, line 9" in refusal(unchecked(b"\n" + TEXT).replace(b"60.0", word))


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (b"60.0", b"1e999", "curves[0].points[1][0]"),
        (b"60.0", b'"60"', "curves[0].points[1][0]"),
        (b"60.0", b"null", "curves[0].points[1][0]"),
        (b"60.0,", b"", "curves[0].points[1]"),
        (b"60.0,", b"60.0,1.0,", "curves[0].points[1]"),
        (b'"closed": true', b'"closed": 1', "curves[0].closed"),
        (b'"closed": true,', b"", "closed"),
        (b'"name": "Outline"', b'"colour": "red"', "colour"),
        (b'"version": 1', b'"version": 1, "layers": []', "layers"),
        (b'"beta": "-1/2"', b'"beta": -0.5', "parameters.beta"),
        (b'"beta": "-1/2"', b'"beta": "much"', "beta must be a number"),
        (b'"beta": "-1/2"', b'"beta": "1/0"', "beta divides by zero"),
        (b'"beta": "-1/2"', b'"beta": "101"', "beta must lie between"),
        (b'"beta": "-1/2"', b'"beta": "' + b"9" * 5000 + b'"', "beta must be a number"),
        (b"mirrored", b"sideways", "neighbours must be"),
        (b"60.0", b"1e300", "Point 2 of 'Outline' is (1e+300, -8)"),
        (b"60.0", b"1000000001", "at most 1e+09 mm"),
        (b"Outline", b"\xff", "UTF-8"),
        (b"Outline", b"\\ud800", "damaged"),
    ],
)
def test_what_a_document_must_not_hold_is_refused_with_its_place(old, new, reason):
    assert TEXT.count(old) == 1
    assert reason in refusal(unchecked(TEXT).replace(old, new))


def test_too_many_points_are_refused_before_they_are_parsed():
    assert refusal(b"[" * (3 * MAX_POINTS)) == f"{NAME}: it holds more than 1,000,000 points."


def test_a_little_too_many_points_are_refused():
    points = b"[0,0]," * MAX_POINTS + b"[0,0]"
    text = unchecked(store.encode(Document((Curve([]),)))).replace(b"[]", b"[" + points + b"]")
    assert "1,000,001 control points; at most 1,000,000" in refusal(text)


def test_the_largest_document_fits_the_size_limit():
    longest = [[-987654321.1234567, -1.2345678901234567e-300]] * 1000
    share = len(store.encode(Document((Curve(longest),)))) / 1000
    assert share * MAX_POINTS < atomic.MAX_BYTES


def test_a_large_file_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / NAME
    path.touch()
    os.truncate(path, 10**12)
    with pytest.raises(FileError, match=r"1,000,000 MB; at most 100 MB are read"):
        store.load(path)


def test_a_saved_document_loads_as_it_was(tmp_path):
    path = tmp_path / NAME
    store.save(DOCUMENT, path)
    assert_same(store.load(path), DOCUMENT)
    assert path.read_bytes() == store.encode(DOCUMENT)


def test_halves_of_characters_in_a_name_become_question_marks(tmp_path):
    path = tmp_path / NAME
    store.save(Document((Curve([[1, 2]], name="a\ud800b"),)), path)
    assert store.load(path).curves[0].name == "a?b"


def test_a_text_that_would_not_read_back_is_never_written(tmp_path, monkeypatch):
    path = tmp_path / NAME
    store.save(DOCUMENT, path)
    before = path.read_bytes()
    other = store.encode(DOCUMENT.with_parameters(PRESETS["Tight"]))
    for wrong in (other, before[:-1]):
        monkeypatch.setattr(store, "encode", lambda document, wrong=wrong: wrong)
        with pytest.raises(FileError):
            store.save(DOCUMENT, path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_too_many_curves_are_neither_written_nor_read(tmp_path, monkeypatch):
    monkeypatch.setattr(store, "MAX_CURVES", 1)
    with pytest.raises(NinepointError, match="at most 1 can be saved"):
        store.encode(DOCUMENT)
    with pytest.raises(FileError, match="at most 1 can be saved"):
        store.save(DOCUMENT, tmp_path / NAME)
    assert "more than 1 curves" in refusal(unchecked(TEXT))


def test_a_drawing_too_large_to_open_is_not_written(tmp_path, monkeypatch):
    monkeypatch.setattr(atomic, "MAX_BYTES", 100)
    with pytest.raises(FileError, match="too large"):
        store.save(DOCUMENT, tmp_path / NAME)
    assert list(tmp_path.iterdir()) == []


SAVING_AND_KILLED = """
import os, random, signal, sys
from pathlib import Path
from core import store
from core.document import Curve, Document

path = Path(sys.argv[1])
documents = [Document((Curve([[k, 0.5]] * 300, name=str(k)),)) for k in range(2)]
synchronise = os.fsync
strays = 0
store.save(documents[0], path)
for kill in range(20):
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        # Tell when the temporary is written, so that the kill falls into the middle of a save.
        os.fsync = lambda file: (os.write(writing, b"."), synchronise(file))
        while True:
            for document in documents:
                store.save(document, path)
    pause = random.Random(kill)
    os.read(reading, pause.randrange(1, 4))
    for _ in range(pause.randrange(5_000)):
        pass
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    strays += len(list(path.parent.glob(".ninepoint-*")))
    name = store.load(path).curves[0].name
    assert name in "01", name
assert strays, "no kill fell into a save"
store.save(documents[0], path)
assert list(path.parent.iterdir()) == [path], list(path.parent.iterdir())
sys.stdout.write("survived")
"""


def test_killed_while_saving_the_file_is_always_whole_and_strays_are_cleaned(tmp_path):
    result = subprocess.run(
        [sys.executable, "-c", SAVING_AND_KILLED, str(tmp_path / NAME)],
        cwd=Path(__file__).parent.parent,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.stdout == "survived", result.stderr


@given(st.data())
def test_any_change_of_the_text_is_a_document_or_a_fault_of_the_file(data):
    text = unchecked(TEXT)
    begin = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(begin, min(begin + 30, len(text))))
    pieces = st.sampled_from([b"[", b"]", b"{", b"}", b",", b'"', b"1e400", b"-", b"null", b"1"])
    inserted = data.draw(st.one_of(st.binary(max_size=5), pieces))
    with contextlib.suppress(FileError):
        assert isinstance(store.decode(text[:begin] + inserted + text[end:], NAME), Document)
