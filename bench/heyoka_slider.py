"""heyoka beside slideway on a free slider: in flight, and bouncing between the faces of its way on linear springs.

Usage: heyoka_slider.py [-o TABLE.csv]; needs heyoka and numpy from PyPI and the slideway package.  One core, medians of processor time, both in
one run.  Flight: attitude and translation of a tumbling slider, whose equations are written here again from docs/explanation/model.md; errors are
against heyoka at 1e-18 in 80 bits, so that they compare the two programs too.  Bouncing: no spin, no friction, no damping, so that the motion is a row of
parabolas and sines, which is the reference; heyoka's touches are terminal events whose callback, in Python, turns the spring on and off.
(Springs with a kink, by `relu`, need no events, but Taylor steps go over them unseen: errors of 50 clearances at any tolerance.)
"""

from __future__ import annotations

import argparse
import csv
import io
import math
import pathlib
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import heyoka as hy
import numpy as np
import slideway

lanes = hy.recommended_simd_size()  # of this processor
rounds = 7
members = 512
flight_end, bounce_end = 0.02, 0.05  # s
clearance, bounce_clearance, stiffness = 0.1, 1e-4, 5e6  # m, m, N/m of an apex
tolerances = (1e-5, 1e-7, 1e-9, 1e-11, 1e-13)


@dataclass
class Row:
    """One program at one tolerance: median and p95 of the error over the members, microseconds a member."""

    who: str
    tolerance: float
    error: float
    worst: float
    microseconds: float


def best_of(work: Callable[[], object]) -> float:
    """Median seconds of processor time."""
    taken = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return float(np.median(taken))


@dataclass
class Start:
    """What differs between members."""

    spin: np.ndarray  # [members, 3] rad/s
    speed: np.ndarray  # [members, 2] m/s, vy and vz


def starts() -> Start:
    draw = np.random.default_rng(5)
    return Start(draw.uniform(-40, 40, (members, 3)), draw.uniform(-0.2, 0.2, (members, 2)))


def ours(scene: dict[str, Any], inputs: dict[str, np.ndarray], method: str, tolerance: float) -> tuple[float, Any]:
    """Microseconds a member, and the result."""
    scene = {**scene, "integrator": {"method": method, "rtol": tolerance, "atol": tolerance, "max_step": scene["study"]["duration"]}}
    ensemble = slideway.Ensemble(scene, threads=1)
    seconds = best_of(lambda: ensemble.run(inputs=inputs))
    return 1e6 * seconds / members, ensemble.run(inputs=inputs)


def median_rows(who: str, tolerance: float, microseconds: float, error: np.ndarray) -> Row:
    return Row(who, tolerance, float(np.median(error)), float(np.quantile(error, 0.95)), microseconds)


# Flight ------------------------------------------------------------------------------------------------------------------------------


def flight_scene() -> dict[str, Any]:
    return {
        "schema": 1, "mechanism": {"kind": "free_slider"}, "joint": {"clearance": clearance}, "contact": {"law": "conservative"}, "friction": {"enabled": False},
        "study": {"kind": "ensemble", "members": members, "duration": flight_end, "quantities": ["contact_onsets"], "verify": 0},
    }  # fmt: skip


def flight_system(inertia: list[float]) -> list[Any]:
    """y, z and their rates, Cardan angles of A = Rz(psi) Ry(theta) Rx(phi), spin in the slider's axes: Euler's equations without torque."""
    names = ("y", "z", "vy", "vz", "phi", "theta", "psi", "wx", "wy", "wz")
    y, z, vy, vz, phi, theta, psi, wx, wy, wz = hy.make_vars(*names)
    about = hy.sin(phi) * wy + hy.cos(phi) * wz
    rates = (vy, vz, hy.expression(-9.81), hy.expression(0.0), wx + hy.tan(theta) * about, hy.cos(phi) * wy - hy.sin(phi) * wz, about / hy.cos(theta),
             (inertia[1] - inertia[2]) / inertia[0] * wy * wz, (inertia[2] - inertia[0]) / inertia[1] * wz * wx,
             (inertia[0] - inertia[1]) / inertia[2] * wx * wy)  # fmt: skip
    return list(zip((y, z, vy, vz, phi, theta, psi, wx, wy, wz), rates, strict=True))


