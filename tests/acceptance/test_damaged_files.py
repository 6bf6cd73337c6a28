"""The readers of foreign files against damage and traps, with what each costs.

Outside the default suite: ``python3 tests tests/acceptance/test_damaged_files.py -s`` prints the
table. ``NINEPOINT_DAMAGED=100000`` reads as many damaged files of each kind instead of 2,000.
"""

import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from damage import damaged, dxf, svg
from test_foreign import assert_sound_or_refused

FILES = int(os.environ.get("NINEPOINT_DAMAGED", "2000"))
FIRST_SEED = 1_000_000
"""Seeds that the default suite does not have."""

MAX_SECONDS = 10
"""Of the processor: who measures on a busy machine measures the reader."""
MAX_BYTES = 1_000_000_000

ROOT = Path(__file__).resolve().parent.parent.parent
READ = """
import json, re, sys, time
sys.path.insert(0, {root!r})
from core.errors import FileError
from core.formats import foreign
start = time.process_time()
try:
    sketch = foreign.read_sketch({path!r})
    cubics = sum(len(trace.controls) for trace in sketch.traces)
    said = f"{{len(sketch.traces):,}} contours, {{cubics:,}} cubics"
except FileError as error:
    said = str(error)
seconds = time.process_time() - start
# What getrusage says begins with the memory of the parent process.
with open("/proc/self/status") as status:
    peak = 1024 * int(re.search(r"VmHWM:\\s*(\\d+)", status.read())[1])
print(json.dumps([said, seconds, peak]))
"""


def walk(count, seed=1):
    return np.cumsum(np.random.default_rng(seed).normal(size=(count, 2)), axis=0).round(3).tolist()


def svg_of(body):
    head = 'xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100"'
    return f"<svg {head}>{body}</svg>"


def dxf_of(body, blocks=""):
    if blocks:
        blocks = f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n"
    return f"{blocks}0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n"


def lines(count, joint):
    return "M" + joint.join(f"{x} {y}" for x, y in walk(count))


def pairs(count, prefix=""):
    return "".join(f"{prefix}10\n{x}\n20\n{y}\n" for x, y in walk(count))


def uses(levels):
    ten = ["".join(f'<use href="#l{k}"/>' for _ in range(10)) for k in range(levels)]
    groups = "".join(f'<g id="l{k + 1}">{ten[k]}</g>' for k in reversed(range(levels)))
    return groups + '<g id="l0"><rect width="1" height="1"/></g>'


def tower(levels, width):
    blocks = "0\nBLOCK\n2\nL0\n0\nCIRCLE\n40\n1\n0\nENDBLK\n"
    for k in range(1, levels):
        blocks += f"0\nBLOCK\n2\nL{k}\n" + f"0\nINSERT\n2\nL{k - 1}\n" * width + "0\nENDBLK\n"
    return blocks


BULGED = "".join(f"10\n{x}\n20\n{y}\n42\n0.5\n" for x, y in walk(400_000))
LINE = "0\nLINE\n8\n0\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n"

