"""Temporary files: gone as soon as nothing uses them, and nothing is left open."""

from __future__ import annotations

import copy
import gc
import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import slideway
import xarray as xr
from conftest import Result

scene = {"schema": 1, "study": {"kind": "tolerance", "members": 8, "duration": "1 ms", "quantities": ["peak_tilt"],
                                "vary": {"initial.y": {"dist": "unif", "low": 0, "high": "0.02 mm"}}}}  # fmt: skip


@pytest.fixture
def left(program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], list[str]]]:
    """What is left in a folder for temporary files of the test's own."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    gc.collect()

    def names() -> list[str]:
        return sorted(os.listdir(tmp_path))

    yield names


def run() -> xr.Dataset:
    return slideway.run(scene, progress=False)


def test_result_lies_in_one_folder_until_it_is_let_go(left: Callable[[], list[str]]) -> None:
    result = run()
    assert len(left()) == 1  # the scene's own is gone
    del result
    assert left() == []


def test_result_is_gone_when_it_is_closed(left: Callable[[], list[str]]) -> None:
    with run() as result:
        assert os.path.exists(result.slideway.path)
    assert left() == []


def test_what_is_selected_keeps_the_file(left: Callable[[], list[str]]) -> None:
    whole = run()
    kept = [whole.sel(member=0), whole.isel(member=[1, 2]), whole.peak_tilt, whole.copy(deep=True), copy.deepcopy(whole), whole.slideway.statistics]
    del whole
    while kept:
        assert len(left()) == 1
        kept.pop().load()
    assert left() == []


def test_groups_are_read_from_what_is_kept(left: Callable[[], list[str]]) -> None:
    assert "peak_tilt_mean" in run().slideway.statistics.load()
    assert left() == []


def test_copy_in_another_process_owns_nothing(left: Callable[[], list[str]]) -> None:
    result = run()
    path = pickle.loads(pickle.dumps(result.encoding["source"]))
    assert path == result.slideway.path
    assert type(path) is str
    child = os.fork()
    if child == 0:
        result.close()
        os._exit(0)
    os.waitpid(child, 0)
    assert len(left()) == 1
    assert result.peak_tilt.values.shape == (8, 3)


def test_statistics_of_a_series_leave_nothing(left: Callable[[], list[str]], result_of: Result) -> None:
    slideway.stats(result_of("ensemble"), "y", 3)
    assert left() == []


def test_runs_that_fail_leave_nothing(left: Callable[[], list[str]]) -> None:
    for changes in ({"study.members": -1}, {"integrator.max_steps": 2}):
        with pytest.raises(slideway.RunError):
            slideway.run(scene, progress=False, set=changes)
    gc.collect()
    assert left() == []


def test_results_of_errors_live_as_long_as_they(left: Callable[[], list[str]]) -> None:
    try:
        slideway.run(scene, progress=False, integrator__max_steps=2)
    except slideway.TooManyFailures as error:
        result = error.dataset
    gc.collect()
    assert set(slideway.statuses(result).values) == {"max_steps"}
    del result
    gc.collect()
    assert left() == []


@pytest.mark.slow
def test_nothing_is_left_open(program: str, tmp_path: Path) -> None:
    script = f"""
import slideway
result = slideway.run({scene!r})
slideway.stats(slideway.run({scene!r}, study__kind="ensemble", study__samples=2001, study__duration="20 ms"), "y")
slideway.report.write(result, r"{tmp_path}/p.html")
slideway.plot.quantiles(result)
"""
    flags = ["-W", "always::ResourceWarning", "-X", "dev"]
    environment = {**os.environ, "MPLBACKEND": "Agg", "TMPDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, *flags, "-c", script], capture_output=True, text=True, check=True, env=environment)
    assert "ResourceWarning" not in done.stderr
    assert os.listdir(tmp_path) == ["p.html"]
