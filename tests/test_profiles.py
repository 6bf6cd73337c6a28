import json
from itertools import product

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import NinepointError
from core.profiles import (
    ENTITIES,
    LAYERS,
    MAX_TOLERANCE_MM,
    MIN_TOLERANCE_MM,
    ORIGINS,
    PROFILES,
    UNITS_MM,
    VERSIONS,
    Profile,
    check_tolerance,
    decimals,
    decode,
    encode,
    named,
)

LEAST = {"name": "mine", "title": "Mine", "format": "svg", "entity": "cubics"}


@st.composite
def profiles(draw):
    form = draw(st.sampled_from(list(ENTITIES)))
    entity = draw(st.sampled_from(ENTITIES[form]))
    versions = ("",) if form != "dxf" else VERSIONS[: 1 if entity == "spline" else 2]
    return Profile(
        name=draw(st.from_regex("[a-z0-9]{1,9}(-[a-z0-9]{1,9}){0,3}", fullmatch=True)),
        title=draw(st.text(st.characters(categories=["L", "N", "S"]), min_size=1, max_size=20)),
        use=draw(st.text(st.characters(categories=["L", "P"]), max_size=20)),
        format=form,
        entity=entity,
        version=draw(st.sampled_from(versions)),
        unit=draw(st.sampled_from(list(UNITS_MM))),
        tolerance_mm=draw(st.floats(MIN_TOLERANCE_MM, MAX_TOLERANCE_MM)),
        colour=draw(st.from_regex("#[0-9a-f]{6}", fullmatch=True)),
        width_mm=draw(st.floats(0.001, 10)),
        layers=draw(st.sampled_from(LAYERS)),
        origin=draw(st.sampled_from(ORIGINS)),
        kerf_mm=draw(st.floats(-5, 5)),
        dpi=draw(st.floats(10, 1200)),
        transparent=draw(st.booleans()),
    )


@given(profiles())
def test_every_profile_reads_back_from_its_json(profile):
    assert decode(encode(profile)) == profile


@given(profiles())
def test_the_json_has_every_field_sorted(profile):
    fields = list(json.loads(encode(profile)))
    assert fields == sorted(Profile.__struct_fields__)


def test_fields_that_are_left_out_have_their_defaults():
    assert decode(json.dumps(LEAST)) == Profile(**LEAST)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b"{", "truncated"),
        (b"[]", "Expected `object`"),
        (b"\xff", "malformed"),
        (json.dumps({**LEAST, "colour2": 1}), "unknown field `colour2`"),
        (json.dumps({**LEAST, "dpi": "300"}), "Expected `float`"),
        (json.dumps({**LEAST, "entity": "arcs"}), "content of SVG must be one of: cubics, polyl"),
        (json.dumps({"name": "a"}), "missing required field"),
        ("[" * 100_000, "This is not"),
    ],
)
def test_other_texts_are_refused_in_a_sentence(text, words):
    with pytest.raises(NinepointError, match=r"^(This is not an export prof|The content)") as told:
        decode(text)
    assert type(told.value) is NinepointError
    assert words in str(told.value)
    assert str(told.value).endswith(".")


@pytest.mark.parametrize(
    "field",
    [
        {"name": "Laser"},
        {"name": "-"},
        {"name": "a--b"},
        {"name": ""},
        {"name": "a" * 101},
        {"title": " "},
        {"title": "two\nlines"},
        {"use": "x" * 101},
        {"format": "gcode"},
        {"entity": "circle"},
        {"version": "R2000"},
        {"unit": "px"},
        {"layers": "many"},
        {"origin": "centre"},
        {"colour": "blue"},
        {"colour": "#12345"},
        {"tolerance_mm": 0.0},
        {"tolerance_mm": float("nan")},
        {"width_mm": 0.0},
        {"width_mm": float("inf")},
        {"kerf_mm": float("nan")},
        {"kerf_mm": -101.0},
        {"dpi": 0.0},
        {"format": "dxf", "entity": "arcs"},
        {"format": "dxf", "entity": "arcs", "version": "R14"},
        {"format": "dxf", "entity": "spline", "version": "R12"},
    ],
)
def test_values_that_make_no_sense_are_refused(field):
    with pytest.raises(NinepointError, match=r"\.$"):
        Profile(**{**LEAST, **field})


def test_a_profile_is_frozen_and_another_tolerance_is_checked():
    profile = named("laser")
    with pytest.raises(AttributeError):
        profile.unit = "in"
    assert profile.within(0.5).tolerance_mm == 0.5
    assert profile.within(0.5) == msgspec.structs.replace(profile, tolerance_mm=0.5)
    with pytest.raises(NinepointError, match="tolerance must lie between 1e-06 and 100 mm"):
        profile.within(0)


@pytest.mark.parametrize("tolerance", [0, -1, 1e-7, 101, float("nan"), float("inf")])
def test_tolerances_that_make_no_sense_are_refused(tolerance):
    with pytest.raises(NinepointError, match="tolerance must lie between 1e-06 and 100 mm"):
        check_tolerance(tolerance)


def test_the_built_in_profiles_are_those_of_the_command_line():
    assert {"laser", "laser-r12", "cad", "svg", "svg-polyline", "points"} < set(PROFILES)
    kinds = {name: (p.format, p.entity, p.version) for name, p in PROFILES.items()}
    assert kinds["laser"] == ("dxf", "arcs", "R2000")
    assert kinds["laser-r12"] == ("dxf", "polyline", "R12")
    assert kinds["cad"] == ("dxf", "spline", "R2000")
    assert kinds["svg"] == ("svg", "cubics", "")
    assert kinds["svg-polyline"] == ("svg", "polyline", "")
    assert kinds["points"][0] == "csv"
    blue = named("svg-blue")
    assert (blue.colour, blue.width_mm) == ("#0000ff", 0.01)
    assert all(profile.name == name for name, profile in PROFILES.items())
    assert len({profile.title for profile in PROFILES.values()}) == len(PROFILES)


def test_a_name_that_is_not_known_is_told_with_those_that_are():
    with pytest.raises(NinepointError, match="no profile 'plasma'; there are laser, laser-r12"):
        named("plasma")


def test_decimals_hold_a_tolerance_with_guards():
    for power, guard in product(range(-5, 3), (2, 4)):
        places = decimals(10.0**power, guard)
        assert places == max(-power, 0) + guard
        assert decimals(0.99 * 10.0**power, guard) == max(1 - power, 0) + guard
