"""MuJoCo, Drake and Siconos beside slideway's rigid contacts: the planar slider-crank of scenes/planar_rigid.toml, flat and without friction.

Usage: rigid_peers.py [-o TABLE.csv]; needs drake and mujoco from PyPI and the slideway package, and python3-siconos of Debian, without which its
rows are left out.  One core; all in one run, medians of processor time.
The reference is slideway at rtol 1e-12, which is within 2e-9 clearances of an 80-bit program that goes from event to event (docs/how_to/rigid.md).
MuJoCo and Drake have no coefficient of restitution: their contacts are springs and dampers, made here to return e = 0.4 and as stiff as some
steps an impact resolve.  Both have spheres at the block's corners, because each of their boxes touches a plane in its own way; Drake's pressure fields
have the box.  Errors are of the slider's height, in clearances, over 50 ms.
"""

from __future__ import annotations

import argparse
import csv
import importlib.util
import pathlib
import time

import numpy as np
import rigid_drake
import rigid_mujoco
import slideway
from rigid_mechanism import clearance, end, samples

scene = pathlib.Path(__file__).resolve().parents[1] / "scenes/planar_rigid.toml"
rounds, members = 5, 512


def by_slideway(tolerance: float, count: int) -> tuple[np.ndarray, float]:
    """Heights of the first member at the samples, and seconds of processor time of a member among so many, whose starts differ a little."""
    changes = {"friction.enabled": False, "initial.wz": 0, "integrator.rtol": tolerance, "integrator.atol": tolerance, "study.members": count,
               "study.duration": end, "study.samples": samples + 1, "study.quantities": ["y"], "study.verify": 0}
    if count > 1:
        changes |= {'study.vary."initial.y"': {"dist": "unif", "low": "-0.1 mm", "high": "0.1 mm"}, "study.samples": 0, "study.quantities": ["damping_loss"]}
    ensemble = slideway.Ensemble(scene, threads=1, set=changes)
    taken = []
    for _ in range(rounds):
        began = time.process_time()
        result = ensemble.run()
        taken.append(time.process_time() - began)
    heights = result.y.values.reshape(-1)[1:] if count == 1 else np.empty(0)
    return heights, float(np.median(taken)) / count


def main() -> None:
    """All, as a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the table, as CSV")
    options = parser.parse_args()
    reference, _ = by_slideway(1e-12, 1)
    rows = [["program", "contacts", "step_accuracy_or_rtol", "mean_error_clearances", "largest_error_clearances", "members_per_s_and_core"]]

    def add(who: str, contacts: str, setting: float, heights: np.ndarray, seconds: float) -> None:
        errors = np.abs(heights - reference) / clearance
        rows.append([who, contacts, f"{setting:.0e}", f"{errors.mean():.1e}", f"{errors.max():.1e}", f"{1 / seconds:.1f}"])
        print(*rows[-1], sep="; ", flush=True)

    for step, impact_steps in rigid_mujoco.settings:
        contacts = f"springs, {impact_steps} steps an impact"
        add(f"MuJoCo {rigid_mujoco.version}", contacts, step, *rigid_mujoco.run(step, impact_steps, rounds if step > 2e-6 else 1))
    for setting in rigid_drake.settings:
        repeats = 1 if 0 < setting.step < 2e-6 else 3
        add(f"Drake {rigid_drake.version}", setting.name, setting.step or setting.accuracy, *rigid_drake.run(setting, repeats))
    if importlib.util.find_spec("siconos") is not None:
        import rigid_siconos

        for step in rigid_siconos.settings:
            add(f"Siconos {rigid_siconos.version}", "rigid, Moreau and Jean", step, *rigid_siconos.run(step, rounds if step > 2e-6 else 1))
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        add("slideway", "rigid", tolerance, by_slideway(tolerance, 1)[0], by_slideway(tolerance, members)[1])
    if options.output:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
