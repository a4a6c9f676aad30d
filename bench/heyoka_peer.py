"""heyoka (Taylor series compiled by LLVM, batches of 8) beside slideway's dop853, both on one core in one run.

Usage: heyoka_peer.py WORK_PRECISION [-o TABLE.md], with the program bench/work_precision of a release build; needs heyoka and numpy from
PyPI.  Lorenz: the members, times and error measure of `work_precision --problem lorenz`, whose columns of ours are read from its table.
Relief valve: events a second while 16 valves bounce, terminal events with callbacks in Python, heyoka's only way in batches.
"""

from __future__ import annotations

import argparse
import csv
import pathlib
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass

import heyoka as hy
import numpy as np

lanes = 8
rounds = 7
recorded_events = 2048 + 64  # of a valve in work_precision: its transient's and those that are compared


@dataclass
class Row:
    """One program at one tolerance: median and p95 of the error over the members, microseconds a member."""

    who: str
    tolerance: float
    error: float
    worst: float
    microseconds: float


def lorenz_members(count: int) -> tuple[np.ndarray, np.ndarray]:
    """rho and z at the start of each member, as bench/work_precision/problems.cpp spreads them."""
    number = np.arange(count) + 1

    def spread(irrational: float) -> np.ndarray:
        return 1 + 0.2 * (2 * ((number * irrational) % 1) - 1)

    return 28 * spread(0.6180339887498949), 25 * spread(0.4142135623730951)


def lorenz_system() -> list:
    x, y, z = hy.make_vars("x", "y", "z")
    return [(x, 10.0 * (y - x)), (y, x * (hy.par[0] - z) - y), (z, x * y - (8.0 / 3) * z)]


def lorenz_reference(rho: np.ndarray, z: np.ndarray, end: float) -> np.ndarray:
    """States at the end in 80 bits."""
    long = np.longdouble
    one = hy.taylor_adaptive(lorenz_system(), [long(1)] * 3, pars=[long(1)], tol=long(1e-18), fp_type=long)
    ends = []
    for r, start in zip(rho, z, strict=True):
        one.time, one.state[:], one.pars[0] = long(0), [long(1), long(1), long(start)], long(r)
        one.propagate_until(long(end))
        ends.append(np.array(one.state, dtype=float))
    return np.array(ends)


def best_of(work: Callable[[], object]) -> float:
    """Median seconds of processor time."""
    taken = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return float(np.median(taken))


def heyoka_lorenz(count: int, end: float) -> list[Row]:
    rho, z = lorenz_members(count)
    reference = lorenz_reference(rho, z, end)
    rows = []
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14):
        batch = hy.taylor_adaptive_batch(lorenz_system(), np.ones((3, lanes)), pars=np.ones((1, lanes)), tol=tolerance)
        ends = np.empty((count, 3))

        def work(batch: hy.taylor_adaptive_batch = batch, ends: np.ndarray = ends) -> None:
            for first in range(0, count, lanes):
                here = slice(first, first + lanes)
                batch.state[0], batch.state[1], batch.state[2], batch.pars[0] = 1, 1, z[here], rho[here]
                batch.set_time(0.0)
                batch.propagate_until(end)
                ends[here] = batch.state.T

        seconds = best_of(work)
        error = np.sqrt((((ends - reference) / (1 + np.abs(reference))) ** 2).mean(axis=1))
        rows.append(Row("heyoka, batch of 8", tolerance, float(np.median(error)), float(np.quantile(error, 0.95)), 1e6 * seconds / count))
    return rows


def our_rows(program: pathlib.Path, problem: str, method: str) -> list[Row]:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--problem", problem, "--method", method, "-o", folder], check=True, capture_output=True)
        lines = (line for line in (pathlib.Path(folder) / "work_precision.csv").read_text().splitlines() if not line.startswith("#"))
        found = list(csv.DictReader(lines))
    return [
        Row(f"{row['method']}, {row['code']}", float(row["tolerance"]), float(row["median_error"]), float(row["p95_error"]), 1e6 * float(row["seconds_per_member"]))
        for row in found
        if row["code"] != "scalar"
    ]


