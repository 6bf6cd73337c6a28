"""What a program makes of an exported file: lines in millimetres, contours, kinds of entities."""

import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from svgpathtools import Arc, Line, parse_path

PX_PER_MM = 96 / 25.4
SVG = "{http://www.w3.org/2000/svg}"
PARTS = 1024
"""Points of a Bézier curve or an arc of an SVG path."""

DRAWING, PAGE = "drawing", "page"
"""Where the origin is: where the drawing has it, or at the top left of the page."""


@dataclass
class Seen:
    """The geometry as the program has it.

    Attributes
    ----------
    lines
        Points in mm, y up, shape (n, 2) each; they may be parts of contours.
    contours, closed
        Number of contours, and of closed ones; None if the program has no such idea.
    kinds
        How often each kind of entity occurs.
    frame
        `DRAWING` or `PAGE`.
    box
        Smallest and largest x and y as the program states them; else they are those of the lines.
    finest
        Half of the step of the program's numbers, or of its pixels, in mm.
    stroke
        Width in mm of what is painted, if the lines are pixels.
    """

    lines: list
    contours: int | None
    closed: int | None
    kinds: Counter = field(default_factory=Counter)
    frame: str = DRAWING
    box: np.ndarray | None = None
    finest: float = 0.0
    stroke: float = 0.0

    @property
    def corners(self):
        if self.box is not None:
            return self.box
        points = np.concatenate(self.lines)
        return np.stack([points.min(axis=0), points.max(axis=0)])


def paths_of(root):
    """Points, closed flag and kinds of each subpath that is drawn in an SVG without transforms.

    y is up, and 0 at the top of the page; units are those of the view box.
    """
    hidden = {child for name in ("defs", "metadata") for part in root.iter(f"{SVG}{name}")
              for child in part.iter()}  # fmt: skip
    found = []
    for element in root.iter(f"{SVG}path"):
        if element in hidden:
            continue
        assert "transform" not in element.attrib
        for part in parse_path(element.get("d")).continuous_subpaths():
            points = np.concatenate([points_of(segment) for segment in part])
            ends = abs(part[0].start - part[-1].end) < 1e-6
            kinds = Counter(type(segment).__name__ for segment in part)
            found.append((np.stack([points.real, -points.imag], axis=1), bool(ends), kinds))
    return found


def points_of(segment):
    if isinstance(segment, Line):
        return np.array([segment.start, segment.end])
    share = np.linspace(0, 1, PARTS)
    if isinstance(segment, Arc):
        angle = np.radians(segment.theta + share * segment.delta)
        x, y = segment.radius.real * np.cos(angle), segment.radius.imag * np.sin(angle)
        return segment.center + segment.rot_matrix * (x + 1j * y)
    return np.poly1d(segment.poly())(share)


def seen_in_svg(path, frame=PAGE):
    """What an SVG file of paths holds, whose user unit is a millimetre."""
    root = ET.parse(path).getroot()
    _, _, width, height = map(float, root.get("viewBox").split())
    assert float(root.get("width").removesuffix("mm")) == width
    assert float(root.get("height").removesuffix("mm")) == height
    found = paths_of(root)
    lines = [points for points, _, _ in found]
    kinds = sum((kinds for _, _, kinds in found), Counter())
    return Seen(lines, len(lines), sum(closed for _, closed, _ in found), kinds, frame)
