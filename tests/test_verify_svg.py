import numpy as np
import pytest

from core.errors import NinepointError
from core.formats.verify_svg import outlines

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="8mm" viewBox="0 0 9 8">'


def file(*paths, head=HEAD):
    drawn = "".join(f'<path d="{path}"/>' for path in paths)
    return f'{head}<g id="L">{drawn}</g></svg>'.encode()


def test_unit_page_lines_and_cubics_are_what_they_are():
    unit, size, (line, cubic) = outlines(file("M1 2\nL3 4 L5 6Z", "M0 0C0 4 4 4 4 0"), 1e-3)
    assert unit == "mm"
    assert size.tolist() == [9, 8]
    assert line.line.tolist() == [[1, -2], [3, -4], [5, -6], [1, -2]]
    assert (line.closed, line.count, line.layer) == (True, 3, "L")
    assert (cubic.closed, cubic.count) == (False, 1)
    assert cubic.line[:, 1].min() == pytest.approx(-3, abs=1e-3)


def test_a_cubic_is_closed_if_it_says_so_and_ends_where_it_starts():
    for data, closed in (
        ("M0 0C1 0 1 1 0 1C-1 1 -1 0 0 0Z", True),
        ("M0 0C1 0 1 1 0 1C-1 1 -1 0 0 0", False),
        ("M0 0C1 0 1 1 0 1C-1 1 -1 0 0 0.1Z", False),
    ):
        _, _, (found,) = outlines(file(data), 0.1)
        assert found.closed == closed


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (file("M0 0L1 1 2"), "damaged numbers"),
        (file("M0 0 5L1 1"), "damaged numbers"),
        (file("M0 0C1 1 2 2 3"), "damaged numbers"),
        (file("M0 0L1 1C0 0 1 1 2 2"), "lines and cubics"),
        (file("m0 0l1 1"), "other data"),
        (file("M0 0H5"), "other data"),
        (file("M0 0"), "other data"),
        (file(""), "other data"),
        (file("M0 0L1 1", head=HEAD.replace("9mm", "9")), "no size"),
        (file("M0 0L1 1", head=HEAD.replace("9mm", "9px")), "no size"),
        (file("M0 0L1 1", head=HEAD.replace("9mm", "9in")), "scale"),
        (file("M0 0L1 1", head=HEAD.replace("0 0 9 8", "0 0 9 9")), "scale"),
        (file("M0 0L1 1").replace(b"<g ", b'<g transform="scale(2)" '), "transform"),
        (file("M0 0L1 1").replace(b"<path ", b'<path transform="scale(2)" '), "other data"),
        (file("M0 0L1 1").replace(b"</svg>", b'<path d="M0 0L1 1"/></svg>'), "no layer"),
        (file("M0 0L1 1")[:-3], "no XML"),
        (b"", "no XML"),
        (b'<!DOCTYPE svg [<!ENTITY a "b">]>' + file("M0 0L1 1"), "no XML"),
        (b'<?xml version="1.0" encoding="U-F-8"?>' + file("M0 0L1 1"), "no XML"),
    ],
)
def test_what_we_do_not_write_is_refused(data, words):
    with pytest.raises(NinepointError, match=words):
        outlines(data, 0.1)


def test_many_vertices_are_read_at_once():
    points = np.random.default_rng(1).integers(0, 10**6, (20_000, 2)) / 1e4
    words = "\nL".join(f"{x:.4f} {y:.4f}" for x, y in points.tolist())
    _, _, (found,) = outlines(file("M" + words), 0.1)
    assert np.array_equal(found.line, points * (1, -1))
