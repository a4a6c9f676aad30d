"""The JSON Schema of scenes, held against a validator and the scenes that are shipped."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from slideway.program import call
from slideway.scenes import tomllib


SCENES = sorted((Path(__file__).resolve().parents[2] / "scenes").glob("*.toml"))


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft7Validator:
    schema = json.loads(call(None, ["list", "--schema"]))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_shipped_scenes_are_valid(validator: jsonschema.Draft7Validator, path: Path) -> None:
    validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    "table, key, value",
    [
        ("joint", "clearence", 1e-4), ("joint", "clearance", -1), ("joint", "clearance", "1 500 mm"), ("joint", "clearance", "0.1.5 mm"),
        ("joint", "clearance", "1+1 mm"), ("joint", "clearance", "1,5 mm"), ("joint", "clearance", "mm"), ("joint", "clearance", True),
        ("contact", "law", "papers"), ("contact", "restitution", 1.5), ("integrator", "rtol", 1.0), ("integrator", "locate_modes", "yes"),
        ("study", "members", 0), ("study", "members", 1.5), ("study", "kind", "ensembles"), ("study", "quantities", "peak_tilt"),
    ],
)
def test_bad_values_are_not(validator: jsonschema.Draft7Validator, table: str, key: str, value: Any) -> None:
    assert not validator.is_valid({"schema": 1, table: {key: value}})


def test_units_and_whole_scenes_are(validator: jsonschema.Draft7Validator) -> None:
    for text in ("0.1 mm", "+1e-4m", ".5 mm", " 7 m "):
        assert validator.is_valid({"schema": 1, "joint": {"clearance": text}}), text
    assert validator.is_valid(tomllib.loads(call(None, ["check", str(SCENES[0]), "--resolved"])))
    assert not validator.is_valid({})
    assert not validator.is_valid({"schema": 1, "joints": {}})
