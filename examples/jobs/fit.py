"""The cheapest fit of a pump's crosshead with which 99.9 % of the pumps keep a limit; or that the members are too few to say so.

    python fit.py [--members N] [--fits H8/f7 H8/e8 ...] [--folder FOLDER]

Edit what stands in capitals: limit, fits and costs are examples.  The exit code is 1 where the members are too few,
2 where a run fails.
"""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import slideway

SCENE = Path(__file__).parent / "pump.toml"
QUANTITY, LIMIT = "damping_loss", "40 mJ"  # what impacts take in the scene's five turns: above it the pump is heard
WANTED = 0.999  # the share of pumps that keep the limit
DOUBT = 0.025  # at either end of an interval

# Deviations of 18 to 30 mm (ISO 286-1) [um]: the lower and the upper limit of the hole, and of what runs in it.
HOLES = {"H7": (0, 21), "H8": (0, 33), "H9": (0, 52)}
SHAFTS = {"g6": (-20, -7), "f7": (-41, -20), "e8": (-73, -40), "d9": (-117, -65)}
# What a pair of parts costs to make, relative to the cheapest: an assumption.
COSTS = {"H7/g6": 1.6, "H7/f7": 1.4, "H8/f7": 1.25, "H8/e8": 1.1, "H9/d9": 1.0}


def share_failing(most: int, members: int, chance: float) -> float:
    """The share of all pumps that fail where so many or fewer of these members fail with this chance: the binomial distribution, solved for the share.

    >>> round(share_failing(0, 100, 0.025), 5)  # 1 - 0.025^(1/100)
    0.03622
    """
    ways = [math.lgamma(members + 1) - math.lgamma(k + 1) - math.lgamma(members - k + 1) for k in range(most + 1)]
    low, high = 0.0, 1.0
    for _ in range(50):
        share = (low + high) / 2
        fails, meets = math.log(share), math.log1p(-share)
        likelier = sum(math.exp(way + k * fails + (members - k) * meets) for k, way in enumerate(ways)) > chance
        low, high = (share, high) if likelier else (low, share)
    return low


@dataclass
class Row:
    """What came of a fit."""

    fit: str
    met: int  # members that keep the limit
    members: int
    resolution: str = ""  # what the run says of its integration error

    @cached_property
    def interval(self) -> tuple[float, float]:
        """That of Clopper and Pearson for the yield, 95 %: exact.  Wilson's, which a run prints, calls a fit bad for one failure among 170 members.

        >>> [round(end, 5) for end in Row("H7/g6", 4000, 4000).interval + Row("H7/g6", 90, 100).interval + Row("H7/g6", 0, 2).interval]
        [0.99908, 1.0, 0.82378, 0.95099, 0.0, 0.84189]
        """
        failed = self.members - self.met
        return (0.0 if self.met == 0 else 1 - share_failing(failed, self.members, DOUBT),
                1.0 if failed == 0 else 1 - share_failing(failed - 1, self.members, 1 - DOUBT))  # fmt: skip

    @property
    def verdict(self) -> str:
        """By the whole interval.

        >>> [Row("H7/g6", met, members).verdict for met, members in ((3688, 3688), (3687, 3687), (169, 170), (3992, 4000), (3991, 4000))]
        ['yes', 'undecided', 'undecided', 'undecided', 'no']
        """
        low, high = self.interval
        return "yes" if low >= WANTED else "no" if high < WANTED else "undecided"


def gap(fit: str) -> tuple[int, int]:
    """The least and the largest clearance between hole and shaft [um].

    >>> gap("H8/f7")
    (20, 74)
    """
    hole, shaft = fit.split("/")
    return HOLES[hole][0] - SHAFTS[shaft][1], HOLES[hole][1] - SHAFTS[shaft][0]


def scatter(fit: str) -> dict[str, Any]:
    """Of the clearance of one side, which is half the gap: normal, the limits three standard deviations off, where parts are rejected."""
    low, high = (limit / 2 for limit in gap(fit))
    return {"dist": "truncnorm", "mean": f"{(low + high) / 2} um", "sd": f"{(high - low) / 6} um", "low": f"{low} um", "high": f"{high} um"}


