"""The elements of an SVG file as a flat table: parsed without recursion, nothing ever expanded.

A document type is passed over where it only names one, as the files of many programs do, and
refused where it declares anything: entities grow without end, and default attributes multiply.
No external thing is ever loaded.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Final
from xml.etree.ElementTree import ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import DefusedXMLParser

from core.errors import FileError
from core.formats.budget import MAX_ELEMENTS

SVG: Final = "http://www.w3.org/2000/svg"
XLINK: Final = "http://www.w3.org/1999/xlink"
INKSCAPE: Final = "http://www.inkscape.org/namespaces/inkscape"
"""Names of the vocabularies."""

MAX_FILE_ELEMENTS: Final = 2 * MAX_ELEMENTS + 100
"""Largest number of elements in a file; a path and its title are two."""

_MAX_TITLE: Final = 200
"""Number of characters of a title that are kept."""

_MAX_ATTRIBUTES: Final = 500
"""Largest number of attributes of an element."""


@dataclass(eq=False)
class Tree:
    """Elements in the order of the file; an element is its index.

    Attributes
    ----------
    tags
        Names; those of SVG's own vocabulary without it, those of others as ``{name}tag``.
    attributes
        Dictionaries of attributes, named likewise.
    children
        Indices of the elements inside.
    texts
        Text inside ``title`` and ``style``, by index.
    ids
        The first element of each ``id``.
    """

    tags: list[str] = field(default_factory=list)
    attributes: list[dict[str, str]] = field(default_factory=list)
    children: list[list[int]] = field(default_factory=list)
    texts: dict[int, str] = field(default_factory=dict)
    ids: dict[str, int] = field(default_factory=dict)

    def title(self, element: int) -> str:
        """First title inside an element, or ""."""
        for child in self.children[element]:
            if self.tags[child] == "title":
                return " ".join(self.texts.get(child, "").split())
        return ""


def parse(data: bytes, path: Path) -> Tree:
    """Parse a file.

    Raises
    ------
    FileError
        If it is no well-formed XML, declares a document type of its own, has too many elements, or
        is no SVG; with the line where there is one.
    """
    builder = _Builder()
    parser = _Parser(target=builder, forbid_dtd=True)
    try:
        parser.feed(data)
        parser.close()
    except ParseError as error:
        line, _ = error.position
        words = str(error).partition(":")[0]
        raise FileError(
            path,
            f"this is no well-formed XML ({words}); the file is damaged or cut off.",
            line,
        ) from error
    except DefusedXmlException as error:
        raise FileError(
            path,
            "it declares a document type of its own with entities or defaults, which can hide"
            ' endless work; save it as "plain SVG" first.',
        ) from error
    except _TooManyError as error:
        raise FileError(path, str(error)) from error
    except (ValueError, LookupError) as error:  # an encoding that nobody knows
        raise FileError(path, "its text encoding is not known; save it in UTF-8.") from error
    tree = builder.tree
    if tree.tags[0] != "svg":
        name = tree.tags[0].rpartition("}")[2][:40]
        raise FileError(path, f"it is no SVG drawing: its outermost element is <{name}>.")
    return tree


class _TooManyError(Exception):
    pass


class _Parser(DefusedXMLParser):
    """The parser that forbids, but for a document type that declares nothing."""

    def defused_start_doctype_decl(
        self, name: str, sysid: str | None, pubid: str | None, has_internal_subset: bool
    ) -> None:
        if has_internal_subset:
            super().defused_start_doctype_decl(name, sysid, pubid, has_internal_subset)


class _Builder:
    """Receives the parser's events."""

    def __init__(self) -> None:
        self.tree = Tree()
        self._open: list[int] = []
        self._vocabulary = ""
        self._words: list[str] | None = None

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        tree = self.tree
        index = len(tree.tags)
        if index >= MAX_FILE_ELEMENTS:
            raise _TooManyError(
                f"it has more than {MAX_FILE_ELEMENTS:,} elements; save a part of it as a file of"
                " its own."
            )
        if len(attributes) > _MAX_ATTRIBUTES:
            raise _TooManyError(f"an element has more than {_MAX_ATTRIBUTES} attributes.")
        vocabulary, _, name = tag.rpartition("}")
        if vocabulary == "{" + SVG or not vocabulary:
            tag = name
        tree.tags.append(tag)
        tree.attributes.append(attributes)
        tree.children.append([])
        if "id" in attributes:
            tree.ids.setdefault(attributes["id"], index)
        if self._open:
            tree.children[self._open[-1]].append(index)
        self._open.append(index)
        self._words = [] if tag in ("title", "style") else None

    def data(self, text: str) -> None:
        if self._words is not None:
            self._words.append(text)

    def end(self, tag: str) -> None:  # noqa: ARG002 - the parser's
        index = self._open.pop()
        if self._words is not None:
            words = "".join(self._words)
            is_title = self.tree.tags[index] == "title"
            self.tree.texts[index] = words[:_MAX_TITLE] if is_title else words
            self._words = None

    def close(self) -> None:
        """Nothing to finish; the parser asks for it."""
