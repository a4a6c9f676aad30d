"""heyoka (Taylor series compiled by LLVM, batches as wide as the processor) beside slideway, both on one core and in turn.

Usage: heyoka_peer.py WORK_PRECISION [-o OUTPUT], with the program bench/work_precision of a release build; needs heyoka and numpy from
PyPI and a C compiler.  Writes OUTPUT.md and OUTPUT.csv, whose first columns are those of work_precision.csv.  Members, times, errors and what
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
    Problem("flight", "Free slider, tumbling in flight, 0.1 s", "dop853,dopri5",
            {"heyoka": FreeSlider, "heyoka, which looks for touches": WatchedFlight}, (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)),
    Problem("springs", "Free slider, rattling on linear springs, 5 ms", "auto,verner65,dop853", {"heyoka": Springs}, (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)),
    Problem("bouncing", "A mass bouncing between two linear springs, 20 ms", "dop853,verner65,dopri5",
            {"heyoka": Bouncing}, (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12)),
]  # fmt: skip


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


head = "problem,method,code,tolerance,median_error,p95_error,error_unit,seconds_per_member,least_seconds,most_seconds,events_per_second"
errors_shown = (1e-6, 1e-9, 1e-10, 1e-11, 1e-12)  # of the last three the finest that both reach


def compared(problem: Problem, rows: list[Row]) -> str:
    """Rows of the page: both at equal median error, the best method of each."""
    text = ""
    ours = [row for row in rows if row.method not in problem.models]
    for method in problem.models:
        found, words = [], problem.words if method == "heyoka" else f"{problem.words}; {method}"
        for error in errors_shown:
            mine, theirs = times_at(ours, error), times_at([row for row in rows if row.method == method], error)
            if not np.isnan([mine, theirs]).any():
                found.append(f"| {words} | {error:.0e} | {mine:.2f} | {theirs:.2f} | {theirs / mine:.2f} |\n")
        text += "".join([*found[:2], *found[2:][-1:]])
    return text


def line(*fields: str) -> str:
    return ",".join(f'"{field}"' if "," in field else field for field in fields) + "\n"


def lines_of(problem: Problem, rows: list[Row]) -> str:
    """Of the CSV."""
    text = ""
    for r in rows:
        times = [f"{t:.4e}" for t in (1e-6 * r.microseconds, min(r.seconds), max(r.seconds))]
        text += line(problem.name, r.method, r.code, f"{r.tolerance:.0e}", f"{r.median:.3e}", f"{r.p95:.3e}", "1", *times, "")
    return text


def valves(program: pathlib.Path, rounds: int) -> tuple[str, str]:
    """Rows of the page and lines of the CSV.  heyoka's error is the largest of its valves, slideway's that of 95 % of those of work_precision."""
    best = Valves(1e-15).last_lifts()
    theirs = {tolerance: Valves(tolerance) for tolerance in (1e-6, 1e-9)}
    rates, ours = collections.defaultdict(list), collections.defaultdict(list)
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            for row in our_rows(program, "relief_valve", "dop853,dopri5", folder):
                key = row["method"], row["code"], row["tolerance"], float(row["p95_error"])
                ours[key].append(recorded_events / float(row["seconds_per_member"]))
        for tolerance, valve in theirs.items():
            start = time.process_time()
            rates[tolerance].append(valve.run() / (time.process_time() - start))
    found = [("heyoka", f"batch of {lanes}", f"{t:.0e}", float(np.abs(v.last_lifts() - best).max()), float(np.median(rates[t]))) for t, v in theirs.items()]
    found += [(*key, float(np.median(rate))) for key, rate in ours.items()]
    page = ""
    for _, _, tolerance, error, rate in found[: len(theirs)]:
        fastest = max((one for one in found[len(theirs) :] if one[3] <= 1.05 * error), key=lambda one: one[4])
        page += f"| {tolerance} | {error:.0e} | {rate:.3g} | {fastest[0]}, {fastest[2]}: {fastest[3]:.0e} | {fastest[4]:.3g} | {fastest[4] / rate:.1f} |\n"
    table = "".join(line("relief_valve", m, c, t, "", f"{e:.0e}", "1", "", "", "", f"{r:.3g}") for m, c, t, e, r in found)
    return page, table


def main() -> None:
    parser = argparse.ArgumentParser(description="heyoka beside slideway, one core")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="without suffix")
    parser.add_argument("--problem", default="", help="only problems whose name contains this")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    said = provenance(arguments.program)
    text = f"""# heyoka beside slideway, one core

Medians of {arguments.rounds} rounds, both in turn in each, by `bench/heyoka_peer.py`. Microseconds of a member at equal median error, of the best method of each,
by straight lines in the logarithms; where the coarsest tolerance does better, its time. All rows, with the scatter of the rounds:
[{arguments.output.name if arguments.output else "heyoka"}.csv]({arguments.output.name if arguments.output else "heyoka"}.csv).

"""
    text += "".join(f"- {one}\n" for one in said if not one.startswith("date"))
    text += "\n| problem | error | slideway, µs | heyoka, µs | times |\n|---|---|---|---|---|\n"
    table = "".join(f"# {one}\n" for one in said) + head + "\n"
    for problem in problems:
        if arguments.problem not in problem.name:
            continue
        rows = measured(arguments.program, problem, arguments.rounds)
        text += compared(problem, rows)
        table += lines_of(problem, rows)
    if arguments.problem in "relief_valve":
        page, of_valves = valves(arguments.program, arguments.rounds)
        table += of_valves
        text += (
            "\nRelief valve, events a second:\n\n| heyoka, tolerance | error | events/s | slideway with no larger error | events/s | times |\n|---|---|---|---|---|---|\n"
            + page
        )
    if arguments.output:
        arguments.output.with_suffix(".md").write_text(text)
        arguments.output.with_suffix(".csv").write_text(table)
    print(text, end="")


if __name__ == "__main__":
    main()
