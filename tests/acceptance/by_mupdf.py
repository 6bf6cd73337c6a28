"""MuPDF: the paths of a PDF, and the size of its page."""

from collections import Counter

import numpy as np

from debian import version_of
from seen import PAGE, Seen
from traced import strokes

TITLE = "MuPDF"
FORMATS = ("pdf",)


def look(paths, folder):
    """What is in the files, and the version of the program."""
    return [drawn(path) for path in paths], version_of("mupdf-tools")


def drawn(path):
    found, page, _ = strokes(path)
    lines = [points - (0, page[1]) for points, _, _ in found]
    kinds = Counter(kind for _, _, kinds in found for kind in kinds)
    kinds = Counter({name: kinds[name] for name in ("lineto", "curveto") if kinds[name]})
    closed = sum(is_closed for _, is_closed, _ in found)
    return Seen(lines, len(lines), closed, kinds, PAGE, np.array([[0, -page[1]], [page[0], 0]]))
