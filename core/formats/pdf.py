"""PDF of contours at true size, one page; it needs no screen's library.

What is written
---------------
One path for each contour, absolute m, l or c, and h, in the unit of the profile, which one matrix
brings to the points of PDF. The page is the contours' box as in SVG (`core.formats.svg.page`), to a
millionth of a point. Layers are optional content, which viewers can hide. No fonts, no time stamps:
the same contours give the same bytes.

Not `QPdfWriter`: it rounds the page to whole points, which is up to 0.18 mm off (Qt 6.11 makes a
page of 281.43 points one of 281), and stamps the time.
"""

from __future__ import annotations

import hashlib
import math
import zlib
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.beziers import Beziers
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats import decimals
from core.formats.contours import Contour, Contours
from core.formats.svg import page

POINTS_PER_MM: Final = 72 / 25.4
"""Points of PDF in a millimetre."""

MAX_SIDE: Final = 14_400
"""Longest side of a page in its units, 200 inches; larger ones count in a larger unit (PDF 1.6)."""

_PLACES: Final = 6
"""Decimals of the page's sides in points."""

_LEVEL: Final = 1
"""Of compression: five times as fast as the usual 6, for an eighth more bytes."""

_FIRST_LAYER: Final = 6
"""Number of the first object that is a layer."""


def encode(contours: Contours, title: str) -> bytes:
    """Bytes of a PDF file.

    Parameters
    ----------
    contours
        What to draw: cubics or polylines.
    title
        Title of the drawing.

    Raises
    ------
    NinepointError
        If a contour is of another kind.
    """
    _, size = page(contours)
    sides = size * contours.profile.unit_mm * POINTS_PER_MM
    unit = max(math.ceil(float(sides.max()) / MAX_SIDE), 1)
    width, height = (decimals.word(side, _PLACES) for side in (sides / unit).tolist())
    layers = _layers(contours)
    refs = " ".join(f"{_FIRST_LAYER + k} 0 R" for k in range(len(layers)))
    names = " ".join(f"/L{k} {_FIRST_LAYER + k} 0 R" for k in range(len(layers)))
    catalog = (
        "<< /Type /Catalog /Pages 2 0 R /OCProperties"
        f" << /OCGs [{refs}] /D << /Order [{refs}] /ON [{refs}] >> >> >>"
    )
    sheet = (
        f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width} {height}] /UserUnit {unit}"
        f" /Contents 4 0 R /Resources << /Properties << {names} >> >> >>"
    )
    drawn = zlib.compress(_content(contours, unit, list(layers)), _LEVEL)
    return _file(
        [
            catalog.encode(),
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            sheet.encode(),
            b"<< /Length %d /Filter /FlateDecode >>\nstream\n%s\nendstream" % (len(drawn), drawn),
            f"<< /Title {_text(title)} /Creator {_text('Ninepoint')} >>".encode(),
            *(f"<< /Type /OCG /Name {_text(label)} >>".encode() for label in layers.values()),
        ]
    )


def _layers(contours: Contours) -> dict[str, str]:
    """Layers and what they are called, in their order."""
    if contours.profile.layers != "by curve":
        return {contour.layer: contour.layer.capitalize() for contour in contours.contours}
    return {contour.layer: contour.name for contour in contours.contours}


def _content(contours: Contours, unit: int, layers: list[str]) -> bytes:
    """What is drawn on the page, in the order of the contours."""
    profile, places = contours.profile, contours.places
    origin, size = page(contours)
    corner = origin - (0.0, size[1])
    scale = f"{profile.unit_mm * POINTS_PER_MM / unit:.12g}"
    red, green, blue = (f"{int(profile.colour[k : k + 2], 16) / 255:.6g}" for k in (1, 3, 5))
    width = np.format_float_positional(profile.width_mm / profile.unit_mm, precision=9, trim="-")
    head = f"{scale} 0 0 {scale} 0 0 cm\n{red} {green} {blue} RG\n{width} w 1 j\n"
    parts = [head.encode()]
    for contour in contours.contours:
        parts.append(b"/OC /L%d BDC\n" % layers.index(contour.layer))
        parts.append(_path(contour, corner, places))
        parts.append(b"s\nEMC\n" if contour.closed else b"S\nEMC\n")
    return b"".join(parts)


def _path(contour: Contour, corner: NDArray[np.float64], places: int) -> bytes:
    """Operators of a contour; the lower left corner of the page is ``corner`` in the document."""
    shape = contour.shape
    if isinstance(shape, Beziers):
        start, rows = shape.controls[:1, 0], shape.controls[:, 1:].reshape(-1, 6)
        between = (b"", *[b" "] * 5, b" c\n")
    elif isinstance(shape, Polyline):
        start, rows = shape.points[:1], shape.points[1:]
        between = (b"", b" ", b" l\n")
    else:
        raise NinepointError(f"PDF holds cubics or polylines; {contour.name!r} is neither.")
    tiled = np.tile(corner, rows.shape[1] // 2)
    first = decimals.text((b"", b" ", b" m\n"), start - corner, (places,) * 2)
    return first + decimals.text(between, rows - tiled, (places,) * len(tiled))


def _text(words: str) -> str:
    """Words as PDF can hold all of them; halves of characters become question marks."""
    return f"<FEFF{words.encode('utf-8', 'replace').decode().encode('utf-16-be').hex().upper()}>"


def _file(objects: list[bytes]) -> bytes:
    """Objects numbered from 1, the table of their places, and the end of the file."""
    parts = [b"%PDF-1.6\n%\xe2\xe3\xcf\xd3\n"]
    places = []
    length = len(parts[0])
    for number, body in enumerate(objects, start=1):
        places.append(length)
        parts.append(b"%d 0 obj\n%s\nendobj\n" % (number, body))
        length += len(parts[-1])
    digest = hashlib.sha256(b"".join(parts)).hexdigest()[:32].upper()
    count = len(objects) + 1
    table = "".join(f"{place:010d} 00000 n \n" for place in places)
    parts.append(
        f"xref\n0 {count}\n0000000000 65535 f \n{table}trailer\n<< /Size {count} /Root 1 0 R"
        f" /Info 5 0 R /ID [<{digest}> <{digest}>] >>\nstartxref\n{length}\n%%EOF\n".encode()
    )
    return b"".join(parts)
