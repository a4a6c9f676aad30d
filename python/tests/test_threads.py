"""Threads, forked processes and notebooks: each test calls from a process of its own, whose end tells a crash from an error."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import slow
import slideway

CALLS = int(os.environ.get("SLIDEWAY_THREAD_CALLS", "16"))

SCENE: dict[str, Any] = {
    "schema": 1, "contact": {"law": "paper"}, "study": {"kind": "ensemble", "members": 3, "duration": "0.2 ms", "samples": 9, "quantities": ["peak_tilt", "y"],
                           "vary": {"initial.y": {"dist": "unif", "low": 0, "high": 1e-5}}}}  # fmt: skip

# What all of them do: open and run, and look at the numbers.
CALL = """
import multiprocessing, os, sys, threading, time
from concurrent.futures import ThreadPoolExecutor
import numpy as np
import slideway

path, number, calls = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
scene = SCENE
expected = slideway.open(path).y.values

def opens(call):
    with slideway.open(path) as result:
        assert np.array_equal(result.y.values, expected)
        return slideway.groups(result) == ["verification"] and slideway.results.holds_all(result)

def runs(call):
    result = slideway.run(scene, progress=False)
    assert np.array_equal(result.y.values, expected)
    return call % 8 or slideway.groups(result) == ["verification"]  # which writes its file
""".replace("SCENE", repr(SCENE))
WITHIN_LIMITS = ""
BEYOND_LIMITS = "slideway.netcdf.largest_at_once = slideway.netcdf._small_column = 0\n"  # all numbers are read when they are used


@pytest.fixture(scope="module")
def stored(program: str, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The result of the scene."""
    path = tmp_path_factory.mktemp("threads") / "stored.nc"
    slideway.run(SCENE, path, progress=False).close()
    return str(path)


def survive(script: str, path: str, number: int, calls: int = CALLS, seconds: float = 60) -> None:
    """Runs a script in a process of its own, and fails if that crashes, hangs or raises."""
    environment = {name: value for name, value in os.environ.items() if name != "SLIDEWAY_PROGRAM"}  # or runs would be the program's
    command = [sys.executable, "-X", "faulthandler", "-c", CALL + script, path, str(number), str(calls)]
    # In the folder of the result: that of the tests holds the sources of the package, without its module.
    done = subprocess.run(command, env=environment, cwd=Path(path).parent, capture_output=True, text=True, check=False, timeout=seconds)
    assert done.returncode == 0, (done.returncode, done.stderr[-3000:])


IN_THREADS = """
with ThreadPoolExecutor(number) as pool:
    assert all(pool.map(lambda call: opens(call) and runs(call), range(calls)))
"""


@pytest.mark.parametrize(("threads", "limits"), [(8, WITHIN_LIMITS), *slow((8, BEYOND_LIMITS))], ids=["eight", "lazily"])
def test_results_are_opened_and_scenes_run_in_threads(stored: str, threads: int, limits: str) -> None:
    survive(limits + IN_THREADS, stored, threads)


@pytest.mark.slow
@pytest.mark.parametrize("threads", range(1, 9))
def test_a_thousand_calls_in_threads(stored: str, threads: int) -> None:
    survive(IN_THREADS, stored, threads, 1000, 300)


def test_one_result_is_read_by_several_threads(stored: str) -> None:
    survive(BEYOND_LIMITS + """
result = slideway.open(path)
with ThreadPoolExecutor(number) as pool:
    assert all(pool.map(lambda call: np.array_equal(result.y[call % 3].values, expected[call % 3]), range(calls)))
""", stored, 8)  # fmt: skip


FORKED = """
def two_threads():
    return int(slideway.Ensemble(scene, threads=2, study__members=1024).run().sizes["member"])

def in_child(call):
    return opens(call) and runs(call) and two_threads()

two_threads()  # OpenMP has them now, which no child has; fewer members would take one
"""


@pytest.mark.slow
def test_pools_of_forked_processes_open_and_run_after_their_parent_has(stored: str) -> None:
    survive(FORKED + """
with multiprocessing.get_context("fork").Pool(number) as pool:
    assert pool.map(in_child, range(calls)) == [1024] * calls
""", stored, 2, 20)  # fmt: skip


@pytest.mark.slow
def test_processes_are_forked_while_threads_read_and_run(stored: str) -> None:
    survive(BEYOND_LIMITS + FORKED + """
ended = threading.Event()
def works():
    while not ended.is_set():
        assert opens(0) and runs(0) and two_threads()
threads = [threading.Thread(target=works) for _ in range(number)]
for thread in threads:
    thread.start()
for call in range(calls):
    child = os.fork()
    if child == 0:
        os._exit(0 if in_child(call) == 1024 else 1)
    assert os.waitpid(child, 0)[1] == 0
ended.set()
""", stored, 2, 12)  # fmt: skip


def test_a_process_that_is_forked_while_another_thread_has_xarrays_lock_opens_results(stored: str) -> None:
    survive("""
from xarray.backends.netCDF4_ import NETCDF4_PYTHON_LOCK
inside = threading.Event()
def reads():
    with NETCDF4_PYTHON_LOCK:  # as xarray does while it reads another file
        inside.set()
        time.sleep(0.5)
reader = threading.Thread(target=reads)
reader.start()
inside.wait()
child = os.fork()
if child == 0:
    os._exit(0 if opens(0) else 1)
assert os.waitpid(child, 0)[1] == 0
reader.join()
with slideway.netcdf.exclusive():  # a handler of a signal may fork there
    child = os.fork()
    if child == 0:
        with slideway.netcdf.exclusive():
            os._exit(0)
assert os.waitpid(child, 0)[1] == 0 and opens(0)
""", stored, 1, 1, seconds=20)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("way", ["fork", "spawn", "forkserver"])
def test_a_thousand_calls_in_processes(stored: str, way: str, tmp_path: Path) -> None:
    script = tmp_path / "script.py"  # children that do not fork import it
    script.write_text(CALL + FORKED.replace("\ntwo_threads()  #", "\nif __name__ == '__main__': two_threads()  #") + f"""
if __name__ == "__main__":
    with multiprocessing.get_context("{way}").Pool(number) as pool:
        assert pool.map(in_child, range(calls)) == [1024] * calls
""", encoding="utf-8")  # fmt: skip
    environment = {name: value for name, value in os.environ.items() if name != "SLIDEWAY_PROGRAM"}
    subprocess.run([sys.executable, str(script), stored, "4", "1000"], env=environment, check=True, timeout=300)


@pytest.mark.slow
@pytest.mark.parametrize("calls", [40, 1000])
def test_a_notebook_opens_and_runs_in_its_loop_and_in_threads(stored: str, calls: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    monkeypatch.delenv("SLIDEWAY_PROGRAM")
    cells = [
        f"import asyncio, sys\nsys.argv = ['', {stored!r}, '4', '{calls}']\n" + CALL,
        "all(opens(call) and runs(call) for call in range(calls // 4))",
        "all(await asyncio.gather(*(asyncio.to_thread(runs if call % 2 else opens, call) for call in range(calls))))",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert [cell.outputs[0].data["text/plain"] for cell in notebook.cells[1:]] == ["True", "True"]
