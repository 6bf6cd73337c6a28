"""The select tool: selects and moves points, pulls the curve, inserts points."""

from __future__ import annotations

from PySide6.QtCore import Qt

from app.edits import with_point_on_edge
from app.gestures import Gesture, MovePoints, Pointer, PullCurve, RubberBand, Stage
from app.handles import (
    CurveHit,
    EdgeHit,
    PointHit,
)
from app.point_set import PointSet
from app.scene import NOTHING, Overlay
from app.session import Selection
from app.style import SIZES
from app.tools import DOT, DragTool, State
from core.errors import NinepointError


class SelectTool(DragTool):
    """Selects and moves control points, pulls the curve, inserts points."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._target: PointHit | CurveHit | None = None
        self._was_selected = False

    @property
    def overlay(self) -> Overlay:
        if self._gesture is not None:
            return self._gesture.overlay
        if isinstance(self._target, PointHit):
            return Overlay(hover=self._target)
        if isinstance(self._target, CurveHit):
            return Overlay(grip=self._target)
        return NOTHING

    @property
    def cursor(self) -> Qt.CursorShape:
        if self._gesture is not None:
            return self._gesture.cursor
        if isinstance(self._target, PointHit):
            return Qt.CursorShape.SizeAllCursor
        if isinstance(self._target, CurveHit):
            return Qt.CursorShape.PointingHandCursor
        return Qt.CursorShape.ArrowCursor

    def hint(self, shift: bool) -> str:
        if self._gesture is not None:
            return self._gesture.hint(shift)
        count = len(self._stage.session.selection.points)
        if isinstance(self._target, PointHit):
            if shift:
                return "Click adds the point to the selection, or takes it out"
            group = count > 1 and self._target.key in self._stage.session.selection.points
            what = f"Drag moves {count} points" if group else "Drag moves the point"
            return f"{what}{DOT}Shift+click selects more{DOT}Del deletes"
        if isinstance(self._target, CurveHit):
            return f"Drag pulls the curve under the mouse{DOT}double click inserts a point"
        if shift:
            return "Drag adds points to the selection"
        if count:
            return (
                f"Arrows move by 1 mm, with Shift 10, with Alt 0.1{DOT}Del deletes{DOT}Esc clears"
            )
        hidden = self._stage.scene.hidden if self._stage.show_polygon else 0
        if hidden:
            return f"{hidden:,} points lie too close to be shown{DOT}zoom in to see them"
        return (
            f"Drag a point, or the curve itself{DOT}drag on empty space selects"
            f"{DOT}double click an edge inserts"
        )

    def press(self, pointer: Pointer) -> None:
        super().press(pointer)
        self._target = self._hit(pointer)
        session = self._stage.session
        selection = session.selection
        if isinstance(self._target, PointHit):
            key = self._target.key
            self._was_selected = key in selection.points
            if not self._was_selected:
                kept = selection.points if pointer.shift else PointSet()
                session.select(Selection(kept | {key}, key[0]))
            else:
                session.select(Selection(selection.points, key[0]))
        elif isinstance(self._target, CurveHit):
            session.select(Selection(selection.points, self._target.curve))

    def move(self, pointer: Pointer) -> None:
        if self.state is State.IDLE:
            self._target = self._hit(pointer)
        super().move(pointer)

    def release(self, pointer: Pointer) -> None:
        super().release(pointer)
        self._target = self._hit(pointer)

    def double_click(self, pointer: Pointer) -> None:
        if self._hit_point(pointer) is not None:
            self.press(pointer)
            return
        edge = self._hit_edge(pointer)
        if edge is None:
            return
        session = self._stage.session
        try:
            document, key = with_point_on_edge(session.document, edge)
        except NinepointError as error:
            self._stage.report(str(error))
            return
        session.commit()
        session.edit(document, "Insert point")
        session.select(Selection(PointSet.of([key]), key[0]))
        hit = self._hit_point(pointer)
        if hit is not None and hit.key == key:
            # The button is still down: the new point can be dragged at once.
            self.press(pointer)

    def leave(self) -> None:
        if self.state is State.IDLE:
            self._target = None

    def key(self, key: int) -> bool:
        if super().key(key):
            return True
        session = self._stage.session
        if key == Qt.Key.Key_Escape and session.selection.points:
            session.select(Selection(curve=session.selection.curve))
            return True
        return False

    def select_under(self, pointer: Pointer) -> None:
        """Make the point under the mouse part of the selection, alone if it was not."""
        hit = self._hit(pointer)
        session = self._stage.session
        if isinstance(hit, PointHit) and hit.key not in session.selection.points:
            session.select(Selection(PointSet.of([hit.key]), hit.curve))
        elif isinstance(hit, CurveHit):
            session.select(Selection(session.selection.points, hit.curve))

    def _begin(self, pressed: Pointer) -> Gesture:
        # Undo or another document may have come between press and drag.
        self._target = self._hit(pressed)
        if isinstance(self._target, PointHit):
            return MovePoints(self._stage, pressed, self._target)
        if isinstance(self._target, CurveHit):
            return PullCurve(self._stage, pressed, self._target)
        return RubberBand(self._stage, pressed)

    def _click(self, pointer: Pointer) -> None:
        session = self._stage.session
        selection = session.selection
        if isinstance(self._target, PointHit):
            key = self._target.key
            if self._was_selected and pointer.shift:
                session.select(Selection(selection.points - {key}, selection.curve))
            elif self._was_selected:
                session.select(Selection(PointSet.of([key]), key[0]))
        elif not pointer.shift:
            session.select(Selection(curve=selection.curve))

    def drop(self) -> None:
        super().drop()
        if not isinstance(self._target, PointHit):
            self._target = None

    def _hit(self, pointer: Pointer) -> PointHit | CurveHit | None:
        return self._hit_point(pointer) or self._hit_curve(pointer)

    def _hit_point(self, pointer: Pointer) -> PointHit | None:
        stage = self._stage
        if not stage.show_polygon:
            return None
        active = stage.session.selection.curve
        return stage.scene.nearest_point(pointer.pos_px, SIZES.hit_point, active)

    def _hit_curve(self, pointer: Pointer) -> CurveHit | None:
        stage = self._stage
        active = stage.session.selection.curve
        return stage.scene.nearest_on_curve(pointer.pos_px, SIZES.hit_curve, active)

    def _hit_edge(self, pointer: Pointer) -> EdgeHit | None:
        """Find the edge under the mouse, or the edge whose span of the curve lies there."""
        stage = self._stage
        curves = stage.scene.curves
        if stage.show_polygon:
            active = stage.session.selection.curve
            edge = stage.scene.nearest_edge(pointer.pos_px, SIZES.hit_edge, active)
            if edge is not None:
                return edge
        hit = self._hit_curve(pointer)
        if hit is None:
            return None
        curve = curves[hit.curve].curve
        # The end of an open curve lies on its last edge.
        span = min(int(hit.t), curve.count - (1 if curve.is_loop else 2))
        return EdgeHit(hit.curve, span, hit.t - span, hit.distance_px)
