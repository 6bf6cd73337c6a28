"""Open exports in other programs: `python3 tests/acceptance [--install] [--markdown FILE]`.

``--install`` installs the programs first, as root on Debian and Ubuntu. The long table goes to the
terminal as it grows, then the summary; ``--markdown`` writes that into a file, too.
"""

import argparse
import os
import sys

if __name__ == "__main__":
    HERE = os.path.dirname(os.path.realpath(__file__))
    ROOT = os.path.dirname(os.path.dirname(HERE))
    sys.path[0] = ROOT  # it was this folder
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

    from app.bootstrap import enter

    enter(os.path.join("tests", "acceptance"), extra="test")
    sys.path[1:1] = [os.path.join(ROOT, "tests"), HERE]

    import tempfile
    from pathlib import Path

    import debian
    import table

    parser = argparse.ArgumentParser(prog="tests/acceptance", description=__doc__.splitlines()[0])
    parser.add_argument("--install", action="store_true", help="install the programs first")
    parser.add_argument("--markdown", type=Path, help="write the summary into this file")
    chosen = parser.parse_args()
    if chosen.install:
        debian.install()
    with tempfile.TemporaryDirectory() as folder:
        found = table.lines(Path(folder), lambda words: print(words, flush=True))
    text = table.markdown(found)
    print(f"\nThe worst of all drawings:\n\n{text}")
    if chosen.markdown:
        chosen.markdown.write_text(text, encoding="utf-8")