def valve_orbits(tolerance: float, end: float, record: bool) -> tuple[int, list[list[float]]]:
    """Events of 16 valves until `end`, and the last eight lifts at them of each, if they are recorded."""
    x, v, p = hy.make_vars("x", "v", "p")
    system = [(x, v), (v, -1.25 * v - (x + 10.0) + p), (p, 20.0 * (hy.par[0] - x * hy.sqrt(p)))]
    inflows = np.linspace(5.0, 7.0, 2 * lanes)
    start = np.tile([[0.2], [0.0], [1.0]], (1, lanes))
    seen: list[list[float]] = [[] for _ in range(lanes)]

    def bounce(batch: hy.taylor_adaptive_batch, _sign: int, lane: int) -> bool:
        batch.state[1, lane] *= -0.8
        seen[lane].append(0.0)
        return True

    def extremum(batch: hy.taylor_adaptive_batch, when: float, _sign: int, lane: int) -> None:
        lift = 0.0
        if record:
            batch.update_d_output(np.full(lanes, when))
            lift = float(batch.d_output[0, lane])
        seen[lane].append(lift)

    batch = hy.taylor_adaptive_batch(
        system,
        start,
        pars=np.ones((1, lanes)),
        tol=tolerance,
        t_events=[hy.t_event_batch(x, callback=bounce, direction=hy.event_direction.negative)],
        nt_events=[hy.nt_event_batch(v, callback=extremum)],
    )
    count, last = 0, []
    for first in range(0, len(inflows), lanes):
        for events in seen:
            events.clear()
        batch.reset_cooldowns()
        batch.state[:] = start
        batch.pars[0] = inflows[first : first + lanes]
        batch.set_time(0.0)
        batch.propagate_until(end)
        count += sum(len(events) for events in seen)
        last += [sorted(events[-8:]) for events in seen]
    return count, last


def heyoka_valve(tolerance: float) -> tuple[float, float]:
    """Events a second, with callbacks that count them, and the largest difference of the last lifts from those at 1e-15."""
    end = 200.0
    valve_orbits(tolerance, end, record=False)  # compiles
    count, taken = 0, 0.0
    for _ in range(rounds):
        start = time.process_time()
        count += valve_orbits(tolerance, end, record=False)[0]
        taken += time.process_time() - start
    own, tight = (valve_orbits(t, end, record=True)[1] for t in (tolerance, 1e-15))
    return count / taken, max(abs(a - b) for of, best in zip(own, tight, strict=True) for a, b in zip(of, best, strict=True))


def main() -> None:
    parser = argparse.ArgumentParser(description="heyoka beside slideway, one core")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    rows = heyoka_lorenz(112, 5.0)
    for method in ("slideway dop853", "slideway dopri5"):
        rows += our_rows(arguments.program, "lorenz", method)
    text = f"# heyoka {hy.__version__} beside slideway, one core\n\n## Lorenz, 5 units of time, 112 members\n"
    text += "| | tolerance | median error | µs a member |\n|---|---|---|---|\n"
    for row in rows:
        text += f"| {row.who} | {row.tolerance:.0e} | {row.error:.1e} | {row.microseconds:.2f} |\n"
    text += "\nAt equal median error, by straight lines in the logarithms:\n\n| error | heyoka, µs | slideway, µs | times |\n|---|---|---|---|\n"
    ours, theirs = ([row for row in rows if row.who.startswith(who)] for who in ("slideway dop853", "heyoka"))
    for error in (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12):
        at = [
            float(np.exp(np.interp(-np.log(error), [-np.log(r.error) for r in side], [np.log(r.microseconds) for r in side])))
            for side in (theirs, ours)
        ]
        text += f"| {error:.0e} | {at[0]:.2f} | {at[1]:.2f} | {at[0] / at[1]:.2f} |\n"
    text += "\n## Relief valve\n\n| | tolerance | largest error | events a second |\n|---|---|---|---|\n"
    for tolerance in (1e-6, 1e-9):
        events, error = heyoka_valve(tolerance)
        text += f"| heyoka, batch of 8, callbacks in Python | {tolerance:.0e} | {error:.0e} | {events:.3g} |\n"
    for method in ("slideway dop853", "slideway dopri5"):
        for row in our_rows(arguments.program, "relief_valve", method):
            text += f"| {row.who} | {row.tolerance:.0e} | {row.worst:.0e} | {1e6 * recorded_events / row.microseconds:.3g} |\n"
    if arguments.output:
        arguments.output.write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
