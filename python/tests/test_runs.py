"""Runs of the program: how it is found, told what to do, watched and stopped."""

from __future__ import annotations

import os
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
from conftest import Result, scenes
from slideway.__main__ import main

short: dict[str, Any] = {
    "schema": 1,
    "title": 'a "short" run',
    "contact": {"law": "paper"},
    "study": {"kind": "ensemble", "members": 3, "duration": "1 ms", "quantities": ["peak_tilt"],
              "vary": {"initial.y": {"dist": "unif", "low": -1e-5, "high": "0.02 mm"}}},
}


@pytest.fixture(autouse=True)
def _program(program: str) -> None:
    """Every test here has one."""


def stub(folder: Path, script: str) -> Path:
    """A program that does what a shell script says."""
    path = folder / "slideway"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def test_dictionary_runs_as_a_scene() -> None:
    result = slideway.run(short, progress=False)
    assert result.sizes["member"] == 3
    assert result.attrs["title"] == 'a "short" run'
    assert float(result.initial_y.max()) <= 2e-5


def test_path_runs_to_the_named_output(tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    result = slideway.run(scenes / "ensemble_starts.toml", output, progress=False, study__members=2, study__duration="1 ms")
    assert output.exists()
    assert result.slideway.path == str(output)


def test_overrides_take_the_place_of_keys() -> None:
    result = slideway.run(short, progress=False, study__members=5, set={"joint.clearance": "0.2 mm", "contact.law": "conservative"})
    scene = slideway.scene(result)
    assert result.sizes["member"] == 5
    assert scene["joint"]["clearance_z"] == pytest.approx(2e-4)
    assert scene["contact"]["law"] == "conservative"


def test_tables_and_lists_can_be_overrides() -> None:
    vary = {"initial.z": {"dist": "values", "values": [0.0, 1e-5]}}
    result = slideway.run(short, progress=False, set={"study.vary": vary, "study.quantities": ["mode_time", "peak_tilt"]})
    assert set(result.initial_z.values) <= {0.0, 1e-5}
    assert "mode_time" in result


def test_resolved_scene_runs_again_to_the_same_bits() -> None:
    first = slideway.run(short, progress=False)
    again = slideway.run(slideway.scene(first), progress=False)
    assert again.attrs["payload_hash"] == first.attrs["payload_hash"]


def test_threads_and_instruction_set_are_passed_on() -> None:
    result = slideway.run(short, progress=False, threads=1, isa="scalar", backend="cpu")
    assert (int(result.attrs["threads"]), result.attrs["isa"], result.attrs["backend"]) == (1, "scalar", "cpu")


def test_members_run_alone_with_their_inputs() -> None:
    everyone = slideway.run(short, progress=False)
    one = slideway.run(short, progress=False, members=1)
    two = slideway.run(short, progress=False, members=(1, 2))
    assert one.initial_y.values == everyone.initial_y.sel(member=[1]).values
    np.testing.assert_array_equal(two.member.values, [1, 2])


def test_second_run_to_the_same_file_is_refused_and_what_is_opened_if_forced(tmp_path: Path) -> None:
    first = slideway.run(short, tmp_path / "a.nc", progress=False)
    assert first.sizes["member"] == 3
    with pytest.raises(slideway.FileError, match="is there already") as refused:
        slideway.run(short, tmp_path / "a.nc", progress=False, study__members=2)
    assert "\n" not in str(refused.value)
    assert slideway.run(short, tmp_path / "a.nc", progress=False, force=True, study__members=2).sizes["member"] == 2
    (tmp_path / "notes.nc").write_text("of a year")
    with pytest.raises(slideway.FileError, match="is no file of slideway"):
        slideway.run(short, tmp_path / "notes.nc", progress=False, force=True)
    assert (tmp_path / "notes.nc").read_text() == "of a year"


def test_page_goes_through_links_and_into_no_device(result_of: Result, tmp_path: Path) -> None:
    result, page, link = result_of("ensemble"), tmp_path / "page.html", tmp_path / "link.html"
    link.symlink_to(page)
    assert slideway.report.write(result, link) == link
    assert link.is_symlink() and page.read_text(encoding="utf-8").startswith("<!doctype html>")
    os.mkfifo(tmp_path / "pipe")
    for special in (tmp_path / "pipe", tmp_path):
        with pytest.raises(slideway.SlidewayError, match="is a folder, a device or a pipe"):
            slideway.report.write(result, special)
    assert (tmp_path / "pipe").is_fifo()


def test_page_replaces_pages_alone(tmp_path: Path) -> None:
    result = slideway.run(short, tmp_path / "a.nc", progress=False)
    page, notes = tmp_path / "a.html", tmp_path / "notes.html"
    slideway.report.write(result, page)
    slideway.report.write(result, page)
    notes.write_text("<p>of a year")
    with pytest.raises(slideway.SlidewayError, match="is no page of slideway"):
        slideway.report.write(result, notes)
    assert notes.read_text() == "<p>of a year"
    command = ["report", str(tmp_path / "a.nc"), "-o", str(page)]
    assert subprocess.run([sys.executable, "-m", "slideway", *command], check=False, capture_output=True).returncode == 4
    assert main([*command, "--force"]) == 0


def test_table_of_a_dictionary_lies_in_the_working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "table.csv").write_text("initial.z [mm]\n0.01\n0.02\n")
    monkeypatch.chdir(tmp_path)
    study = {"kind": "ensemble", "design": "table", "table": "table.csv", "duration": "1 ms"}
    result = slideway.run({"schema": 1, "study": study}, progress=False)
    np.testing.assert_allclose(result.initial_z.values, [1e-5, 2e-5])


