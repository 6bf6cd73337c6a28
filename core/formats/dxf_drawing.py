"""The parts of a DXF file: header, layers, blocks and entities, as records."""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from core.formats.dxf_shapes import integer, number
from core.formats.dxf_tags import EntityError, Record

_UTF8_FROM: Final = "AC1021"
"""First version whose texts are UTF-8 (AutoCAD 2007)."""

_UNICODE: Final = re.compile(r"\\U\+([0-9A-Fa-f]{4})")
_FROZEN: Final = 1
_VARIABLES: Final = ("$ACADVER", "$DWGCODEPAGE", "$INSUNITS", "$MEASUREMENT")


@dataclass(eq=False)
class Block:
    """Entities that INSERT repeats, around a base point."""

    name: str
    base: tuple[float, float]
    entities: list[Record] = field(default_factory=list)


class Layer(NamedTuple):
    """What the table says of a layer."""

    name: str
    is_frozen: bool
    is_off: bool


class Drawing:
    """A file, sorted.

    Attributes
    ----------
    entities
        Records of the ENTITIES section.
    blocks, layers
        By name in small letters.
    variables
        Header variables that a reader needs.
    """

    def __init__(self, records: list[Record]) -> None:
        self.entities: list[Record] = []
        self.blocks: dict[str, Block] = {}
        self.layers: dict[str, Layer] = {}
        self.variables: dict[str, bytes] = {}
        self._encoding = "utf-8"
        section = b""
        block: Block | None = None
        for record in records:
            if record.name == "SECTION":
                section = record.first().get(2, b"").upper()
                if section == b"HEADER":
                    self._read_header(record)
            elif record.name == "ENDSEC":
                section = b""
            elif section == b"ENTITIES":
                self.entities.append(record)
            elif section == b"BLOCKS":
                block = self._in_blocks(record, block)
            elif section == b"TABLES" and record.name == "LAYER":
                self._read_layer(record)

    def text(self, data: bytes) -> str:
        """Words of the file, in its encoding."""
        try:
            words = data.decode("utf-8")
        except UnicodeDecodeError:
            words = data.decode(self._encoding, "replace")
        return _UNICODE.sub(lambda match: chr(int(match[1], 16)), words)

    def layer(self, name: str) -> Layer:
        """Layer of a name; one that no table declares is visible."""
        return self.layers.get(name.lower(), Layer(name, False, False))

    def _read_header(self, record: Record) -> None:
        whole = record.tags
        for index in record.all(9).tolist():
            name = whole.value(index).decode("ascii", "replace").upper()
            if name in _VARIABLES and index + 1 < record.own:
                self.variables[name] = whole.value(index + 1)
        page = self.variables.get("$DWGCODEPAGE", b"").decode("ascii", "replace").lower()
        number_of_page = re.sub(r"[^0-9]", "", page) or "1252"
        try:
            self._encoding = codecs.lookup("cp" + number_of_page).name
        except LookupError:
            self._encoding = "cp1252"
        if self.variables.get("$ACADVER", b"").decode("ascii", "replace") >= _UTF8_FROM:
            self._encoding = "utf-8"

    def _read_layer(self, record: Record) -> None:
        values = record.first()
        name = self.text(values.get(2, b""))
        try:
            is_frozen = bool(integer(values, 70) & _FROZEN)
            is_off = number(values, 62) < 0
        except EntityError:
            is_frozen = is_off = False
        self.layers[name.lower()] = Layer(name, is_frozen, is_off)

    def _in_blocks(self, record: Record, block: Block | None) -> Block | None:
        if record.name == "BLOCK":
            values = record.first()
            name = self.text(values.get(2, b""))
            try:
                base = (number(values, 10), number(values, 20))
            except EntityError:
                base = (0.0, 0.0)
            block = self.blocks[name.lower()] = Block(name, base)
            return block
        if record.name == "ENDBLK":
            return None
        if block is not None:
            block.entities.append(record)
        return block
