"""Things on the sheet: no ink outside the box, and in a region the ink of the whole."""

import numpy as np
import pytest
from PySide6.QtGui import QColor, QFont, QImage, QPainter, QRegion

from app.ink import Band, Stroke, Words
from app.line import LONG, WHOLE, Line, line_of, ribbon_of, stride_of
from app.signs import Dots, Grip, Handles, Ring
from app.style import LIGHT
from core.runs import Runs

SIDE = 240


def curve(count, centre=(120.0, 120.0), radius=80.0):
    angle = np.linspace(0, 2 * np.pi, count + 1)
    waves = radius + 0.3 * radius * np.sin(5 * angle)
    vertices = centre + waves[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    runs = Runs(vertices, np.arange(count + 1.0), np.array([0, count + 1]), 0.0)
    return line_of(runs, count, stride_of(runs))


def opened(line):
    """The same without its last vertices."""
    count = len(line.t) - 40
    return Line(line.vertices[:count], line.t[:count], np.array([0, count]))


def ribbon(shift=0.0, scale=1.0):
    """A line as broad as it says itself, open and with sharp corners too."""
    vertices = np.concatenate([curve(50).vertices[:31], [(60.0, 190.0), (75.0, 100.0)]])
    halves = 9 * np.sin(np.linspace(0.1, 3.0, len(vertices)))
    middle = vertices[5]
    return ribbon_of(scale * (vertices - middle) + middle + shift, halves)


def things():
    places = np.random.default_rng(0).uniform(20, 220, (60, 2))
    names = np.arange(60)
    ink = "#123456"
    yield "short wide", Stroke(curve(90), ink, 2.0)
    yield "wide", Stroke(curve(300), ink, 2.0)
    yield "wide and open", Stroke(opened(curve(300)), ink, 5.0, 0.5)
    yield "long wide", Stroke(curve(2000), ink, 2.0)
    yield "thin", Stroke(curve(30), ink, 1.0, 0.8, True)
    yield "long thin", Stroke(curve(2000), ink, 1.0, 1.0, True)
    yield "ribbon", Stroke(ribbon(), ink, 0.0, 0.34)
    yield "huge ribbon", Stroke(ribbon(0.0, 1e4), ink, 0.0, 0.34)
    yield "handles", Handles(names, places, ink, "#ffffff", 3.5, 1.0)
    yield "dots", Dots(names, places, ink)
    yield "ring", Ring(50.3, 60.8, ink, 1.0)
    yield "grip", Grip(50.3, 60.8, ink, "#ffffff")
    yield "band", Band(30.5, 40.2, 150.9, 170.0, ink)
    yield "words", Words("Words", QFont(), (50.5, 60.0, 150.0, 90.0), ink, LIGHT)


THINGS = dict(things())


def painted(thing, region, image=None):
    """A picture of a thing, painted for a region and cut to it."""
    if image is None:
        image = QImage(SIDE, SIDE, QImage.Format.Format_RGB32)
        image.fill(QColor("white"))
    with QPainter(image) as painter:
        painter.setClipRegion(region)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        x, y, wide, high = region.boundingRect().getRect()
        thing.paint(painter, (x, y, x + wide, y + high))
    flat = np.frombuffer(image.constBits(), dtype=np.uint8)
    return flat.reshape(SIDE, SIDE, 4).copy()


def whole():
    return QRegion(0, 0, SIDE, SIDE)


@pytest.fixture(autouse=True)
def application(qapp):
    return qapp


@pytest.mark.parametrize("name", THINGS)
def test_there_is_no_ink_outside_the_box(name):
    thing = THINGS[name]
    picture = painted(thing, whole())
    y, x = np.nonzero((picture[..., :3] != 255).any(axis=-1))
    assert len(x)
    left, top, right, bottom = thing.box
    assert left <= x.min()
    assert right >= x.max() + 1
    assert top <= y.min()
    assert bottom >= y.max() + 1


@pytest.mark.parametrize("name", THINGS)
def test_in_a_region_there_is_the_ink_of_the_whole(name):
    thing, rng = THINGS[name], np.random.default_rng(4)
    picture = painted(thing, whole())
    for _ in range(12):
        region = QRegion()
        for x, y in rng.integers(0, SIDE - 20, (3, 2)).tolist():
            region += QRegion(x, y, *rng.integers(4, 70, 2).tolist())
        part = painted(thing, region)
        held = np.zeros((SIDE, SIDE), dtype=bool)
        for rectangle in region:
            x, y, w, h = rectangle.getRect()
            held[y : y + h, x : x + w] = True
        np.testing.assert_array_equal(part[held], picture[held])


def test_a_line_cut_to_what_is_seen_of_it_leaves_the_same_ink_up_to_the_last_pixel():
    rng = np.random.default_rng(0)
    for count in rng.integers(LONG, WHOLE, 40).tolist():
        line = curve(count, tuple(rng.uniform(90, 150, 2)), rng.uniform(30, 110))
        stroke = Stroke(opened(line) if count % 2 else line, "#123456", rng.choice([1.5, 2.0, 5.0]))
        picture = painted(stroke, whole())
        for x, y, wide, high in rng.integers([0, 0, 4, 4], [200, 200, 120, 120], (4, 4)).tolist():
            part = painted(stroke, QRegion(x, y, wide, high))
            seen = slice(y, y + high), slice(x, x + wide)
            np.testing.assert_array_equal(part[seen], picture[seen])


def others():
    """Each thing, and what it may become."""
    places = np.random.default_rng(0).uniform(20, 220, (60, 2))
    moved = places.copy()
    moved[7] += (9, 4)
    kept = np.delete(np.arange(60), [3, 50])
    ink = "#123456"
    handles = THINGS["handles"]
    yield handles, Handles(np.arange(60), moved, ink, "#ffffff", 3.5, 1.0)
    yield handles, Handles(kept, moved[kept], ink, "#ffffff", 3.5, 1.0)
    yield handles, Handles(kept, moved[kept], "#ff0000", "#ffffff", 3.5, 1.0)
    yield THINGS["dots"], Dots(kept, moved[kept], ink)
    yield THINGS["band"], Band(30.5, 40.2, 170.9, 150.0, ink)
    yield THINGS["band"], Band(200.5, 210.2, 220.9, 230.0, ink)
    yield THINGS["ring"], Ring(90.0, 60.8, ink, 1.0)
    yield THINGS["ribbon"], Stroke(ribbon(3.0), ink, 0.0, 0.34)
    narrow = ribbon()
    halves = narrow.halves.copy()
    halves[7] += 2.0
    yield (
        THINGS["ribbon"],
        Stroke(Line(narrow.vertices, narrow.t, narrow.starts, halves), ink, 0.0, 0.34),
    )
    yield THINGS["words"], Words("Others", QFont(), (50.5, 60.0, 150.0, 90.0), ink, LIGHT)
    for name, count in (("short wide", 90), ("long wide", 2000), ("thin", 30)):
        line, width = curve(count), THINGS[name].width
        for low, high in ((10, 14), (0, 3), (count - 2, count + 1)):
            vertices = line.vertices.copy()
            vertices[low:high] += (12.0, -7.0)
            other = Line(vertices, line.t, line.starts)
            thing = THINGS[name]
            yield thing, Stroke(other, ink, width, thing.opacity, thing.is_thin)


@pytest.mark.parametrize("pair", range(19))
def test_outside_the_boxes_of_their_difference_two_things_are_the_same(pair):
    one, other = list(others())[pair]
    before, after = painted(one, whole()), painted(other, whole())
    inside = np.zeros((SIDE, SIDE), dtype=bool)
    for left, top, right, bottom in one.unlike(other):
        rows, columns = (slice(max(int(low), 0), max(int(high) + 1, 0))
                         for low, high in ((top, bottom), (left, right)))
        inside[rows, columns] = True
    differ = (before != after).any(axis=-1)
    assert differ.any()
    assert not (differ & ~inside).any()
    assert one.unlike(one) == []


def test_a_local_change_of_a_line_is_a_small_box():
    one, other = list(others())[10]
    boxes = np.array(one.unlike(other))
    assert np.prod(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)) < 0.2 * SIDE**2
