#!/usr/bin/env python3
"""Compares what two builds of bench_throughput do in a second.

usage: bench/compare.py [--rounds N] [--filter REGEX] [--allow PERCENT] BASE NEW

BASE and NEW are two programs, run in turn N times so that what slows the machine slows both, or two files of results
(--benchmark_out=FILE.json).  A row is the ratio of times NEW over BASE, below 1 where NEW is faster: its median over the rounds, and the
range that the median of N rounds lies in with 95 % probability.  The exit code is 1 where a row is slower by more than PERCENT, range
and all; such rows are marked.  Rows that one of them does not have are named.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

Times = dict[str, list[float]]


def times_of(results: dict) -> Times:
    """Seconds of an iteration of each row; rows measured by the wall clock by that.  Runs that reported an error have none."""
    unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
    times: Times = {}
    for row in results["benchmarks"]:
        if row.get("run_type") == "aggregate" or row.get("error_occurred"):
            continue
        by = "real_time" if row["name"].endswith("/real_time") else "cpu_time"
        times.setdefault(row["run_name"], []).append(row[by] * unit[row["time_unit"]])
    return times


def run(program: str, pattern: str) -> Times:
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        command = [program, f"--benchmark_filter={pattern}", f"--benchmark_out={file.name}", "--benchmark_out_format=json"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return times_of(json.loads(Path(file.name).read_text()))


def rounds_of(base: str, new: str, rounds: int, pattern: str) -> tuple[Times, Times]:
    all_times: tuple[Times, Times] = ({}, {})
    for i in range(rounds):
        print(f"\rround {i + 1} of {rounds}", end="", file=sys.stderr, flush=True)
        # The second of two may find a warmer machine: they take turns in that, too.
        for which in (0, 1) if i % 2 == 0 else (1, 0):
            for name, times in run((base, new)[which], pattern).items():
                all_times[which].setdefault(name, []).append(statistics.median(times))
    print(file=sys.stderr)
    return all_times


def median_range(ratios: list[float]) -> tuple[float, float]:
    """Order statistics that enclose the median of the distribution with 95 % probability; all of them where there are too few."""
    n, ordered = len(ratios), sorted(ratios)
    outside, k = 0.0, 0
    while k < n // 2 and 2 * (outside + math.comb(n, k) / 2**n) <= 0.05:
        outside += math.comb(n, k) / 2**n
        k += 1
    k = max(k - 1, 0)
    return ordered[k], ordered[n - 1 - k]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base", metavar="BASE")
    parser.add_argument("new", metavar="NEW")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--filter", default=".", metavar="REGEX")
    parser.add_argument("--allow", type=float, default=2.0, metavar="PERCENT")
    words = parser.parse_args()
    if words.rounds < 1:
        parser.error("--rounds is at least 1")
    if words.base.endswith(".json") != words.new.endswith(".json"):
        parser.error("BASE and NEW are two programs or two files of results")
    if words.base.endswith(".json"):
        base, new = (times_of(json.loads(Path(file).read_text())) for file in (words.base, words.new))
    else:
        base, new = rounds_of(words.base, words.new, words.rounds, words.filter)

    slower = 0
    print(f"| row | {words.base} | {words.new} | ratio of times | |\n|---|---|---|---|---|")
    for name in (name for name in base if name in new):
        count = min(len(base[name]), len(new[name]))
        ratios = [n / b for b, n in zip(base[name][:count], new[name][:count])]
        low, high = median_range(ratios)
        too_slow = low > 1 + words.allow / 100
        slower += too_slow
        one, other = (f"{1e3 * statistics.median(t[name]):.4g} ms" for t in (base, new))
        print(f"| {name} | {one} | {other} | {statistics.median(ratios):.3f} ({low:.3f} … {high:.3f}) | {'slower' if too_slow else ''} |")
    for name in sorted(base.keys() ^ new.keys()):
        print(f"| {name} | {'' if name in new else 'measured'} | {'' if name in base else 'measured'} | | in one alone |")
    if not base.keys() & new.keys():
        print("compare.py: no row is in both", file=sys.stderr)
        return 2
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