def test_labels_of_a_table_are_a_coordinate(tmp_path: Path) -> None:
    (tmp_path / "parts.csv").write_text("part;initial.z [mm]\nA-001;0,01\nB-2;0,02\n")
    study = {"kind": "ensemble", "design": "table", "table": str(tmp_path / "parts.csv"), "duration": "1 ms"}
    in_memory = slideway.run({"schema": 1, "study": study}, progress=False)
    in_a_file = slideway.run({"schema": 1, "study": study}, tmp_path / "a.nc", progress=False)
    for result in (in_memory, in_a_file):
        assert result.coords["member_label"].values.tolist() == ["A-001", "B-2"]
        np.testing.assert_allclose(result.initial_z.values, [1e-5, 2e-5])


def test_progress_is_passed_on(capfd: pytest.CaptureFixture[str]) -> None:
    slideway.run(short)
    assert "backend cpu" in capfd.readouterr().err
    slideway.run(short, progress=False)
    assert capfd.readouterr().err == ""


def test_warnings_are_passed_on_without_progress(capfd: pytest.CaptureFixture[str]) -> None:
    slideway.run(short, progress=False, study__levels=3)
    assert capfd.readouterr().err.startswith("warning: study.levels has no effect")


def test_progress_goes_where_python_says_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lines: list[str] = []

    class Cell:
        def write(self, text: str) -> None:
            lines.append(text)

        def flush(self) -> None: ...

    monkeypatch.setattr(sys, "stderr", Cell())
    slideway.run(short)
    assert any("backend cpu" in line for line in lines)


def test_bad_scene_is_said_in_the_programs_words() -> None:
    with pytest.raises(slideway.SceneError, match="did you mean joint.clearance") as caught:
        slideway.run(short, progress=False, set={"joint.clerance": 1})
    assert caught.value.code == 2
    assert "\n" not in str(caught.value)


def test_override_without_a_dot_is_no_argument() -> None:
    with pytest.raises(slideway.SlidewayError, match="no argument thread;"):
        slideway.run(short, thread=2)


def test_output_that_cannot_be_written_is_a_file_error(tmp_path: Path) -> None:
    with pytest.raises(slideway.FileError) as caught:
        slideway.run(short, tmp_path / "nowhere" / "deep" / "a.nc", progress=False)
    assert caught.value.code == 4


def test_too_many_failures_keep_the_result() -> None:
    with pytest.raises(slideway.TooManyFailures, match="of 3 members failed") as caught:
        slideway.run(short, progress=False, study__duration="20 ms", integrator__max_steps=20)
    assert caught.value.code == 3
    assert set(slideway.statuses(caught.value.dataset).values) == {"max_steps"}


def test_failures_that_are_allowed_are_no_error() -> None:
    result = slideway.run(short, progress=False, study__duration="20 ms", integrator__max_steps=20, max_failures="100%")
    assert not slideway.finished(result).any()


