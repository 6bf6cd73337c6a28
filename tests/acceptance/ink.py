"""What renderers paint: dark pixels."""

from collections import Counter

import numpy as np
from PySide6.QtGui import QImage, QImageReader

from seen import PAGE, Seen

PX_PER_MM = 50
MAX_PIXELS = 130_000_000
PAPER = 250
"""Grey of what is still paper; a line of a fifth of a pixel's width is darker."""


def resolution(size_mm):
    """Whole pixels a mm, such that a picture is not too large."""
    return min(PX_PER_MM, int(np.sqrt(MAX_PIXELS / np.prod(size_mm))))


def ink(picture, px_per_mm, stroke_mm, margin_mm=0.0):
    """What a picture of a page shows.

    Parameters
    ----------
    picture
        Path of a file without transparency.
    stroke_mm
        Width of the lines.
    margin_mm
        How much larger than the drawing the page is on each side.
    """
    QImageReader.setAllocationLimit(0)
    image = QImage(str(picture))
    assert not image.isNull()
    grey = image.convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(grey.constBits(), dtype=np.uint8).reshape(grey.height(), -1)
    y, x = np.nonzero(rows[:, : grey.width()] < PAPER)
    corner = margin_mm * np.array([1, -1])
    centres = np.stack([x + 0.5, -(y + 0.5)], axis=1) / px_per_mm - corner
    low, high = (x.min(), -(y.max() + 1)), (x.max() + 1, -y.min())
    box = np.array([low, high]) / px_per_mm - corner
    kinds = Counter({"pixels": len(centres)})
    return Seen([centres], None, None, kinds, PAGE, box, 0.5 / px_per_mm, stroke_mm)
