import msgspec
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.export_fields import ROWS, ProfileFields
from app.fields import NumberField
from core.profiles import ENTITIES, PROFILES, VERSIONS, Profile, named


@pytest.fixture
def fields(qtbot):
    fields = ProfileFields(named("laser"))
    qtbot.addWidget(fields)
    fields.show()
    return fields


def shown(fields):
    return [row.key for row in ROWS if fields.editors[row.key].isVisible()]


def type_into(editor, text):
    editor.setFocus()
    editor.selectAll()
    QTest.keyClicks(editor, text)
    QTest.keyClick(editor, Qt.Key.Key_Return)


def choose(combo, value):
    combo.setCurrentIndex(combo.findData(value))


def test_each_format_has_its_own_fields(fields):
    assert shown(fields) == [
        "entity", "version", "tolerance_mm", "unit", "layers", "origin", "kerf_mm", "colour",
    ]  # fmt: skip
    fields.show_profile(named("svg"))
    assert shown(fields) == [
        "entity", "tolerance_mm", "unit", "layers", "kerf_mm", "colour", "width_mm",
    ]  # fmt: skip
    fields.show_profile(named("png"))
    assert shown(fields) == [
        "entity", "tolerance_mm", "kerf_mm", "colour", "width_mm", "dpi", "transparent",
    ]  # fmt: skip
    fields.show_profile(named("points"))
    assert shown(fields) == ["format", "entity", "tolerance_mm", "unit", "origin"]


@pytest.mark.parametrize("name", PROFILES)
def test_a_profile_that_is_shown_comes_back_unchanged(fields, name):
    changed = []
    fields.changed.connect(changed.append)
    fields.show_profile(named(name))
    assert changed == []
    fields._take()
    assert changed == [named(name)]


@pytest.mark.parametrize(
    ("name", "key", "text", "value"),
    [
        ("laser", "tolerance_mm", "1/4", 0.25),
        ("laser", "kerf_mm", "-0.1", -0.1),
        ("svg", "width_mm", "0,01", 0.01),
        ("png", "dpi", "96", 96.0),
    ],
)
def test_typed_numbers_change_the_profile(qtbot, fields, name, key, text, value):
    fields.show_profile(named(name))
    with qtbot.waitSignal(fields.changed) as changed:
        type_into(fields.editors[key], text)
    assert changed.args == [msgspec.structs.replace(named(name), **{key: value})]


@pytest.mark.parametrize(
    ("name", "key", "value"),
    [
        ("laser", "entity", "polyline"),
        ("laser", "version", "R12"),
        ("laser", "unit", "in"),
        ("laser", "layers", "by curve"),
        ("laser", "origin", "corner"),
        ("png", "transparent", False),
        ("points", "format", "json"),
    ],
)
def test_choices_change_the_profile(qtbot, fields, name, key, value):
    fields.show_profile(named(name))
    with qtbot.waitSignal(fields.changed) as changed:
        choose(fields.editors[key], value)
    assert changed.args == [msgspec.structs.replace(named(name), **{key: value})]


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("tolerance_mm", "0"), ("tolerance_mm", "abc"), ("tolerance_mm", "1e-9"),
        ("tolerance_mm", "9" * 400), ("kerf_mm", "101"), ("kerf_mm", ""),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_its_place(qtbot, fields, key, text):
    editor = fields.editors[key]
    if not text:
        editor.clear()
    with qtbot.waitSignal(fields.refused) as refused:
        type_into(editor, text)
    assert refused.args[0].endswith(".")
    assert fields.fault == refused.args[0]
    assert fields.profile == named("laser")
    with qtbot.waitSignal(fields.changed):
        type_into(editor, "0.5")
    assert not fields.fault


def test_two_fields_that_do_not_go_together_are_refused_until_one_is_mended(qtbot, fields):
    fields.show_profile(named("cad"))
    with qtbot.waitSignal(fields.refused) as refused:
        choose(fields.editors["version"], "R12")
    assert "R12 has no splines" in refused.args[0]
    assert fields.fault
    with qtbot.waitSignal(fields.changed) as changed:
        choose(fields.editors["entity"], "arcs")
    assert (changed.args[0].version, changed.args[0].entity) == ("R12", "arcs")


def test_a_refused_number_is_not_forgotten_when_another_field_changes(fields):
    type_into(fields.editors["tolerance_mm"], "abc")
    refused = []
    fields.refused.connect(refused.append)
    choose(fields.editors["layers"], "by curve")
    assert refused
    assert fields.fault == refused[-1]


def test_points_in_a_dxf_hide_what_they_have_not(fields):
    choose(fields.editors["entity"], "control points")
    assert not {"tolerance_mm", "kerf_mm"} & set(shown(fields))
    assert fields.profile.is_table


def test_every_field_has_a_name_a_sentence_and_a_letter(fields):
    letters = [row.label[row.label.index("&") + 1].lower() for row in ROWS]
    # Those of the dialog: For, Save profile, Delete profile, Reset, Export.
    assert len({*letters, *"fsdre"}) == len(letters) + 5
    for row in ROWS:
        editor = fields.editors[row.key]
        assert editor.accessibleName()
        assert editor.toolTip().endswith(".")


def test_all_choices_of_the_core_are_offered(fields):
    for form, entities in ENTITIES.items():
        profile = Profile(
            name="a", title="a", format=form, entity=entities[0],
            version=VERSIONS[0] if form == "dxf" else "",
        )  # fmt: skip
        fields.show_profile(profile)
        combo = fields.editors["entity"]
        assert tuple(combo.itemData(k) for k in range(combo.count())) == entities


def test_tab_goes_through_the_fields_in_their_order(qtbot, fields):
    fields.activateWindow()
    keys = shown(fields)
    fields.editors[keys[0]].setFocus()
    qtbot.waitUntil(lambda: fields.focusWidget() is not None)
    for key in keys[1:]:
        fields.focusNextChild()
        editor = fields.editors[key]
        assert fields.focusWidget() in (editor, editor.focusProxy())
        if isinstance(editor, NumberField):
            assert editor.accessibleName().endswith(" in mm")
