"""FreeCAD: its importers of DXF and SVG, without a screen; all files in one run."""

import json
import subprocess
from collections import Counter

import numpy as np

from debian import needed
from seen import DRAWING, PAGE, Seen

TITLE = "FreeCAD"
FORMATS = ("dxf", "svg")

SCRIPT = """
import FreeCAD, Part, importDXF, importSVG, json
names, answer = json.load(open({jobs!r}))
found = []
for name in names:
    (importSVG if name.endswith(".svg") else importDXF).open(name)
    edges = [e for o in FreeCAD.ActiveDocument.Objects for e in o.Shape.Edges]
    chains = Part.sortEdges(edges)
    lines = [[(p.x, p.y) for p in e.discretize(Deflection=1e-4)] for e in edges]
    kinds = [type(e.Curve).__name__ for e in edges]
    closed = sum(Part.Wire(chain).isClosed() for chain in chains)
    found.append([lines, len(chains), closed, kinds])
    FreeCAD.closeDocument(FreeCAD.ActiveDocument.Name)
version = ".".join(FreeCAD.Version()[:3])
json.dump([version.split(" ")[0], found], open(answer, "w"))
"""


def look(paths, folder):
    """What is in the files, and the version of the program."""
    script, jobs, answer = folder / "look.py", folder / "jobs.json", folder / "answer.json"
    script.write_text(SCRIPT.format(jobs=str(jobs)))
    jobs.write_text(json.dumps([[str(path) for path in paths], str(answer)]))
    run = subprocess.run(
        [needed("freecadcmd"), script], capture_output=True, text=True, check=True
    )
    assert answer.exists(), run.stdout + run.stderr
    version, found = json.loads(answer.read_text())
    seen = [
        Seen(
            [np.array(line) for line in lines], contours, closed, Counter(kinds),
            PAGE if path.suffix == ".svg" else DRAWING,
        )
        for path, (lines, contours, closed, kinds) in zip(paths, found, strict=True)
    ]  # fmt: skip
    return seen, version
