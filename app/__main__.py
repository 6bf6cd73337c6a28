"""Start Ninepoint: `python3 app [FILE ...]` in a checkout, `ninepoint [FILE ...]` elsewhere."""

import os
import sys


def main() -> None:
    """Run the command line, or open the window if there is nothing on it."""
    # Read when numpy is imported: our matrices are small, and a pool of threads only delays them.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        # A shell asks without words for what words there could be (`app.commands.completion`).
        if len(sys.argv) > 1 or "_NINEPOINT_COMPLETE" in os.environ:
            from app.cli import main as command_line

            command_line()
        else:  # there is nothing to parse, and that takes 10 ms
            from app.entrance import main as open_at_once

            open_at_once()
    except ImportError:  # of Qt, because the system lacks what it loads?
        from app import bootstrap

        lacking = bootstrap.missing_packages()
        bootstrap.require_packages(lacking)
        if not lacking or bootstrap.missing_packages():
            raise
        bootstrap.go_on([sys.executable, *sys.orig_argv[1:]])


if __name__ == "__main__":
    if not __package__:  # started as a folder, by any Python; the path began with that folder
        sys.path[0] = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
        from app.bootstrap import enter

        enter("app")
    main()
