"""Runs in memory: the same numbers as the program's, and what they say when they are asked wrongly."""

from __future__ import annotations

import functools
import os
import resource
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import scenes, slow
from slideway.program import call

small: dict[str, Any] = {
    "schema": 1,
    "contact": {"law": "paper"},
    "study": {
        "kind": "ensemble", "members": 6, "duration": "20 ms", "quantities": ["peak_normal_force", "mode_time", "peak_tilt"],
        "vary": {"initial.y": {"dist": "unif", "low": 0, "high": "20 um"}, "joint.clearance": {"dist": "unif", "low": "50 um", "high": "0.1 mm"}},
    },
}  # fmt: skip

# Each kind of study, and each way to store one: with what makes it small; revolutions of a fast crank are few steps.
studies = {
    "ensemble_starts": {"study.members": 12, "study.duration": "20 ms"},
    "lyapunov_0.1mm": {"study.members": 3, "study.transient_revolutions": 1, "study.revolutions": 2, "mechanism.crank_speed": "600 rpm"},
    "lyapunov_rigid": {"study.members": 3, "study.transient_revolutions": 0, "study.revolutions": 1},
    "tolerance_0.1mm": {"study.base": 8, "study.duration": "1 ms"},
    "tolerance_table": {"study.duration": "1 ms"},
    "poincare_0.1mm": {"study.members": 3, "study.transient_revolutions": 1, "study.revolutions": 3, "mechanism.crank_speed": "120 rpm"},
    "planar_flores": {"study.duration": "20 ms"},
    "rigid_starts": {"study.members": 12, "study.duration": "0.1 s"},
    "slider_crank_rigid": {"study.members": 6, "study.revolutions": 1, "mechanism.crank_speed": "600 rpm"},
    "sweep_clearance": {
        "study.members": 2, "study.points": 3, "study.transient_revolutions": 0, "study.revolutions": 2, "mechanism.crank_speed": "600 rpm"},
    "sweep_rigid": {"study.members": 2, "study.points": 2, "study.transient_revolutions": 0, "study.revolutions": 2},
    "carriage_3": {"study.duration": "5 ms"},
}


@pytest.fixture(autouse=True)
def _program(program: str) -> None:
    """Every test here has one."""


@pytest.fixture(scope="module")
def stored_of(program: str, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], xr.Dataset]:
    """The program's result of a study, run once."""
    folder = tmp_path_factory.mktemp("stored")

    @functools.cache
    def of(name: str) -> xr.Dataset:
        changes = {**studies[name], "study.verify": 0}
        return slideway.run(scenes / f"{name}.toml", folder / f"{name}.nc", set=changes, progress=False, max_failures="100%")

    return of


@pytest.mark.parametrize("threads", [2, *slow(1)])
@pytest.mark.parametrize("name", studies)
def test_results_in_memory_are_those_of_the_program(name: str, threads: int, stored_of: Callable[[str], xr.Dataset]) -> None:
    stored = stored_of(name)
    computed = slideway.Ensemble(scenes / f"{name}.toml", threads=threads, set=studies[name]).run()

    varying = {"created", "threads", "commit", "completeness", "format_version", "payload_hash", "metadata_hash", "scene"}
    assert {k for k in computed.attrs} - varying == {k for k in stored.attrs} - varying
    xr.testing.assert_identical(computed.drop_attrs(deep=False), stored.drop_attrs(deep=False))
    # The file that it becomes has the program's hash, and its groups.
    path = slideway.results.path_of(computed)
    assert payload(path) == payload(stored.slideway.path)
    without_check = [group for group in slideway.groups(stored) if group != "verification"]
    assert slideway.groups(computed) == without_check
    for group in without_check:
        xr.testing.assert_identical(slideway.open(path, group).drop_attrs(deep=False), slideway.open(stored.slideway.path, group).drop_attrs(deep=False))


def payload(path: str) -> str:
    import netCDF4

    call(None, ["info", "--check", path])
    with netCDF4.Dataset(path) as file:
        return str(file.payload_hash)


def test_a_check_is_made_where_it_is_asked_for() -> None:
    ensemble = slideway.Ensemble(small, verify=True)
    assert slideway.groups(ensemble.run()) == ["verification"]
    assert slideway.groups(slideway.Ensemble(small).run()) == []


def test_runs_with_other_values_are_those_of_the_scene_with_them() -> None:
    ensemble = slideway.Ensemble(small)
    changed = ensemble.run(contact__law="conservative", set={"mechanism.crank_speed": "60 rpm"})
    expected = slideway.Ensemble({**small, "contact": {"law": "conservative"}, "mechanism": {"crank_speed": "60 rpm"}}).run()
    xr.testing.assert_identical(changed.drop_attrs(deep=False), expected.drop_attrs(deep=False))
    # The ensemble itself is as it was.
    assert not np.array_equal(changed.peak_normal_force, ensemble.run().peak_normal_force)


