import io
import math

import ezdxf
import numpy as np
import pytest
from ezdxf import path as ezpath
from ezdxf.disassemble import recursive_decompose
from ezdxf.math import Matrix44
from hypothesis import given
from hypothesis import strategies as st

from core.errors import FileError
from core.formats import budget, dxf_tags, read_dxf
from effort import costly

NAME = read_dxf.Path("drawing.dxf")


def new(version="R2000", units=4):
    return ezdxf.new(version, setup=False, units=units)


def written(drawing):
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode("utf-8", "surrogateescape")


def read(source):
    if isinstance(source, str):
        source = source.encode()
    return read_dxf.decode(source if isinstance(source, bytes) else written(source), NAME)


def refusal(source):
    with pytest.raises(FileError) as caught:
        read(source)
    return str(caught.value).removeprefix("drawing.dxf")


def tags(*pairs):
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def entities(*pairs, header=()):
    return tags(
        (0, "SECTION"), (2, "HEADER"), *header, (0, "ENDSEC"),
        (0, "SECTION"), (2, "ENTITIES"), *pairs, (0, "ENDSEC"), (0, "EOF"),
    )  # fmt: skip


LINE = ((0, "LINE"), (8, "0"), (10, 1), (20, 2), (11, 4), (21, 6))


def box(sketch):
    return [*sketch.low.tolist(), *sketch.high.tolist()]


def points_on(controls, count=12):
    t = np.linspace(0, 1, count)[:, None]
    a, b, c, d = (controls[:, i, None] for i in range(4))
    found = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
    return found.reshape(-1, 2)


def seen_by_ezdxf(drawing, gap=0.001):
    """Points of all curves as ezdxf draws them, seen from above."""
    found = []
    for entity in recursive_decompose(drawing.modelspace()):
        if entity.dxftype() == "SPLINE":  # its path is too coarse
            curve = entity.construction_tool().approximate(700)
            found.append(np.array([point.xyz[:2] for point in curve]))
            continue
        try:
            whole = ezpath.make_path(entity)
        except TypeError:
            continue
        found += [
            np.array([point.xyz[:2] for point in part.flattening(gap, 8)])
            for part in whole.sub_paths()
        ]
    return found


def distances(points, polylines):
    """Distance of each point from the nearest of some polylines."""
    best = np.full(len(points), np.inf)
    for line in polylines:
        a, step = line[:-1], np.diff(line, axis=0)
        size = np.maximum((step**2).sum(axis=1), 1e-300)
        share = np.clip(((points[:, None] - a) * step).sum(axis=2) / size, 0, 1)
        gaps = points[:, None] - a - share[..., None] * step
        best = np.minimum(best, np.hypot(gaps[..., 0], gaps[..., 1]).min(axis=1))
    return best


def assert_same_as_ezdxf(drawing, tolerance=0.004):
    sketch = read(drawing)
    theirs = seen_by_ezdxf(drawing)
    ours = [points_on(trace.controls) for trace in sketch.traces]
    assert distances(np.concatenate(ours), theirs).max() <= tolerance
    fine = [points_on(trace.controls, 60) for trace in sketch.traces]
    assert distances(np.concatenate(theirs), fine).max() <= tolerance
    return sketch


def cubic_error(corners, bulges):
    """Largest error of ezdxf's cubics for the arcs of a polyline: one for a quarter of a circle.

    It is 2.8e-4 of the radius for a quarter, and falls by the sixth power of the angle.
    """
    chords = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    bulges = np.maximum(np.abs(bulges), 1e-9)
    radii = chords * (1 + bulges**2) / (4 * bulges)
    quarters = 4 * np.arctan(bulges) / (np.pi / 2)
    return (2.8e-4 * radii * np.minimum(quarters, 1) ** 6).max()


