import math
from pathlib import Path

import numpy as np
import pytest
import resvg_py
import svgpathtools
from hypothesis import given
from hypothesis import strategies as st

from core.errors import FileError
from core.formats import budget, read_svg, svg_values

PX = 25.4 / 96
HEAD = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
)
MM = 'width="100mm" height="80mm" viewBox="0 0 100 80"'


def svg(body, size=MM):
    return f"<svg {HEAD} {size}>{body}</svg>"


def read(text):
    data = text.encode() if isinstance(text, str) else text
    return read_svg.decode(data, Path("drawing.svg"))


def refusal(text):
    with pytest.raises(FileError) as caught:
        read(text)
    return str(caught.value).removeprefix("drawing.svg")


def box(sketch):
    return [*sketch.low.tolist(), *sketch.high.tolist()]


RECT = '<rect x="10" y="20" width="30" height="5"/>'


def test_the_page_is_true_size_and_upright():
    sketch = read(svg(RECT))
    assert box(sketch) == [10, 55, 40, 60]
    assert (sketch.unit, sketch.is_unit_known, sketch.notes) == ("mm", True, ())
    (trace,) = sketch.traces
    assert trace.closed
    assert trace.nodes.tolist() == [[10, 60], [40, 60], [40, 55], [10, 55]]


def test_an_f_is_not_mirrored():
    sketch = read(svg('<path d="M10 50V10H30M10 30H25"/>'))
    assert sketch.traces[0].nodes.tolist() == [[10, 30], [10, 70], [30, 70]]
    assert sketch.traces[1].nodes.tolist() == [[10, 50], [25, 50]]


@pytest.mark.parametrize(
    ("size", "unit", "is_known", "mm"),
    [
        ('width="100mm" height="80mm" viewBox="0 0 100 80"', "mm", True, 1),
        ('width="10cm" height="8cm" viewBox="0 0 100 80"', "cm", True, 1),
        ('width="100in" height="80in" viewBox="0 0 100 80"', "in", True, 25.4),
        ('width="72pt" height="72pt" viewBox="0 0 1 1"', "pt", True, 25.4),
        ('width="6pc" height="6pc" viewBox="0 0 1 1"', "pt", True, 25.4),
        ('width="40Q" height="40Q" viewBox="0 0 10 10"', "mm", True, 1),
        ('width="1in" height="2in" viewBox="0 0 1 1"', "in", True, 25.4),
        ('width="100MM" viewBox="0 0 100 80"', "mm", True, 1),
        ('height=" 80mm " viewBox="0 0 100 80"', "mm", True, 1),
        ('width="100mm" height="80mm"', "mm", True, PX),
        ('width="100px" height="80px" viewBox="0 0 100 80"', "px", False, PX),
        ('width="100" height="80" viewBox="0 0 50 40"', "px", False, 2 * PX),
        ('width="100%" height="100%" viewBox="0 0 50 40"', "px", False, PX),
        ('viewBox="0,0,100,80"', "px", False, PX),
        ("", "px", False, PX),
        ('width="0mm" height="-3mm" viewBox="0 0 0 5"', "px", False, PX),
        ('width="wide" viewBox="0 0 1"', "px", False, PX),
        ('width="10em" height="10em" viewBox="0 0 160 160"', "px", False, PX),
    ],
)
def test_sizes_are_honoured_and_guesses_are_told(size, unit, is_known, mm):
    sketch = read(svg('<rect width="3" height="7"/>', size))
    assert (sketch.unit, sketch.is_unit_known) == (unit, is_known)
    assert sketch.high - sketch.low == pytest.approx([3 * mm, 7 * mm], rel=1e-12)


@pytest.mark.parametrize(
    ("aspect", "expected"),
    [
        ("", [0, 25, 100, 75]),
        ("xMidYMid meet", [0, 25, 100, 75]),
        ("xMinYMin", [0, 50, 100, 100]),
        ("xMaxYMax meet", [0, 0, 100, 50]),
        ("none", [0, 0, 100, 100]),
        ("xMidYMid slice", [-50, 0, 150, 100]),
        ("xMinYMid slice", [0, 0, 200, 100]),
        ("defer xMaxYMid slice", [-100, 0, 100, 100]),
    ],
)
def test_the_view_box_is_fitted(aspect, expected):
    size = f'width="100mm" height="100mm" viewBox="5 7 20 10" preserveAspectRatio="{aspect}"'
    sketch = read(svg('<rect x="5" y="7" width="20" height="10"/>', size))
    assert box(sketch) == pytest.approx(expected, abs=1e-12)


