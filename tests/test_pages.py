import os
import struct
import subprocess
import sys

import msgspec
import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage

from app.pages import MAX_PIXELS, encode_png, picture_size, register_encoders
from core.document import Curve, Document
from core.errors import NinepointError
from core.formats import export
from core.formats.contours import Contours
from core.profiles import named
from drawings import extents, letter_f


def contours_of(document, **fields):
    return Contours.of(document, msgspec.structs.replace(named("png"), **fields))


def chunks(data):
    """Chunks of a PNG file by their names, read without Qt."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    found, place = {}, 8
    while place < len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        found[data[place + 4 : place + 8]] = data[place + 8 : place + 8 + length]
        place += 12 + length
    return found


def seen(data):
    """Alpha or darkness of the pixels, 0 to 1."""
    image = QImage.fromData(data).convertToFormat(QImage.Format.Format_RGBA8888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)
    return rows / 255


@pytest.mark.parametrize("dpi", [72.0, 300.0])
def test_size_and_resolution_are_true(dpi):
    document = letter_f()
    found = chunks(encode_png(contours_of(document, dpi=dpi), "F"))
    pixels = struct.unpack(">II", found[b"IHDR"][:8])
    low, high = extents(document)
    wanted = (high - low + named("png").width_mm) / 25.4 * dpi
    assert np.all(np.abs(np.array(pixels) - wanted) <= 1.1)
    across, down, metres = struct.unpack(">IIB", found[b"pHYs"])
    assert (across, down, metres) == (round(dpi / 0.0254), round(dpi / 0.0254), 1)


def test_the_ink_lies_where_the_curve_is_and_reaches_the_border():
    document = letter_f()
    content = contours_of(document, dpi=254.0, transparent=False, colour="#0000ff")
    image = seen(encode_png(content, ""))
    ink = 1 - image[..., 0]
    rows, columns = np.nonzero(ink > 0.5)
    low, high = extents(document)
    # Ten pixels a millimetre; the line's middle is half its width within the picture.
    exact = document.curves[0].limit(document.parameters).points(9)
    places = np.stack([exact[:, 0] - low[0], high[1] - exact[:, 1]], axis=1) * 10 + 1.75
    near = np.abs(
        (places[::40] @ [1, 1j])[:, None] - (columns + 0.5 + 1j * (rows + 0.5))[None]
    ).min(axis=1)
    assert near.max() <= 1.5
    for edge in (ink[:2], ink[-2:], ink[:, :2], ink[:, -2:]):
        assert edge.max() > 0.3


def test_the_ground_is_transparent_or_white():
    clear = seen(encode_png(contours_of(letter_f(), transparent=True), ""))
    white = seen(encode_png(contours_of(letter_f(), transparent=False), ""))
    assert clear[0, 0].tolist() == [0, 0, 0, 0]
    assert white[0, 0].tolist() == [1, 1, 1, 1]
    assert white[..., 3].min() == 1


def test_the_colour_is_that_of_the_profile():
    image = QImage.fromData(encode_png(contours_of(letter_f(), colour="#ff8000"), ""))
    colours = {image.pixelColor(x, image.height() // 2).name() for x in range(image.width())}
    assert QColor("#ff8000").name() in colours


def test_a_picture_that_is_too_large_is_refused_with_a_resolution_that_does():
    with pytest.raises(NinepointError, match=r"choose at most \d+ dpi") as refused:
        encode_png(contours_of(letter_f(), dpi=10_000.0), "")
    dpi = float(str(refused.value).split("at most ")[1].split()[0])
    width, height = picture_size(contours_of(letter_f(), dpi=dpi))
    assert MAX_PIXELS * 0.95 < width * height <= MAX_PIXELS


def test_a_side_is_limited_too():
    line = Document((Curve([(0, 0), (5000, 0)]),))
    with pytest.raises(NinepointError, match=r"32,000 a side; choose at most 16\d dpi"):
        picture_size(contours_of(line))
    width, height = picture_size(contours_of(line, dpi=160.0))
    assert height >= 2
    assert width > 31_000


def test_the_same_drawing_gives_the_same_bytes():
    content = contours_of(letter_f())
    assert encode_png(content, "a") == encode_png(content, "a")


def test_registered_formats_are_exported(tmp_path):
    register_encoders()
    for name in ("pdf", "png"):
        report = export(letter_f(), tmp_path / f"f.{name}", named(name))
        assert report.path.stat().st_size > 0
        assert report.entities > 0


def test_neither_a_screen_nor_an_application_is_needed(tmp_path):
    """In a process of its own, with nothing of Qt but what the encoders load."""
    script = f"""
import sys
from pathlib import Path
from app.pages import register_encoders
from core.document import Curve, Document
from core.formats import export
from core.profiles import named
register_encoders()
assert "PySide6" not in sys.modules
drawing = Document((Curve([(0, 0), (40, 0), (40, 30), (0, 30)]),))
for name in ("pdf", "png"):
    export(drawing, Path({str(tmp_path)!r}) / f"a.{{name}}", named(name))
    assert ("PySide6" in sys.modules) == (name == "png")
"""
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "QT_QPA_PLATFORM")}
    environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
    subprocess.run([sys.executable, "-c", script], env=environment, check=True)
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    assert QImage(str(tmp_path / "a.png")).width() > 100
