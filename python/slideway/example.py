"""A made-up result, small and quick, for examples and tests."""

from __future__ import annotations

import numpy as np
import xarray as xr

_scene = """\
schema = 1
title = "Made-up example"

[mechanism]
kind = "slider_crank"
crank_length = 0.05  # m
rod_length = 0.1422  # m
crank_speed = 3.141592653589793  # rad/s
start_angle = 0.0  # rad
gravity = 9.81  # m/s2
# slider_mass = 0.1872  # kg, derived: density x slider_length x way_width x way_depth

[joint]
clearance_y = 0.0001  # m
clearance_z = 0.0001  # m

[contact]
law = "paper"

[study]
kind = "sweep"
members = 2
parameter = "joint.clearance"
"""


def example() -> xr.Dataset:
    """A Dataset like those of :func:`slideway.open`, made up of sines and random numbers: no mechanism was integrated.

    Twelve members over two turns of the crank, of which the last failed half way; with series, forces by contact, quantities,
    sections, exponents, and the clearance as the parameter of a sweep. Numbers are the same in every call.

    >>> slideway.example().sizes["sample"]
    1601
    """
    random = np.random.default_rng(1)
    members, samples, turns = 12, 1601, 40
    time = np.linspace(0.0, 4.0, samples)
    speed = np.pi
    phase, tone = random.uniform(0, 2 * np.pi, (2, members, 1))
    clearance = np.repeat([1e-4, 2e-4, 3e-4], 4)
    frequency = 3 + 0.2 * np.arange(members)[:, None]
    y = clearance[:, None] * np.sin(2 * np.pi * frequency * time + phase)
    vy = np.gradient(y, time, axis=1)
    z = 0.8 * clearance[:, None] * np.cos(2 * np.pi * 1.3 * frequency * time + tone)
    push = np.clip(np.abs(y) / clearance[:, None] - 0.8, 0, None) * random.lognormal(6, 0.5, y.shape)
    kind = random.integers(0, 3, y.shape)
    x = 0.05 * np.cos(speed * time) + np.sqrt(0.1422**2 - (0.05 * np.sin(speed * time)) ** 2) + 0.01 * y
    series = {
        "x": (x, "m", "position of the slider's centre along the slide way"),
        "y": (y, "m", "vertical position of the slider's centre"),
        "z": (z, "m", "lateral position of the slider's centre"),
        "vy": (vy, "m s-1", "vertical velocity of the slider's centre"),
        "acceleration_top": (np.gradient(vy, time, axis=1), "m s-2", "acceleration of the top channel"),
        "normal_force": (push, "N", "sum of the normal forces"),
        "points": ((push > 0) & (kind == 0), "1", "point contacts"),
        "lines": ((push > 0) & (kind == 1), "1", "line contacts"),
        "surfaces": ((push > 0) & (kind == 2), "1", "surface contacts"),
    }
    dataset = xr.Dataset(coords={"member": np.arange(members, dtype=np.int32), "time": ("sample", time, {"units": "s"})})
    dataset = dataset.set_xindex("time")
    for name, (values, units, words) in series.items():
        values = values.astype(float)
        values[-1, samples // 2 :] = np.nan  # what a member that failed has not reached
        dataset[name] = (("member", "sample"), values, {"units": units, "long_name": words})

    words = "not_run finished step_too_small max_steps nonfinite geometry contact_domain invalid_inputs unstable"
    dataset["status"] = (
        "member",
        np.array([0] * (members - 1) + [2], dtype=np.int8),
        {"long_name": "how the member ended", "flag_values": np.arange(-1, 8, dtype=np.int8), "flag_meanings": words},
    )
    dataset["joint_clearance"] = ("member", clearance, {"units": "m", "long_name": "clearance per side"})
    exponent = random.normal(600, 40, (members, 1))
    spread = random.normal(0, 1, (members, 40, 1)) / np.arange(1, 41)[:, None]
    per_member: dict[str, tuple[np.ndarray, str, str]] = {
        "peak_normal_force": (random.lognormal(6.5, 0.4, members), "N", "largest sum of the normal forces"),
        "lyapunov_exponent": (exponent, "s-1", "finite-time Lyapunov exponents, the largest first"),
        "lyapunov_exponent_half_width": (np.full((members, 1), 30.0), "s-1", "half the width of the exponent's 95 % interval"),
        "lyapunov_exponent_late": (exponent.copy(), "s-1", "exponent of the second half of the record alone"),
        "lyapunov_time": (np.full(members, 4.0), "s", "time over which the exponents are taken"),
        "rescalings": (np.full(members, 4000.0), "1", "times that offsets were rescaled"),
        "lyapunov_history": (exponent[:, None] + 300 * spread, "s-1", "running exponents after so many rescalings"),
    }
    for name, (values, units, words) in per_member.items():
        values[-1] = np.nan
        dims = ("member", *("history", "exponent")[3 - values.ndim :])
        dataset[name] = (dims, values, {"units": units, "long_name": words})
    dataset = dataset.assign_coords(exponent=[1.0], history=np.arange(1, 41) * 100.0)

    owners = np.repeat(dataset["member"].values, turns)
    dataset = dataset.assign_coords(section_member=("section", owners))
    angle = random.uniform(0, 2 * np.pi, owners.size)
    reach = np.sqrt(random.uniform(0, 1, owners.size)) * clearance[owners]
    for name, values, units in (("y", reach * np.sin(angle), "m"), ("z", reach * np.cos(angle), "m"),
                                ("vy", 50 * reach * np.cos(2 * angle), "m s-1"), ("time", np.tile(np.arange(turns) * 2.0, members), "s")):
        dataset[f"section_{name}"] = ("section", values, {"units": units, "long_name": f"{name} at the section"})
    dataset.attrs = {"source": "slideway", "title": "Made-up example", "scene": _scene, "sweep_parameter": "joint_clearance"}
    return dataset
