"""DXF of other programs, read as a sketch.

What is read
------------
LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE and POLYLINE with bulges, SPLINE of any degree, and INSERT
of blocks in each other, scaled, turned, mirrored and in arrays; ASCII, of any version. The unit is
``$INSUNITS``; where that is 0, ``$MEASUREMENT`` decides between inches and millimetres, which is a
guess, as no program keeps it with care. What is invisible, on a layer that is off or frozen, or on
paper, and what is no curve (texts, hatches, dimensions) is left out with a note. Heights are
dropped with a note. Loose lines and arcs whose ends meet are joined (`core.formats.chains`).

Why not with ezdxf
------------------
ezdxf keeps every tag as an object: 2 million vertices of a POLYLINE take it 40 s and more than
1 GB, damaged files end in errors of a dozen kinds, and its repairs drop geometry unsaid. Here NumPy
looks at the lines first (`core.formats.dxf_tags`), budgets come before work, and ezdxf stays an
independent reader for the tests.

Bad files
---------
Nothing recurses; blocks pay from `core.formats.budget`. A file is refused in one sentence, or read
up to its faults with a note.
"""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from core import atomic
from core.document import MAX_COORDINATE_MM
from core.errors import FileError
from core.formats import dxf_tags
from core.formats.affine import Matrix
from core.formats.budget import Budget, BudgetError, listed
from core.formats.chains import joined
from core.formats.dxf_drawing import Block, Drawing
from core.formats.dxf_shapes import DRAWN, Shape, integer, number, plane
from core.formats.dxf_tags import EntityError, Record
from core.formats.outlines import outline
from core.formats.sketch import UNITS_MM, Sketch, Trace

DEVIATION_MM: Final = 1e-4
"""Admitted deviation of arcs and splines: a hundredth of the default tolerance of an export."""

MAX_BLOCK_DEPTH: Final = 50
"""Largest number of blocks that stand in each other."""

_UNITS: Final = {
    1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 13: "µm",
}  # fmt: skip
"""Names of the values of ``$INSUNITS`` that a user can choose."""

_RARE_MM: Final = {
    3: 1609344.0, 7: 1e6, 8: 25.4e-6, 9: 25.4e-3, 10: 914.4, 11: 1e-7, 12: 1e-6, 14: 100.0,
    15: 1e4, 16: 1e5, 17: 1e12, 21: 1200e3 / 3937, 22: 100e3 / 3937, 23: 3600e3 / 3937,
}  # fmt: skip
"""Millimetres of the others; "mm" is shown for them."""

_SILENT: Final = frozenset({"SEQEND", "ENDBLK", "ATTDEF", "VIEWPORT"})
_TOO_LARGE: Final = f"Entities beyond {MAX_COORDINATE_MM:g} mm, or not finite, left out"
_ON_PAPER, _INVISIBLE = 67, 60


def read(path: str | Path) -> Sketch:
    """Read a DXF file.

    Raises
    ------
    FileError
        If the file cannot be read, is no ASCII DXF, is damaged before its first entity, asks for
        too much work, or holds no geometry.
    """
    path = Path(path)
    return decode(atomic.read(path), path)


def decode(data: bytes, path: Path) -> Sketch:
    """Read the contents of a DXF file; ``path`` is for messages.

    Raises
    ------
    FileError
        As `read` does.
    """
    whole = dxf_tags.tags(data, path)
    drawing = Drawing(dxf_tags.records(whole, path))
    try:
        with np.errstate(all="ignore"):  # what overflows is found in `_Walk._add`
            walk = _Walk(drawing)
            walk.run()
    except BudgetError as error:
        raise FileError(path, str(error)) from error
    notes = walk.notes()
    if not walk.traces:
        if whole.fault_line is not None:
            raise FileError(path, "the file is damaged or cut off here.", whole.fault_line)
        raise FileError(path, " ".join(["there are no lines or curves in it.", *notes]))
    if whole.fault_line is not None:
        damage = (
            f"The file is damaged or cut off at line {whole.fault_line:,}; what stands before was"
            f" read: {walk.drawn:,} entities."
        )
        notes = (damage, *notes)
    traces = joined(walk.traces)
    if len(traces) < len(walk.traces):
        joins = (
            f"{len(walk.traces):,} lines and curves that meet were joined into"
            f" {len(traces):,} contour{'s' if len(traces) > 1 else ''}."
        )
        notes = (*notes, joins)
    return Sketch(traces, walk.unit, walk.is_unit_known, notes)


class _Place(NamedTuple):
    """Where entities stand: in the drawing, or in a block that an INSERT repeats."""

    matrix: Matrix
    layer: str  # of the INSERT, for entities on layer 0
    name: str
    blocks: tuple[str, ...]


