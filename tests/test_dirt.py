"""Painting only what differs gives the picture that painting all would give, in every bit."""

import numpy as np
import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QImage, QPalette, QRegion
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from app.dirt import MOST_CHANGES, MOST_RECTANGLES, dirt, merged, region_of
from app.session import Selection
from app.signs import Ring
from core.document import Curve, Document
from core.family import PRESETS
from mouse import BOAT, SHIFT, Mouse, by, shown

SIZE = (500, 360)


class Screen:
    """What is on a screen after all that a canvas had painted, region by region."""

    def __init__(self, canvas, ratio, monkeypatch):
        self.canvas, self.ratio = canvas, ratio
        self.waiting = QRegion()
        self.painted = 0
        monkeypatch.setattr(canvas, "devicePixelRatioF", lambda: ratio)
        canvas.refresh()
        QApplication.processEvents()
        monkeypatch.setattr(canvas, "update", self.update)
        self.image = self.blank()
        self.paint(QRegion(canvas.rect()))

    def blank(self):
        wide, high = (round(length * self.ratio) for length in SIZE)
        image = QImage(wide, high, QImage.Format.Format_RGB32)
        image.setDevicePixelRatio(self.ratio)
        return image

    def update(self, area=None):
        self.waiting += QRegion(self.canvas.rect()) if area is None else QRegion(area)

    def paint(self, region, image=None):
        flags = QWidget.RenderFlag(0)
        corner = region.boundingRect().topLeft()
        self.canvas.render(self.image if image is None else image, corner, region, flags)

    def follow(self):
        """Paint what is asked for; return the share of the canvas that was."""
        QApplication.processEvents()
        region, self.waiting = self.waiting, QRegion()
        if not region.isEmpty():
            self.paint(region)
        assert self.waiting.isEmpty()
        self.painted += not region.isEmpty()
        return sum(part.width() * part.height() for part in region) / (SIZE[0] * SIZE[1])

    def whole(self):
        """The picture as it is when all is painted at once."""
        image = self.blank()
        self.paint(QRegion(self.canvas.rect()), image)
        return image

    def differences(self):
        """Number of pixels that differ from the picture painted at once."""
        one, other = pixels(self.image), pixels(self.whole())
        return int((one != other).any(axis=-1).sum())


