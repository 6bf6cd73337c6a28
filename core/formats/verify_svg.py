"""What an SVG file of ours says, read by a strict reader on the standard XML parser.

It knows what SVG demands and nothing of how the file was written; it refuses all that we do not
write, so that a slip cannot hide behind what a lenient reader makes of it.
"""

from __future__ import annotations

import re
from typing import Final
from xml.etree.ElementTree import Element, ParseError

import numpy as np
from numpy.typing import NDArray

from core.errors import NinepointError
from core.formats.readback import Readback, arcs_read, cubics_read, numbers_in

_SVG: Final = "{http://www.w3.org/2000/svg}"

_LENGTH: Final = re.compile(r"(\d+(?:\.\d+)?)(mm|in)")

_DATA: Final = re.compile(r"M([^A-Za-z]+)((?:[LC][^A-Za-z]+)+)(Z?)")
"""Path data: a start, lines or cubics, and perhaps the way back."""

_STEPS: Final = {"L": 2, "C": 6}
"""Numbers of a step."""


def outlines(data: bytes, fine: float) -> tuple[str, NDArray[np.float64], list[Readback]]:
    """Unit, size of the page, and contours of a file; y is up and negative.

    Parameters and errors are those of `core.formats.verify_dxf.outlines`.
    """
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root: Element = fromstring(data, forbid_dtd=True)
    except (ParseError, DefusedXmlException, LookupError, ValueError) as error:
        raise NinepointError(f"it is no XML ({error})") from error
    unit, size = _page(root)
    found = []
    for layer in root.findall(f"{_SVG}g"):
        if "transform" in layer.attrib:
            raise NinepointError("it has a transform")
        name = layer.get("id", "")
        found += [_outline(path, name, fine) for path in layer.findall(f"{_SVG}path")]
    if len(found) != sum(1 for _ in root.iter(f"{_SVG}path")):
        raise NinepointError("a path is on no layer")
    return unit, size, found


def _page(root: Element) -> tuple[str, NDArray[np.float64]]:
    """Unit and size; a view box of another size would be a scale."""
    sides = [_LENGTH.fullmatch(root.get(name, "")) for name in ("width", "height")]
    if root.tag != f"{_SVG}svg" or sides[0] is None or sides[1] is None:
        raise NinepointError("its page has no size")
    if sides[0][2] != sides[1][2] or root.get("viewBox") != f"0 0 {sides[0][1]} {sides[1][1]}":
        raise NinepointError("its page has a scale")
    return sides[0][2], np.array([float(side[1]) for side in sides if side is not None])


def _outline(path: Element, layer: str, fine: float) -> Readback:
    match = _DATA.fullmatch(path.get("d", "").strip())
    if match is None or "transform" in path.attrib:
        raise NinepointError("a path has other data than lines or cubics")
    kind = match[2][0]
    # One kind of step: then its letter is nothing but a blank between numbers.
    if not set(re.findall("[A-Z]", match[2])) <= {kind}:
        raise NinepointError("a path has lines and cubics")
    start = numbers_in(match[1], 2)
    count = match[2].count(kind) * _STEPS[kind]
    steps = numbers_in(match[2].replace(kind, " "), count)
    points = np.concatenate([start, steps]).reshape(-1, 2) * (1.0, -1.0)
    if kind == "L":
        closed = match[3] == "Z"
        return arcs_read(points, np.zeros(len(points)), closed, layer, fine)
    rows = (len(points) - 1) // 3
    controls = np.empty((rows, 4, 2))
    controls[:, 0], controls[:, 1:] = points[:-1:3], points[1:].reshape(rows, 3, 2)
    closed = match[3] == "Z" and bool((points[0] == points[-1]).all())
    return cubics_read(controls, closed, layer, fine)