def study(fit: str, members: int, folder: Path | None) -> Row:
    """Runs as many pumps with this fit; into a folder, if there is one."""
    keys = {"study.members": members, "study.quantities": [QUANTITY], "study.limits": {QUANTITY: {"max": LIMIT}},
            'study.vary."joint.clearance_y"': scatter(fit)}  # fmt: skip
    output = folder and folder / f"{fit.replace('/', '_')}.nc"
    with slideway.run(SCENE, output, set=keys, progress=False) as result, result.slideway.yields as yields:
        checked = slideway.resolution(result)
        return Row(fit, int(yields.all_met), int(yields.trials), checked.verdict if checked else "not_checked")


def needed() -> int:
    """Members without a failure from which on the interval lies above the wanted yield.

    >>> needed()
    3688
    """
    return math.ceil(math.log(DOUBT) / math.log(WANTED))


def conclusion(rows: list[Row]) -> tuple[str, bool]:
    """The cheapest fit that is shown to do, in words, and whether all is decided that is cheaper.

    >>> few, good, bad = Row("H9/d9", 256, 256), Row("H8/f7", 4000, 4000), Row("H8/e8", 3900, 4000)
    >>> conclusion([good, bad])
    ('H8/f7 is the cheapest fit with a yield of 99.9 %, at a cost of 1.25.', True)
    >>> conclusion([bad])
    ('No fit has a yield of 99.9 %.', True)
    >>> print(conclusion([good, bad, few])[0])
    H8/f7 has a yield of 99.9 %, at a cost of 1.25. Cheaper and undecided: H9/d9. 256 members are too few: at least 3,688 are needed.
    >>> print(conclusion([bad, few])[0])
    No fit can be named. Undecided: H9/d9. 256 members are too few: at least 3,688 are needed.
    """
    wanted = f"a yield of {100 * WANTED:g} %"
    by_cost = sorted(rows, key=lambda row: COSTS[row.fit])
    shown = next((row for row in by_cost if row.verdict == "yes"), None)
    doubtful = [row for row in by_cost if row.verdict == "undecided" and (shown is None or COSTS[row.fit] < COSTS[shown.fit])]
    if not doubtful:
        return (f"{shown.fit} is the cheapest fit with {wanted}, at a cost of {COSTS[shown.fit]}." if shown else f"No fit has {wanted}."), True
    named = f"{shown.fit} has {wanted}, at a cost of {COSTS[shown.fit]}. Cheaper and undecided" if shown else "No fit can be named. Undecided"
    members = min(row.members for row in doubtful)
    more = f"at least {needed():,} are needed" if members < needed() else "more are needed, as some fail"
    return f"{named}: {', '.join(row.fit for row in doubtful)}. {members:,} members are too few: {more}.", False


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description="The cheapest fit of a pump's crosshead for a yield.")
    parser.add_argument("--members", type=int, default=4000, help="pumps of each fit (4000)")
    parser.add_argument("--fits", nargs="+", choices=COSTS, default=list(COSTS), help="which fits (all)")
    parser.add_argument("--folder", type=Path, help="where to keep the results (nowhere)")
    options = parser.parse_args()
    rows = []
    print(f"{'fit':<6} {'gap [um]':>9} {'met':>6} {'of':>6} {'yield [%]':>9}  {'95 % interval':<17} {'cost':>5}  {f'{100 * WANTED:g} %':<9}  integration error")
    for fit in options.fits:
        try:
            row = study(fit, options.members, options.folder)
        except slideway.SlidewayError as error:
            print(f"fit.py: {error}", file=sys.stderr)
            return 2
        rows.append(row)
        low, high = gap(fit)
        share, limits = 100 * row.met / row.members, " - ".join(f"{100 * end:.3f}" for end in row.interval)
        print(f"{fit:<6} {f'{low} - {high}':>9} {row.met:>6} {row.members:>6} {share:>9.3f}  {limits:<17} {COSTS[fit]:>5.2f}  {row.verdict:<9}  "
              f"{row.resolution.replace('_', ' ')}", flush=True)  # fmt: skip
    words, decided = conclusion(rows)
    print(words)
    return 0 if decided else 1


if __name__ == "__main__":
    sys.exit(main())
