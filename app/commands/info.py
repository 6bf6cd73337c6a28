"""`ninepoint info`: what is in a file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from app.commands.manual import FileOf, Manual
from app.commands.reading import FILES_READ, READABLE, Reading, read_unit

if TYPE_CHECKING:
    from core.document import Document
    from core.formats.sketch import Sketch

_EXAMPLES: Final = ("info wing.ninepoint", "info foreign.dxf --unit in", "info wing.svg --json")

_WIDTH: Final = 11
"""Column of the answers."""


@click.command(
    "info",
    cls=Manual,
    short_help="Tell what is in a file.",
    examples=_EXAMPLES,
    files=FILES_READ,
)
@click.argument("source", metavar="FILE", type=FileOf(*READABLE))
@read_unit("--unit")
@click.option("--json", "as_json", is_flag=True, help="Answer in JSON, errors too.")
def info(source: Path, read_unit: str | None, as_json: bool) -> None:
    """Tell what is in FILE: size, curves, points, entities, unit, layers, and what is proven.

    Of a drawing or of points: the size of the curves, the number of control points, how many arcs
    a DXF would have within 0.01 mm, and the smoothness that is proven of the scheme. Of SVG and DXF
    of any program: what the reader found, and what it left out.
    """
    from core.formats.foreign import SUFFIXES, read_sketch

    found: dict[str, Any] = {"file": str(source)}
    if source.suffix.lower() in SUFFIXES:
        sketch = read_sketch(source)
        found |= _of_sketch(sketch if read_unit is None else sketch.in_unit(read_unit))
        if sketch.document is not None and read_unit is None:
            found["drawing"] = _of_document(sketch.document)
    else:
        document, _ = Reading(unit=read_unit).document(source)
        found |= _of_document(document)
    if as_json:
        click.echo(json.dumps(found, indent=2, allow_nan=False, ensure_ascii=False))
        return
    click.echo(f"{source}:")
    _tell(found)


def _of_document(document: Document) -> dict[str, Any]:
    """What is in a drawing."""
    from core.continuity import smoothness
    from core.errors import NinepointError
    from core.formats import PROFILES, survey

    scheme = document.parameters
    notes: list[str] = []
    size: list[float] | None = None
    entities: dict[str, int] = {}
    try:
        report = survey(document, PROFILES["laser"])
    except NinepointError as error:
        notes.append(str(error))
    else:
        size = [report.width_mm, report.height_mm]
        entities = {"arcs": report.entities}
        notes += report.notes
    return {
        "size_mm": size,
        "curves": [
            {"name": curve.name, "closed": curve.is_loop, "points": curve.count}
            for curve in document.curves
        ],
        "points": sum(curve.count for curve in document.curves),
        "entities": entities,
        "unit": "mm",
        "unit_is_known": True,
        "layers": [],
        "scheme": {
            "alpha": str(scheme.alpha),
            "beta": str(scheme.beta),
            "gamma": str(scheme.gamma),
            "neighbours": scheme.neighbours,
            "name": scheme.name,
            "class": smoothness(scheme.mask).order,
        },
        "profiles": [profile.name for profile in document.profiles],
        "notes": notes,
    }


def _of_sketch(sketch: Sketch) -> dict[str, Any]:
    """What was read of another program's drawing."""
    from core.formats.foreign import name

    curves = [
        {
            "name": name(trace, index),
            "closed": trace.closed,
            "points": len(trace.nodes),
            "deviation_mm": trace.deviation,
        }
        for index, trace in enumerate(sketch.traces, 1)
    ]
    return {
        "size_mm": (sketch.high - sketch.low).tolist(),
        "curves": curves,
        "points": sum(len(trace.nodes) for trace in sketch.traces),
        "entities": {"cubics": sum(len(trace.controls) for trace in sketch.traces)},
        "unit": sketch.unit,
        "unit_is_known": sketch.is_unit_known,
        "layers": sorted({trace.layer for trace in sketch.traces if trace.layer}),
        "scheme": None,
        "profiles": [],
        "notes": list(sketch.notes),
    }


def _tell(found: dict[str, Any]) -> None:
    """Say it in words."""
    size = found["size_mm"]
    if size is not None:
        _line("size", f"{size[0]:.2f} x {size[1]:.2f} mm")
    closed = sum(curve["closed"] for curve in found["curves"])
    _line("curves", f"{len(found['curves']):,}, {closed:,} of them closed")
    _line("points", f"{found['points']:,}")
    for kind, count in found["entities"].items():
        _line(kind, f"{count:,}")
    guess = "" if found["unit_is_known"] else " (the file does not say)"
    _line("unit", found["unit"] + guess)
    if found["layers"]:
        _line("layers", ", ".join(found["layers"]))
    scheme = found["scheme"]
    if scheme is not None:
        called = f", {scheme['name']}" if scheme["name"] else ""
        mirrored = ", mirrored neighbours" if scheme["neighbours"] == "mirrored" else ""
        numbers = ", ".join(scheme[key] for key in ("alpha", "beta", "gamma"))
        _line("scheme", f"({numbers}){called}{mirrored}")
        order = scheme["class"]
        _line("smooth", "nothing is proven" if order is None else f"C^{order}, proven")
    if found["profiles"]:
        _line("profiles", ", ".join(found["profiles"]))
    for note in found["notes"]:
        _line("note", note)
    if "drawing" in found:
        click.echo("It holds the drawing of Ninepoint that it was made of:")
        _tell(found["drawing"])


def _line(what: str, words: str) -> None:
    click.echo(f"  {what:{_WIDTH}}{words}")