def pixels(image):
    flat = np.frombuffer(image.constBits(), dtype=np.uint8)
    lines = flat.reshape(image.height(), image.bytesPerLine() // 4, 4)
    return lines[:, : image.width(), :3].copy()


def flower(count, closed=True, shift=(0, 0)):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 100 + 10 * np.sin(9 * angle) + 20 * np.sin(2 * angle)
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return Curve(points + shift, closed)


def drawing(count):
    if count == 8:
        return Document((Curve(BOAT),))
    beside = Curve(np.array(BOAT) - (60, 30), False)
    return Document((flower(count), beside, flower(max(count // 3, 9), False, (20, 9))))


def dark():
    colours = QPalette()
    colours.setColor(QPalette.ColorRole.Window, QColor("#222222"))
    colours.setColor(QPalette.ColorRole.WindowText, QColor("#ffffff"))
    return colours


def anywhere(rng):
    return rng.uniform((30, 30), (SIZE[0] - 6, SIZE[1] - 6))


def near_a_point(canvas, rng):
    places = canvas.scene.curves[0].points_px
    seen = places[((places > 30) & (places < np.array(SIZE) - 5)).all(axis=1)]
    return seen[rng.integers(len(seen))] if len(seen) else anywhere(rng)


def steps(canvas, mouse, rng, screen):
    """A few random things that a hand does, one event after the other."""
    session, document = canvas.session, canvas.session.document
    deed = rng.choice(DEEDS)
    if deed in ("drag", "pull", "band"):
        place = near_a_point(canvas, rng) if deed == "drag" else anywhere(rng)
        vertices = canvas.scene.curves[0].vertices_px
        if deed == "pull" and len(vertices):
            canvas.show_polygon = False
            place = vertices[rng.integers(len(vertices))]
        mouse.move(place)
        yield deed
        mouse.press(place, keys=rng.choice([SHIFT, Qt.KeyboardModifier.NoModifier]))
        yield deed
        for _ in range(5):
            place = place + rng.normal(0, 25, 2)
            mouse.move(place)
            yield deed
        if rng.random() < 0.2:
            QTest.keyClick(canvas, Qt.Key.Key_Escape)
            yield "escape"
        mouse.release()
        yield deed
        canvas.show_polygon = True
    elif deed == "hover":
        for _ in range(4):
            mouse.move(near_a_point(canvas, rng) + rng.normal(0, 3, 2))
            yield deed
    elif deed == "select":
        count = document.curves[0].count
        some = rng.choice(count, size=min(count, int(rng.integers(0, 40))), replace=False)
        points = frozenset((0, int(point)) for point in some)
        session.select(Selection(points, int(rng.integers(len(document.curves)))))
        yield deed
        canvas.nudge(*rng.normal(0, 3, 2))
    elif deed == "all":
        canvas.select_all()
        yield deed
        canvas.nudge(*rng.normal(0, 3, 2))
    elif deed == "undo":
        for verb in (session.undo, session.undo, session.redo):
            verb()
            yield deed
    elif deed == "slide":
        names = list(PRESETS)
        session.edit(document.with_parameters(PRESETS[names[rng.integers(len(names))]]), "Preset")
    elif deed == "pen":
        canvas.set_tool("pen")
        yield deed
        for _ in range(3):
            place = anywhere(rng)
            mouse.move(place)
            yield deed
            mouse.click(place)
            yield deed
        mouse.move(anywhere(rng))
        yield deed
        canvas.set_tool("select")
    elif deed == "notice":
        canvas.show_notice(rng.choice(["", "A warning.", "Another warning, which is longer."]))
    elif deed == "zoom":
        canvas.zoom_by(rng.choice([0.4, 1.3, 3.0]))
    elif deed == "pan":
        canvas.look(canvas.camera.moved(*rng.uniform(-90, 90, 2)))
    elif deed == "fit":
        canvas.fit_all()
    elif deed == "focus":
        (canvas.clearFocus if canvas.hasFocus() else canvas.setFocus)()
    elif deed == "leave":
        canvas.mark_mouse(None)
    yield deed


DEEDS = (
    *("drag",) * 6, "pull", "pull", "band", "band", "hover", "hover", "select", "select", "all",
    "undo", "slide", "pen", "notice", "zoom", "pan", "fit", "focus", "leave",
)  # fmt: skip


@pytest.mark.parametrize("ratio", [1.0, 1.25, 2.0])
@pytest.mark.parametrize("count", [8, 60, 700, 20_000])
def test_partial_painting_gives_the_whole_picture(qtbot, monkeypatch, count, ratio):
    rng = np.random.default_rng([count, int(4 * ratio)])
    # On a slow machine the end of a burst of nudges would come between two looks at the screen.
    monkeypatch.setattr("app.nudging.BURST_MS", 10**8)
    canvas = shown(qtbot, drawing(count), SIZE)
    if rng.random() < 0.5:
        canvas.setPalette(dark())
    screen = Screen(canvas, ratio, monkeypatch)
    mouse = Mouse(canvas)
    shares = []
    for _ in range(12):
        for deed in steps(canvas, mouse, rng, screen):
            shares.append(screen.follow())
            assert screen.differences() == 0, deed
    assert np.median(shares) < 0.5


@pytest.mark.parametrize("ratio", [1.0, 1.25, 1.5, 2.0, 3.0])
def test_the_frame_of_the_focus_stays_where_what_is_beside_it_is_painted(
    qtbot, monkeypatch, ratio
):
    canvas = shown(qtbot, drawing(8), SIZE)
    canvas.setFocus()
    assert canvas.hasFocus()
    screen = Screen(canvas, ratio, monkeypatch)
    wide, high = SIZE
    for part in (
        (wide - 3, 40, 2, 30), (wide - 2, 90, 1, 30), (60, high - 3, 90, 2), (60, high - 2, 40, 1),
    ):  # fmt: skip
        screen.paint(QRegion(*part))
        assert screen.differences() == 0, part


def test_dragging_one_of_many_points_paints_a_small_part(qtbot, monkeypatch):
    for count, most in ((60, 0.5), (700, 0.1), (20_000, 0.1)):
        canvas = shown(qtbot, Document((flower(count),)), SIZE)
        screen, mouse = Screen(canvas, 1.0, monkeypatch), Mouse(canvas)
        start = mouse.point(count // 3)
        mouse.press(start)
        screen.follow()
        for angle in np.linspace(0, 6, 9):
            mouse.move(start + by(12 * np.cos(angle), 12 * np.sin(angle)))
            assert 0 < screen.follow() < most
            assert screen.differences() == 0
        mouse.release()


def test_nothing_is_painted_when_nothing_changes(qtbot, monkeypatch):
    canvas = shown(qtbot, drawing(60), SIZE)
    screen = Screen(canvas, 1.0, monkeypatch)
    canvas.refresh()
    assert screen.follow() == 0


def test_the_window_shows_what_is_painted_by_parts(qtbot):
    """The same with the store of a real window in place of the tests' own."""
    canvas = shown(qtbot, drawing(700), SIZE)
    mouse = Mouse(canvas)
    start = mouse.point(200)
    mouse.press(start)
    for way in np.random.default_rng(2).normal(0, 20, (6, 2)):
        mouse.move(start + way)
        for _ in range(4):  # the events, the timer of the redraw, the paint
            QApplication.processEvents()
        held = canvas.screen().grabWindow(canvas.winId()).toImage()
        held = held.convertToFormat(QImage.Format.Format_RGB32)
        whole = canvas.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
        np.testing.assert_array_equal(pixels(held), pixels(whole))


def test_boxes_that_overlap_go_together_and_all_are_held():
    rng = np.random.default_rng(0)
    for count in (1, 3, 40, 300):
        low = rng.uniform(0, 900, (count, 2))
        high = low + rng.uniform(0, 200, (count, 2))
        boxes = [tuple(box) for box in np.concatenate([low, high], axis=1).tolist()]
        found = merged(boxes)
        assert len(found) <= MOST_RECTANGLES
        for left, top, right, bottom in boxes:
            assert any(
                a <= left and b <= top and c >= right and d >= bottom for a, b, c, d in found
            )
    assert merged([(0, 0, 9, 9), (800, 500, 809, 509)]) == [(0, 0, 9, 9), (800, 500, 809, 509)]
    assert merged([(np.inf, np.inf, -np.inf, -np.inf)]) == []


def test_a_region_holds_each_pixel_that_a_box_touches():
    screen = QRect(24, 24, 100, 80)
    region = region_of([(30.2, 40.9, 31.0, 41.1), (-1e300, 90.0, 1e300, 1e300)], screen)
    assert region == QRegion(QRect(30, 40, 2, 2)) + QRegion(QRect(24, 90, 100, 14))
    assert region_of([(0, 0, 20, 20), (500, 0, 600, 50)], screen).isEmpty()


def test_things_that_are_the_same_leave_no_dirt():
    ring, other = Ring(50, 50, "#000000", 1.0), Ring(60, 50, "#000000", 1.0)
    assert dirt({(1, 0): ring}, {(1, 0): Ring(50, 50, "#000000", 1.0)}) == []
    key = (1, 0)
    for before, now in (({key: ring}, {key: other}), ({key: ring}, {}), ({}, {key: ring})):
        (box,) = merged(dirt(before, now))
        assert box[0] < 45
        assert box[2] > 55


def test_of_many_things_that_differ_all_are_held():
    count = 3 * MOST_CHANGES
    rings = [Ring(10.0 * k, 500.0 - k, "#000000", 1.0) for k in range(count)]
    others = [Ring(ring.x, ring.y + 3.0, "#000000", 1.0) for ring in rings]
    before, now = ({(1, k): ring for k, ring in enumerate(some)} for some in (rings, others))
    del before[1, 0], now[1, count - 1]  # things that only one of the pictures has count, too
    (held,) = dirt(before, now)
    for ring in [*before.values(), *now.values()]:
        left, top, right, bottom = ring.box
        assert held[0] <= left <= right <= held[2]
        assert held[1] <= top <= bottom <= held[3]
