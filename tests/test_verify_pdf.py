"""A PDF is read back by a reader of its own, and what differs is refused."""

import re
import zlib

import msgspec
import numpy as np
import pytest

from core.document import Document
from core.errors import FileError
from core.family import PRESETS
from core.formats import pdf
from core.formats.contours import Contours
from core.formats.verify import verify
from core.profiles import named
from drawings import letter_f

STREAM = re.compile(rb"/Length (\d+) /Filter /FlateDecode >>\nstream\n")


def made(document=None, **fields):
    profile = msgspec.structs.replace(named("pdf"), **fields)
    content = Contours.of(document or letter_f((3.0, -7.0)), profile)
    return pdf.encode(content, "F"), content


def drawn_otherwise(data, change):
    """File with other contents of its page, and everything else right."""
    found = STREAM.search(data)
    start, length = found.end(), int(found[1])
    drawn = change(zlib.decompress(data[start : start + length]))
    packed = zlib.compress(drawn)
    head = data[: found.start()] + b"/Length %d /Filter /FlateDecode >>\nstream\n" % len(packed)
    shift = len(head) + len(packed) - start - length
    rest = data[start + length :]
    table = re.search(rb"xref\n(.*)startxref\n(\d+)\n", rest, re.DOTALL)
    rows = [
        b"%010d%s" % (int(row[:10]) + shift * (int(row[:10]) > start), row[10:])
        for row in re.findall(rb"\d{10} \d{5} [nf] \n", table[1])
    ]
    body = rest[: table.start(1)] + re.match(rb"0 \d+\n", table[1])[0] + b"".join(rows)
    tail = table[1][table[1].index(b"trailer") :] + b"startxref\n%d\n" % (int(table[2]) + shift)
    return head + packed + body + tail + rest[table.end() :]


def refused(data, content, words=""):
    with pytest.raises(FileError, match="read back, the file is not the drawing") as told:
        verify(data, content, "f.pdf")
    assert words in str(told.value)


@pytest.mark.parametrize("entity", ["cubics", "polyline"])
@pytest.mark.parametrize("unit", ["mm", "in"])
@pytest.mark.parametrize("layers", ["one", "by curve"])
def test_what_is_written_passes(entity, unit, layers):
    data, content = made(entity=entity, unit=unit, layers=layers)
    verify(data, content, "f.pdf")
    verify(drawn_otherwise(data, lambda drawn: drawn), content, "f.pdf")


def test_a_page_of_many_metres_passes():
    data, content = made(Document((letter_f().curves[0].moved([0], (20_000.0, 9_000.0)),)))
    assert b"/UserUnit 1 " not in data
    verify(data, content, "f.pdf")


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        (rb"\ns\n", b"\nS\n", "open"),
        (rb"2\.83464566929", b"2.84", "scale"),
        (rb"2\.83464566929", b"72", "unit"),
        (rb"/L0 BDC", b"/L1 BDC", "layer"),
        (rb"EMC\n\Z", b"EMC\nq\n", "other data"),
    ],
)
def test_a_slip_is_found(before, after, words):
    data, content = made(layers="one")
    changed = drawn_otherwise(data, lambda drawn: re.sub(before, after, drawn))
    assert changed != data
    refused(changed, content, words)


def test_a_digit_that_is_another_is_found():
    data, content = made()
    found = STREAM.search(data)
    drawn = zlib.decompress(data[found.end() : found.end() + int(found[1])])
    places = [match.start(1) for match in re.finditer(rb"(?<=[ \n])-?\d*(\d)\.\d+ ", drawn)]
    head = drawn.index(b" m\n") - 20
    chosen = [place for place in places if place > head]
    for place in np.random.default_rng(1).choice(chosen, 12):
        digit = bytes([48 + (drawn[place] - 48 + 5) % 10])
        other = drawn[:place] + digit + drawn[place + 1 :]
        refused(drawn_otherwise(data, lambda _, other=other: other), content)


def test_files_of_other_drawings_pages_and_ends_are_refused():
    data, content = made()
    refused(made(letter_f().with_parameters(PRESETS["Tight"]))[0], content)
    refused(made(Document(letter_f().curves[:1]))[0], content)
    refused(re.sub(rb"/MediaBox \[0 0 (\d)", rb"/MediaBox [0 0 9\1", data), content)
    refused(data[:-200], content, "table of places")
    refused(data.replace(b"FlateDecode >>", b"FlateDecoda >>"), content, "no contents")
