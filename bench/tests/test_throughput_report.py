"""bench/compare.py and bench/throughput_report.py on results that were made up."""

from __future__ import annotations

import json
import stat
import subprocess
import sys
from pathlib import Path

import pytest

BENCH = Path(__file__).resolve().parents[1]


def run_of(name: str, seconds: float, **counters: float) -> dict:
    return {"name": name, "run_name": name, "run_type": "iteration", "time_unit": "us", "cpu_time": 1e6 * seconds, "real_time": 2e6 * seconds, **counters}


def results_of(*runs: dict) -> dict:
    context = {"date": "2026-01-01", "cpu": "a machine", "compiler": "a compiler", "commit": "abc", "load_avg": [0.1]}
    return {"context": context, "benchmarks": list(runs)}


def write(folder: Path, name: str, results: dict) -> str:
    file = folder / name
    file.write_text(json.dumps(results))
    return str(file)


def call(script: str, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(BENCH / script), *words], capture_output=True, text=True, check=False)


def cells(text: str, row: str) -> list[str]:
    line = next(line for line in text.splitlines() if line.startswith(f"| {row} |"))
    return [cell.strip() for cell in line.strip("|").split("|")]


def repeated(name: str, *seconds: float) -> list[dict]:
    return [run_of(name, s) for s in seconds]


def test_a_row_that_is_slower_in_every_round_fails(tmp_path: Path) -> None:
    base = write(tmp_path, "base.json", results_of(*repeated("a", *[1.0] * 7), *repeated("b", *[1.0] * 7)))
    new = write(tmp_path, "new.json", results_of(*repeated("a", *[1.05] * 7), *repeated("b", *[1.01] * 7)))
    answer = call("compare.py", base, new)
    assert answer.returncode == 1
    assert cells(answer.stdout, "a")[3:] == ["1.050 (1.050 … 1.050)", "slower"]
    assert cells(answer.stdout, "b")[-1] == ""
    assert call("compare.py", base, new, "--allow", "6").returncode == 0


def test_a_row_within_its_scatter_passes(tmp_path: Path) -> None:
    base = write(tmp_path, "base.json", results_of(*repeated("a", 1.0, 1.2, 0.9, 1.1, 1.0, 0.95, 1.3)))
    new = write(tmp_path, "new.json", results_of(*repeated("a", 1.2, 1.0, 1.1, 1.0, 1.2, 1.1, 1.0)))
    assert call("compare.py", base, new).returncode == 0


def test_the_range_holds_the_median_with_95_per_cent() -> None:
    sys.path.insert(0, str(BENCH))
    from compare import median_range

    # 2·(1/2)⁷ = 1.6 % outside the least and largest of seven, 2·8/2⁷ = 12.5 % outside the next; of five nothing suffices.
    assert median_range([1, 2, 3, 4, 5, 6, 7]) == (1, 7)
    assert median_range([1, 2, 3, 4, 5]) == (1, 5)
    # 2·(1 + 9)/2⁹ = 3.9 %: the second and the last but one of nine.
    assert median_range([9, 8, 7, 6, 5, 4, 3, 2, 1]) == (2, 8)


def test_two_programs_are_run_in_turn(tmp_path: Path) -> None:
    programs = []
    for name, seconds in (("old", 1.0), ("new", 0.5)):
        program = tmp_path / name
        content = json.dumps(results_of(run_of("a", seconds)))
        program.write_text(f'#!/bin/sh\necho {name} >>"{tmp_path}/order"\nfor word in "$@"; do case $word in --benchmark_out=*) '
                           f"printf '%s' '{content}' >\"${{word#--benchmark_out=}}\" ;; esac; done\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        programs.append(str(program))
    answer = call("compare.py", "--rounds", "2", *programs)
    assert answer.returncode == 0
    assert cells(answer.stdout, "a")[3].startswith("0.500")
    assert (tmp_path / "order").read_text().split() == ["old", "new", "new", "old"]


def test_what_has_no_counterpart_is_named_and_errors_count_for_nothing(tmp_path: Path) -> None:
    failed = run_of("c", 1.0) | {"error_occurred": True}
    base = write(tmp_path, "base.json", results_of(run_of("a", 1.0), run_of("b", 1.0), failed))
    new = write(tmp_path, "new.json", results_of(run_of("a", 1.0), run_of("c", 9.0)))
    answer = call("compare.py", base, new)
    assert cells(answer.stdout, "b")[1:3] == ["measured", ""]
    assert cells(answer.stdout, "c")[1:3] == ["", "measured"]
    nothing = write(tmp_path, "nothing.json", results_of(run_of("d", 1.0)))
    assert call("compare.py", base, nothing).returncode == 2


def test_rows_by_the_wall_clock_are_compared_by_it(tmp_path: Path) -> None:
    base = write(tmp_path, "base.json", results_of(run_of("a/real_time", 1.0)))
    new = write(tmp_path, "new.json", results_of(run_of("a/real_time", 1.0) | {"real_time": 4e6}))
    assert cells(call("compare.py", base, new).stdout, "a/real_time")[3].startswith("2.000")


@pytest.fixture
def throughput(tmp_path: Path) -> str:
    rows = [("engine/turn/scalar/threads:1", 10.0), ("engine/turn/wide/threads:1", 40.0), ("engine/turn/wide/threads:2/real_time", 70.0),
            ("valve/events/scalar", 5.0), ("valve/events/wide", 20.0), ("valve/events/odeint", 4.0)]
    runs = [
        run_of(name, 1.0, family_index=i, **{"members/s": rate * factor})
        for factor in (0.5, 1.0, 3.0)
        for i, (name, rate) in reversed(list(enumerate(rows)))
    ]
    return write(tmp_path, "results.json", results_of(*runs))


def test_the_table_has_medians_and_ratios(throughput: str, tmp_path: Path) -> None:
    answer = call("throughput_report.py", throughput, str(tmp_path))
    assert answer.returncode == 0, answer.stderr
    text = answer.stdout
    assert cells(text, "engine: turn") == ["engine: turn", "members/s", "10", "40", "", "4.00", ""]
    assert cells(text, "engine: turn, threads: 2")[3] == "70"
    assert cells(text, "valve: events") == ["valve: events", "members/s", "5", "20", "4", "4.00", "5.00"]
    table = (tmp_path / "throughput.csv").read_text()
    assert "# commit: abc" in table
    assert '"engine: turn, threads: 2",members/s,,70,,,\n' in table
    assert "<svg" in (tmp_path / "throughput.svg").read_text()


def test_results_without_rates_are_told(tmp_path: Path) -> None:
    file = write(tmp_path, "results.json", results_of(run_of("peak/x/scalar", 1.0, family_index=0)))
    answer = call("throughput_report.py", file, str(tmp_path))
    assert answer.returncode == 1
    assert "has no rates" in answer.stderr
