"""Siconos and MuJoCo beside slideway's linkages: scenes/four_bar_loose.toml, whose three pins are loose, without friction, e = 0.9.

Usage: linkage_peers.py [-o TABLE.csv]; needs mujoco from PyPI and the slideway package, and python3-siconos of Debian; scripts/linkage_peers.sh installs
what is not there.  One core, processor time.
What all three approach is the motion with rigid journals, which tests/golden/journals.py goes through from impact to impact: Siconos by time stepping or from
event to event, MuJoCo and slideway by contacts that are stiff.  Errors are of the three journals' places in their bearings, the largest component, in
clearances, over the first 40 ms (19 impacts); later each error grows until orbits have nothing in common.  A second row of slideway tells what its
integration alone errs by: its distance from itself at rtol 1e-12.
"""

from __future__ import annotations

import argparse
import csv
import importlib.util
import pathlib
import statistics
import sys
import time

import linkage_mujoco
import numpy as np
import slideway

root = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(root / "tests/golden"))
import journals  # noqa: E402

clearance, end, samples, rounds, members = 5e-3, 0.04, 20, 3, 256
pins = "crank_pin", "coupler_pin", "post"


def offsets(states: np.ndarray) -> np.ndarray:
    """Of the journals in their bearings, from crank angle and x, y, angle of the others."""

    def bar(length: float, angle: np.ndarray) -> np.ndarray:
        return length * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    crank, coupler, rocker = bar(1, states[:, 0]), bar(2, states[:, 3]), bar(1.25, states[:, 6])
    second, third = states[:, 1:3], states[:, 4:6]
    return np.concatenate([crank - second + coupler, second + coupler - third - rocker, third - rocker - [3, 0]], axis=1)


def by_slideway(tolerance: float, stiffness: float, count: int) -> tuple[np.ndarray, float]:
    """Offsets of the first member at the samples, and seconds of processor time of a member among so many, whose starts differ a little."""
    changes = {"integrator.rtol": tolerance, "integrator.atol": tolerance, "study.members": count, "study.duration": end, "study.samples": samples + 1,
               "study.verify": 0, "study.quantities": [f"{pin}_{axis}" for pin in pins for axis in "xy"]}
    changes |= {f"link.{pin}.stiffness": stiffness for pin in pins}
    if count > 1:
        changes |= {'study.vary."mechanism.crank_speed"': {"dist": "unif", "low": "14.13 rad/s", "high": "14.15 rad/s"}, "study.samples": 0, "study.quantities": ["damping_loss"]}
    ensemble = slideway.Ensemble(root / "scenes/four_bar_loose.toml", threads=1, set=changes)
    taken = []
    for _ in range(rounds if count > 1 else 1):
        began = time.process_time()
        result = ensemble.run()
        taken.append(time.process_time() - began)
    if count > 1:
        return np.empty(0), statistics.median(taken) / count
    return np.stack([result[f"{pin}_{axis}"].values.reshape(-1)[1:] for pin in pins for axis in "xy"], axis=1), 0.0


def main() -> None:
    """All, as a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the table, as CSV")
    options = parser.parse_args()
    made = journals.Linkage(journals.CASES["four_bar"], 0.0)
    start = [x[0][2:] + x[1] + x[2] for x in (made.place, made.rate)]
    exact = []
    for k in range(1, samples + 1):
        for _ in made.run_to(end * k / samples):
            pass
        exact.append(made.place[0][2:] + made.place[1] + made.place[2])
    reference = offsets(np.array(exact))
    rows = [["program", "journals", "step_or_rtol", "mean_error_clearances", "largest_error_clearances", "members_per_s_and_core", "core_s_per_simulated_s"]]

    def add(who: str, what: str, setting: float, errors: np.ndarray, seconds: float) -> None:
        worst = np.abs(errors).max(axis=1) / clearance
        rows.append([who, what, f"{setting:.0e}", f"{worst.mean():.1e}", f"{worst.max():.1e}", f"{1 / seconds:.4g}" if seconds else "", f"{seconds / end:.2g}" if seconds else ""])
        print(*rows[-1], sep="; ", flush=True)

    for setting in linkage_mujoco.settings:
        runs = [linkage_mujoco.run(setting, *start, journals.RESTITUTION, end, samples) for _ in range(rounds if setting[0] > 2e-6 else 1)]
        add(f"MuJoCo {linkage_mujoco.version}", f"tendon limits, {setting[1]} steps an impact", setting[0], offsets(runs[0][0]) - reference, statistics.median(s for _, s in runs))
    if importlib.util.find_spec("siconos") is not None:
        import linkage_siconos

        for step in linkage_siconos.settings:
            runs = [linkage_siconos.run(step, *start, journals.RESTITUTION, end, samples) for _ in range(rounds if step > 2e-6 else 1)]
            add(f"Siconos {linkage_siconos.version}", "rigid, Moreau and Jean", step, offsets(runs[0][0]) - reference, statistics.median(s for _, s in runs))
        for tolerance in linkage_siconos.tolerances:
            runs = [linkage_siconos.run_events(tolerance, *start, journals.RESTITUTION, end, samples) for _ in range(rounds)]
            add(f"Siconos {linkage_siconos.version}", "rigid, from event to event", tolerance, offsets(runs[0][0]) - reference, statistics.median(s for _, s in runs))
    for stiffness, tolerance in ((1e10, 1e-4), (1e11, 1e-4), (1e12, 1e-5), (1e13, 1e-6), (1e14, 1e-6), (1e16, 1e-7)):
        places, tight = by_slideway(tolerance, stiffness, 1)[0], by_slideway(1e-12, stiffness, 1)[0]
        add("slideway", f"Hertz, {stiffness:.0e} N/m^1.5", tolerance, places - reference, by_slideway(tolerance, stiffness, members)[1])
        add("slideway", "the same from itself at rtol 1e-12", tolerance, places - tight, 0)
    if options.output:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