def test_in_another_unit_the_same_numbers_are_read():
    sketch = read(svg(RECT, 'viewBox="0 0 100 80"')).in_unit("mm")
    assert box(sketch) == pytest.approx([10, 55, 40, 60])
    assert sketch.is_unit_known


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        ('<rect width="10" height="10" rx="2"/>', 1),
        ('<rect width="10" height="10" rx="2" ry="3"/>', 1),
        ('<rect width="10" height="10" rx="50%" ry="99"/>', 1),
        ('<rect width="0" height="10"/>', 0),
        ('<rect width="-1" height="10"/>', 0),
        ('<rect width="10" height="10" rx="-1" ry="auto"/>', 1),
        ('<circle r="5"/>', 1),
        ('<circle r="0"/>', 0),
        ('<circle r="-2"/>', 0),
        ('<ellipse cx="4" rx="5" ry="2"/>', 1),
        ('<ellipse cx="4" rx="5"/>', 1),
        ('<line x2="1" y2="2"/>', 1),
        ('<line x1="1"  x2="1"/>', 0),
        ('<polyline points="1,2 3,4 5 6"/>', 1),
        ('<polyline points="1,2"/>', 0),
        ('<polygon points=" 1,2 3,4 5,6 "/>', 1),
        ('<polygon points=""/>', 0),
        ("<path/>", 0),
        ("<g/>", 0),
    ],
)
def test_shapes_are_read_or_empty(shape, expected):
    mark = '<line x1="50" x2="51"/>'
    sketch = read(svg(mark + shape))
    assert len(sketch.traces) == 1 + expected
    assert sketch.notes == ()


def radial_error(trace, centre, rx, ry):
    t = np.linspace(0, 1, 200)[:, None]
    a, b, c, d = (trace.controls[:, i, None] for i in range(4))
    points = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    u, v = ((points - centre) / (rx, ry)).reshape(-1, 2).T
    return np.abs(np.hypot(u, v) - 1).max() * max(rx, ry)


@pytest.mark.parametrize("radius", [0.001, 1, 40, 5000, 1e6])
def test_circles_keep_to_their_bound(radius):
    (trace,) = read(svg(f'<circle cx="3" cy="4" r="{radius}"/>')).traces
    assert trace.closed
    assert trace.deviation <= read_svg.DEVIATION_MM * 1.001
    assert radial_error(trace, (3, 76), radius, radius) <= trace.deviation + 1e-12 * radius
    assert trace.controls[..., 0].max() >= 3 + radius


def test_rounded_corners_keep_to_their_bound():
    text = svg('<rect x="1" y="2" width="30" height="20" rx="4" ry="3"/>')
    (trace,) = read(text).traces
    assert trace.closed
    assert box(read(text)) == pytest.approx([1, 58, 31, 78], abs=1e-12)
    path = svgpathtools.parse_path(
        "M5 2H27A4 3 0 0 1 31 5V19A4 3 0 0 1 27 22H5A4 3 0 0 1 1 19V5A4 3 0 0 1 5 2Z"
    )
    exact = np.array([part.point(u) for part in path for u in np.linspace(0, 1, 500)])
    t = np.linspace(0, 1, 20)[:, None]
    a, b, c, d = (trace.controls[:, i, None] for i in range(4))
    ours = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    ours = ours.reshape(-1, 2) @ [1, -1j] + 80j
    assert np.abs(ours[:, None] - exact).min(axis=1).max() < 0.05 + trace.deviation