class _Walk:
    """Visits the entities, with a stack of its own."""

    def __init__(self, drawing: Drawing) -> None:
        self.traces: list[Trace] = []
        self.drawn = 0
        self._drawing = drawing
        self._budget = Budget()
        self._left_out: Counter[str] = Counter()
        self._faults: Counter[str] = Counter()
        self._notes: list[str] = []
        self._cache: dict[tuple[int, int], Shape] = {}
        self._stack: list[tuple[Record, _Place]] = []
        self.unit, self.is_unit_known, self._mm = self._find_unit()

    def run(self) -> None:
        """Visit all entities."""
        mm = self._mm
        self._push(self._drawing.entities, _Place(Matrix(mm, 0.0, 0.0, mm, 0.0, 0.0), "", "", ()))
        while self._stack:
            record, place = self._stack.pop()
            self._budget.visit()
            try:
                self._visit(record, place)
            except EntityError:
                self._faults[f"{record.name} that could not be read, left out"] += 1

    def notes(self) -> tuple[str, ...]:
        """Sentences on what was left out or repaired."""
        left = [f"Left out: {listed(self._left_out)}."] if self._left_out else []
        faults = [f"{what}: {count:,}." for what, count in self._faults.items()]
        return (*self._notes, *left, *faults)

    def _push(self, entities: list[Record], place: _Place) -> None:
        self._stack += [(record, place) for record in reversed(entities)]

    def _find_unit(self) -> tuple[str, bool, float]:
        given = self._variable("$INSUNITS")
        if given in _UNITS:
            return _UNITS[given], True, UNITS_MM[_UNITS[given]]
        if given in _RARE_MM:
            self._notes.append("The file has a unit that is rare in drawings; it is shown in mm.")
            return "mm", True, _RARE_MM[given]
        unit = "in" if self._variable("$MEASUREMENT") == 0 else "mm"
        return unit, False, UNITS_MM[unit]

    def _variable(self, name: str) -> int:
        try:
            return integer({0: self._drawing.variables[name]}, 0)
        except (KeyError, EntityError):
            return -1

    def _visit(self, record: Record, place: _Place) -> None:
        name = record.name
        if name in _SILENT:
            return
        if name not in DRAWN and name != "INSERT":
            self._left_out[name] += 1
            return
        values = record.first()
        if integer(values, _ON_PAPER) == 1:
            self._left_out["on paper"] += 1
            return
        layer = self._drawing.layer(self._drawing.text(values.get(8, b"0")))
        if layer.name == "0" and place.layer:
            layer = self._drawing.layer(place.layer)
        # A block on a layer that is off is drawn as far as its entities are on other layers.
        is_hidden = layer.is_frozen or (layer.is_off and name != "INSERT")
        if is_hidden or integer(values, _INVISIBLE) == 1:
            self._left_out["hidden"] += 1
            return
        if name == "INSERT":
            self._insert(values, place, layer.name)
            return
        scale = place.matrix.scale
        if scale > 0:
            self._add(self._shape(record, scale, bool(place.blocks)), place, layer.name)

    def _shape(self, record: Record, scale: float, is_repeated: bool) -> Shape:
        if not scale < math.inf:
            raise EntityError("it is scaled beyond all numbers")
        if not is_repeated:
            return DRAWN[record.name](record, DEVIATION_MM / scale, self._budget)
        # Repeated entities are read once for all scales of about one size.
        exponent = math.ceil(math.log2(scale))
        key = (record.low, exponent)
        found = self._cache.get(key)
        if found is None:
            tolerance = DEVIATION_MM / 2.0**exponent
            found = self._cache[key] = DRAWN[record.name](record, tolerance, self._budget)
        else:
            self._budget.draw(sum(len(one.controls) for one in found.outlines))
        return found

    def _add(self, shape: Shape, place: _Place, layer: str) -> None:
        self.drawn += 1
        if not shape.is_flat:
            self._faults["Entities with heights, seen from above"] += 1
        if shape.is_guess:
            self._faults["SPLINE given by points on it, which each program draws differently"] += 1
        matrix = place.matrix.after(shape.matrix)
        scale = matrix.scale
        for one in shape.outlines:
            placed = matrix.of(one.controls)
            # A comparison with nan is false.
            if not float(np.abs(placed).max()) <= MAX_COORDINATE_MM:
                self._faults[_TOO_LARGE] += 1
                continue
            left = outline(placed, one.closed, one.deviation * scale)
            if left is not None:
                self.traces.append(
                    Trace(left.controls, left.closed, place.name, layer, left.deviation)
                )

    def _insert(self, values: dict[int, bytes], place: _Place, layer: str) -> None:
        name = self._drawing.text(values.get(2, b""))
        block = self._drawing.blocks.get(name.lower())
        if block is None:
            self._faults["INSERT of a block that is not there"] += 1
            return
        if name.lower() in place.blocks or len(place.blocks) >= MAX_BLOCK_DEPTH:
            self._faults["INSERT of a block into itself, left out"] += 1
            return
        if not block.entities:
            return
        shown = place.name or ("" if name.startswith("*") else name)
        inner = place._replace(layer=layer, name=shown, blocks=(*place.blocks, name.lower()))
        columns, rows = max(integer(values, 70, 1), 1), max(integer(values, 71, 1), 1)
        # Each repetition costs a visit even if nothing in it is drawn.
        self._budget.visit(columns * rows)
        maps = _maps(values, block, columns, rows)
        for one in reversed(maps):
            self._push(block.entities, inner._replace(matrix=place.matrix.after(one)))


def _maps(values: dict[int, bytes], block: Block, columns: int, rows: int) -> list[Matrix]:
    """Maps from a block into the drawing, one for each column and row of an array."""
    level, _ = plane(values, number(values, 30))
    turn = math.radians(math.fmod(number(values, 50), 360))
    cos, sin = math.cos(turn), math.sin(turn)
    if number(values, 50) % 90 == 0:
        cos, sin = float(round(cos)), float(round(sin))
    moved = level.after(Matrix(cos, sin, -sin, cos, number(values, 10), number(values, 20)))
    sx, sy = number(values, 41, 1.0), number(values, 42, 1.0)
    x, y = block.base
    dx, dy = number(values, 44), number(values, 45)
    return [
        moved.after(Matrix(sx, 0.0, 0.0, sy, column * dx - x * sx, row * dy - y * sy))
        for row in range(rows)
        for column in range(columns)
    ]