def test_tables_are_read_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    table = tmp_path / "p.csv"
    table.write_text("time [s], force [N]\n0, 0\n1, 40\n")
    load = {"table": "p.csv", "over": "time", "column": "force", "force_x": 1, "scale": 2}
    study = {"kind": "ensemble", "members": 2, "duration": "5 ms", "quantities": ["load_work"]}
    monkeypatch.chdir(tmp_path)
    ensemble = slideway.Ensemble({"schema": 1, "load": {"push": load}, "study": study})
    changes = {"load.push.scale": 4}
    work, more = ensemble.run().load_work.values, ensemble.run(set=changes).load_work.values
    assert (work != more).all()
    table.write_text("time [s], force [N]\n0, 70\n1, 40\n")
    monkeypatch.chdir(tmp_path.parent)
    np.testing.assert_array_equal(ensemble.run().load_work.values, work)
    np.testing.assert_array_equal(ensemble.run(set=changes).load_work.values, more)
    table.unlink()
    np.testing.assert_array_equal(ensemble.run(set=changes).load_work.values, more)


def test_members_are_those_that_are_given() -> None:
    ensemble = slideway.Ensemble(small)
    drawn = ensemble.members()
    assert list(drawn) == ["initial_y", "joint_clearance"] and drawn.sizes == {"member": 6}
    as_drawn = ensemble.run()
    np.testing.assert_array_equal(as_drawn.initial_y, drawn.initial_y)
    by_name = {key: drawn[key.replace(".", "_")].values for key in ensemble.inputs}
    for inputs in (by_name, np.stack(list(by_name.values()), axis=1)):
        given = ensemble.run(inputs=inputs)
        for name in as_drawn:
            np.testing.assert_array_equal(given[name], as_drawn[name], name)
    # Keys that the scene does not vary, and another number of members.
    wide = ensemble.run(inputs={"joint.clearance": [1e-4, 2e-4], "friction.kinetic": 0.1, "friction.static": 0.2})
    assert wide.sizes["member"] == 2 and wide.joint_clearance.values.tolist() == [1e-4, 2e-4]


def test_members_of_a_scenes_table_may_be_given_too() -> None:
    ensemble = slideway.Ensemble(scenes / "tolerance_table.toml", study__duration="1 ms", study__verify=0)
    drawn = ensemble.members()
    as_drawn = ensemble.run()
    given = ensemble.run(inputs={key: drawn[key.replace(".", "_")].values for key in ensemble.inputs})
    np.testing.assert_array_equal(given.drive_work.values, as_drawn.drive_work.values)
    with pytest.raises(slideway.SceneError, match=r"study\.table has a column of .*, which inputs of members lack"):
        ensemble.run(inputs={"friction.kinetic": [0.1]})


@pytest.mark.parametrize(
    ("inputs", "says"),
    [
        ({"joint.clearence": [1e-4]}, "joint.clearence"),
        ({"joint.clearance": [1e-4], "joint.clearance_y": [1e-4]}, "set the same input"),
        ({"joint.clearance": ["wide"]}, "joint.clearance is"),
        ({}, "inputs of members need keys"),
        (np.zeros((3, 5)), r"\[members, 2\]"),
        (np.zeros(3), r"\[members, 2\]"),
    ],
)
def test_inputs_that_cannot_be_used_are_named(inputs: Any, says: str) -> None:
    with pytest.raises(slideway.SlidewayError, match=says):
        slideway.Ensemble(small).run(inputs=inputs)


def test_a_member_with_unusable_inputs_fails_alone() -> None:
    result = slideway.Ensemble(small).run(inputs={"joint.clearance": [1e-4, -1.0, np.nan]})
    assert [str(status) for status in slideway.statuses(result).values] == ["finished", "invalid_inputs", "invalid_inputs"]
    assert np.isfinite(result.peak_normal_force.values[0])


def test_starts_inside_the_way_are_refused_unless_they_are_taken() -> None:
    deep = {"initial.y": [1e-5, 3e-4], "joint.clearance": 1e-4}
    with pytest.raises(slideway.SceneError, match="1 of 2 members start inside the way, deeper than a tenth of the clearance: member 1 by 0.2 mm"):
        slideway.Ensemble(small).run(inputs=deep, study__duration="1 us")
    assert slideway.Ensemble(small).run(inputs=deep, any_start=True, study__duration="1 us").sizes["member"] == 2
    with pytest.raises(slideway.SceneError, match="start inside the way"):
        slideway.run(small, initial__z=3e-4, study__duration="1 us", progress=False)
    assert slideway.run(small, initial__z=3e-4, study__duration="1 us", progress=False, any_start=True).sizes["member"] == 6


