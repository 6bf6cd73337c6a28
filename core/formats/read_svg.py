"""SVG of other programs, read as a sketch.

What is read
------------
Paths, lines, polylines, polygons, rectangles, circles and ellipses, with all transforms, groups,
nested drawings, ``use`` and ``symbol``, in the page's true size: width and height with their unit,
``viewBox`` and ``preserveAspectRatio``. y is flipped, so that the page's lower left corner is the
origin. Layers are Inkscape's; a contour is called by its label, its title or its id. What is
hidden (``display``, ``visibility``), and what is no geometry (texts, pictures), is left out with a
note. Fills, strokes, clips, masks and markers do not matter.

Bad files
---------
Nothing recurses, and nothing is loaded or expanded but ``use``, which pays from
`core.formats.budget`. A file is refused in one sentence, or read up to its faults with a note.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from core import atomic
from core.document import MAX_COORDINATE_MM
from core.errors import FileError
from core.formats import svg_shapes, svg_tree
from core.formats.affine import Matrix
from core.formats.budget import Budget, BudgetError, listed
from core.formats.outlines import Outline, outline
from core.formats.path_data import Drawn
from core.formats.sketch import Sketch, Trace
from core.formats.svg_shapes import SHAPES, Viewport
from core.formats.svg_tree import INKSCAPE, XLINK, Tree
from core.formats.svg_values import (
    PX_MM,
    declarations,
    fitted,
    hiding_rules,
    length,
    transform,
    view_box,
)

DEVIATION_MM: Final = 1e-4
"""Admitted deviation of arcs: a hundredth of the default tolerance of an export."""

MAX_USE_DEPTH: Final = 50
"""Largest number of ``use`` elements that stand in each other."""

_TOO_LARGE: Final = f"Shapes whose coordinates are not finite or beyond {MAX_COORDINATE_MM:g} mm"
_GROUPS: Final = frozenset({"g", "a", "switch"})
_LEFT_OUT: Final = {"text": "text", "image": "image", "foreignObject": "foreign object"}
_TITLED_UNITS: Final = frozenset({"mm", "cm", "in", "pt", "pc", "q"})
_RARE_UNITS: Final = {"pc": "pt", "q": "mm", "": "px", "%": "px"}
_TEXT_UNITS: Final = frozenset({"em", "rem", "ex", "ch"})


def read(path: str | Path) -> Sketch:
    """Read an SVG file.

    Raises
    ------
    FileError
        If the file cannot be read, is damaged, asks for too much work, or holds no geometry.
    """
    path = Path(path)
    return decode(atomic.read(path), path)


def decode(data: bytes, path: Path) -> Sketch:
    """Read the contents of an SVG file; ``path`` is for messages.

    Raises
    ------
    FileError
        As `read` does.
    """
    tree = svg_tree.parse(data, path)
    del data  # it may be the larger part of what memory there is
    try:
        with np.errstate(all="ignore"):  # what overflows is found in `_Walk.add`
            walk = _Walk(tree, path)
            walk.run()
    except BudgetError as error:
        raise FileError(path, str(error)) from error
    if not walk.traces:
        raise FileError(path, " ".join(["there are no lines or curves in it.", *walk.notes()]))
    return Sketch(tuple(walk.traces), walk.page.unit, walk.page.is_unit_known, walk.notes())


class _Page(NamedTuple):
    """The outermost element's view: user units to millimetres, y up."""

    matrix: Matrix
    viewport: Viewport
    unit: str
    is_unit_known: bool


def _page(attributes: Mapping[str, str]) -> _Page:
    wide, high = length(attributes.get("width")), length(attributes.get("height"))
    box = view_box(attributes.get("viewBox"))
    # Percentages of a window that is not there mean nothing; nor does a size that is not positive.
    wide = wide if wide and wide.unit != "%" and wide.number > 0 else None
    high = high if high and high.unit != "%" and high.number > 0 else None
    given = wide or high
    unit = given.unit if given else ""
    width = wide.mm if wide else None
    height = high.mm if high else None
    if box is None:
        bottom = height or 0.0
        view = Viewport((width or height or 100.0) / PX_MM, (height or width or 100.0) / PX_MM)
        across = Matrix(PX_MM, 0.0, 0.0, PX_MM, 0.0, 0.0)
    else:
        view = Viewport(box[2], box[3])
        if width is None and height is None:
            width, height = box[2] * PX_MM, box[3] * PX_MM
        width = width if width is not None else (height or 0.0) * box[2] / box[3]
        bottom = height if height is not None else width * box[3] / box[2]
        across = fitted(box, width, bottom, attributes.get("preserveAspectRatio"))
    upright = Matrix(1.0, 0.0, 0.0, -1.0, 0.0, bottom).after(across)
    name = "px" if unit in _TEXT_UNITS else _RARE_UNITS.get(unit, unit)
    # A pixel is 1/96 inch by the standard, but 1/72 or 1/90 in files of some programs.
    return _Page(upright, view, name, unit in _TITLED_UNITS)