FUNCTIONS = st.lists(
    st.one_of(
        st.tuples(st.just("translate"), st.lists(st.integers(-9, 9), min_size=1, max_size=2)),
        st.tuples(
            st.just("scale"), st.lists(st.sampled_from([-2, 0.5, 1, 3]), min_size=1, max_size=2)
        ),
        st.tuples(st.just("rotate"), st.lists(st.integers(-360, 360), min_size=1, max_size=1)),
        st.tuples(st.just("rotate"), st.lists(st.integers(-90, 90), min_size=3, max_size=3)),
        st.tuples(st.just("skewX"), st.lists(st.integers(-60, 60), min_size=1, max_size=1)),
        st.tuples(st.just("skewY"), st.lists(st.integers(-60, 60), min_size=1, max_size=1)),
        st.tuples(st.just("matrix"), st.lists(st.integers(-3, 3), min_size=6, max_size=6)),
    ),
    max_size=4,
)  # fmt: skip


@given(FUNCTIONS, st.sampled_from([" ", ",", ", ", ""]))
def test_transforms_are_products_from_the_left(functions, joint):
    text = joint.join(f"{name}({' '.join(map(str, values))})" for name, values in functions)
    matrix = svg_values.transform(text)
    theirs = svgpathtools.parser.parse_transform(text) if text else np.eye(3)
    a, b, c, d, e, f = matrix
    assert np.allclose([[a, c, e], [b, d, f], [0, 0, 1]], theirs, atol=1e-9)
    assert matrix.scale == pytest.approx(np.linalg.norm(theirs[:2, :2], 2), abs=1e-9)


@pytest.mark.parametrize(
    "text", ["rotate(1,2)", "scale()", "turn(3)", "rotate(3", "matrix(1 2)", "rotate(a)", "x", "3"]
)
def test_a_faulty_transform_is_passed_over_with_a_note(text):
    assert svg_values.transform(text) is None
    sketch = read(svg(f'<g transform="{text}">{RECT}</g>'))
    assert box(sketch) == [10, 55, 40, 60]
    assert sketch.notes == ("Transforms with a fault, passed over: 1.",)


def test_groups_pass_on_transforms_layers_and_what_is_hidden():
    body = f"""
    <g inkscape:groupmode="layer" inkscape:label="Cut" id="layer1" transform="translate(1,2)">
      <g transform="scale(2)">{RECT}</g>
      <g inkscape:groupmode="layer" id="inner"><line x2="1" id="short"/></g>
    </g>
    <g display="none">{RECT}</g>
    <g style="fill:red; DISPLAY : none !important">{RECT}</g>
    <g visibility="hidden"><path d="M0 0h1"/><path style="visibility:visible" d="M0 0h2"/></g>
    """
    sketch = read(svg(body))
    first, second, third = sketch.traces
    assert first.layer == "Cut"
    assert first.controls.min(axis=(0, 1)).tolist() == [21, 28]
    assert (second.layer, second.name) == ("inner", "short")
    assert third.nodes[1].tolist() == [2, 80]
    assert sketch.notes == ("Left out: 3 hidden.",)


def test_style_sheets_hide_by_class_id_and_tag():
    body = f"""<style>/* x{{}} */ .a, .b {{ display: none }} #c {{visibility:hidden}} .d{{fill:red}}
    circle {{ display: none; }}</style><g class="x a">{RECT}</g><rect id="c" width="1" height="1"/>
    <circle r="1"/><line class="d" x2="5"/>"""
    sketch = read(svg(body))
    assert len(sketch.traces) == 1
    assert sketch.notes == ("Left out: 3 hidden.",)


def test_names_are_labels_or_titles_or_ids():
    body = """<path id="a" d="M0 0h1"/><path id="b" d="M0 0h2"><title> A
    title </title></path><path inkscape:label="L" id="c" d="M0 0h3"><title>t</title></path>"""
    assert [trace.name for trace in read(svg(body)).traces] == ["a", "A title", "L"]


def test_what_is_no_geometry_is_counted():
    body = f"<text>a</text><text>b</text><image/><foreignObject>{RECT}</foreignObject>{RECT}"
    apart = f"<defs>{RECT}</defs><clipPath>{RECT}</clipPath><symbol>{RECT}</symbol>"
    sketch = read(svg(apart + body))
    assert len(sketch.traces) == 1
    assert sketch.notes[0] == "Left out: 2 text, 1 foreign object, 1 image."