def flight(start: Start) -> list[Row]:
    inputs = {f"initial.{name}": column for name, column in zip(("vy", "vz", "wx", "wy", "wz"), (*start.speed.T, *start.spin.T), strict=True)}
    found = slideway.Ensemble(flight_scene(), threads=1).run(inputs={key: column[:1] for key, column in inputs.items()})
    known = slideway.scene(found, derived=True)["mechanism"]
    inertia = [float(known[f"slider_inertia_{axis}"]) for axis in "xyz"]
    first = np.zeros((members, 10))
    first[:, 2:4], first[:, 7:] = start.speed, start.spin
    long = np.longdouble
    one = hy.taylor_adaptive(flight_system(inertia), [long(0)] * 10, tol=long(1e-18), fp_type=long)
    reference = np.empty((members, 10))
    for member in range(members):
        one.time, one.state[:] = long(0), first[member].astype(long)
        one.propagate_until(long(flight_end))
        reference[member] = one.state.astype(float)
    scale = np.abs(reference).max(axis=0)

    def error(ends: np.ndarray) -> np.ndarray:
        return np.asarray(np.sqrt((((ends - reference) / scale) ** 2).mean(axis=1)))

    rows = []
    for tolerance in tolerances:
        batch = hy.taylor_adaptive_batch(flight_system(inertia), np.zeros((10, lanes)), tol=tolerance)
        ends = np.empty((members, 10))

        def work(batch: hy.taylor_adaptive_batch = batch, ends: np.ndarray = ends) -> None:
            for at in range(0, members, lanes):
                batch.set_time(0.0)
                batch.state[:] = first[at : at + lanes].T
                batch.propagate_until(flight_end)
                ends[at : at + lanes] = batch.state.T

        rows.append(median_rows(f"heyoka, batch of {lanes}", tolerance, 1e6 * best_of(work) / members, error(ends)))
    for method in ("dop853", "dopri5"):
        for tolerance in tolerances:
            microseconds, result = ours(flight_scene(), inputs, method, tolerance)
            assert not result.contact_onsets.values.any()
            names = ("y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz")
            rows.append(median_rows(f"slideway {method}", tolerance, microseconds, error(np.stack([result[f"final_{name}"].values for name in names], -1))))
    return rows


# Bouncing ----------------------------------------------------------------------------------------------------------------------------


def bounce_scene() -> dict[str, Any]:
    return {
        "schema": 1, "mechanism": {"kind": "free_slider"}, "joint": {"clearance": bounce_clearance},
        "contact": {"law": "kelvin_voigt", "apex_stiffness": stiffness}, "friction": {"enabled": False},
        "study": {"kind": "ensemble", "members": members, "duration": bounce_end, "quantities": ["contact_onsets"], "verify": 0},
    }  # fmt: skip


def bounced(v: float, rate: float) -> tuple[float, float, int]:
    """Height, speed and touches at the end in closed form; rate: of the springs of a face [rad/s]."""
    y, left, touches = 0.0, bounce_end, 0
    while True:
        # Flight: the first time at which y = ±c.
        times = []
        for side in (-bounce_clearance, bounce_clearance):
            root = v * v + 2 * 9.81 * (y - side)
            if root >= 0:
                times += [t for t in ((v - math.sqrt(root)) / 9.81, (v + math.sqrt(root)) / 9.81) if t > 1e-9]
        t = min(times)
        if t >= left:
            return y + v * left - 9.81 / 2 * left * left, v - 9.81 * left, touches
        y, v, left, touches = y + v * t - 9.81 / 2 * t * t, v - 9.81 * t, left - t, touches + 1
        side = math.copysign(bounce_clearance, y)
        # Contact: about its centre y = side − g/rate², from the touch until y = side again.
        rest = 9.81 / rate**2
        turn = 2 * math.atan2(v / rate, rest) % (2 * math.pi)
        t = turn / rate
        if t >= left:
            phase = rate * left
            return side - rest + rest * math.cos(phase) + v / rate * math.sin(phase), v * math.cos(phase) - rest * rate * math.sin(phase), touches
        y, v, left = side, v * math.cos(turn) - rest * rate * math.sin(turn), left - t