def test_time_limit_keeps_what_is_finished_and_resumes(tmp_path: Path) -> None:
    many = {"study.members": 800, "study.duration": "60 ms"}
    scene, output = scenes / "ensemble_starts.toml", tmp_path / "a.nc"
    with pytest.raises(slideway.StoppedEarly, match="stopped early") as caught:
        slideway.run(scene, output, progress=False, set=many, max_hours=0.2 / 3600, threads=1)
    part = caught.value.dataset
    assert caught.value.code == 5
    assert 0 < int(slideway.finished(part).sum()) < 800
    whole = slideway.run(scene, output, progress=False, set=many, resume=True)
    assert bool(slideway.finished(whole).all())
    ran = slideway.finished(part)
    np.testing.assert_array_equal(part.final_y[ran].values, whole.final_y.sel(member=part.member[ran]).values)


def test_interrupt_stops_the_program_and_keeps_what_is_finished(tmp_path: Path) -> None:
    script = f"""
import slideway
try:
    slideway.run(r"{scenes}/ensemble_starts.toml", r"{tmp_path}/a.nc", study__members=20000, threads=1)
except KeyboardInterrupt as stop:
    print(type(stop.__cause__).__name__, stop.__cause__.code, int(slideway.finished(stop.__cause__.dataset).sum()) > 0)
"""
    python = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              start_new_session=True)
    assert python.stderr is not None and python.stdout is not None
    for line in python.stderr:  # it says that it has begun
        if line.startswith("memory"):
            break
    wait_until(lambda: has_finished_some(tmp_path / "a.nc.shards"), "no member has finished")
    began = time.monotonic()
    os.killpg(python.pid, signal.SIGINT)  # as a terminal does: to the whole group
    out, _ = python.communicate(timeout=30)
    assert out.split() == ["StoppedEarly", "5", "True"]
    assert time.monotonic() - began < 20


def state_of(process: int) -> str:
    """A letter of proc(5), Z of one that ended and that nobody asked for yet; empty of one that is gone."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return ""


def wait_until(holds: Callable[[], bool], what: str, seconds: float = 30.0) -> None:
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, what
        time.sleep(0.02)


def has_finished_some(shards: Path) -> bool:
    """Whether a run has listed members in its folder of shards."""
    return any(manifest.stat().st_size > 0 for manifest in shards.glob("manifest-*"))


on_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the program ends with Python on Linux alone")


def forked(call: Callable[[], object], handler: bool) -> int:
    """A process of this Python with a session and no stderr of its own, which has the package loaded already; with a handler SIGTERM raises."""
    child = os.fork()
    if child != 0:
        return child
    try:
        os.setsid()
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # which nohup has ignored
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        signal.signal(signal.SIGTERM, (lambda *_: sys.exit(1)) if handler else signal.SIG_DFL)
        call()
    finally:
        os._exit(1)


@on_linux
@pytest.mark.parametrize("handler", [False, True], ids=["no handler", "handler"])
@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGHUP, signal.SIGKILL], ids=["TERM", "HUP", "KILL"])
def test_program_is_asked_to_end_when_python_does(tmp_path: Path, ending: signal.Signals, handler: bool) -> None:
    # It also speaks on a stderr that nobody reads any more, before it writes what it has.
    program = stub(tmp_path, f"""trap 'echo stopping >&2; echo kept >{tmp_path}/kept; exit 5' TERM
echo $$ >{tmp_path}/new; mv {tmp_path}/new {tmp_path}/process
while :; do sleep 0.05; done""")
    python = forked(lambda: slideway.run(tmp_path / "scene.toml", program=program), handler)
    wait_until((tmp_path / "process").exists, "the program did not begin")
    child = int((tmp_path / "process").read_text())
    os.killpg(python, ending)
    os.waitpid(python, 0)
    try:
        wait_until(lambda: state_of(child) in ("", "Z"), "the program went on without Python", seconds=10)
    finally:
        if state_of(child) not in ("", "Z"):
            os.kill(child, signal.SIGKILL)
    assert (tmp_path / "kept").read_text() == "kept\n"


@on_linux
def test_program_keeps_what_is_finished_when_python_is_killed(tmp_path: Path) -> None:
    script = f"""
