"""Several threads run scenes, write and open results in one process: for scripts/sanitize.sh, under the thread sanitizer."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import slideway

scene: dict[str, Any] = {
    "schema": 1, "study": {"kind": "ensemble", "members": 64, "duration": "0.2 ms", "samples": 9, "quantities": ["peak_tilt", "y"],
                           "vary": {"initial.y": {"dist": "unif", "low": 0, "high": 1e-5}}}}  # fmt: skip


def main(threads: int, calls: int) -> None:
    """Half of the calls share an ensemble; each result is written, opened and read again."""
    shared = slideway.Ensemble(scene, threads=2, verify=True)
    expected = shared.run().y.values

    def call(number: int) -> bool:
        result = shared.run() if number % 2 else slideway.run(scene, progress=False)
        path = slideway.results.path_of(result)
        with slideway.open(path, check=False) as stored:
            return np.array_equal(stored.y.values, expected) and np.array_equal(result.y.values, expected) and Path(path).exists()

    with ThreadPoolExecutor(threads) as pool:
        assert all(pool.map(call, range(calls)))
    print(f"{calls} calls in {threads} threads")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 4, int(sys.argv[2]) if len(sys.argv) > 2 else 24)
