"""DXF at true size: R2000 or R12, one entity for each contour. Write only.

What is written
---------------
Coordinates in the unit of the profile, y up, and both header variables that say so: readers go by
``$INSUNITS``, or by ``$MEASUREMENT``, and import 25.4 times too large when they disagree. R12 knows
no units. A closed contour has the closed flag and does not repeat its first vertex; a closed SPLINE
ends in the very point where it starts. All layers are declared. Readers choke on three things that
ezdxf writes or omits by default: ``$PDMODE`` (a warning in Inkscape), ``$PSVPSCALE`` 0 (an empty
page in LibreCAD), and no extents. The same contours give the same bytes: no dates, no random
identifiers.

ezdxf writes a drawing without entities, which it audits before; the text of the entities
(`core.formats.dxf_text`) is put where their section is empty.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

import numpy as np

from core.errors import NinepointError
from core.formats import dxf_text
from core.formats.contours import Contours
from core.formats.layers import layer_names
from core.formats.tables import Tables
from core.splines import Spline

if TYPE_CHECKING:
    from ezdxf.document import Drawing

MAX_VERTICES: Final = 1_000_000
"""Largest number of vertices in a file."""

BLACK: Final = 7
"""Colour index that is black on white and white on black."""

MAX_POINTS: Final = 100_000
"""Largest number of POINT entities: what reads them needs a tenth of a millisecond for each."""

_UNITS: Final = {"mm": (4, 1), "in": (1, 0)}
"""``$INSUNITS`` and ``$MEASUREMENT``."""

_VIEW_SHARE: Final = 1.1
"""Height of the first view, as a share of the drawing's larger side."""

_EMPTY: Final = "  2\nENTITIES\n  0\nENDSEC\n"
"""The section of the entities as ezdxf writes it without any."""


def encode(content: Contours | Tables, title: str) -> bytes:  # noqa: ARG001 - as of other formats
    """Text of a DXF file, ASCII.

    Parameters
    ----------
    content
        What to draw; points of tables become POINT entities.
    title
        Not used: DXF has no place for a title.

    Raises
    ------
    NinepointError
        If there are more than `MAX_VERTICES` vertices or `MAX_POINTS` points, or the drawing fails
        ezdxf's audit.
    """
    if isinstance(content, Tables):
        most, what = MAX_POINTS, "points"
    else:
        most, what = MAX_VERTICES, "vertices"
    if content.count > most:
        raise NinepointError(
            f"The drawing needs {content.count:,} {what}; at most {most:,} are written into a DXF"
            " file. Choose a larger tolerance."
        )
    with _reproducible():
        drawing = _frame(content)
        faults = drawing.audit().errors
        if faults:
            raise NinepointError(f"The DXF drawing fails its audit: {faults[0].message}")
        entities = _entities(content, drawing)
        text = io.StringIO()
        drawing.write(text)
    before, found, after = text.getvalue().partition(_EMPTY)
    if not found:
        raise NinepointError("The DXF frame has no empty section of entities; report this.")
    head, tail = _EMPTY[: len("  2\nENTITIES\n")], _EMPTY[len("  2\nENTITIES\n") :]
    return b"".join([(before + head).encode("ascii"), *entities, (tail + after).encode("ascii")])


def colour_index(colour: str) -> int:
    """Nearest of the 255 colours of DXF to "#rrggbb"."""
    from ezdxf.colors import DXF_DEFAULT_COLORS

    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    if not wanted.any():
        return BLACK
    known = np.array(DXF_DEFAULT_COLORS[1:256])
    rgb = np.stack([known >> 16 & 255, known >> 8 & 255, known & 255], axis=1)
    return int(((rgb - wanted) ** 2).sum(axis=1).argmin()) + 1


def layers_of(content: Contours | Tables) -> list[str]:
    """Layer of each contour, or of each table."""
    if isinstance(content, Contours):
        return [contour.layer for contour in content.contours]
    names = [table.curve.name for table in content.tables]
    return layer_names(names if content.profile.layers == "by curve" else None, len(names))


def _frame(content: Contours | Tables) -> Drawing:
    """Drawing with everything but its entities."""
    from ezdxf.filemanagement import new  # a tenth of a second that the start must not take

    profile = content.profile
    if profile.version == "R12":
        drawing = new("R12", setup=False)
        drawing.header["$HANDLING"] = 0
    else:
        units, measurement = _UNITS[profile.unit]
        drawing = new("R2000", setup=False, units=units)
        drawing.header["$MEASUREMENT"] = measurement
        drawing.header["$PSVPSCALE"] = 1
    del drawing.header["$PDMODE"]
    colour = colour_index(profile.colour)
    for layer in dict.fromkeys(layers_of(content)):
        drawing.layers.add(layer, color=colour)
    space = drawing.modelspace()
    low, high = content.box
    # ezdxf copies the layout's extents into the header, but not a corner that is the origin.
    space.dxf.extmin = drawing.header["$EXTMIN"] = (*low.tolist(), 0.0)
    space.dxf.extmax = drawing.header["$EXTMAX"] = (*high.tolist(), 0.0)
    centre = ((low + high) / 2).tolist()
    # A table may hold a single point.
    height = _VIEW_SHARE * float((high - low).max()) or 1.0
    drawing.set_modelspace_vport(height, centre)
    return drawing


def _entities(content: Contours | Tables, drawing: Drawing) -> list[bytes]:
    """Text of all entities; the drawing gives them their handles."""
    owner = drawing.modelspace().layout_key
    new = drawing.entitydb.next_handle
    is_old = content.profile.version == "R12"
    if isinstance(content, Tables):
        return [
            dxf_text.points(rows, layer, new, None if is_old else owner)
            for rows, layer in zip(content.points, layers_of(content), strict=True)
        ]
    found = []
    for contour in content.contours:
        if is_old:
            found.append(dxf_text.polyline(contour, content.places))
        elif isinstance(contour.shape, Spline):
            found.append(dxf_text.spline(contour, content.places, new(), owner))
        else:
            found.append(dxf_text.lwpolyline(contour, content.places, new(), owner))
    return found


@contextmanager
def _reproducible() -> Iterator[None]:
    """Let ezdxf write a constant instead of the time and of random identifiers, and be quiet."""
    from ezdxf import options  # type: ignore[attr-defined]  # its documented place

    logger = logging.getLogger("ezdxf")
    before = options.write_fixed_meta_data_for_testing, logger.disabled
    # It warns that R12 has no units, which our own report says.
    options.write_fixed_meta_data_for_testing, logger.disabled = True, True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing, logger.disabled = before