def heyoka_bounces(tolerance: float, speeds: np.ndarray, rate: float) -> tuple[float, np.ndarray]:
    """Microseconds a member, and heights at the end."""
    y, v = hy.make_vars("y", "v")
    # par[0]: the face that is touched, -1, 0 or 1.
    system = [(y, v), (v, -9.81 - rate**2 * (hy.par[0] * hy.par[0] * y - hy.par[0] * bounce_clearance))]

    def turn(side: float) -> Any:
        def callback(batch: hy.taylor_adaptive_batch, sign: int, lane: int) -> bool:
            batch.pars[0, lane] = side if sign * side > 0 else 0.0
            return True

        return callback

    events = [hy.t_event_batch(y - side * bounce_clearance, callback=turn(side)) for side in (-1.0, 1.0)]
    batch = hy.taylor_adaptive_batch(system, np.zeros((2, lanes)), pars=np.zeros((1, lanes)), tol=tolerance, t_events=events)
    ends = np.empty(members)

    def work() -> None:
        for at in range(0, members, lanes):
            batch.reset_cooldowns()
            batch.pars[:] = 0.0
            batch.set_time(0.0)
            batch.state[0], batch.state[1] = 0.0, speeds[at : at + lanes]
            batch.propagate_until(bounce_end)
            ends[at : at + lanes] = batch.state[0]

    return 1e6 * best_of(work) / members, ends.copy()


def bouncing(start: Start) -> tuple[list[Row], float]:
    """Errors are of the height at the end, in clearances."""
    speeds = np.abs(start.speed[:, 0]) + 0.05
    found = slideway.Ensemble(bounce_scene(), threads=1).run(inputs={"initial.vy": speeds[:1]})
    rate = math.sqrt(4 * stiffness / float(slideway.scene(found, derived=True)["mechanism"]["slider_mass"]))
    closed = [bounced(float(speed), rate) for speed in speeds]
    reference = np.array([end[0] for end in closed])

    def error(ends: np.ndarray) -> np.ndarray:
        return np.asarray(np.abs(ends - reference) / bounce_clearance)

    rows = []
    for tolerance in tolerances:
        microseconds, ends = heyoka_bounces(tolerance, speeds, rate)
        rows.append(median_rows("heyoka, events with callbacks in Python", tolerance, microseconds, error(ends)))
    for method in ("verner65", "dopri5"):
        for tolerance in tolerances:
            microseconds, result = ours(bounce_scene(), {"initial.vy": speeds}, method, tolerance)
            rows.append(median_rows(f"slideway {method}", tolerance, microseconds, error(result.final_y.values)))
    return rows, float(np.mean([end[2] for end in closed]))


def table(problem: str, rows: list[Row]) -> list[list[str]]:
    return [[problem, row.who, f"{row.tolerance:.0e}", f"{row.error:.1e}", f"{row.worst:.1e}", f"{row.microseconds:.2f}"] for row in rows]


def main() -> None:
    parser = argparse.ArgumentParser(description="heyoka beside slideway on a free slider, one core")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    start = starts()
    lines = [["problem", "method", "tolerance", "median_error", "p95_error", "us_per_member"]]
    lines += table(f"Tumbling in flight, {1e3 * flight_end:.0f} ms: states", flight(start))
    rows, touches = bouncing(start)
    lines += table(f"Bouncing on linear springs, {1e3 * bounce_end:.0f} ms, {touches:.1f} touches a member: height, in clearances", rows)
    made = io.StringIO()
    csv.writer(made, lineterminator="\n").writerows(lines)
    text = f"# heyoka {hy.__version__} beside slideway {slideway.__version__} on a free slider, {members} members, one core\n" + made.getvalue()
    if arguments.output:
        arguments.output.write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
