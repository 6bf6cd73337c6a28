"""From a moved point to the vertices of a frame, and picking, at any number of points.

Run with ``python3 tests tests/benchmarks``; the table comes at the end.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from comparison import Comparison
from numpy.typing import NDArray

from core.affine import IDENTITY, Affine
from core.blocks import Blocks
from core.document import Curve
from core.family import PRESETS
from core.live import LiveCurve
from core.picking import nearest_place, nearest_point
from core.pyramid import CurvePyramid, PolygonPyramid
from core.view import view

LENGTHS = [20, 2000, 100_000, 1_000_000]
HALF_SCREEN = np.array([960.0, 540.0])


def flower(number: int) -> NDArray[np.float64]:
    """A closed curve with nine petals that fills 1920 x 1080 pixels."""
    angle = np.linspace(0, 2 * np.pi, number, endpoint=False)
    radius = 480 + 50 * np.sin(9 * angle)
    return radius[:, None] * np.stack([1.7 * np.cos(angle), np.sin(angle)], axis=-1)


@pytest.mark.parametrize("number", LENGTHS)
def test_frames(comparison: Comparison, number: int) -> None:
    live = LiveCurve(flower(number), PRESETS["Calm"].mask, True)
    pyramid = CurvePyramid(Blocks(live))
    place = live.at(0.31 * number)
    for zoom in (1.0, 30.0, 1e6):
        half = HALF_SCREEN / zoom
        centre = place if zoom > 1 else np.zeros(2)

        def seen(centre=centre, half=half, zoom=zoom):
            return view(pyramid, centre - half, centre + half, 0.25 / zoom, centre)

        vertices = len(seen().vertices)
        milliseconds = comparison.seconds({"view": seen})["view"] * 1e3
        comparison.row(
            f"view of {number:,} points at zoom {zoom:g}",
            f"{vertices} vertices, {milliseconds:.2f} ms",
            "2,000",
        )


@pytest.mark.parametrize("number", LENGTHS)
def test_from_event_to_vertices(comparison: Comparison, number: int) -> None:
    """A document's curve, the live one, its blocks, and all vertices of the frame."""
    curve = Curve(flower(number))
    live = LiveCurve(curve.points, PRESETS["Calm"].mask, True)
    blocks = Blocks(live)
    index = number // 3
    masks = itertools.cycle([PRESETS["Tight"].mask, PRESETS["Lean"].mask])

    def seen(placed=IDENTITY):
        pyramid = CurvePyramid(blocks)
        return view(pyramid, -HALF_SCREEN, HALF_SCREEN, 0.25, placed=placed)

    def moved():
        after = curve.moved(index, (30.0, 40.0))
        changed = after.differences(curve)
        live.move(changed, after.places(changed))
        blocks.update(changed)
        return seen()

    def recast():
        live.recast(next(masks))
        blocks.update_ends()
        return seen()

    found = comparison.seconds(
        {
            "one point": moved,
            "another scheme": recast,
            "all points together": lambda: seen(Affine.shift((30.0, 40.0))),
        }
    )
    for what, seconds in found.items():
        comparison.row(f"event to vertices, {what}, {number:,} points", f"{seconds * 1e3:.2f} ms")


@pytest.mark.parametrize("number", LENGTHS)
def test_picking(comparison: Comparison, number: int) -> None:
    live = LiveCurve(flower(number), PRESETS["Calm"].mask, True)
    blocks = Blocks(live)
    pyramid, polygon = CurvePyramid(blocks), PolygonPyramid(blocks)
    place = live.at(0.31 * number)
    found = comparison.seconds(
        {
            "point": lambda: nearest_point(polygon, place, 8.0),
            "curve": lambda: nearest_place(pyramid, place, 8.0),
        }
    )
    for what, seconds in found.items():
        comparison.row(f"pick the {what}, {number:,} points", f"{seconds * 1e3:.2f} ms", "0.3 ms")


def test_building_everything(comparison: Comparison) -> None:
    number = 1_000_000
    points = flower(number)
    live = LiveCurve(points, PRESETS["Calm"].mask, True)
    found = comparison.seconds(
        {
            "live curve": lambda: LiveCurve(points, PRESETS["Calm"].mask, True),
            "its blocks": lambda: Blocks(live),
        }
    )
    for what, seconds in found.items():
        comparison.row(f"{what}, {number:,} points", f"{seconds / number * 1e9:.0f} ns a point")
    comparison.row("all of it", f"{sum(found.values()) / number * 1e9:.0f} ns a point", "250 ns")
