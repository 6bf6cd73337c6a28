"""The programs that open exports: packages of Debian and Ubuntu, and their versions."""

import os
import re
import shutil
import subprocess
import sys

PACKAGES = (
    "freecad",
    "inkscape",
    "python3-cssselect",  # for the importers of Inkscape
    "python3-lxml",
    "python3-tinycss2",
    "librecad",
    "openscad",
    "librsvg2-bin",
    "mupdf-tools",  # reads what LibreCAD prints
    "poppler-utils",
    "imagemagick",
    "openbox",  # the real window
    "xdotool",
    "xvfb",
)

INSTALL = ["apt-get", "install", "-y", "--no-install-recommends", *PACKAGES]
SAYING = "install the programs with: sudo " + " ".join(INSTALL)


def install():
    """Install all packages, as root; else end with the command that does."""
    if shutil.which("apt-get") is None:
        sys.exit("These are packages of Debian and Ubuntu: " + " ".join(PACKAGES))
    if os.geteuid():
        sys.exit("To " + SAYING)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], INSTALL):
        subprocess.run(command, check=True, env=environment)


def needed(program):
    """Path of a program."""
    found = shutil.which(program)
    assert found, f"There is no {program}; {SAYING}"
    return found


def version_of(package):
    """Version of the program in a package, without what Debian adds."""
    run = subprocess.run(
        ["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True
    )
    return re.sub(r"^\d+:|[-+].*", "", run.stdout)
