"""Renderers: resvg, librsvg and Poppler; and what stands in a PNG."""

import re
import subprocess
from importlib.metadata import version

import numpy as np
import resvg_py

from debian import needed, version_of
from ink import ink, resolution
from seen import PX_PER_MM

MM_PER_INCH = 25.4
MARGIN_PX = 4


class Renderer:
    """A program that paints a page."""

    def __init__(self, title, kind, paint, version):
        self.TITLE, self.FORMATS = title, (kind,)
        self.paint, self.version = paint, version

    def look(self, paths, folder):
        """What is painted, and the version of the program."""
        return [self.paint(path, folder) for path in paths], self.version()


def page_of_svg(path):
    """Size of the page and width of the lines, in mm."""
    text = path.read_text()
    size = [float(re.search(rf'{side}="([\d.]+)mm"', text)[1]) for side in ("width", "height")]
    return np.array(size), float(re.search(r'stroke-width="([\d.]+)"', text)[1])


def by_resvg(path, folder):
    """resvg cuts pages to whole pixels of 96 dpi, so the page is put onto a larger one."""
    size, stroke = page_of_svg(path)
    px_per_mm = resolution(size)
    width, height = np.ceil(size * PX_PER_MM).astype(int) + 2 * MARGIN_PX
    text = path.read_text().partition("?>")[2].strip()
    inner = text.replace("<svg ", f'<svg x="{MARGIN_PX}" y="{MARGIN_PX}" ', 1)
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}">'
    painted = resvg_py.svg_to_bytes(
        svg_string=f"{head}{inner}</svg>", zoom=px_per_mm / PX_PER_MM, background="#ffffff", dpi=96
    )
    picture = folder / f"{path.stem}-resvg.png"
    picture.write_bytes(bytes(painted))
    return ink(picture, px_per_mm, stroke, MARGIN_PX / PX_PER_MM)


def by_librsvg(path, folder):
    size, stroke = page_of_svg(path)
    px_per_mm = resolution(size)
    dpi = str(px_per_mm * MM_PER_INCH)
    picture = folder / f"{path.stem}-rsvg.png"
    subprocess.run(
        [needed("rsvg-convert"), "-d", dpi, "-p", dpi, "-b", "white", "-o", picture, path],
        check=True, capture_output=True,
    )  # fmt: skip
    return ink(picture, px_per_mm, stroke)


def by_poppler(path, folder):
    run = subprocess.run([needed("pdfinfo"), path], capture_output=True, text=True, check=True)
    words = re.search(r"Page size: +(\S+) x (\S+) pts", run.stdout)
    size = np.array([float(words[1]), float(words[2])]) * MM_PER_INCH / 72
    px_per_mm = resolution(size)
    picture = folder / f"{path.stem}-poppler"
    dpi = str(px_per_mm * MM_PER_INCH)
    subprocess.run(
        [needed("pdftocairo"), "-png", "-singlefile", "-r", dpi, path, picture],
        check=True, capture_output=True,
    )  # fmt: skip
    return ink(picture.with_suffix(".png"), px_per_mm, WIDTHS["pdf"])


def by_imagemagick(path, folder):
    """The picture as it is, at the resolution that it states."""
    said = subprocess.run(
        [needed("identify"), "-units", "PixelsPerInch", "-format", "%x %w %h", path],
        capture_output=True, text=True, check=True,
    ).stdout.split()  # fmt: skip
    flat = folder / f"{path.stem}-flat.png"
    subprocess.run(
        [needed("convert"), path, "-background", "white", "-flatten", flat], check=True
    )
    return ink(flat, float(said[0]) / MM_PER_INCH, WIDTHS["png"], WIDTHS["png"] / 2)


WIDTHS = {"pdf": 0.1, "png": 0.35}
"""Widths of the lines of the built-in profiles, in mm."""

RENDERERS = (
    Renderer("resvg", "svg", by_resvg, lambda: version("resvg_py")),
    Renderer("librsvg", "svg", by_librsvg, lambda: version_of("librsvg2-bin")),
    Renderer("Poppler", "pdf", by_poppler, lambda: version_of("poppler-utils")),
    Renderer("ImageMagick", "png", by_imagemagick, lambda: version_of("imagemagick")),
)