def test_used_elements_stand_where_they_are_used():
    body = f"""<defs><g id="r" transform="scale(2)">{RECT}</g></defs>
    <use href="#r" x="1" y="2"/><use xlink:href="#r" transform="rotate(90)" id="turned"/>
    <use href="#nothing"/><use/><use href="other.svg#r"/>"""
    sketch = read(svg(body))
    assert [trace.controls.min(axis=(0, 1)).tolist() for trace in sketch.traces] == [
        [21, 28],
        [-50, 0],
    ]
    assert sketch.traces[1].name == "turned"
    assert sketch.notes == ("References that lead nowhere: 3.",)


def test_symbols_and_nested_drawings_have_a_view_of_their_own():
    body = f"""<symbol id="s" viewBox="10 20 30 5" preserveAspectRatio="none">{RECT}</symbol>
    <use href="#s" x="5" y="6" width="60" height="20"/>
    <svg x="10" y="10" width="50%" height="20" viewBox="10 20 30 5" preserveAspectRatio="none"
    >{RECT}</svg><svg width="0">{RECT}</svg>"""
    sketch = read(svg(body))
    boxes = [
        [*trace.controls.min(axis=(0, 1)), *trace.controls.max(axis=(0, 1))]
        for trace in sketch.traces
    ]
    assert boxes[0] == pytest.approx([5, 54, 65, 74])
    assert boxes[1] == pytest.approx([10, 50, 60, 70])


def test_a_faulty_path_is_drawn_up_to_its_fault_with_a_note():
    sketch = read(svg('<path d="M0 0L1 2L3"/><polyline points="0 0 1 1 2"/>'))
    assert [len(trace.controls) for trace in sketch.traces] == [1, 1]
    assert sketch.notes == ("Shapes with a fault in their data, drawn up to there: 2.",)


DAMAGED = "the file is damaged or cut off."
DECLARED = (
    ": it declares a document type of its own with entities or defaults, which can hide endless"
    ' work; save it as "plain SVG" first.'
)
EMPTY = ": there are no lines or curves in it."
BEYOND = f"{EMPTY} Shapes whose coordinates are not finite or beyond 1e+09 mm: 1."
WORDS = f"{EMPTY} Left out: 1 text. Convert texts to paths in the program that they come from."


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", f", line 1: this is no well-formed XML (no element found); {DAMAGED}"),
        ("<svg><path", f", line 1: this is no well-formed XML (unclosed token); {DAMAGED}"),
        ("<svg>\n<g>\n</svg>", f", line 3: this is no well-formed XML (mismatched tag); {DAMAGED}"),
        ("<html/>", ": it is no SVG drawing: its outermost element is <html>."),
        ("<svg/>", EMPTY),
        ("<svg><text>a</text></svg>", WORDS),
        ("<svg><path d='M0 0L1e999 3'/></svg>", BEYOND),
        ("<svg><path d='M0 0L1e300 3'/></svg>", BEYOND),
        ("<svg><g transform='scale(1e308)scale(9)'><path d='M0 0L1 3'/></g></svg>", BEYOND),
        (
            '<?xml version="1.0" encoding="klingon"?><svg/>',
            ": its text encoding is not known; save it in UTF-8.",
        ),
        ('<!DOCTYPE svg [<!ENTITY a "aa">]><svg>&a;</svg>', DECLARED),
        ('<!DOCTYPE svg [<!ATTLIST g a CDATA "b">]><svg/>', DECLARED),
        ('<!DOCTYPE svg [<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;]><svg/>', DECLARED),
    ],
)
def test_a_bad_file_is_refused_in_a_sentence(text, message):
    assert refusal(text) == message


def test_a_document_type_that_declares_nothing_is_passed_over():
    text = svg(RECT).replace(
        "<svg",
        '<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN"'
        ' "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd"><svg',
        1,
    )
    assert len(read(text).traces) == 1


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_encodings_are_read(encoding):
    text = f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig")}"?>'
    text += svg('<path id="Bézier" d="M0 0h1"/>')
    (trace,) = read(text.encode(encoding)).traces
    assert trace.name == "Bézier"


def test_a_million_laughs_in_use_elements_are_refused():
    ten = ["".join(f'<use href="#l{k}"/>' for _ in range(10)) for k in range(20)]
    levels = "".join(f'<g id="l{k + 1}">{ten[k]}</g>' for k in reversed(range(20)))
    message = refusal(svg(levels + f'<g id="l0">{RECT}</g>'))
    assert message.startswith(": it has more than 100,000 elements, repetitions included;")


