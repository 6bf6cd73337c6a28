"""The picture on the sheet: the things that are painted, made outside painting and kept.

What did not change since the picture before is the same thing again, not only an equal one.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from operator import is_
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRect, QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QPainter

from app.crowd import MOST_HANDLES, is_crowd
from app.dirt import Key
from app.drawn import Drawn
from app.ink import Band, Ink, Stroke, Words
from app.line import Line
from app.pixel_box import Box, box_of, meeting
from app.scene import Overlay, Scene
from app.session import Selection
from app.signs import Dots, Grip, Handles, Ring
from app.style import SIZES, Palette

HINT_POINTS: Final = 10.5
"""Size of the words on the canvas, in typographic points."""

HINT_PADDING_PX: Final = (14.0, 8.0)
"""Room around the words, left and right, above and below."""

HINT_RISE_PX: Final = 20.0
"""Room between the words and the edge of the sheet."""

HINT_ROOM_PX: Final = 28.0
"""Room to leave free below a drawing, besides its margin, while there are words."""

GHOST_OPACITY: Final = 0.8
RIBBON_OPACITY: Final = 0.34
"""What lies behind a ghost, or under a ribbon of influence, is seen through it."""


class Layer(IntEnum):
    """What the things of a picture are, from the back to the front."""

    RIBBON = 0
    GHOST = 1
    POLYGON = 2
    CALM = 3
    ACTIVE = 4
    PREVIEW_POLYGON = 5
    PREVIEW = 6
    PREVIEW_POINTS = 7
    POINTS = 8
    SELECTED = 9
    HOVER = 10
    GRIP = 11
    BAND = 12
    HINT = 13
    NOTICE = 14


class Setting(NamedTuple):
    """How a picture is drawn, whatever it shows; with another one nothing of it stays.

    Attributes
    ----------
    palette
        Colours.
    ratio
        Device pixels per logical pixel.
    view
        The part of the sheet that is painted on, in whole pixels.
    font
        Font of the sheet.
    with_polygon
        Whether control polygons and points are drawn.
    """

    palette: Palette
    ratio: float
    view: QRect
    font: QFont
    with_polygon: bool


class Picture:
    """Things by their keys, in the order in which they are painted.

    Attributes
    ----------
    things
        What is painted. The dictionary is never changed, only replaced.
    """

    def __init__(self) -> None:
        self.things: dict[Key, Ink] = {}
        self._sources: dict[Key, tuple[object, ...]] = {}
        self._curves: list[_CurveInks] = []
        self._setting: Setting | None = None

    def update(
        self,
        setting: Setting,
        scene: Scene,
        selection: Selection,
        overlay: Overlay,
        hint: str = "",
        notice: str = "",
    ) -> None:
        """Make the picture of what is shown now.

        Parameters
        ----------
        setting
            How it is drawn.
        scene, selection, overlay
            The curves, the points selected of them, and what the hand adds.
        hint, notice
            Words near the lower and the upper edge, or "".
        """
        if setting != self._setting:
            self._setting, self._sources, self._curves = setting, {}, []
        known, sources = self.things, self._sources
        self.things, self._sources = {}, {}

        def put(key: Key, make: _Make, *source: object) -> None:
            """Take the thing as it was, if it was made from the same, or make it."""
            before = sources.get(key)
            is_kept = before is not None and all(map(is_, before, source))
            ink = known.get(key) if is_kept else make(setting, *source)
            self._sources[key] = source
            if ink is not None:
                self.things[key] = ink

        for place, ribbon in enumerate(scene.ribbons):
            put((Layer.RIBBON, place), _ribbon, ribbon)
        for index, ghost in scene.ghosts.items():
            put((Layer.GHOST, index), _ghost, ghost)
        self._put_curves(put, setting, scene, selection)
        for layer, ink in _overlay(setting, scene, overlay):
            self.things[layer, 0] = ink
        for layer, text in ((Layer.HINT, hint), (Layer.NOTICE, notice)):
            if text:
                put((layer, 0), _words, layer, text)

    def paint(self, painter: QPainter, seen: Box) -> None:
        """Paint what is seen of it in a box."""
        left, top, right, bottom = seen
        for ink in self.things.values():
            box = ink.box
            if box[0] <= right and box[2] >= left and box[1] <= bottom and box[3] >= top:
                ink.paint(painter, seen)

    def _put_curves(
        self, put: _Put, setting: Setting, scene: Scene, selection: Selection
    ) -> None:
        """Put polygons, curves and points, layer by layer."""
        curves, active, preview = scene.curves, selection.curve, scene.preview
        # Of thousands of curves most stay: each is looked at once, not once for each layer.
        kept = [*self._curves[: len(curves)], *[None] * (len(curves) - len(self._curves))]
        self._curves = [
            held
            if held is not None and held.drawn is drawn and held.is_active == (index == active)
            else _curve_inks(setting, drawn, index == active, held)
            for index, (drawn, held) in enumerate(zip(curves, kept, strict=True))
        ]
        self._take(Layer.POLYGON, [held.polygon for held in self._curves])
        calm = [None if held.is_active else held.outline for held in self._curves]
        self._take(Layer.CALM, calm)
        if active < len(curves) and (ink := self._curves[active].outline) is not None:
            self.things[Layer.ACTIVE, active] = ink
        if preview is not None:
            put((Layer.PREVIEW_POLYGON, 0), _polygon, preview)
            put((Layer.PREVIEW, 0), _outline, preview, False)
            put((Layer.PREVIEW_POINTS, 0), _points, preview, False)
        self._take(Layer.POINTS, [held.points for held in self._curves])
        if setting.with_polygon:
            for index, chosen in selection.points.by_curve.items():
                if index < len(curves):
                    put((Layer.SELECTED, index), _selected, curves[index], chosen)

    def _take(self, layer: Layer, inks: list[Ink | None]) -> None:
        self.things.update(
            ((layer, index), ink) for index, ink in enumerate(inks) if ink is not None
        )


_Make = Callable[..., Ink | None]
"""Maker of a thing, from the setting and what it is made from."""

_Put = Callable[..., None]


class _CurveInks(NamedTuple):
    """Things that are painted of a curve, and what they were made from."""

    drawn: Drawn
    is_active: bool
    polygon: Ink | None
    outline: Ink | None
    points: Ink | None


def _curve_inks(
    setting: Setting, drawn: Drawn, is_active: bool, before: _CurveInks | None
) -> _CurveInks:
    """Make the things of a curve; a polygon looks alike whether it is active or not."""
    polygon = points = None
    if setting.with_polygon:
        is_kept = before is not None and before.drawn is drawn
        polygon = before.polygon if before and is_kept else _polygon(setting, drawn)
        points = _points(setting, drawn, not is_active)
    outline = _outline(setting, drawn, not is_active)
    return _CurveInks(drawn, is_active, polygon, outline, points)


def _ribbon(setting: Setting, line: Line) -> Ink | None:
    return _stroke(setting, line, setting.palette.influence, 0.0, RIBBON_OPACITY)


def _ghost(setting: Setting, line: Line) -> Ink | None:
    return _stroke(setting, line, setting.palette.ghost, SIZES.polygon_width, GHOST_OPACITY)


def _polygon(setting: Setting, drawn: Drawn) -> Ink | None:
    return _stroke(setting, drawn.polygon_line, setting.palette.polygon, SIZES.polygon_width)


def _outline(setting: Setting, drawn: Drawn, calm: bool) -> Ink | None:
    palette = setting.palette
    if calm:
        return _stroke(setting, drawn.outline_line, palette.curve, SIZES.calm_width)
    return _stroke(setting, drawn.outline_line, palette.curve_active, SIZES.curve_width)


def _stroke(
    setting: Setting, line: Line, colour: str, width: float, opacity: float = 1.0
) -> Ink | None:
    if not len(line.t):
        return None
    is_thin = line.halves is None and width * setting.ratio <= 1.0
    return Stroke(line, colour, width, opacity, is_thin)


def _points(setting: Setting, drawn: Drawn, calm: bool) -> Ink | None:
    """Control points in view: as handles, or as dots where they are crowded."""
    if drawn.shown is None or not len(drawn.shown):
        return None
    palette, places = setting.palette, drawn.handles_px
    rim = palette.polygon if calm else palette.point
    if is_crowd(places):
        return Dots(drawn.shown, places, rim)
    fill = palette.point_fill
    return Handles(drawn.shown, places, rim, fill, SIZES.point_radius, setting.ratio)


def _selected(setting: Setting, drawn: Drawn, chosen: NDArray[np.intp]) -> Ink | None:
    """Selected points in view; of very many, those that are shown anyway."""
    if not len(chosen):
        return None
    if len(chosen) > MOST_HANDLES:
        shown = chosen[:0] if drawn.shown is None else drawn.shown
        places = np.minimum(np.searchsorted(chosen, shown), len(chosen) - 1)
        chosen = shown[chosen[places] == shown]
    chosen = chosen[chosen < drawn.curve.count]
    places_px = drawn.places_px(chosen)
    seen = meeting(places_px, box_of(setting.view), SIZES.hit_point)
    if not seen.all():
        chosen, places_px = chosen[seen], places_px[seen]
        if not len(chosen):
            return None
    colour = setting.palette.point_selected
    return Handles(chosen, places_px, colour, colour, SIZES.selected_radius, setting.ratio)


def _overlay(setting: Setting, scene: Scene, overlay: Overlay) -> list[tuple[Layer, Ink]]:
    """What the hand adds in front of all curves."""
    palette, ratio = setting.palette, setting.ratio
    found: list[tuple[Layer, Ink]] = []
    hover, grip = overlay.hover, overlay.grip
    if hover is not None and hover.curve < len(scene.curves):
        drawn = scene.curves[hover.curve]
        if hover.point < drawn.curve.count:
            x, y = drawn.places_px(np.array([hover.point]))[0].tolist()
            found.append((Layer.HOVER, Ring(x, y, palette.hover, ratio)))
    if grip is not None and grip.curve < len(scene.curves):
        place = place_of(scene.curves[grip.curve], grip.t)
        if place is not None:
            x, y = place.tolist()
            found.append((Layer.GRIP, Grip(x, y, palette.hover, palette.background)))
    if overlay.rubber_band is not None:
        left, top = np.minimum(*overlay.rubber_band).tolist()
        right, bottom = np.maximum(*overlay.rubber_band).tolist()
        found.append((Layer.BAND, Band(left, top, right, bottom, palette.rubber_band)))
    return found


def _words(setting: Setting, layer: Layer, text: str) -> Ink:
    """Words near the lower edge, or such as warn near the upper one."""
    font = QFont(setting.font)
    font.setPointSizeF(HINT_POINTS)
    wide, high = HINT_PADDING_PX
    size = QFontMetricsF(font).size(0, text)
    box = QRectF(0, 0, size.width() + 2 * wide, size.height() + 2 * high)
    view = QRectF(setting.view)
    box.moveCenter(view.center())
    palette = setting.palette
    if layer == Layer.HINT:
        box.moveBottom(view.bottom() - HINT_RISE_PX)
        colour = palette.text
    else:
        box.moveTop(view.top() + HINT_RISE_PX)
        colour = palette.warning
    ground: Box = box.left(), box.top(), box.right(), box.bottom()
    return Words(text, font, ground, colour, palette)


def place_of(drawn: Drawn, t: float) -> NDArray[np.float64] | None:
    """Pixels of a place on a drawn curve, linear between its vertices; None if it has none."""
    if not len(drawn.parameters):
        return None
    places = drawn.vertices_px
    return np.array([np.interp(t, drawn.parameters, places[:, axis]) for axis in (0, 1)])
