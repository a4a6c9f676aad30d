#!/usr/bin/env python3
"""Table and picture of what bench_throughput measured.

usage: bench/throughput_report.py RESULTS.json OUTDIR

Prints a table and writes OUTDIR/throughput.csv, a row for what was measured with the rate of each instruction set and of the peer and the ratio of the
widest to `scalar`, and OUTDIR/throughput.svg, these ratios as bars.  Times are medians of the repetitions.
"""

from __future__ import annotations

import csv
import json
import statistics
import sys
from dataclasses import dataclass, field
from pathlib import Path

# What a row is told by: the first of these that it counts.
RATES = ("members/s", "rhs/s", "member-steps/s", "faces/s", "values/s", "flop/s")


@dataclass
class Row:
    """One thing that was measured, by who did it: an instruction set or a peer."""

    group: str
    what: str
    rate: str = ""
    rates: dict[str, float] = field(default_factory=dict)

    def widest(self) -> str:
        return [name for name in self.rates if name != "odeint"][-1]

    def ratio(self, other: str) -> float | None:
        return self.rates[self.widest()] / self.rates[other] if other in self.rates and other != self.widest() else None


def rows_of(results: dict) -> list[Row]:
    measured: dict[str, list[dict]] = {}
    # As registered, narrow instruction sets before wide ones: repetitions are measured in random order.
    for one in sorted(results["benchmarks"], key=lambda one: one["family_index"]):
        if one.get("run_type") != "aggregate" and not one.get("error_occurred"):
            measured.setdefault(one["run_name"], []).append(one)
    rows: dict[tuple[str, str], Row] = {}
    for name, runs in measured.items():
        parts = name.split("/")
        group, what, who = parts[:3]
        notes = [part for part in parts[3:] if part.startswith("threads:") and part != "threads:1"]
        what = ", ".join([what, *(note.replace("threads:", "threads: ") for note in notes)])
        rate = next((r for r in RATES if r in runs[0]), "")
        if not rate:
            continue
        row = rows.setdefault((group, what), Row(group, what, rate))
        row.rates[who] = statistics.median(run[rate] for run in runs)
    return list(rows.values())


def machine_lines(context: dict) -> list[str]:
    told = [key for key in context if key in ("cpu", "compiler", "commit") or key.startswith("flags, ")]
    return [f"{key}: {context[key]}" for key in told] + [f"date: {context['date']}", f"load: {context.get('load_avg', [])}"]


def table_of(rows: list[Row]) -> list[list[str]]:
    """Its head and a line for each row."""
    names = list(dict.fromkeys(name for row in rows for name in row.rates))
    lines = [["what", "rate", *names, "widest_over_scalar", "over_odeint"]]
    for row in rows:
        numbers = [f"{row.rates[name]:.3g}" if name in row.rates else "" for name in names]
        ratios = [f"{ratio:.2f}" if ratio else "" for ratio in (row.ratio("scalar"), row.ratio("odeint"))]
        lines.append([f"{row.group}: {row.what}", row.rate, *numbers, *ratios])
    return lines


def draw(rows: list[Row], file: Path) -> None:
    """The widest instruction set over `scalar`, a bar for each row that has both."""
    # Here, so that the table needs Python alone.
    import numpy as np
    from slideway.figures.marks import Axis, Level, Panel, Rows, Text, named
    from slideway.plot.axes import picture

    bars = [(f"{row.group}: {row.what}", ratio, row.widest()) for row in reversed(rows) if (ratio := row.ratio("scalar"))]
    ratios = np.array([ratio for _, ratio, _ in bars])
    marks = [Rows(ratios), Level(1, "x"), *(Text(ratio, place, f" {ratio:.1f}", size=8, across="left") for place, ratio in enumerate(ratios))]
    across = Axis(f"times as fast with {bars[-1][2]}\nas with scalar code, one core", low=0, high=1.1 * ratios.max())
    panel = Panel(marks, across, Axis("", ticks=named([name for name, _, _ in bars])))
    file.write_text(picture([panel], height=0.8 + 0.24 * len(bars), width=7), encoding="utf-8")


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    results = json.loads(Path(sys.argv[1]).read_text())
    rows = rows_of(results)
    if not rows:
        print(f"throughput_report.py: {sys.argv[1]} has no rates", file=sys.stderr)
        return 1
    folder = Path(sys.argv[2])
    table = table_of(rows)
    with (folder / "throughput.csv").open("w", encoding="utf-8", newline="") as file:
        for line in ("Throughput", *machine_lines(results["context"]), "Medians of interleaved repetitions; one thread unless a row says two."):
            file.write(f"# {line}\n")
        csv.writer(file, lineterminator="\n").writerows(table)
    if any(row.ratio("scalar") for row in rows):
        draw(rows, folder / "throughput.svg")
    for line in table:
        print("| " + " | ".join(line) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
