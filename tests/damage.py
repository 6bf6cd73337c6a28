"""Files of other programs for the readers, and seeded damage to them."""

import io
import random
import re
from functools import cache

import ezdxf

NASTY = [
    b"nan", b"inf", b"-1e308", b"1e999", b"", b"0", b"-1", b"99999999999", b"\xff\xfe", b"1e-320",
]  # fmt: skip


@cache
def svg(seed):
    """An SVG with something of everything."""
    rng = random.Random(seed)
    n = lambda: f"{rng.uniform(-90, 90):.3f}"  # noqa: E731
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="120mm" height="80mm"
 viewBox="0 0 120 80"><style>.a{{display:none}} #z{{visibility:hidden}}</style>
<defs><g id="u"><path id="p" d="M{n()} {n()}C{n()},{n()} {n()} {n()},{n()},{n()}z"/></g>
<symbol id="s" viewBox="0 0 9 9"><circle cx="4" cy="5" r="3"/></symbol></defs>
<g inkscape:groupmode="layer" inkscape:label="Cut" transform="rotate({n()}) scale(1.5,-2)">
<use xlink:href="#u" x="{n()}"/><use href="#s" width="20" height="30"/><g class="a"/>
<text>t</text><path d="m{n()},{n()}a5 9 {n()} 0110 {n()}q{n()} 1 2-3t.5.5s1 2 3 4h{n()}v9z
L{n()} {n()}"/></g>
<rect x="1" y="2" width="{abs(float(n()))}" height="9" rx="2" id="z"/><ellipse rx="9" ry="{n()}"/>
<svg x="3" width="50%" viewBox="0 0 10 10"><line x2="{n()}" y2="3"/>
<polygon points="1,2 {n()},4 5 6 7,{n()}"/></svg><polyline points="{n()} 1 2 {n()}"/></svg>
""".encode()


@cache
def dxf(seed):
    """A DXF with something of everything, as ezdxf writes it, without the parts nobody draws."""
    rng = random.Random(seed)
    n = lambda: round(rng.uniform(-90, 90), 3)  # noqa: E731
    drawing = ezdxf.new(rng.choice(["R12", "R2000", "R2010"]), setup=False, units=4)
    space = drawing.modelspace()
    drawing.layers.add("off").off()
    block = drawing.blocks.new("B", base_point=(n(), n()))
    block.add_arc((n(), n()), abs(n()) + 1, n(), n())
    corners = [(n(), n(), n()), (n(), n(), 0), (n(), n(), 1)]
    if drawing.dxfversion == "AC1009":
        block.add_polyline2d(corners, format="xyb", close=True)
    else:
        block.add_lwpolyline(corners, format="xyb", close=True)
    array = {"rotation": n(), "xscale": 2, "column_count": 3, "column_spacing": 9}
    space.add_blockref("B", (n(), n()), dxfattribs=array)
    space.add_line((0, 0), (9, n()))
    space.add_line((9, 9), (0, 0))
    space.add_circle((n(), n()), 4, dxfattribs={"extrusion": (0, 0, -1)})
    space.add_polyline2d([(n(), n(), 0.5), (n(), n(), 0), (n(), n(), 0)], format="xyb")
    space.add_polyline3d([(n(), n(), n()), (n(), n(), n())])
    space.add_text("words", dxfattribs={"layer": "off"})
    if drawing.dxfversion > "AC1009":
        space.add_ellipse((n(), n()), (n(), n()), 0.5, 0, 3)
        space.add_open_spline([(n(), n()) for _ in range(6)], degree=rng.choice([2, 3, 5]))
        space.add_rational_spline([(n(), n()) for _ in range(5)], [1, 2, 3, 2, 1])
        space.add_spline([(n(), n()) for _ in range(4)])
    text = io.StringIO()
    drawing.write(text)
    whole = text.getvalue()
    # Most of the file is tables that no reader of curves looks at; hits there would test nothing.
    start = whole.find("BLOCKS") if rng.random() < 0.9 else 0
    end = whole.find("OBJECTS")
    head = "0\nSECTION\n2\n" if start else ""
    return (head + whole[max(start, 0) : end if end > 0 else None]).encode()


def damaged(data, seed):
    """The same file with one to four faults of one of many kinds.

    Most damage to XML ends its reading at once, so seven of ten times it is done to attributes.
    """
    rng = random.Random(seed)
    if not data.startswith(b"<") or rng.random() < 0.3:
        return _damaged(data, rng)
    value = rng.choice(list(re.finditer(rb'="([^"]{3,})"', data)))
    bad = re.sub(rb'[<>&"\x00-\x1f\x7f-\xff]', b" ", _damaged(value[1], rng))
    return data[: value.start(1)] + bad + data[value.end(1) :]


def _damaged(data, rng):
    for _ in range(rng.choice([1, 1, 2, 4])):
        if not data:
            return data
        kind = rng.randrange(7)
        low = rng.randrange(len(data))
        high = min(len(data), low + rng.choice([1, 5, 40, 400]))
        if kind == 0:
            data = data[:low] + bytes([data[low] ^ 1 << rng.randrange(8)]) + data[low + 1 :]
        elif kind == 1:
            data = data[:low]
        elif kind == 2:
            data = data[:high] + data[low:high] * rng.choice([1, 2, 50]) + data[high:]
        elif kind == 3:
            data = data[:low] + data[high:]
        elif kind == 4:
            other = rng.randrange(len(data))
            data = data[:low] + data[other : other + high - low] + data[high:]
        else:
            words = data.split(b"\n" if rng.random() < 0.5 else b" ")
            joint = b"\n" if len(data.split(b"\n")) == len(words) else b" "
            place, other = rng.randrange(len(words)), rng.randrange(len(words))
            if kind == 5:
                words[place], words[other] = words[other], words[place]
            else:
                words[place] = rng.choice(NASTY)
            data = joint.join(words)
    return data
