import re

import pytest

from app import assets
from app.actions import COMMANDS
from app.icons import PLACEHOLDER_COLOUR, program_icon


def test_resources_are_found_beside_the_package_or_inside_it(monkeypatch, tmp_path):
    package = tmp_path / "app"
    (package / "resources").mkdir(parents=True)
    for inside, expected in ((True, package / "resources"), (False, tmp_path / "resources")):
        if not inside:
            (package / "resources").rmdir()
        monkeypatch.setattr(assets, "PACKAGE", package)
        assets.resources.cache_clear()
        assert assets.resources() == expected
    monkeypatch.undo()
    assets.resources.cache_clear()
    assert assets.resources().is_dir()


@pytest.mark.parametrize("name", sorted({c.icon for c in COMMANDS if c.icon}))
def test_an_action_icon_has_no_colour_of_its_own(name):
    drawing = assets.icon_path(name).read_text(encoding="utf-8")
    assert PLACEHOLDER_COLOUR in drawing
    assert not re.search(r"#[0-9a-fA-F]{3,6}|rgb", drawing)
    assert 'viewBox="0 0 24 24"' in drawing


def test_every_drawn_icon_is_used():
    drawn = {path.stem for path in (assets.resources() / "icons").glob("*.svg")}
    assert drawn == {c.icon for c in COMMANDS if c.icon} | {"ninepoint"}


def test_the_program_has_an_icon(qtbot):
    assert not program_icon().pixmap(64, 64).isNull()
