"""A study of one's own, spread over the processes of this machine by joblib or dask.distributed: the same numbers, and the same payload hash.

    python spread_study.py serial|joblib|dask [PROCESSES]

It is done in both ways that there are. Inputs that Python draws go to an `Ensemble` in each process, and the numbers come back: for
optimisers and samplers. A study whose members are rows of a table is run in parts, which are merged into one result file: for what is to be
kept. dask.distributed is shown on this machine; with the address of a scheduler, and a folder that all machines share, it is the same.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import slideway

SCENE: dict[str, Any] = {
    "schema": 1,
    "contact": {"law": "conservative"},
    "friction": {},
    "study": {"kind": "ensemble", "members": 2, "duration": "1 ms", "quantities": ["peak_normal_force"],
              "vary": {"joint.clearance": {"dist": "unif", "low": "0.05 mm", "high": "0.15 mm"},
                       "initial.y": {"dist": "unif", "low": "0 mm", "high": "0.02 mm"}}},
}  # fmt: skip
ROWS = 48

Map = Callable[[Callable[..., Any], Sequence[tuple[Any, ...]]], list[Any]]


def forces(ensemble: slideway.Ensemble, rows: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Peak forces [N] of the members with these inputs."""
    return ensemble.run(inputs=rows).peak_normal_force.values


def study(spread: Map, parts: int, folder: str) -> tuple[np.ndarray[Any, Any], str]:
    """Peak forces of rows of inputs, and the payload hash of the study of the same rows as a result file."""
    ensemble = slideway.Ensemble(SCENE, threads=1)
    rows = np.random.default_rng(1).uniform([0.5e-4, 0.0], [1.5e-4, 2e-5], (ROWS, 2))
    found = np.concatenate(spread(forces, [(ensemble, part) for part in np.array_split(rows, parts)]))

    table, output = Path(folder) / "rows.csv", str(Path(folder) / "study.nc")
    np.savetxt(table, rows, delimiter=",", header=",".join(ensemble.inputs), comments="", fmt="%.17g")
    scene = {**SCENE, "study": {"kind": "tolerance", "design": "table", "table": str(table), "duration": "1 ms",
                                "quantities": ["peak_normal_force"]}}  # fmt: skip
    spread(slideway.run_part, [(scene, output, part, parts) for part in range(1, parts + 1)])
    with slideway.merge(output) as result:
        assert np.array_equal(result.peak_normal_force, found)
        return found, str(result.attrs["payload_hash"])


def serial(function: Callable[..., Any], calls: Sequence[tuple[Any, ...]]) -> list[Any]:
    return [function(*arguments) for arguments in calls]


def by_joblib(processes: int) -> Map:
    from joblib import Parallel, delayed

    return lambda function, calls: Parallel(n_jobs=processes)(delayed(function)(*arguments) for arguments in calls)


def by_dask(client: Any) -> Map:
    return lambda function, calls: client.gather([client.submit(function, *arguments, pure=False) for arguments in calls])


def main(way: str, processes: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        if way == "dask":
            from dask.distributed import Client, LocalCluster

            with LocalCluster(n_workers=processes, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
                found, payload_hash = study(by_dask(client), processes, folder)
        else:
            found, payload_hash = study(by_joblib(processes) if way == "joblib" else serial, processes if way == "joblib" else 1, folder)
    print(f"{len(found)} members, 95 % of the peak forces below {np.quantile(found, 0.95):.6g} N, payload hash {payload_hash}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "joblib", int(sys.argv[2]) if len(sys.argv) > 2 else 2)
