"""The view of the drawing: a frozen mapping between pixels (y down) and millimetres (y up)."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

MIN_SCALE: Final = 1e-8
"""Pixels per mm: the largest drawing (coordinates of 1e9 mm) is then some 20 pixels wide."""

MAX_SCALE: Final = 1e6
"""Pixels per mm: a pixel is a nanometre, some eight steps of a float at the largest coordinate."""

MAX_CENTRE_MM: Final = 1e10
"""Farthest place to look at, well beyond the largest coordinate."""

DEFAULT_SPAN_MM: Final = 200.0
"""Width of the view when there is nothing to fit."""


class Camera(NamedTuple):
    """Where the canvas looks at, and how close; both axes have the same scale.

    Attributes
    ----------
    x_mm, y_mm
        Place in the drawing that the middle of the canvas shows.
    scale
        Logical pixels per millimetre.
    width, height
        Size of the canvas in logical pixels.
    """

    x_mm: float = 0.0
    y_mm: float = 0.0
    scale: float = 4.0
    width: int = 1
    height: int = 1

    @property
    def pixel_mm(self) -> float:
        """Size of a pixel in millimetres."""
        return 1.0 / self.scale

    @property
    def frame(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The place in the middle of the view, its scale with y turned over, the middle in pixels.

        Pixels are ``(place - centre) * flip + middle``; each array has the shape (2,) and is
        read-only.
        """
        return _frame(self)

    @property
    def decimals(self) -> int:
        """Decimals of a coordinate in mm that tell one pixel from the next, 0 to 6."""
        return min(max(math.ceil(math.log10(self.scale)), 0), 6)

    def to_pixels(self, points_mm: ArrayLike) -> NDArray[np.float64]:
        """Pixels of points in millimetres, shape (..., 2)."""
        centre, flip, middle = self.frame
        # All x before all y: so NumPy goes along many points, and not across each of them.
        points = np.asarray(points_mm, order="F")
        # The centre goes first: far from the origin this keeps the digits.
        pixels: NDArray[np.float64] = (points - centre) * flip + middle
        return pixels

    def to_mm(self, points_px: ArrayLike) -> NDArray[np.float64]:
        """Millimetres of points in pixels, shape (..., 2)."""
        centre, flip, middle = self.frame
        points: NDArray[np.float64] = (np.asarray(points_px) - middle) / flip + centre
        return points

    def rectangle_mm(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower left and upper right corner of what is in view."""
        centre, flip, middle = self.frame
        half = middle / flip[0]
        return centre - half, centre + half

    def resized(self, width: int, height: int) -> Camera:
        """Return the same view on a canvas of another size; the middle stays."""
        return self._replace(width=max(width, 1), height=max(height, 1))

    def moved(self, dx_px: float, dy_px: float) -> Camera:
        """Return the view after the paper was pushed by some pixels."""
        return self._looking_at(
            self.x_mm - dx_px / self.scale, self.y_mm + dy_px / self.scale, self.scale
        )

    def zoomed(self, factor: float, at_px: ArrayLike | None = None) -> Camera:
        """Return the view ``factor`` times as close; the place at ``at_px`` or the middle stays."""
        at = np.array([self.width / 2, self.height / 2]) if at_px is None else np.asarray(at_px)
        scale = float(np.clip(self.scale * factor, MIN_SCALE, MAX_SCALE))
        held = self.to_mm(at)
        away = at - (self.width / 2, self.height / 2)
        x, y = held - away / (scale, -scale)
        return self._looking_at(float(x), float(y), scale)

    def at_scale(self, scale: float) -> Camera:
        """Return the view of the same place at another scale."""
        return self.zoomed(scale / self.scale)

    def fitted(self, points_mm: NDArray[np.float64], margins_px: tuple[float, ...]) -> Camera:
        """Return the view that shows all points, as close as it can.

        Parameters
        ----------
        points_mm
            Points to be seen, shape (n, 2). None at all shows the origin; a single place is
            centred, at a width of `DEFAULT_SPAN_MM`.
        margins_px
            Free borders: left, top, right, bottom.
        """
        left, top, right, bottom = margins_px
        room = np.maximum([self.width - left - right, self.height - top - bottom], 1.0)
        if len(points_mm):
            low, high = points_mm.min(axis=0), points_mm.max(axis=0)
        else:
            low = high = np.zeros(2)
        size = high - low
        if not size.any():
            size = np.array([DEFAULT_SPAN_MM, 0.0])
        with np.errstate(divide="ignore"):
            scale = float(np.clip((room / size).min(), MIN_SCALE, MAX_SCALE))
        # The middle of the free room shows the middle of the points.
        shift = np.array([left - right, bottom - top]) / (2 * scale)
        x, y = (low + high) / 2 - shift
        return self._looking_at(float(x), float(y), scale)

    def _looking_at(self, x_mm: float, y_mm: float, scale: float) -> Camera:
        x, y = np.clip([x_mm, y_mm], -MAX_CENTRE_MM, MAX_CENTRE_MM)
        return self._replace(x_mm=float(x), y_mm=float(y), scale=scale)


@lru_cache(maxsize=16)
def _frame(
    camera: Camera,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    # Each event asks for them, and numbers take longer to become an array than to be added.
    centre = np.array([camera.x_mm, camera.y_mm])
    flip = np.array([camera.scale, -camera.scale])
    middle = np.array([camera.width / 2, camera.height / 2])
    centre.flags.writeable = flip.flags.writeable = middle.flags.writeable = False
    return centre, flip, middle
