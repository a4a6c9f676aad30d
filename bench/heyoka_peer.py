"""heyoka (Taylor series compiled by LLVM, batches as wide as the processor) beside slideway, both on one core and in turn.

Usage: heyoka_peer.py WORK_PRECISION [-o OUTPUT], with the program bench/work_precision of a release build; needs heyoka and numpy from
PyPI and a C compiler.  Writes OUTPUT.md and OUTPUT.csv, whose columns are those of work_precision.csv.  Members, times, errors and what
counts as exact are those of `work_precision`; relief valve: events a second while 16 valves bounce.
"""

from __future__ import annotations

import argparse
import collections
import csv
import os
import pathlib
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import heyoka as hy
import numpy as np
from heyoka_models import Bouncing, Lorenz, Members, Valves, lanes
from heyoka_slider_models import FreeSlider, Springs

recorded_events = 2048 + 64  # of a valve in work_precision: its transient's and those that are compared
least_time = 0.02  # [s] of what is timed at once


class WatchedFlight(Springs):
    """In flight, but looking for touches as slideway does."""

    in_units = False


@dataclass
class Problem:
    name: str
    words: str
    methods: str  # of slideway
    models: dict[str, type]  # of heyoka
    tolerances: Iterable[float]


problems = [
    Problem("lorenz", "Lorenz, 5 units of time", "auto,dop853,dopri5", {"heyoka": Lorenz}, (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14)),
    Problem(
        "flight",
        "Free slider, tumbling in flight, 0.1 s",
        "dop853,dopri5",
        {"heyoka": FreeSlider, "heyoka, which looks for touches": WatchedFlight},
        (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13),
    ),
    Problem(
        "springs",
        "Free slider, rattling on linear springs, 5 ms",
        "auto,verner65,dop853",
        {"heyoka": Springs},
        (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10),
    ),
    Problem(
        "bouncing",
        "A mass bouncing between two linear springs, 20 ms",
        "dop853,verner65,dopri5",
        {"heyoka": Bouncing},
        (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12),
    ),
]


@dataclass
class Row:
    """One method at one tolerance: median and p95 of the error over the members, seconds a member in each round."""

    method: str
    code: str
    tolerance: float
    median: float
    p95: float
    seconds: list[float]

    @property
    def microseconds(self) -> float:
        return 1e6 * float(np.median(self.seconds))


def processor_time(work: Callable[[], object]) -> float:
    """Seconds of one call."""
    calls, start = 0, time.process_time()
    while time.process_time() - start < least_time:
        work()
        calls += 1
    return (time.process_time() - start) / calls


