import numpy as np
import pytest

from app.camera import Camera
from app.import_picture import MANY, Sight, painted, sight_of
from app.style import DARK, LIGHT
from core.document import Curve, Document
from core.family import Parameters
from core.flatten import Polyline
from core.formats.outlines import straight
from core.formats.sketch import Sketch, Trace
from core.polytope import never

SIZE = 200


def square(side=100.0, count=1):
    corners = np.array([(0, 0), (side, 0), (side, side), (0, side)])
    corners = np.concatenate([np.linspace(a, b, count, endpoint=False)
                              for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)])
    return Trace(straight(corners, np.roll(corners, -1, axis=0)), True)


def picture(sight, palette=LIGHT, ratio=1.0, camera=None, cancelled=never):
    camera = camera or Camera(50, 50, 1.5, SIZE, SIZE)
    return painted(sight, camera, ratio, palette, cancelled)


def ink(image, palette):
    """Device pixels that are not ground, shape (rows, columns)."""
    ground = palette.background
    return np.array(
        [[image.pixelColor(x, y).name() != ground for x in range(image.width())]
         for y in range(image.height())]
    )  # fmt: skip


@pytest.mark.parametrize(("palette", "ratio"), [(LIGHT, 1.0), (DARK, 1.0), (LIGHT, 2.0)])
def test_the_lines_of_the_file_are_where_they_belong(palette, ratio):
    seen = ink(picture(sight_of(Sketch((square(),), "mm", True)), palette, ratio), palette)
    assert seen.shape == (SIZE * ratio, SIZE * ratio)
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    for places in (rows, columns):  # 150 pixels about the middle, and half of the band's width
        assert np.abs(np.array([places[0], places[-1] + 1]) / ratio - (23, 177)).max() <= 1
    middle = int(SIZE * ratio / 2)
    assert not seen[middle - 20 : middle + 20, middle - 20 : middle + 20].any()


def test_many_pieces_look_like_few():
    few = ink(picture(sight_of(Sketch((square(),), "mm", True))), LIGHT)
    many = ink(picture(sight_of(Sketch((square(count=MANY),), "mm", True))), LIGHT)
    assert (few != many).mean() < 0.01


def test_curves_and_points_are_drawn_over_the_file():
    sketch = Sketch((square(),), "mm", True)
    document = Document((Curve(sketch.traces[0].nodes), Curve(np.array([[50.0, 50.0]]))))
    sight = sight_of(sketch, document)
    assert len(sight.points) == 5
    assert len(sight.curves) == 1
    image = picture(sight)
    inks = {image.pixelColor(x, y).name() for x in range(SIZE) for y in range(SIZE)}
    assert LIGHT.accent in inks


def test_a_scheme_without_a_limit_shows_the_points_alone():
    sketch = Sketch((square(),), "mm", True)
    document = Document((Curve(sketch.traces[0].nodes),), Parameters(1, 0, -1, "mirrored"))
    assert len(sight_of(sketch, document).points) == 4


def test_it_ends_when_it_is_cancelled():
    sight = Sight([Polyline(np.eye(2) * 100, False, 0.0)] * 100, np.zeros(2), np.full(2, 100.0))
    asked = []

    def cancelled():
        asked.append(True)
        return len(asked) > 3

    picture(sight, cancelled=cancelled)
    assert len(asked) == 4
