"""Runs are made once, and one that fails stops no other."""

from pathlib import Path

import pytest
from reproduction.plan import plan
from reproduction.runs import Laboratory, Missing, Run
from reproduction.scale import SCALES

KEYS = {
    "study.members": 3,
    "study.revolutions": 0.005,
    "study.samples_per_revolution": 2000,
    "study.vary": {"initial.y": {"dist": "unif", "low": -1e-5, "high": 1e-5}},
}


@pytest.fixture
def said() -> list[str]:
    return []


def laboratory(scenes: Path, folder: Path, said: list[str]) -> Laboratory:
    return Laboratory(scenes, folder, 1, said.append)


def test_a_result_of_the_same_scene_is_not_made_again(scenes: Path, tmp_path: Path, said: list[str]) -> None:
    first, other = (Run("one", "slider_crank_0.1mm.toml", KEYS), Run("one", "slider_crank_0.1mm.toml", {**KEYS, "study.members": 2}))
    laboratory(scenes, tmp_path, said).make([first])
    made = (tmp_path / "one.nc").stat().st_mtime_ns
    laboratory(scenes, tmp_path, said).make([first])
    assert (tmp_path / "one.nc").stat().st_mtime_ns == made
    assert said[1].endswith("is there")
    last = laboratory(scenes, tmp_path, said)
    last.make([other])
    assert last.result("one").sizes["member"] == 2


def test_a_run_goes_on_from_where_another_ended(scenes: Path, tmp_path: Path, said: list[str]) -> None:
    bench = laboratory(scenes, tmp_path, said)
    bench.make([Run("one", "slider_crank_0.1mm.toml", KEYS), Run("two", "slider_crank_0.1mm.toml", {**KEYS, "study.vary": None}, after="one", members=2)])
    assert not bench.failures
    assert bench.result("two").sizes["member"] == 2
    for state in ("y", "vz", "pitch", "wx"):
        assert bench.result("two")[state].values[:, 0].tolist() == bench.result("one")[f"final_{state}"].values[:2].tolist()


def test_a_run_that_fails_stops_no_other(scenes: Path, tmp_path: Path, said: list[str]) -> None:
    bench = laboratory(scenes, tmp_path, said)
    bench.make(
        [
            Run("bad", "slider_crank_0.1mm.toml", {"joint.clearance": "-1 mm"}),
            Run("after", "slider_crank_0.1mm.toml", KEYS, after="bad"),
            Run("good", "slider_crank_0.1mm.toml", KEYS),
        ]
    )
    assert set(bench.failures) == {"bad", "after"}
    assert "clearance" in bench.failures["bad"]
    assert bench.result("good").sizes["member"] == 3
    with pytest.raises(Missing, match="clearance"):
        bench.result("bad")


def test_runs_that_follow_others_come_after_them() -> None:
    names: list[str] = []
    for run in plan(SCALES["full"]):
        assert run.after is None or run.after in names
        assert run.name not in names
        names.append(run.name)