def test_repeated_large_paths_are_refused_by_their_segments(monkeypatch):
    monkeypatch.setattr(budget, "MAX_SEGMENTS", 10_000)
    path = f'<path id="p" d="M0 0{"l1 1-2 3" * 1000}"/>'
    assert len(read(svg(path)).traces) == 1
    assert "more than 10,000 lines and curves" in refusal(svg(path + '<use href="#p"/>' * 10))


def test_references_in_a_circle_are_left_out():
    body = f'<g id="a"><use href="#b"/>{RECT}</g><g id="b"><use href="#a"/><line x2="1"/></g>'
    sketch = read(svg(body))
    assert sketch.notes == ("References that lead back to themselves, left out: 2.",)
    assert len(sketch.traces) == 6


def test_a_use_of_the_drawing_itself_is_left_out():
    sketch = read(svg(f'{RECT}<use href="#all"/>', MM + ' id="all"'))
    assert len(sketch.traces) == 2
    assert "References that lead back to themselves, left out: 1." in sketch.notes


def test_deep_groups_need_no_stack():
    deep = 99_000
    sketch = read(svg('<g transform="translate(1)">' * deep + '<line x2="3"/>' + "</g>" * deep))
    assert box(sketch) == [99_000, 80, 99_003, 80]


def test_more_elements_than_the_budget_are_refused_while_they_are_parsed():
    message = refusal(svg("<g/>" * 200_200))
    assert message.startswith(": it has more than 200,100 elements;")


def test_an_element_of_many_attributes_is_refused():
    words = " ".join(f'a{k}="1"' for k in range(600))
    assert refusal(svg(f"<g {words}/>")) == ": an element has more than 500 attributes."


@given(st.integers(0, 2**32 - 1))
def test_resvg_paints_where_we_read(seed):
    """The box of what a renderer paints is that of our sketch, to a pixel and half a line."""
    rng = np.random.default_rng(seed)
    turn, skew = rng.integers(-180, 180), rng.integers(-40, 40)
    x, y, w, h = rng.integers(20, 60, 4)
    body = f"""<defs><g id="u"><rect x="{x}" y="{y}" width="{w}" height="{h}" rx="5"/></g></defs>
    <g transform="translate(150 150) rotate({turn}) skewX({skew})"><use href="#u" x="-50" y="-60"/>
    <path d="M0 0a{w} {h} {skew} 1 1 20 10zq{x} 9 {y} 30t5 9z"/></g>
    <svg x="150" y="120" width="60" height="90" viewBox="0 0 {w} {h}" overflow="visible">
    <circle r="9" cx="20" cy="15"/></svg>"""
    line = 'fill="none" stroke="#000" stroke-width="0.3" stroke-linejoin="round"'
    text = svg(body, f'width="400" height="400" viewBox="0 0 400 400" {line}')
    sketch = read(text)
    picture = resvg_py.svg_to_bytes(svg_string=text)
    ink = _ink(bytes(picture))
    rows, columns = np.nonzero(ink)
    dense = np.concatenate([_points(trace.controls) for trace in sketch.traces]) / PX
    x, y = dense[:, 0], 400 - dense[:, 1]
    inside = (x > 0) & (x < 400) & (y > 0) & (y < 400)
    if not inside.all():
        return
    seen = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
    assert np.abs(np.array([x.min(), y.min(), x.max(), y.max()]) - seen).max() <= 2


def _points(controls):
    t = np.linspace(0, 1, 30)[:, None]
    a, b, c, d = (controls[:, i, None] for i in range(4))
    found = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    return found.reshape(-1, 2)


def _ink(png):
    """Where a picture is not transparent."""
    from PySide6.QtGui import QImage

    image = QImage.fromData(png).convertToFormat(QImage.Format.Format_RGBA8888)
    pixels = np.frombuffer(image.constBits(), dtype=np.uint8)
    return pixels.reshape(image.height(), image.bytesPerLine())[:, 3::4][:, : image.width()] > 0


def test_angles_of_full_quarters_are_exact():
    matrix = svg_values.transform("rotate(90)rotate(-450)")
    assert [*matrix] == [1, 0, 0, 1, 0, 0]
    assert math.isnan(svg_values.transform("rotate(1e999)").a)
