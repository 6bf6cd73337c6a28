"""The whole story of a drawing, by mouse and keys, and what other readers find in its files."""

from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from answers import Answers
from app.assets import resources
from app.dialogs import Answer
from app.window import MainWindow
from core import store
from independent import farthest, seen_by_ezdxf, seen_by_svgpathtools
from mouse import Mouse, by

TOLERANCE_MM = 0.01


@pytest.fixture
def window(qtbot, tmp_path):
    answers = Answers()
    answers.answer = Answer.DISCARD
    window = MainWindow(dialogs=answers)
    qtbot.addWidget(window)
    with qtbot.waitSignal(window.completed):
        window.show()
    window.activateWindow()
    window.canvas.setFocus()
    return window


def slide(track, value):
    """Drag the handle of a slider to a value, with the mouse."""
    row = track.height() // 2
    start = QPoint(round(track.x_of(track.value())), row)
    stop = QPoint(round(track.x_of(value)), row)
    QTest.mousePress(track, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(track, (start + stop) / 2)
    QTest.mouseMove(track, stop)
    QTest.mouseRelease(track, Qt.MouseButton.LeftButton, pos=stop)


def export(window, path, qtbot):
    """Export through the dialog, as a user who chooses a profile, a tolerance and a name."""
    window.dialogs.path = path
    window.commands["export"].trigger()
    dialog = window.exporter.dialog
    qtbot.waitUntil(dialog.list.hasFocus)
    QTest.keyClick(dialog.list, {".svg": Qt.Key.Key_I, ".dxf": Qt.Key.Key_Home}[path.suffix])
    tolerance = dialog.fields.editors["tolerance_mm"]
    tolerance.setText(str(TOLERANCE_MM))
    QTest.keyClick(tolerance, Qt.Key.Key_Tab)
    with qtbot.waitSignal(window.exporter.told):
        dialog.export.click()
    assert window.exporter.dialog is None
    assert window.dialogs.shown == []
    assert path.exists()


def exact_box(document):
    points = np.concatenate([c.limit(document.parameters).points(8) for c in document.curves])
    return points.min(axis=0), points.max(axis=0)


def svg_points(path):
    """Points of the only path of an SVG, in mm, y up again."""
    root = ET.parse(path).getroot()
    width, height = root.get("width"), root.get("height")
    assert width.endswith("mm")
    assert height.endswith("mm")
    assert root.get("viewBox").split()[2:] == [width[:-2], height[:-2]]
    ((points, closed),) = seen_by_svgpathtools(path.read_bytes())
    assert closed
    return points


def signed_area(outline):
    (x, y), (next_x, next_y) = outline.T, np.roll(outline, -1, axis=0).T
    return (x * next_y - y * next_x).sum() / 2


def test_open_drag_slide_undo_redo_save_and_export(window, qtbot, tmp_path):
    session = window.session
    window.dialogs.path = resources() / "examples" / "airfoil.ninepoint"
    window.commands["open"].trigger()
    opened = session.document
    assert len(opened.curves) == 1

    mouse = Mouse(window.canvas)
    place = mouse.point(7)
    mouse.drag(place, place + by(6, -9), place + by(14, -25))
    dragged = session.document
    assert session.undo_name == "Move point"
    moved = dragged.curves[0].points[7] - opened.curves[0].points[7]
    np.testing.assert_allclose(moved * window.canvas.camera.scale, (14, 25), atol=1e-6)
    others = [np.delete(d.curves[0].points, 7, axis=0) for d in (dragged, opened)]
    np.testing.assert_array_equal(*others)

    slide(window.scheme.tracks["beta"], -150)
    slid = session.document
    assert float(slid.parameters.beta) == pytest.approx(-0.75, abs=0.02)
    assert slid.curves is dragged.curves

    QTest.keyClick(window.canvas, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert session.document is dragged
    QTest.keyClick(window.canvas, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert session.document is opened
    window.commands["redo"].trigger()
    assert session.document is dragged

    window.dialogs.path = tmp_path / "wing.ninepoint"
    window.commands["save as"].trigger()
    assert store.encode(store.load(tmp_path / "wing.ninepoint")) == store.encode(dragged)
    assert not window.isWindowModified()

    export(window, tmp_path / "wing.svg", qtbot)
    export(window, tmp_path / "wing.dxf", qtbot)
    low, high = exact_box(dragged)

    drawing = ezdxf.readfile(tmp_path / "wing.dxf")
    assert drawing.audit().errors == []
    assert (drawing.header["$INSUNITS"], drawing.header["$MEASUREMENT"]) == (4, 1)
    (line,) = drawing.modelspace()
    assert (line.dxftype(), line.closed) == ("LWPOLYLINE", True)
    ((in_dxf, _, _),) = seen_by_ezdxf((tmp_path / "wing.dxf").read_bytes(), TOLERANCE_MM / 10)
    np.testing.assert_allclose(in_dxf.min(axis=0), low, atol=TOLERANCE_MM)
    np.testing.assert_allclose(in_dxf.max(axis=0), high, atol=TOLERANCE_MM)

    in_svg = svg_points(tmp_path / "wing.svg")
    np.testing.assert_allclose(np.ptp(in_svg, axis=0), high - low, atol=2 * TOLERANCE_MM)
    # The same outline in the same direction: neither file is mirrored, y is up in the DXF. Their
    # decimals differ, so that their vertices need not be the same.
    in_svg += in_dxf.min(axis=0) - in_svg.min(axis=0)
    assert farthest(in_svg, in_dxf) <= 4 * TOLERANCE_MM
    assert farthest(in_dxf, in_svg) <= 4 * TOLERANCE_MM
    assert signed_area(in_svg) == pytest.approx(signed_area(in_dxf), rel=0.01)
    highest = dragged.curves[0].points[:, 1].argmax()
    leading = dragged.curves[0].points[highest, 0]
    top = in_dxf[in_dxf[:, 1].argmax(), 0]
    assert abs(top - leading) < 0.25 * (high[0] - low[0])
