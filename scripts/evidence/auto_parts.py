"""What `auto` takes beside its parts at the same residual of the energy: mechanism x law x pitch of the way x damping x friction x tolerance.

Every method of a cell runs the same starts at rtol 1e-3 to 1e-9, on one thread. A part's cost at the residual that `auto` has comes from the line
between its two neighbouring tolerances, both in logarithms; where the part does not get there it counts as infinite. The published law is left out: the
energy that its switches make is no error of a method.

    python -m evidence.auto_parts PROGRAM FOLDER [--members 16] [--only WORDS] [--limit 60]
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import resource
import subprocess
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import netCDF4
import numpy as np

TOLERANCES = tuple(10.0**-k for k in range(3, 10))
MECHANISMS = {"slider_crank": "ensemble_starts.toml", "scotch_yoke": "scotch_yoke.toml", "carriage": "carriage_1.toml"}
LAWS = {"conservative": ("chi_line", "chi_surface"), "foundation": ("chi_surface",), "kelvin_voigt": ()}
STARTS = {"initial.y": 3e-5, "initial.z": 3e-5, "initial.roll": 5e-4, "initial.yaw": 5e-4, "initial.pitch": 5e-4}
PARTS = ("dopri5", "bs32", "ros34pw2")
SCENES = Path(__file__).resolve().parents[2] / "scenes"


class Cell(NamedTuple):
    """A scene of the grid."""

    mechanism: str
    law: str
    pitch: float
    chi: float
    friction: bool

    def __str__(self) -> str:
        return f"{self.mechanism}, {self.law}, pitch {self.pitch:g} mrad, chi {self.chi:g}, {'friction' if self.friction else 'none'}"

    def settings(self, members: int) -> list[str]:
        """What its runs have in common, for `--set`."""
        vary = ", ".join(f'"{key}" = {{dist = "unif", low = {-half}, high = {half}}}' for key, half in STARTS.items())
        return [
            f"contact.law={self.law}", f"study.members={members}", "study.duration=0.05", "study.samples=0", f"study.vary={{{vary}}}", "study.verify=0",
            'study.quantities=["energy_residual"]', f"friction.enabled={str(self.friction).lower()}", f"way.pitch={self.pitch * 1e-3}",
            *(f"contact.{key}={self.chi:g}" for key in LAWS[self.law] if self.chi > 0),
        ]  # fmt: skip


class Cost(NamedTuple):
    """What a method takes at a tolerance: processor time [s], right-hand sides with Jacobians, root mean square of the residual [J]."""

    rtol: float
    seconds: float
    evaluations: float
    residual: float


def grid() -> list[Cell]:
    """All cells; of the law without χ, one."""
    axes = itertools.product(MECHANISMS, LAWS, (0.0, 0.06), (0.0, 10.0), (True, False))
    return [cell for cell in map(Cell._make, axes) if LAWS[cell.law] or cell.chi == 0]


class Bench:
    """Runs of one program."""

    def __init__(self, program: str, folder: Path, members: int, limit: int) -> None:
        self.program, self.folder, self.members, self.limit = program, folder, members, limit

    def cost(self, cell: Cell, method: str, rtol: float) -> Cost | None:
        """Of one run; None where it takes longer than the limit, or no member finishes."""
        output = self.folder / f"{'_'.join(map(str, cell))}_{method}.nc"
        command = [self.program, "run", str(SCENES / MECHANISMS[cell.mechanism]), "--quiet", "--force", "--threads", "1", "-o", str(output)]
        for setting in [*cell.settings(self.members), f"integrator.method={method}", f"integrator.rtol={rtol}"]:
            command += ["--set", setting]
        with subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (self.limit, self.limit))
        ) as run:
            _, status, used = os.wait4(run.pid, 0)
            run.returncode = os.waitstatus_to_exitcode(status)
        if run.returncode != 0:
            return None
        with netCDF4.Dataset(output) as result:
            residual = np.sqrt(np.mean(np.square(result["energy_residual"][:])))
            evaluations = np.sum(result["rhs_evaluations"][:]) + np.sum(result["jacobian_evaluations"][:])
        output.unlink()
        return Cost(rtol, used.ru_utime, float(evaluations), float(residual))

    def row(self, cell: Cell) -> dict[str, object]:
        """A cell: what each method takes, and `auto` over the best of its parts."""
        costs = {method: [cost for rtol in TOLERANCES if (cost := self.cost(cell, method, rtol))] for method in ("auto", *PARTS)}
        ratios = []
        for cost in costs["auto"]:
            best = {of: min(at_residual(costs[part], cost.residual, of) for part in PARTS) for of in ("seconds", "evaluations")}
            ratios.append({"rtol": cost.rtol, "residual": cost.residual, **{of: getattr(cost, of) / best[of] for of in best}})
        print(f"{cell}: " + "  ".join(f"{r['rtol']:.0e} {r['seconds']:.2f} ({r['evaluations']:.2f}) {r['residual']:.1e}" for r in ratios), flush=True)
        return {"cell": cell._asdict(), "ratios": ratios, "costs": {method: [cost._asdict() for cost in all_of] for method, all_of in costs.items()}}


def at_residual(costs: list[Cost], residual: float, of: str) -> float:
    """The least that a method takes to have a residual."""
    least = min((getattr(cost, of) for cost in costs if cost.residual <= residual), default=np.inf)
    for one, other in itertools.pairwise(costs):
        low, high = sorted((one, other), key=lambda cost: cost.residual)
        if low.residual < residual < high.residual:
            share = np.log(residual / low.residual) / np.log(high.residual / low.residual)
            least = min(least, float(np.exp((1 - share) * np.log(getattr(low, of)) + share * np.log(getattr(high, of)))))
    return least


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m evidence.auto_parts", description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--members", type=int, default=16)
    parser.add_argument("--limit", type=int, default=60, help="processor seconds of a run")
    parser.add_argument("--only", default="", help="cells whose name has these words")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(options.program, options.folder, options.members, options.limit)
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        rows = list(pool.map(bench.row, (cell for cell in grid() if options.only in str(cell))))
    (options.folder / "auto_parts.json").write_text(json.dumps(rows, indent=1), encoding="utf-8")
    over = [r["seconds"] for row in rows for r in row["ratios"]]
    print(f"{len(over)} cells with tolerance: median {np.median(over):.2f}, 90 % {np.quantile(over, 0.9):.2f}, largest {max(over):.2f}, "
          f"above 1.1: {sum(ratio > 1.1 for ratio in over)}")  # fmt: skip
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
