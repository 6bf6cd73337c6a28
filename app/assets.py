"""Where icons and example documents are found: in a checkout as in an installed package."""

from __future__ import annotations

from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


@cache
def resources() -> Path:
    """Folder of the resources.

    An installed wheel carries it inside the package; in a checkout it lies beside the package.
    """
    inside = PACKAGE / "resources"
    return inside if inside.is_dir() else PACKAGE.parent / "resources"


def icon_path(name: str) -> Path:
    """File of the icon called ``name``."""
    return resources() / "icons" / f"{name}.svg"


def example_paths() -> list[Path]:
    """The example documents, sorted by name; empty if the folder is missing."""
    return sorted((resources() / "examples").glob("*.ninepoint"))
