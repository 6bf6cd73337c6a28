"""From a moved point to the vertices of a frame, and picking, at any number of points.

Run with ``python3 tests tests/benchmarks``; the table comes at the end.
"""

from __future__ import annotations

import numpy as np
import pytest
from comparison import Comparison
from numpy.typing import NDArray

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
    pyramid = CurvePyramid(live)
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
            "2,000, 0.5 ms",
        )


@pytest.mark.parametrize("number", LENGTHS)
def test_from_event_to_vertices(comparison: Comparison, number: int) -> None:
    """A document's curve, the live one, both pyramids, and all vertices of the frame."""
    curve = Curve(flower(number))
    live = LiveCurve(curve.points, PRESETS["Calm"].mask, True)
    pyramid = CurvePyramid(live)
    polygon = PolygonPyramid(live.control_points, True)
    index = number // 3

    def event():
        after = curve.moved(index, (30.0, 40.0))
        changed = after.differences(curve)
        pyramid.update(live.move(changed, after.places(changed)))
        polygon.update(polygon.edges_at(changed))
        return view(pyramid, -HALF_SCREEN, HALF_SCREEN, 0.25)

    milliseconds = comparison.seconds({"event": event})["event"] * 1e3
    comparison.row(f"event to vertices, one point of {number:,}", f"{milliseconds:.2f} ms")


@pytest.mark.parametrize("number", LENGTHS)
def test_picking(comparison: Comparison, number: int) -> None:
    live = LiveCurve(flower(number), PRESETS["Calm"].mask, True)
    pyramid = CurvePyramid(live)
    polygon = PolygonPyramid(live.control_points, True)
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
            "pyramid of the curve": lambda: CurvePyramid(live),
            "pyramid of the polygon": lambda: PolygonPyramid(live.control_points, True),
        }
    )
    for what, seconds in found.items():
        comparison.row(f"{what}, {number:,} points", f"{seconds / number * 1e9:.0f} ns a point")
    comparison.row("all of it", f"{sum(found.values()) / number * 1e9:.0f} ns a point", "250 ns")