class _State(NamedTuple):
    """What an element inherits."""

    matrix: Matrix
    viewport: Viewport
    is_visible: bool
    layer: str
    name: str  # of the `use` that brings it
    uses: tuple[int, ...]


class _Walk:
    """Visits the elements in the order in which they are painted, with a stack of its own."""

    def __init__(self, tree: Tree, path: Path) -> None:
        self.tree = tree
        self.path = path
        self.page = _page(tree.attributes[0])
        self.traces: list[Trace] = []
        self.left_out: Counter[str] = Counter()
        self._faults: Counter[str] = Counter()
        self._budget = Budget()
        self._cache: dict[tuple[int, Viewport, float], Drawn] = {}
        self._rules: dict[str, dict[str, str]] = {}
        for element, sheet in tree.texts.items():
            if tree.tags[element] == "style":
                for selector, given in hiding_rules(sheet).items():
                    self._rules.setdefault(selector, {}).update(given)
        self._stack: list[tuple[int, _State]] = []

    def run(self) -> None:
        """Visit all elements."""
        start = _State(self.page.matrix, self.page.viewport, True, "", "", ())
        self._push(0, self._styled(0, start) or start)
        while self._stack:
            element, state = self._stack.pop()
            self._budget.visit()
            self._visit(element, state)

    def notes(self) -> tuple[str, ...]:
        """Sentences on what was left out or repaired."""
        notes = [f"Left out: {listed(self.left_out)}."] if self.left_out else []
        if self.left_out["text"]:
            notes.append("Convert texts to paths in the program that they come from.")
        return (*notes, *(f"{what}: {number:,}." for what, number in self._faults.items()))

    def _push(self, element: int, state: _State) -> None:
        self._stack += [(child, state) for child in reversed(self.tree.children[element])]

    def _visit(self, element: int, state: _State) -> None:
        tag = self.tree.tags[element]
        if tag in _LEFT_OUT:
            self.left_out[_LEFT_OUT[tag]] += 1
            return
        if not (tag in SHAPES or tag in _GROUPS or tag in ("use", "svg")):
            return
        inherited = self._styled(element, state)
        if inherited is None:
            return
        state = inherited
        if tag in SHAPES:
            self._shape(element, tag, state)
        elif tag == "use":
            self._use(element, state)
        elif tag == "svg":
            self._view(element, state, self.tree.attributes[element])
        else:
            self._push(element, state)

    def _styled(self, element: int, state: _State) -> _State | None:
        """State inside an element; None if it is not displayed."""
        attributes = self.tree.attributes[element]
        given: dict[str, str] = {}
        for name in ("display", "visibility"):
            if name in attributes:
                given[name] = attributes[name]
        if self._rules:
            names = [self.tree.tags[element]]
            names += ["." + name for name in attributes.get("class", "").split()]
            names += ["#" + attributes.get("id", "")]
            for name in names:
                given.update(self._rules.get(name, {}))
        if "style" in attributes:
            given.update(declarations(attributes["style"]))
        if given.get("display", "").strip() == "none":
            self.left_out["hidden"] += 1
            return None
        visibility = given.get("visibility", "").strip()
        if visibility in ("visible", "hidden", "collapse"):
            state = state._replace(is_visible=visibility == "visible")
        if "transform" in attributes and element:
            own = transform(attributes["transform"])
            if own is None:
                self._faults["Transforms with a fault, passed over"] += 1
            else:
                state = state._replace(matrix=state.matrix.after(own))
        if attributes.get(f"{{{INKSCAPE}}}groupmode") == "layer":
            label = attributes.get(f"{{{INKSCAPE}}}label") or attributes.get("id", "")
            state = state._replace(layer=label)
        return state

    def _name(self, element: int) -> str:
        attributes = self.tree.attributes[element]
        return (
            attributes.get(f"{{{INKSCAPE}}}label")
            or self.tree.title(element)
            or attributes.get("id", "")
        )

    def _view(self, element: int, state: _State, size: Mapping[str, str]) -> None:
        """A nested drawing, or a symbol with the size that its ``use`` has."""
        attributes = self.tree.attributes[element]
        outer = state.viewport
        x, y = length(attributes.get("x")), length(attributes.get("y"))
        left, top = x.px(outer.width) if x else 0.0, y.px(outer.height) if y else 0.0
        wide = length(size.get("width")) or length(attributes.get("width"))
        high = length(size.get("height")) or length(attributes.get("height"))
        width = wide.px(outer.width) if wide else outer.width
        height = high.px(outer.height) if high else outer.height
        if width <= 0 or height <= 0:
            return
        matrix = state.matrix.after(Matrix(1.0, 0.0, 0.0, 1.0, left, top))
        box = view_box(attributes.get("viewBox"))
        viewport = Viewport(width, height)
        if box:
            aspect = attributes.get("preserveAspectRatio")
            matrix = matrix.after(fitted(box, width, height, aspect))
            viewport = Viewport(box[2], box[3])
        self._push(element, state._replace(matrix=matrix, viewport=viewport))

    def _use(self, element: int, state: _State) -> None:
        attributes = self.tree.attributes[element]
        link = attributes.get("href") or attributes.get(f"{{{XLINK}}}href") or ""
        target = self.tree.ids.get(link.strip()[1:]) if link.strip().startswith("#") else None
        if target is None:
            self._faults["References that lead nowhere"] += 1
            return
        if element in state.uses or len(state.uses) >= MAX_USE_DEPTH:
            self._faults["References that lead back to themselves, left out"] += 1
            return
        x, y = length(attributes.get("x")), length(attributes.get("y"))
        left = x.px(state.viewport.width) if x else 0.0
        top = y.px(state.viewport.height) if y else 0.0
        matrix = state.matrix.after(Matrix(1.0, 0.0, 0.0, 1.0, left, top))
        state = state._replace(
            matrix=matrix, uses=(*state.uses, element), name=state.name or self._name(element)
        )
        tag = self.tree.tags[target]
        if tag in ("symbol", "svg"):
            inner = self._styled(target, state)
            if inner is not None:
                self._view(target, inner, attributes)
        else:
            self._stack.append((target, state))

    def _shape(self, element: int, tag: str, state: _State) -> None:
        if not state.is_visible:
            self.left_out["hidden"] += 1
            return
        scale = state.matrix.scale
        if scale == 0:
            return
        if not scale < np.inf:
            self._faults[_TOO_LARGE] += 1
            return
        attributes = self.tree.attributes[element]
        found = self._outlines(element, tag, attributes, state, scale)
        if not found.is_whole:
            self._faults["Shapes with a fault in their data, drawn up to there"] += 1
        if not found.outlines:
            return
        name = state.name or self._name(element)
        for one in found.outlines:
            self._add(one, scale, name, state)

    def _outlines(
        self, element: int, tag: str, attributes: Mapping[str, str], state: _State, scale: float
    ) -> Drawn:
        if not state.uses:
            tolerance = DEVIATION_MM / scale
            return svg_shapes.drawn(tag, attributes, state.viewport, tolerance, self._budget)
        # Repeated shapes are read once for all scales of about one size.
        exponent = float(np.ceil(np.log2(scale)))
        key = (element, state.viewport, exponent)
        if key not in self._cache:
            tolerance = DEVIATION_MM / 2.0**exponent
            self._cache[key] = svg_shapes.drawn(
                tag, attributes, state.viewport, tolerance, self._budget
            )
        else:
            self._budget.draw(sum(len(one.controls) for one in self._cache[key].outlines))
        return self._cache[key]

    def _add(self, one: Outline, scale: float, name: str, state: _State) -> None:
        placed = state.matrix.of(one.controls)
        # A comparison with nan is false.
        if not float(np.abs(placed).max()) <= MAX_COORDINATE_MM:
            self._faults[_TOO_LARGE] += 1
            return
        # A singular matrix, or a shape far away, can leave points that fall together.
        left = outline(placed, one.closed, one.deviation * scale)
        if left is not None:
            self.traces.append(Trace(left.controls, left.closed, name, state.layer, left.deviation))
