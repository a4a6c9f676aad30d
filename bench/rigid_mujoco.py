"""The flat slider-crank of bench/rigid_peers.py by MuJoCo: spheres at the block's corners between two planes."""

from __future__ import annotations

import math
import time
from typing import Any

import mujoco
import numpy as np
from rigid_mechanism import corner_radius, corners, damping_ratio, end, height, links, restitution, samples, start_speeds, wall

version: str = mujoco.__version__
# Step, and steps an impact takes: as many as gave the smallest errors, and twice or half as many.
settings = [(1e-4, 5), (1e-4, 10), (1e-5, 5), (1e-5, 10), (1e-5, 20), (1e-6, 20), (1e-6, 40), (1e-6, 80)]


def model(step: float, impact_steps: int) -> Any:
    """The mechanism; angles of its joints are relative."""
    ratio = damping_ratio(restitution)
    duration = impact_steps * step  # of an impact: nearly half a period of a spring of 1/(timeconst ratio)
    timeconst = duration / math.pi * math.sqrt(1 - ratio**2) / ratio
    bodies = "".join(f'<body name="{link.name}" pos="{link.at} 0 0"><joint type="hinge" axis="0 0 1"/><inertial pos="{link.centre} 0 0" mass="{link.mass}" '
                     f'diaginertia="{link.inertia} {link.inertia} {link.inertia}"/>' for link in links)
    spheres = "".join(f'<geom type="sphere" size="{corner_radius}" pos="{x} {y} 0"/>' for x, y in corners)
    return mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="{step!r}" gravity="0 -9.81 0" integrator="Euler"/>
<default><geom condim="1" solref="{timeconst!r} {ratio!r}" solimp="0.9999 0.9999 0.001 0.5 2"/></default>
<worldbody><geom type="plane" size="1 1 1" pos="0 {-wall} 0" zaxis="0 1 0"/><geom type="plane" size="1 1 1" pos="0 {wall} 0" zaxis="0 -1 0"/>
{bodies}{spheres}{"</body>" * len(links)}</worldbody></mujoco>""")


def run(step: float, impact_steps: int, rounds: int) -> tuple[np.ndarray, float]:
    """Heights at the samples, and seconds of processor time of a member."""
    made = model(step, impact_steps)
    state = mujoco.MjData(made)
    steps = round(end / samples / step)
    taken = []
    heights = np.empty(samples)
    for _ in range(rounds):
        mujoco.mj_resetData(made, state)
        state.qvel[:] = start_speeds
        began = time.process_time()
        for i in range(samples):
            mujoco.mj_step(made, state, nstep=steps)
            heights[i] = height(state.qpos[0], state.qpos[1])
        taken.append(time.process_time() - began)
    return heights, float(np.median(taken))
