"""The four-bar of bench/linkage_peers.py by MuJoCo: a journal is a tendon between two sites that is no longer than the clearance.

Such a limit is a unilateral constraint on |e|, without friction: the same as a rigid journal's, but for being a spring and a damper that are made to return e.
"""

from __future__ import annotations

import math
import time
from typing import Any

import mujoco
import numpy as np
from rigid_mechanism import damping_ratio

version: str = mujoco.__version__
# Step, and steps that an impact takes.
settings = [(1e-4, 5), (1e-5, 5), (1e-5, 10), (1e-6, 10), (1e-6, 20)]


def _model(step: float, impact_steps: int, restitution: float) -> Any:
    ratio = damping_ratio(restitution)
    timeconst = impact_steps * step / math.pi * math.sqrt(1 - ratio**2) / ratio
    hinge, slides = '<joint type="hinge" axis="0 0 1"/>', '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>'

    def inertial(x: float, inertia: float) -> str:
        return f'<inertial pos="{x} 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>'

    free = "".join(f'<body>{slides}{hinge}{inertial(0, inertia)}<site name="{name}0" pos="{-half} 0 0"/><site name="{name}1" pos="{half} 0 0"/></body>'
                   for name, half, inertia in (("coupler", 2, 16 / 12), ("rocker", 1.25, 6.25 / 12)))
    pins = "".join(f'<spatial><site site="{first}"/><site site="{second}"/></spatial>'
                   for first, second in (("crank", "coupler0"), ("coupler1", "rocker1"), ("rocker0", "post")))
    return mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="{step!r}" gravity="0 -9.81 0" integrator="Euler"/>
<default><tendon limited="true" range="0 0.005" solreflimit="{timeconst!r} {ratio!r}" solimplimit="0.9999 0.9999 0.001 0.5 2"/></default>
<worldbody><site name="post" pos="3 0 0"/><body>{hinge}{inertial(0.5, 1 / 12)}<site name="crank" pos="1 0 0"/></body>{free}</worldbody>
<tendon>{pins}</tendon></mujoco>""")


def run(setting: tuple[float, int], places: list[float], rates: list[float], restitution: float, end: float, samples: int) -> tuple[np.ndarray, float]:
    """Coordinates at the samples, and seconds of processor time of a member."""
    step, impact_steps = setting
    made = _model(step, impact_steps, restitution)
    state, states = mujoco.MjData(made), np.empty((samples, 7))
    state.qpos[:], state.qvel[:] = places, rates
    steps = round(end / samples / step)
    began = time.process_time()
    for i in range(samples):
        mujoco.mj_step(made, state, nstep=steps)
        states[i] = state.qpos
    return states, time.process_time() - began
