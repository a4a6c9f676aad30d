"""slideway.keys(): what there is to set, as the program says."""

import json
import stat

import pytest
import slideway
from slideway.program import call


def rows():
    return json.loads(call(None, ["list", "--json"]))["keys"]


def test_keys_are_all_of_the_table():
    keys, table = slideway.keys(), rows()
    assert list(keys) == [row["name"] for row in table]
    for row in table:
        key = keys[row["name"]]
        assert (key.name, key.type, key.meaning) == (row["name"], row["type"], row["meaning"])
        assert (key.unit, key.default) == (row.get("unit", ""), row.get("default", ""))
        assert all(key.counts_for.get(what, []) == row.get(what, []) for what in ("mechanisms", "laws", "studies", "methods"))
        assert all(choice in key.domain for choice in row.get("choices", []))
        assert bool(key.domain) == any(limit in row for limit in ("minimum", "exclusive_minimum", "maximum", "choices"))
        assert row["meaning"] in str(key)


def test_a_key_that_is_added_to_the_table_is_there(tmp_path):
    added = {"name": "joint.play", "type": "number", "unit": "m", "exclusive_minimum": 0, "maximum": 0.5, "default": "0.1", "meaning": "play of a trial"}
    program = tmp_path / "slideway"
    program.write_text(f"#!/bin/sh\ncat <<'END'\n{json.dumps({'keys': [*rows(), added]})}\nEND\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    key = slideway.keys(program=program)["joint.play"]
    assert str(key) == "joint.play [m]: play of a trial; > 0, ≤ 0.5; default 0.1"


def test_keys_are_found_by_a_part_of_their_name():
    found = slideway.keys("clearance")
    faces = [f"joint.clearance_{axis}_{side}" for axis in "yz" for side in ("plus", "minus")]
    assert list(found) == ["joint.clearance_y", "joint.clearance_z", *faces, "joint.clearance", "link.<name>.clearance"]
    assert str(found).count("\n") == 7
    assert slideway.keys("no such part") == {}


@pytest.mark.parametrize(
    ("word", "hint"),
    [("seed", "did you mean study__seed?"), ("study_members", "did you mean study__members?"), ("frobnicate", "study__members=64")],
)
def test_a_word_that_is_no_argument_gets_a_hint_of_the_table(word, hint):
    with pytest.raises(slideway.SlidewayError) as refused:
        slideway.run({"schema": 1}, **{word: 3})
    assert f"run() has no argument {word}" in str(refused.value)
    assert hint in str(refused.value)


def test_help_of_run_names_the_keys():
    assert "slideway.keys" in slideway.run.__doc__
