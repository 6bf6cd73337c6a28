"""Run the tests: `python3 tests [pytest options]`, from any folder, with nothing but Python."""

import os
import sys

if __name__ == "__main__":
    ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
    sys.path[0] = ROOT  # it was the folder of this file
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # see app/__main__.py

    from app.bootstrap import enter

    enter("tests", extra="test")
    os.chdir(ROOT)

    import pytest

    # All of them: on all cores. Who asks for something sees it as it goes, in one process; and
    # benchmarks must have the machine for themselves.
    words = sys.argv[1:] or ["--numprocesses", "auto", "--dist", "worksteal"]
    sys.exit(pytest.main(words))
