"""The sheet: a widget that shows a session's document, draws once per turn, and can be zoomed."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QWidget

from app.camera import Camera
from app.dirt import dirt, region_of
from app.grid import Background, paint_frame, ruler_font, view_step
from app.guard import guarded
from app.handover import Handover
from app.picture import HINT_ROOM_PX, Picture, Setting
from app.pixel_box import box_of
from app.rulers import Rulers
from app.scene import NOTHING, Overlay, Scene
from app.session import Selection, Session
from app.style import SIZES, color, palette_of
from core.document import Document

FIRST_HINT: Final = "Drag a dot. Or pull the curve itself."
"""Shown on the sheet until the first edit."""

EMPTY_HINT: Final = "Press P, then click to place the points of a curve."
"""Shown on a sheet without curves."""

NO_LIMIT_HINT: Final = (
    "These parameters have no limit curve; only the polygon is drawn. Move a slider a little."
)
"""Shown when the scheme has no limit."""

_SMOOTH: Final = QPainter.RenderHint.Antialiasing

MM_PER_INCH: Final = 25.4

SMALL_MARGIN: Final = 0.12
"""Largest share of a small sheet that the margin of a fitted drawing takes on each side."""


class Sheet(QWidget):
    """Shows the document of a session: grid, rulers, curves, and what a hand adds.

    Everything that is drawn is computed before painting, once for all events that wait.

    Parameters
    ----------
    session
        What is shown.
    parent
        The widget that holds it.

    Signals
    -------
    zoom_changed(float)
        The scale in logical pixels per millimetre.
    """

    zoom_changed = Signal(float)
    _due = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self._camera = Camera()
        self._is_fitted = True
        self._scene = Scene()
        self._background = Background()
        self._rulers = Rulers(self)
        self._picture = Picture()
        self._handover = Handover(self)
        self._setting: tuple[tuple[object, ...], Setting] | None = None
        self._ground: tuple[object, ...] = ()
        self._is_stale = True
        self._shown_overlay: Overlay = NOTHING
        self._notice = ""
        self._show_polygon = self._show_grid = True
        self._first_document = session.document
        self._is_taught = session.undo_name is not None
        self._is_due = False
        self._due.connect(self._draw, Qt.ConnectionType.QueuedConnection)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumSize(160, 120)
        session.changed.connect(self._on_changed)
        session.selection_changed.connect(self._on_selection_changed)
        session.status_changed.connect(self.refresh)

    @property
    def camera(self) -> Camera:
        """The view."""
        return self._camera

    @property
    def scene(self) -> Scene:
        """What is drawn, up to date."""
        self._settle()
        return self._scene

    @property
    def overlay(self) -> Overlay:
        """What the hand adds to the picture."""
        return NOTHING

    @property
    def show_polygon(self) -> bool:
        """Whether control polygons and points are shown, and can be taken; the curve always can."""
        return self._show_polygon

    @show_polygon.setter
    def show_polygon(self, shown: bool) -> None:
        self._show_polygon = shown
        self.refresh()

    @property
    def show_grid(self) -> bool:
        """Whether the grid is shown."""
        return self._show_grid

    @show_grid.setter
    def show_grid(self, shown: bool) -> None:
        self._show_grid = shown
        self.refresh()

    @property
    def notice(self) -> str:
        """The sentence that stays above the drawing."""
        return self._notice

    def look(self, camera: Camera) -> None:
        """Change the view."""
        old, self._camera = self._camera, camera
        self._is_fitted = False
        if old.scale != camera.scale:
            self.zoom_changed.emit(camera.scale)
        if old != camera:
            self.refresh()

    def fit_all(self) -> None:
        """Show the whole drawing as large as it fits."""
        curves = self.session.document.curves
        corners = [corner for curve in curves if curve.count for corner in curve.box]
        self._fit(np.array(corners).reshape(-1, 2))
        self._is_fitted = True

    def fit_selection(self) -> None:
        """Show the selected points as large as they fit; without any, the whole drawing."""
        curves = self.session.document.curves
        selected = self.session.selection.points.by_curve
        if selected:
            places = [curves[curve].places(points) for curve, points in selected.items()]
            self._fit(np.concatenate(places))
        else:
            self.fit_all()

    def zoom_by(self, factor: float) -> None:
        """Zoom about the middle of the sheet."""
        self.look(self._camera.zoomed(factor, place_px(self._content().center())))

    def zoom_real_size(self) -> None:
        """Show a millimetre as a millimetre, as far as the screen tells its resolution."""
        self.zoom_by(self.logicalDpiX() / MM_PER_INCH / self._camera.scale)

    def refresh(self) -> None:
        """Draw anew, once, when the events that wait have been dealt with."""
        self._is_stale = True
        self._draw_soon()

    def show_notice(self, sentence: str) -> None:
        """Show a sentence that stays above the drawing, such as a warning, or none."""
        if sentence != self._notice:
            self._notice = sentence
            self.refresh()

    def mark_mouse(self, position: QPointF | None) -> None:
        """Mark a place on the rulers, or none."""
        self._rulers.mark(position)

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:
        setting = self._present_setting()
        if self._is_due or not self._ground or setting is not self._ground[0]:
            # What differs outside of the event's region is painted by the next event.
            self._renew()
        whole = around = event.region().boundingRect()
        with QPainter(self) as painter:
            # Qt has cut the painter to the region.
            self._background.paint(painter, whole.contains(setting.view))
            if not setting.view.contains(around):
                painter.setClipRect(setting.view)
                around = around.intersected(setting.view)
            if not around.isEmpty():
                painter.setRenderHint(_SMOOTH)
                self._picture.paint(painter, box_of(around))
            if self.hasFocus() and _is_at_edge(whole, self.rect()):
                painter.setClipping(False)
                painter.setRenderHint(_SMOOTH, False)
                size = self.width(), self.height()
                paint_frame(painter, size, color(setting.palette.accent))
        self._handover.follow(whole.topLeft())

    @guarded
    def resizeEvent(self, event: QResizeEvent) -> None:
        fitted = self._is_fitted
        self.look(self._camera.resized(self.width(), self.height()))
        if fitted:
            self.fit_all()

    @guarded
    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        self._setting = None  # the font may be another one
        self.refresh()

    def words(self) -> str:
        """Return the words shown on the sheet, or ""."""
        if not self.session.document.curves:
            return "" if self.overlay.preview is not None else EMPTY_HINT
        if not self._scene.has_limit:
            return NO_LIMIT_HINT
        # Without a dot to be seen there is none to be dragged.
        return "" if self._is_taught or self._scene.hidden else FIRST_HINT

    def document_replaced(self) -> None:
        """Take note that another document is shown (New, Open)."""
        self.fit_all()

    def _content(self) -> QRectF:
        """Return the sheet without its rulers."""
        return QRectF(self.rect()).adjusted(SIZES.ruler, SIZES.ruler, 0, 0)

    def _fit(self, points_mm: NDArray[np.float64]) -> None:
        margin = min(SIZES.fit_margin, SMALL_MARGIN * min(self.width(), self.height()))
        near = SIZES.ruler + margin
        below = margin + (HINT_ROOM_PX if self.words() else 0.0)
        self.look(self._camera.fitted(points_mm, (near, near, margin, below)))

    def _settle(self) -> None:
        """Compute the scene, if anything has changed."""
        if self._is_stale:
            self._is_stale = False
            session = self.session
            self._shown_overlay = self.overlay
            self._scene.update(
                session.document, session.origin, self._camera, self.devicePixelRatioF(),
                self._shown_overlay,
            )  # fmt: skip

    def _present_setting(self) -> Setting:
        """How the picture is to be drawn; the same object as long as it is the same way."""
        # The colours, and a screen's ratio, change without a word.
        ratio = self.devicePixelRatioF()
        key = self.palette().cacheKey(), ratio, self.width(), self.height(), self._show_polygon
        if self._setting is None or self._setting[0] != key:
            view = self._content().toAlignedRect()
            made = Setting(palette_of(self), ratio, view, self.font(), self._show_polygon)
            self._setting = key, made
        return self._setting[1]

    def _draw_soon(self) -> None:
        """Draw once the input that waits has been dealt with, and before anything is painted.

        A timer would come after that: labels that follow the mouse would be painted and handed to
        the screen first, and the canvas in a second turn.
        """
        if not self._is_due:
            self._is_due = True
            self._due.emit()

    def _draw(self) -> None:
        """Have painted what differs from what is shown; without a difference, nothing."""
        self._is_due = False
        if self._ground:  # before the first paint there is nothing to be compared with
            self._renew()

    def _renew(self) -> None:
        """Make the picture of what is shown now, and have painted where it differs."""
        things, setting = self._picture.things, self._present_setting()
        ground = setting, self._camera, self._show_grid, self.hasFocus()
        is_other, is_first = ground != self._ground, not self._ground
        self._ground = ground
        if is_other:
            self._is_stale = True
            self._look_behind(setting)
        self._settle()
        notice = self._notice if self.session.document.curves else ""
        self._picture.update(
            setting, self._scene, self.session.selection, self._shown_overlay, self.words(), notice
        )
        if is_other:
            if not is_first:  # the first time all is painted anyway
                self.update()
            return
        boxes = dirt(things, self._picture.things)
        region = region_of(boxes, setting.view)
        if not region.isEmpty():
            self.update(region)

    def _look_behind(self, setting: Setting) -> None:
        """Have grid and rulers show the view."""
        camera, palette, ratio = self._camera, setting.palette, setting.ratio
        step = view_step(camera, QFontMetricsF(ruler_font(setting.font)))
        self._background.look(camera, palette, ratio, step, self._show_grid)
        self._rulers.show_view(camera, palette, ratio, setting.font, step, self.hasFocus())

    def _on_changed(self, old: Document, new: Document) -> None:
        # The first state of a history has no name. Undo and cancel lead back to the document that
        # is known; another one there means another history.
        if self.session.undo_name is not None:
            self._is_taught = True
        elif new is not self._first_document:
            self._first_document = new
            self.document_replaced()
        if old.curves is not new.curves or old.parameters is not new.parameters:
            self.refresh()

    def _on_selection_changed(self, old: Selection, new: Selection) -> None:
        self.refresh()


def _is_at_edge(part: QRect, whole: QRect) -> bool:
    """Whether a part of a rectangle touches one of its sides."""
    return not whole.adjusted(1, 1, -1, -1).contains(part)


def place_px(point: QPointF) -> NDArray[np.float64]:
    """Pixels of a Qt point, shape (2,)."""
    return np.array([point.x(), point.y()])
