import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

import core

FOLDER = Path(core.__file__).parent
MODULES = sorted(path.stem for path in FOLDER.glob("*.py") if path.stem != "__init__")


def imports_for_types():
    """The names that a type checker sees, each with its module."""
    (block,) = (
        node
        for node in ast.parse(Path(core.__file__).read_text(encoding="utf-8")).body
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
    )
    return {name.name: line.module for line in block.body for name in line.names}


def in_a_new_process(code):
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=FOLDER.parent, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_what_is_public_is_what_a_type_checker_sees():
    assert sorted(core.__all__) == sorted(imports_for_types())


@pytest.mark.parametrize("name", core.__all__)
def test_a_public_name_is_that_of_its_module(name):
    public = getattr(core, name)
    assert not isinstance(public, ModuleType)
    assert public is getattr(import_module(imports_for_types()[name]), name)


def test_names_are_loaded_when_they_are_asked_for():
    code = "import sys, core.errors; print('numpy' in sys.modules); core.Mask; print(core.Mask)"
    assert in_a_new_process(code) == "False\n<class 'core.mask.Mask'>\n"


def test_a_module_does_not_hide_the_function_of_its_name():
    code = "import core.report, core.arcs; from core import report, arcs; print(arcs, report)"
    assert in_a_new_process(code).count("<function") == 2


def test_a_star_brings_all_names():
    code = "before = set(dir()); from core import *; print(len(set(dir()) - before) - 1)"
    assert int(in_a_new_process(code)) == len(core.__all__)


def test_what_is_not_public_is_refused():
    with pytest.raises(AttributeError, match="module 'core' has no attribute 'Curves'"):
        core.Curves  # noqa: B018
    assert {"LimitCurve", "__version__"} & set(dir(core)) == {"LimitCurve"}


def test_each_module_can_be_the_first_that_is_loaded():
    code = f"""
import sys
from importlib import import_module
for name in {MODULES}:
    for loaded in [m for m in sys.modules if m == "core" or m.startswith("core.")]:
        del sys.modules[loaded]
    import_module(f"core.{{name}}")
"""
    in_a_new_process(code)