TRAPS = {
    "2,000,000 L": lambda: svg_of(f'<path d="{lines(2_000_000, "L")}"/>'),
    "2,000,000 l, implicit": lambda: svg_of(f'<path d="m{"3 4.5-3-4.5 " * 1_000_000}"/>'),
    "2,000,000 h and v": lambda: svg_of(f'<path d="M0 0{"h1v1" * 1_000_000}"/>'),
    "2,000,000 s": lambda: svg_of(f'<path d="M0 0{"s1 2 3 4" * 2_000_000}"/>'),
    "600,000 cubics C": lambda: svg_of(f'<path d="M0 0C{lines(1_800_000, " ")[1:]}"/>'),
    "500,000 arcs": lambda: svg_of(f'<path d="M0 0{"a1 2 3 011 1" * 500_000}"/>'),
    "1,000,000 subpaths": lambda: svg_of(f'<path d="{"M0 0h1" * 1_000_000}"/>'),
    "90,000 circles": lambda: svg_of('<circle cx="3" cy="4" r="5"/>' * 90_000),
    "90,000 rounded rectangles": lambda: svg_of('<rect width="3" height="4" rx="1"/>' * 90_000),
    "90,000 paths": lambda: svg_of('<path id="p" d="M1 2C3 4 5 6 7 8A9 9 9 0 0 1 2z"/>' * 90_000),
    "groups 99,000 deep": lambda: svg_of("<g>" * 99_000 + '<line x2="3"/>' + "</g>" * 99_000),
    "groups 1,000,000 deep": lambda: svg_of("<g>" * 1_000_000 + "</g>" * 1_000_000),
    "use bomb": lambda: svg_of(uses(30)),
    "entity bomb": lambda: "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'>"
    + "".join(f"<!ENTITY a{k} '{f'&a{k - 1};' * 10}'>" for k in range(1, 20))
    + "]><svg>&a19;</svg>",
    "a transform of 5,000,000 functions": lambda: svg_of(
        f'<g transform="{"scale(1)" * 5_000_000}"><line x2="3"/></g>'
    ),
    "40 MB of digits": lambda: svg_of(f'<path d="M0 0L{"1" * 40_000_000} 1"/>'),
    "40 MB of signs": lambda: svg_of(f'<path d="M0 0L{"-" * 40_000_000} 1"/>'),
    "LWPOLYLINE of 2,000,000 vertices": lambda: dxf_of(f"0\nLWPOLYLINE\n8\n0\n{pairs(2_000_000)}"),
    "LWPOLYLINE of 400,000 arcs": lambda: dxf_of(f"0\nLWPOLYLINE\n8\n0\n{BULGED}"),
    "POLYLINE of 1,500,000 vertices": lambda: dxf_of(
        "0\nPOLYLINE\n8\n0\n66\n1\n" + pairs(1_500_000, "0\nVERTEX\n8\n0\n") + "0\nSEQEND\n"
    ),
    "SPLINE of 500,000 points": lambda: dxf_of(
        "0\nSPLINE\n8\n0\n71\n3\n"
        + "".join(f"40\n{k}\n" for k in range(500_004))
        + pairs(500_000)
    ),
    "100,000 LINEs of one contour": lambda: dxf_of(
        "".join(LINE.format(*a, *b) for a, b in zip(walk(100_001), walk(100_001)[1:], strict=False))
    ),
    "99,000 CIRCLEs": lambda: dxf_of("0\nCIRCLE\n8\n0\n10\n1\n20\n2\n40\n3\n" * 99_000),
    "1,000,000 HATCHes": lambda: dxf_of("0\nHATCH\n8\n0\n" * 1_000_000),
    "exponential blocks": lambda: dxf_of("0\nINSERT\n2\nL29\n", tower(30, 10)),
    "a tower of 20,000 blocks": lambda: dxf_of("0\nINSERT\n2\nL19999\n", tower(20_000, 1)),
    "an array of 10^18": lambda: dxf_of(
        "0\nINSERT\n2\nL0\n70\n1000000000\n71\n1000000000\n", tower(1, 1)
    ),
    "50 MB of blank lines": lambda: "0\nSECTION\n" + "\n" * 50_000_000,
    "50 MB of one line": lambda: "0\n" + "x" * 50_000_000,
}


@pytest.mark.parametrize("trap", TRAPS)
def test_a_trap_costs_little(trap, tmp_path):
    path = tmp_path / "trap"
    path.write_text(TRAPS[trap]())
    script = READ.format(root=str(ROOT), path=str(path))
    run = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    said, seconds, peak = json.loads(run.stdout)
    print(f"  {trap:36} {path.stat().st_size / 1e6:5.1f} MB {seconds:6.2f} s {peak / 1e6:5.0f} MB"
          f"  {said}")  # fmt: skip
    assert seconds <= MAX_SECONDS
    assert peak <= MAX_BYTES


@pytest.mark.parametrize("make", [svg, dxf])
def test_damaged_files_are_read_soundly_or_refused(make, tmp_path):
    path = tmp_path / f"drawing.{make.__name__}"
    whole = [make(seed) for seed in range(200)]
    longest, refused, faults = 0.0, 0, []
    for seed in range(FIRST_SEED, FIRST_SEED + FILES):
        path.write_bytes(damaged(whole[seed % len(whole)], seed))
        # The processor's time, as the machine may have other work.
        start = time.process_time()
        try:
            refused += assert_sound_or_refused(path)
        except Exception as error:  # one fault must not hide the others
            faults.append((seed, repr(error)))
        longest = max(longest, time.process_time() - start)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(f"  {FILES:,} damaged {make.__name__}: {refused:,} refused, {FILES - refused:,} read,"
          f" {len(faults)} faults; slowest {longest:.3f} s, peak {peak / 1e6:.0f} MB"
          f" with the tests themselves")  # fmt: skip
    assert not faults, faults[:20]
    assert longest <= MAX_SECONDS
    assert peak <= MAX_BYTES
