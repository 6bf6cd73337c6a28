"""DXF of contours at true size: R2000, one LWPOLYLINE for each contour. Write only.

What is written
---------------
Coordinates in millimetres, y up, as they are in the document, and both header variables that say
so: readers go by ``$INSUNITS``, or by ``$MEASUREMENT``, and import 25.4 times too large when they
disagree. A closed contour has the closed flag and does not repeat its first vertex. One layer,
declared. Readers choke on three things that ezdxf writes or omits by default: ``$PDMODE`` (a
warning in Inkscape), ``$PSVPSCALE`` 0 (an empty page in LibreCAD), and no extents. The same
contours give the same bytes: no dates, no random identifiers.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

import numpy as np

from core.errors import NinepointError
from core.formats.contours import Contours

if TYPE_CHECKING:
    from ezdxf.document import Drawing

GUARD_DIGITS: Final = 4
"""Decimals beyond those of the tolerance: 0.01 mm is written with 6. CAD programs go on computing
with the vertices, so they get more than a picture."""

LAYER: Final = "CURVES"
"""Layer of all contours; a name in ASCII, which all readers know."""

COLOUR: Final = 7
"""Colour index of the layer: black on white, white on black."""

MAX_VERTICES: Final = 1_000_000
"""Largest number of vertices in a file; ezdxf takes some 8 s to write a million."""

_MILLIMETRES: Final = 4
_METRIC: Final = 1
_VIEW_SHARE: Final = 1.1
"""Height of the first view, as a share of the drawing's larger side."""


def encode(contours: Contours, title: str) -> bytes:  # noqa: ARG001 - as of other formats
    """Text of a DXF file, ASCII.

    Parameters
    ----------
    contours
        What to draw.
    title
        Not used: DXF has no place for a title.

    Raises
    ------
    NinepointError
        If there are more than `MAX_VERTICES` vertices, or the drawing fails ezdxf's audit.
    """
    if contours.vertices > MAX_VERTICES:
        raise NinepointError(
            f"The drawing needs {contours.vertices:,} vertices; at most {MAX_VERTICES:,} are"
            " written into a DXF file. Choose a larger tolerance."
        )
    with _reproducible():
        drawing = _drawing(contours)
        faults = drawing.audit().errors
        if faults:
            raise NinepointError(f"The DXF drawing fails its audit: {faults[0].message}")
        text = io.StringIO()
        drawing.write(text)
    return text.getvalue().encode("ascii")


def _drawing(contours: Contours) -> Drawing:
    from ezdxf.filemanagement import new  # a tenth of a second that the start must not take

    drawing = new("R2000", setup=False, units=_MILLIMETRES)
    drawing.header["$MEASUREMENT"] = _METRIC
    drawing.header["$PSVPSCALE"] = 1
    del drawing.header["$PDMODE"]
    drawing.layers.add(LAYER, color=COLOUR)
    space = drawing.modelspace()
    for line in contours.polylines:
        entity = space.add_lwpolyline([], close=line.closed, dxfattribs={"layer": LAYER})
        # x, y, start width, end width, bulge
        vertices = np.zeros((len(line.points), 5))
        vertices[:, :2] = line.points
        entity.lwpoints.extend(vertices)
    low, high = contours.low, contours.high
    # ezdxf copies the layout's extents into the header, but not a corner that is the origin.
    space.dxf.extmin = drawing.header["$EXTMIN"] = (*low.tolist(), 0.0)
    space.dxf.extmax = drawing.header["$EXTMAX"] = (*high.tolist(), 0.0)
    centre = ((low + high) / 2).tolist()
    drawing.set_modelspace_vport(_VIEW_SHARE * float((high - low).max()), centre)
    return drawing


@contextmanager
def _reproducible() -> Iterator[None]:
    """Let ezdxf write a constant instead of the time and of random identifiers."""
    from ezdxf import options  # type: ignore[attr-defined]  # its documented place

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
