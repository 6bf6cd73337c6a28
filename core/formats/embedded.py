"""The document inside an SVG file of ours, if the paths still are what it shows.

Programs that open and save the file keep the metadata and the digests (measured with Inkscape
1.2), also those that write path data with other white space. Whoever moves, bends, adds or deletes
something changes data, adds a transform or another element; then the document is not what the file
shows any more, and the paths have to be taken as they are.
"""

from __future__ import annotations

from typing import Final
from xml.etree.ElementTree import Element, ParseError

from core import store
from core.document import Document
from core.errors import FileError
from core.formats.svg import NAMESPACE, document_digest, path_digest

_SVG: Final = "{http://www.w3.org/2000/svg}"
_OWN: Final = f"{{{NAMESPACE}}}"

_NOT_SHOWN: Final = ("defs", "metadata", "title", "desc")
"""Elements whose contents are not drawn."""


def embedded(source: Element | bytes, name: str = "drawing.svg") -> Document | None:
    """Document that an SVG file of ours carries.

    Parameters
    ----------
    source
        The file, or the root element that a safe parser made of it.
    name
        Name of the file, for the messages of what is found.

    Returns
    -------
    Document or None
        None if there is none, it is damaged, or the paths are not those that were written: each
        there, with its data, none more, without any transform, on a page of the same scale.
    """
    root = _parsed(source) if isinstance(source, bytes) else source
    if root is None:
        return None
    drawing = root.find(f"{_SVG}metadata/{_OWN}drawing")
    if drawing is None:
        return None
    text = "".join(part.text or "" for part in drawing.findall(f"{_OWN}part"))
    if document_digest(text) != drawing.get("digest"):
        return None
    page = f"{root.get('width')} {root.get('height')} {root.get('viewBox')}"
    shown = _shown(root)
    if shown is None or str(len(shown)) != drawing.get("paths") or page != drawing.get("page"):
        return None
    for path in shown:
        if path_digest(path.get("d", "")) != path.get(f"{_OWN}digest"):
            return None
    # A path that was copied stands for another one that was deleted.
    if len({path.get(f"{_OWN}place") for path in shown}) != len(shown):
        return None
    try:
        return store.decode(text.encode(), name)
    except FileError:
        return None


def _parsed(data: bytes) -> Element | None:
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root: Element = fromstring(data, forbid_dtd=True)
    except (ParseError, DefusedXmlException, LookupError, ValueError, RecursionError):
        return None
    return root


def _shown(root: Element) -> list[Element] | None:
    """Paths that are drawn, or None if something else is, or something is transformed.

    No recursion: files may be nested as deep as they like.
    """
    found: list[Element] = []
    waiting = [root]
    while waiting:
        element = waiting.pop()
        if not isinstance(element.tag, str) or not element.tag.startswith(_SVG):
            continue
        kind = element.tag.removeprefix(_SVG)
        if kind in _NOT_SHOWN:
            continue
        style = element.get("style", "")
        if "transform" in element.attrib or "transform" in style:
            return None
        if kind == "path":
            found.append(element)
        elif kind in ("g", "svg") and (kind == "g" or element is root):
            waiting += list(element)
        else:
            return None
    return found