def test_each_kind_of_entity_is_drawn_as_ezdxf_draws_it():
    drawing = new()
    space = drawing.modelspace()
    space.add_line((0, 0), (10, 5))
    space.add_arc((20, 0), 5, 300, 45)
    space.add_circle((40, 0), 5)
    space.add_ellipse((60, 0), (6, 3), 0.4)
    space.add_ellipse((80, 0), (6, 3), 0.4, 1, 5.5)
    space.add_lwpolyline([(0, 20, 0.5), (10, 20, 0), (10, 30, -2)], format="xyb", close=True)
    space.add_lwpolyline([(20, 20, 1), (30, 20, 0.01)], format="xyb")
    space.add_polyline2d([(40, 20, 0.3), (50, 20, 0), (50, 30, 0)], format="xyb", close=True)
    space.add_polyline3d([(60, 20, 0), (70, 20, 0), (70, 30, 0)])
    space.add_open_spline([(0, 40), (10, 60), (20, 30), (30, 50), (40, 40)])
    space.add_open_spline([(50, 40), (60, 60), (70, 30), (80, 50), (90, 40), (95, 44)], degree=5)
    space.add_rational_spline([(0, 70), (10, 90), (20, 60), (30, 80)], [1, 2, 0.5, 1])
    sketch = assert_same_as_ezdxf(drawing)
    assert sketch.notes == ()
    assert [trace.closed for trace in sketch.traces] == [
        False, False, True, True, False, True, False, True, False, False, False, False,
    ]  # fmt: skip
    assert max(trace.deviation for trace in sketch.traces) <= read_dxf.DEVIATION_MM * 1.001


@pytest.mark.parametrize("version", ["R12", "R2000", "R2004", "R2007", "R2010", "R2018"])
def test_all_versions_are_read(version):
    drawing = new(version)
    drawing.layers.add("Schnitt")
    drawing.modelspace().add_line((1, 2), (4, 6), dxfattribs={"layer": "Schnitt"})
    (trace,) = read(drawing).traces
    assert trace.nodes.tolist() == [[1, 2], [4, 6]]
    assert trace.layer == "Schnitt"


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("pad", ["", "  ", "   \t"])
def test_lines_may_end_and_be_indented_in_any_way(newline, pad):
    text = entities(*LINE)
    lines = [pad + line if k % 2 == 0 else line for k, line in enumerate(text.split("\n"))]
    (trace,) = read(newline.join(lines)).traces
    assert trace.nodes.tolist() == [[1, 2], [4, 6]]


@pytest.mark.parametrize(
    ("header", "unit", "is_known", "mm"),
    [
        (((9, "$INSUNITS"), (70, 4)), "mm", True, 1),
        (((9, "$INSUNITS"), (70, 1)), "in", True, 25.4),
        (((9, "$INSUNITS"), (70, 2)), "ft", True, 304.8),
        (((9, "$INSUNITS"), (70, 5)), "cm", True, 10),
        (((9, "$INSUNITS"), (70, 6)), "m", True, 1000),
        (((9, "$INSUNITS"), (70, 13)), "µm", True, 0.001),
        (((9, "$INSUNITS"), (70, 10)), "mm", True, 914.4),
        (((9, "$INSUNITS"), (70, 4), (9, "$MEASUREMENT"), (70, 0)), "mm", True, 1),
        (((9, "$INSUNITS"), (70, 0), (9, "$MEASUREMENT"), (70, 0)), "in", False, 25.4),
        (((9, "$INSUNITS"), (70, 0), (9, "$MEASUREMENT"), (70, 1)), "mm", False, 1),
        (((9, "$INSUNITS"), (70, 99)), "mm", False, 1),
        (((9, "$INSUNITS"), (70, "x")), "mm", False, 1),
        ((), "mm", False, 1),
    ],
)
def test_units_are_honoured_and_guesses_are_told(header, unit, is_known, mm):
    sketch = read(entities(*LINE, header=header))
    assert (sketch.unit, sketch.is_unit_known) == (unit, is_known)
    assert box(sketch) == pytest.approx([mm, 2 * mm, 4 * mm, 6 * mm], rel=1e-15)


def test_inches_are_approximated_as_finely_as_millimetres():
    drawing = new(units=1)
    drawing.modelspace().add_circle((0, 0), 10)
    (trace,) = read(drawing).traces
    assert trace.deviation <= read_dxf.DEVIATION_MM
    assert np.abs(np.hypot(*points_on(trace.controls).T) - 254).max() <= trace.deviation + 1e-12


@given(
    bulges=st.lists(
        st.one_of(st.just(0.0), st.floats(-3, 3), st.floats(-1e-9, 1e-9)), min_size=2, max_size=6
    ),
    closed=st.booleans(),
    seed=st.integers(0, 999),
)
def test_bulges_are_the_arcs_that_ezdxf_makes_of_them(bulges, closed, seed):
    rng = np.random.default_rng(seed)
    corners = rng.integers(-20, 20, (len(bulges), 2))
    if (np.diff(corners, axis=0) == 0).all(axis=1).any() or (corners[0] == corners[-1]).all():
        return
    drawing = new()
    rows = [(x, y, b) for (x, y), b in zip(corners.tolist(), bulges, strict=True)]
    drawing.modelspace().add_lwpolyline(rows, format="xyb", close=closed)
    (trace,) = assert_same_as_ezdxf(drawing, 0.002 + cubic_error(corners, bulges)).traces
    assert trace.closed == closed


