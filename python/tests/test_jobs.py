"""The job of examples/jobs/fit.py: its yields are counted again, and it decides only where an exact test does."""

from __future__ import annotations

import doctest
import importlib.util
import math
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import slideway
from conftest import root
from scipy.stats import beta, binom

script = root / "examples/jobs/fit.py"
LIMIT, WANTED = 40e-3, 0.999


@pytest.fixture(scope="module")
def job() -> ModuleType:
    """The script as a module."""
    found = importlib.util.spec_from_file_location("fit", script)
    assert found and found.loader
    module = importlib.util.module_from_spec(found)
    sys.modules["fit"] = module  # where its data class looks itself up
    found.loader.exec_module(module)
    return module


def run(folder: Path, *options: str) -> tuple[int, dict[str, list[str]], str]:
    """Its exit code, the cells of its rows by fit, and its last line."""
    done = subprocess.run([sys.executable, str(script), "--folder", str(folder), *options], capture_output=True, text=True, check=False)
    assert not done.stderr
    rows = [re.split(r"  +", line) for line in done.stdout.splitlines()[1:-1]]
    return done.returncode, {row[0]: row[1:] for row in rows}, done.stdout.splitlines()[-1]


def exact(met: int, members: int) -> tuple[float, float]:
    """The interval of Clopper and Pearson by quantiles of beta distributions."""
    failed = members - met
    return (beta.ppf(0.025, met, failed + 1) if met else 0.0, beta.ppf(0.975, met + 1, failed) if failed else 1.0)


def counted(folder: Path, fit: str) -> tuple[int, int]:
    """Members of a result within the limit, and all of them."""
    with slideway.open(folder / f"{fit.replace('/', '_')}.nc") as result:
        return int(np.sum((result.damping_loss.values <= LIMIT) & (result.status.values == 0))), result.sizes["member"]


def test_its_examples_hold(job: ModuleType) -> None:
    assert doctest.testmod(job).failed == 0


def test_clearances_are_those_of_the_standard(job: ModuleType) -> None:
    # ISO 286-1: tolerances are 10, 16, 25, 40 of i = 0.45 D^(1/3) + 0.001 D, deviations powers of D, the geometric mean of the range; then rounded.
    size = math.sqrt(18 * 30)
    unit = 0.45 * size ** (1 / 3) + 0.001 * size
    grade = {"6": 10, "7": 16, "8": 25, "9": 40}
    deviation = {"g": 2.5 * size**0.34, "f": 5.5 * size**0.41, "e": 11 * size**0.41, "d": 16 * size**0.44}
    for fit in job.COSTS:
        hole, shaft = fit.split("/")
        least = deviation[shaft[0]]
        assert job.gap(fit) == pytest.approx((least, least + unit * (grade[hole[1]] + grade[shaft[1]])), abs=1.5), fit


def test_few_members_decide_nothing(program: str, tmp_path: Path, job: ModuleType) -> None:
    code, rows, last = run(tmp_path, "--members", "64")
    assert code == 1
    assert last == "No fit can be named. Undecided: H8/f7, H7/f7, H7/g6. 64 members are too few: at least 3,688 are needed."
    assert list(rows) == list(job.COSTS)
    for fit, (gap, met, of, share, interval, cost, verdict, _) in rows.items():
        good, members = counted(tmp_path, fit)
        assert (int(met), int(of), float(share), float(cost)) == (good, members, pytest.approx(100 * good / members, abs=6e-4), job.COSTS[fit])
        assert [float(end) / 100 for end in interval.split(" - ")] == pytest.approx(exact(good, members), abs=6e-6), fit
        assert verdict == ("no" if binom.sf(members - good - 1, members, 1 - WANTED) < 0.025 else "undecided"), fit  # never good
        low, high = (float(end) for end in gap.split(" - "))
        with slideway.open(tmp_path / f"{fit.replace('/', '_')}.nc") as result:
            sides = 2e6 * result.joint_clearance_y.values
            assert low <= sides.min() < (low + high) / 2 < sides.max() <= high, fit


@pytest.mark.slow
def test_enough_members_name_the_cheapest_fit(program: str, tmp_path: Path) -> None:
    code, rows, last = run(tmp_path, "--members", "3700", "--fits", "H8/f7", "H8/e8")
    assert (code, last) == (0, "H8/f7 is the cheapest fit with a yield of 99.9 %, at a cost of 1.25.")
    failed = {}
    for fit, (_, met, of, *_) in rows.items():
        good, members = counted(tmp_path, fit)
        assert (int(met), int(of)) == (good, members) and members == 3700
        failed[fit] = members - good
    # Were the yield just what is wanted, so few would fail in less than one of forty studies, and so many.
    assert binom.cdf(failed["H8/f7"], 3700, 1 - WANTED) <= 0.025
    assert binom.sf(failed["H8/e8"] - 1, 3700, 1 - WANTED) <= 0.025


@pytest.mark.parametrize(("failed", "members"), [(0, 3688), (1, 5570), (5, 11_665)])
def test_a_verdict_takes_the_members_that_the_page_says(job: ModuleType, failed: int, members: int) -> None:
    assert [job.Row("H8/f7", count - failed, count).verdict for count in (members - 1, members)] == ["undecided", "yes"]
    assert binom.cdf(failed, members, 1 - WANTED) <= 0.025 < binom.cdf(failed, members - 1, 1 - WANTED)
    assert f"{members:,}" in (root / "docs/how_to/jobs.md").read_text(encoding="utf-8")


def test_a_single_failure_of_few_members_is_no_verdict(job: ModuleType) -> None:
    for members in range(1, 200):
        assert job.Row("H8/f7", members - 1, members).verdict == ("no" if members <= 25 else "undecided"), members  # 1 - 0.999^25 = 0.0247
        assert job.Row("H8/f7", members, members).verdict == "undecided", members


@pytest.mark.slow
def test_the_page_shows_what_it_prints(program: str) -> None:
    printed = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=True).stdout
    assert f"$ python examples/jobs/fit.py\n{printed}```\n" in (root / "docs/how_to/jobs.md").read_text(encoding="utf-8")
