"""What a call of slideway.Ensemble costs beside the integration, and what slideway.run costs by way of the program.

Usage: python bench/python_overhead.py, with the package installed; SLIDEWAY_PROGRAM or the package's own program is the other way.
64 members of the slider-crank for 5 ms, one thread and all of them; medians. The last lines: scipy.optimize (pip install scipy) over the clearance.
Beside other work one thread is faster: a team waits for the thread that the machine runs last.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import slideway
from scipy.optimize import minimize_scalar

scene = Path(__file__).parents[1] / "scenes" / "ensemble_starts.toml"
small = {"study.members": 64, "study.duration": "5 ms", "study.samples_per_revolution": 0, "study.quantities": ["peak_normal_force"]}


def median(call: Callable[[], object], repeats: int) -> float:
    """Of the time that a call takes [ms]."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1e3 * statistics.median(times)


def main() -> None:
    for threads in (1, None):
        ensemble = slideway.Ensemble(scene, threads=threads, set=small)
        # The same call with next to no integration: what is left is overhead.
        idle = slideway.Ensemble(scene, threads=threads, set={**small, "study.duration": "1 ns"})
        name = "one thread" if threads else "all threads"
        print(f"{name}: run {median(ensemble.run, 300):.3f} ms, of which overhead {median(idle.run, 300):.3f} ms; "
              f"with an override {median(lambda: idle.run(joint__clearance=2e-4), 300):.3f} ms")
    with tempfile.TemporaryDirectory() as folder:
        calls = iter(range(1000))
        by_program = median(lambda: slideway.run(scene, Path(folder) / f"{next(calls)}.nc", set={**small, "study.verify": 0}, progress=False), 9)
    print(f"slideway.run by way of the program and a file: {by_program:.0f} ms")

    for threads in (1, None):
        ensemble = slideway.Ensemble(scene, threads=threads, set=small)

        def peak(clearance: float, ensemble: slideway.Ensemble = ensemble) -> float:
            return float(ensemble.run(joint__clearance=clearance).peak_normal_force.quantile(0.9))

        start = time.perf_counter()
        found = minimize_scalar(peak, bounds=(5e-5, 5e-4), method="bounded", options={"maxiter": 12})
        taken = time.perf_counter() - start
        print(f"minimize_scalar, {'one thread' if threads else 'all threads'}: {found.nfev} calls, {1e3 * taken:.0f} ms; "
              f"at {by_program:.0f} ms a call {found.nfev * by_program / 1e3 / taken:.0f} times as long")


if __name__ == "__main__":
    sys.exit(main())