@costly
@given(
    st.lists(
        st.tuples(
            st.floats(-180, 180), st.sampled_from([1, 2, -1, 0.5]), st.sampled_from([1, -1, 3]),
            st.sampled_from([(0, 0, 1), (0, 0, -1)]), st.integers(1, 3), st.integers(1, 2),
        ),
        min_size=1,
        max_size=3,
    )
)  # fmt: skip
def test_blocks_in_blocks_stand_where_ezdxf_puts_them(inserts):
    drawing = new()
    block = drawing.blocks.new("B0", base_point=(1, 2))
    block.add_lwpolyline([(0, 0, 0.5), (5, 0, 0), (5, 3, 0)], format="xyb", close=True)
    block.add_circle((2, 2), 1)
    places = [block]
    for level, (turn, sx, sy, normal, columns, rows) in enumerate(inserts, 1):
        places.append(drawing.blocks.new(f"B{level}", base_point=(level, -level)))
        places[-1].add_blockref(
            f"B{level - 1}",
            (3, 4),
            dxfattribs={
                "rotation": turn, "xscale": sx, "yscale": sy, "extrusion": normal,
                "column_count": columns, "row_count": rows,
                "column_spacing": 11, "row_spacing": 7,
            },
        )  # fmt: skip
    drawing.modelspace().add_blockref(f"B{len(inserts)}", (10, 20))
    # ezdxf's own explosion bends arcs that are sheared; its matrices are exact.
    maps = [Matrix44()]
    for holder in (drawing.modelspace(), *reversed(places[1:])):
        (reference,) = holder.query("INSERT")
        single = list(reference.multi_insert()) or [reference]
        maps = [one.matrix44() @ outer for outer in maps for one in single]
    sketch = read(drawing)
    assert {trace.name for trace in sketch.traces} == {f"B{len(inserts)}"}
    assert len(sketch.traces) == 2 * len(maps)
    curves = [np.array([p.xyz for p in ezpath.make_path(e).flattening(0.1)]) for e in block]
    for (one, index), trace in zip(
        ((one, index) for one in maps for index in (0, 1)), sketch.traces, strict=True
    ):
        exact = np.array([point.xyz[:2] for point in one.transform_vertices(curves[index])])
        assert distances(exact, [points_on(trace.controls, 60)]).max() <= 0.02


def test_arrays_are_mirrored_with_the_block_that_they_stand_in():
    row = insert("A", (71, 2), (45, 7))
    text = blocks(("A", LINE), ("B", row)) + entities(*insert("B", (42, -1)))
    assert box(read(text)) == [3, -13, 6, -2]


def test_entities_upside_down_are_mirrored():
    drawing = new()
    space = drawing.modelspace()
    below = {"extrusion": (0, 0, -1)}
    space.add_arc((10, 5), 3, 0, 90, dxfattribs=below)
    space.add_lwpolyline([(30, 0, 1), (40, 0, 0), (40, 9, 0)], format="xyb", dxfattribs=below)
    space.add_circle((60, 1), 4, dxfattribs=below)
    space.add_ellipse((80, 0), (6, 3), 0.4, 1, 3, dxfattribs=below)
    sketch = assert_same_as_ezdxf(drawing)
    assert sketch.high[0] < 90
    assert sketch.notes == ()


def test_tilted_and_rising_entities_are_seen_from_above_with_a_note():
    drawing = new()
    space = drawing.modelspace()
    space.add_circle((0, 0, 5), 3, dxfattribs={"extrusion": (0, 1, 1)})
    space.add_polyline3d([(20, 0, 0), (30, 0, 5), (30, 9, 9)])
    space.add_line((40, 0, 0), (50, 0, 9))
    space.add_ellipse((60, 0, 1), (3, 0, 3), 0.5, dxfattribs={"extrusion": (-1, 0, 1)})
    sketch = assert_same_as_ezdxf(drawing)
    assert sketch.notes == ("Entities with heights, seen from above: 4.",)