def our_table(program: pathlib.Path, problem: str, methods: str, folder: str) -> list[str]:
    """Lines of work_precision.csv."""
    words = [program, "--problem", problem, "--method", ",".join(f"slideway {m}" for m in methods.split(","))]
    words += ["--no-scalar", "--members", "-o", folder]
    subprocess.run(words, check=True, capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    return (pathlib.Path(folder) / "work_precision.csv").read_text().splitlines()


def our_rows(*what: object) -> list[dict[str, str]]:
    lines = (line for line in our_table(*what) if not line.startswith("#"))
    return list(csv.DictReader(lines))


def provenance(program: pathlib.Path) -> list[str]:
    """Machine, compiler, commit, date and flags, as the program says them."""
    with tempfile.TemporaryDirectory() as folder:
        lines = our_table(program, "bouncing", "dop853", folder)
    said = [line[2:] for line in lines if line.startswith("# ") and not line.startswith(("# peers", "# slideway scalar"))]
    return [*said, f"heyoka {hy.__version__} from PyPI, batch of {lanes}, fast_math, callbacks compiled by cc -O2"]


def measured(program: pathlib.Path, problem: Problem, rounds: int) -> list[Row]:
    ours: dict[tuple, Row] = {}
    theirs: dict[tuple, tuple[Row, object]] = {}
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            for row in our_rows(program, problem.name, problem.methods, folder):
                key = row["method"], float(row["tolerance"])
                fresh = Row(row["method"], row["code"], key[1], float(row["median_error"]), float(row["p95_error"]), [])
                ours.setdefault(key, fresh).seconds.append(float(row["seconds_per_member"]))
            members = Members(pathlib.Path(folder) / f"{problem.name}_members.csv")
        for method, model in problem.models.items():
            for tolerance in problem.tolerances:
                key = method, tolerance
                if key not in theirs:
                    solver = model(members, tolerance)
                    solver.run()
                    errors = members.errors(solver.found)
                    row = Row(method, f"batch of {lanes}", tolerance, float(np.median(errors)), float(np.quantile(errors, 0.95)), [])
                    theirs[key] = row, solver
                row, solver = theirs[key]
                row.seconds.append(processor_time(solver.run) / len(members))
    return [row for row, _ in theirs.values()] + list(ours.values())


def times_at(rows: list[Row], error: float) -> float:
    """Microseconds for a median error of this or less, by straight lines in the logarithms; the least of the methods, NaN where none gets
    there."""
    by_method = collections.defaultdict(list)
    for row in rows:
        by_method[row.method].append(row)
    found = []
    for curve in by_method.values():
        curve.sort(key=lambda row: -row.median)
        if error < curve[-1].median:
            continue
        found.append(np.exp(np.interp(-np.log(error), [-np.log(r.median) for r in curve], [np.log(r.microseconds) for r in curve])))
    return float(min(found, default=np.nan))


def section(problem: Problem, rows: list[Row]) -> str:
    text = f"\n## {problem.words}\n\nAt equal median error, the best method of each, by straight lines in the logarithms; "
    text += "where the coarsest tolerance does better, its time:\n\n"
    text += "| error | slideway, µs a member |" + "".join(f" {method}, µs | times |" for method in problem.models) + "\n|---|---|"
    text += "---|---|" * len(problem.models) + "\n"
    ours = [row for row in rows if row.method not in problem.models]
    for error in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13):
        mine = times_at(ours, error)
        theirs = [times_at([row for row in rows if row.method == method], error) for method in problem.models]
        if error > max(row.median for row in rows) or np.isnan(mine) or np.isnan(theirs).all():
            continue
        text += f"| {error:.0e} | {mine:.2f} |"
        text += "".join(" — | — |" if np.isnan(t) else f" {t:.2f} | {t / mine:.2f} |" for t in theirs) + "\n"
    text += "\n| | tolerance | error, median | p95 | µs a member | least … most |\n|---|---|---|---|---|---|\n"
    for row in rows:
        spread = f"{1e6 * min(row.seconds):.2f} … {1e6 * max(row.seconds):.2f}"
        text += f"| {row.method}, {row.code} | {row.tolerance:.0e} | {row.median:.1e} | {row.p95:.1e} | {row.microseconds:.2f} | {spread} |\n"
    return text


def valve_section(program: pathlib.Path, rounds: int) -> str:
    text = "\n## Relief valve\n\n| | tolerance | largest error | events a second |\n|---|---|---|---|\n"
    best = Valves(1e-15).last_lifts()
    valves = {tolerance: Valves(tolerance) for tolerance in (1e-6, 1e-9)}
    rates, ours = collections.defaultdict(list), collections.defaultdict(list)
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            for row in our_rows(program, "relief_valve", "dop853,dopri5", folder):
                ours[row["method"], row["code"], row["tolerance"], row["p95_error"]].append(recorded_events / float(row["seconds_per_member"]))
        for tolerance, valve in valves.items():
            start = time.process_time()
            rates[tolerance].append(valve.run() / (time.process_time() - start))
    for tolerance, valve in valves.items():
        error = np.abs(valve.last_lifts() - best).max()
        text += f"| heyoka, batch of {lanes} | {tolerance:.0e} | {error:.0e} | {np.median(rates[tolerance]):.3g} |\n"
    for (method, code, tolerance, error), found in ours.items():
        text += f"| {method}, {code} | {tolerance} | {float(error):.0e} | {np.median(found):.3g} |\n"
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description="heyoka beside slideway, one core")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="without suffix")
    parser.add_argument("--problem", default="", help="only problems whose name contains this")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    said = provenance(arguments.program)
    text = f"# heyoka beside slideway, one core\n\nMedians of {arguments.rounds} rounds, both in turn in each.\n\n"
    text += "".join(f"- {line}\n" for line in said)
    table = "".join(f"# {line}\n" for line in said) + "problem,method,code,tolerance,median_error,p95_error,error_unit,seconds_per_member\n"
    for problem in problems:
        if arguments.problem not in problem.name:
            continue
        rows = measured(arguments.program, problem, arguments.rounds)
        text += section(problem, rows)
        for r in rows:
            method = f'"{r.method}"' if "," in r.method else r.method
            table += f"{problem.name},{method},{r.code},{r.tolerance:.0e},{r.median:.3e},{r.p95:.3e},1,{1e-6 * r.microseconds:.4e}\n"
    if arguments.problem in "relief_valve":
        text += valve_section(arguments.program, arguments.rounds)
    if arguments.output:
        arguments.output.with_suffix(".md").write_text(text)
        arguments.output.with_suffix(".csv").write_text(table)
    print(text, end="")


if __name__ == "__main__":
    main()
