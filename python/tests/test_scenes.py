"""Resolved scenes, and dictionaries as TOML."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result
from slideway.report.facts import of_scene
from slideway.report.poses import poses
from slideway.scenes import tomllib, varied
from slideway.toml_writer import to_toml
from slideway.way import may_be_misaligned


def test_scene_is_resolved_in_si_units(result_of: Result) -> None:
    scene = slideway.scene(result_of("ensemble"))
    assert scene["mechanism"]["kind"] == "slider_crank"
    assert scene["joint"]["clearance_y"] == 1e-4
    assert scene["study"]["vary"]["initial.y"] == {"dist": "unif", "low": -4e-5, "high": 4e-5}
    assert "slider_mass" not in scene["mechanism"]


def test_derived_keys_are_there_when_asked_for(result_of: Result) -> None:
    mechanism = slideway.scene(result_of("ensemble"), derived=True)["mechanism"]
    assert mechanism["slider_mass"] == pytest.approx(7800 * 0.04 * 0.02 * 0.03)


@pytest.mark.parametrize("words", ["derived: density x slider_length x way_width x way_depth", "follows from other keys"])
def test_derived_keys_of_older_results_are_there_too(words: str) -> None:
    result = xr.Dataset(attrs={"scene": f"[mechanism]\n# slider_mass = 0.1872  # kg, {words}\n# apex_stiffness  # derived: E_s A\n"})
    assert slideway.scene(result, derived=True)["mechanism"] == {"slider_mass": 0.1872}
    assert slideway.scene(result)["mechanism"] == {}


def test_members_have_what_they_drew(result_of: Result) -> None:
    result = result_of("ensemble")
    for member in (0, 5):
        assert slideway.scene(result, member)["initial"]["y"] == float(result.initial_y[member])
    assert slideway.scene(result)["initial"]["y"] == 0


def test_sweep_sets_both_clearances(result_of: Result) -> None:
    result = result_of("sweep")  # five columns from 0.05 mm to 0.5 mm, two members each
    widest = slideway.scene(result, member=9)["joint"]
    assert widest["clearance_y"] == widest["clearance_z"] == pytest.approx(5e-4)
    assert slideway.scene(result, member=0)["joint"]["clearance_y"] == pytest.approx(5e-5)


def test_member_that_is_not_there_has_no_scene(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError, match="no member 64"):
        slideway.scene(result_of("ensemble"), member=64)


INPUTS = {"mechanism.crank_speed": [3.0, 6.0], "joint.clearance": [1e-4, 5e-4], "joint.slider_length": [0.04, 0.08], "way.offset_y": [0.0, 1e-4]}
SERIES: dict[str, Any] = {
    "schema": 1, "mechanism": {"crank_speed": 3}, "contact": {"law": "conservative"},
    "study": {"duration": "20 ms", "samples": 21, "quantities": ["x", "y", "z", "roll", "yaw", "pitch"]},
}  # fmt: skip


@pytest.fixture(scope="module", params=["table", "inputs"])
def own(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """Two members whose values no scene holds: rows of a table, or given inputs."""
    if request.param == "inputs":
        return slideway.Ensemble(SERIES).run(INPUTS)
    table = tmp_path_factory.mktemp("table") / "members.csv"
    table.write_text("\n".join([",".join(INPUTS), *(",".join(map(repr, row)) for row in zip(*INPUTS.values(), strict=True))]))
    return slideway.run(SERIES, study__design="table", study__table=str(table), progress=False)


def test_members_of_a_table_have_their_own_scene(own: xr.Dataset) -> None:
    assert set(varied(own)) == set(INPUTS)
    scene = slideway.scene(own, member=1, derived=True)
    assert scene["joint"]["clearance_y"] == scene["joint"]["clearance_z"] == 5e-4
    assert scene["mechanism"]["crank_speed"] == 6
    assert scene["mechanism"]["slider_mass"] == pytest.approx(7800 * 0.08 * 0.02 * 0.03)
    assert slideway.scene(own.sel(member=0), 0, derived=True)["mechanism"]["slider_mass"] == pytest.approx(7800 * 0.04 * 0.02 * 0.03)


def test_members_of_a_table_are_drawn_by_their_own_scene(own: xr.Dataset) -> None:
    plot = slideway.plot.time_series
    assert np.abs(plot(own, "x", 1, difference=True).lines[0].get_ydata()).max() < 500  # um; by the other's speed it were millimetres
    assert {line.get_ydata()[0] for line in plot(own, "y", 1).lines if line.get_linestyle() == ":"} == {500.0, -500.0}
    assert not any(line.get_linestyle() == ":" for line in plot(own, "y").lines)
    assert may_be_misaligned(own)
    shown = poses(own, 1)
    assert (shown.joint.gap_y, shown.joint.length, shown.y[0]) == (5e-4, 0.08, pytest.approx(own.y.values[1, 0] - 1e-4))
    assert ("varies: joint.clearance", "2 values from 100 µm to 500 µm") in of_scene(own, 2)


def test_scene_of_a_member_of_given_inputs_runs_again() -> None:
    own = slideway.Ensemble(SERIES).run(INPUTS)
    again = slideway.run(slideway.scene(own, member=1), progress=False)
    np.testing.assert_array_equal(again.y.values, own.y.values[1:])
    with pytest.raises(slideway.SceneError, match=r"study.table is .* slideway.scene\(result, member=K\)"):
        slideway.run(slideway.scene(own), progress=False)


def test_dataset_without_scene_says_so() -> None:
    with pytest.raises(slideway.SlidewayError, match="carries no scene"):
        slideway.scene(xr.Dataset())


@pytest.mark.parametrize(
    "scene",
    [
        {"schema": 1, "title": 'quotes ", \\ and\nlines, π\x07'},
        {"study": {"members": 8, "values": [1, 2.5, 1e-300, -0.0], "texts": ["0.1 mm", ""], "flag": True, "none": []}},
        {"study": {"vary": {"initial.y": {"dist": "unif", "low": -1e-5, "high": "0.02 mm"}}}},
        {"study": {"vary": {"initial.y": {"dist": "unif"}}, "members": 3}, "title": "tables before values"},
        {"study": {"section": {"on": "vy", "value": 0}, "limits": {"mode_time[free]": {"max": "1 ms"}}}},
        {"study": {"correlation": {"keys": ["a.b", "c"], "matrix": [[1, 0.5], [0.5, 1]]}}},
        {"friction": {}, "study": {"vary": {}}},
    ],
)
def test_toml_reads_back_as_it_was(scene: dict[str, Any]) -> None:
    assert tomllib.loads(to_toml(scene)) == scene


def test_toml_takes_numpy_numbers_and_lists() -> None:
    text = to_toml({"study": {"values": np.array([1.5, 2.0]), "members": np.int64(4), "pair": (1, 2)}})
    assert tomllib.loads(text) == {"study": {"values": [1.5, 2.0], "members": 4, "pair": [1, 2]}}


def test_toml_keeps_every_bit_of_a_number() -> None:
    numbers = [0.1, 1 / 3, 5e-324, 1.7976931348623157e308, 3.141592653589793]
    assert tomllib.loads(to_toml({"n": numbers}))["n"] == numbers


@pytest.mark.parametrize("value", [None, object(), 1j, {1, 2}])
def test_what_toml_cannot_hold_is_refused_by_its_key(value: object) -> None:
    with pytest.raises(slideway.SlidewayError, match=r"study\.base is .*use a number"):
        to_toml({"study": {"base": value}})