def test_what_is_hidden_or_no_curve_is_counted():
    drawing = new()
    drawing.layers.add("off").off()
    drawing.layers.add("frozen").freeze()
    space = drawing.modelspace()
    for layer in ("off", "frozen", "OFF", "0"):
        space.add_line((0, 0), (1, 1), dxfattribs={"layer": layer})
    space.add_line((0, 0), (1, 1), dxfattribs={"invisible": 1})
    space.add_text("words")
    space.add_hatch()
    space.add_point((0, 0))
    drawing.paperspace().add_line((0, 0), (1, 1))
    sketch = read(drawing)
    assert len(sketch.traces) == 1
    assert sketch.notes[0].startswith("Left out: 4 hidden, 1 HATCH, 1 POINT, 1 TEXT")


def test_layer_0_of_a_block_is_the_layer_of_the_insert():
    drawing = new()
    drawing.layers.add("cut")
    block = drawing.blocks.new("B")
    block.add_line((0, 0), (1, 0))
    block.add_line((0, 1), (1, 1), dxfattribs={"layer": "own"})
    drawing.modelspace().add_blockref("B", (0, 0), dxfattribs={"layer": "cut"})
    assert [trace.layer for trace in read(drawing).traces] == ["cut", "own"]


def test_loose_lines_and_arcs_become_a_closed_contour():
    drawing = new()
    space = drawing.modelspace()
    space.add_line((0, 0), (10, 0))
    space.add_arc((10, 5), 5, -90, 90)
    space.add_line((0, 10), (10, 10))
    space.add_line((0, 10), (0, 0))
    sketch = read(drawing)
    (trace,) = sketch.traces
    assert trace.closed
    assert sketch.notes == ("4 lines and curves that meet were joined into 1 contour.",)
    assert trace.deviation <= 1.01 * read_dxf.DEVIATION_MM


def test_splines_through_points_are_drawn_with_a_note():
    drawing = new()
    drawing.modelspace().add_spline([(0, 0), (5, 5), (10, 0), (20, 3)])
    sketch = read(drawing)
    assert "SPLINE given by points on it" in sketch.notes[0]
    nodes = sketch.traces[0].nodes
    for point in [(0, 0), (5, 5), (10, 0), (20, 3)]:
        assert np.hypot(*(nodes - point).T).min() < 1e-9


def test_vertices_that_a_curve_was_fitted_to_are_left_out():
    vertices = [(0, 0, 16), (5, 9, 16), (0, 0, 8), (4, 4, 8), (9, 0, 8)]
    body = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, 4)]
    for x, y, flag in vertices:
        body += [(0, "VERTEX"), (8, "0"), (10, x), (20, y), (70, flag)]
    (trace,) = read(entities(*body, (0, "SEQEND"))).traces
    assert trace.nodes.tolist() == [[0, 0], [4, 4], [9, 0]]


def test_names_are_read_in_the_encoding_of_the_file():
    words = "Größe"
    page = (9, "$DWGCODEPAGE")
    plain = entities(*altered(LINE, 8, words), header=(page, (3, "ANSI_1252")))
    escaped = plain.replace(words, "Gr\\U+00F6\\U+00DFe")
    for text in (plain.encode("cp1252"), plain.encode(), escaped.encode()):
        assert read(text).traces[0].layer == words
    japanese = entities(*altered(LINE, 8, "線"), header=(page, (3, "ANSI_932")))
    assert read(japanese.encode("cp932")).traces[0].layer == "線"


SPLINE = (
    (0, "SPLINE"), (8, "0"), (70, 8), (71, 3), (72, 8), (73, 4),
    *[(40, k) for k in (0, 0, 0, 0, 1, 1, 1, 1)],
    *[pair for x in range(4) for pair in ((10, x), (20, x * x))],
)  # fmt: skip


def altered(pairs, code, value):
    """The same tags with another value for the first of a code."""
    place = next(k for k, pair in enumerate(pairs) if pair[0] == code)
    return (*pairs[:place], (code, value), *pairs[place + 1 :])


