"""MuJoCo beside slideway's rigid contacts: the planar slider-crank of scenes/planar_rigid.toml, flat and without friction.

Usage: rigid_peers.py [-o TABLE.md]; needs mujoco from PyPI and the slideway package.  One core; both in one run, medians of processor time.
The reference is slideway at rtol 1e-12, which is within 2e-9 clearances of an 80-bit program that goes from event to event (docs/rigid.md).
MuJoCo has no restitution: its contacts are springs and dampers in the acceleration of the constraint, made here to return e = 0.4
and as stiff as ten steps an impact resolve.  Errors are of the slider's height, in clearances, over 50 ms.
"""

from __future__ import annotations

import argparse
import math
import pathlib
import time

import mujoco
import numpy as np
import slideway

scene = pathlib.Path(__file__).resolve().parents[1] / "scenes/planar_rigid.toml"
crank, rod, half_length, half_height, clearance, restitution = 0.153, 0.306, 0.05, 0.025, 1e-3, 0.4
samples, end, rounds, members = 50, 0.05, 5, 512


def damping_ratio(e: float) -> float:
    """Of a spring and damper that only push, so that they let go before the spring is relaxed; by halving.

    >>> round(damping_ratio(1.0), 6)
    0.0
    """

    def rebound(ratio: float) -> float:
        root = math.sqrt(1 - ratio**2)
        return math.exp(-ratio / root * (math.pi - math.atan2(2 * ratio * root, 1 - 2 * ratio**2)))

    low, high = 0.0, 0.999
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if rebound(middle) > e else (low, middle)
    return (low + high) / 2


def model(step: float) -> mujoco.MjModel:
    """The mechanism for MuJoCo: angles of its joints are relative."""
    ratio = damping_ratio(restitution)
    duration = 10 * step  # of an impact: nearly half a period of a spring of 1/(timeconst ratio)
    timeconst = duration / math.pi * math.sqrt(1 - ratio**2) / ratio

    def link(name: str, at: str, mass: float, inertia: float, centre: str) -> str:
        return (f'<body name="{name}" pos="{at}"><joint type="hinge" axis="0 0 1"/>'
                f'<inertial pos="{centre}" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>')

    wall = half_height + clearance
    return mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="{step!r}" gravity="0 -9.81 0" integrator="Euler"/>
<default><geom condim="1" solref="{timeconst!r} {ratio!r}" solimp="0.9999 0.9999 0.001 0.5 2"/></default>
<worldbody><geom type="plane" size="1 1 1" pos="0 {-wall} 0" zaxis="0 1 0"/><geom type="plane" size="1 1 1" pos="0 {wall} 0" zaxis="0 -1 0"/>
{link("crank", "0 0 0", 0.038, 7.4e-5, f"{crank / 2} 0 0")}{link("rod", f"{crank} 0 0", 0.038, 5.9e-4, f"{rod / 2} 0 0")}
{link("block", f"{rod} 0 0", 0.076, 2.7e-6, "0 0 0")}<geom type="box" size="{half_length} {half_height} 0.001"/></body></body></body></worldbody></mujoco>""")


def by_mujoco(step: float) -> tuple[np.ndarray, float]:
    """Heights at the samples, and seconds of processor time of a member."""
    made = model(step)
    state = mujoco.MjData(made)
    steps = round(end / samples / step)
    taken = []
    heights = np.empty(samples)
    for _ in range(rounds if step > 2e-6 else 1):
        mujoco.mj_resetData(made, state)
        state.qvel[:] = 150, -225, 75
        began = time.process_time()
        for i in range(samples):
            mujoco.mj_step(made, state, nstep=steps)
            heights[i] = crank * math.sin(state.qpos[0]) + rod * math.sin(state.qpos[0] + state.qpos[1])
        taken.append(time.process_time() - began)
    return heights, float(np.median(taken))


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
    """Both, as a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the table, in Markdown")
    options = parser.parse_args()
    reference, _ = by_slideway(1e-12, 1)
    rows = ["| program | step or rtol | mean error, clearances | largest | members a second and core |", "|---|---|---|---|---|"]

    def add(who: str, setting: float, heights: np.ndarray, seconds: float) -> None:
        errors = np.abs(heights - reference) / clearance
        rows.append(f"| {who} | {setting:.0e} | {errors.mean():.1e} | {errors.max():.1e} | {1 / seconds:,.1f} |")
        print(rows[-1], flush=True)

    for step in (1e-4, 1e-5, 1e-6, 2e-7):
        add(f"MuJoCo {mujoco.__version__}", step, *by_mujoco(step))
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        add("slideway", tolerance, by_slideway(tolerance, 1)[0], by_slideway(tolerance, members)[1])
    if options.output:
        options.output.write_text("\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
