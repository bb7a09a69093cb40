"""JSON Schemas of the shipped files: what ships is what the models say, and by it shipped files are valid."""

import json
import tomllib

import jsonschema
import pytest

from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.file_schema import json_schema
from ftc_jsb.resources import shipped
from ftc_jsb.scenario.schema import Scenario

FOLDER = shipped("scenarios")
KINDS = {"scenario": (Scenario, FOLDER), "campaign": (Campaign, FOLDER / "campaigns")}
FILES = [
    (kind, path) for kind, (_, folder) in KINDS.items() for path in sorted(folder.glob("*.toml"))
]


@pytest.mark.parametrize("kind", KINDS)
def test_what_ships_is_what_the_models_say(kind):
    """`make schema` writes it again."""
    shipped_one = json.loads((FOLDER / "schema" / f"{kind}.json").read_text(encoding="utf-8"))
    made = json_schema(KINDS[kind][0], f"{kind.capitalize()} of ftc-jsb")
    assert shipped_one == json.loads(json.dumps(made))
    jsonschema.Draft202012Validator.check_schema(shipped_one)


@pytest.mark.parametrize(("kind", "path"), FILES, ids=lambda value: getattr(value, "stem", value))
def test_a_shipped_file_names_its_schema_and_is_valid_by_it(kind, path):
    text = path.read_text(encoding="utf-8")
    directive, _, named = text.splitlines()[0].partition(" ")
    assert directive == "#:schema"
    schema = json.loads((path.parent / named).read_text(encoding="utf-8"))
    assert schema["title"].startswith(kind.capitalize())
    jsonschema.validate(tomllib.loads(text), schema)


def test_wrong_keys_and_values_are_seen_by_an_editor_and_units_are_shown():
    schema = json_schema(Scenario, "")
    paper = tomllib.loads((FOLDER / "paper.toml").read_text(encoding="utf-8"))
    for wrong in (
        {"duratoin": 3},
        {"duration": -1},
        {"model": "glider"},
        {"fault": [{"begin": 3}]},
    ):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**paper, **wrong}, schema)
    assert schema["properties"]["duration"]["description"] == "s"
    assert schema["$defs"]["Fault"]["properties"]["delay"]["description"] == "s"