@pytest.mark.parametrize(
    "bad",
    [
        altered(SPLINE, 10, "nan"),
        altered(SPLINE, 20, "inf"),
        altered(SPLINE, 10, "-1.#IND"),
        altered(SPLINE, 71, 0),
        altered(SPLINE, 71, -3),
        altered(SPLINE, 71, 10**9),
        altered(SPLINE, 71, "1e400"),
        altered(SPLINE, 40, "5"),
        tuple(pair if pair[0] != 40 else (40, 1) for pair in SPLINE),
        SPLINE[:-3],
        ((0, "SPLINE"), (71, 3)),
        ((0, "SPLINE"), (71, 3), (11, 0), (21, 0), (11, 0), (21, 0)),
        altered(LINE, 10, "nan"),
        altered(LINE, 11, "inf"),
        altered(LINE, 20, "two"),
        altered(LINE, 20, ""),
        altered(LINE, 20, "1e300"),
        ((0, "CIRCLE"), (10, 0), (20, 0), (40, 0)),
        ((0, "CIRCLE"), (10, 0), (20, 0), (40, "nan")),
        ((0, "CIRCLE"), (10, 0), (20, 0), (40, "1e308")),
        ((0, "ARC"), (40, 3), (50, "inf")),
        ((0, "ELLIPSE"), (11, 0), (21, 0)),
        ((0, "ELLIPSE"), (11, 1), (40, "nan")),
        ((0, "LWPOLYLINE"), (10, 1), (20, 1), (10, 2)),
        ((0, "LWPOLYLINE"), (10, 1), (20, "nan"), (10, 2), (20, 3)),
        ((0, "LWPOLYLINE"), (10, 1), (20, 1), (42, "1e300"), (10, 2), (20, 3)),
        ((0, "LWPOLYLINE"), (90, 10**9)),
        ((0, "POLYLINE"), (66, 1), (70, 64), (0, "VERTEX"), (10, 1), (0, "SEQEND")),
        ((0, "POLYLINE"), (66, 1)),
        ((0, "INSERT"), (2, "nothing")),
        ((0, "INSERT"), (2, "nothing"), (70, 10**9), (71, 10**9)),
        ((0, "MTEXT"), (1, "words")),
    ],
)
def test_a_bad_entity_costs_nothing_but_itself(bad):
    sketch = read(entities(*bad, *LINE))
    assert box(sketch) == [1, 2, 4, 6]
    if bad[0][1] not in ("LWPOLYLINE", "POLYLINE") or len(bad) > 2:
        assert sketch.notes
    assert refusal(entities(*bad)).startswith(": there are no lines or curves in it.")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", ": the file is empty."),
        (b" \r\n", ": the file is empty."),
        (b"AC1015\0\0\0\0\0\1", ": it is a DWG, which only CAD programs read; save it as a DXF."),
        (b"AC1032" + bytes(99), ": it is a DWG, which only CAD programs read; save it as a DXF."),
        (b"AutoCAD Binary DXF\r\n\x1a\0", ": it is a binary DXF; save it as an ASCII DXF."),
        (b"hello\nworld\n", ", line 1: it is no DXF: it does not begin with a group code."),
        (bytes(99), ", line 1: it is no DXF: it does not begin with a group code."),
        (b"0\n", ", line 1: it is no DXF: it does not begin with a group code."),
        (entities().encode(), ": there are no lines or curves in it."),
        (
            b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n1\n",
            ", line 9: the file is damaged or cut off here.",
        ),
        (b"999\nremark\n0\nEOF\n", ": there are no lines or curves in it."),
    ],
)  # fmt: skip
def test_a_bad_file_is_refused_in_a_sentence(data, message):
    assert refusal(data) == message


def test_a_file_that_is_cut_off_is_read_up_to_there_with_a_note():
    whole = entities(*LINE, *LINE, *altered(LINE, 10, 3)).encode()
    cut = whole[: whole.rfind(b"LINE") + 12]
    sketch = read(cut)
    assert len(sketch.traces) == 2
    assert sketch.notes[0].startswith("The file is damaged or cut off at line ")
    assert sketch.notes[0].endswith("what stands before was read: 2 entities.")


def test_a_damaged_group_code_ends_the_reading_at_its_line():
    lines = entities(*LINE, *LINE).split("\n")
    place = len(lines) - 9
    assert place % 2 == 0
    lines[place] = "xx"
    sketch = read("\n".join(lines))
    assert len(sketch.traces) == 1
    assert f"line {place + 1:,};" in sketch.notes[0]


def blocks(*names_and_bodies):
    body = [(0, "SECTION"), (2, "BLOCKS")]
    for name, inner in names_and_bodies:
        body += [(0, "BLOCK"), (2, name), (10, 0), (20, 0), *inner, (0, "ENDBLK")]
    return tags(*body, (0, "ENDSEC"))


