"""What a press and a drag do, each a small object that lives until the button is released.

A gesture keeps where it began and the document it began with; each move derives the new document
from those (position = now + offset, never summed), so it cannot drift, and Escape is exact.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt

from app.camera import Camera
from app.edits import counted, shifted, with_moved
from app.handles import CurveHit, PointHit
from app.point_set import PointSet
from app.ribbons import Influence
from app.scene import NOTHING, Overlay, Scene
from app.session import Selection, Session
from core.pull import control_weights, pull


class Pointer(NamedTuple):
    """The mouse at one moment.

    Attributes
    ----------
    pos_px
        Its place on the canvas, shape (2,).
    shift
        Whether Shift is held.
    """

    pos_px: NDArray[np.float64]
    shift: bool = False


class Stage(Protocol):
    """What gestures and tools see of the canvas."""

    session: Session

    @property
    def camera(self) -> Camera:
        """The view."""

    @property
    def scene(self) -> Scene:
        """What is drawn, up to date."""

    @property
    def show_polygon(self) -> bool:
        """Whether control polygons and points are shown, and can be taken."""

    def look(self, camera: Camera) -> None:
        """Change the view."""

    def set_tool(self, name: str) -> None:
        """Take another tool into the hand."""

    def report(self, message: str) -> None:
        """Tell the user why something was not done."""


class Gesture:
    """A drag under way.

    Parameters
    ----------
    stage
        The canvas.
    pointer
        The mouse when the button was pressed.
    """

    cursor = Qt.CursorShape.ArrowCursor

    def __init__(self, stage: Stage, pointer: Pointer) -> None:
        self._stage = stage
        self._start = pointer

    @property
    def is_alive(self) -> bool:
        """Whether the gesture may go on; undo or another document end it from outside."""
        return True

    @property
    def overlay(self) -> Overlay:
        """What the gesture adds to the picture."""
        return NOTHING

    def move(self, pointer: Pointer) -> None:
        """Follow the mouse."""
        raise NotImplementedError

    def finish(self) -> None:
        """Keep what was done."""

    def cancel(self) -> None:
        """Restore what was before."""

    def hint(self, shift: bool) -> str:
        """Tell what the keys do now."""
        raise NotImplementedError


class Pan(Gesture):
    """The paper follows the mouse."""

    cursor = Qt.CursorShape.ClosedHandCursor

    def __init__(self, stage: Stage, pointer: Pointer) -> None:
        super().__init__(stage, pointer)
        self._before = stage.camera
        self._held_mm = stage.camera.to_mm(pointer.pos_px)

    def move(self, pointer: Pointer) -> None:
        # The place that was grabbed goes under the mouse, also after a zoom on the way.
        camera = self._stage.camera
        dx, dy = pointer.pos_px - camera.to_pixels(self._held_mm)
        self._stage.look(camera.moved(float(dx), float(dy)))

    def cancel(self) -> None:
        camera = self._stage.camera
        self._stage.look(self._before.resized(camera.width, camera.height))

    def hint(self, shift: bool) -> str:
        return "Release to stop \N{MIDDLE DOT} Esc goes back"


class RubberBand(Gesture):
    """All control points in a rectangle become the selection; Shift adds them to it."""

    cursor = Qt.CursorShape.CrossCursor

    def __init__(self, stage: Stage, pointer: Pointer) -> None:
        super().__init__(stage, pointer)
        self._before = stage.session.selection
        self._end = pointer.pos_px

    @property
    def overlay(self) -> Overlay:
        return Overlay(rubber_band=(self._start.pos_px, self._end))

    def move(self, pointer: Pointer) -> None:
        self._end = pointer.pos_px
        stage = self._stage
        points = PointSet()
        if stage.show_polygon:
            points = PointSet.of(stage.scene.points_within(self._start.pos_px, self._end))
        if self._start.shift:
            points |= self._before.points
        curves = points.by_curve.keys()
        # The active curve stays, unless points of another one alone were caught.
        curve = self._before.curve
        if curves and curve not in curves:
            curve = min(curves)
        stage.session.select(Selection(points, curve))

    def cancel(self) -> None:
        self._stage.session.select(self._before)

    def hint(self, shift: bool) -> str:
        count = len(self._stage.session.selection.points)
        added = "added to the selection" if self._start.shift else "selected"
        return f"{_points(count)} {added} \N{MIDDLE DOT} Esc restores"


class _Edit(Gesture):
    """A drag that changes the document: one step of undo."""

    name = ""

    def __init__(self, stage: Stage, pointer: Pointer) -> None:
        super().__init__(stage, pointer)
        self._session = stage.session
        self._session.begin(self.name)
        self._origin = self._session.origin
        self._way_mm = np.zeros(2)

    @property
    def is_alive(self) -> bool:
        return self._session.in_gesture and self._session.origin is self._origin

    def finish(self) -> None:
        if self._way_mm.any():
            self._session.commit()
        else:
            # Back at the start: nothing was done, and undo shall not show it.
            self._session.cancel()

    def cancel(self) -> None:
        self._session.cancel()

    def hint(self, shift: bool) -> str:
        decimals = self._stage.camera.decimals
        dx, dy = (f"{value:+.{decimals}f}".replace("-", "\N{MINUS SIGN}") for value in self._way_mm)
        keeps = "Keeping one axis" if shift else "Shift keeps an axis"
        return f"{dx}, {dy} mm \N{MIDDLE DOT} {keeps} \N{MIDDLE DOT} Esc restores"


class MovePoints(_Edit):
    """The selected control points follow the mouse together."""

    cursor = Qt.CursorShape.SizeAllCursor

    def __init__(self, stage: Stage, pointer: Pointer, hit: PointHit) -> None:
        points = stage.session.selection.points | {hit.key}
        self.name = counted("Move", len(points))
        super().__init__(stage, pointer)
        self._hit = hit
        self._start_mm = stage.camera.to_mm(pointer.pos_px)
        self._members = points.by_curve
        self._influences = tuple(
            Influence(curve, members, np.ones(len(members)))
            for curve, members in self._members.items()
        )

    @property
    def overlay(self) -> Overlay:
        return Overlay(hover=self._hit, influences=self._influences)

    def move(self, pointer: Pointer) -> None:
        way = self._stage.camera.to_mm(pointer.pos_px) - self._start_mm
        self._way_mm = one_axis(way) if pointer.shift else way
        self._session.adjust(shifted(self._origin, self._members, self._way_mm))


class PullCurve(_Edit):
    """A place on the limit curve goes exactly under the mouse.

    Of all changes of the control points that put it there, the least one is made
    (`core.pull.pulled`).
    """

    cursor = Qt.CursorShape.PointingHandCursor
    name = "Pull curve"

    def __init__(self, stage: Stage, pointer: Pointer, hit: CurveHit) -> None:
        super().__init__(stage, pointer)
        self._hit = hit
        curve = self._origin.curves[hit.curve]
        self._curve, self._mask = curve, self._origin.parameters.mask
        indices, weights = control_weights(curve.count, self._mask, curve.is_loop, hit.t)
        indices.flags.writeable = False  # so that it is known again with each move
        self._place_mm = weights @ curve.places(indices)
        self._influences = (Influence(hit.curve, indices, weights / (weights @ weights)),)

    @property
    def overlay(self) -> Overlay:
        return Overlay(grip=self._hit, influences=self._influences)

    def move(self, pointer: Pointer) -> None:
        # No grab offset: the promise is that the curve runs through the tip of the arrow.
        way = self._stage.camera.to_mm(pointer.pos_px) - self._place_mm
        self._way_mm = one_axis(way) if pointer.shift else way
        target = self._place_mm + self._way_mm
        curve = self._curve
        _, places = pull(curve.points, self._mask, curve.is_loop, self._hit.t, target)
        indices = self._influences[0].indices
        self._session.adjust(with_moved(self._origin, self._hit.curve, indices, places))


def one_axis(way: NDArray[np.float64]) -> NDArray[np.float64]:
    """Keep the larger component of a way; the other one becomes 0."""
    kept = np.zeros(2)
    axis = int(abs(way[1]) > abs(way[0]))
    kept[axis] = way[axis]
    return kept


def _points(count: int) -> str:
    return "1 point" if count == 1 else f"{count} points"
