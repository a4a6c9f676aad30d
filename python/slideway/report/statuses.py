"""How members ended, in words."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

import slideway
from slideway.members import counts

from .numbers import counted, number

MEANINGS = {
    "finished": "reached the end time",
    "not_run": "the run stopped before the member started or ended; slideway run --resume goes on",
    "step_too_small": "the error control asked for a step below the resolution of time",
    "max_steps": "spent all steps that integrator.max_steps allows; raise it, or look whether the member chatters",
    "nonfinite": "a number became infinite or no number at any step; with method rk4 use a smaller integrator.step",
    "geometry": "the slider left its way, the rod did not reach it, a rigid one began inside the way, or a loop of joints without clearance came to a dead centre",
    "contact_domain": "a line contact was pressed deeper than its law holds for (δ ≤ l²/R)",
    "invalid_inputs": "the values drawn for the member cannot be used; it was not integrated",
    "unstable": "reached the end time, but its energy audit says that the method left its stable range; use smaller tolerances",
    "out_of_time": "its crank had not turned as far as it was to when study.time_limit was over; give it longer",
}
MOST_NAMED = 20


@dataclass(frozen=True)
class Ending:
    """How some members ended."""

    status: str
    count: int
    meaning: str


@dataclass(frozen=True)
class Failure:
    """A member that did not reach its end."""

    member: int
    status: str
    time: float  # [s], NaN where it never started
    where: str  # what its state was


def endings(result: xr.Dataset) -> list[Ending]:
    """Counts of how members ended, the most frequent first, finished above all."""
    found = counts(result)
    order = sorted(found, key=lambda word: (word != "finished", -found[word], word))
    return [Ending(word, found[word], MEANINGS.get(word, "")) for word in order]


def failures(result: xr.Dataset) -> list[Failure]:
    """The first members that failed, with when and where; empty where members are not stored."""
    if "status" not in result:
        return []
    words = slideway.statuses(result).values
    failed = np.flatnonzero((words != "finished") & (words != "not_run"))[:MOST_NAMED]
    return [_failure(result.isel(member=int(k)), str(words[k])) for k in failed]


def _failure(row: xr.Dataset, status: str) -> Failure:
    places = []
    for name, factor, unit in (("y", 1e3, "mm"), ("z", 1e3, "mm"), ("roll", 1e3, "mrad"), ("yaw", 1e3, "mrad"), ("pitch", 1e3, "mrad")):
        if f"final_{name}" in row:
            places.append(f"{name} {number(float(row[f'final_{name}']) * factor, 3)} {unit}")
    return Failure(int(row["member"]), status, float(row["end_time"]) if "end_time" in row else np.nan, ", ".join(places))


def headline(every: list[Ending]) -> tuple[str, str]:
    """Grade and words for the top of the page."""
    total = sum(ending.count for ending in every)
    good = sum(ending.count for ending in every if ending.status == "finished")
    if good == total:
        return "good", {1: "The member", 2: "Both members"}.get(total, f"All {total:,} members") + " finished"
    return ("bad" if good == 0 else "warn"), f"{good:,} of {counted(total, 'member')} finished"