import slideway
slideway.run(r"{scenes}/ensemble_starts.toml", r"{tmp_path}/a.nc", study__members=20000, threads=1)
"""
    python = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE, text=True, start_new_session=True)
    assert python.stderr is not None
    for line in python.stderr:  # it says that it has begun
        if line.startswith("memory"):
            break
    child = int(Path(f"/proc/{python.pid}/task/{python.pid}/children").read_text().split()[0])
    wait_until(lambda: has_finished_some(tmp_path / "a.nc.shards"), "no member has finished")
    assert state_of(child) not in ("", "Z")
    python.kill()
    python.communicate(timeout=30)
    wait_until(lambda: state_of(child) in ("", "Z"), "the program went on without Python")
    slideway.program.call(None, ["merge", f"{tmp_path}/a.nc.shards", "-o", f"{tmp_path}/merged.nc"], good=(0, 5))
    with slideway.open(tmp_path / "merged.nc") as merged:
        assert 0 < int(slideway.finished(merged).sum()) < 20000


def test_end_by_a_signal_is_named(tmp_path: Path) -> None:
    with pytest.raises(slideway.RunError, match="SIGKILL") as caught:
        slideway.run(short, program=stub(tmp_path, "kill -9 $$"), progress=False)
    assert caught.value.code == -9


def test_unknown_exit_code_carries_the_last_line(tmp_path: Path) -> None:
    with pytest.raises(slideway.RunError, match="^the last$") as caught:
        slideway.run(short, program=stub(tmp_path, "echo first >&2; echo the last >&2; exit 9"), progress=False)
    assert (caught.value.code, caught.value.line) == (9, "the last")


def test_program_is_looked_for_in_this_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folders = [tmp_path / name for name in ("argument", "environment", "path")]
    for folder in folders:
        folder.mkdir()
    argument, environment, path = (stub(folder, "exit 0") for folder in folders)
    find = slideway.program.find_program
    monkeypatch.setattr("slideway.program._packaged", lambda: None)
    monkeypatch.setenv("PATH", str(path.parent))
    monkeypatch.delenv("SLIDEWAY_PROGRAM")
    assert find() == str(path)
    monkeypatch.setenv("SLIDEWAY_PROGRAM", str(environment))
    assert find() == str(environment)
    assert find(argument) == str(argument)


def test_program_that_is_nowhere_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("slideway.program._packaged", lambda: None)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("SLIDEWAY_PROGRAM")
    with pytest.raises(slideway.SlidewayError, match="was not found; install the package .* SLIDEWAY_PROGRAM"):
        slideway.run(short, tmp_path / "a.nc")


def test_temporary_results_are_gone_with_python() -> None:
    script = f"import slideway; print(slideway.run({short!r}, progress=False).slideway.path)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert not os.path.exists(done.stdout.strip())


def test_statistics_of_a_series_are_those_that_the_program_prints(result_of: Result, program: str) -> None:
    path = result_of("ensemble").slideway.path
    printed = subprocess.run([program, "stats", path, "--variable", "y", "--member", "7"], capture_output=True, text=True, check=True).stdout
    found = slideway.stats(path, "y", 7)
    assert found.text["0-1 test"] in printed
    assert found.text["average period"] in printed
    assert found.time.size == found.mean_log_distance.size > 0


def test_exponent_of_the_logistic_map_is_ln_2(tmp_path: Path) -> None:
    x = [0.3]
    for _ in range(4000):
        x.append(4 * x[-1] * (1 - x[-1]))
    (tmp_path / "x.csv").write_text("x\n" + "\n".join(map(repr, x)))
    found = slideway.stats(tmp_path / "x.csv", dt=1.0, delay=1, dimension=2, theiler=1, fit="0..5")
    assert found.exponent == pytest.approx(np.log(2), rel=0.1)
    assert found.fit == (0, 5)


def test_statistics_of_a_table_are_of_the_column_that_is_named(tmp_path: Path) -> None:
    time = 0.01 * np.arange(2000)
    table = tmp_path / "two.csv"
    np.savetxt(table, np.c_[time, np.sin(time), np.sin(3 * time)], delimiter=",", header="t,x,y", comments="")
    periods = [slideway.stats(table, *column).text["average period"][:4] for column in (["x"], ["y"], [])]
    assert periods == ["6.28", "2.09", "2.09"]


def test_information_is_what_the_program_prints(result_of: Result, program: str) -> None:
    result = result_of("ensemble")
    assert "64" in slideway.info(result)
    assert slideway.info(result.slideway.path) == slideway.info(result)