def insert(name, *more):
    return ((0, "INSERT"), (8, "0"), (2, name), (10, 1), (20, 0), *more)


def test_blocks_in_a_circle_are_left_out():
    text = blocks(("A", (*insert("B"), *LINE)), ("B", (*insert("a"), *insert("A"))))
    sketch = read(text + entities(*insert("A")))
    assert "INSERT of a block into itself, left out: 2." in sketch.notes
    assert box(sketch) == [2, 2, 5, 6]


def test_exponential_blocks_are_refused():
    levels = [(f"L{k}", 10 * insert(f"L{k - 1}")) for k in range(1, 40)]
    text = blocks(("L0", LINE), *levels)
    message = refusal(text + entities(*insert("L39")))
    assert message.startswith(": it has more than 100,000 elements")
    # The same without anything that is drawn.
    text = blocks(("L0", ((0, "TEXT"), (1, "x"))), *levels)
    message = refusal(text + entities(*insert("L39")))
    assert message.startswith(": it has more than 100,000 elements")


def test_a_deep_tower_of_blocks_is_cut_with_a_note():
    levels = [(f"L{k}", (*insert(f"L{k - 1}"), *LINE)) for k in range(1, 5000)]
    sketch = read(blocks(("L0", LINE), *levels) + entities(*insert("L4999")))
    assert "INSERT of a block into itself, left out: 1." in sketch.notes


@pytest.mark.parametrize("count", ["1000000000", "1e300", "100001"])
def test_endless_arrays_are_refused(count):
    text = blocks(("A", LINE)) + entities(*insert("A", (70, count), (71, count)))
    assert refusal(text).startswith(": it has more than 100,000 elements")


def test_more_entities_than_the_budget_are_refused(monkeypatch):
    monkeypatch.setattr(budget, "MAX_ELEMENTS", 1000)
    assert len(read(entities(*LINE * 1000)).traces) == 1000
    assert refusal(entities(*LINE * 1001)).startswith(": it has more than 1,000 elements")


def test_more_vertices_than_the_budget_are_refused_before_they_are_read(monkeypatch):
    monkeypatch.setattr(budget, "MAX_SEGMENTS", 1000)
    vertices = [pair for k in range(1001) for pair in ((10, k), (20, k % 7))]
    assert "more than 1,000 lines" in refusal(entities((0, "LWPOLYLINE"), (8, "0"), *vertices))
    text = blocks(("A", ((0, "LWPOLYLINE"), (8, "0"), *vertices[:400])))
    assert "more than 1,000 lines" in refusal(text + entities(*insert("A", (70, 9), (44, 1))))


def test_more_records_than_admitted_are_refused(monkeypatch):
    monkeypatch.setattr(dxf_tags, "MAX_RECORDS", 10)
    assert "more than 10 records" in refusal(entities(*LINE * 10))


def test_long_polylines_are_read_in_bulk_as_they_stand():
    points = np.random.default_rng(1).integers(-9999, 9999, (30_000, 2)) / 8
    heavy = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, 1)]
    light = [(0, "LWPOLYLINE"), (8, "0"), (90, len(points)), (70, 1)]
    for x, y in points.tolist():
        heavy += [(0, "VERTEX"), (8, "0"), (10, x), (20, y)]
        light += [(10, x), (20, y)]
    sketch = read(entities(*heavy, (0, "SEQEND"), *light))
    for trace in sketch.traces:
        assert trace.closed
        assert trace.nodes.tobytes() == points.tobytes()


@given(st.integers(-(10**6), 10**6), st.integers(1, 10**6))
def test_arcs_end_where_their_angles_say(first, width):
    angle, turn = first / 1000, width % 359_000 / 1000 + 0.5
    drawing = new()
    drawing.modelspace().add_arc((7, -3), 10, angle, angle + turn)
    (trace,) = read(drawing).traces
    for corner, degrees in ((trace.controls[0, 0], angle), (trace.controls[-1, 3], angle + turn)):
        across, up = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        assert corner == pytest.approx([7 + 10 * across, 10 * up - 3], abs=1e-9)
    radii = np.hypot(*(points_on(trace.controls) - [7, -3]).T)
    assert np.abs(radii - 10).max() <= trace.deviation + 1e-12


def test_more_lines_than_admitted_are_refused(monkeypatch):
    monkeypatch.setattr(dxf_tags, "MAX_LINES", 10)
    assert refusal(entities(*LINE)).startswith(": it has more than 10 lines")
