"""Text of the entities of a DXF file: their vertices in bulk.

ezdxf spends ten microseconds on a vertex; these routines write the tags as ezdxf does, all
vertices of a contour at once. Numbers keep one decimal at least, as some readers take a number
without a point for another type.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.beziers import Beziers
from core.errors import NinepointError
from core.flatten import Polyline
from core.formats import decimals
from core.formats.contours import Contour, bulge_places
from core.splines import DEGREE, Spline

PLANAR: Final = 8
"""The flag of a SPLINE that it lies in a plane. The flag "closed" is never set: LibreCAD then draws
another curve. The curve closes as its ends are the same point."""

_CLOSED: Final = 1
"""The flag of polylines."""

_LEAST: Final = 1

_FLAT: Final = b"\n 30\n0.0\n"
"""The third coordinate, between two points."""

NewHandle = Callable[[], str]


def lwpolyline(contour: Contour, places: int, handle: str, owner: str) -> bytes:
    """A contour of arcs or lines as LWPOLYLINE, from R2000 on."""
    values, decimal = _vertices(contour, places)
    head = (
        _common("LWPOLYLINE", contour.layer, handle, owner)
        + f"100\nAcDbPolyline\n 90\n{len(values)}\n 70\n{_CLOSED * contour.closed}\n"
    )
    between = (b" 10\n", b"\n 20\n", b"\n 42\n")[: len(decimal)]
    return head.encode() + decimals.text((*between, b"\n"), values, decimal, _LEAST)


def polyline(contour: Contour, places: int) -> bytes:
    """A contour of arcs or lines as POLYLINE of R12, without handles."""
    values, decimal = _vertices(contour, places)
    layer = contour.layer.encode()
    head = (
        b"  0\nPOLYLINE\n  8\n%b\n 66\n1\n 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n%d\n"
        % (layer, _CLOSED * contour.closed)
    )  # fmt: skip
    vertex = b"  0\nVERTEX\n  8\n" + layer + b"\n 10\n"
    ends = (_FLAT + b" 42\n", b"\n") if contour.is_bent else (_FLAT,)
    rows = decimals.text((vertex, b"\n 20\n", *ends), values, decimal, _LEAST)
    return head + rows + b"  0\nSEQEND\n  8\n%b\n" % layer


def spline(contour: Contour, places: int, handle: str, owner: str) -> bytes:
    """A contour as SPLINE of degree 3: clamped, inner knots simple."""
    shape = contour.shape
    if not isinstance(shape, Spline):
        raise NinepointError(f"{contour.name!r} is no spline.")
    ends = [DEGREE + 1, *[1] * (len(shape.knots) - 2), DEGREE + 1]
    knots = np.repeat(shape.knots, ends)[:, None]
    controls = shape.controls
    head = (
        _common("SPLINE", contour.layer, handle, owner)
        + f"100\nAcDbSpline\n 70\n{PLANAR}\n 71\n{DEGREE}\n 72\n{len(knots)}\n"
        + f" 73\n{len(controls)}\n 74\n0\n"
    )
    return (
        head.encode()
        + decimals.text((b" 40\n", b".0\n"), knots, (0,))
        + decimals.text((b" 10\n", b"\n 20\n", _FLAT), controls, (places, places), _LEAST)
    )


def points(rows: NDArray[np.float64], layer: str, new: NewHandle, owner: str | None) -> bytes:
    """Points, shape (n, 2), as POINT entities; those of R12 have no owner."""
    head = f"  0\nPOINT\n  8\n{layer}\n"
    lines = []
    for x, y in rows.tolist():
        if owner is not None:
            head = _common("POINT", layer, new(), owner) + "100\nAcDbPoint\n"
        lines.append(f"{head} 10\n{x}\n 20\n{y}\n 30\n0.0\n")
    return "".join(lines).encode()


def _vertices(contour: Contour, places: int) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """Columns x, y, and bulge unless all pieces are lines; and their decimals."""
    shape = contour.shape
    if isinstance(shape, (Beziers, Spline)):
        raise NinepointError(f"{contour.name!r} is no polyline.")
    if isinstance(shape, Polyline) or not contour.is_bent:
        return shape.points, (places, places)
    values = np.column_stack([shape.points, shape.bulges])
    return values, (places, places, bulge_places(shape, places))


def _common(kind: str, layer: str, handle: str, owner: str) -> str:
    return f"  0\n{kind}\n  5\n{handle}\n330\n{owner}\n100\nAcDbEntity\n  8\n{layer}\n"