def test_starts_inside_the_way_are_said_once(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SLIDEWAY_PROGRAM", raising=False)
    with pytest.raises(slideway.SceneError, match="inside the way"):
        slideway.run(small, initial__z=3e-4, study__duration="1 us", progress=False, study__levels=3)
    refused = capfd.readouterr().err
    assert refused.startswith("warning: study.levels has no effect") and "inside the way" not in refused
    slideway.run(small, initial__z=3e-4, study__duration="1 us", progress=False, any_start=True)
    assert capfd.readouterr().err.count("inside the way") == 1


def test_errors_name_keys_of_a_dictionary_and_lines_of_a_file(tmp_path: Path) -> None:
    with pytest.raises(slideway.SceneError, match=r"^study.members is 0"):
        slideway.Ensemble({**small, "study": {**small["study"], "members": 0}})
    with pytest.raises(slideway.SceneError, match="joint.clearance"):
        slideway.Ensemble(small).run(joint__clearance=-1.0)
    file = tmp_path / "s.toml"
    file.write_text("schema = 1\n[joint]\nclearance = -1\n")
    with pytest.raises(slideway.SceneError, match=r"s.toml:3: "):
        slideway.Ensemble(file)
    with pytest.raises(slideway.SceneError, match="nowhere.toml: cannot be read"):
        slideway.Ensemble(tmp_path / "nowhere.toml")
    with pytest.raises(slideway.SceneError, match="no instruction set"):
        slideway.Ensemble(small, isa="sse9").run()
    with pytest.raises(slideway.SlidewayError, match="two underscores"):
        slideway.Ensemble(small).run(clearance=1)


def test_states_are_probed_as_by_the_program(tmp_path: Path) -> None:
    ensemble = slideway.Ensemble(scenes / "ensemble_starts.toml")
    generator = np.random.default_rng(1)
    states = generator.uniform(-1, 1, (20, len(ensemble.states))) * [1e-4, 1e-4, 1, 1, 1e-3, 1e-3, 1e-3, 1, 1, 1]
    times = generator.uniform(0, 1, 20)
    table = tmp_path / "states.csv"
    rows = np.column_stack([times, states])
    np.savetxt(table, rows, delimiter=",", header=",".join(["t", *ensemble.states]), comments="", fmt="%.17g")
    call(None, ["probe", str(scenes / "ensemble_starts.toml"), "--csv", str(table), "-o", str(tmp_path / "out.csv")])
    expected = np.genfromtxt(tmp_path / "out.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    found = ensemble.probe(states, times)
    assert np.all(found["status"] == 0)
    for name, values in found.items():
        if name != "status":
            np.testing.assert_array_equal(values, expected[name], name)
    by_name = ensemble.probe(dict(zip(ensemble.states, states.T)), times)
    np.testing.assert_array_equal(by_name["fn_y_P1"], found["fn_y_P1"])


def test_statistics_in_place_of_members_come_back_too() -> None:
    scene = {**small, "study": {**small["study"], "store": "statistics"}}
    result = slideway.Ensemble(scene).run()
    assert int(result.status_count.values[0]) == 6
    assert "statistics" in slideway.groups(result)


def test_ctrl_c_ends_a_run() -> None:
    ensemble = slideway.Ensemble(small, study__members=4096, study__duration="2 s")
    start = time.monotonic()
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ensemble.run()
    timer.join()
    assert time.monotonic() - start < 10
    assert ensemble.run(study__members=2, study__duration="1 ms").sizes["member"] == 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_other_threads_go_on_meanwhile() -> None:
    ensemble = slideway.Ensemble(small, study__members=512, study__duration="100 ms", threads=1)
    results: list[xr.Dataset] = []
    thread = threading.Thread(target=lambda: results.append(ensemble.run()))
    thread.start()
    steps = 0
    while thread.is_alive():
        steps += 1
        time.sleep(0.001)
    assert steps > 10 and results[0].sizes["member"] == 512


def test_ensembles_in_several_threads_give_what_they_give_alone() -> None:
    ensembles = [slideway.Ensemble(scenes / f"{name}.toml", threads=threads, set=studies[name])
                 for threads in (1, 2) for name in ("ensemble_starts", "tolerance_table", "carriage_3")]
    alone = [ensemble.run() for ensemble in ensembles]
    found: dict[int, xr.Dataset] = {}

    def run(place: int) -> None:
        found[place] = ensembles[place // 2].run()

    # Each of them is in use twice at a time.
    threads = [threading.Thread(target=run, args=(place,)) for place in range(2 * len(ensembles))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for place in range(len(threads)):
        # But for when they ran.
        xr.testing.assert_identical(found[place].assign_attrs(created=""), alone[place // 2].assign_attrs(created=""))


@pytest.mark.slow
def test_memory_stays_flat_over_many_runs() -> None:
    ensemble = slideway.Ensemble(small)

    def used() -> int:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    for _ in range(200):
        ensemble.run()
    before = used()
    for _ in range(int(os.environ.get("SLIDEWAY_CALLS", "1000"))):
        ensemble.run()
    assert used() - before < 2000  # kB; a result has some 20


def test_arrays_outlive_their_ensemble() -> None:
    values = slideway.Ensemble(small).run().peak_normal_force.values
    again = slideway.Ensemble(small).run().peak_normal_force.values
    np.testing.assert_array_equal(values, again)


@pytest.fixture
def in_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """No program is named: runs without a file are in this process."""
    monkeypatch.delenv("SLIDEWAY_PROGRAM", raising=False)
    monkeypatch.setattr("slideway.runs.find_program", lambda program=None: pytest.fail("the program was asked for"))


def test_a_run_without_a_file_is_in_this_process(in_process: None, capfd: pytest.CaptureFixture[str]) -> None:
    result = slideway.run(small, study__members=8, contact__eta=0.02)
    assert result.sizes["member"] == 8 and slideway.groups(result) == ["verification"]
    assert Path(slideway.results.path_of(result)).exists()
    assert slideway.scene(result)["contact"]["eta"] == 0.02
    slideway.run({**small, "study": {**small["study"], "levels": 3}}, progress=False)
    assert "warning: study.levels has no effect" in capfd.readouterr().err


def test_too_many_failures_leave_the_members(in_process: None) -> None:
    failing = {**small, "integrator": {"max_steps": 3}}
    with pytest.raises(slideway.TooManyFailures, match="6 of 6 members failed, more than --max-failures 1%") as caught:
        slideway.run(failing, progress=False)
    assert caught.value.code == 3 and caught.value.dataset.sizes["member"] == 6
    assert slideway.run(failing, progress=False, max_failures=6).sizes["member"] == 6
    assert slideway.run(failing, progress=False, max_failures="100%").sizes["member"] == 6


def test_ctrl_c_keeps_the_members_that_ended(in_process: None) -> None:
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        slideway.run(small, study__members=4096, study__duration="1 s", progress=False)
    timer.join()
    cause = caught.value.__cause__
    assert isinstance(cause, slideway.StoppedEarly)
    ended = np.unique(slideway.statuses(cause.dataset).values, return_counts=True)
    assert "not_run" in ended[0] and cause.dataset.sizes["member"] == 4096


def test_what_needs_the_program_goes_to_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    asked: list[object] = []
    find = slideway.program.find_program
    monkeypatch.setattr("slideway.runs.find_program", lambda given=None: asked.append(given) or find(program))
    monkeypatch.delenv("SLIDEWAY_PROGRAM")
    slideway.run(small, tmp_path / "a.nc", progress=False)
    slideway.run(small, members=2, progress=False)
    slideway.run(small, backend="cpu", progress=False)
    monkeypatch.setattr("slideway.runs._largest_in_memory", 100)
    slideway.run(small, progress=False)
    assert len(asked) == 4


def test_numbers_of_a_result_are_read_only() -> None:
    result = slideway.Ensemble(small).run()
    with pytest.raises(ValueError, match="read-only"):
        result.peak_normal_force.values[0] = 1


def test_given_members_stay_with_other_values() -> None:
    native = slideway.Ensemble(small)._native.with_members(["joint.clearance"], np.linspace(5e-5, 1e-4, 9).reshape(9, 1))
    assert native.members == native.with_settings([("study.duration", '"1 ms"')]).members == 9


@pytest.mark.parametrize("threads", [100000])
def test_threads_beyond_the_runtime_are_refused(threads: int) -> None:
    with pytest.raises(slideway.SceneError, match="threads is 100000"):
        slideway.Ensemble(small, threads=threads).run()


def test_a_forked_process_runs_too() -> None:
    ensemble = slideway.Ensemble(small, threads=2, study__members=1024, study__duration="1 ms")  # fewer would take one thread
    before = ensemble.run()
    child = os.fork()
    if child == 0:
        same = np.array_equal(ensemble.run().peak_normal_force, before.peak_normal_force)
        os._exit(0 if same else 1)
    deadline = time.monotonic() + 30
    while (ended := os.waitpid(child, os.WNOHANG))[0] == 0 and time.monotonic() < deadline:
        time.sleep(0.05)
    if ended[0] == 0:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    assert ended[0] == child and os.waitstatus_to_exitcode(ended[1]) == 0


def test_results_are_written_by_several_threads_at_once(tmp_path: Path) -> None:
    computed = [slideway.Ensemble(small).run() for _ in range(4)]
    threads = [threading.Thread(target=slideway.results.path_of, args=(result,)) for result in computed]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({payload(slideway.results.path_of(result)) for result in computed}) == 1
